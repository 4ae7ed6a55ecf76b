// Shows the class of a mesh, determined from its histogram, and how certain the classification is.

import { element, verdict } from './element.js';
import { number, percent } from './format.js';
import { showHistograms } from './histogram_chart.js';
import { table } from './table.js';

const isLess = (value, limit) => limit === null || limit === undefined || value <= limit;

function classTable({ classes, limits }) {
  const distance = (value, limit) =>
    element(
      'span',
      {},
      element('data', { value: String(value), text: number(value, 3) }),
      isLess(value, limit) ? '' : ' – past the limit',
    );
  const best = (key) => Math.min(...classes.map((one) => one[key]));
  const rows = classes.map((one) => [
    one.class,
    distance(one.mse, limits?.mse),
    distance(one.emd, limits?.emd),
    one.nearest,
    one.mse === best('mse')
      ? verdict(isLess(one.mse, limits?.mse) ? 'ok' : 'attention', 'nearest')
      : element('span', { class: 'muted', text: one.emd === best('emd') ? 'nearest by EMD' : '–' }),
  ]);
  const limit = limits ? `, limits MSE ${number(limits.mse, 3)} and EMD ${number(limits.emd, 3)}` : '';
  return element(
    'div',
    { class: 'scroll', tabindex: '0', role: 'group', 'aria-label': 'Distances to the masters' },
    table(`Distances to the masters${limit}`, ['Class', 'MSE', 'EMD', 'Nearest master', 'Verdict'], rows, {
      class: 'classes',
    }),
  );
}

/** Returns the section with the class. report: a finished report. */
export function showClassification(report) {
  const node = element(
    'section',
    { class: 'classification', 'aria-labelledby': 'class-title' },
    element('h3', { id: 'class-title', text: 'Histogram and masters' }),
  );
  const said = report.classification,
    own = report.measures.histogram;
  if (said) {
    const known = said.class !== 'unknown';
    node.append(
      element(
        'p',
        { class: 'headline' },
        verdict(known ? 'ok' : 'unknown', known ? `Looks like a ${said.class}` : 'Looks like none of the classes'),
      ),
      element('p', {
        class: 'muted',
        text:
          'Masters are meshes whose class is known. MSE (mean squared error) and EMD (earth mover’s distance) tell ' +
          'how far the histogram of this mesh is from theirs: the smaller, the more alike. In mode curvature MSE is that of the ' +
          'shares’ square roots, so that rare bends count beside the many flat edges. The margin is how much ' +
          'nearer the first class is than the next by MSE: 0 % is undecided, 100 % is sure.',
      }),
      element('p', {
        class: 'muted',
        text: [
          said.reason,
          `margin to the next class ${percent(said.margin)}`,
          said.second_opinion ? `second opinion by EMD: ${said.second_opinion}` : null,
          `masters: ${said.masters}`,
        ]
          .filter(Boolean)
          .join('; '),
      }),
    );
  } else {
    node.append(
      element('p', { class: 'headline' }, verdict('unknown', 'Not classified')),
      element('p', { class: 'muted', text: report.classification_error ?? 'the service does not say why' }),
    );
  }
  const shares = said?.shares ?? own?.shares;
  if (shares?.length > 0) {
    const classes = said?.classes ?? [];
    node.append(
      showHistograms({
        shares,
        masters: said ? (report.nearest_masters ?? []) : [],
        found: (name) => classes.find((one) => one.class === name),
        best: classes.length > 0 ? classes.reduce((a, b) => (b.mse < a.mse ? b : a)).class : null,
      }),
    );
  }
  if (said?.classes?.length > 0) node.append(classTable(said));
  return node;
}
