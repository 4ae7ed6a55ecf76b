// Tests the metrics service's page in a real browser.
//
//   node page_test.mjs BASE_URL OPERATIONS_URL VALID_MESH DEFECTIVE_MESH SCREENSHOT_DIR NODE_MODULES
//
// BASE_URL: address of a service that monitors a streaming world and measures its chunks. VALID_MESH, DEFECTIVE_MESH:
// .glb files; the second one has holes. NODE_MODULES: a folder with playwright-core. Exit status 0 if all checks pass.
import fs from 'node:fs';
import path from 'node:path';
import { openBrowser, openPage, pictureOf } from './page_browser.mjs';
import { Checks, until } from './page_checks.mjs';
import {
  chartsBesideMetrics,
  hardTimes,
  isLive,
  mapBesideInterface,
  tokens,
  worldsOtherwise,
} from './page_scenarios.mjs';
import { cancelling, choose, defectiveMesh, refusals, validMesh, withoutWebgl } from './page_uploads.mjs';

const [base_url, operations_url, valid, defective, screenshots, node_modules] = process.argv.slice(2);
if (!node_modules) {
  console.error(
    'usage: node page_test.mjs BASE_URL OPERATIONS_URL VALID_MESH DEFECTIVE_MESH SCREENSHOT_DIR NODE_MODULES',
  );
  process.exit(2);
}
const base = new URL(base_url).origin,
  operations = new URL(operations_url).origin;
const policy =
  "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; " +
  "base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
fs.mkdirSync(screenshots, { recursive: true });
const checks = new Checks();
const browser = await openBrowser(node_modules);
const picture = (page, name, selector = null) =>
  (selector ? page.locator(selector) : page).screenshot({ path: path.join(screenshots, `${name}.png`) });

const isQuiet = (noted) => {
  checks.equal(
    'nothing is asked of another server',
    noted.requests.filter((url) => new URL(url).origin !== base && !/^(data|blob):/.test(url)),
    [],
  );
  checks.equal('nothing breaks the policy', noted.violations, []);
  checks.equal('no error in the console', noted.errors, []);
};

/**
 * Moves the focus through the page with the Tab key; returns the ids, or other names, of the focused elements in order.
 */
async function tabThrough(page, most = 90) {
  const passed = [];
  for (let i = 0; i < most; ++i) {
    await page.keyboard.press('Tab');
    const at = await page.evaluate(() => {
      const node = document.activeElement;
      return (
        node.id ||
        node.closest('figure')?.id ||
        node.dataset.report ||
        node.dataset.place ||
        node.textContent.trim().slice(0, 20) ||
        node.tagName
      );
    });
    if (at.includes('SG+M')) break; // stop: the focus is past the last element, on the body
    passed.push(at);
  }
  return passed;
}

async function keyboard(id) {
  // A busy browser may report several changes of an element's visibility in one call. Makes each call here begin with
  // an outdated change.
  const reportOutdated = (opened) =>
    opened.addInitScript(() => {
      window.IntersectionObserver = class extends IntersectionObserver {
        constructor(observe, options) {
          super((changes) => observe([{ isIntersecting: !changes.at(-1).isIntersecting }, ...changes]), options);
        }
      };
    });
  const { page, noted, close } = await openPage(browser, base, { before: reportOutdated });
  await isLive(page);
  // Focuses an element in view. The page scrolls smoothly: a scroll that earlier key presses have caused could continue
  // and move the element out of view, where the mesh is not drawn.
  const focusInView = async (selector) => {
    await page.focus(selector);
    await page.$eval(selector, (node) => node.scrollIntoView({ behavior: 'instant', block: 'center' }));
  };
  await page.$eval('#map', (node) => node.scrollIntoView({ behavior: 'instant' }));
  await page.waitForSelector('.levels data');
  await until(() => page.$(`[data-report="${id}"].link`));
  const reaches = async (wanted) => {
    const passed = await tabThrough(page),
      order = wanted.map((one) => passed.indexOf(one));
    checks.equal(
      'Tab reaches all that can be used',
      wanted.filter((one) => !passed.includes(one)),
      [],
    );
    checks.check(
      'in the order of the page',
      order.every((at, i) => i === 0 || at > order[i - 1]),
      order.join(', '),
    );
  };
  await reaches([
    'Skip to the content',
    'world-select',
    'chart-per_second',
    'map-all',
    'map-canvas',
    'upload-input',
    id,
  ]);

  await page.focus('#chart-waiting svg[role="slider"]');
  await page.keyboard.press('ArrowLeft');
  checks.check(
    'a chart is read by keys',
    (await page.textContent('#chart-waiting .readout')).includes('s ago: waiting'),
  );
  await focusInView('#map-canvas');
  const before = await pictureOf(page, '#map-canvas');
  await page.keyboard.press('+');
  await page.keyboard.press('ArrowLeft');
  checks.check(
    'the map moves by keys',
    await until(async () => (await pictureOf(page, '#map-canvas')).sum !== before.sum),
  );
  let chooser = null;
  page.on('filechooser', (opened) => {
    chooser = opened;
  });
  await page.focus('#upload-input');
  // Wait until the browser has registered the listener; before, it would open its own file chooser.
  await page.waitForTimeout(500);
  await page.keyboard.press('Space');
  checks.check('space asks for files', await until(() => chooser?.isMultiple()));
  await page.focus(`[data-report="${id}"].link`);
  await page.keyboard.press('Enter');
  checks.check(
    'Enter opens a report',
    await until(() => page.evaluate(() => document.activeElement.id === 'report')),
  );
  await page.waitForSelector('#mesh-view[data-marked]');
  await reaches(['mesh-view', '0', 'histogram-scale']);
  await focusInView('#mesh-view');
  await page.keyboard.press(' ');
  await page.waitForTimeout(300);
  const still = await pictureOf(page, '#mesh-view canvas:first-child');
  await page.keyboard.press('ArrowUp');
  checks.check(
    'the view turns by keys',
    await until(async () => (await pictureOf(page, '#mesh-view canvas:first-child')).sum !== still.sum),
    await page.evaluate(() => {
      const { top, bottom } = document.querySelector('#mesh-view').getBoundingClientRect();
      return `focus: ${document.activeElement.id || document.activeElement.tagName}, from ${top} to ${bottom} of ${innerHeight}`;
    }),
  );
  isQuiet(noted);
  await close();
}

