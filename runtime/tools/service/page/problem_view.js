// Shows why the service has rejected a request.

import { element } from './element.js';
import { nothing } from './format.js';
import { table } from './table.js';

/** problem: parsed body of an answer of type application/problem+json. */
export function showProblem(problem) {
  const facts = [
    ['Status', problem.status ? `${problem.status} ${problem.title ?? ''}` : null],
    ['Code', problem.code],
    ['Where', problem.pointer ? `JSON ${problem.pointer}` : null],
    ['Place', problem.line ? `line ${problem.line}${problem.column ? `, column ${problem.column}` : ''}` : null],
  ];
  const node = element(
    'div',
    { class: 'problem' },
    element('p', { class: 'detail', text: problem.detail ?? problem.title ?? nothing }),
    element(
      'dl',
      { class: 'facts' },
      ...facts
        .filter(([, value]) => value)
        .map(([name, value]) =>
          element('div', {}, element('dt', { text: name }), element('dd', {}, element('code', { text: value }))),
        ),
    ),
  );
  if (problem.diagnostics?.length > 0) node.append(showDiagnostics(problem.diagnostics));
  return node;
}

/** Shows the compiler's messages about a grammar. */
export function showDiagnostics(diagnostics) {
  return element(
    'div',
    { class: 'scroll', tabindex: '0', role: 'group', 'aria-label': 'What the compiler says' },
    table(
      'What the compiler says',
      ['Line', 'Column', 'Severity', 'Message'],
      diagnostics.map((d) => [
        String(d.line),
        String(d.column),
        d.severity ?? 'error',
        d.hint ? `${d.message} (${d.hint})` : d.message,
      ]),
    ),
  );
}
