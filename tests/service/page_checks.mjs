// Runs checks, prints and counts their results; also has other helpers for the test of the page.

export const pause = (milliseconds) =>
  new Promise((resolve) => {
    setTimeout(resolve, milliseconds);
  });

export class Checks {
  passed = 0;
  failed = 0;

  check(name, holds, detail = '') {
    if (holds) ++this.passed;
    else ++this.failed;
    console.log(`${holds ? 'ok    ' : 'FAILED'} ${name}${detail !== '' ? `: ${detail}` : ''}`);
    return holds;
  }

  equal(name, found, wanted) {
    const [a, b] = [JSON.stringify(found), JSON.stringify(wanted)];
    return this.check(name, a === b, a === b ? a.slice(0, 120) : `${a}, not ${b}`);
  }

  /** Runs a scenario. If it throws, it counts as failed, and later scenarios still run. */
  async scenario(name, run) {
    console.log(`-- ${name}`);
    try {
      await run();
    } catch (error) {
      this.check(name, false, String(error.stack ?? error).slice(0, 1500));
    }
  }
}

/** Calls ask() until its result is true, for at most `seconds` seconds; resolves to the last result. */
export async function until(ask, seconds = 20) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const answer = await ask();
    if (answer || Date.now() > end) return answer;
    await pause(100);
  }
}

/** Parses Prometheus' text format into a list of {name, labels, value}. */
export function readMetrics(text) {
  return text
    .split('\n')
    .filter((line) => line && !line.startsWith('#'))
    .map((line) => {
      const [, name, inner, value] = /^([a-zA-Z0-9_:]+)(?:\{(.*)\})? (\S+)/.exec(line);
      const labels = Object.fromEntries(
        [...(inner ?? '').matchAll(/([a-z_]+)="((?:[^"\\]|\\.)*)"/g)].map((m) => [m[1], m[2]]),
      );
      return { name, labels, value: Number(value.replace('Inf', 'Infinity')) };
    });
}

/** Returns the sum of all series with this name and these labels; null if there are none. */
export function sumOf(samples, name, labels) {
  const found = samples.filter(
    (one) => one.name === name && Object.entries(labels).every(([key, value]) => one.labels[key] === value),
  );
  return found.length === 0 ? null : found.reduce((sum, one) => sum + one.value, 0);
}
