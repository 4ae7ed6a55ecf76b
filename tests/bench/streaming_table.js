// Compares the reports of the flights and crowds of streaming.sh with the targets: writes streaming.csv and
// streaming.svg, and prints a table. Exit status 1 if a flight has no report or a surface was not closed.
'use strict';
const fs = require('fs');
const path = require('path');

const folder = process.argv[2];
const read = (ending) => fs.readdirSync(folder).filter((name) => name.endsWith(ending)).sort().map((name) =>
  ({ name: name.split('.')[0], ...JSON.parse(fs.readFileSync(path.join(folder, name), 'utf8')) }));
const flights = read('.flight.json');
const crowds = read('.crowd.json');

const percent = (share) => 100 * share;
const never = (ms) => (ms < 0 ? Infinity : ms);
const unclosed = (r) => (r.checked ? r.open_edges + r.nonmanifold_edges + r.overlaps + r.whole_failures : Infinity);
// The rows of the table. line: name; of: names of the flights that it uses; value: the value in a report (null:
// missing; undefined: there was nothing to measure); most, least: the target, as an upper or a lower bound; unit.
const lines = [
  { line: 'caller\'s thread, 99 % of frames', of: /^walk/, value: (r) => r.main_thread_ms.p99, most: 1, unit: 'ms' },
  { line: 'caller\'s thread, longest frame', of: /^walk/, value: (r) => r.main_thread_ms.max, most: 2, unit: 'ms' },
  { line: 'frames with level 0 within 24 m, 20 m/s', of: /^walk/, value: (r) => percent(r.lod0_covered_frames),
    least: 100, unit: '%' },
  { line: 'time to walkable', of: /^walk/, value: (r) => never(r.time_to_walkable_ms), most: 500, unit: 'ms' },
  { line: 'chunks meshed in vain, 20 m/s', of: /^walk/, value: (r) => percent(r.wasted_fraction), most: 10, unit: '%' },
  { line: 'frames with level 0 within 24 m, 60 m/s', of: /^fast/, value: (r) => percent(r.lod0_covered_frames),
    least: 99, unit: '%' },
  { line: 'chunks meshed in vain, 60 m/s', of: /^fast/, value: (r) => percent(r.wasted_fraction), most: 10, unit: '%' },
  { line: 'level 0 saved by reachability', of: /^reach/, value: (r) => percent(r.finest_saved), least: 40, unit: '%',
    more: (r) => `${r.finest_meshed} chunks instead of ${r.finest_meshed_by_distance}` },
  { line: 'stale work gone 2 frames after a leap', of: /^leaps/, least: 95, unit: '%',
    // On a busy machine, the queue may be empty at every teleport: then there is nothing to measure (undefined).
    value: (r) => (r.work_at_teleports.every((work) => work === 0) ? undefined
      : r.stale_after_2_frames && percent(1 - r.stale_after_2_frames.worst)),
    more: (r) => `work at the leaps: ${r.work_at_teleports.join(' ')}` },
  { line: 'changes of what is drawn until a dig is', of: /^digs/, value: (r) => (r.digs > 0 ? r.dig_frames.max : null),
    most: 2, unit: '', more: (r) => `${r.digs} digs` },
  // This row has no target; it shows that the number does not grow with the number of digs.
  { line: 'chunks that waited while digging', of: /^digs/, value: (r) => r.most_queued_while_digging, unit: '' },
  { line: '64 walkers see cells of 4 m within 32 m', of: /^crowd$/, value: (r) => never(r.all_drawn_s), most: 10,
    unit: 's' },
  { line: 'chunks in 8 s of 32 worlds at 125 Hz', of: /^worlds$/, value: (r) => r.chunks - r.in_vain, least: 8000,
    unit: '', more: (r) => `planning ${r.plan_seconds} s, meshing ${r.mesh_seconds} s` },
  { line: 'chunks in 10 s of 4 fast viewers, 80 edits/s', of: /^edits$/, value: (r) => r.chunks - r.in_vain, least: 4000,
    unit: '', more: (r) => `the slowest sees cells of 4 m from ${r.first_drawn_s} s on` },
  { line: 'level 0 after 2 s of 65,536 bytes a frame', of: /^budget$/, value: (r) => never(r.level_0_back_s), most: 1,
    unit: 's', more: (r) => `${r.level_0} of ${r.level_0_wanted} chunks, ${r.failed} failed` },
  { line: 'colliders that replaced an equal one', of: /^colliders$/, value: (r) => r.equal_colliders, most: 0, unit: '',
    more: (r) => `of ${r.colliders}, at most ${r.most_colliders_a_frame} a frame` },
  { line: 'memory over new ground after a sixth of it', of: /^far$/, most: 1.05, unit: 'of before',
    value: (r) => r.resident_mb_later / r.resident_mb_first_sixth,
    more: (r) => `${r.resident_mb_first_sixth}, then ${r.resident_mb_later} MB on ${r.metres} m` },
  { line: 'open, non-manifold and overlapping edges', of: /^closed_/, value: unclosed, most: 0, unit: '',
    more: (r, all) => `${sum(all, 'frames')} frames, ${sum(all, 'commits')} changes of what is drawn` },
];

