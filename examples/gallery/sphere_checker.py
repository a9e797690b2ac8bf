"""A closed surface on the sphere: a checker of meridians and Mercator's parallels, all its squares alike in shape."""

import numpy as np
import pyvista as pv
from scene import BLUE, CREAM, Scene, unshared
from surfaces import bumpy_ball

import conformal_uv as cuv


def texture(colour):
    """A sphere's checker by longitude and latitude."""
    latitude = (0.5 - (np.arange(2048)[:, None] + 0.5) / 2048) * np.pi
    longitude = np.arange(4096) / 4096
    mercator = np.arctanh(np.clip(np.sin(latitude), -0.9999, 0.9999)) / (2 * np.pi)
    field = (np.floor(36 * mercator) + np.floor(36 * longitude)) % 2
    made = pv.Texture((255 * np.where(field[..., None] > 0, colour, CREAM)).astype(np.uint8))
    made.repeat = True
    return made


if __name__ == "__main__":
    V, F = bumpy_ball()
    xyz = cuv.sphere_map(V, F, rotation="surface").xyz
    uv = cuv.equirectangular(xyz, cuv.PolygonMesh(V, F.ravel(), np.arange(0, F.size + 1, 3))).reshape(-1, 2)
    scene = Scene()
    for panel, place in enumerate((V, xyz)):
        scene.add(panel, unshared(place, F, uv), view=(1, 0.4, 0.5), up=(0, 0, 1), texture=texture(BLUE))
    scene.save("sphere_checker")
