// Meshes and grammars for the tests of the service: valid ones, and one for each defect.
//
//   node meshes.mjs FOLDER     writes all of them to the folder
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

/**
 * Makes a closed ball: an octahedron whose triangles are divided into four, `levels` times; it has 8 * 4^levels
 * triangles.
 */
export function ball(levels, radius = 1) {
  const points = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
  let triangles = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
  for (let level = 0; level < levels; ++level) {
    const middles = new Map();
    const middle = (a, b) => {
      const key = a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a;
      if (!middles.has(key)) {
        const sum = points[a].map((x, i) => x + points[b][i]);
        const length = Math.hypot(...sum);
        middles.set(key, points.push(sum.map((x) => x / length)) - 1);
      }
      return middles.get(key);
    };
    triangles = triangles.flatMap(([a, b, c]) => {
      const ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      return [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
    });
  }
  return { points: points.map((p) => p.map((x) => x * radius)), triangles };
}

/**
 * Encodes a mesh as .glb. change(json, bin) may damage its JSON and binary data, text(json) the JSON's text;
 * without_bin omits the binary chunk.
 */
export function glb({ points, triangles }, { change = () => {}, text = JSON.stringify, without_bin = false } = {}) {
  const bin = Buffer.alloc(points.length * 12 + triangles.length * 12);
  points.flat().forEach((x, i) => bin.writeFloatLE(x, i * 4));
  triangles.flat().forEach((index, i) => bin.writeUInt32LE(index, points.length * 12 + i * 4));
  const bound = (of) => [0, 1, 2].map((axis) => points.reduce((m, p) => of(m, Math.fround(p[axis])), points[0][axis]));
  const json = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      {
        bufferView: 0, componentType: 5126, count: points.length, type: 'VEC3',
        min: bound(Math.min), max: bound(Math.max),
      },
      { bufferView: 1, componentType: 5125, count: triangles.length * 3, type: 'SCALAR' },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: points.length * 12 },
      { buffer: 0, byteOffset: points.length * 12, byteLength: triangles.length * 12 },
    ],
    buffers: [{ byteLength: bin.length }],
  };
  change(json, bin);
  const words = Buffer.from(text(json));
  const padded = Buffer.concat([words, Buffer.alloc((4 - (words.length % 4)) % 4, ' ')]);
  const chunk = (type, data) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(data.length, 0);
    head.writeUInt32LE(type, 4);
    return Buffer.concat([head, data]);
  };
  const chunks = Buffer.concat([chunk(0x4e4f534a, padded), ...(without_bin ? [] : [chunk(0x004e4942, bin)])]);
  const head = Buffer.alloc(12);
  head.write('glTF');
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + chunks.length, 8);
  return Buffer.concat([head, chunks]);
}

export function obj({ points, triangles }) {
  const faces = triangles.map((t) => `f ${t.map((i) => i + 1).join(' ')}`);
  const lines = [...points.map((p) => `v ${p.join(' ')}`), ...faces];
  return Buffer.from(lines.join('\n') + '\n');
}

export function ply({ points, triangles }) {
  const head = ['ply', 'format ascii 1.0', `element vertex ${points.length}`, 'property float x', 'property float y',
    'property float z', `element face ${triangles.length}`, 'property list uchar int vertex_indices', 'end_header'];
  const lines = [...head, ...points.map((p) => p.join(' ')), ...triangles.map((t) => `3 ${t.join(' ')}`)];
  return Buffer.from(lines.join('\n') + '\n');
}

export function stl({ points, triangles }) {
  const bytes = Buffer.alloc(84 + triangles.length * 50);
  bytes.writeUInt32LE(triangles.length, 80);
  triangles.forEach((t, i) => t.forEach((p, corner) => points[p].forEach((x, axis) => {
    bytes.writeFloatLE(x, 84 + i * 50 + 12 + corner * 12 + axis * 4);
  })));
  return bytes;
}

export const types = {
  '.glb': 'model/gltf-binary', '.obj': 'model/obj', '.ply': 'model/ply', '.stl': 'model/stl', '.sgm': 'text/x-sgm',
};

const small = ball(3);

/**
 * Test files by name: the bytes to upload, and in `valid` the expected result: a solid (true), no solid (false), or
 * refused with status 422 (null).
 */
export const files = {
  'sphere.glb': { valid: true, bytes: () => glb(small) },
  'sphere.obj': { valid: true, bytes: () => obj(small) },
  'sphere.ply': { valid: true, bytes: () => ply(small) },
  'sphere.stl': { valid: true, bytes: () => stl(small) },
  'ball.sgm': { valid: true, bytes: () => Buffer.from('sgm 1;\nparam radius = 3m in 1m..4m "radius";\nstart Ball;\n' +
                                                       'rule Ball { sphere(radius); }\n') },
  'hole.glb': { valid: false, bytes: () => glb({ points: small.points, triangles: small.triangles.slice(1) }) },
  'truncated.glb': { valid: null, bytes: () => glb(small).subarray(0, -1000) },
  'empty.glb': { valid: null, bytes: () => Buffer.alloc(0) },
  'noise.glb': { valid: null, bytes: () => Buffer.alloc(4096, 'no mesh at all. ') },
  'index_out_of_range.glb': {
    valid: null,
    bytes: () => glb(small, { change: (json, bin) => bin.writeUInt32LE(0xfffffff0, small.points.length * 12) }),
  },
  'count_out_of_range.glb': {
    valid: null,
    pointer: true,
    bytes: () => glb(small, { change: (json) => { json.accessors[0].count = 2 ** 31; } }),
  },
  'nan_bounds.glb': {
    valid: null,
    bytes: () => glb(small, {
      change: (json) => { json.accessors[0].min[0] = 'NaN'; },
      text: (json) => JSON.stringify(json).replace('"NaN"', 'NaN'),
    }),
  },
  'external_file.glb': {
    valid: null,
    pointer: true,
    bytes: () => glb(small, { change: (json) => { json.buffers[0].uri = 'file:///etc/passwd'; }, without_bin: true }),
  },
  'external_http.glb': {
    valid: null,
    pointer: true,
    bytes: () => glb(small, {
      change: (json) => { json.buffers[0].uri = 'http://127.0.0.1:1/a.bin'; },
      without_bin: true,
    }),
  },
  'external_beside_bin.glb': {
    valid: null,
    pointer: true,
    bytes: () => glb(small, { change: (json) => { json.buffers[0].uri = '../../etc/passwd'; } }),
  },
  'sparse_out_of_range.glb': {
    valid: null,
    pointer: true,
    bytes: () => glb(small, {
      change: (json) => {
        json.accessors[0].sparse = {
          count: 1,
          indices: { bufferView: 1, byteOffset: 8, componentType: 5125 },
          values: { bufferView: 0, byteOffset: 2 ** 31 },
        };
      },
    }),
  },
  'wrong.sgm': { valid: null, line: true, bytes: () => Buffer.from('sgm 1;\nstart Ball;\nrule Ball { spere(3m); }\n') },
  'import.sgm': { valid: null, line: true,
                  bytes: () => Buffer.from('sgm 1;\nimport "/etc/passwd" as secrets;\nstart Ball;\n' +
                                           'rule Ball { sphere(3m); }\n') },
};

export function write(folder) {
  fs.mkdirSync(folder, { recursive: true });
  for (const [name, file] of Object.entries(files)) fs.writeFileSync(path.join(folder, name), file.bytes());
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  if (process.argv.length !== 3) {
    console.error('usage: node meshes.mjs FOLDER');
    process.exit(2);
  }
  write(process.argv[2]);
}
