// Draws a mesh on a 2D canvas, without WebGL, by sorting its triangles from far to near.

import { faceNormal } from './mesh_preview.js';
import { project } from './mesh_camera.js';

const css = (colour, light) => `rgb(${colour.map((x) => Math.round(255 * Math.min(x * light, 1))).join(' ')})`;
const shades = 24;

export function makePainter(canvas, mesh, edges) {
  const context = canvas.getContext('2d'),
    { positions, indices } = mesh;
  const triangles = indices.length / 3,
    depths = new Float32Array(triangles),
    order = new Uint32Array(triangles);
  const screen = new Float32Array(positions.length);
  const normals = new Float32Array(indices.length);
  for (let i = 0; i < indices.length; i += 3) {
    const n = faceNormal(positions, indices, i),
      length = Math.hypot(...n) || 1;
    normals.set(
      n.map((x) => x / length),
      i,
    );
  }

  /** The cosine between triangle t's normal and the direction to the eye; positive if the eye sees the outer side. */
  function facing(t, eye) {
    const a = 3 * indices[3 * t];
    const to = [eye[0] - positions[a], eye[1] - positions[a + 1], eye[2] - positions[a + 2]];
    return (
      (normals[3 * t] * to[0] + normals[3 * t + 1] * to[1] + normals[3 * t + 2] * to[2]) / (Math.hypot(...to) || 1)
    );
  }

  function paintLines(matrix, colours, ratio) {
    context.lineWidth = 3 * ratio;
    for (const [kind, segments] of Object.entries(edges)) {
      context.strokeStyle = css(colours.marks[kind], 1);
      context.beginPath();
      for (const s of segments) {
        const a = project(matrix, s.slice(0, 3), canvas.width, canvas.height),
          b = project(matrix, s.slice(3), canvas.width, canvas.height);
        if (a[2] <= 0 || b[2] <= 0) continue;
        context.moveTo(a[0], a[1]);
        context.lineTo(b[0], b[1]);
      }
      context.stroke();
    }
  }

  return {
    name: 'canvas',
    /** Draws the mesh. Takes the same options as the WebGL renderer, but the shading is always flat. */
    draw({ matrix, eye, colours, ratio }) {
      context.fillStyle = css(colours.ground, 1);
      context.fillRect(0, 0, canvas.width, canvas.height);
      for (let i = 0; i < positions.length; i += 3)
        screen.set(project(matrix, positions.subarray(i, i + 3), canvas.width, canvas.height), i);
      for (let t = 0; t < triangles; ++t) {
        order[t] = t;
        depths[t] = Math.min(...[0, 1, 2].map((corner) => screen[3 * indices[3 * t + corner] + 2]));
      }
      order.sort((a, b) => depths[b] - depths[a]);
      const tones = [colours.inside, colours.outside].map((colour) =>
        Array.from({ length: shades + 1 }, (_, i) => css(colour, 0.38 + (0.62 * i) / shades)),
      );
      context.lineWidth = 0.7 * ratio;
      for (const t of order) {
        if (depths[t] <= 0) continue;
        const [a, b, c] = [3 * indices[3 * t], 3 * indices[3 * t + 1], 3 * indices[3 * t + 2]];
        const towards = facing(t, eye);
        context.fillStyle = context.strokeStyle = tones[towards > 0 ? 1 : 0][Math.round(Math.abs(towards) * shades)];
        context.beginPath();
        context.moveTo(screen[a], screen[a + 1]);
        context.lineTo(screen[b], screen[b + 1]);
        context.lineTo(screen[c], screen[c + 1]);
        context.closePath();
        context.fill();
        context.stroke(); // covers the gaps that antialiasing leaves between adjacent triangles
      }
      paintLines(matrix, colours, ratio);
    },
    dispose() {},
  };
}
