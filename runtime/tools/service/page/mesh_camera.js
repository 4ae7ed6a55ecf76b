// A camera that orbits around a target. Matrices are column-major, as in WebGL.

const field_of_view = 0.7; // vertical field of view in radians
const steepest = 1.5;

const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => a.map((x) => x / (Math.hypot(...a) || 1));

export class Camera {
  /** mesh: {centre, radius}, its bounding sphere. */
  constructor(mesh) {
    this.mesh = mesh;
    this.reset();
  }

  reset() {
    this.target = [...this.mesh.centre];
    this.yaw = 0.7;
    this.pitch = 0.45;
    this.distance = this.mesh.radius * 3.1;
  }

  turn(yaw, pitch) {
    this.yaw += yaw;
    this.pitch = Math.min(Math.max(this.pitch + pitch, -steepest), steepest);
  }

  zoom(factor) {
    this.distance = Math.min(Math.max(this.distance * factor, this.mesh.radius * 0.01), this.mesh.radius * 20);
  }

  /** A close view of a place from outside the mesh: {target, yaw, pitch, distance}. */
  closeTo(place) {
    const out = place.map((x, axis) => x - this.mesh.centre[axis]);
    const length = Math.hypot(...out);
    const seen = length > this.mesh.radius * 0.05;
    return {
      target: place,
      distance: this.mesh.radius * 1.1,
      yaw: seen ? Math.atan2(out[0], out[2]) : this.yaw,
      pitch: seen ? Math.min(Math.max(Math.asin(out[1] / length), -1.3), 1.3) : this.pitch,
    };
  }

  /**
   * Moves the camera to a view between the views `from` and `to`. Views: as closeTo() returns them. part: 0 (`from`) to
   * 1 (`to`).
   */
  between(from, to, part) {
    const mix = (a, b) => a + (b - a) * part;
    const turn = Math.atan2(Math.sin(to.yaw - from.yaw), Math.cos(to.yaw - from.yaw));
    this.target = from.target.map((x, axis) => mix(x, to.target[axis]));
    this.yaw = from.yaw + turn * part;
    this.pitch = mix(from.pitch, to.pitch);
    this.distance = mix(from.distance, to.distance);
  }

  get pose() {
    return { target: [...this.target], yaw: this.yaw, pitch: this.pitch, distance: this.distance };
  }

  get eye() {
    const flat = Math.cos(this.pitch);
    const back = [flat * Math.sin(this.yaw), Math.sin(this.pitch), flat * Math.cos(this.yaw)];
    return this.target.map((x, axis) => x + this.distance * back[axis]);
  }

  /** Matrix from mesh coordinates to clip space. aspect: the picture's width divided by its height. */
  matrix(aspect) {
    const eye = this.eye,
      back = unit(eye.map((x, axis) => x - this.target[axis]));
    const right = unit(cross([0, 1, 0], back)),
      up = cross(back, right);
    const far =
      this.distance + Math.hypot(...this.target.map((x, axis) => x - this.mesh.centre[axis])) + this.mesh.radius * 1.5;
    const near = Math.max(this.distance * 0.02, far * 1e-4);
    // If the picture is higher than wide, widen the field of view, so that the sides of the mesh stay visible.
    const f = (1 / Math.tan(field_of_view / 2)) * Math.min(1, aspect);
    const [sx, sy] = [f / aspect, f],
      sz = (far + near) / (near - far),
      tz = (2 * far * near) / (near - far);
    const [x, y, z] = [-dot(right, eye), -dot(up, eye), -dot(back, eye)];
    return new Float32Array([
      sx * right[0],
      sy * up[0],
      sz * back[0],
      -back[0],
      sx * right[1],
      sy * up[1],
      sz * back[1],
      -back[1],
      sx * right[2],
      sy * up[2],
      sz * back[2],
      -back[2],
      sx * x,
      sy * y,
      sz * z + tz,
      -z,
    ]);
  }
}

/**
 * Projects a place to the picture: [x, y, depth] with x and y in pixels; depth is negative behind the camera. m: matrix
 * from Camera.matrix().
 */
export function project(m, place, width, height) {
  const [x, y, z] = place,
    w = m[3] * x + m[7] * y + m[11] * z + m[15];
  return [
    (((m[0] * x + m[4] * y + m[8] * z + m[12]) / w) * 0.5 + 0.5) * width,
    (0.5 - ((m[1] * x + m[5] * y + m[9] * z + m[13]) / w) * 0.5) * height,
    w,
  ];
}
