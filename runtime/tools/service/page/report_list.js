// The list of all reports that the service stores, for the uploads of all clients.

import { element, verdict } from './element.js';
import { bytes, clock, duration, nothing } from './format.js';
import { table } from './table.js';

/** The verdict on an upload. The argument may be an upload, a report or an entry of the list of reports. */
export function stateVerdict({ state, valid }) {
  if (state === 'done') return valid ? verdict('ok', 'valid') : verdict('defect', 'not valid');
  if (state === 'failed') return verdict('attention', 'refused');
  if (state === 'cancelled') return verdict('unknown', 'cancelled');
  return verdict('waiting', state === 'running' ? 'being judged' : 'waiting');
}

export class ReportList {
  #api;
  #node;
  #open;
  #shown = '';

  /** api: sends requests. node: element for the list. open(id): called when the user selects a report. */
  constructor(api, node, open) {
    this.#api = api;
    this.#node = node;
    this.#open = open;
    this.#show([]);
  }

  async refresh() {
    const { reports } = await this.#api.json('/api/v1/reports');
    // If the list has not changed, keep its elements in the document, so that a keyboard user does not lose the focus.
    const shown = JSON.stringify(reports);
    if (shown === this.#shown) return;
    this.#shown = shown;
    this.#show(reports);
  }

  #show(reports) {
    const focused = this.#node.contains(document.activeElement) ? document.activeElement.dataset.report : undefined;
    if (reports.length === 0) {
      this.#node.replaceChildren(element('p', { class: 'muted', text: 'Nothing was validated yet.' }));
      return;
    }
    const rows = reports.map((report) => [
      element('button', {
        type: 'button',
        class: 'link',
        'data-report': report.id,
        text: report.name || nothing,
        on: { click: () => this.#open(report.id) },
      }),
      stateVerdict(report),
      report.kind,
      bytes(report.bytes),
      clock(report.received),
      report.seconds === null || report.seconds === undefined ? nothing : duration(report.seconds),
    ]);
    this.#node.replaceChildren(
      element(
        'div',
        { class: 'scroll tall', tabindex: '0', role: 'group', 'aria-label': 'List of reports' },
        table(
          'Newest first; also what came by other programs',
          ['Name', 'Verdict', 'Kind', 'Size', 'Received', 'Took'],
          rows,
          { class: 'reports' },
        ),
      ),
    );
    if (focused) this.#node.querySelector(`[data-report="${CSS.escape(focused)}"]`)?.focus();
  }
}