function sum(reports, what) {
  return reports.reduce((total, report) => total + report[what], 0);
}
const text = (x) => (x === Infinity ? 'never' : String(+x.toPrecision(4)));

function measure(line) {
  const flown = [...flights, ...crowds].filter((flight) => line.of.test(flight.name));
  const reports = flown.map((flight) => flight.report);
  const command = flown.map((flight) => flight.command).filter((c, i, all) => all.indexOf(c) === i).join('; ');
  const unit = line.unit && ` ${line.unit}`;
  const asked = line.most !== undefined ? `at most ${line.most}${unit}`
    : line.least !== undefined ? `at least ${line.least}${unit}` : 'bounded';
  const values = reports.map((report) => (report ? line.value(report) : null));
  if (values.length === 0 || values.some((v) => typeof v !== 'number')) {
    const empty = values.length > 0 && values.every((v) => v === undefined);
    return { line: line.line, asked, reached: empty ? 'nothing to measure' : 'not measured', met: 'no', command };
  }
  // Sort the values, the best one first.
  values.sort((a, b) => (line.least !== undefined ? b - a : a - b));
  const worst = values[values.length - 1], median = values[values.length >> 1];
  const meets = (v) => (line.least !== undefined ? v >= line.least : v <= line.most);
  const judged = line.most !== undefined || line.least !== undefined;
  let reached = values.length === 1 ? `${text(worst)}${unit}` : `median ${text(median)}${unit}, worst ${text(worst)}${unit}`;
  if (line.more) reached += ` (${line.more(reports[0], reports)})`;
  return { line: line.line, asked, reached, command, median, worst, bound: line.most ?? line.least,
    met: !judged ? 'reported' : meets(worst) ? 'yes' : meets(median) ? 'in the median' : 'no' };
}

const escaped = (s) => s.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;');

/// Draws a chart of the worst and the median value of each row relative to its target; at the line 1, a value equals
/// its target.
function chart(rows) {
  const shown = rows.filter((row) => row.bound > 0 && Number.isFinite(row.worst));
  const left = 300, unit = 260, height = 30, top = 40, width = left + 2 * unit + 240;
  const scaled = (v) => Math.min(2, v) * unit;
  const bars = shown.map((row, i) => {
    const y = top + i * height, worst = row.worst / row.bound, median = row.median / row.bound;
    return `<text x="${left - 8}" y="${y + 15}" text-anchor="end">${escaped(row.line)}</text>` +
      `<rect x="${left}" y="${y + 3}" width="${scaled(worst)}" height="16" fill="#9aa7b5"/>` +
      `<rect x="${left}" y="${y + 7}" width="${scaled(median)}" height="8" fill="#2b3a4a"/>` +
      `<text x="${left + Math.max(scaled(worst), unit) + 8}" y="${y + 15}">${text(worst)} (${escaped(row.asked)})</text>`;
  });
  const end = top + shown.length * height;
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${end + 12}" font-family="sans-serif" ` +
    'font-size="12" fill="#111"><rect width="100%" height="100%" fill="#fff"/>' +
    `<text x="${left}" y="20">reached / asked: wide bars the worst run, narrow ones the median</text>${bars.join('')}` +
    `<path d="M${left + unit} ${top - 8}V${end}" stroke="#111" stroke-dasharray="4 3"/></svg>\n`;
}

const rows = lines.map(measure);
const columns = ['line', 'asked', 'reached', 'met', 'command'];
const quoted = (s) => (/[",]/.test(s) ? `"${s.replace(/"/g, '""')}"` : s);
fs.writeFileSync(path.join(folder, 'streaming.csv'),
  [columns, ...rows.map((row) => columns.map((c) => row[c]))].map((row) => row.map(quoted).join(',') + '\n').join(''));
fs.writeFileSync(path.join(folder, 'streaming.svg'), chart(rows));
const shown = columns.slice(0, 4);
const table = [shown, shown.map(() => '---'), ...rows.map((row) => shown.map((c) => row[c]))];
for (const row of table) console.log(`| ${row.join(' | ')} |`);

const closed = flights.filter((flight) => /^closed_/.test(flight.name));
const whole = closed.length > 0 && closed.every((flight) => flight.report && unclosed(flight.report) === 0);
if (!whole) console.error('streaming: a surface was not closed');
process.exit(whole && [...flights, ...crowds].every((flight) => flight.report) ? 0 : 1);
