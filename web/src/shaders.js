// One vertex shader for both pictures: the surface where it is, or its map after the Moebius map.
import { GLSL3, DoubleSide, NoBlending, ShaderMaterial } from "three";
import { COLOURS } from "./colours.js";
import { MOEBIUS } from "./moebius.js";

export const MODES = ["checker", "angle", "area"];

const VERTEX = /* glsl */ `
  in vec3 image;
  in float angle, area;
  uniform vec3 center;
  uniform mat3 turned; // of the surface as it is shown, for its light in the map
  out vec3 on_surface, in_map, facing;
  out float angle_there, area_there;
  ${MOEBIUS}
  void main() {
    on_surface = position;
    in_map = moebius(image, center);
    angle_there = angle;
    area_there = area + enlarged(image, center);
    facing = turned * normal;
    #ifdef MAP
      vec3 place = in_map;
    #else
      vec3 place = on_surface;
    #endif
    gl_Position = projectionMatrix * modelViewMatrix * vec4(place, 1.0);
  }
`;

const INTERFACE = /* glsl */ `
  precision highp float;
  in vec3 on_surface, in_map, facing;
  in float angle_there, area_there;
`;

const SHOWN = /* glsl */ `
  ${INTERFACE}
  uniform int mode;
  uniform float squares, angle_shown, area_shown;
  uniform vec3 light, dark;
  out vec4 colour;
  ${COLOURS}

  // I. Quilez's checker, each pixel the mean over its own box
  float checker(vec2 p, vec2 w) {
    vec2 box = max(w, 1e-4);
    vec2 i = 2.0 * (abs(fract((p - 0.5 * box) * 0.5) - 0.5) - abs(fract((p + 0.5 * box) * 0.5) - 0.5)) / box;
    return 0.5 - 0.5 * i.x * i.y;
  }

  float pattern() {
    #ifdef SPHERE // the cube's sides, their angles equally divided
      vec3 d = normalize(in_map), size = abs(d), w = fwidth(d);
      float longest = max(size.x, max(size.y, size.z)), across = max(w.x, max(w.y, w.z));
      vec2 flat_on = size.x == longest ? d.yz / d.x : size.y == longest ? d.zx / d.y : d.xy / d.z;
      return checker(atan(flat_on) * 1.27323954 * squares * 0.5, vec2(across * 1.27323954 * squares * 0.5));
    #else
      vec2 p = in_map.xy * squares * 0.5;
      return checker(p, fwidth(p));
    #endif
  }

  void main() {
    vec3 base = mix(dark, light, pattern());
    if (mode == 1) base = angle_colour(angle_there / angle_shown);
    if (mode == 2) base = area_colour(0.5 + 0.5 * area_there / area_shown);
    #ifdef FACETED
      vec3 towards = normalize(cross(dFdx(on_surface), dFdy(on_surface)));
      towards *= dot(towards, facing) < 0.0 ? -1.0 : 1.0;
    #else
      vec3 towards = normalize(facing);
    #endif
    #ifndef MAP
      if (towards.z < 0.0) towards = -towards; // the back of an open surface
    #endif
    float lit = 0.5 + 0.5 * dot(towards, normalize(vec3(-0.35, 0.45, 0.82)));
    colour = vec4(base * (0.42 + 0.62 * pow(lit, 1.3)), 1.0);
  }
`;

// What is under one pixel: where it is in the other picture, and its errors.
const PICKED = /* glsl */ `
  ${INTERFACE}
  layout(location = 0) out vec4 other;
  layout(location = 1) out vec4 errors;
  void main() {
    #ifdef MAP
      other = vec4(on_surface, 1.0);
    #else
      other = vec4(in_map, 1.0);
    #endif
    errors = vec4(angle_there, area_there, 0.0, 1.0);
  }
`;

/** The two materials of a picture, to be seen and to be picked from; `uniforms` are shared. */
export function materials(shape, is_map, faceted, uniforms) {
  const defines = {};
  if (shape === "disk") defines.DISK = "";
  if (shape === "sphere") defines.SPHERE = "";
  if (is_map) defines.MAP = "";
  const made = (fragmentShader, more = {}) =>
    new ShaderMaterial({
      glslVersion: GLSL3,
      side: DoubleSide,
      blending: NoBlending,
      vertexShader: VERTEX,
      fragmentShader,
      uniforms,
      defines: { ...defines, ...more },
    });
  return { shown: made(SHOWN, faceted ? { FACETED: "" } : {}), picked: made(PICKED) };
}
