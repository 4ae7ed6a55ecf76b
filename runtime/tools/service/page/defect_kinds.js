// The kinds of defects that are marked in the mesh. Each has a title, a colour and a symbol of its own.

import { svg } from './element.js';

/**
 * title: shown name. colour: CSS class that gives the mark its colour. sign: shape of the mark. edge: whether the mesh
 * view marks the affected edges with lines.
 */
export const defectKinds = {
  open_edge: { title: 'open edge', colour: 'mark-0', sign: 'circle', edge: true },
  nonmanifold_edge: { title: 'nonmanifold edge', colour: 'mark-1', sign: 'square', edge: true },
  turned_edge: { title: 'turned edge', colour: 'mark-2', sign: 'diamond', edge: true },
  self_intersection: { title: 'self intersection', colour: 'mark-3', sign: 'cross' },
  pinched_vertex: { title: 'pinched point', colour: 'mark-1', sign: 'hourglass' },
  folded: { title: 'folded triangles', colour: 'mark-3', sign: 'diamond' },
  degenerate: { title: 'degenerate triangle', colour: 'mark-4', sign: 'up' },
  flat: { title: 'flat triangle', colour: 'mark-4', sign: 'diamond' },
  duplicate: { title: 'duplicate triangle', colour: 'mark-4', sign: 'down' },
  inside_out: { title: 'shell inside out', colour: 'mark-2', sign: 'left' },
  nested: { title: 'nested shell', colour: 'mark-3', sign: 'right' },
};
export const kindOf = (kind) =>
  defectKinds[kind] ?? { title: kind.replaceAll('_', ' '), colour: 'mark-0', sign: 'circle' };

const totalKeys = {
  open_edge: 'open_edges',
  nonmanifold_edge: 'nonmanifold_edges',
  turned_edge: 'turned_edges',
  self_intersection: 'self_intersections',
  pinched_vertex: 'nonmanifold_vertices',
  folded: 'folded',
  degenerate: 'degenerate',
  flat: 'flat',
  duplicate: 'duplicates',
  inside_out: 'inside_out',
  nested: 'nested',
};

/**
 * Number of defects of a kind in a mesh. Open edges at a region's border are not counted, since the border cuts the
 * mesh there.
 */
export function totalOf(measures, kind) {
  const total = measures[totalKeys[kind]] ?? 0;
  return kind === 'open_edge' ? total - measures.cut_edges : total;
}

const outlines = {
  circle: Array.from({ length: 16 }, (_, i) => [Math.cos((i * Math.PI) / 8), Math.sin((i * Math.PI) / 8)]),
  square: [
    [-0.85, -0.85],
    [0.85, -0.85],
    [0.85, 0.85],
    [-0.85, 0.85],
  ],
  diamond: [
    [0, -1.15],
    [1.15, 0],
    [0, 1.15],
    [-1.15, 0],
  ],
  up: [
    [0, -1.1],
    [1.05, 0.8],
    [-1.05, 0.8],
  ],
  down: [
    [0, 1.1],
    [1.05, -0.8],
    [-1.05, -0.8],
  ],
  left: [
    [-1.1, 0],
    [0.8, -1.05],
    [0.8, 1.05],
  ],
  right: [
    [1.1, 0],
    [-0.8, -1.05],
    [-0.8, 1.05],
  ],
  hourglass: [
    [-0.9, -1],
    [0.9, -1],
    [-0.9, 1],
    [0.9, 1],
  ],
  cross: [
    [-1, -0.35],
    [-0.35, -0.35],
    [-0.35, -1],
    [0.35, -1],
    [0.35, -0.35],
    [1, -0.35],
    [1, 0.35],
    [0.35, 0.35],
    [0.35, 1],
    [-0.35, 1],
    [-0.35, 0.35],
    [-1, 0.35],
  ],
};

/** The corners of the symbol of a kind of defect, in a square from -1 to 1. */
export const outlineOf = (kind) => outlines[kindOf(kind).sign];

export function signNode(kind) {
  const points = outlineOf(kind)
    .map(([x, y]) => `${(7 + 5 * x).toFixed(2)},${(7 + 5 * y).toFixed(2)}`)
    .join(' ');
  return svg(
    'svg',
    { viewBox: '0 0 14 14', class: 'square', 'aria-hidden': 'true' },
    svg('polygon', { points, class: `mark ${kindOf(kind).colour}` }),
  );
}
