// Table of an uploaded mesh's measures, each with a verdict, and the overall verdict in words.

import { totalOf } from './defect_kinds.js';
import { datum } from './element.js';
import { count, number, percent } from './format.js';
import { measureColumns, measureRow, sliverRow, table } from './table.js';

const holes = (m) => totalOf(m, 'open_edge');

const inWords = [
  [(m) => m.triangles === 0, 'Empty: there is no triangle'],
  [(m) => m.non_finite > 0, 'Broken: corners that are no numbers'],
  [(m) => holes(m) > 0, 'Not watertight: there are holes'],
  [(m) => m.turned_edges > 0, 'Not watertight: neighbours face different ways'],
  [(m) => m.nonmanifold_edges > 0 || m.nonmanifold_vertices > 0, 'Not manifold: parts meet in an edge or a point'],
  [(m) => m.inside_out > 0, 'Inside out'],
  [(m) => m.self_intersections > 0 || m.folded > 0, 'Cuts itself'],
  [(m) => m.nested > 0, 'Covered twice: a solid in a solid'],
  [(m) => m.degenerate > 0 || m.flat > 0 || m.duplicates > 0, 'Flawed triangles'],
  [(m) => !m.complete, 'Not sure: not all could be looked at'],
];

/** The overall verdict {kind, text} of a finished report. */
export function verdictInWords({ valid, measures }) {
  if (valid && measures.cut_edges > 0) return { kind: 'ok', text: 'Valid: closed but for the border of the region' };
  if (valid) return { kind: 'ok', text: 'Valid: the closed surface of a solid' };
  const found = inWords.find(([applies]) => applies(measures));
  return {
    kind: found && measures.complete === false && found === inWords.at(-1) ? 'attention' : 'defect',
    text: found ? found[1] : 'Not valid',
  };
}

/** unit: unit of lengths, or empty if the uploaded file does not state one. */
export function showReportMeasures(measures, unit) {
  const m = measures,
    powered = (power) => (unit ? unit + power : power ? `unit${power}` : 'units');
  const value = (x, digits = 6) => datum(x, number(x, digits));
  const whole = (x) => datum(x, count(x));
  const named = (key, node) => {
    node.dataset.measure = key;
    return node;
  };
  const fact = (name, key, why) => measureRow(name, named(key, whole(m[key])), '', 'info', why);
  const none = (name, key, bad, why = '', found = m[key]) =>
    measureRow(name, named(key, whole(found)), '', found > 0 ? bad : 'ok', found > 0 ? why : '');

  const size = m.bounds ? m.bounds[1].map((high, axis) => high - m.bounds[0][axis]) : null;
  const sound = m.watertight && m.volume_counts_once;
  const slivers = sliverRow(m.slivers, m.triangles);
  named('slivers', slivers[1]);
  const rows = [
    measureRow(
      'Open edges',
      named('open_edges', whole(m.open_edges)),
      '',
      holes(m) > 0 ? 'defect' : 'ok',
      holes(m) > 0 ? 'holes' : m.cut_edges > 0 ? 'all in the border of the region' : '',
    ),
    ...(m.cut_edges > 0 ? [fact('Cut edges', 'cut_edges', 'where the region ends')] : []),
    none('Nonmanifold edges', 'nonmanifold_edges', 'defect', 'three triangles or more'),
    none('Nonmanifold points', 'nonmanifold_vertices', 'defect', 'several fans meet'),
    none('Turned edges', 'turned_edges', 'defect', 'neighbours face different ways'),
    none('Degenerate triangles', 'degenerate', 'defect', 'two corners in one place'),
    none('Flat triangles', 'flat', 'defect', 'corners on a line'),
    none('Duplicate triangles', 'duplicates', 'defect', 'there twice'),
    m.self_intersections === null
      ? measureRow('Self intersections', named('self_intersections', datum('', '–')), '', 'attention', 'not sought')
      : none('Self intersections', 'self_intersections', 'defect', 'pairs of triangles'),
    ...(m.folded === null ? [] : [none('Folded triangles', 'folded', 'defect', 'pairs upon each other')]),
    ...(m.self_intersections_complete === false
      ? [measureRow('All pairs looked at', datum(false, 'no'), '', 'attention', 'too much in one place')]
      : []),
    none('Shells inside out', 'inside_out', 'defect'),
    none('Nested shells', 'nested', 'defect', 'covered twice'),
    ...(m.not_judged > 0 ? [none('Shells not judged', 'not_judged', 'attention')] : []),
    ...(m.non_finite > 0 ? [none('Corners no numbers', 'non_finite', 'defect', 'left out of all else')] : []),
    slivers,
    measureRow('Area', named('area', value(m.area)), powered('²'), 'info'),
    measureRow(
      'Volume',
      named('volume', value(m.volume)),
      powered('³'),
      sound ? 'info' : 'attention',
      sound ? '' : m.watertight ? 'parts count twice or less' : 'the surface is open',
    ),
    measureRow(
      'Euler number',
      named('euler', m.euler === null ? datum('', '–') : whole(m.euler)),
      '',
      'info',
      m.euler === null ? 'no manifold' : '',
    ),
    measureRow(
      'Genus',
      named('genus', m.genus === null ? datum('', '–') : whole(m.genus)),
      '',
      'info',
      m.genus === null ? 'no manifold' : 'handles',
    ),
    fact('Objects', 'objects', 'joined through points'),
    fact('Shells', 'shells', 'joined through edges'),
    ...(m.cavities > 0 ? [fact('Cavities', 'cavities', 'hollows within')] : []),
    fact('Triangles', 'triangles'),
    fact('Points', 'points', m.welded_points > 0 ? `${count(m.welded_points)} fell on others` : ''),
    ...(size ? [measureRow('Size', size.map((x) => number(x, 4)).join(', '), powered(''), 'info', 'x, y, z')] : []),
    ...(m.histogram
      ? ['flat', 'convex', 'concave'].map((how) =>
          measureRow(
            `Edges that are ${how}`,
            named(how, datum(m.histogram[how], percent(m.histogram[how]))),
            '',
            'info',
          ),
        )
      : []),
  ];
  return table(unit ? 'Lengths in metres' : 'Lengths in the units of the file', measureColumns, rows, {
    class: 'measures',
  });
}
