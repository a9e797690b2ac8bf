"""The page in a real browser: headless Chromium, drawing by software. Skipped where there is none."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from chromium import launched
from meshes_closed import icosphere

import conformal_uv as cuv
from conformal_uv.mapped_mesh import mapped_mesh
from conformal_uv.page import write_page
from conformal_uv.samples import mask

SINGLE = 2.0**-23


@pytest.fixture(scope="module")
def browser() -> Iterator:
    with launched() as chromium:
        yield chromium


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("pages")


@pytest.fixture(scope="module")
def disk(folder: Path) -> tuple[Path, cuv.DiskMap]:
    result = cuv.disk_map(*mask(2000))
    write_page(folder / "disk.html", result, "A mask")
    return folder / "disk.html", result


@pytest.fixture(scope="module")
def ball(folder: Path) -> tuple[Path, cuv.SphereMap]:
    V, F = icosphere(3)
    result = cuv.sphere_map(V * [1.0, 1.5, 0.8], F)
    write_page(folder / "sphere.html", result, "An ellipsoid")
    return folder / "sphere.html", result


class Shown:
    """A page in a window of its own; nothing may be asked for, and nothing complained of."""

    def __init__(self, browser, path: Path, **how) -> None:
        self.context = browser.new_context(**{"viewport": {"width": 1000, "height": 700}, **how})
        self.page = self.context.new_page()
        self.told: list[str] = []
        self.asked: list[str] = []
        self.page.on("console", lambda message: self.told.append(message.text))
        self.page.on("pageerror", lambda error: self.told.append(str(error)))
        self.page.on("request", lambda request: self.asked.append(request.url))
        self.page.goto(path.as_uri())
        self.page.wait_for_selector("html[data-ready=yes]", timeout=60_000)
        self.ask = self.page.evaluate

    def __enter__(self) -> Shown:
        return self

    def __exit__(self, kind, *_) -> None:
        self.context.close()
        if kind is None:
            assert self.told == []
            assert [url for url in self.asked if not url.startswith("data:")] == self.asked[:1]

    def middle(self, canvas: str) -> np.ndarray:
        box = self.page.locator(f"#{canvas}").bounding_box()
        return np.array([box["x"] + box["width"] / 2, box["y"] + box["height"] / 2])

    def picture(self, canvas: str) -> np.ndarray:
        self.page.wait_for_timeout(150)
        image = pytest.importorskip("PIL.Image").open(io.BytesIO(self.page.locator(f"#{canvas}").screenshot()))
        return np.asarray(image.convert("RGB"), dtype=float)

    def drag(self, canvas: str, by: tuple[float, float]) -> None:
        x, y = self.middle(canvas)
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + by[0], y + by[1], steps=5)
        self.page.mouse.up()

    def positions(self) -> np.ndarray:
        return np.array(self.ask("Array.from(conformalUV.positions())")).reshape(-1, 3)

    def pixel(self, pane: str, point) -> list[float]:
        return self.ask(f"p => conformalUV.panes.{pane}.pixel(p)", list(map(float, point)))

    def hover(self, pane: str, pixel: list[float]) -> dict | None:
        return self.ask(f"p => (conformalUV.hoverAt('{pane}', p), conformalUV.hover())", pixel)


def changed(one: np.ndarray, other: np.ndarray) -> float:
    """Share of the pixels that differ."""
    return float((np.abs(one - other).max(axis=-1) > 20).mean())


def test_it_loads_with_the_map_that_was_written(browser, disk) -> None:
    path, result = disk
    with Shown(browser, path) as shown:
        assert np.abs(shown.positions()[:, :2] - result.uv).max() < 2 * SINGLE
        for canvas in ("surface", "map"):
            picture = shown.picture(canvas)
            assert len(np.unique(picture.reshape(-1, 3).round(-1), axis=0)) > 20
        assert shown.page.inner_text("#facts").split("\n")[:2] == ["vertices", "2,000"]


def test_a_drag_changes_both_pictures_and_keeps_the_boundary_on_the_circle(browser, disk) -> None:
    path, result = disk
    with Shown(browser, path) as shown:
        before = [shown.picture(canvas) for canvas in ("surface", "map")]
        held = shown.hover("map", shown.pixel("map", [0.0, 0.0, 0.0]))
        shown.drag("map", (90.0, -60.0))
        after = [shown.picture(canvas) for canvas in ("surface", "map")]
        assert min(map(changed, before, after)) > 0.05
        center = shown.ask("conformalUV.center()")
        assert 0.2 < np.hypot(*center[:2]) < 0.9
        moved = shown.positions()
        rim = np.linalg.norm(moved[result.boundary], axis=1)
        assert np.abs(rim - 1.0).max() < 40 * SINGLE  # the map enlarges there by up to (1 + |a|) / (1 - |a|)
        z = result.uv @ [1.0, 1.0j]
        expected = cuv.Moebius.to_zero(complex(*center[:2]))(z)
        assert np.abs(moved[:, :2] @ [1.0, 1.0j] - expected).max() < 40 * SINGLE
        # what was held in the middle has come along: it is where the pointer is now
        there = shown.hover("map", shown.pixel("map", disk_moved(held["image"], center)))
        assert np.allclose(there["surface"], held["surface"], atol=0.02)
        x, y = shown.pixel("map", disk_moved(held["image"], center))
        size = shown.page.locator("#map").bounding_box()
        assert abs(x - size["width"] / 2 - 90) < 3 and abs(y - size["height"] / 2 + 60) < 3
        shown.page.click("#reset")
        assert shown.ask("conformalUV.center()") == [0, 0, 0]
        assert changed(shown.picture("map"), before[1]) < 0.01


def disk_moved(point: list[float], center: list[float]) -> list[float]:
    w = complex(cuv.Moebius.to_zero(complex(*center[:2]))(complex(*point[:2])))
    return [w.real, w.imag, 0.0]


@pytest.mark.parametrize("center", [[0.0, 0.0, 0.0], [0.5, -0.3, 0.0]])
def test_the_graphics_card_computes_the_same_map_and_hovering_links_the_points(browser, disk, center) -> None:
    """At the place of a vertex in either picture the shader's interpolation gives its place in the other."""
    path, _ = disk
    with Shown(browser, path) as shown:
        shown.ask("c => conformalUV.setCenter(c)", center)
        moved = shown.positions()
        surface = np.array(shown.ask("Array.from(conformalUV.surface())")).reshape(-1, 3)
        inner = np.flatnonzero(np.linalg.norm(moved, axis=1) < 0.8)[::150]
        assert len(inner) > 3
        for vertex in inner:
            there = shown.hover("map", shown.pixel("map", moved[vertex]))
            assert np.linalg.norm(np.subtract(there["surface"], surface[vertex])) < 0.02
            back = shown.hover("surface", shown.pixel("surface", surface[vertex]))
            assert np.linalg.norm(disk_moved(back["image"], center) - moved[vertex]) < 0.03


