// Checks and converts the dashboard of samples/monitoring for its tests.
//
//   node dashboard.mjs check METRICS DASHBOARD ALERTS   prints errors, one per line; status 1 if there are any
//   node dashboard.mjs rules DASHBOARD                  prints its expressions as recording rules, for promtool
//   node dashboard.mjs expressions DASHBOARD RANGE      prints its expressions that have a value for a world on the CPU
import { readFileSync } from 'node:fs';

// Metrics that worlds on the CPU do not have.
const ofDevices = { sgm_gpu_memory_bytes: ['world', 'heap'], sgm_device_lost_total: ['world'] };
// Metrics that Prometheus itself adds.
const ofPrometheus = { up: [], ALERTS: ['alertname', 'alertstate', 'world'] };
// Metrics that need no panel. The number of worlds is visible as the number of lines in the other panels.
const notShown = ['sgm_worlds'];

const [mode, ...files] = process.argv.slice(2);
const dashboardFile = mode === 'check' ? files[1] : files[0];
const dashboard = JSON.parse(readFileSync(dashboardFile, 'utf8'));
const shown = dashboard.panels.filter((panel) => panel.type !== 'row');
const targets = shown.flatMap((panel) => panel.targets.map((target) => ({ where: panel.title, ...target })));

function plain(expr, range) {
  return expr.replaceAll('$__rate_interval', range).replaceAll('$instance', '.*').replaceAll('$world', '.*');
}

// Parses the text of /metrics. Returns, for each metric's name, a map from each label to the set of its values (null:
// any value).
function metricsOf(text) {
  const metrics = new Map();
  for (const [, name, , labels] of text.matchAll(/^([a-z_]+)(\{(.*)\})? \S+$/gm)) {
    if (!metrics.has(name)) metrics.set(name, new Map());
    const known = metrics.get(name);
    for (const [, label, value] of (labels ?? '').matchAll(/(\w+)="([^"]*)"/g)) {
      if (!known.has(label)) known.set(label, new Set());
      known.get(label).add(value);
    }
  }
  for (const [name, labels] of Object.entries({ ...ofDevices, ...ofPrometheus }))
    if (!metrics.has(name)) metrics.set(name, new Map(labels.map((label) => [label, null])));
  for (const known of metrics.values()) for (const label of ['job', 'instance']) known.set(label, null);
  return metrics;
}

function groupingsOf(expr) {
  return [...expr.matchAll(/\b(?:by|on) \(([^)]*)\)/g)].flatMap(([, labels]) => labels.split(/, */));
}

// Reports every metric, label and label value that a panel's expression uses although it does not exist.
function checkExpression(where, expr, metrics, used, say) {
  const selectors = [...expr.matchAll(/\b((?:sgm|process)_\w+|up|ALERTS)\b(?:\{([^}]*)\})?/g)];
  if (selectors.length === 0) say(where, `${expr} asks for nothing`);
  for (const [, name, matchers] of selectors) {
    const known = metrics.get(name);
    used.add(name);
    if (!known) {
      say(where, `/metrics has no ${name}`);
      continue;
    }
    for (const label of groupingsOf(expr)) if (!known.has(label)) say(where, `${name} has no label ${label}`);
    for (const [, label, , value] of (matchers ?? '').matchAll(/(\w+)(=~|!~|!=|=)"([^"]*)"/g)) {
      if (!known.has(label)) say(where, `${name} has no label ${label}`);
      const values = known.get(label);
      if (!values || /[$.]/.test(value)) continue;
      for (const one of value.split('|')) if (!values.has(one)) say(where, `${name} has no ${label} ${one}`);
    }
  }
}

