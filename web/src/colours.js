// Colour maps, once as CSS for the legend and once as GLSL.

// viridis (S. van der Walt, N. Smith; CC0) and ColorBrewer's RdBu (C. Brewer; Apache 2.0), at equal steps
const ANGLE = ["440154", "472d7b", "3b528b", "2c728e", "21918c", "28ae80", "5ec962", "addc30", "fde725"];
const AREA = ["2166ac", "4393c3", "92c5de", "d1e5f0", "f7f7f7", "fddbc7", "f4a582", "d6604d", "b2182b"];

export const gradient = (mode) =>
  `linear-gradient(to right, ${(mode === "area" ? AREA : ANGLE).map((c) => `#${c}`).join(", ")})`;

const vec3 = (hex) => `vec3(${[0, 2, 4].map((k) => (parseInt(hex.slice(k, k + 2), 16) / 255).toFixed(4)).join(", ")})`;

const table = (name, colours) => /* glsl */ `
  vec3 ${name}(float t) {
    vec3 stops[${colours.length}] = vec3[](${colours.map(vec3).join(", ")});
    float at = clamp(t, 0.0, 1.0) * ${(colours.length - 1).toFixed(1)};
    int k = min(int(at), ${colours.length - 2});
    return mix(stops[k], stops[k + 1], at - float(k));
  }
`;

export const COLOURS = table("angle_colour", ANGLE) + table("area_colour", AREA);