def test_a_mouse_over_one_picture_marks_the_point_in_the_other(browser, disk) -> None:
    path, _ = disk
    with Shown(browser, path) as shown:
        assert not shown.page.is_visible("#surface-mark")
        empty = shown.page.inner_text("#point")
        shown.page.mouse.move(*shown.middle("map"))
        assert shown.page.is_visible("#surface-mark") and shown.page.is_visible("#map-mark")
        assert "angle error" in shown.page.inner_text("#point")
        shown.page.mouse.move(*(shown.middle("map") - [0, 320]))
        assert not shown.page.is_visible("#surface-mark") and shown.page.inner_text("#point") == empty


def test_errors_are_colours_with_a_legend(browser, disk) -> None:
    path, result = disk
    with Shown(browser, path) as shown:
        checker = shown.picture("map")
        assert not shown.page.is_visible("#legend")
        for mode, low in (("angle", "0°"), ("area", "×")):
            shown.page.check(f"input[value={mode}]")
            assert changed(shown.picture("map"), checker) > 0.3
            assert shown.page.inner_text("#low").startswith(low) and not shown.page.is_visible("#squares")
        found = shown.hover("map", shown.pixel("map", [0.1, 0.1, 0.0]))
        mapped = mapped_mesh(result)
        near = np.argmin(np.linalg.norm(result.uv - 0.1, axis=1))
        errors = mapped.at_vertices(result.distortion.angle_error.mean(axis=1))
        around = errors[mapped.F[(mapped.F == near).any(axis=1)]]
        assert around.min() - 1e-3 <= found["angle"] <= around.max() + 1e-3


