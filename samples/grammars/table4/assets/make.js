// Makes the assets of cabral.sgm, house.glb, shuttered.glb and arcade.glb, beside this file: node make.js
// Each solid is an outline in x and y (metres) that is extruded along z; its front has recesses and raised parts
// ("features").
'use strict';
const fs = require('fs');
const path = require('path');

// '' stands for the material of the statement that places the asset.
const materials = ['', 'plaster', 'brick', 'slate', 'concrete_cream', 'glass', 'wood', 'paint_white', 'plaster_rose', 'paint_green'];

class Body {
  constructor() { this.byMaterial = materials.map(() => []); }

  quad(material, a, b, c, d) { this.byMaterial[materials.indexOf(material)].push(a, b, c, a, c, d); }

  /// Adds the flat face that `loop` encloses in the plane at z, with a hole for each feature. The face is cut into
  /// strips at the heights of all corners. Then adds the features.
  face(loop, z, material, features, towards = 1) {
    const loops = [loop, ...features.map((f) => f.loop)];
    const heights = [...new Set(loops.flat().map((p) => p[1]))].sort((a, b) => a - b);
    for (let i = 0; i + 1 < heights.length; ++i) {
      const [low, high] = [heights[i], heights[i + 1]];
      const crossing = [];
      for (const corners of loops) {
        corners.forEach((a, k) => {
          const b = corners[(k + 1) % corners.length];
          if (Math.min(a[1], b[1]) > low || Math.max(a[1], b[1]) < high || a[1] === b[1]) return;
          const at = (y) => (y === a[1] ? a[0] : y === b[1] ? b[0] : a[0] + ((b[0] - a[0]) * (y - a[1])) / (b[1] - a[1]));
          crossing.push([at(low), at(high)]);
        });
      }
      crossing.sort((a, b) => a[0] + a[1] - b[0] - b[1]);
      for (let k = 0; k < crossing.length; k += 2) {
        const [l, r] = [crossing[k], crossing[k + 1]];
        const corners = [[l[0], low, z], [r[0], low, z], [r[1], high, z], [l[1], high, z]];
        this.quad(material, ...(towards > 0 ? corners : corners.reverse()));
      }
    }
    for (const f of features) {
      this.band(f.loop, z, z + f.depth, () => f.sides || material);
      this.face(f.loop, z + f.depth, f.material || material, f.features || []);
    }
  }

  /// Adds the side faces of a loop from one z to another.
  band(loop, from, to, materialOf) {
    loop.forEach((a, i) => {
      const b = loop[(i + 1) % loop.length];
      this.quad(materialOf(a, b), [a[0], a[1], from], [b[0], b[1], from], [b[0], b[1], to], [a[0], a[1], to]);
    });
  }

  write(name) {
    const chunks = [], accessors = [], views = [], primitives = [], used = [];
    let at = 0;
    this.byMaterial.forEach((points, i) => {
      if (points.length === 0) return;
      const low = [0, 1, 2].map((k) => Math.min(...points.map((p) => Math.fround(p[k]))));
      const high = [0, 1, 2].map((k) => Math.max(...points.map((p) => Math.fround(p[k]))));
      const bytes = Buffer.from(new Float32Array(points.flat()).buffer);
      views.push({ buffer: 0, byteOffset: at, byteLength: bytes.length });
      accessors.push({ bufferView: views.length - 1, componentType: 5126, count: points.length, type: 'VEC3', min: low, max: high });
      primitives.push({ attributes: { POSITION: accessors.length - 1 }, ...(materials[i] && { material: used.length }) });
      if (materials[i]) used.push({ name: materials[i] });
      chunks.push(bytes);
      at += bytes.length;
    });
    const pad = (bytes, fill) => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, fill)]);
    const json = pad(Buffer.from(JSON.stringify({
      asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, name }],
      meshes: [{ primitives }], materials: used, accessors, bufferViews: views, buffers: [{ byteLength: at }],
    })), 0x20);
    const binary = pad(Buffer.concat(chunks), 0);
    const words = (...numbers) => Buffer.from(new Uint32Array(numbers).buffer);
    fs.writeFileSync(path.join(__dirname, `${name}.glb`), Buffer.concat([
      words(0x46546c67, 2, 28 + json.length + binary.length), words(json.length, 0x4e4f534a), json,
      words(binary.length, 0x004e4942), binary,
    ]));
  }
}

