// Tests uploads on the page: its results against the reports of the HTTP interface, problems, hostile file names, and
// the view of the mesh.
import fs from 'node:fs';
import path from 'node:path';
import { dropFiles, openPage, pictureOf, uploaded } from './page_browser.mjs';
import { until } from './page_checks.mjs';
import { isLive } from './page_scenarios.mjs';

export const reportOf = async (base, id) => (await fetch(`${base}/api/v1/reports/${id}`)).json();
const fileOf = (file, name = path.basename(file)) => ({
  name,
  mimeType: 'application/octet-stream',
  buffer: fs.readFileSync(file),
});
export const choose = (page, ...files) => page.setInputFiles('#upload-input', files);
const surface = '#mesh-view canvas:first-child';

/** Checks that each measure that the page shows equals the report's. */
async function measuresAgree(checks, page, report) {
  const rows = await page.$$eval('[data-measure]', (all) => all.map((node) => [node.dataset.measure, node.value]));
  // The report uses some keys twice: `flat` counts triangles without area, and it also counts edges without a bend.
  // Accept either value.
  const isIts = (key, value) =>
    [report.measures[key], report.measures.histogram[key]].some((its) => value === String(its ?? ''));
  const wrong = rows.filter(([key, value]) => !isIts(key, value));
  const wanted = [
    'open_edges',
    'nonmanifold_edges',
    'turned_edges',
    'degenerate',
    'flat',
    'duplicates',
    'self_intersections',
    'folded',
    'inside_out',
    'nested',
    'slivers',
    'area',
    'volume',
    'euler',
    'genus',
    'objects',
  ];
  checks.equal("every measure shown is the report's", wrong, []);
  checks.equal(
    'no measure is missing',
    wanted.filter((key) => !rows.some(([shown]) => shown === key)),
    [],
  );
}

export async function validMesh(checks, page, base, file) {
  let veiled = false;
  const id = await uploaded(page, () =>
    dropFiles(page, [{ name: path.basename(file), bytes: fs.readFileSync(file) }], async () => {
      veiled = await page.isVisible('#drop-veil');
    }),
  );
  checks.check('files that hang over the page are seen', veiled && !(await page.isVisible('#drop-veil')));
  const report = await reportOf(base, id),
    verdict = await page.textContent('#report-verdict .headline');
  checks.check('a valid mesh, dropped, has a valid verdict', report.valid && verdict.startsWith('Valid'), verdict);
  await measuresAgree(checks, page, report);
  checks.equal('the list has it', await page.textContent(`[data-report="${id}"].link`), path.basename(file));

  const heads = await page.$$eval('.classes tbody tr', (rows) =>
    rows.map((row) => [
      row.querySelector('th').textContent,
      ...[...row.querySelectorAll('data')].map((node) => Number(node.value)),
    ]),
  );
  checks.equal(
    'classes with their MSE and EMD',
    heads,
    (report.classification?.classes ?? []).map((one) => [one.class, one.mse, one.emd]),
  );
  checks.equal(
    'the histogram stands beside a master of each class',
    await page.$$eval('.histogram', (all) => all.length),
    report.nearest_masters.length || 1,
  );
  checks.equal(
    'as many bars as bins',
    await page.$$eval('.histogram:first-child .plot .bar', (all) => all.length),
    (report.classification ?? report.measures.histogram).shares.length,
  );

  await page.waitForSelector('#mesh-view');
  await page.locator('#mesh-view').scrollIntoViewIfNeeded();
  checks.equal('the view is drawn by', await page.getAttribute('#mesh-view', 'data-renderer'), 'WebGL');
  const first = await until(async () => {
    const now = await pictureOf(page, surface);
    return now.colours > 8 && now;
  });
  checks.check('the view shows the mesh', Boolean(first), JSON.stringify(first));
  checks.check('it turns by itself', await until(async () => (await pictureOf(page, surface)).sum !== first.sum));
  return id;
}

export async function defectiveMesh(checks, page, base, file) {
  const id = await uploaded(page, () => choose(page, fileOf(file))),
    report = await reportOf(base, id),
    { measures } = report;
  const verdict = await page.textContent('#report-verdict .headline');
  checks.check('a mesh with holes is not watertight', !report.valid && verdict.includes('Not watertight'), verdict);
  await measuresAgree(checks, page, report);
  const row = await page.$eval('[data-measure="open_edges"]', (node) => node.closest('tr').textContent);
  checks.check('its open edges are a defect', measures.open_edges > 0 && row.includes('defect'), row);
  checks.equal('each place is listed', await page.$$eval('[data-place]', (all) => all.length), measures.places.length);
  await page.waitForSelector('#mesh-view[data-marked]');
  checks.equal(
    'the legend counts them',
    await page.$eval('.view [data-kind="open_edge"]', (node) => Number(node.value)),
    measures.open_edges,
  );
  const before = await pictureOf(page, surface);
  await page.click('[data-place="0"]');
  await until(async () => (await pictureOf(page, surface)).sum !== before.sum);
  const marked = await until(async () => Number(await page.getAttribute('#mesh-view', 'data-marked')) > 0);
  checks.check('the view goes to a place, and marks it', marked);
  return id;
}

