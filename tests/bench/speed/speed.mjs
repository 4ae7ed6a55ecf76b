// Compares the speed of our library with that of other libraries, and measures how our time grows with the input. Each
// library runs in a separate process on the same samples. A round runs all processes one after the other; the result is
// the median over the rounds of the ratio of times within a round. A time counts only if the meshes are the same
// surface. See ../README.md.
//
//   node tests/bench/speed/speed.mjs BIN OUT [--cells 256] [--runs 7] [--rounds 3] [--threads 1,2] [--no-growth]
//                      [--as-installed]
//
//   BIN   folder of sgm_bench_ours and the other programs
//   OUT   folder for speed.csv, speed.json and the charts
//
// Exit status 1 if a mesh of our library is wrong. A library that is not installed is left out, and its package is
// reported.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { bars, curves, exponent, short } from './chart.mjs';

const [bin, out, ...rest] = process.argv.slice(2);
const options = { cells: 256, runs: 7, rounds: 3, threads: '1,2', growth: true, keep: true };
const valid = { cells: /^(64|128|256|512)$/, runs: /^[1-9]\d*$/, rounds: /^[1-9]\d*$/, threads: /^[1-9]\d*(,[1-9]\d*)*$/ };
for (let i = 0; i < rest.length; ++i) {
  const name = rest[i].replace(/^--/, '');
  if (rest[i] === '--no-growth') options.growth = false;
  else if (rest[i] === '--as-installed') options.keep = false;
  else if (valid[name]?.test(rest[i + 1] ?? '')) options[name] = name === 'threads' ? rest[++i] : Number(rest[++i]);
  else fail(`unknown option or value: ${rest.slice(i).join(' ')}`);
}
if (!bin || !out) fail('usage: node speed.mjs BIN OUT [--cells 64|128|256|512] [--runs N] [--rounds N] [--threads 1,2] [--no-growth] [--as-installed]');
const threadCounts = options.threads.split(',').map(Number);
const here = path.dirname(new URL(import.meta.url).pathname);
for (const side of ['sgm_bench_ours', 'sgm_bench_machine'])
  if (!fs.existsSync(path.join(bin, side))) fail(`there is no ${side} in ${bin}: build the project with its benchmarks`);
try {
  fs.mkdirSync(out, { recursive: true });
} catch (error) {
  fail(`${out} cannot be made: ${error.message}`);
}

function fail(message) {
  console.error(`speed: error: ${message}`);
  process.exit(2);
}

const measured = []; // every parsed output line of a program, with the scene and the library's name
let wrong = 0;

/// Runs a library's program. Returns the key=value words that it prints as an object, with numbers as numbers.
function run(program, args, env = {}) {
  const done = spawnSync(program, args.map(String), { encoding: 'utf8', env: { ...process.env, ...env }, maxBuffer: 1 << 26 });
  if (done.status !== 0) fail(`${program} ${args.join(' ')}: ${done.error?.message ?? done.stderr.trim()}`);
  const answer = {};
  for (const word of done.stdout.trim().split(/\s+/)) {
    const [key, value] = word.split('=');
    if (value !== undefined) answer[key] = Number.isNaN(Number(value)) ? value : Number(value);
  }
  return answer;
}
const ours = (set, ...args) => {
  const answer = run(path.join(bin, 'sgm_bench_ours'), args, set && set !== best ? { SGM_BENCH_SET: set } : {});
  if (set && answer.set !== set) fail(`sgm_bench_ours was asked for ${set} and took ${answer.set}`);
  return answer;
};
// Our runtime keeps freed blocks and requests large pages, so malloc is set to do the same for the other libraries: on
// machines where new pages are slow, their times would otherwise be mostly page faults. With --as-installed, malloc
// keeps its defaults.
const keeping = options.keep
  ? { GLIBC_TUNABLES: 'glibc.malloc.mmap_threshold=33554432:glibc.malloc.trim_threshold=4294967296:glibc.malloc.hugetlb=1' }
  : {};
