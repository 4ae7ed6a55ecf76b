// The map of a world: draws its chunks on a canvas as squares, seen from above; x points right, z down.

import { counted, number } from './format.js';

/** Number of colours for levels of detail; all coarser levels share the last colour. */
export const levelColours = 9;
export const colourOfLevel = (level) => `--level-${Math.min(level, levelColours - 1)}`;

const smallestScale = 1e-4,
  largestScale = 1e3; // pixels per metre

export class MapView {
  #canvas;
  #told;
  #map = null;
  #byLevel = [];
  #height = null;
  #view = null; // {x, z: centre in metres, scale: pixels per metre}; null: the whole map is visible
  #drawn = 0;
  #asked = false;
  #pointers = new Map();

  /** told(text): called with a description of the chunk under the pointer, or at the centre of the map. */
  constructor(canvas, told) {
    this.#canvas = canvas;
    this.#told = told;
    new ResizeObserver(() => this.#ask()).observe(canvas);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.#ask());
    canvas.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        this.#zoom(Math.exp(-event.deltaY * 0.0015), ...this.#at(event));
      },
      { passive: false },
    );
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.#pointers.set(event.pointerId, this.#at(event));
    });
    for (const end of ['pointerup', 'pointercancel'])
      canvas.addEventListener(end, (event) => this.#pointers.delete(event.pointerId));
    canvas.addEventListener('pointermove', (event) => this.#moved(event));
    canvas.addEventListener('pointerleave', () => this.#told(''));
    canvas.addEventListener('keydown', (event) => this.#key(event));
    canvas.addEventListener('focus', () => this.#ask());
    canvas.addEventListener('blur', () => this.#ask());
  }

  /** Number of chunks that the map shows at present. */
  get drawn() {
    return this.#drawn;
  }

  /**
   * map: answer of /api/v1/worlds/NAME/chunks. height: metres; only chunks that contain this height are shown. null:
   * all chunks are shown.
   */
  show(map, height) {
    if (this.#map?.name !== map.name) this.#view = null;
    this.#map = map;
    this.#height = height;
    this.#byLevel = [];
    for (const chunk of map.chunks) (this.#byLevel[chunk[0]] ??= []).push(chunk);
    this.#ask();
  }

  fit() {
    this.#view = null;
    this.#ask();
  }

  zoomBy(factor) {
    this.#zoom(factor, this.#canvas.clientWidth / 2, this.#canvas.clientHeight / 2);
  }

  #at(event) {
    const box = this.#canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #width(level) {
    return this.#map.cell_meters * this.#map.chunk_cells * 2 ** level;
  }

  #isShown(chunk) {
    if (this.#height === null) return true;
    const width = this.#width(chunk[0]);
    return chunk[2] * width <= this.#height && this.#height < (chunk[2] + 1) * width;
  }

  /** The view that shows the whole map. */
  #whole() {
    let [x0, z0, x1, z1] = [Infinity, Infinity, -Infinity, -Infinity];
    const include = (x, z, width) => {
      [x0, z0, x1, z1] = [Math.min(x0, x), Math.min(z0, z), Math.max(x1, x + width), Math.max(z1, z + width)];
    };
    for (const [level, x, , z] of this.#map.chunks)
      include(x * this.#width(level), z * this.#width(level), this.#width(level));
    for (const { position } of this.#map.viewers) include(position[0], position[2], 0);
    if (!(x1 > x0) || !(z1 > z0)) [x0, z0, x1, z1] = [-50, -50, 50, 50];
    const scale = 0.94 * Math.min(this.#canvas.clientWidth / (x1 - x0), this.#canvas.clientHeight / (z1 - z0));
    return { x: (x0 + x1) / 2, z: (z0 + z1) / 2, scale: Math.min(Math.max(scale, smallestScale), largestScale) };
  }

  #zoom(factor, x, y) {
    if (!this.#map) return;
    const old = this.#view ?? this.#whole();
    const scale = Math.min(Math.max(old.scale * factor, smallestScale), largestScale);
    const dx = x - this.#canvas.clientWidth / 2,
      dy = y - this.#canvas.clientHeight / 2;
    this.#view = { scale, x: old.x + dx / old.scale - dx / scale, z: old.z + dy / old.scale - dy / scale };
    this.#ask();
  }

  #pan(dx, dy) {
    if (!this.#map) return;
    const old = this.#view ?? this.#whole();
    this.#view = { ...old, x: old.x - dx / old.scale, z: old.z - dy / old.scale };
    this.#ask();
  }

  #moved(event) {
    const at = this.#at(event),
      before = this.#pointers.get(event.pointerId);
    if (before && this.#pointers.size === 1) this.#pan(at[0] - before[0], at[1] - before[1]);
    if (before && this.#pointers.size === 2) {
      const [other] = [...this.#pointers].filter(([id]) => id !== event.pointerId).map(([, place]) => place);
      const spread = (place) => Math.max(Math.hypot(place[0] - other[0], place[1] - other[1]), 1);
      this.#zoom(spread(at) / spread(before), other[0], other[1]);
    }
    if (before) this.#pointers.set(event.pointerId, at);
    else this.#told(this.#textAt(...at));
  }

  #key(event) {
    const step = 40;
    const act = {
      ArrowLeft: () => this.#pan(step, 0),
      ArrowRight: () => this.#pan(-step, 0),
      ArrowUp: () => this.#pan(0, step),
      ArrowDown: () => this.#pan(0, -step),
      '+': () => this.zoomBy(1.25),
      '=': () => this.zoomBy(1.25),
      '-': () => this.zoomBy(0.8),
      0: () => this.fit(),
      Home: () => this.fit(),
    }[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
    this.#told(this.#textAt(this.#canvas.clientWidth / 2, this.#canvas.clientHeight / 2));
  }

  #textAt(px, py) {
    if (!this.#map) return '';
    const view = this.#view ?? this.#whole();
    const x = view.x + (px - this.#canvas.clientWidth / 2) / view.scale;
    const z = view.z + (py - this.#canvas.clientHeight / 2) / view.scale;
    const here = `x ${number(x, 5)} m, z ${number(z, 5)} m`;
    for (let level = 0; level < this.#byLevel.length; ++level) {
      const width = this.#width(level),
        i = Math.floor(x / width),
        k = Math.floor(z / width);
      const found = (this.#byLevel[level] ?? []).filter(
        (chunk) => chunk[1] === i && chunk[3] === k && this.#isShown(chunk),
      );
      if (found.length === 0) continue;
      const triangles = found.reduce((sum, chunk) => sum + chunk[4], 0);
      return (
        `${here}: level ${level}, chunk ${width} m wide, ` +
        (found.length === 1 ? `key ${found[0].slice(1, 4).join(', ')}` : `${found.length} above each other`) +
        `, ${counted(triangles, 'triangle')}`
      );
    }
    return `${here}: nothing is drawn here`;
  }

  #ask() {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      if (this.#map && this.#canvas.clientWidth > 0) this.#draw();
    });
  }

  #draw() {
    const canvas = this.#canvas,
      ratio = Math.min(devicePixelRatio, 2);
    const width = canvas.clientWidth,
      height = canvas.clientHeight;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    const context = canvas.getContext('2d'),
      colours = getComputedStyle(canvas);
    const colour = (name) => colours.getPropertyValue(name).trim();
    const view = this.#view ?? this.#whole();
    context.scale(ratio, ratio);
    context.fillStyle = colour('--map-ground');
    context.fillRect(0, 0, width, height);

    this.#drawn = 0;
    context.strokeStyle = colour('--map-line');
    // Draw coarse levels first: where chunks lie above each other, the finest one stays visible.
    for (let level = this.#byLevel.length - 1; level >= 0; --level) {
      const meters = this.#width(level),
        size = meters * view.scale;
      context.fillStyle = colour(colourOfLevel(level));
      context.lineWidth = size > 12 ? 1 : 0.5;
      for (const chunk of this.#byLevel[level] ?? []) {
        if (!this.#isShown(chunk)) continue;
        const x = (chunk[1] * meters - view.x) * view.scale + width / 2;
        const y = (chunk[3] * meters - view.z) * view.scale + height / 2;
        if (x > width || y > height || x + size < 0 || y + size < 0) continue;
        context.fillRect(x, y, size, size);
        if (size > 5) context.strokeRect(x, y, size, size);
        ++this.#drawn;
      }
    }
    this.#map.viewers.forEach((viewer, i) => this.#drawViewer(context, viewer, i, view, colour));
    this.#drawScale(context, view, colour);
    if (canvas.matches(':focus-visible')) this.#drawMiddle(context, colour);
    canvas.dataset.drawn = String(this.#drawn);
  }

  #drawViewer(context, { position, direction }, i, view, colour) {
    const x = (position[0] - view.x) * view.scale + this.#canvas.clientWidth / 2;
    const y = (position[2] - view.z) * view.scale + this.#canvas.clientHeight / 2;
    context.save();
    context.translate(x, y);
    context.lineWidth = 2;
    context.strokeStyle = colour('--map-halo');
    context.fillStyle = colour('--viewer');
    const flat = Math.hypot(direction[0], direction[2]);
    context.save();
    if (flat > 0.05) {
      context.rotate(Math.atan2(direction[2], direction[0]));
      context.beginPath();
      context.moveTo(17, 0);
      context.lineTo(-9, -9);
      context.lineTo(-4, 0);
      context.lineTo(-9, 9);
      context.closePath();
    } else {
      context.beginPath(); // the viewer looks straight up or down: draw a circle instead of an arrow
      context.arc(0, 0, 8, 0, 2 * Math.PI);
    }
    context.stroke();
    context.fill();
    context.restore();
    context.font = '600 12px system-ui, sans-serif';
    context.lineWidth = 3;
    context.strokeText(String(i + 1), -4, 26);
    context.fillStyle = colour('--text');
    context.fillText(String(i + 1), -4, 26);
    context.restore();
  }

  #drawScale(context, view, colour) {
    const height = this.#canvas.clientHeight,
      power = 10 ** Math.floor(Math.log10(110 / view.scale));
    const meters = [5, 2, 1].map((step) => step * power).find((length) => length * view.scale <= 110) ?? power;
    const text = meters >= 1000 ? `${number(meters / 1000)} km` : `${number(meters)} m`;
    const size = meters * view.scale;
    context.fillStyle = colour('--map-halo');
    context.globalAlpha = 0.85;
    context.fillRect(6, height - 34, Math.max(size, 62) + 16, 28);
    context.globalAlpha = 1;
    context.fillStyle = context.strokeStyle = colour('--text');
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(14, height - 16);
    context.lineTo(14, height - 11);
    context.lineTo(14 + size, height - 11);
    context.lineTo(14 + size, height - 16);
    context.stroke();
    context.font = '12px system-ui, sans-serif';
    context.fillText(text, 14, height - 20);
  }

  #drawMiddle(context, colour) {
    const [x, y] = [this.#canvas.clientWidth / 2, this.#canvas.clientHeight / 2];
    context.strokeStyle = colour('--text');
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x - 8, y);
    context.lineTo(x + 8, y);
    context.moveTo(x, y - 8);
    context.lineTo(x, y + 8);
    context.stroke();
  }
}
