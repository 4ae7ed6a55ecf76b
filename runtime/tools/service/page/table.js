// Tables of measures, with a name, a value and a verdict in each row.

import { datum, element, verdict } from './element.js';
import { count, percent } from './format.js';

/** columns: titles of the columns. rows: arrays of DOM nodes or texts; the first element is the row's heading. */
export function table(caption, columns, rows, options = {}) {
  const cell = (tag, content, attributes) => {
    const node = element(tag, attributes);
    node.append(content ?? '');
    return node;
  };
  return element(
    'table',
    options,
    element('caption', { text: caption }),
    element('thead', {}, element('tr', {}, ...columns.map((title) => element('th', { scope: 'col', text: title })))),
    element(
      'tbody',
      {},
      ...rows.map((row) =>
        element(
          'tr',
          {},
          ...row.map((content, i) => (i === 0 ? cell('th', content, { scope: 'row' }) : cell('td', content, {}))),
        ),
      ),
    ),
  );
}

const words = { ok: 'ok', attention: 'attention', defect: 'defect', info: '' };

/** A row of a table of measures. kind: verdict ok, attention or defect, or info if there is no verdict. */
export function measureRow(name, value, unit, kind, why = '') {
  const judged =
    kind === 'info'
      ? element('span', { class: 'muted', text: why || '–' })
      : verdict(kind, why ? `${words[kind]}: ${why}` : words[kind]);
  return [name, value, unit, judged];
}

/**
 * The row for the number of sliver triangles. Every mesh from a grid has a few, so only a large share gets the verdict
 * "attention".
 */
export function sliverRow(slivers, triangles) {
  const share = triangles > 0 ? slivers / triangles : 0;
  const why = slivers > 0 ? `${percent(share, 2)} of the triangles` : '';
  return measureRow(
    'Slivers',
    datum(slivers, count(slivers), { title: 'thin triangles' }),
    '',
    share > 0.05 ? 'attention' : 'ok',
    why && share > 0.05 ? `${why}, over 5 %` : why,
  );
}

export const measureColumns = ['Measure', 'Value', 'Unit', 'Verdict'];
