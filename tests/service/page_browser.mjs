// Starts a real browser for the test of the page, and records all requests of the page and all its errors.
import { createRequire } from 'node:module';
import path from 'node:path';

const flags = [
  '--no-sandbox',
  '--disable-gpu',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
  '--use-gl=angle',
  '--use-angle=swiftshader',
  '--enable-unsafe-swiftshader',
];

export async function openBrowser(node_modules) {
  const { chromium } = createRequire(path.resolve(node_modules, 'none.js'))('playwright-core');
  return chromium.launch({ executablePath: '/usr/bin/chromium', args: flags });
}

/**
 * Opens the page at `base` in a new browser context; records its requests, console errors, and violations of the
 * content security policy.
 */
export async function openPage(browser, base, { before = async () => {}, at = '/', ...options } = {}) {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, ...options });
  const page = await context.newPage();
  const noted = { requests: [], errors: [], violations: [] };
  page.on('request', (request) => noted.requests.push(request.url()));
  page.on('pageerror', (error) => noted.errors.push(String(error.stack)));
  page.on('console', (message) => {
    // Ignore the driver's warning that reading WebGL pixels is slow: only the test reads them.
    const ours = message.text().includes('GPU stall due to ReadPixels') || message.text().includes('too many errors');
    if (['error', 'warning'].includes(message.type()) && !ours) noted.errors.push(message.text());
  });
  await page.exposeFunction('noteViolation', (text) => noted.violations.push(text));
  await page.addInitScript(() =>
    addEventListener('securitypolicyviolation', (event) =>
      window.noteViolation(`${event.violatedDirective}: ${event.blockedURI}`),
    ),
  );
  await before(page);
  await page.goto(base + at);
  const close = async () => {
    // When the page closes, a route handler may still be replacing a response. Ignore the error of that handler.
    await page.unrouteAll({ behavior: 'ignoreErrors' });
    await context.close();
  };
  return { page, noted, close };
}

/** Drops files on the page. files: [{name, bytes}]. told(): called while the files are dragged over the page. */
export async function dropFiles(page, files, told = async () => {}) {
  const transfer = await page.evaluateHandle(
    (list) => {
      const made = new DataTransfer();
      for (const { name, text } of list)
        made.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
      return made;
    },
    files.map(({ name, bytes }) => ({ name, text: bytes.toString('base64') })),
  );
  await page.dispatchEvent('main', 'dragenter', { dataTransfer: transfer });
  await told();
  await page.dispatchEvent('main', 'dragover', { dataTransfer: transfer });
  await page.dispatchEvent('main', 'drop', { dataTransfer: transfer });
}

/** Calls send(), which uploads a file; resolves to the upload's report, once the page shows it. */
export async function uploaded(page, send) {
  const [answer] = await Promise.all([
    page.waitForResponse((response) => response.url().includes('/api/v1/validate'), { timeout: 60000 }),
    send(),
  ]);
  const { id } = await answer.json();
  await page.waitForSelector(`#report-verdict[data-report="${id}"]:is([data-state="done"], [data-state="failed"])`, {
    timeout: 60000,
  });
  return id;
}

/** Returns the number of colours in the middle of an element's picture, and a checksum for comparing pictures. */
export async function pictureOf(page, selector) {
  return page.evaluate((wanted) => {
    const canvas = document.querySelector(wanted),
      copy = document.createElement('canvas');
    [copy.width, copy.height] = [160, 120];
    const context = copy.getContext('2d');
    context.drawImage(canvas, 0, 0, 160, 120);
    const { data } = context.getImageData(0, 0, 160, 120),
      colours = new Set();
    let sum = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = data[i] * 65536 + data[i + 1] * 256 + data[i + 2];
      colours.add(colour);
      sum = (sum * 31 + colour) % 2147483647;
    }
    return { colours: colours.size, sum };
  }, selector);
}
