// Prints one line for each mesh of a file (format: meshes.h): what Manifold (npm manifold-3d) reports about it.
//
//   node manifold_judge.js FOLDER_OF_NODE_MODULES FILE
const fs = require('fs');
const path = require('path');
const { pathToFileURL } = require('url');

const [tools, file] = process.argv.slice(2);

(async () => {
  const library = await import(pathToFileURL(path.resolve(tools, 'manifold-3d/manifold.js')));
  const wasm = await library.default();
  wasm.setup();
  const bytes = fs.readFileSync(file);
  for (let at = 0; at < bytes.length;) {
    const [points, triangles] = [bytes.readUInt32LE(at + 4), bytes.readUInt32LE(at + 8)];
    at += 12;
    const array = (Type, count) => {
      const end = at + count * Type.BYTES_PER_ELEMENT;
      const values = new Type(bytes.buffer.slice(bytes.byteOffset + at, bytes.byteOffset + end));
      at = end;
      return values;
    };
    const places = array(Float64Array, 3 * points);
    const mesh = new wasm.Mesh({ numProp: 3, vertProperties: Float32Array.from(places),
                                 triVerts: array(Uint32Array, 3 * triangles) });
    mesh.merge();
    let status = 'NoError', parts = [], solid;
    try {
      solid = new wasm.Manifold(mesh);
      status = solid.status();
      parts = solid.decompose();
    } catch (e) {
      status = e.code || e.message;
    }
    // Manifold's genus is correct only for a connected mesh, so sum the genus of the parts.
    const genus = parts.reduce((sum, part) => sum + part.genus(), 0);
    console.log(status, parts.length, genus, solid ? solid.surfaceArea() : 0, solid ? solid.volume() : 0);
    for (const part of parts) part.delete();
    if (solid) solid.delete();
  }
})().catch((e) => { console.error(String(e)); process.exit(1); });