const rival = (program, args) => run(program, args, keeping);
const machine = (...args) => rival(path.join(bin, 'sgm_bench_machine'), args);

/// Returns the numbers of the processors that this process may use, in the order in which the programs pin their
/// threads to them.
function allowedProcessors() {
  const list = /^Cpus_allowed_list:\s*(.*)$/m.exec(fs.readFileSync('/proc/self/status', 'utf8'))[1];
  return list.split(',').flatMap((part) => {
    const [first, last = first] = part.split('-').map(Number);
    return Array.from({ length: last - first + 1 }, (_, i) => first + i);
  });
}

const vtk = path.join(bin, 'sgm_bench_vtk'), openvdb = path.join(bin, 'sgm_bench_openvdb'), python = '/usr/bin/python3';
const built = (program) => fs.existsSync(program);
const skimage = fs.existsSync(python) && spawnSync(python, ['-c', 'import skimage']).status === 0;
const build = ' and configure and build again';
const peers = [
  { name: 'VTK Flying Edges, normals', ask: 5, aim: 10, there: built(vtk), package: 'libvtk9-dev', more: build,
    run: (grid, threads) => rival(vtk, ['flying-edges', grid, threads, options.runs]) },
  { name: 'VTK Flying Edges', plain: true, there: built(vtk), package: 'libvtk9-dev', more: build,
    run: (grid, threads) => rival(vtk, ['flying-edges-plain', grid, threads, options.runs]) },
  { name: 'OpenVDB volumeToMesh', ask: 4, aim: 8, plain: true, there: built(openvdb), package: 'libopenvdb-dev', more: build,
    run: (grid, threads) => rival(openvdb, [grid, threads, options.runs]) },
  { name: 'VTK marching cubes', ask: 11, aim: 20, plain: true, serial: true, there: built(vtk), package: 'libvtk9-dev', more: build,
    run: (grid) => rival(vtk, ['marching-cubes', grid, 1, Math.min(3, options.runs)]) },
  { name: 'scikit-image', ask: 11, aim: 20, serial: true, there: skimage, package: 'python3-skimage', more: '',
    run: (grid) => rival(python, [path.join(here, 'skimage_side.py'), grid, Math.min(3, options.runs)]) },
];
for (const name of new Set(peers.filter((p) => !p.there).map((p) => p.package))) {
  const lacking = peers.filter((p) => p.package === name);
  console.log(`Without ${lacking.map((p) => p.name).join(', ')}: install ${name}${lacking[0].more}.`);
}
const present = peers.filter((peer) => peer.there);

const median = (values) => {
  const sorted = [...values].sort((a, b) => a - b), half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
};
const tell = (text) => {
  console.log(`  WRONG: ${text}`);
  ++wrong;
};
const note = (what, answer) => {
  measured.push({ ...what, ...answer });
  if (what.side.startsWith('ours') && answer.open > 0) tell(`${what.scene}, ${what.side}: ${answer.open} open edges`);
  return answer;
};

/// Checks that our mesh is the same surface as another library's, since only then can their times be compared. The
/// Euler characteristic may differ only by the number of ambiguous faces, whose diagonals each method chooses in its
/// own way. Areas are compared only if cells are small relative to the features: on coarse grids, OpenVDB's dual
/// surface cuts off corners.
function compare(scene, mine, peer, name) {
  if (options.cells >= 256 && Math.abs(mine.area - peer.area) > 0.01 * peer.area) tell(`${scene}: area ${mine.area} is not within 1 % of ${peer.area} of ${name}`);
  const handles = Math.abs(mine.euler - peer.euler);
  if (handles > mine.ambiguous)
    tell(`${scene}: Euler characteristic ${mine.euler} is not that of ${name}, ${peer.euler}, with ${mine.ambiguous} ambiguous faces`);
  return handles === 0 ? 'same genus' : `Euler ${mine.euler} and ${peer.euler}, ${mine.ambiguous} ambiguous faces`;
}

