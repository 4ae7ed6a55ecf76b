// Tests the page's view of worlds: its charts against /metrics, its map against the HTTP interface, and its behaviour
// when the service fails.
import { openPage, pictureOf } from './page_browser.mjs';
import { pause, readMetrics, sumOf, until } from './page_checks.mjs';

export const isLive = (page) => page.waitForSelector('.connection[data-state="live"]', { timeout: 30000 });
const shown = (page, series) =>
  page.$eval(`[data-series="${series}"]`, (node) => (node.value === '' ? null : Number(node.value)));

/** Reads from /metrics, every 120 ms for some seconds, the values that the page's charts show. */
async function scrape(operations, seconds, world) {
  const scrapes = [],
    end = Date.now() + 1000 * seconds;
  while (Date.now() < end) {
    const response = await fetch(`${operations}/metrics`);
    const samples = readMetrics(await response.text());
    const one = (name, labels = {}) => sumOf(samples, name, { world, ...labels });
    scrapes.push({
      time: Date.now() / 1000,
      built: one('sgm_chunks_built_total', { result: 'meshed' }),
      waiting: one('sgm_queue_depth', { stage: 'waiting' }),
      in_work: one('sgm_queue_depth', { stage: 'in_work' }),
      mesh_bytes: one('sgm_mesh_bytes'),
      collider_bytes: one('sgm_collider_bytes'),
      defects: one('sgm_mesh_defects_total'),
      failed: one('sgm_chunks_built_total', { result: 'failed' }),
      drawn: one('sgm_chunks_drawn'),
      kept: one('sgm_chunks_kept'),
      mean_ms: (1000 * one('sgm_world_update_seconds_sum')) / one('sgm_world_update_seconds_count'),
      buckets: samples
        .filter((s) => s.name === 'sgm_world_update_seconds_bucket' && s.labels.world === world)
        .map((s) => ({ to: 1000 * Number(s.labels.le.replace('Inf', 'Infinity')), count: s.value }))
        .sort((a, b) => a.to - b.to),
    });
    await pause(120);
  }
  return scrapes;
}

/** Returns the bounds, in milliseconds, of the histogram bucket that contains the given quantile of update times. */
function bracket(buckets, share) {
  const wanted = share * (buckets.at(-1)?.count ?? 0),
    i = buckets.findIndex((bucket) => bucket.count >= wanted);
  return i < 0 ? null : [i === 0 ? 0 : buckets[i - 1].to, buckets[i].to];
}

export async function chartsBesideMetrics(checks, page, operations) {
  const world = await page.$eval('#world-select', (select) => select.value);
  const scrapes = await scrape(operations, 6, world);
  const keys = [
    'waiting',
    'in_work',
    'mesh_bytes',
    'collider_bytes',
    'defects',
    'failed',
    'drawn',
    'kept',
    'per_second',
    'p50_ms',
    'p99_ms',
  ];
  const values = Object.fromEntries(await Promise.all(keys.map(async (key) => [key, await shown(page, key)])));
  const note = await page.textContent('#chart-p50_ms-note');
  for (const key of ['waiting', 'in_work', 'mesh_bytes', 'collider_bytes', 'defects', 'failed', 'drawn', 'kept']) {
    const seen = [...new Set(scrapes.map((one) => one[key]))];
    checks.check(
      `chart ${key} shows what /metrics says`,
      seen.includes(values[key]),
      `${values[key]} among ${seen.slice(-8).join(', ')}`,
    );
  }
  // The page shows the rate over the last few seconds, which must lie within the range of the rates over all intervals
  // of 2 s to 6 s.
  const rates = scrapes.flatMap((a) =>
    scrapes.filter((b) => b.time - a.time > 2).map((b) => (b.built - a.built) / (b.time - a.time)),
  );
  const [low, high] = [Math.min(...rates), Math.max(...rates)];
  checks.check(
    'chart per_second fits sgm_chunks_built_total',
    values.per_second >= 0.6 * low - 3 && values.per_second <= 1.6 * high + 3,
    `${values.per_second} beside ${low} to ${high}`,
  );
  const mean = Number(/mean ([\d.e-]+) ms/.exec(note)?.[1]);
  checks.check(
    'the mean time of an update is that of /metrics',
    scrapes.some((one) => Math.abs(one.mean_ms - mean) <= 0.01 * mean),
    `${mean} ms beside ${scrapes.at(-1).mean_ms} ms`,
  );
  for (const [key, share] of [
    ['p50_ms', 0.5],
    ['p99_ms', 0.99],
  ]) {
    const brackets = scrapes.map((one) => bracket(one.buckets, share)).filter(Boolean);
    checks.check(
      `chart ${key} lies in the bucket of /metrics`,
      brackets.some(([from, to]) => values[key] >= 0.99 * from && values[key] <= 1.01 * to),
      `${values[key]} in ${JSON.stringify(brackets.at(-1))}`,
    );
  }
}

