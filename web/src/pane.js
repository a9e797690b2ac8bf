// One of the two pictures: its canvas, camera and mesh; what is under a pixel of it.
import {
  FloatType, HalfFloatType, Matrix3, Matrix4, Mesh, NearestFilter, OrthographicCamera, Quaternion, Scene, Vector3,
  WebGLRenderer, WebGLRenderTarget, DataUtils,
} from "three";
import { materials } from "./shaders.js";

const ROOM = 1.06; // of the picture's half size, the mesh having 1
const ZOOM = [0.5, 200];

export class Pane {
  /** `size` is half the width and height of what is shown. */
  constructor(canvas, { geometry, faceted }, shape, is_map, uniforms, size) {
    this.canvas = canvas;
    this.shape = shape;
    this.is_map = is_map;
    this.solid = !is_map || shape === "sphere"; // can be turned
    this.size = size;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, powerPreference: "high-performance" });
    this.renderer.outputColorSpace = "srgb-linear"; // colours are written as they are
    this.renderer.setClearColor(0, 0);
    this.camera = new OrthographicCamera(-1, 1, 1, -1, -3, 3);
    const { shown, picked } = materials(shape, is_map, faceted, uniforms);
    Object.assign(this, { shown, picked });
    this.mesh = new Mesh(geometry, shown);
    this.mesh.frustumCulled = false;
    this.scene = new Scene().add(this.mesh);
    this.first = new Quaternion();
    const float = this.renderer.extensions.has("EXT_color_buffer_float");
    this.float = float;
    this.target = new WebGLRenderTarget(1, 1, {
      count: 2, type: float ? FloatType : HalfFloatType, minFilter: NearestFilter, magFilter: NearestFilter,
    });
    this.dirty = true;
  }

  /** Take the canvas's size in the page. */
  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height, false);
    const half = ROOM * Math.max(this.size[1], (this.size[0] * height) / width);
    const wide = (half * width) / height;
    Object.assign(this.camera, { left: -wide, right: wide, top: half, bottom: -half });
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }

  look(quaternion) {
    this.first.copy(quaternion);
    this.reset();
  }

  reset() {
    this.mesh.quaternion.copy(this.first);
    this.camera.position.set(0, 0, 0);
    this.zoom(1 / this.camera.zoom);
  }

  /** Turn about the picture's own axes, radians. */
  turn(right, down, roll = 0) {
    const by = new Quaternion();
    for (const [axis, angle] of [[[0, 1, 0], right], [[1, 0, 0], down], [[0, 0, 1], roll]]) {
      this.mesh.quaternion.premultiply(by.setFromAxisAngle(new Vector3(...axis), angle));
    }
    this.dirty = true;
  }

  /** Shift by fractions of the picture's height. */
  pan(x, y) {
    const height = (this.camera.top - this.camera.bottom) / this.camera.zoom;
    this.camera.position.x -= x * height;
    this.camera.position.y -= y * height;
    this.dirty = true;
  }

  zoom(factor) {
    this.camera.zoom = Math.min(Math.max(this.camera.zoom * factor, ZOOM[0]), ZOOM[1]);
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }

  /** How the mesh is turned, for vectors. */
  rotation() {
    return new Matrix3().setFromMatrix4(new Matrix4().makeRotationFromQuaternion(this.mesh.quaternion));
  }

  render() {
    this.renderer.render(this.scene, this.camera);
    this.dirty = false;
  }

  /** The pixel of a point of the mesh, from the canvas's upper left. */
  pixel(point) {
    const p = new Vector3(...point).applyQuaternion(this.mesh.quaternion);
    this.camera.updateMatrixWorld();
    p.project(this.camera);
    return [((1 + p.x) / 2) * this.canvas.clientWidth, ((1 - p.y) / 2) * this.canvas.clientHeight];
  }

  /** The point of the picture's plane under a pixel; on the sphere, the one of it, or the nearest of its outline. */
  under([x, y]) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.camera.updateMatrixWorld();
    const p = new Vector3((2 * x) / width - 1, 1 - (2 * y) / height, 0).unproject(this.camera);
    p.z = 0;
    if (!this.solid) return [p.x, p.y, 0];
    const length = Math.hypot(p.x, p.y);
    if (length < 1) p.z = Math.sqrt(1 - length * length);
    else p.divideScalar(length);
    return p.applyQuaternion(this.mesh.quaternion.clone().invert()).toArray();
  }

  /** { other, angle, area } of what is under a pixel, or null: its place in the other picture, and its errors. */
  pick([x, y]) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!(x >= 0 && y >= 0 && x < width && y < height)) return null;
    this.camera.setViewOffset(width, height, Math.floor(x), Math.floor(y), 1, 1);
    this.mesh.material = this.picked;
    this.renderer.setRenderTarget(this.target);
    this.renderer.clear();
    this.renderer.render(this.scene, this.camera);
    const other = this.pixel_values(0);
    const errors = this.pixel_values(1);
    this.renderer.setRenderTarget(null);
    this.mesh.material = this.shown;
    this.camera.clearViewOffset();
    if (other[3] === 0) return null;
    return { other: other.slice(0, 3), angle: errors[0], area: errors[1] };
  }

  pixel_values(texture) {
    const raw = this.float ? new Float32Array(4) : new Uint16Array(4);
    this.renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, raw, undefined, texture);
    return Array.from(raw, (value) => (this.float ? value : DataUtils.fromHalfFloat(value)));
  }
}