const rect = (x0, y0, x1, y1) => [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
/// The outline of a door with a round arch, which is approximated by `chords` chords.
function arch(x0, y0, x1, spring, chords) {
  const r = (x1 - x0) / 2;
  const head = [...Array(chords - 1).keys()].map((i) => {
    const turn = (Math.PI * (i + 1)) / chords;
    return [x0 + r + r * Math.cos(turn), spring + r * Math.sin(turn)];
  });
  return [[x0, y0], [x1, y0], [x1, spring], ...head, [x0, spring]];
}
const octagon = (x, y, r) => [...Array(8).keys()].map((i) => {
  const turn = (Math.PI * (2 * i + 1)) / 8;
  return [x + r * Math.cos(turn), y + r * Math.sin(turn)];
});
/// A window of four panes in a stone surround, recessed so far that its edges are straight with grid cells of 0.1 m.
const window_ = (x0, y0, x1, y1) => {
  const middle = (x0 + x1) / 2, step = (y1 - y0 - 0.2) / 2;
  const panes = [];
  for (const [l, r] of [[x0 + 0.1, middle - 0.05], [middle + 0.05, x1 - 0.1]]) {
    for (let k = 0; k < 2; ++k) {
      const low = y0 + 0.1 + k * (step + 0.03);
      panes.push({ loop: rect(l, low, r, low + step - 0.03), depth: -0.08, material: 'glass', sides: 'paint_white' });
    }
  }
  return [{
    loop: rect(x0 - 0.13, y0, x1 + 0.13, y1 + 0.14), depth: 0.05, material: 'concrete_cream', sides: 'concrete_cream',
    features: [{
      loop: rect(x0, y0 + 0.01, x1, y1), depth: -0.19, material: 'paint_white', sides: 'concrete_cream', features: panes,
    }],
  }];
};
/// A window of two panes between open shutters. The shutters are one plate with the frame, so that the outline has few
/// corners.
const shuttered_ = (x0, y0, x1, y1) => {
  const middle = (x0 + x1) / 2, pane = { depth: -0.08, material: 'glass', sides: 'paint_white' };
  const panel = (l, r) => ({
    loop: rect(l, y0 + 0.1, r, y1 - 0.1), depth: -0.04, material: 'paint_green', sides: 'paint_green',
  });
  return [{
    loop: rect(x0 - 0.27, y0, x1 + 0.27, y1), depth: 0.06, material: 'paint_green', sides: 'paint_green',
    features: [panel(x0 - 0.23, x0 - 0.06), panel(x1 + 0.06, x1 + 0.23), {
      loop: rect(x0, y0 + 0.01, x1, y1 - 0.01), depth: -0.2, material: 'paint_white', sides: 'plaster',
      features: [
        { loop: rect(x0 + 0.08, y0 + 0.08, middle - 0.05, y1 - 0.08), ...pane },
        { loop: rect(middle + 0.05, y0 + 0.08, x1 - 0.08, y1 - 0.08), ...pane },
      ],
    }],
  }];
};
const sill = (x0, x1, y) => ({ loop: rect(x0 - 0.1, y - 0.16, x1 + 0.1, y - 0.01), depth: 0.11, material: 'concrete_cream', sides: 'concrete_cream' });

/// A house with a gabled roof; with shutters it also has another colour.
function house(name, wall, shuttered) {
  const body = new Body();
  const outline = [[0.3, 0], [5.7, 0], [5.7, 6.4], [6, 6.4], [6, 6.6], [3, 9.6], [0, 6.6], [0, 6.4], [0.3, 6.4]];
  const features = [
    {
      loop: arch(2.12, 0.2, 3.88, 1.7, 8), depth: 0.12, material: 'concrete_cream', sides: 'concrete_cream',
      features: [{
        loop: arch(2.3, 0.21, 3.7, 1.7, 8), depth: -0.42, material: 'wood', sides: 'concrete_cream',
        features: [2.42, 3.06].map((x) => ({
          loop: rect(x, 0.45, x + 0.52, 1.55), depth: 0.06, material: 'wood', sides: 'wood',
        })),
      }],
    },
    { loop: rect(0.4, 2.8, 5.6, 3), depth: 0.08, material: 'concrete_cream', sides: 'concrete_cream' },
    { loop: octagon(3, 7.7, 0.5), depth: -0.2, material: 'glass', sides: 'concrete_cream' },
  ];
  const opening = shuttered ? shuttered_ : window_;
  for (const x of [0.9, 4.2]) features.push(...opening(x, 1, x + 0.9, 2.3), sill(x, x + 0.9, 1));
  for (const x of [0.9, 2.55, 4.2]) features.push(...opening(x, 3.9, x + 0.9, 5.4), sill(x, x + 0.9, 3.9));
  body.face(outline, 0, wall, features);
  body.band(outline, -5, 0, (a, b) => (Math.min(a[1], b[1]) >= 6.4 ? 'slate' : wall));
  body.face(outline, -5, wall, [], -1);
  body.write(name);
}

function arcade() {
  const body = new Body();
  const outline = rect(0, 0, 4, 5);
  body.face(outline, 0, 'brick', [
    { loop: arch(1, 0.3, 3, 2.4, 10), depth: -1.6, material: 'plaster', sides: 'brick' },
    { loop: rect(0.4, 0.3, 0.7, 3.9), depth: 0.12, material: 'concrete_cream', sides: 'concrete_cream' },
    { loop: rect(3.3, 0.3, 3.6, 3.9), depth: 0.12, material: 'concrete_cream', sides: 'concrete_cream' },
    { loop: rect(0.1, 4.1, 3.9, 4.4), depth: 0.25, material: 'concrete_cream', sides: 'concrete_cream' },
  ]);
  body.band(outline, -4, 0, (a, b) => (Math.min(a[1], b[1]) === 5 ? 'slate' : 'brick'));
  body.face(outline, -4, 'brick', [], -1);
  body.write('arcade');
}

house('house', '', false);
house('shuttered', '', true);
arcade();