export async function mapBesideInterface(checks, page) {
  await page.locator('#map').scrollIntoViewIfNeeded();
  await page.locator('#map-body').getByRole('button', { name: 'Show all' }).click();
  const isChunks = (response) => response.url().endsWith('/chunks') && response.ok();
  const told = await (await page.waitForResponse(isChunks, { timeout: 15000 })).json();
  const read = () =>
    page.evaluate(() => ({
      total: Number(document.querySelector('#map-total').value),
      legend: [...document.querySelectorAll('.levels data')].reduce((sum, node) => sum + Number(node.value), 0),
      drawn: Number(document.querySelector('#map-canvas').dataset.drawn),
    }));
  const map =
    (await until(async () => {
      const now = await read();
      return now.total === told.total && now.drawn === told.chunks.length && now;
    }, 1.5)) || (await read());
  checks.check('there are chunks to show', told.total > 0, told.total);
  checks.equal('the map shows as many chunks as the interface says', map, {
    total: told.total,
    legend: told.chunks.length,
    drawn: told.chunks.length,
  });
  checks.check('the map is no blank picture', (await pictureOf(page, '#map-canvas')).colours > 3);
  await page.uncheck('#map-all');
  const slice = await until(async () => {
    const { drawn } = await read();
    return drawn < map.drawn && drawn;
  }, 5);
  checks.check('one height has fewer chunks', slice > 0 && slice < map.drawn, `${slice} of ${map.drawn}`);
  await page.check('#map-all');
}

/** Replaces the JSON in responses to the page's requests for `path` by change(json). */
const changed = (page, path, change) =>
  page.route(path, async (route) => {
    const response = await route.fetch();
    const json = await response.json();
    await route.fulfill({ response, json: change(json) ?? json });
  });

export async function hardTimes(checks, browser, base) {
  const { page, close } = await openPage(browser, base);
  await isLive(page);
  await page.route('**/api/v1/**', (route) => route.abort());
  const said = await until(async () => {
    const text = await page.textContent('#connection-text');
    return text.includes('No news') && text;
  });
  checks.check('it says that the service is gone', Boolean(said), said);
  await page.unroute('**/api/v1/**');
  await isLive(page);
  checks.check('it finds the service again by itself', true);

  let asked = 0;
  const hide = (hidden) =>
    page.evaluate((value) => {
      Object.defineProperty(document, 'hidden', { value, configurable: true });
      document.dispatchEvent(new Event('visibilitychange'));
    }, hidden);
  await hide(true);
  await pause(1500);
  page.on('request', () => ++asked);
  await pause(3500);
  checks.equal('it asks nothing while the tab is hidden', asked, 0);
  await hide(false);
  checks.check('it asks again once the tab is seen', await until(() => asked > 0));
  await close();
}

