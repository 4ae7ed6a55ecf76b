// Damaged meshes, in addition to those of meshes.mjs, and grammars that try to read files that they may not.
import { ball, files, glb, obj, ply, stl } from './meshes.mjs';

const small = ball(2);
const line = (bytes, number, text) => {
  const lines = bytes.toString('latin1').split('\n');
  lines[number - 1] = text;
  return Buffer.from(lines.join('\n'), 'latin1');
};
const spoilt = (change, more = {}) => () => glb(small, { change, ...more });
const grammar = (text) => () => Buffer.from(text);

/** Returns a ball as .glb whose buffer is external, at `uri`. */
export const elsewhere = (uri) => spoilt((json) => { json.buffers[0].uri = uri; }, { without_bin: true })();

/**
 * Damaged files by name, in the format of `files` in meshes.mjs. pointer, line: the expected members of the problem
 * object.
 */
export const damaged = {
  'nan_position.glb': { pointer: /^\/accessors\/0/, bytes: spoilt((json, bin) => bin.writeFloatLE(NaN, 24)) },
  'infinite_position.glb': { pointer: /^\/accessors\/0/, bytes: spoilt((json, bin) => bin.writeFloatLE(Infinity, 24)) },
  'index_just_out_of_range.glb': {
    pointer: /^\/accessors\/1/,
    bytes: spoilt((json, bin) => bin.writeUInt32LE(small.points.length, small.points.length * 12)),
  },
  'view_out_of_range.glb': {
    pointer: /^\/bufferViews\/1/,
    bytes: spoilt((json) => { json.bufferViews[1].byteLength += 4096; }),
  },
  'offset_overflow.glb': {
    pointer: true,
    bytes: spoilt((json) => { json.bufferViews[0].byteOffset = 2 ** 52; }),
  },
  'sparse_index_out_of_range.glb': {
    pointer: /^\/accessors\/0\/sparse/,
    bytes: spoilt((json, bin) => {
      // The sparse accessor uses the last index of the triangles as the number of the point that it replaces, so make
      // that index too large.
      bin.writeUInt32LE(small.points.length, bin.length - 4);
      json.accessors[1].count -= 3;
      json.accessors[0].sparse = { count: 1, values: { bufferView: 0, byteOffset: 0 },
        indices: { bufferView: 1, byteOffset: small.triangles.length * 12 - 4, componentType: 5125 } };
    }),
  },
  'half_json.glb': { bytes: spoilt(() => {}, { text: (json) => JSON.stringify(json).slice(0, 200) }) },
  'head_alone.glb': { bytes: () => glb(small).subarray(0, 12) },
  'two_bytes.glb': { bytes: () => Buffer.from('gl') },
  'empty.obj': { bytes: () => Buffer.alloc(0) },
  'empty.ply': { bytes: () => Buffer.alloc(0) },
  'empty.stl': { bytes: () => Buffer.alloc(0) },
  'number.obj': { line: 3, bytes: () => line(obj(small), 3, 'v 1 two 3') },
  'face.obj': { line: small.points.length + 1, bytes: () => line(obj(small), small.points.length + 1, 'f 1 2 99999') },
  'word.obj': { line: 2, bytes: () => line(obj(small), 2, 'no-such-word 1') },
  'nan.obj': { line: 1, bytes: () => line(obj(small), 1, 'v nan 0 0') },
  'number.ply': { line: 12, bytes: () => line(ply(small), 12, '1 two 3') },
  'format.ply': { line: 2, bytes: () => line(ply(small), 2, 'format quantum 1.0') },
  'index.ply': { bytes: () => line(ply(small), 10 + small.points.length, '3 0 1 99999') },
  'short.ply': { bytes: () => ply(small).subarray(0, 1500) },
  'short.stl': { bytes: () => stl(small).subarray(0, -20) },
  'nan.stl': { bytes: () => { const bytes = stl(small); bytes.writeFloatLE(NaN, 96); return bytes; } },
  'word.stl': {
    line: 3,
    bytes: () => Buffer.from('solid a\nfacet normal 0 0 1\nouter hoop\nendloop\nendfacet\nendsolid a\n'),
  },
};

/** Grammars that must be refused; x.sgm exists in the service's working folder and in its parent. */
export const refusedGrammars = {
  'column.sgm': { line: 3, column: 13, bytes: grammar('sgm 1;\nstart Ball;\nrule Ball { spere(3m); }\n') },
  'empty.sgm': { bytes: grammar('') },
  'binary.sgm': { bytes: () => Buffer.from([0, 1, 2, 255, 254, 253]) },
  'above.sgm': { line: 2, bytes: grammar('sgm 1;\nimport "../x.sgm" as x;\nstart Ball;\nrule Ball { sphere(3m); }\n') },
  'beside.sgm': { line: 2, bytes: grammar('sgm 1;\nimport "x.sgm" as x;\nstart Ball;\nrule Ball { sphere(3m); }\n') },
  'asset.sgm': { line: 2, bytes: grammar('sgm 1;\nimport "million.glb" as m;\nstart Ball;\nrule Ball { m(3m); }\n') },
  'nested.sgm': { bytes: grammar(`sgm 1;\nstart B;\nrule B { sphere(${'('.repeat(50000)}1m); }\n`) },
};

/**
 * Returns random overlapping triangles, the same for every call. They have millions of intersections, which take long
 * to find.
 */
export function soup(count, size = 0.3) {
  let state = 1;
  const random = () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
  const points = [], triangles = [];
  for (let i = 0; i < count; ++i) {
    const middle = [random(), random(), random()];
    for (let corner = 0; corner < 3; ++corner) points.push(middle.map((x) => x + size * random()));
    triangles.push([3 * i, 3 * i + 1, 3 * i + 2]);
  }
  return { points, triangles };
}
