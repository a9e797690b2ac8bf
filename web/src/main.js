// The page: a surface beside its map, linked point by point.
import { Matrix3, Matrix4, Quaternion, Vector3 } from "three";
import { colour_of, connect, fail, tell_facts, tell_point } from "./controls.js";
import { decoded, inflated } from "./decode.js";
import { listen } from "./gestures.js";
import { mesh_of } from "./mesh.js";
import { grabbed, moved, moved_back, within } from "./moebius.js";
import { Pane } from "./pane.js";

const HIDDEN = 0.03; // farther than this from what is seen at its pixel, a point is behind something

async function start() {
  const about = JSON.parse(document.getElementById("about").textContent);
  const text = document.getElementById("mesh");
  const mesh = mesh_of(about, decoded(about.arrays, await inflated(text.textContent)));
  text.remove(); // and its memory
  tell_facts(about);
  const { shape } = about;
  const uniforms = {
    center: { value: new Vector3() },
    turned: { value: new Matrix3() },
    mode: { value: 0 },
    squares: { value: 16 },
    angle_shown: { value: about.angle.shown },
    area_shown: { value: about.area.shown },
    light: { value: new Vector3() },
    dark: { value: new Vector3() },
  };
  const canvas = (id) => document.getElementById(id);
  const panes = {
    surface: new Pane(canvas("surface"), mesh, shape, false, uniforms, [1, 1]),
    map: new Pane(canvas("map"), mesh, shape, true, uniforms, mesh.extent),
  };
  const marks = { surface: canvas("surface-mark"), map: canvas("map-mark") };
  const all = Object.values(panes);
  const live = shape === "disk" || shape === "sphere"; // has a Moebius center
  let turning_map = false;
  let hover = null; // { pane, image, surface, angle, area }, image before the Moebius map

  const [right, up, front] = about.view.map((row) => new Vector3(...row));
  const first = new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(right, up, front).transpose());
  panes.surface.look(first);
  if (shape === "sphere") panes.map.look(new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), -Math.PI / 2));

  const center = () => uniforms.center.value.toArray();
  function set_center(value) {
    uniforms.center.value.set(...(live ? within(shape, value) : [0, 0, 0]));
    all.forEach((pane) => (pane.dirty = true));
  }

  function hover_at(name, pixel) {
    const found = pixel && panes[name].pick(pixel);
    hover = null;
    if (found) {
      const { other, angle, area } = found;
      const here = name === "map" ? plane_point(pixel) : null;
      hover =
        name === "map"
          ? { pane: name, image: moved_back(shape, here, center()), surface: other, angle, area }
          : { pane: name, image: moved_back(shape, other, center()), surface: surface_at(pixel, other), angle, area };
    }
    tell_point(hover);
    place_marks();
  }
  const plane_point = (pixel) => panes.map.under(pixel);

  /** The point of the surface under a pixel of it: picked again in the map, or straight from there where it is hidden. */
  function surface_at(pixel, image) {
    const back = panes.map.pick(panes.map.pixel(image));
    if (!back) return null;
    const there = panes.surface.pixel(back.other);
    return Math.hypot(there[0] - pixel[0], there[1] - pixel[1]) < 0.05 * panes.surface.canvas.clientHeight
      ? back.other
      : null;
  }

  function place_marks(pixel) {
    for (const name of ["surface", "map"]) {
      const mark = marks[name];
      const point = hover && (name === "map" ? moved(shape, hover.image, center()) : hover.surface);
      mark.hidden = !point;
      if (!point) continue;
      const [x, y] = panes[name].pixel(point);
      mark.style.transform = `translate(${x}px, ${y}px)`;
      mark.classList.toggle("behind", name !== hover.pane && panes[name].solid && is_behind(name, point));
    }
  }

  function is_behind(name, point) {
    const seen = panes[name].pick(panes[name].pixel(point));
    if (!seen) return true;
    const expected = name === "map" ? hover.surface : moved(shape, hover.image, center());
    return !expected || Math.hypot(...expected.map((x, k) => x - seen.other[k])) > HIDDEN;
  }

  for (const [name, pane] of Object.entries(panes)) {
    let held = null;
    const moves = (turning) => name === "map" && live && !turning && !(pane.solid && turning_map);
    listen(pane.canvas, {
      hover: (pixel) => hover_at(name, pixel),
      begin(pixel, turning) {
        held = null;
        if (moves(turning) && inside(pane, pixel)) held = grabbed(shape, pane.under(pixel), center());
        hover_at(name, pixel);
      },
      drag(pixel, [dx, dy], turning) {
        if (held) set_center(held(kept_inside(pane.under(pixel))));
        else if (moves(turning)) return;
        else if (pane.solid) pane.turn(4 * dx, -4 * dy);
        else pane.pan(dx, dy);
      },
      end: () => (held = null),
      zoom: (factor) => pane.zoom(factor),
      arrow([x, y], turning) {
        if (moves(turning)) set_center(pushed(pane, x, y));
        else if (pane.solid) pane.turn(2 * x, -2 * y);
        else pane.pan(x, y);
      },
      reset,
      middle: () => hover_at(name, [pane.canvas.clientWidth / 2, pane.canvas.clientHeight / 2]),
    });
  }

  const inside = (pane, pixel) => shape !== "disk" || Math.hypot(...pane.under(pixel)) < 1;
  const kept_inside = (q) => {
    const length = Math.hypot(...q);
    return shape === "disk" && length > 0.98 ? q.map((x) => (0.98 * x) / length) : q;
  };

  /** The center after a push of the picture to the right and up. */
  function pushed(pane, x, y) {
    if (shape === "disk") return grabbed(shape, [0, 0, 0], center())([x, y, 0]);
    const by = new Vector3(x, y, 0).applyQuaternion(pane.mesh.quaternion.clone().invert());
    return center().map((value, k) => value + by.toArray()[k]);
  }

  function reset() {
    set_center([0, 0, 0]);
    all.forEach((pane) => pane.reset());
  }

  connect(about, {
    mode: (mode) => changed(() => (uniforms.mode.value = mode)),
    squares: (count) => changed(() => (uniforms.squares.value = count)),
    reset,
    turning: (on) => (turning_map = on),
  });
  function changed(change) {
    change();
    all.forEach((pane) => (pane.dirty = true));
  }

  const scheme = matchMedia("(prefers-color-scheme: dark)");
  const take_colours = () =>
    changed(() => {
      uniforms.light.value.set(...colour_of("--checker-light"));
      uniforms.dark.value.set(...colour_of("--checker-dark"));
    });
  scheme.addEventListener("change", take_colours);
  take_colours();

  const sizes = new ResizeObserver(() => all.forEach((pane) => pane.resize()));
  all.forEach((pane) => sizes.observe(pane.canvas));
  all.forEach((pane) => pane.resize());

  function frame() {
    if (all.some((pane) => pane.dirty)) {
      uniforms.turned.value.copy(panes.surface.rotation());
      all.forEach((pane) => pane.render());
      place_marks();
    }
    requestAnimationFrame(frame);
  }
  frame();

  const points = mesh.geometry.getAttribute("image").array;
  window.conformalUV = {
    about,
    panes,
    /** Positions of all vertices in the map as it is shown, n rows of three: what the vertex shader computes. */
    positions() {
      const out = new Float64Array(points.length);
      for (let i = 0; i < points.length; i += 3) {
        out.set(moved(shape, [points[i], points[i + 1], points[i + 2]], center()), i);
      }
      return out;
    },
    surface: () => mesh.geometry.getAttribute("position").array,
    center,
    setCenter: set_center,
    hover: () => hover,
    hoverAt: hover_at,
    render: () => all.forEach((pane) => pane.render()),
  };
  document.documentElement.dataset.ready = "yes";
}

start().catch((error) => {
  console.error(error);
  fail(
    typeof DecompressionStream === "undefined"
      ? "This browser is too old for the page: it has no DecompressionStream."
      : `The page could not be shown (${error.message}). It needs WebGL 2.`,
  );
});