def test_areas_change_with_the_moebius_map(browser, disk) -> None:
    """By |M'|^2, M' = (1 - |a|^2) / (1 - conj(a) z)^2; at z = 0 it is (1 - |a|^2)^2."""
    path, _ = disk
    with Shown(browser, path) as shown:
        before = shown.hover("map", shown.pixel("map", [0.0, 0.0, 0.0]))
        shown.ask("conformalUV.setCenter([0.6, 0, 0])")
        after = shown.hover("map", shown.pixel("map", [-0.6, 0.0, 0.0]))
        assert np.linalg.norm(after["image"]) < 0.01
        assert after["area"] - before["area"] == pytest.approx(2.0 * np.log2(0.64), abs=0.1)


def test_keys_do_what_a_drag_does(browser, disk) -> None:
    path, _ = disk
    with Shown(browser, path) as shown:
        shown.page.focus("#map")
        shown.page.keyboard.press("ArrowRight")
        assert shown.ask("conformalUV.center()")[0] == pytest.approx(-0.05, abs=1e-6)
        shown.page.keyboard.press("0")
        assert shown.ask("conformalUV.center()") == [0, 0, 0]
        shown.page.focus("#surface")
        before = shown.picture("surface")
        for _ in range(4):
            shown.page.keyboard.press("ArrowRight")
        assert changed(before, shown.picture("surface")) > 0.02
        shown.page.keyboard.press("Enter")
        assert shown.ask("conformalUV.hover().pane") == "surface"
        zoom = shown.ask("conformalUV.panes.surface.camera.zoom")
        shown.page.keyboard.press("+")
        assert shown.ask("conformalUV.panes.surface.camera.zoom") > zoom


def test_fingers_drag_turn_and_enlarge(browser, disk) -> None:
    path, _ = disk
    with Shown(browser, path, has_touch=True, is_mobile=True, viewport={"width": 390, "height": 844}) as shown:
        session = shown.context.new_cdp_session(shown.page)

        def touch(kind: str, *points: tuple[float, float]) -> None:
            fingers = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(points)]
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": fingers})

        x, y = shown.middle("map")
        touch("touchStart", (x, y))
        for step in range(1, 6):
            touch("touchMove", (x + 8 * step, y))
        touch("touchEnd")
        assert shown.ask("conformalUV.center()")[0] < -0.1
        x, y = shown.middle("surface")
        touch("touchStart", (x - 20, y))
        touch("touchStart", (x - 20, y), (x + 20, y))
        for step in range(1, 6):
            touch("touchMove", (x - 20 - 8 * step, y), (x + 20 + 8 * step, y))
        touch("touchEnd")
        assert shown.ask("conformalUV.panes.surface.camera.zoom") == pytest.approx(3.0, rel=0.1)


def test_it_is_readable_on_a_phone_in_the_dark_and_has_names_for_all_it_shows(browser, disk) -> None:
    path, _ = disk
    with Shown(browser, path, viewport={"width": 360, "height": 780}, color_scheme="dark") as shown:
        assert shown.ask("document.documentElement.scrollWidth") <= 360
        boxes = [shown.page.locator(f"#{canvas}").bounding_box() for canvas in ("surface", "map")]
        assert all(box["width"] > 320 and box["height"] > 200 for box in boxes)
        assert boxes[1]["y"] + boxes[1]["height"] < 780 + 60  # both can be seen at once, nearly
        paper, ink = (shown.ask(f"getComputedStyle(document.body).{name}") for name in ("backgroundColor", "color"))
        light = [np.mean([int(x) for x in text[4:-1].split(",")]) for text in (paper, ink)]
        assert light[0] < 40 and light[1] > 200
        assert shown.ask(
            "[...document.querySelectorAll('canvas')].every(c => c.getAttribute('aria-label').length > 20)"
        )
        assert shown.ask("[...document.querySelectorAll('input')].every(i => i.labels.length === 1)")
        assert shown.ask("document.documentElement.lang") == "en"


