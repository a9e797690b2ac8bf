// node --test: the Moebius maps by themselves.
import assert from "node:assert/strict";
import { test } from "node:test";
import { decoded } from "./src/decode.js";
import { grabbed, moved, moved_back } from "./src/moebius.js";

const near = (p, q, tolerance = 1e-12) => p.forEach((x, k) => assert.ok(Math.abs(x - q[k]) < tolerance, `${p} ${q}`));

const unit = (p) => p.map((x) => x / Math.hypot(...p));
const points = {
  disk: [[0.1, 0.2, 0], [-0.7, 0.5, 0], [0.6, -0.3, 0]],
  sphere: [[1, 2, 3], [-2, 1, 0.5], [0.3, -1, -2]].map(unit),
};
const centers = { disk: [0.4, -0.3, 0], sphere: [0.2, 0.5, -0.4] };

for (const shape of ["disk", "sphere"]) {
  test(`${shape}: the map back undoes the map`, () => {
    for (const p of points[shape]) near(moved_back(shape, moved(shape, p, centers[shape]), centers[shape]), p);
  });

  test(`${shape}: the rim or the sphere stays, and cross ratios' moduli do`, () => {
    const circle = [0.3, 1.1, 2.9, 4.4].map((t) => [Math.cos(t), Math.sin(t), 0]);
    const images = circle.map((p) => moved(shape, p, centers[shape]));
    images.forEach((p) => assert.ok(Math.abs(Math.hypot(...p) - 1) < 1e-12));
    const far = (p, q) => Math.hypot(...p.map((x, k) => x - q[k]));
    const ratio = ([a, b, c, d]) => (far(a, c) * far(b, d)) / (far(a, d) * far(b, c));
    assert.ok(Math.abs(ratio(images) / ratio(circle) - 1) < 1e-12);
  });

  test(`${shape}: what is dragged follows, from any center, and begins where it is`, () => {
    const [p, q] = points[shape];
    const start = moved(shape, p, centers[shape]);
    const center_at = grabbed(shape, start, centers[shape]);
    near(center_at(start), centers[shape]);
    near(moved(shape, p, center_at(q)), q);
  });
}

test("the disk's center goes to 0", () => near(moved("disk", centers.disk, centers.disk), [0, 0, 0]));

test("numbers come back from bytes", () => {
  const header = { name: "x", rows: 3, columns: 1, width: 2, low: [-1], step: 0.5 };
  // 1, 0, 65535: differences 1, -1, -1 (modulo 65536) as 2, 1, 1
  assert.deepEqual([...decoded([header], Uint8Array.of(2, 1, 1, 0, 0, 0)).x], [-0.5, -1, 32766.5]);
});
