"""What the gallery's scripts share: surfaces side by side in pyvista, and where a picture is written to.

    pip install ".[gallery]" && python examples/gallery/disk_checker.py [picture.webp]

Pictures have no background, so that they stand on light pages and dark ones.
"""

import io
import sys
from pathlib import Path

import numpy as np
import pyvista as pv
from PIL import Image

PICTURES = Path(__file__).resolve().parents[2] / "docs" / "gallery"
CREAM, BLUE, ORANGE = (0.95, 0.91, 0.82), (0.17, 0.40, 0.60), (0.90, 0.47, 0.19)
MOST = 150_000  # bytes of a picture


def mesh(V, F):
    """Vertices (n, 2 or 3) and triangles as pyvista keeps them."""
    V = np.column_stack((V, np.zeros(len(V)))) if np.shape(V)[1] == 2 else np.asarray(V)
    return pv.PolyData.from_regular_faces(V.astype(float), np.asarray(F))


def checker(squares=20, dark=BLUE, light=CREAM, size=2048):
    """A texture of squares by squares fields."""
    cell = np.arange(size) * squares // size
    field = ((cell[:, None] + cell) % 2)[..., None]
    return pv.Texture((255 * np.where(field, dark, light)).astype(np.uint8))


def by_vertex(found, F):
    """The texture coordinates of an unwrap of one chart, vertex by vertex."""
    uv = np.empty((np.max(F) + 1, 2))
    uv[np.ravel(F)] = found.uv
    return uv


def textured(V, F, uv):
    """A surface with texture coordinates of its vertices."""
    surface = mesh(V, F)
    surface.active_texture_coordinates = np.asarray(uv, dtype=float)
    return surface


def unshared(V, F, uv):
    """A surface with texture coordinates of its corners: no vertex is shared, normals are as if they were."""
    surface = mesh(V, F).compute_normals(split_vertices=False, auto_orient_normals=False, consistent_normals=False)
    apart = textured(V[np.ravel(F)], np.arange(np.size(F)).reshape(-1, 3), uv)
    apart.point_data.active_normals = surface.point_data["Normals"][np.ravel(F)]
    return apart


class Scene:
    """Panels in one row, each with a surface of its own or several."""

    def __init__(self, panels=2, width=1200, height=600, rows=1):
        self.columns = panels
        self.plot = pv.Plotter(
            off_screen=True, shape=(rows, panels), window_size=(2 * width, 2 * height), border=False, lighting="none"
        )

    def add(self, panel, surface, *, view=(0, 0, 1), up=(0, 1, 0), flat=False, zoom=1.0, smooth=True, **look):
        """A surface in a panel, seen from `view`; flat ones are not shaded."""
        self.plot.subplot(*divmod(panel, self.columns))
        if smooth and not flat and surface.point_data.active_normals is None:
            surface = surface.compute_normals(split_vertices=False, auto_orient_normals=False, consistent_normals=False)
        look = {"show_scalar_bar": False, "smooth_shading": smooth and not flat, "lighting": not flat, **look}
        if not flat:
            look = {"ambient": 0.18, "diffuse": 0.85, "specular": 0.12, "specular_power": 18, **look}
        self.plot.add_mesh(surface, **look)
        if not self.plot.renderer.lights:
            for place, strength in (((-0.5, 0.7, 1.0), 0.85), ((0.9, 0.1, 0.6), 0.35), ((0.0, -1.0, 0.3), 0.15)):
                light = pv.Light(light_type="camera light", intensity=strength)
                light.position, light.focal_point = place, (0, 0, 0)
                self.plot.renderer.add_light(light)
        if self.plot.camera.parallel_projection:
            return  # the first surface of a panel says what is seen
        self.plot.enable_parallel_projection()
        self.plot.view_vector(view, viewup=up)
        self.plot.reset_camera()
        self._fit(surface.points, np.asarray(view, dtype=float), np.asarray(up, dtype=float), zoom)

    def _fit(self, points, view, up, zoom):
        """Let the points fill the panel but for a small margin."""
        right = np.cross(up, view)
        frame = np.stack((right, np.cross(view, right)), axis=1)
        frame /= np.linalg.norm(frame, axis=0)
        seen = points @ frame
        low, high = seen.min(axis=0), seen.max(axis=0)
        camera, (wide, tall) = self.plot.camera, np.divide(self.plot.window_size, self.plot.shape[::-1])
        shift = frame @ (0.5 * (low + high)) - frame @ (frame.T @ np.array(camera.focal_point))
        camera.position, camera.focal_point = camera.position + shift, camera.focal_point + shift
        size = (high - low) / 2
        camera.parallel_scale = 1.04 * max(size[1], size[0] * tall / wide) / zoom

    def save(self, name):
        """The picture, half as large as it was drawn."""
        save(self.picture(), name)

    def picture(self):
        """An image with transparent background."""
        self.plot.render()
        shot = self.plot.screenshot(transparent_background=True, return_img=True)
        image = Image.fromarray(shot).convert("RGBa")  # premultiplied, or outlines get a seam
        return image.resize((image.width // 2, image.height // 2), Image.Resampling.LANCZOS).convert("RGBA")


def save(image, name):
    """Written as WebP of less than MOST bytes to the path on the command line, else to the docs."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else PICTURES / f"{name}.webp"
    for quality in (90, 84, 76, 66, 50):
        data = io.BytesIO()
        image.save(data, "WEBP", quality=quality, method=6)
        if data.tell() < MOST:
            break
    target.write_bytes(data.getvalue())
    print(f"{target}: {data.tell() // 1000} kB")


def save_figure(figure, name):
    """The same for a figure of matplotlib."""
    data = io.BytesIO()
    figure.savefig(data, dpi=150, facecolor="white")
    save(Image.open(data).convert("RGB"), name)
