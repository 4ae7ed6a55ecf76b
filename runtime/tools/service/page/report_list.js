// The reports that the service keeps, whoever sent the meshes.

import { element, verdict } from './element.js';
import { bytes, clock, duration, nothing } from './format.js';
import { table } from './table.js';

/** What has become of an upload, of a report or of its line in the list. */
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

  /** open(id): somebody wants to see a report. */
  constructor(api, node, open) {
    this.#api = api;
    this.#node = node;
    this.#open = open;
    this.#show([]);
  }

  async refresh() {
    const { reports } = await this.#api.json('/api/v1/reports');
    // What has not changed stays: whoever is in the list by keyboard is not thrown out of it.
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
