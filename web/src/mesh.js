// The decoded mesh as one geometry: surface and map each in a box of size 2 around 0, normals of the surface.
import { BufferAttribute, BufferGeometry } from "three";

const FEW = 4000; // triangles up to which each is flat in the light

/** { geometry, faceted, flat, extent }: `extent` is half the width and height of the map. */
export function mesh_of(about, arrays) {
  const surface = in_box(arrays.surface, 3);
  const unit = about.shape === "disk" || about.shape === "sphere";
  const { points, extent } = unit
    ? { points: on_unit(arrays.image, about.shape), extent: [1, 1] }
    : in_box(arrays.image, 2);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(surface.points, 3));
  geometry.setAttribute("image", new BufferAttribute(points, 3));
  geometry.setAttribute("angle", new BufferAttribute(arrays.angle, 1));
  geometry.setAttribute("area", new BufferAttribute(arrays.area, 1));
  geometry.setIndex(new BufferAttribute(arrays.faces, 1));
  geometry.computeVertexNormals();
  return { geometry, faceted: about.triangles <= FEW, extent };
}

/** Rows of three, their box's middle at 0 and the farthest point of them (in the plane: its farthest side) at distance 1. */
function in_box(rows, columns) {
  const low = Array(columns).fill(Infinity);
  const high = Array(columns).fill(-Infinity);
  for (let i = 0; i < rows.length; i++) {
    const k = i % columns;
    if (rows[i] < low[k]) low[k] = rows[i];
    if (rows[i] > high[k]) high[k] = rows[i];
  }
  const half = low.map((x, k) => (high[k] - x) / 2);
  const points = new Float32Array((rows.length / columns) * 3);
  let farthest = 0;
  for (let i = 0, j = 0; i < rows.length; i += columns, j += 3) {
    let square = 0;
    for (let k = 0; k < columns; k++) {
      points[j + k] = rows[i + k] - low[k] - half[k];
      square += points[j + k] ** 2;
    }
    farthest = Math.max(farthest, square);
  }
  const radius = (columns === 3 ? Math.sqrt(farthest) : Math.max(...half)) || 1;
  for (let j = 0; j < points.length; j++) points[j] /= radius;
  return { points, extent: half.map((x) => x / radius) };
}

/** Rows of three; what the quantisation has moved off the circle or sphere is put back. */
function on_unit(rows, shape) {
  const columns = shape === "disk" ? 2 : 3;
  const points = new Float32Array((rows.length / columns) * 3);
  for (let i = 0, j = 0; i < rows.length; i += columns, j += 3) {
    const z = columns === 3 ? rows[i + 2] : 0;
    const length = Math.hypot(rows[i], rows[i + 1], z);
    const scale = columns === 3 || Math.abs(length - 1) < 2e-7 ? 1 / length : 1;
    points[j] = rows[i] * scale;
    points[j + 1] = rows[i + 1] * scale;
    points[j + 2] = z * scale;
  }
  return points;
}
