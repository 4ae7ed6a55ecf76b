// Draws a mesh with WebGL: its surface, lit from the camera, and lines along the edges with defects.

const surface_vertex = `
attribute vec3 position;
attribute vec3 normal;
uniform mat4 matrix;
varying vec3 at, out_normal;
void main() {
  at = position;
  out_normal = normal;
  gl_Position = matrix * vec4(position, 1.0);
}`;
const surface_fragment = `
precision highp float;
uniform vec3 eye, outside, inside;
varying vec3 at, out_normal;
void main() {
  vec3 n = normalize(gl_FrontFacing ? out_normal : -out_normal);
  vec3 to_eye = normalize(eye - at);
  float light = 0.32 + 0.5 * max(dot(n, to_eye), 0.0) + 0.18 * max(dot(n, normalize(vec3(0.4, 0.9, 0.3))), 0.0);
  gl_FragColor = vec4((gl_FrontFacing ? outside : inside) * light, 1.0);
}`;
// A line is drawn as two triangles. Each vertex has both ends of the line as attributes, and is moved sideways by half
// the line's width.
const line_vertex = `
attribute vec3 from, to;
attribute vec2 corner;
uniform mat4 matrix;
uniform vec2 half_width;
void main() {
  vec4 a = matrix * vec4(from, 1.0), b = matrix * vec4(to, 1.0);
  vec2 along = normalize((b.xy / b.w - a.xy / a.w) / half_width + vec2(1e-6, 0.0));
  gl_Position = corner.x < 0.5 ? a : b;
  vec2 aside = vec2(-along.y, along.x) * corner.y + along * (corner.x - 0.5);
  gl_Position.xy += aside * half_width * gl_Position.w;
  gl_Position.z -= 0.0006 * gl_Position.w;
}`;
const line_fragment = `
precision mediump float;
uniform vec4 colour;
void main() { gl_FragColor = colour; }`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  return gl.getProgramParameter(made, gl.LINK_STATUS) ? made : null;
}

function buffer(gl, values) {
  const made = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, made);
  gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
  return made;
}

/**
 * Gives each triangle its own copies of its vertices. Flat shading needs them: a vertex then has the normal of its
 * triangle.
 */
function unrolled({ positions, normals, indices }, faceNormal) {
  const corners = new Float32Array(3 * indices.length),
    smooth = new Float32Array(3 * indices.length);
  const flat = new Float32Array(3 * indices.length);
  for (let i = 0; i < indices.length; ++i) {
    corners.set(positions.subarray(3 * indices[i], 3 * indices[i] + 3), 3 * i);
    smooth.set(normals.subarray(3 * indices[i], 3 * indices[i] + 3), 3 * i);
    if (i % 3 === 0) {
      const n = faceNormal(positions, indices, i);
      for (let corner = 0; corner < 3; ++corner) flat.set(n, 3 * (i + corner));
    }
  }
  return { corners, smooth, flat };
}

function lineBuffers(gl, segments) {
  const from = [],
    to = [],
    corner = [];
  for (const s of segments) {
    for (const c of [
      [0, -1],
      [0, 1],
      [1, 1],
      [0, -1],
      [1, 1],
      [1, -1],
    ]) {
      from.push(s[0], s[1], s[2]);
      to.push(s[3], s[4], s[5]);
      corner.push(c[0], c[1]);
    }
  }
  return {
    from: buffer(gl, new Float32Array(from)),
    to: buffer(gl, new Float32Array(to)),
    corner: buffer(gl, new Float32Array(corner)),
    count: corner.length / 2,
  };
}

/**
 * Makes a renderer; null if WebGL is not available. edges: {kind: [[x, y, z, x, y, z]]}. lost(): called when the WebGL
 * context is lost, so that the caller can draw by other means.
 */
export function makeWebglRenderer(canvas, mesh, edges, faceNormal, lost) {
  const gl = canvas.getContext('webgl', { antialias: true, preserveDrawingBuffer: true });
  const surface = gl && program(gl, surface_vertex, surface_fragment),
    lines = gl && program(gl, line_vertex, line_fragment);
  if (!surface || !lines) return null;
  canvas.addEventListener('webglcontextlost', lost);
  const { corners, smooth, flat } = unrolled(mesh, faceNormal);
  const buffers = { corners: buffer(gl, corners), smooth: buffer(gl, smooth), flat: buffer(gl, flat) };
  const made_lines = Object.entries(edges)
    .filter(([, all]) => all.length > 0)
    .map(([kind, all]) => ({ kind, ...lineBuffers(gl, all) }));
  const count = corners.length / 3;

  const feed = (of, name, values, size) => {
    const place = gl.getAttribLocation(of, name);
    gl.bindBuffer(gl.ARRAY_BUFFER, values);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
  };
  const uniform = (of, name) => gl.getUniformLocation(of, name);

  function drawLines(matrix, colours, ratio, opacity) {
    gl.useProgram(lines);
    gl.uniformMatrix4fv(uniform(lines, 'matrix'), false, matrix);
    gl.uniform2f(uniform(lines, 'half_width'), (3.4 * ratio) / canvas.width, (3.4 * ratio) / canvas.height);
    for (const line of made_lines) {
      feed(lines, 'from', line.from, 3);
      feed(lines, 'to', line.to, 3);
      feed(lines, 'corner', line.corner, 2);
      gl.uniform4f(uniform(lines, 'colour'), ...colours.marks[line.kind], opacity);
      gl.drawArrays(gl.TRIANGLES, 0, line.count);
    }
  }

  return {
    name: 'WebGL',
    /**
     * Draws the mesh. colours: outside, inside and ground as [r, g, b], each 0 to 1; marks: a colour for each kind of
     * edge.
     */
    draw({ matrix, eye, colours, flat: is_flat, ratio }) {
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(...colours.ground, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST);
      gl.disable(gl.BLEND);
      gl.useProgram(surface);
      gl.uniformMatrix4fv(uniform(surface, 'matrix'), false, matrix);
      gl.uniform3f(uniform(surface, 'eye'), ...eye);
      gl.uniform3f(uniform(surface, 'outside'), ...colours.outside);
      gl.uniform3f(uniform(surface, 'inside'), ...colours.inside);
      feed(surface, 'position', buffers.corners, 3);
      feed(surface, 'normal', is_flat ? buffers.flat : buffers.smooth, 3);
      gl.drawArrays(gl.TRIANGLES, 0, count);
      drawLines(matrix, colours, ratio, 1);
      // Draw the lines once more without depth test, but faintly, so that they are visible behind surfaces.
      gl.disable(gl.DEPTH_TEST);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      drawLines(matrix, colours, ratio, 0.28);
    },
    dispose() {
      canvas.removeEventListener('webglcontextlost', lost);
      gl.getExtension('WEBGL_lose_context')?.loseContext();
    },
  };
}
