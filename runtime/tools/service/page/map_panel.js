// The map with its controls: choice of a height, zoom, and a legend of the levels of detail.

import { datum, element, svg } from './element.js';
import { count, counted, nothing, number } from './format.js';
import { MapView, colourOfLevel } from './map_view.js';
import { Poller } from './poller.js';

const period = 2000;

export class MapPanel {
  #api;
  #node;
  #view;
  #world = null;
  #map = null;
  #shown = true;
  #poller;
  #count = element('p', { class: 'map-count', id: 'map-count' });
  #legend = element('ul', { class: 'legend levels', 'aria-label': 'Chunks by level' });
  #viewers = element('p', { class: 'muted', id: 'map-viewers' });
  #readout = element('p', { class: 'readout', role: 'status', text: '\u00a0' });
  #all;
  #slider;
  #height = element('output', { for: 'map-height', text: nothing });

  constructor(api, node) {
    this.#api = api;
    this.#node = node;
    const canvas = element('canvas', {
      class: 'map',
      tabindex: '0',
      role: 'application',
      id: 'map-canvas',
      'aria-label': 'Map of the chunks, seen from above: arrow keys move, plus and minus zoom, 0 shows all',
      'aria-describedby': 'map-count map-viewers',
    });
    this.#view = new MapView(canvas, (text) => {
      this.#readout.textContent = text || '\u00a0';
    });
    const button = (text, label, act) =>
      element('button', { type: 'button', 'aria-label': label, title: label, text, on: { click: act } });
    this.#all = element('input', {
      type: 'checkbox',
      id: 'map-all',
      checked: true,
      on: { change: () => this.#draw() },
    });
    this.#slider = element('input', {
      type: 'range',
      id: 'map-height',
      min: '0',
      max: '1',
      step: 'any',
      disabled: true,
      'aria-label': 'Height that is shown',
      on: { input: () => this.#draw() },
    });
    node.append(
      element(
        'div',
        { class: 'controls' },
        element('label', { class: 'check' }, this.#all, ' all heights'),
        element('span', { class: 'slide' }, this.#slider, this.#height),
        element(
          'span',
          { class: 'buttons' },
          button('+', 'Nearer', () => this.#view.zoomBy(1.5)),
          button('−', 'Farther', () => this.#view.zoomBy(1 / 1.5)),
          button('Show all', 'Show all chunks', () => this.#view.fit()),
        ),
      ),
      element('div', { class: 'map-frame' }, canvas),
      this.#readout,
      this.#count,
      this.#legend,
      this.#viewers,
    );
    this.#poller = new Poller(
      () => this.#load(),
      period,
      ({ error }) => {
        if (error && this.#world) this.#count.textContent = `There is no map at this moment: ${error.message}`;
      },
    );
    new IntersectionObserver((changes) => {
      this.#shown = changes.at(-1).isIntersecting;
      if (this.#shown) this.#poller.now();
    }).observe(node);
  }

  /** Shows the map of a world. name: the world's name, or null for no map. */
  show(name) {
    if (name === this.#world) return;
    this.#world = name;
    this.#map = null;
    this.#node.hidden = name === null;
    this.#poller.now();
  }

  async #load() {
    const world = this.#world;
    if (world === null || !this.#shown) return;
    const map = await this.#api.json(`/api/v1/worlds/${encodeURIComponent(world)}/chunks`);
    if (world !== this.#world) return;
    this.#map = map;
    this.#setHeights();
    this.#draw();
    this.#describe();
  }

  #setHeights() {
    const unit = this.#map.cell_meters * this.#map.chunk_cells;
    let [low, high] = [Infinity, -Infinity];
    for (const [level, , y] of this.#map.chunks) {
      low = Math.min(low, y * unit * 2 ** level);
      high = Math.max(high, (y + 1) * unit * 2 ** level);
    }
    if (!(high > low)) return;
    const first = this.#slider.max === '1' && this.#slider.min === '0';
    const value = first ? (this.#map.viewers[0]?.position[1] ?? (low + high) / 2) : Number(this.#slider.value);
    this.#slider.min = String(low);
    this.#slider.max = String(high - unit / 1000);
    this.#slider.step = String(unit / 4);
    this.#slider.value = String(value);
  }

  #draw() {
    if (!this.#map) return;
    const all = this.#all.checked,
      height = Number(this.#slider.value);
    this.#slider.disabled = all;
    this.#height.textContent = all ? 'y: all' : `y: ${number(height, 4)} m`;
    this.#view.show(this.#map, all ? null : height);
  }

  #describe() {
    const levels = [];
    for (const [level] of this.#map.chunks) levels[level] = (levels[level] ?? 0) + 1;
    const { total, chunks, truncated, cell_meters, chunk_cells, viewers } = this.#map;
    this.#count.replaceChildren(
      datum(total, count(total), { id: 'map-total' }),
      ` ${total === 1 ? 'chunk is' : 'chunks are'} drawn`,
      truncated ? `, the finest and nearest ${count(chunks.length)} of them here` : '',
    );
    this.#legend.replaceChildren(
      ...levels
        .map((found, level) =>
          element(
            'li',
            {},
            svg(
              'svg',
              { viewBox: '0 0 14 14', class: 'square', 'aria-hidden': 'true' },
              svg('rect', { width: 14, height: 14, class: `level ${colourOfLevel(level).slice(2)}` }),
            ),
            element('span', { text: `level ${level}, ${number(cell_meters * chunk_cells * 2 ** level)} m wide` }),
            datum(found, count(found)),
          ),
        )
        .filter(Boolean),
    );
    this.#viewers.textContent =
      viewers.length === 0
        ? 'No viewer looks at this world.'
        : `${counted(viewers.length, 'viewer')}: ` +
          viewers.map(({ position }, i) => `${i + 1} at ${position.map((x) => number(x, 4)).join(', ')}`).join('; ');
  }
}