const asked = []; // the rows of the table of targets, filled below
const ask = (name, reached, what) => {
  asked.push({ name, reached, unit: '', ...what });
};

// ---- extraction

const scenes = ['sphere', 'blobs', 'caves'];
const best = ours('', 'write', 'sphere', 64, path.join(out, 'probe.grid')) && ours('', 'grid', path.join(out, 'probe.grid'), 1, 1).set;
fs.rmSync(path.join(out, 'probe.grid'));
const sets = best.startsWith('avx512') ? [best, 'avx2'] : [best];
console.log(`${options.cells}^3 cells, ${options.rounds} rounds of ${options.runs} runs, milliseconds; ` +
  `${machine('float', 1, 5).gflops} GFLOP/s without fused operations on one thread`);
console.log('scene    threads  side                           median   cpu/wall  peak MB  triangles  times ours');
for (const scene of scenes) {
  const grid = path.join(out, `${scene}.grid`);
  ours('', 'write', scene, options.cells, grid);
  const byThreads = new Map(threadCounts.map((threads) => [threads, {}]));
  for (let round = 0; round < options.rounds; ++round) {
    for (const [threads, answers] of byThreads) {
      const add = (side, answer) => (answers[side] ??= []).push(note({ scene, threads, side, round }, answer));
      for (const set of sets) {
        add(`ours, normals, ${set}`, ours(set, 'grid', grid, threads, options.runs));
        add(`ours, ${set}`, ours(set, 'grid-plain', grid, threads, options.runs));
      }
      const { vertices, triangles } = answers[`ours, normals, ${sets[0]}`][0];
      add('floor: reading signs', machine('signs', grid, threads, options.runs));
      add('floor: writing the mesh', machine('output', 24 * vertices + 12 * triangles, threads, options.runs));
      for (const peer of present) {
        if (!peer.serial || threads === 1) add(peer.name, peer.run(grid, threads));
      }
    }
  }
  for (const [threads, answers] of byThreads) {
    const first = (side) => answers[side][0];
    const of = (side) => median(answers[side].map((a) => a.median));
    const print = (side, ratio, more = '') => {
      const a = first(side);
      console.log(`${scene.padEnd(8)} ${String(threads).padStart(7)}  ${side.padEnd(28)} ${of(side).toFixed(2).padStart(8)} ` +
        `${a.processor.toFixed(2).padStart(9)} ${a.peak_mb.toFixed(0).padStart(8)} ${String(a.triangles ?? '').padStart(10)}  ` +
        `${ratio === undefined ? '' : short(ratio)}${more}`);
    };
    for (const set of sets) {
      print(`ours, normals, ${set}`);
      print(`ours, ${set}`);
    }
    const floors = answers['floor: reading signs'].map((a, i) => a.median + answers['floor: writing the mesh'][i].median);
    print('floor: reading signs');
    print('floor: writing the mesh');
    for (const peer of present.filter((p) => answers[p.name])) {
      const same = compare(scene, first(`ours, normals, ${sets[0]}`), first(peer.name), peer.name);
      const ratios = (set, kind) => median(answers[peer.name].map((a, i) => a.median / answers[`ours${kind}, ${set}`][i].median));
      const kind = peer.plain ? '' : ', normals';
      print(peer.name, ratios(sets[0], kind), ` (${same})`);
      if (!peer.ask) continue;
      for (const set of sets) {
        ask(`${scene}: ${peer.name}, ${threads} thread${threads > 1 ? 's' : ''}, ${set}`, ratios(set, kind),
          { asked: peer.ask, aim: peer.aim, unit: '×' });
      }
    }
    ask(`${scene}: extraction, normals, by its floor, ${threads} thread${threads > 1 ? 's' : ''}`,
      median(answers[`ours, normals, ${sets[0]}`].map((a, i) => a.median / floors[i])), { asked: 5, aim: 2.5, unit: '×', atMost: true });
  }
}

