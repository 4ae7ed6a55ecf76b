// Writes small .glb files into the working folder: a valid tetrahedron, and one file for each defect.
"use strict";
const fs = require("fs");

const positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
const indices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3];

function glb(json, binary) {
  const pad = (bytes, by) => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, by)]);
  const chunk = (type, bytes) => {
    const head = Buffer.alloc(8);
    head.writeUInt32LE(bytes.length, 0);
    head.writeUInt32LE(type, 4);
    return Buffer.concat([head, bytes]);
  };
  const body = Buffer.concat([chunk(0x4e4f534a, pad(Buffer.from(JSON.stringify(json).replace('"a number"', "NaN")), 0x20)), chunk(0x4e4942, pad(binary, 0))]);
  const head = Buffer.alloc(12);
  head.write("glTF", 0, "latin1");
  head.writeUInt32LE(2, 4);
  head.writeUInt32LE(12 + body.length, 8);
  return Buffer.concat([head, body]);
}

// Writes one file. change: edits the JSON before it is written. of: edits the binary chunk.
function write(name, change = () => {}, of = () => {}) {
  const binary = Buffer.alloc(48 + 24 + 16);
  positions.flat().forEach((x, i) => binary.writeFloatLE(x, 4 * i));
  indices.forEach((x, i) => binary.writeUInt16LE(x, 48 + 2 * i));
  const json = {
    asset: { version: "2.0" },
    buffers: [{ byteLength: binary.length }],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: 48 },
      { buffer: 0, byteOffset: 48, byteLength: 24 },
      { buffer: 0, byteOffset: 72, byteLength: 4 },
      { buffer: 0, byteOffset: 76, byteLength: 12 },
    ],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: "VEC3", min: [0, 0, 0], max: [1, 1, 1] },
      { bufferView: 1, componentType: 5123, count: 12, type: "SCALAR" },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    nodes: [{ mesh: 0 }],
    scenes: [{ nodes: [0] }],
    scene: 0,
  };
  change(json);
  of(binary);
  fs.writeFileSync(name, glb(json, binary));
}

write("good.glb");
write("hole.glb", (j) => { j.accessors[1].count = 9; });
write("out_of_bounds.glb", () => {}, (b) => b.writeUInt16LE(4, 48 + 2 * 5));
write("nan.glb", () => {}, (b) => b.writeUInt32LE(0x7fc00000, 4 * 4));
write("nan_bounds.glb", (j) => { j.accessors[0].max = [1, "a number", 1]; });
write("external.glb", (j) => { j.buffers.push({ byteLength: 4, uri: "file:///etc/passwd" }); j.bufferViews[0].buffer = 1; });
write("elsewhere.glb", (j) => { j.buffers[0].uri = "http://127.0.0.1/a.bin"; });
write("count.glb", (j) => { j.accessors[1].count = 4e9; });
const sparse = (j) => {
  j.accessors[0].sparse = { count: 1, indices: { bufferView: 2, componentType: 5125 }, values: { bufferView: 3 } };
};
write("sparse_range.glb", sparse, (b) => b.writeUInt32LE(4, 72));
fs.writeFileSync("truncated.glb", fs.readFileSync("good.glb").subarray(0, -10));