export async function refusals(checks, page, noted, base, valid) {
  const bytes = fs.readFileSync(valid),
    hostile = '<img src=x onerror="window.hacked=1">&amp;.glb';
  const id = await uploaded(page, () => choose(page, { name: hostile, mimeType: '', buffer: bytes }));
  const seen = await page.evaluate(() => ({
    hacked: window.hacked,
    images: document.querySelectorAll('img[src="x"]').length,
    title: document.querySelector('#report-title .name').textContent,
  }));
  checks.equal('a hostile name is text', seen, { images: 0, title: hostile });
  checks.equal('in the list too', await page.textContent(`[data-report="${id}"].link`), hostile);

  const cut = await uploaded(page, () =>
    choose(page, { name: 'cut.glb', mimeType: '', buffer: bytes.subarray(0, bytes.length - 40) }),
  );
  const { problem } = await reportOf(base, cut),
    said = await page.textContent('#report-body .problem');
  checks.check(
    'a truncated GLB is a problem of 422',
    problem.status === 422 && said.includes('422') && said.includes(problem.code) && said.includes(problem.detail),
    said,
  );
  checks.check(
    'with where it is wrong',
    !problem.pointer || said.includes(problem.pointer),
    problem.pointer ?? 'no pointer',
  );

  const grammar = await uploaded(page, () =>
    choose(page, {
      name: 'wrong.sgm',
      mimeType: '',
      buffer: Buffer.from('sgm 1;\nstart Ball;\nrule Ball { sphere(; }\n'),
    }),
  );
  const wrong = (await reportOf(base, grammar)).problem,
    text = await page.textContent('#report-body');
  checks.check(
    'a wrong grammar says line and column',
    text.includes(`line ${wrong.line}, column ${wrong.column}`) &&
      wrong.diagnostics.every((one) => text.includes(one.message)),
    wrong.detail,
  );

  const sent = noted.requests.length;
  await choose(page, { name: 'notes.txt', mimeType: 'text/plain', buffer: Buffer.from('no mesh') });
  await page.waitForSelector('.uploads li:first-child .problem');
  const unknown = await page.textContent('.uploads li:first-child');
  checks.check(
    'an unknown type is not sent, and the page says which are taken',
    ['.glb', '.obj', '.ply', '.stl', '.sgm'].every((ending) => unknown.includes(ending)) &&
      !noted.requests.slice(sent).some((url) => url.includes('notes.txt')),
    unknown,
  );

  const other = await (
    await fetch(`${base}/api/v1/validate?name=by-program.glb`, {
      method: 'POST',
      headers: { 'Content-Type': 'model/gltf-binary' },
      body: bytes,
    })
  ).json();
  checks.check(
    'what another program sends is listed by itself',
    await until(() => page.$(`[data-report="${other.id}"]`)),
  );
}

export async function cancelling(checks, browser, base, valid) {
  const { page, close } = await openPage(browser, base, {
    before: (opened) => opened.route('**/validate?*', () => {}),
  });
  await isLive(page);
  await choose(page, fileOf(valid, 'first.glb'), fileOf(valid, 'second.glb'));
  const cancel = (name) => page.getByRole('button', { name: `Cancel: ${name}` });
  await cancel('second.glb').click();
  await cancel('first.glb').click();
  const states = await until(async () => {
    const all = await page.$$eval('.uploads .state', (nodes) => nodes.map((node) => node.textContent));
    return all.every((state) => state === 'cancelled') && all;
  });
  checks.equal('a file that waits and one under way are cancelled', states, ['cancelled', 'cancelled']);
  await close();
}

export async function withoutWebgl(checks, browser, base, id) {
  const { page, noted, close } = await openPage(browser, base, {
    reducedMotion: 'reduce',
    at: `/#report=${id}`,
    before: (opened) =>
      opened.addInitScript(() => {
        const real = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
          return kind.startsWith('webgl') ? null : real.call(this, kind, ...rest);
        };
      }),
  });
  await page.waitForSelector('#mesh-view[data-renderer="canvas"][data-marked]');
  const first = await pictureOf(page, surface);
  checks.check('without WebGL the mesh is painted', first.colours > 8, JSON.stringify(first));
  await page.waitForTimeout(1500);
  checks.equal('it does not turn where motion is unwanted', (await pictureOf(page, surface)).sum, first.sum);
  await page.focus('#mesh-view');
  await page.keyboard.press('ArrowRight');
  checks.check('but by keys', await until(async () => (await pictureOf(page, surface)).sum !== first.sum));
  checks.equal('nothing is wrong', [...noted.errors, ...noted.violations], []);
  await close();
}
