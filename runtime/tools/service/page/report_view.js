// Shows one report: its verdict, the mesh with its defects, its measures and its histogram.

import { Problem } from './api.js';
import { byId, datum, element, verdict } from './element.js';
import { bytes, clock, duration } from './format.js';
import { showClassification } from './classification_view.js';
import { MeshView } from './mesh_view.js';
import { readPreview } from './mesh_preview.js';
import { showDiagnostics, showProblem } from './problem_view.js';
import { showReportMeasures, verdictInWords } from './report_measures.js';
import { showPlaces } from './report_places.js';

const pause = (milliseconds) =>
  new Promise((resolve) => {
    setTimeout(resolve, milliseconds);
  });

export class ReportView {
  #api;
  #verdict = byId('report-verdict');
  #body = byId('report-body');
  #title = byId('report-title');
  #view = null;
  #wanted = null;

  constructor(api) {
    this.#api = api;
  }

  /** Shows the report with this id. Waits until the report is finished. */
  async open(id) {
    this.#wanted = id;
    try {
      for (;;) {
        const report = await this.#api.json(`/api/v1/reports/${encodeURIComponent(id)}`);
        if (this.#wanted !== id) return;
        if (!['waiting', 'running'].includes(report.state)) return this.#show(report);
        this.#head(report, 'waiting', report.state === 'running' ? 'It is being judged' : 'It waits to be judged');
        this.#clear();
        await pause(500);
      }
    } catch (error) {
      if (!(error instanceof Problem)) console.error(error);
      if (this.#wanted !== id) return;
      this.#title.textContent = 'Report';
      this.#verdict.replaceChildren(
        element('p', { class: 'headline' }, verdict('attention', 'This report cannot be shown')),
      );
      this.#clear(showProblem(error.body ?? { detail: error.message }));
    }
  }

  #clear(...nodes) {
    this.#view?.dispose();
    this.#view = null;
    this.#body.replaceChildren(...nodes);
  }

  #head(report, kind, text) {
    this.#title.replaceChildren('Report of ', element('span', { class: 'name', text: report.name }));
    this.#verdict.dataset.report = report.id;
    this.#verdict.dataset.state = report.state;
    this.#verdict.replaceChildren(
      element('p', { class: 'headline' }, verdict(kind, text)),
      element(
        'p',
        { class: 'muted' },
        `${report.kind}, ${bytes(report.bytes)}, received ${clock(report.received)}`,
        typeof report.seconds === 'number' ? `, judged in ${duration(report.seconds)}` : '',
      ),
    );
  }

  #show(report) {
    if (report.state !== 'done') {
      this.#head(report, 'attention', report.state === 'failed' ? 'Refused: it cannot be judged' : 'Cancelled');
      this.#clear(showProblem(report.problem ?? { detail: 'the service does not say why' }));
      return;
    }
    const { kind, text } = verdictInWords(report);
    this.#head(report, kind, text);
    const said = [
      ...report.measures.problems,
      ...report.measures.unknowns,
      ...(report.measures.notes ?? []),
      ...(report.empty_because ? [report.empty_because] : []),
    ];
    if (said.length > 0)
      this.#verdict.append(element('ul', { class: 'said' }, ...said.map((one) => element('li', { text: one }))));
    const unit = ['glb', 'sgm'].includes(report.kind) ? 'm' : '';
    const picture = element(
      'div',
      { class: 'view-slot' },
      element('p', {
        class: 'muted',
        text: report.preview ? 'The view is on its way.' : 'There is nothing to look at.',
      }),
    );
    this.#clear(
      element(
        'div',
        { class: 'columns report-columns' },
        element(
          'section',
          { 'aria-labelledby': 'view-title' },
          element('h3', { id: 'view-title', text: 'View' }),
          picture,
          element('h3', { text: 'Places' }),
          showPlaces(report.measures, (index) => this.#view?.focus(index)),
        ),
        element(
          'section',
          { 'aria-labelledby': 'report-measures-title' },
          element('h3', { id: 'report-measures-title', text: 'Measures' }),
          element(
            'div',
            { class: 'scroll', tabindex: '0', role: 'group', 'aria-label': 'Measures of the mesh' },
            showReportMeasures(report.measures, unit),
          ),
        ),
      ),
      showClassification(report),
      ...(report.diagnostics?.length > 0 ? [showDiagnostics(report.diagnostics)] : []),
      element(
        'p',
        { class: 'muted' },
        'Report ',
        datum(report.id, report.id),
        ', as JSON at ',
        element(
          'a',
          { href: `/api/v1/reports/${encodeURIComponent(report.id)}`, target: '_blank', rel: 'noopener' },
          element('code', { text: `/api/v1/reports/${report.id}` }),
        ),
      ),
    );
    if (report.preview) this.#look(report, picture);
  }

  async #look(report, picture) {
    try {
      const mesh = readPreview(await this.#api.bytes(report.preview.url));
      if (this.#wanted !== report.id || !picture.isConnected) return;
      this.#view = new MeshView(mesh, report);
      picture.replaceChildren(this.#view.node);
    } catch (error) {
      picture.replaceChildren(element('p', { class: 'wrong', text: `There is no view: ${error.message}` }));
    }
  }
}
