// Parses a preview mesh from the bytes of /api/v1/reports/ID/preview.

const magic = 'SGMPREV1';

/**
 * Unit normals of the vertices, weighted by the areas of the adjacent triangles; 0 if all these areas are 0. Without
 * the scaling to unit length, dark specks would appear at the rim of thin triangles: the rasterizer extrapolates there,
 * and between normals of very different lengths the result has an arbitrary direction.
 */
function normalsOf(positions, indices) {
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < indices.length; i += 3) {
    const n = faceNormal(positions, indices, i);
    for (let corner = 0; corner < 3; ++corner)
      for (let axis = 0; axis < 3; ++axis) normals[3 * indices[i + corner] + axis] += n[axis];
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]);
    if (length > 0) for (let axis = 0; axis < 3; ++axis) normals[i + axis] /= length;
  }
  return normals;
}

/**
 * The normal of a triangle; its length is twice the triangle's area. i: index of the triangle's first entry in
 * `indices`.
 */
export function faceNormal(positions, indices, i) {
  const [a, b, c] = [3 * indices[i], 3 * indices[i + 1], 3 * indices[i + 2]];
  const ux = positions[b] - positions[a],
    uy = positions[b + 1] - positions[a + 1],
    uz = positions[b + 2] - positions[a + 2];
  const vx = positions[c] - positions[a],
    vy = positions[c + 1] - positions[a + 1],
    vz = positions[c + 2] - positions[a + 2];
  return [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
}

/**
 * Parses the bytes of a preview into {positions, indices, normals, centre, radius}. Positions are relative to the
 * preview's origin. Throws an error if the bytes are invalid.
 */
export function readPreview(buffer) {
  const view = new DataView(buffer);
  const head = buffer.byteLength < 16 ? '' : String.fromCharCode(...new Uint8Array(buffer, 0, 8));
  if (head !== magic) throw new Error('the preview is not one that this page can read');
  const points = view.getUint32(8, true),
    triangles = view.getUint32(12, true);
  if (buffer.byteLength !== 16 + 12 * points + 12 * triangles) throw new Error('the preview is cut off');
  const positions = new Float32Array(3 * points),
    indices = new Uint32Array(3 * triangles);
  const low = [Infinity, Infinity, Infinity],
    high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; ++i) {
    positions[i] = view.getFloat32(16 + 4 * i, true);
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  for (let i = 0; i < indices.length; ++i) {
    indices[i] = view.getUint32(16 + 4 * (positions.length + i), true);
    if (indices[i] >= points) throw new Error('the preview names a point that it does not have');
  }
  const centre = low.map((x, axis) => (x + high[axis]) / 2);
  let radius = 1e-6;
  for (let i = 0; i < positions.length; i += 3)
    radius = Math.max(
      radius,
      Math.hypot(positions[i] - centre[0], positions[i + 1] - centre[1], positions[i + 2] - centre[2]),
    );
  return { positions, indices, normals: normalsOf(positions, indices), centre, radius };
}

/**
 * Finds the edges with defects in a mesh: {open_edge, nonmanifold_edge, turned_edge}; each is an array of lines [x, y,
 * z, x, y, z]. Vertices with equal positions count as one vertex, as in the service's measures.
 */
export function defectEdges({ positions, indices }) {
  const ids = new Map(),
    same = new Uint32Array(positions.length / 3);
  for (let i = 0; i < same.length; ++i) {
    const key = `${positions[3 * i]} ${positions[3 * i + 1]} ${positions[3 * i + 2]}`;
    if (!ids.has(key)) ids.set(key, i);
    same[i] = ids.get(key);
  }
  const edges = new Map(); // for each pair of vertices: the number of triangles that use the edge in each direction
  for (let i = 0; i < indices.length; ++i) {
    const from = same[indices[i]],
      to = same[indices[i % 3 === 2 ? i - 2 : i + 1]];
    if (from === to) continue;
    const key = Math.min(from, to) * same.length + Math.max(from, to);
    const edge = edges.get(key) ?? { from, to, along: 0, against: 0 };
    edges.set(key, edge);
    if (edge.from === from) ++edge.along;
    else ++edge.against;
  }
  const found = { open_edge: [], nonmanifold_edge: [], turned_edge: [] };
  const at = (point) => positions.subarray(3 * point, 3 * point + 3);
  for (const { from, to, along, against } of edges.values()) {
    const kind =
      along + against > 2
        ? 'nonmanifold_edge'
        : along + against === 1
          ? 'open_edge'
          : along !== against
            ? 'turned_edge'
            : null;
    if (kind) found[kind].push([...at(from), ...at(to)]);
  }
  return found;
}
