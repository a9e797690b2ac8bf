"""Cuts that open a closed surface, or one with handles, into a disk; along the sides of polygons only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import dijkstra, minimum_spanning_tree

__all__ = ["OneChart", "handle_cut", "sphere_cut"]

Ints = NDArray[np.int64]
Real = NDArray[np.float64]

MOST_ROOTS, SITES_FOR_ALL_ROOTS = 16, 200_000  # where the tree of a closed surface is tried from


@dataclass(frozen=True, eq=False)
class OneChart:
    """The joined sides of one chart as a graph, everything numbered from 0.

    Attributes
    ----------
    tail, head : (e,) int64
        Sites at the ends of each pair of joined sides; no two pairs have the same ends.
    left, right : (e,) int64
        Polygons on either side.
    length : (e,) float64
    rim_tail, rim_head : (b,) int64
        Sites at the ends of the boundary's sides.
    sites, polygons : int
        How many there are.
    """

    tail: Ints
    head: Ints
    left: Ints
    right: Ints
    length: Real
    rim_tail: Ints
    rim_head: Ints
    sites: int
    polygons: int

    def graph(self) -> csr_array:
        """Side lengths as a symmetric (sites, sites) matrix; sides without length are given a little."""
        length = self.length + 1e-9 * self.length.mean() + np.finfo(float).tiny
        rows, columns = np.concatenate((self.tail, self.head)), np.concatenate((self.head, self.tail))
        return coo_array((np.tile(length, 2), (rows, columns)), shape=(self.sites, self.sites)).tocsr()

    def pairs_between(self, a: Ints, b: Ints) -> Ints:
        """The pair of joined sides between sites a and b, for each."""
        key = np.minimum(self.tail, self.head) * self.sites + np.maximum(self.tail, self.head)
        order = np.argsort(key)
        return order[np.searchsorted(key, np.minimum(a, b) * self.sites + np.maximum(a, b), sorter=order)]


def sphere_cut(chart: OneChart) -> Ints:
    """A cut for a closed surface of genus 0: the shortest path between two sites far apart, as pairs of sides.

    The ends come from a double sweep: the site farthest from an arbitrary one, and the site farthest from that.
    Between these two the path along polygon sides is shortest; that no shorter cut keeps the map from crowding is
    not claimed. A path of a single side opens nothing and is led on by one more.
    """
    graph = chart.graph()
    start = int(np.argmax(dijkstra(graph, indices=0)))
    distance, before = dijkstra(graph, indices=start, return_predecessors=True)
    path = [int(np.argmax(distance))]
    while path[-1] != start:
        path.append(int(before[path[-1]]))
    if len(path) == 2:
        neighbours = graph.indices[graph.indptr[start] : graph.indptr[start + 1]]
        path.append(int(neighbours[neighbours != path[0]][0]))
    return chart.pairs_between(np.array(path[:-1]), np.array(path[1:]))


def handle_cut(chart: OneChart) -> Ints:
    """A cut graph of a surface with handles, closed or with one boundary loop, as pairs of sides.

    Erickson and Whittlesey (2005), "Greedy optimal homotopy and homology generators": a tree of shortest paths; the
    spanning tree of polygons that crosses the sides with the longest loops through the first tree; each side in
    neither tree closes a loop, and these loops are the cut. Stems that hang on it by one end are taken off. The
    first tree grows from the boundary; on a closed surface from several sites in turn, and the shortest cut is kept.
    """
    graph = chart.graph()
    rim = np.unique(np.concatenate((chart.rim_tail, chart.rim_head)))
    if len(rim):
        return _greedy_cut(chart, graph, rim)
    tries = int(np.clip(SITES_FOR_ALL_ROOTS // chart.sites, 1, MOST_ROOTS))
    roots = np.unique(np.linspace(0, chart.sites - 1, tries).astype(np.int64))
    cuts = [_greedy_cut(chart, graph, roots[k : k + 1]) for k in range(len(roots))]
    return min(cuts, key=lambda cut: float(chart.length[cut].sum()))


def _greedy_cut(chart: OneChart, graph: csr_array, sources: Ints) -> Ints:
    """The cut graph whose tree of shortest paths grows from the given sites."""
    distance, before, _ = dijkstra(graph, indices=sources, min_only=True, return_predecessors=True)
    branch = np.flatnonzero(before >= 0)
    in_tree = np.zeros(len(chart.tail), dtype=bool)
    tree_pair = np.full(chart.sites, -1, dtype=np.int64)
    tree_pair[branch] = chart.pairs_between(branch, before[branch].astype(np.int64))
    in_tree[tree_pair[branch]] = True
    loop_length = distance[chart.tail] + distance[chart.head] + chart.length
    crossed = _cotree(chart, np.flatnonzero(~in_tree), loop_length)
    cut = np.flatnonzero(~in_tree & ~crossed)
    chosen = np.zeros(len(chart.tail), dtype=bool)
    chosen[cut] = True
    for site in np.concatenate((chart.tail[cut], chart.head[cut])).tolist():
        while before[site] >= 0 and not chosen[tree_pair[site]]:
            chosen[tree_pair[site]] = True
            site = int(before[site])
    return _without_stems(chart, np.flatnonzero(chosen))


def _cotree(chart: OneChart, pairs: Ints, weight: Real) -> NDArray[np.bool_]:
    """The pairs that a spanning tree of the polygons of largest weight crosses, as a mask (e,)."""
    low, high = np.minimum(chart.left, chart.right)[pairs], np.maximum(chart.left, chart.right)[pairs]
    order = np.lexsort((-weight[pairs], high, low))
    pairs, low, high = pairs[order], low[order], high[order]
    heaviest = np.ones(len(pairs), dtype=bool)  # of those between the same two polygons
    heaviest[1:] = (low[1:] != low[:-1]) | (high[1:] != high[:-1])
    heaviest &= low != high
    pairs, low, high = pairs[heaviest], low[heaviest], high[heaviest]
    # Ranks instead of weights: ties are broken one way, and no entry is 0.
    rank = np.empty(len(pairs))
    rank[np.argsort(-weight[pairs], kind="stable")] = np.arange(1.0, len(pairs) + 1.0)
    tree = minimum_spanning_tree(coo_array((rank, (low, high)), shape=(chart.polygons, chart.polygons)).tocsr())
    crossed = np.zeros(len(chart.tail), dtype=bool)
    by_rank = np.argsort(rank)
    crossed[pairs[by_rank[tree.data.astype(np.int64) - 1]]] = True
    return crossed


def _without_stems(chart: OneChart, pairs: Ints) -> Ints:
    rim = np.bincount(chart.rim_tail, minlength=chart.sites) + np.bincount(chart.rim_head, minlength=chart.sites)
    while True:
        ends = rim + np.bincount(chart.tail[pairs], minlength=chart.sites)
        ends += np.bincount(chart.head[pairs], minlength=chart.sites)
        kept = (ends[chart.tail[pairs]] > 1) & (ends[chart.head[pairs]] > 1)
        if kept.all():
            return pairs
        pairs = pairs[kept]
