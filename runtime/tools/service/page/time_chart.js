// A chart of some quantities over the last five minutes.

import { addCursor } from './chart_cursor.js';
import { element, svg } from './element.js';
import { nothing, niceStep } from './format.js';
import { historySeconds } from './history.js';

const width = 360,
  height = 170;
const plot = { left: 46, right: width - 10, top: 10, bottom: height - 26 };
/**
 * The line is interrupted where no sample was taken for more than this number of seconds, because the tab was hidden or
 * the service did not run.
 */
const gap = 4;

const xOf = (age) => plot.right - (age / historySeconds) * (plot.right - plot.left);

export class TimeChart {
  #series;
  #format;
  #axis;
  #samples = [];
  #now = 0;
  #top = 0;
  #lines;
  #cursor;
  #dots;
  #grid;
  #legend;
  #readout;
  #refresh;
  #note;

  /**
   * series: [{key, label}], key: name of the value in a sample. format(value): text of a value with its unit.
   * axis(top): returns the unit {name, size} for an axis whose highest value is `top`. least: minimum for the end of
   * the axis. limit: name of a value in a sample, drawn as a bound if the other values come near it. note(sample):
   * returns an additional line of text.
   */
  constructor({ title, series, format, axis, least = 1, limit = null, note = null }) {
    this.#series = series;
    this.#format = format;
    this.#axis = axis;
    this.least = least;
    this.limit = limit;
    this.#note = note;
    const id = `chart-${series[0].key}`;
    this.#legend = series.map((one) => element('data', { value: '', text: nothing, 'data-series': one.key }));
    const legend = series.map((one, i) =>
      element(
        'li',
        {},
        svg(
          'svg',
          { viewBox: '0 0 22 8', class: 'swatch', 'aria-hidden': 'true' },
          svg('path', { d: 'M0 4H22', class: `line series-${i}` }),
        ),
        element('span', { text: one.label }),
        this.#legend[i],
      ),
    );
    this.#grid = svg('g');
    this.#lines = [...series, ...(limit ? [{ key: limit }] : [])].map((one) =>
      svg('path', { class: one.key === limit ? 'line limit' : `line series-${series.indexOf(one)}` }),
    );
    this.#cursor = svg('path', { class: 'cursor', visibility: 'hidden' });
    this.#dots = series.map((one, i) => svg('circle', { r: 3.5, class: `dot series-${i}`, visibility: 'hidden' }));
    const picture = svg(
      'svg',
      { viewBox: `0 0 ${width} ${height}`, class: 'plot', 'aria-describedby': `${id}-note` },
      this.#grid,
      ...this.#lines,
      this.#cursor,
      ...this.#dots,
    );
    this.#readout = element('p', { class: 'readout', id: `${id}-note` });
    this.node = element(
      'figure',
      { class: 'chart card', id },
      element('figcaption', {}, element('h3', { text: title }), element('ul', { class: 'legend' }, ...legend)),
      picture,
      this.#readout,
    );
    this.#refresh = addCursor(picture, {
      label: `${title}, the last five minutes`,
      size: () => this.#samples.length,
      indexAt: (x) => this.#nearest(x),
      show: (index) => this.#show(index),
    });
  }

  /** Redraws the chart. samples: oldest first, each with `time`. now: current time on the same clock as sample.time. */
  update(samples, now) {
    this.#samples = samples;
    this.#now = now;
    const highest = Math.max(0, ...samples.flatMap((s) => this.#series.map((one) => s[one.key] ?? 0)));
    const bound = this.limit && samples.length > 0 ? (samples.at(-1)[this.limit] ?? 0) : 0;
    const shows_bound = bound > 0 && highest > bound / 4;
    this.#drawGrid(Math.max(highest, shows_bound ? bound : 0, this.least));
    if (shows_bound)
      this.#grid.append(svg('text', { x: plot.right, y: this.#yOf(bound) - 4, class: 'tick end', text: 'budget' }));
    this.#lines.forEach((line, i) => {
      const key = this.#series[i]?.key ?? this.limit;
      line.setAttribute('d', key === this.limit && !shows_bound ? '' : this.#path(key));
    });
    const last = samples.at(-1);
    this.#series.forEach((one, i) => {
      const value = last?.[one.key] ?? null;
      this.#legend[i].value = value === null ? '' : String(value);
      this.#legend[i].textContent = value === null ? nothing : this.#format(value);
    });
    this.#refresh();
  }

  #yOf(value) {
    return plot.bottom - (value / this.#top) * (plot.bottom - plot.top);
  }

  #drawGrid(highest) {
    const unit = this.#axis(highest);
    const step = niceStep(highest / unit.size / 4) * unit.size;
    this.#top = step * Math.ceil(highest / step - 1e-9);
    const parts = [];
    for (let value = 0; value <= this.#top * (1 + 1e-9); value += step) {
      const y = this.#yOf(value);
      parts.push(
        svg('path', { d: `M${plot.left} ${y}H${plot.right}`, class: value === 0 ? 'axis' : 'grid' }),
        svg('text', {
          x: plot.left - 6,
          y: y + 4,
          class: 'tick end',
          text: String(Number((value / unit.size).toPrecision(4))),
        }),
      );
    }
    for (let minutes = 5; minutes >= 0; --minutes) {
      const x = xOf(minutes * 60);
      parts.push(
        svg('path', { d: `M${x} ${plot.bottom}v4`, class: 'axis' }),
        svg('text', {
          x,
          y: plot.bottom + 17,
          class: `tick ${minutes === 0 ? 'end' : 'middle'}`,
          text: minutes === 0 ? 'now' : `−${minutes} min`,
        }),
      );
    }
    parts.push(svg('text', { x: plot.left + 4, y: plot.top + 9, class: 'unit', text: unit.name }));
    this.#grid.replaceChildren(...parts);
  }

  #path(key) {
    let path = '',
      before = -Infinity;
    for (const sample of this.#samples) {
      const value = sample[key];
      if (value === null || value === undefined) continue;
      const age = this.#now - sample.time;
      if (age > historySeconds) continue;
      path += `${sample.time - before > gap ? 'M' : 'L'}${xOf(age).toFixed(1)} ${this.#yOf(value).toFixed(1)}`;
      before = sample.time;
    }
    return path;
  }

  #nearest(x) {
    if (this.#samples.length === 0) return null;
    const distance = (i) => Math.abs(xOf(this.#now - this.#samples[i].time) - x);
    let best = 0;
    for (let i = 1; i < this.#samples.length; ++i) if (distance(i) < distance(best)) best = i;
    return best;
  }

  #show(index) {
    const chosen = index === null ? null : this.#samples[index];
    const sample = chosen ?? this.#samples.at(-1);
    this.#cursor.setAttribute('visibility', chosen ? 'visible' : 'hidden');
    this.#dots.forEach((dot) => dot.setAttribute('visibility', 'hidden'));
    if (!sample) return (this.#readout.textContent = 'nothing was measured yet');
    const x = xOf(this.#now - sample.time);
    this.#cursor.setAttribute('d', `M${x} ${plot.top}V${plot.bottom}`);
    this.#series.forEach((one, i) => {
      if (sample[one.key] === null || sample[one.key] === undefined) return;
      this.#dots[i].setAttribute('cx', x);
      this.#dots[i].setAttribute('cy', this.#yOf(sample[one.key]));
      this.#dots[i].setAttribute('visibility', 'visible');
    });
    const age = Math.round(this.#now - sample.time);
    const values = this.#series.map(
      (one) => `${one.label} ${sample[one.key] === null ? nothing : this.#format(sample[one.key])}`,
    );
    const when = chosen ? `${age} s ago: ${values.join(', ')}` : '';
    this.#readout.textContent = when || this.#note?.(sample) || '\u00a0';
    return when || `now: ${values.join(', ')}`;
  }
}
