// The main script of the page: queries the service once a second and shows its state.

import { Api } from './api.js';
import { byId, element } from './element.js';
import { bytes, count, counted, duration } from './format.js';
import { History } from './history.js';
import { MapPanel } from './map_panel.js';
import { Poller } from './poller.js';
import { ReportList } from './report_list.js';
import { ReportView } from './report_view.js';
import { askToken } from './token_dialog.js';
import { UploadPanel } from './upload_panel.js';
import { makeWorldCharts, sampleOf } from './world_charts.js';
import { showFacts, showMeasures } from './world_panel.js';

const report_mark = '#report=';

const api = new Api(askToken);
const charts = makeWorldCharts();
const histories = new Map();
const map = new MapPanel(api, byId('map-body'));
const view = new ReportView(api);
const list = new ReportList(api, byId('reports-body'), openReport);
const uploads = new UploadPanel(api, byId('validate-body'), { open: openReport, finished });
const select = byId('world-select');

let summary = null;
let reports_seen = '';
let gone_since = null;
let begun = false;

function openReport(id) {
  if (location.hash === report_mark + id) showReport(id);
  else location.hash = report_mark + id;
}

/** Shows a report that the user has selected or followed a link to, and scrolls to it. */
async function showReport(id) {
  byId('report').focus({ preventScroll: true });
  byId('report').scrollIntoView({ block: 'start' });
  await view.open(id);
  // Scroll again: until the report was loaded, the page was too short to scroll it to the top.
  byId('report').scrollIntoView({ block: 'start', behavior: 'instant' });
}

function finished(upload) {
  list.refresh().catch(() => {
    reports_seen = '';
  });
  if (upload.report && upload.state !== 'cancelled') view.open(upload.report.id);
}

function showWorlds() {
  const names = summary.worlds.map(({ name }) => name);
  const shown = [...select.options].map(({ value }) => value);
  if (names.join('\n') !== shown.join('\n')) {
    const chosen = select.value;
    select.replaceChildren(...names.map((name) => element('option', { value: name, text: name })));
    if (names.includes(chosen)) select.value = chosen;
  }
  byId('world-choice').hidden = names.length === 0;
  showWorld();
}

function showWorld() {
  const world = summary?.worlds.find(({ name }) => name === select.value) ?? null;
  byId('no-world').hidden = world !== null;
  byId('world-shown').hidden = world === null;
  byId('map-and-measures').hidden = world === null;
  map.show(world?.name ?? null);
  if (!world) return;
  const { samples } = histories.get(world.name);
  showFacts(byId('world-facts'), world);
  showMeasures(byId('measures-body'), world);
  for (const chart of charts) chart.update(samples, performance.now() / 1000);
}

function showService() {
  const { service } = summary;
  byId('service-facts').textContent = [
    `SG+M ${summary.version}`,
    `up ${duration(summary.uptime_seconds)}`,
    counted(service.connections, 'connection'),
    `${bytes(service.resident_bytes)} resident`,
    service.validator
      ? `${count(service.validated)} validated, ${count(service.jobs_running)} running, ` +
        `${count(service.jobs_waiting)} of ${count(service.jobs_most_waiting)} waiting`
      : 'no validator: meshes cannot be validated here',
    `metrics for Prometheus at port ${summary.operations_port}, /metrics`,
  ].join(' · ');
  uploads.limit(service.most_upload_bytes);
  const seen = JSON.stringify([service.reports, service.validated, service.jobs_running, service.jobs_waiting]);
  if (seen !== reports_seen)
    list.refresh().then(
      () => {
        reports_seen = seen;
      },
      () => {},
    );
}

async function ask() {
  summary = await api.json('/api/v1/summary');
  const now = performance.now() / 1000;
  for (const world of summary.worlds) {
    if (!histories.has(world.name)) histories.set(world.name, new History());
    histories.get(world.name).add(sampleOf(world, now));
  }
  showWorlds();
  showService();
}

function followHash() {
  if (location.hash.startsWith(report_mark)) showReport(location.hash.slice(report_mark.length));
}

const wholeSeconds = (milliseconds) => duration(Math.max(Math.round(milliseconds / 1000), 1));

function told({ ok, error, retry }) {
  const connection = document.querySelector('.connection'),
    wants_token = error?.status === 401;
  gone_since = ok ? null : (gone_since ?? performance.now());
  connection.dataset.state = ok ? 'live' : 'gone';
  const text = ok
    ? 'Live'
    : wants_token
      ? 'The service wants a token'
      : `No news for ${wholeSeconds(performance.now() - gone_since)}: ${error.message}; ` +
        `next try in ${wholeSeconds(retry)}`;
  if (byId('connection-text').textContent !== text) byId('connection-text').textContent = text;
  byId('connection-retry').hidden = ok;
  byId('connection-retry').textContent = wants_token ? 'Enter the token' : 'Try now';
  document.body.classList.toggle('stale', !ok);
  // Follow a link to a report only now, when the sections above the report have their final height.
  if (!begun) list.refresh().then(followHash, followHash);
  begun = true;
}

const poller = new Poller(ask, 1000, told);
byId('world-charts').append(...charts.map((chart) => chart.node));
select.addEventListener('change', showWorld);
byId('connection-retry').addEventListener('click', () => {
  api.askAgain();
  poller.now();
});
addEventListener('hashchange', followHash);
poller.now();
