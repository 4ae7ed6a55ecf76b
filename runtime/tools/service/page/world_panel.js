// The description of a world: its properties, and its measures with verdicts. The charts are not part of it.

import { datum, element } from './element.js';
import { bytes, count, counted, nothing, number, percent } from './format.js';
import { measureColumns, measureRow, sliverRow, table } from './table.js';

const frame_ms = 1000 / 60;
/** In milliseconds: 99 % of the world's updates should take less than this time of the main thread. */
const p99_limit_ms = 2;

function facts(world) {
  const hits = world.cache.hits,
    asked = hits + world.cache.misses;
  return [
    ['State', world.idle ? 'idle: all is meshed' : 'streaming'],
    ['Backend', `${world.backend}${world.device ? `, ${world.device}` : ''}`],
    ['Finest cell', `${number(world.cell_meters)} m, ${counted(world.top_level + 1, 'level')}`],
    ['Seen up to', `${number(world.view_distance_meters)} m`],
    ['Viewers', count(world.viewers.length)],
    ['Updates', count(world.update.count)],
    ['Changes drawn', count(world.frame)],
    ['Edits', count(world.edits)],
    ['Chunks meshed', count(world.chunks.meshed)],
    [
      'Speedup',
      world.parallel ? `${number(world.parallel.speedup, 3)} on ${counted(world.parallel.threads, 'thread')}` : nothing,
    ],
    ['Cache', asked > 0 ? `${percent(hits / asked)} hits, ${bytes(world.cache.bytes)}` : 'not asked'],
  ];
}

export function showFacts(list, world) {
  list.replaceChildren(
    ...facts(world).map(([name, value]) =>
      element('div', {}, element('dt', { text: name }), element('dd', { text: value })),
    ),
  );
}

const defectNames = {
  index: 'indices out of range',
  outside: 'points outside of their chunk',
  misplaced: 'points off the surface',
  samples: 'samples that are no numbers',
  degenerate: 'triangles with two corners in one place',
  flat: 'triangles whose corners lie on a line',
  duplicate: 'triangles there twice',
  open_edge: 'open edges',
  turned_edge: 'turned edges',
  nonmanifold_edge: 'edges of three triangles or more',
  pinched_vertex: 'pinched points',
  folded: 'folded triangles',
  self_intersection: 'triangles that cut each other',
};

const countRow = (name, value, bad, why = '') =>
  measureRow(name, datum(value, count(value)), '', value > 0 ? bad : 'ok', value > 0 ? why : '');

function streamRows(world) {
  const memory = world.memory,
    used = memory.mesh_limit_bytes > 0 ? memory.mesh_bytes / memory.mesh_limit_bytes : 0;
  const longest = world.update.max_ms,
    p99 = world.update.p99_ms;
  return [
    measureRow(
      'Detail',
      datum(world.detail, percent(world.detail)),
      '',
      world.detail < 0.999 ? 'attention' : 'ok',
      world.detail < 0.999 ? 'lowered to stay within the budget' : '',
    ),
    measureRow(
      'Budget in use',
      datum(used, memory.mesh_limit_bytes > 0 ? percent(used) : nothing),
      '',
      used > 1 ? 'defect' : used > 0.9 ? 'attention' : 'ok',
      used > 0.9 ? bytes(memory.mesh_limit_bytes) : '',
    ),
    measureRow(
      'Main thread, 99 % of updates',
      datum(p99, number(p99, 3)),
      'ms',
      p99 > p99_limit_ms ? 'attention' : 'ok',
      p99 > p99_limit_ms ? 'over 2 ms' : '',
    ),
    measureRow(
      'Main thread, longest update',
      datum(longest, number(longest, 3)),
      'ms',
      longest > frame_ms ? 'attention' : 'ok',
      longest > frame_ms ? 'over 16.7 ms, a frame at 60 Hz' : '',
    ),
    countRow('Chunks that failed', world.chunks.failed, 'defect'),
    countRow('Cache entries damaged', world.cache.damaged, 'attention', 'meshed anew'),
  ];
}

function surfaceRows(measures) {
  const volume = measures.volume_cubic_meters;
  return [
    measureRow('Area drawn', datum(measures.area_square_meters, number(measures.area_square_meters, 5)), 'm²', 'info'),
    volume < 0
      ? measureRow('Void', datum(-volume, number(-volume, 5)), 'm³', 'info', 'hollow within the solid')
      : measureRow('Volume drawn', datum(volume, number(volume, 5)), 'm³', 'info'),
    measureRow('Triangles drawn', datum(measures.triangles, count(measures.triangles)), '', 'info'),
    sliverRow(measures.slivers, measures.triangles),
    countRow('Defects', measures.defects_total, 'defect', 'since creation'),
    ...Object.entries(measures.defects)
      .filter(([, found]) => found > 0)
      .map(([kind, found]) => countRow(`· ${defectNames[kind] ?? kind}`, found, 'defect')),
  ];
}

const howToMeasure = () =>
  element(
    'div',
    { class: 'hint' },
    element('h3', { text: 'This world measures no meshes' }),
    element(
      'p',
      {},
      'Area, volume and defects of every chunk come with ',
      element('code', { text: 'sgm fly --measure' }),
      ', or in an engine with the flag ',
      element('code', { text: 'SGM_WORLD_MEASURE' }),
      ' of the world: about a millisecond a chunk, on the worker threads.',
    ),
  );

export function showMeasures(node, world) {
  const rows = [...(world.measures ? surfaceRows(world.measures) : []), ...streamRows(world)];
  node.replaceChildren(
    ...(world.measures ? [] : [howToMeasure()]),
    element(
      'div',
      { class: 'scroll', tabindex: '0', role: 'group', 'aria-label': 'Measures of the world' },
      table(
        `${world.name}, as of ${number(world.sampled_seconds_ago, 2)} s ago; times by the clock, waits included`,
        measureColumns,
        rows,
        { class: 'measures' },
      ),
    ),
  );
}
