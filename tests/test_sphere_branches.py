"""Branches of the sphere's maps that ordinary meshes seldom take, each against what it is to do."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
from meshes_closed import icosphere

import conformal_uv as cuv
from conformal_uv.mesh.distinguished import distinguished
from conformal_uv.operators.orientation_sign import inverted_faces
from conformal_uv.sphere import newton, solution
from conformal_uv.sphere.centring import centred, landmark_aligned


def test_a_step_that_uncovers_part_of_the_sphere_is_halved(monkeypatch: pytest.MonkeyPatch) -> None:
    """Energies that only fall, faces that all stay sound; the volume falls by the square of the step."""
    V, F = icosphere(1)
    sound = np.ones(len(F), dtype=bool)

    def place(length: float) -> SimpleNamespace:
        x = V * np.cbrt(1.0 - 0.5 * length**2)
        return SimpleNamespace(x=x, corners=F.T, sound=sound, value=-length, gradient=-V, tangent=lambda v: v)

    monkeypatch.setattr(newton, "_moved", lambda energy, mass, step: place(float(step[0, 0] / V[0, 0])))
    held = SimpleNamespace(project=lambda v: v)
    found = newton._line_search(place(0.0), held, np.ones(len(V)), V)
    assert found is not None
    assert found[0] == 0.25  # 1 and 1/2 leave 1/2 and 7/8 of the volume, less than 0.95 of it; 1/4 leaves 31/32


def test_a_relaxed_map_is_not_taken_where_it_folds_a_face(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not even if its angles were the better ones."""
    V, F = icosphere(2)

    def folded(charts: object, x: np.ndarray, corners: np.ndarray) -> np.ndarray:
        out = x.copy()
        out[corners[0, 0]] = -out[corners[0, 0]]
        return out

    monkeypatch.setattr(solution.TwoCharts, "relaxed", folded)
    monkeypatch.setattr(
        solution.ClosedSurface, "_angle_mean", lambda self, x: -float(len(inverted_faces(x, self.surface.corners)))
    )
    assert len(cuv.sphere_map(V * [1.0, 1.2, 1.5], F, method="schwarz", repair="never").flipped) == 0


@pytest.mark.parametrize("pole", [1.0, -1.0])
def test_a_corner_at_a_pole_takes_the_mean_longitude_of_the_others(pole: float) -> None:
    longitude = np.radians([30.0, 80.0])
    xyz = np.array([[0.0, 0.0, pole], *np.column_stack((np.cos(longitude), np.sin(longitude), 0.0 * longitude))])
    uv = cuv.equirectangular(xyz, cuv.PolygonMesh(xyz, np.arange(3), np.array([0, 3])))
    np.testing.assert_allclose(uv[:, 0], 0.5 + np.array([55.0, 30.0, 80.0]) / 360.0, atol=1e-15)
    np.testing.assert_allclose(uv[:, 1], [0.5 + 0.5 * pole, 0.5, 0.5], atol=1e-15)


def test_around_the_surface_is_a_sphere_of_its_area_about_its_middle() -> None:
    V, F = icosphere(2)
    V = 700.0 * V * [1.0, 1.2, 1.5] + [1e3, -50.0, 0.0]
    area = cuv.face_areas(V, F)
    middle = area @ V[F].mean(axis=1) / area.sum()
    around = cuv.sphere_map(V, F, method="linear").around_surface - middle
    np.testing.assert_allclose(np.linalg.norm(around, axis=1), np.sqrt(area.sum() / (4.0 * np.pi)), rtol=1e-12)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_of_alike_vertices_the_nearest_to_the_middle_at_every_scale(scale: float) -> None:
    V, F = icosphere(3)
    V = scale * (V * np.random.default_rng(0).uniform(0.7, 1.3, (len(V), 1)) + [0.3, 0.2, 0.1])
    area = cuv.face_areas(V, F)
    middle = area @ V[F].mean(axis=1) / area.sum()
    candidates = np.arange(0, len(V), 7)
    nearest = candidates[np.argmin(np.linalg.norm(V[candidates] - middle, axis=1))]
    assert distinguished(V, np.ascontiguousarray(F.T.astype(np.int32)), candidates) == nearest


def test_landmarks_are_met_by_a_moebius_map_of_all_vertices() -> None:
    """It is told by three points: where they stand already nothing moves, and what was moved away comes back."""
    V, _ = icosphere(2)
    x = np.concatenate(([[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]], V @ np.linalg.qr(V[:3] + 0.1)[0]))
    np.testing.assert_allclose(landmark_aligned(x, (0, 1, 2)), x, atol=1e-12)
    pushed = centred(x, np.exp(3.0 * x[:, 1]) / np.exp(3.0 * x[:, 1]).sum())
    assert np.abs(pushed - x).max() > 0.3
    np.testing.assert_allclose(landmark_aligned(pushed, (0, 1, 2)), x, atol=1e-9)
