"""The sphere filter in pymeshlab: it moves vertices, and nothing else."""

from __future__ import annotations

import numpy as np
import pytest

pymeshlab = pytest.importorskip("pymeshlab", reason="pymeshlab is not installed")

import nasty_meshes  # noqa: E402
from meshes_closed import icosphere  # noqa: E402

import conformal_uv as cuv  # noqa: E402
import meshlab_filter  # noqa: E402

V, F = icosphere(3)
V = V * [1.0, 1.3, 1.7]


@pytest.fixture(autouse=True)
def registered():
    meshlab_filter.register()
    yield
    meshlab_filter.unregister()


def mesh_set(vertices: np.ndarray, faces: np.ndarray):
    ms = pymeshlab.MeshSet()
    ms.add_mesh(pymeshlab.Mesh(np.eye(3), [[0, 1, 2]]), "other")
    ms.add_mesh(pymeshlab.Mesh(vertices, faces), "egg")
    return ms


def test_vertices_come_to_the_map_of_the_library():
    ms = mesh_set(V, F)
    ms.compute_selection_by_condition_per_face(condselect="fi < 7")
    numbers = ms.compute_coord_conformal_sphere(quality="angle")
    expected = cuv.sphere_map(V, F)
    mesh = ms.current_mesh()
    np.testing.assert_array_equal(mesh.vertex_matrix(), expected.xyz)
    np.testing.assert_array_equal(mesh.face_matrix(), F)
    assert ms.current_mesh_id() == 1 and mesh.label() == "egg" and ms.mesh_number() == 2
    assert mesh.selected_face_number() == 7
    assert numbers["conformal_energy"] == expected.conformal_energy and numbers["converged"] == 1
    np.testing.assert_allclose(mesh.face_scalar_array(), expected.distortion.angle_error.mean(axis=1), rtol=1e-12)


@pytest.mark.parametrize(
    ("mesh", "options", "cause"),
    [
        (nasty_meshes.MASK, {}, cuv.TopologyError),
        (nasty_meshes.torus(), {}, cuv.TopologyError),
        ((V, F), {"method": "magic"}, cuv.OptionError),
        ((V, F), {"quality": "beauty"}, cuv.OptionError),
        ((V, F), {"landmarks": [1, 1, 2]}, cuv.OptionError),
    ],
)
def test_what_is_refused_changes_nothing(mesh, options, cause):
    ms = mesh_set(*mesh)
    with pytest.raises(pymeshlab.PyMeshLabException) as caught:
        ms.compute_coord_conformal_sphere(**options)
    assert isinstance(caught.value.__cause__, cause)
    np.testing.assert_array_equal(ms.current_mesh().vertex_matrix(), mesh[0])
    assert ms.current_mesh_id() == 1 and ms.mesh_number() == 2
