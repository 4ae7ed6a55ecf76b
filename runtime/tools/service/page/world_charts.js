// The charts of a world, and the conversion of the service's summary to their samples.

import { bytes, byteUnit, count, number, percent } from './format.js';
import { TimeChart } from './time_chart.js';

const plain = (name) => () => ({ name, size: 1 });
const perSecond = (value) => `${number(value, 3)}/s`;
const milliseconds = (value) => `${number(value, 3)} ms`;

/** Makes one sample for the charts. time: seconds. world: an element of `worlds` in /api/v1/summary. */
export function sampleOf(world, time) {
  return {
    time,
    per_second: world.chunks.per_second,
    waiting: world.queue.waiting,
    in_work: world.queue.in_work,
    mesh_bytes: world.memory.mesh_bytes,
    collider_bytes: world.memory.collider_bytes,
    mesh_limit: world.memory.mesh_limit_bytes,
    peak_bytes: world.memory.peak_mesh_bytes,
    defects: world.measures ? world.measures.defects_total : null,
    failed: world.chunks.failed,
    p50_ms: world.update.p50_ms,
    p99_ms: world.update.p99_ms,
    mean_ms: world.update.mean_ms,
    max_ms: world.update.max_ms,
    drawn: world.chunks.drawn,
    kept: world.chunks.kept,
  };
}

export function makeWorldCharts() {
  return [
    new TimeChart({
      title: 'Chunks meshed',
      series: [{ key: 'per_second', label: 'rate' }],
      format: perSecond,
      axis: plain('chunks/s'),
      least: 1,
      note: () => 'over the last few seconds',
    }),
    new TimeChart({
      title: 'Queue',
      series: [
        { key: 'waiting', label: 'waiting' },
        { key: 'in_work', label: 'in work' },
      ],
      format: count,
      axis: plain('chunks'),
      least: 4,
      note: () => 'chunks that viewers wait for',
    }),
    new TimeChart({
      title: 'Memory of meshes',
      series: [
        { key: 'mesh_bytes', label: 'meshes' },
        { key: 'collider_bytes', label: 'colliders' },
      ],
      format: bytes,
      axis: byteUnit,
      least: 1024,
      limit: 'mesh_limit',
      note: (s) =>
        (s.mesh_limit > 0
          ? `${percent(s.mesh_bytes / s.mesh_limit)} of the budget of ${bytes(s.mesh_limit)}; `
          : 'no budget was set; ') + `at most ${bytes(s.peak_bytes)}`,
    }),
    new TimeChart({
      title: 'Defects',
      series: [
        { key: 'defects', label: 'in meshes' },
        { key: 'failed', label: 'chunks failed' },
      ],
      format: count,
      axis: plain('since creation'),
      least: 4,
      note: (s) =>
        s.defects === null ? 'not measured: see the measures of the world' : 'of all that was meshed since creation',
    }),
    new TimeChart({
      title: 'Time on the main thread',
      series: [
        { key: 'p50_ms', label: 'median' },
        { key: 'p99_ms', label: '99 %' },
      ],
      format: milliseconds,
      axis: plain('ms an update'),
      least: 0.1,
      note: (s) =>
        `by the clock, waits included: mean ${milliseconds(s.mean_ms)}, longest ${milliseconds(s.max_ms)}`,
    }),
    new TimeChart({
      title: 'Chunks at hand',
      series: [
        { key: 'drawn', label: 'drawn' },
        { key: 'kept', label: 'kept' },
      ],
      format: count,
      axis: plain('chunks'),
      least: 4,
      note: () => 'kept: in memory, whether drawn or not',
    }),
  ];
}