async function phone(id) {
  const { page, noted, close } = await openPage(browser, base, {
    viewport: { width: 360, height: 740 },
    hasTouch: true,
    isMobile: true,
    at: `/#report=${id}`,
  });
  await isLive(page);
  await page.waitForSelector('#mesh-view[data-marked]');
  await choose(page, {
    name: `${'long-name-without-a-place-to-break-'.repeat(5)}.txt`,
    mimeType: '',
    buffer: Buffer.from('x'),
  });
  await page.waitForSelector('.uploads .problem');
  checks.check(
    'nothing is wider than a phone',
    await page.evaluate(() => document.documentElement.scrollWidth <= 360),
    await page.evaluate(() => document.documentElement.scrollWidth),
  );
  const clipped = await page.$$eval('.scroll', (all) =>
    all.filter((node) => node.scrollWidth > node.clientWidth).map((node) => node.getAttribute('aria-label')),
  );
  checks.equal('no table is wider than its card', clipped, []);
  const small = await page.$$eval('button, nav a, select, summary, .button, .check', (all) =>
    all
      .filter(
        (node) =>
          node.offsetParent &&
          (node.getBoundingClientRect().height < 43.5 || node.getBoundingClientRect().width < 43.5),
      )
      .map((node) => node.textContent.trim()),
  );
  checks.equal('fingers can hit every control', small, []);
  for (const [name, selector] of [
    ['phone', '#world'],
    ['phone_map', '#map'],
    ['phone_report', '#report'],
  ]) {
    await page.$eval(selector, (node) => node.scrollIntoView({ behavior: 'instant' }));
    await page.waitForTimeout(500);
    await picture(page, name);
  }
  noted.errors = noted.errors.filter((line) => !line.includes('415'));
  isQuiet(noted);
  await close();
}

async function dark(id) {
  const { page, noted, close } = await openPage(browser, base, {
    colorScheme: 'dark',
    viewport: { width: 1400, height: 1500 },
    at: `/#report=${id}`,
  });
  await isLive(page);
  await page.waitForSelector('#mesh-view[data-marked]');
  const light = await page.evaluate(() =>
    ['backgroundColor', 'color'].map((key) =>
      Math.max(...getComputedStyle(document.body)[key].match(/\d+/g).slice(0, 3).map(Number)),
    ),
  );
  checks.check('dark where dark is wished', light[0] < 60 && light[1] > 200, light.join(', '));
  await page.waitForTimeout(1000);
  await picture(page, 'dark_report');
  await page.$eval('#world', (node) => node.scrollIntoView({ behavior: 'instant' }));
  await page.waitForTimeout(800);
  await picture(page, 'dark');
  isQuiet(noted);
  await close();
}

await checks.scenario('headers', async () => {
  for (const file of ['/', '/page.css', '/main.js', '/icon.svg']) {
    const { status, headers } = await fetch(base + file);
    checks.equal(
      `${file} is there, and no other type`,
      [status, headers.get('x-content-type-options')],
      [200, 'nosniff'],
    );
    if (file === '/') checks.equal('the policy of the page', headers.get('content-security-policy'), policy);
  }
});

let id = null;
const { page, noted, close } = await openPage(browser, base, { viewport: { width: 1400, height: 1700 } });
await checks.scenario('charts', async () => {
  await isLive(page);
  await page.waitForTimeout(3000);
  const summary = await (await fetch(`${base}/api/v1/summary`)).json();
  checks.equal(
    'the selector has the worlds',
    await page.$$eval('#world-select option', (all) => all.map((one) => one.value)),
    summary.worlds.map((one) => one.name),
  );
  await chartsBesideMetrics(checks, page, operations);
  await picture(page, 'overview');
});
await checks.scenario('map', async () => {
  await mapBesideInterface(checks, page);
  await picture(page, 'map', '#map');
});
await checks.scenario('a valid mesh', async () => {
  await validMesh(checks, page, base, valid);
  await picture(page, 'report', '#report');
});
await checks.scenario('a defective mesh', async () => {
  id = await defectiveMesh(checks, page, base, defective);
  await page.waitForTimeout(1000);
  await picture(page, 'defects', '#report');
});
await checks.scenario('refusals', () => refusals(checks, page, noted, base, valid));
isQuiet(noted);
await close();
await checks.scenario('cancelling', () => cancelling(checks, browser, base, valid));
await checks.scenario('keyboard', () => keyboard(id));
await checks.scenario('phone', () => phone(id));
await checks.scenario('dark', () => dark(id));
await checks.scenario('without WebGL', () => withoutWebgl(checks, browser, base, id));
await checks.scenario('worlds otherwise', () => worldsOtherwise(checks, browser, base));
await checks.scenario('hard times', () => hardTimes(checks, browser, base));
await checks.scenario('tokens', () => tokens(checks, browser, base));
await browser.close();
console.log(`${checks.passed} checks hold, ${checks.failed} do not`);
process.exit(checks.failed === 0 ? 0 : 1);