export async function worldsOtherwise(checks, browser, base) {
  const without = await openPage(browser, base, {
    before: (page) =>
      changed(page, '**/summary', (json) => {
        for (const world of json.worlds) world.measures = null;
      }),
  });
  await isLive(without.page);
  const hint = await without.page.textContent('#measures-body');
  checks.check(
    'a world without measures says how to get them',
    hint.includes('SGM_WORLD_MEASURE') && hint.includes('sgm fly --measure'),
  );
  await without.close();

  const none = await openPage(browser, base, {
    before: (page) => changed(page, '**/summary', (json) => ({ ...json, worlds: [] })),
  });
  await isLive(none.page);
  checks.check(
    'no world: the page says how to get one',
    (await none.page.isVisible('#no-world')) && !(await none.page.isVisible('#map')),
  );
  await none.close();

  const two = await openPage(browser, base, {
    before: async (page) => {
      await changed(page, '**/summary', (json) => ({
        ...json,
        worlds: [...json.worlds, { ...json.worlds[0], name: 'other', queue: { waiting: 4711, in_work: 0, stale: 0 } }],
      }));
      await page.route('**/worlds/other/chunks', (route) => route.fulfill({ json: manyChunks() }));
    },
  });
  await isLive(two.page);
  await two.page.locator('#world-select').focus();
  const names = await two.page.$$eval('#world-select option', (all) => all.map((one) => one.value));
  await two.page.keyboard.press('End');
  checks.check(
    'the selector shows another world, by keyboard',
    await until(async () => (await shown(two.page, 'waiting')) === 4711),
    names.join(', '),
  );
  await two.page.locator('#map-canvas').scrollIntoViewIfNeeded();
  checks.check(
    '20,000 chunks are all drawn',
    await until(() => two.page.$eval('#map-canvas', (node) => node.dataset.drawn === '20000'), 10),
  );
  const milliseconds = await two.page.evaluate(async () => {
    const canvas = document.querySelector('#map-canvas'),
      began = performance.now();
    for (let i = 0; i < 10; ++i) {
      canvas.dispatchEvent(new KeyboardEvent('keydown', { key: i % 2 ? 'ArrowLeft' : 'ArrowRight' }));
      await new Promise((done) => {
        requestAnimationFrame(() => requestAnimationFrame(done));
      });
    }
    return (performance.now() - began) / 10;
  });
  checks.check('20,000 chunks move in less than 0.4 s a picture', milliseconds < 400, `${milliseconds.toFixed(1)} ms`);
  await two.close();
}

function manyChunks() {
  const chunks = Array.from({ length: 20000 }, (_, i) => [
    i < 10000 ? 0 : 1,
    i % 100,
    0,
    Math.floor((i % 10000) / 100),
    100,
  ]);
  return {
    name: 'other',
    frame: 1,
    cell_meters: 0.5,
    chunk_cells: 32,
    viewers: [{ position: [800, 5, 800], direction: [1, 0, 0] }],
    total: 25000,
    truncated: true,
    chunks,
  };
}

export async function tokens(checks, browser, base) {
  const token = 'right-and-long-enough';
  const { page, noted, close } = await openPage(browser, base, {
    before: (opened) =>
      opened.route('**/api/v1/**', (route) =>
        route.request().headers().authorization === `Bearer ${token}`
          ? route.continue()
          : route.fulfill({
              status: 401,
              contentType: 'application/problem+json',
              body: '{"status":401,"code":"no_token","detail":"a token is needed"}',
            }),
      ),
  });
  await page.waitForSelector('#token-dialog[open]');
  await page.keyboard.type('wrong');
  await page.keyboard.press('Enter');
  await page.waitForSelector('#token-wrong:not([hidden])');
  await page.keyboard.type(token);
  await page.keyboard.press('Enter');
  await isLive(page);
  checks.equal(
    'a token is asked for, and kept for the tab',
    await page.evaluate(() => [...Object.values(sessionStorage), ...Object.values(localStorage)]),
    [token],
  );
  checks.check(
    'the token is in no address',
    noted.requests.every((url) => !url.includes(token)),
  );
  await page.reload();
  await isLive(page);
  checks.check('it is not asked for again', !(await page.isVisible('#token-dialog')));
  await close();
}