def test_the_spheres_drag_keeps_it_a_sphere_and_brings_along_what_is_held(browser, ball) -> None:
    path, result = ball
    with Shown(browser, path) as shown:
        assert np.abs(shown.positions() - result.xyz).max() < 4 * SINGLE
        before = [shown.picture(canvas) for canvas in ("surface", "map")]
        size = shown.page.locator("#map").bounding_box()
        held = shown.hover("map", [size["width"] / 2, size["height"] / 2])
        shown.drag("map", (70.0, -50.0))
        after = [shown.picture(canvas) for canvas in ("surface", "map")]
        assert min(map(changed, before, after)) > 0.05
        moved, center = shown.positions(), np.array(shown.ask("conformalUV.center()"))
        assert 0.1 < np.linalg.norm(center) < 0.97
        assert np.abs(np.linalg.norm(moved, axis=1) - 1.0).max() < 40 * SINGLE
        # A Moebius map keeps cross ratios of distances.
        some = [0, 100, 200, 300]
        assert cross_ratio(*moved[some]) == pytest.approx(cross_ratio(*result.xyz[some]), rel=1e-4)
        x, y = shown.pixel("map", sphere_moved(np.array(held["image"]), center))
        assert abs(x - size["width"] / 2 - 70) < 3 and abs(y - size["height"] / 2 + 50) < 3


def test_the_graphics_card_moves_the_sphere_the_same_way(browser, ball) -> None:
    """Under a vertex on the near side of the moved sphere, the surface is where that vertex is."""
    path, _ = ball
    with Shown(browser, path) as shown:
        shown.ask("conformalUV.setCenter([0.3, -0.25, 0.2])")
        moved = shown.positions()
        surface = np.array(shown.ask("Array.from(conformalUV.surface())")).reshape(-1, 3)
        near = np.flatnonzero(moved[:, 1] < -0.7)[::20]  # it is seen from -y
        assert len(near) > 3
        for vertex in near:
            there = shown.hover("map", shown.pixel("map", moved[vertex]))
            assert np.linalg.norm(np.subtract(there["surface"], surface[vertex])) < 0.03


def test_a_sphere_can_be_turned_instead(browser, ball) -> None:
    path, _ = ball
    with Shown(browser, path) as shown:
        before = shown.picture("map")
        shown.page.check("#turning")
        shown.drag("map", (70.0, -50.0))
        assert shown.ask("conformalUV.center()") == [0, 0, 0]
        assert changed(before, shown.picture("map")) > 0.05


def cross_ratio(a, b, c, d) -> float:
    far = np.linalg.norm
    return float(far(a - c) * far(b - d) / (far(a - d) * far(b - c)))


def sphere_moved(x: np.ndarray, center: np.ndarray) -> np.ndarray:
    """Through -x and the center, to the sphere's other side."""
    line = center + x
    return -x + 2.0 * line * (x @ line) / (line @ line)


@pytest.mark.parametrize("shape", ["free", "rectangle"])
def test_other_maps_are_shifted_by_a_drag(browser, folder: Path, shape: str) -> None:
    V, F = mask(500)
    result = cuv.free_map(V, F) if shape == "free" else cuv.rectangle_map(V, F)
    write_page(folder / f"{shape}.html", result, shape)
    with Shown(browser, folder / f"{shape}.html") as shown:
        before, positions = shown.picture("map"), shown.positions()
        shown.drag("map", (60.0, 0.0))
        assert changed(before, shown.picture("map")) > 0.05
        assert np.array_equal(shown.positions(), positions)
        assert not shown.page.is_visible("#turning")


def test_what_the_browser_lacks_is_told(browser, disk) -> None:
    path, _ = disk
    context = browser.new_context()
    page = context.new_page()
    page.add_init_script("delete window.DecompressionStream")
    page.goto(path.as_uri())
    page.wait_for_selector("#problem", state="visible")
    assert "DecompressionStream" in page.inner_text("#problem")
    context.close()