function checkPanels(say) {
  const ids = new Set(), titles = new Set(), cells = new Map();
  for (const panel of dashboard.panels) {
    const { x, y, w, h } = panel.gridPos, where = panel.title;
    if (ids.has(panel.id)) say(where, `the id ${panel.id} is another panel's`);
    if (titles.has(panel.title)) say(where, 'the title is another panel\'s');
    ids.add(panel.id);
    titles.add(panel.title);
    const onGrid = [x, y, w, h].every(Number.isInteger) && x >= 0 && y >= 0 && w > 0 && h > 0 && x + w <= 24;
    if (!onGrid) say(where, 'off the grid');
    for (let row = y; row < y + h; ++row)
      for (let column = x; column < x + w; ++column) {
        const cell = row * 24 + column;
        if (cells.has(cell)) return say(where, `lies on ${cells.get(cell)}`);
        cells.set(cell, panel.title);
      }
  }
  for (const panel of shown) {
    const where = panel.title, defaults = panel.fieldConfig?.defaults;
    if (!panel.description) say(where, 'no description');
    if (!defaults?.unit) say(where, 'no unit');
    if (!defaults?.thresholds?.steps?.length) say(where, 'no thresholds');
    if (!panel.targets?.length) say(where, 'no targets');
    if (new Set(panel.targets.map((target) => target.refId)).size !== panel.targets.length) say(where, 'a refId twice');
    for (const { datasource } of [panel, ...panel.targets])
      if (datasource?.type !== 'prometheus' || datasource.uid !== '${datasource}')
        say(where, 'not of the chosen data source');
  }
}

function check(metricsText, alertsText) {
  const wrong = [], used = new Set(), metrics = metricsOf(metricsText);
  const say = (where, what) => wrong.push(`${where}: ${what}`);
  const variables = dashboard.templating.list;
  checkPanels(say);
  if (dashboard.schemaVersion !== 38) say('dashboard', 'not of the schema of Grafana 10');
  for (const [name, type] of [['datasource', 'datasource'], ['world', 'query']])
    if (!variables.some((one) => one.name === name && one.type === type)) say('dashboard', `no ${name} to choose`);
  for (const { where, expr, legendFormat } of targets) {
    checkExpression(where, expr, metrics, used, say);
    for (const [, label] of legendFormat.matchAll(/\{\{(\w+)\}\}/g))
      if (!groupingsOf(expr).includes(label)) say(where, `the legend's ${label} is not in ${expr}`);
    for (const [, name] of expr.matchAll(/\$(\w+)/g))
      if (name !== '__rate_interval' && !variables.some((one) => one.name === name)) say(where, `no variable ${name}`);
  }
  for (const { name, query } of variables.filter((one) => one.type === 'query')) {
    const [, selector, label] = /^label_values\((.*), (\w+)\)$/.exec(query.query) ?? [];
    if (!selector) say(name, 'not label_values(METRIC, LABEL)');
    else checkExpression(name, `sum by (${label}) (${selector})`, metrics, used, say);
  }
  for (const { name, expr } of dashboard.annotations.list) if (expr) checkExpression(name, expr, metrics, used, say);

  const alerts = [...alertsText.matchAll(/- alert: (\w+)\n +expr: (?:>-\n)?([^]*?)\n +(?:for|labels):/g)];
  if (alerts.length !== alertsText.split('- alert:').length - 1) say('alerts', 'not all of them are read');
  for (const [, name, expr] of alerts) checkExpression(name, expr, metrics, used, say);
  for (const name of Object.keys(ofPrometheus)) if (!used.has(name)) say(name, 'nobody asks for it');
  const family = (name) => name.replace(/_(bucket|sum|count)$/, '');
  const families = new Set([...used].map(family));
  for (const name of metrics.keys())
    if (!families.has(family(name)) && !notShown.includes(name)) say(name, 'is in /metrics, but nobody asks for it');
  return wrong;
}

if (mode === 'check') {
  const wrong = check(readFileSync(files[0], 'utf8'), readFileSync(files[2], 'utf8'));
  for (const line of wrong) console.log(line);
  process.exit(wrong.length === 0 ? 0 : 1);
} else if (mode === 'rules') {
  const rules = targets.map(({ expr }, i) => ({ record: `dashboard:${i}`, expr: plain(expr, '1m') }));
  console.log(JSON.stringify({ groups: [{ name: 'dashboard', rules }] }));
} else {
  const ofCpu = ({ expr }) => !Object.keys(ofDevices).some((name) => expr.includes(name));
  for (const target of targets.filter(ofCpu)) console.log(plain(target.expr, files[1]));
}