// ---- evaluation and meshing

const rounds = (measure) => Array.from({ length: options.rounds }, (_, round) => measure(round));
const mesh = (scene, cells, threads) =>
  note({ scene, cells, threads, side: 'ours: evaluate and mesh' }, ours('', 'mesh', scene, cells, threads, options.runs));
for (const threads of threadCounts) {
  const flying = present.find((p) => p.name === 'VTK Flying Edges, normals');
  if (!flying) continue;
  ask(`200 blobs, evaluate and mesh: brute sampling and Flying Edges, ${threads} thread${threads > 1 ? 's' : ''}`,
    median(rounds(() => {
      const mine = mesh('blobs', options.cells, threads);
      const brute = note({ scene: 'blobs', threads, side: 'brute sampling' }, machine('brute', options.cells, threads, 3));
      return (brute.median + flying.run(path.join(out, 'blobs.grid'), threads).median) / mine.median;
    })), { asked: 15, aim: 40, unit: '×' });
}
ask('1,000 spheres at 128³, evaluate and mesh, 1 thread',
  median(rounds(() => mesh('spheres', 128, 1).median)) / 1000, { asked: 0.03, aim: 0.01, unit: ' s', atMost: true });
ask('32³ cells with a surface, extraction only without normals, caves',
  median(rounds(() => note({ scene: 'caves', side: 'ours: 32^3 of a grid' },
    ours('', 'grid-chunks', path.join(out, 'caves.grid'), options.runs)).median)), { asked: 0.06, aim: 0.03, unit: ' ms', atMost: true });
ask('a surface chunk of cave.sgm, from cells to packed mesh',
  median(rounds(() => note({ scene: 'cave', side: 'ours: chunk' }, ours('', 'chunk', 'cave', 256, options.runs, 0)).median)),
  { asked: 0.5, aim: 0.2, unit: ' ms', atMost: true });
ask('10,000 spheres by 1,000 at equal filling',
  median(rounds(() => mesh('spheres:10000', options.cells, 1).median / mesh('spheres:1000', options.cells, 1).median)),
  { asked: 3, aim: 1.5, unit: '×', atMost: true });
// On a shared machine, the speed of a processor depends on the load of its neighbours. So the rate with two threads is
// compared with the sum of the rates that the same two processors reach with one thread each.
const processors = allowedProcessors();
if (threadCounts.includes(1) && threadCounts.includes(2) && processors.length >= 2) {
  const scaling = (name, scene, stage) => ask(name, median(rounds(() => {
    const alone = processors.slice(0, 2).map((processor) =>
      note({ scene, threads: 1, cpu: processor, side: 'ours: one processor' },
        run('taskset', ['-c', processor, path.join(bin, 'sgm_bench_ours'), ...stage(1)])).median);
    const both = note({ scene, threads: 2, side: 'ours: both processors' }, ours('', ...stage(2))).median;
    return 2 / (1 / alone[0] + 1 / alone[1]) / both;
  })), { asked: 1.85, aim: 1.95, unit: '×' });
  for (const scene of scenes)
    scaling(`${scene}: extraction, 2 threads by 1`, scene, (threads) => ['grid', path.join(out, `${scene}.grid`), threads, 2 * options.runs]);
  for (const scene of ['blobs', 'spheres', 'cave'])
    scaling(`${scene}: evaluate and mesh, 2 threads by 1`, scene, (threads) => ['mesh', scene, options.cells, threads, options.runs]);
}
for (const scene of [...scenes, 'cave']) {
  ask(`${scene}: peak memory of a region of ${options.cells}³`,
    note({ scene, side: 'ours: region' }, ours('', 'region', scene, options.cells, 1, 2)).peak_mb,
    { asked: 150, aim: 80, unit: ' MB', atMost: true });
}

