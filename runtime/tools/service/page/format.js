// Formats numbers for users.

const whole = new Intl.NumberFormat('en', { maximumFractionDigits: 0 });
const significant = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9].map(
  (digits) => new Intl.NumberFormat('en', { maximumSignificantDigits: Math.max(digits, 1) }),
);

export const nothing = '–';
const known = (value) => typeof value === 'number' && Number.isFinite(value);

export const count = (value) => (known(value) ? whole.format(value) : nothing);

/**
 * A number as text with `digits` significant digits, at most 9. Very small and very large numbers are written with a
 * power of ten.
 */
export function number(value, digits = 4) {
  if (!known(value)) return nothing;
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e12)) return value.toExponential(digits - 1);
  return size >= 10 ** digits ? whole.format(value) : significant[digits].format(value);
}

export const percent = (ratio, digits = 3) => (known(ratio) ? `${number(100 * ratio, digits)} %` : nothing);

const units = ['B', 'KiB', 'MiB', 'GiB', 'TiB'];
export function byteUnit(value) {
  let unit = 0;
  while (unit + 1 < units.length && Math.abs(value) >= 1024 ** (unit + 1)) ++unit;
  return { name: units[unit], size: 1024 ** unit };
}
export function bytes(value) {
  if (!known(value)) return nothing;
  const unit = byteUnit(value);
  return `${number(value / unit.size, 3)} ${unit.name}`;
}

export function duration(seconds) {
  if (!known(seconds)) return nothing;
  if (seconds < 1) return `${number(seconds * 1000, 3)} ms`;
  if (seconds < 60) return `${number(seconds, 3)} s`;
  const [days, hours, minutes] = [seconds / 86400, (seconds / 3600) % 24, (seconds / 60) % 60].map(Math.floor);
  if (days > 0) return `${days} d ${hours} h`;
  return hours > 0 ? `${hours} h ${minutes} min` : `${minutes} min ${Math.floor(seconds % 60)} s`;
}

/** A number and its noun: `one` if the number is 1, otherwise `many`. */
export const counted = (value, one, many = `${one}s`) => `${count(value)} ${value === 1 ? one : many}`;

export const place = (at) => at.map((x) => number(x, 4)).join(', ');

export function clock(text) {
  const time = new Date(text);
  if (Number.isNaN(time.getTime())) return nothing;
  const today = time.toDateString() === new Date().toDateString();
  return today ? time.toLocaleTimeString() : time.toLocaleString();
}

/** Rounds up to the next number of the form 1, 2, 2.5 or 5 times a power of ten, for the ticks of an axis. */
export function niceStep(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  for (const step of [1, 2, 2.5, 5]) if (step * power >= value * (1 - 1e-9)) return step * power;
  return 10 * power;
}
