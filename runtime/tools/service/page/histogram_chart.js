// Charts of a mesh's histogram together with a reference histogram: bars for the mesh, a line for the reference.

import { addCursor } from './chart_cursor.js';
import { element, svg } from './element.js';
import { niceStep, number, percent } from './format.js';

const width = 330,
  height = 190;
const plot = { left: 40, right: width - 8, top: 10, bottom: height - 24 };

/** Scales of the vertical axis. The square root makes small shares visible next to large ones. */
const scales = { linear: (x) => x, root: Math.sqrt };

const ticksTo = (top) => {
  const step = niceStep(top / 4);
  return Array.from({ length: Math.round(top / step) + 1 }, (_, i) => i * step).filter(
    (tick) => tick <= top * (1 + 1e-9),
  );
};

function grid(top, scale) {
  const y = (share) => plot.bottom - (scale(share) / scale(top)) * (plot.bottom - plot.top);
  const parts = [];
  const ticks = scale === scales.root ? [0, 0.04, 0.16, 0.36, 0.64, 1].map((share) => share * top) : ticksTo(top);
  for (const tick of ticks) {
    parts.push(
      svg('path', { d: `M${plot.left} ${y(tick)}H${plot.right}`, class: tick === 0 ? 'axis' : 'grid' }),
      svg('text', { x: plot.left - 5, y: y(tick) + 4, class: 'tick end', text: number(100 * tick, 2) }),
    );
  }
  parts.push(svg('text', { x: plot.left + 4, y: plot.top + 9, class: 'unit', text: '% of edges' }));
  const labels = [
    [0, '', 'concave'],
    [0.5, 'middle', 'flat'],
    [1, 'end', 'convex'],
  ];
  for (const [at, anchor, text] of labels) {
    const x = plot.left + at * (plot.right - plot.left);
    parts.push(
      svg('path', { d: `M${x} ${plot.bottom}v5`, class: 'axis' }),
      svg('text', { x, y: plot.bottom + 17, class: `tick ${anchor}`, text }),
    );
  }
  return { parts, y };
}

/** End of the vertical axis: the highest share, rounded up to a multiple of 5 %, or of 1 % if it is at most 20 %. */
const topOf = (...histograms) => {
  const highest = Math.max(0.01, ...histograms.flat());
  const step = highest > 0.2 ? 0.05 : 0.01;
  return Math.min(Math.ceil(highest / step - 1e-9) * step, 1);
};

/**
 * A chart of one histogram. title: heading. shares: the mesh's share in each bin. master: the reference histogram
 * {name, shares}, or null. top: end of the vertical axis. scale: linear or root. Both histograms must have the same
 * number of bins.
 */
function histogram({ title, note, shares, master, top, scale, main }) {
  const shape = scales[scale],
    bins = shares.length;
  const { parts, y } = grid(top, shape);
  const x = (bin) => plot.left + (bin / bins) * (plot.right - plot.left);
  const bars = shares.map((share, i) =>
    svg('rect', {
      x: x(i) + 0.4,
      y: y(share),
      width: Math.max(x(1) - x(0) - 0.8, 0.5),
      height: Math.max(plot.bottom - y(share), 0),
      class: 'bar',
    }),
  );
  const line =
    master?.shares.length === bins
      ? svg('path', {
          class: 'line master',
          d: master.shares.map((share, i) => `${i ? 'L' : 'M'}${x(i)} ${y(share)}L${x(i + 1)} ${y(share)}`).join(''),
        })
      : svg('g');
  const cursor = svg('rect', {
    class: 'bin-cursor',
    y: plot.top,
    height: plot.bottom - plot.top,
    width: x(1) - x(0),
    visibility: 'hidden',
  });
  const picture = svg('svg', { viewBox: `0 0 ${width} ${height}`, class: 'plot' }, ...parts, ...bars, line, cursor);
  const readout = element('p', { class: 'readout', text: note });
  addCursor(picture, {
    label: title,
    size: () => bins,
    indexAt: (at) => Math.floor(((at - plot.left) / (plot.right - plot.left)) * bins),
    show: (index) => {
      cursor.setAttribute('visibility', index === null ? 'hidden' : 'visible');
      if (index === null) return (readout.textContent = note);
      cursor.setAttribute('x', x(index));
      const bend = (2 * (index + 0.5)) / bins - 1;
      return (readout.textContent =
        `bin ${index + 1} of ${bins}, ${Math.abs(bend) < 1 / bins ? 'flat' : bend < 0 ? 'concave' : 'convex'}: ` +
        `mesh ${percent(shares[index])}${master ? `, master ${percent(master.shares[index])}` : ''}`);
    },
  });
  return element(
    'figure',
    { class: main ? 'chart histogram nearest' : 'chart histogram' },
    element('figcaption', {}, element('h4', { text: title })),
    picture,
    readout,
  );
}

const legend = (has_masters) =>
  element(
    'ul',
    { class: 'legend' },
    element(
      'li',
      {},
      svg(
        'svg',
        { viewBox: '0 0 14 14', class: 'square', 'aria-hidden': 'true' },
        svg('rect', { y: 2, width: 14, height: 12, class: 'bar' }),
      ),
      element('span', { text: 'this mesh' }),
    ),
    ...(has_masters
      ? [
          element(
            'li',
            {},
            svg(
              'svg',
              { viewBox: '0 0 22 8', class: 'swatch', 'aria-hidden': 'true' },
              svg('path', { d: 'M0 6H8V2H15V6H22', class: 'line master' }),
            ),
            element('span', { text: 'nearest master of the class' }),
          ),
        ]
      : []),
  );

/**
 * Charts of the mesh's histogram with each reference histogram. shares: the mesh's share in each bin. masters:
 * reference histograms [{class, name, shares}]. found(class): returns the distances {mse, emd} to that class. best:
 * name of the nearest class.
 */
export function showHistograms({ shares, masters, found, best }) {
  const node = element('div', { class: 'histograms' }),
    fitting = masters.filter((master) => master.shares.length === shares.length);
  const top = topOf(shares, ...fitting.map((master) => master.shares));
  const choice = element(
    'select',
    { id: 'histogram-scale', on: { change: () => draw() } },
    element('option', { value: 'root', text: 'square roots' }),
    element('option', { value: 'linear', text: 'linear' }),
  );
  const charts = element('div', { class: 'charts' });
  function draw() {
    const scale = choice.value;
    charts.replaceChildren(
      ...(fitting.length === 0
        ? [histogram({ title: 'Histogram of this mesh', note: '\u00a0', shares, master: null, top, scale, main: true })]
        : fitting.map((master) => {
            const its = found(master.class);
            return histogram({
              title: `Beside ${master.class}${master.class === best ? ' (nearest)' : ''}`,
              shares,
              master,
              top,
              scale,
              note: `${master.name}${its ? `: MSE ${number(its.mse, 3)}, EMD ${number(its.emd, 3)}` : ''}`,
              main: master.class === best,
            });
          })),
    );
  }
  draw();
  node.append(
    element('p', {
      class: 'muted',
      text: `Shares of edges by how the surface bends across them, in ${shares.length} bins`,
    }),
    element(
      'div',
      { class: 'controls' },
      legend(fitting.length > 0),
      element('p', { class: 'field' }, element('label', { for: 'histogram-scale', text: 'Scale of shares' }), choice),
    ),
    charts,
  );
  return node;
}