// ---- growth

const panels = [];
if (options.growth) {
  const line = (name, xs, measure) => {
    const points = xs.map((x) => [x, measure(x)]);
    return { name, points, exponent: exponent(points) };
  };
  panels.push({ title: 'Primitives at equal filling', x: 'spheres', y: 'ms, 256³ cells', lines: [
    line('evaluate and mesh', [100, 1000, 10000, 100000], (n) => mesh(`spheres:${n}`, 256, 1).median)] });
  panels.push({ title: 'Cells on an edge', x: 'cells', y: 'ms', lines: [
    line('sphere, evaluate and mesh', [64, 128, 256, 512], (n) => mesh('sphere', n, 1).median),
    line('caves, a grid with normals', [32, 64, 128, 256, 512], (n) => {
      const file = path.join(out, 'growth.grid');
      ours('', 'write', 'caves', n, file);
      const answer = note({ scene: 'caves', cells: n, side: 'ours: grid' }, ours('', 'grid', file, 1, Math.min(5, options.runs)));
      fs.rmSync(file);
      return answer.median;
    })] });
  panels.push({ title: 'Threads', x: 'threads', y: 'ms, 256³ cells', lines: ['blobs', 'cave'].map((scene) =>
    line(`${scene}, evaluate and mesh`, threadCounts, (n) => mesh(scene, 256, n).median)) });
  panels.push({ title: 'Levels', x: 'metres a cell', y: 'ms a surface chunk', lines: [
    line('cave.sgm', [0.5, 1, 2, 4], (n) => note({ scene: 'cave', level: Math.log2(2 * n), side: 'ours: chunk' },
      ours('', 'chunk', 'cave', 256, Math.min(5, options.runs), Math.log2(2 * n))).median)] });
  panels.push({ title: 'Size of the world', x: 'chunks', y: 'ms', lines: [
    line('cave.sgm, cells of half a metre', [128, 256, 512, 768], (n) => mesh('world', n, 1).median)]
    .map((l) => {
      const points = l.points.map(([n, ms]) => [(n / 32) ** 3, ms]);
      return { ...l, points, exponent: exponent(points) };
    }) });
  for (const panel of panels)
    for (const l of panel.lines) console.log(`${panel.title}, ${l.name}: ${l.points.map(([x, y]) => `${short(x)} ${short(y)}`).join(', ')}; exponent ${l.exponent.toFixed(2)}`);
  fs.writeFileSync(path.join(out, 'growth.svg'), curves(panels));
}

// ---- targets, and what was reached

const met = (row) => (row.atMost ? row.reached <= row.asked : row.reached >= row.asked);
console.log('\n| | reached | asked | aim | |\n|---|---|---|---|---|');
for (const row of asked)
  console.log(`| ${row.name} | ${short(row.reached)}${row.unit} | ${row.asked}${row.unit} | ${row.aim}${row.unit} | ${met(row) ? 'yes' : 'NO'} |`);
console.log(`\n${asked.filter(met).length} of ${asked.length} are met.`);
fs.writeFileSync(path.join(out, 'speed.svg'), bars(`Reached by asked: ${options.cells}³ cells`, asked));
fs.writeFileSync(path.join(out, 'speed.json'), JSON.stringify({ options, sets, asked, measured, growth: panels }, null, 1));
const keys = [...new Set(measured.flatMap((row) => Object.keys(row)))];
fs.writeFileSync(path.join(out, 'speed.csv'), [keys, ...measured.map((row) => keys.map((k) => row[k] ?? ''))]
  .map((row) => row.map((v) => (/[",]/.test(String(v)) ? `"${v}"` : v)).join(',') + '\n').join(''));
for (const scene of scenes) fs.rmSync(path.join(out, `${scene}.grid`));
process.exit(wrong === 0 ? 0 : 1);
