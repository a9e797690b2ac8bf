// Moebius maps of the unit disk and of the unit sphere, once for the processor and once for the vertex shader.
//
// The disk: z -> (z - a) / (1 - conj(a) z), which sends a to 0. Points are [x, y, 0].
// The sphere: x -> (1 - |c|^2) (x + c) / |x + c|^2 + c; the images of x and the point -x lie on one line with c
// (A. Baden, K. Crane, M. Kazhdan, Moebius registration, 2018). `center` is a or c.

export const MOEBIUS = /* glsl */ `
  vec3 moebius(vec3 p, vec3 center) {
    #if defined(DISK)
      vec2 a = center.xy, z = p.xy - a;
      vec2 under = vec2(1.0 - dot(a, p.xy), a.y * p.x - a.x * p.y);
      return vec3(dot(z, under), z.y * under.x - z.x * under.y, 0.0) / dot(under, under);
    #elif defined(SPHERE)
      vec3 from = p + center;
      return (1.0 - dot(center, center)) / dot(from, from) * from + center;
    #else
      return p;
    #endif
  }

  // log2 of how much the map enlarges areas there
  float enlarged(vec3 p, vec3 center) {
    #if defined(DISK)
      vec2 a = center.xy, under = vec2(1.0 - dot(a, p.xy), a.y * p.x - a.x * p.y);
      return 2.0 * log2((1.0 - dot(a, a)) / dot(under, under));
    #elif defined(SPHERE)
      vec3 from = p + center;
      return 2.0 * log2((1.0 - dot(center, center)) / dot(from, from));
    #else
      return 0.0;
    #endif
  }
`;

const MOST = { disk: 0.99, sphere: 0.97 }; // |center|, beyond which single precision shows

export const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];

/** The image of a point of the disk or the sphere. */
export function moved(shape, p, center) {
  const [a, b, c] = center;
  if (shape === "disk") {
    const [x, y] = [p[0] - a, p[1] - b];
    const [u, v] = [1 - a * p[0] - b * p[1], b * p[0] - a * p[1]];
    const norm = u * u + v * v;
    return [(x * u + y * v) / norm, (y * u - x * v) / norm, 0];
  }
  if (shape === "sphere") {
    const from = [p[0] + a, p[1] + b, p[2] + c];
    const scale = (1 - dot(center, center)) / dot(from, from);
    return [scale * from[0] + a, scale * from[1] + b, scale * from[2] + c];
  }
  return [...p];
}

/** The point whose image is p. */
export const moved_back = (shape, p, center) => moved(shape, p, center.map((x) => -x));

/** What a drag holds that begins at the image p: the center that brings what is there to another place. */
export function grabbed(shape, p, center) {
  const origin = moved_back(shape, p, center);
  return shape === "disk" ? (q) => disk_center(origin, q) : sphere_center(origin, p, center);
}

/** The a whose map sends z to q: a - k conj(a) = z - q, k = q z. */
function disk_center([x, y], [u, v]) {
  const [kx, ky] = [u * x - v * y, u * y + v * x];
  const [rx, ry] = [x - u, y - v];
  const under = 1 - kx * kx - ky * ky;
  return within("disk", [(rx + kx * rx + ky * ry) / under, (ry + ky * rx - kx * ry) / under, 0]);
}

/** A c on the line from -x to q, as far along it as at the beginning. */
function sphere_center(x, p, center) {
  const chord = p.map((value, k) => value + x[k]);
  const length = dot(chord, chord);
  const share = length > 1e-12 ? dot(chord.map((_, k) => center[k] + x[k]), chord) / length : 0.5;
  return (q) => within("sphere", x.map((value, k) => share * (q[k] + value) - value));
}

/** The center, or the farthest allowed in its direction. */
export function within(shape, center) {
  const length = Math.hypot(...center);
  if (!Number.isFinite(length)) return [0, 0, 0];
  return length > MOST[shape] ? center.map((x) => (x * MOST[shape]) / length) : center;
}
