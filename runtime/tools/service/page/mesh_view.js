// The 3D view of an uploaded mesh, with marks at its defects. The view turns by itself; the user can also turn it with
// the pointer or keys.

import { datum, element, reducedMotion, svg } from './element.js';
import { count, counted } from './format.js';
import { defectKinds, kindOf, outlineOf, signNode, totalOf } from './defect_kinds.js';
import { Camera, project } from './mesh_camera.js';
import { makePainter } from './mesh_painter.js';
import { defectEdges, faceNormal } from './mesh_preview.js';
import { makeWebglRenderer } from './mesh_webgl.js';

const turn_speed = 0.35; // radians per second
const way_seconds = 0.6;
/** If drawing takes more milliseconds than this, the view does not turn by itself. */
const slow = 120;

const channels = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255);

/**
 * Lines along the edges with defects, for each kind of defect. A kind has no lines if the report counts no such defect.
 * No kind has lines if the preview is a simplified mesh or a region's border cuts the mesh.
 */
function markedEdges(mesh, report) {
  const { preview, measures } = report;
  const edges = { open_edge: [], nonmanifold_edge: [], turned_edge: [] };
  const whole = preview.triangles === preview.of_triangles && measures.cut_edges === 0;
  if (!whole || !Object.keys(edges).some((kind) => totalOf(measures, kind) > 0)) return edges;
  const found = defectEdges(mesh);
  for (const kind of Object.keys(edges)) if (totalOf(measures, kind) > 0) edges[kind] = found[kind];
  return edges;
}

export class MeshView {
  #mesh;
  #camera;
  #edges;
  #places;
  #renderer;
  #canvas;
  #overlay = element('canvas', { class: 'marks', 'aria-hidden': 'true' });
  #frame;
  #flat = false;
  #turning = !reducedMotion();
  #shown = true;
  #asked = 0;
  #last = 0;
  #way = null;
  #chosen = null;
  #pointers = new Map();
  #turn;
  #observers = [];
  #note = element('p', { class: 'muted view-note' });

  /** mesh: result of readPreview(). report: the mesh's report. */
  constructor(mesh, report) {
    this.#mesh = mesh;
    this.#camera = new Camera(mesh);
    this.#edges = markedEdges(mesh, report);
    this.#places = (report.measures.places ?? []).map(({ kind, at }) => ({
      kind,
      at: at.map((x, axis) => x - report.preview.origin[axis]),
    }));
    this.#frame = element('div', {
      class: 'view-frame',
      tabindex: '0',
      role: 'application',
      id: 'mesh-view',
      'aria-label':
        'View of the mesh: arrow keys turn it, plus and minus zoom, 0 shows all, space stops or starts turning',
    });
    this.#useRenderer(false);
    this.#turn = element('button', {
      type: 'button',
      text: 'Turning',
      on: { click: () => this.#setTurning(!this.#turning) },
    });
    const shading = element('button', {
      type: 'button',
      text: 'Flat shading',
      'aria-pressed': 'false',
      on: {
        click: () => {
          this.#flat = !this.#flat;
          shading.setAttribute('aria-pressed', String(this.#flat));
          this.#ask();
        },
      },
    });
    shading.disabled = this.#renderer.name !== 'WebGL';
    const button = (text, label, act) =>
      element('button', { type: 'button', text, 'aria-label': label, title: label, on: { click: act } });
    this.node = element(
      'div',
      { class: 'view' },
      this.#frame,
      element(
        'div',
        { class: 'controls' },
        element(
          'span',
          { class: 'buttons' },
          this.#turn,
          shading,
          button('+', 'Nearer', () => this.#move(() => this.#camera.zoom(0.8))),
          button('−', 'Farther', () => this.#move(() => this.#camera.zoom(1.25))),
          button('Show all', 'Show all of the mesh', () => this.#reset()),
        ),
      ),
      this.#legend(report),
      this.#note,
    );
    const { preview } = report;
    this.#note.textContent = `${counted(preview.triangles, 'triangle')}${
      preview.triangles < preview.of_triangles
        ? `, simplified from ${count(preview.of_triangles)}: marks are true to the mesh as it came`
        : ''
    }${this.#renderer.name === 'WebGL' ? '' : '; drawn without WebGL'}.`;
    this.#setTurning(this.#turning);
    this.#listen();
  }

  dispose() {
    cancelAnimationFrame(this.#asked);
    for (const observer of this.#observers) observer.disconnect();
    this.#observers = [];
    this.#renderer.dispose();
  }

  /** Moves the camera to the defect report.measures.places[index]. */
  focus(index) {
    this.#chosen = index;
    this.#setTurning(false);
    this.#go(this.#camera.closeTo(this.#places[index].at));
    this.node.scrollIntoView({ block: 'nearest' });
  }

  #useRenderer(plain) {
    this.#renderer?.dispose();
    const make = (maker) => {
      this.#canvas = element('canvas', { 'aria-hidden': 'true' });
      return maker(this.#canvas);
    };
    this.#renderer =
      (plain
        ? null
        : make((canvas) => makeWebglRenderer(canvas, this.#mesh, this.#edges, faceNormal, () => this.#lost()))) ??
      make((canvas) => makePainter(canvas, this.#mesh, this.#edges));
    this.#frame.replaceChildren(this.#canvas, this.#overlay);
    this.#frame.dataset.renderer = this.#renderer.name;
  }

  #lost() {
    if (this.#observers.length === 0) return; // dispose() has released the context intentionally: ignore the event
    this.#useRenderer(true);
    this.#ask();
  }

  #legend(report) {
    const items = Object.keys(defectKinds)
      .filter((kind) => totalOf(report.measures, kind) > 0)
      .map((kind) =>
        element(
          'li',
          {},
          signNode(kind),
          element('span', { text: kindOf(kind).title }),
          datum(totalOf(report.measures, kind), count(totalOf(report.measures, kind)), { 'data-kind': kind }),
        ),
      );
    const side = (name, text) =>
      element(
        'li',
        {},
        svg(
          'svg',
          { viewBox: '0 0 14 14', class: 'square', 'aria-hidden': 'true' },
          svg('rect', { width: 14, height: 14, class: name }),
        ),
        element('span', { text }),
      );
    return element(
      'ul',
      { class: 'legend', 'aria-label': 'What the view shows' },
      side('side-outside', 'outside'),
      side('side-inside', 'inside'),
      ...items,
    );
  }

  #listen() {
    const frame = this.#frame;
    const at = (event) => [event.clientX, event.clientY];
    frame.addEventListener('pointerdown', (event) => {
      frame.setPointerCapture(event.pointerId);
      this.#pointers.set(event.pointerId, at(event));
      this.#setTurning(false);
    });
    for (const end of ['pointerup', 'pointercancel'])
      frame.addEventListener(end, (event) => this.#pointers.delete(event.pointerId));
    frame.addEventListener('pointermove', (event) => {
      const before = this.#pointers.get(event.pointerId),
        now = at(event);
      if (!before) return;
      const other = [...this.#pointers].find(([id]) => id !== event.pointerId)?.[1];
      const spread = (place) => Math.max(Math.hypot(place[0] - other[0], place[1] - other[1]), 1);
      this.#move(() =>
        other
          ? this.#camera.zoom(spread(before) / spread(now))
          : this.#camera.turn((before[0] - now[0]) * 0.009, (now[1] - before[1]) * 0.009),
      );
      this.#pointers.set(event.pointerId, now);
    });
    frame.addEventListener(
      'wheel',
      (event) => {
        event.preventDefault();
        this.#move(() => this.#camera.zoom(Math.exp(event.deltaY * 0.0012)));
      },
      { passive: false },
    );
    frame.addEventListener('keydown', (event) => {
      const act = {
        ArrowLeft: () => this.#camera.turn(-0.12, 0),
        ArrowRight: () => this.#camera.turn(0.12, 0),
        ArrowUp: () => this.#camera.turn(0, 0.12),
        ArrowDown: () => this.#camera.turn(0, -0.12),
        '+': () => this.#camera.zoom(0.8),
        '=': () => this.#camera.zoom(0.8),
        '-': () => this.#camera.zoom(1.25),
      }[event.key];
      const other = { 0: () => this.#reset(), Home: () => this.#reset(), ' ': () => this.#setTurning(!this.#turning) }[
        event.key
      ];
      if ((!act && !other) || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      if (act) this.#move(act);
      else other();
    });
    const resized = new ResizeObserver(() => this.#ask());
    resized.observe(frame);
    // On a busy machine one call reports several changes: use the last change.
    const seen = new IntersectionObserver((changes) => {
      this.#shown = changes.at(-1).isIntersecting;
      this.#ask();
    });
    seen.observe(frame);
    const scheme = matchMedia('(prefers-color-scheme: dark)'),
      redraw = () => this.#ask();
    scheme.addEventListener('change', redraw);
    this.#observers = [resized, seen, { disconnect: () => scheme.removeEventListener('change', redraw) }];
  }

  #setTurning(turning) {
    this.#turning = turning;
    this.#turn.setAttribute('aria-pressed', String(turning));
    this.#last = 0;
    this.#ask();
  }

  #move(change) {
    this.#way = null;
    this.#setTurning(false);
    change();
    this.#ask();
  }

  #reset() {
    this.#chosen = null;
    const to = new Camera(this.#mesh);
    this.#go(to.pose);
  }

  #go(to) {
    this.#way = reducedMotion() ? null : { from: this.#camera.pose, to, began: performance.now() };
    if (!this.#way) this.#camera.between(this.#camera.pose, to, 1);
    this.#ask();
  }

  #ask() {
    if (this.#asked || !this.#shown) return;
    this.#asked = requestAnimationFrame((time) => {
      this.#asked = 0;
      this.#step(time);
    });
  }

  #step(time) {
    if (this.#way) {
      const part = Math.min(Math.max(time - this.#way.began, 0) / 1000 / way_seconds, 1);
      this.#camera.between(this.#way.from, this.#way.to, part * part * (3 - 2 * part));
      if (part === 1) this.#way = null;
    } else if (this.#turning && this.#last > 0) {
      this.#camera.turn(turn_speed * Math.min((time - this.#last) / 1000, 0.1), 0);
    }
    this.#last = time;
    const began = performance.now();
    this.#draw();
    if (this.#turning && performance.now() - began > slow) this.#setTurning(false);
    if (this.#turning || this.#way) this.#ask();
  }

  #draw() {
    const ratio = Math.min(devicePixelRatio, 2),
      width = this.#frame.clientWidth,
      height = this.#frame.clientHeight;
    if (width === 0 || height === 0) return;
    for (const canvas of [this.#canvas, this.#overlay]) {
      if (canvas.width === Math.round(width * ratio) && canvas.height === Math.round(height * ratio)) continue;
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const style = getComputedStyle(this.#frame),
      colour = (name) => style.getPropertyValue(name).trim();
    const matrix = this.#camera.matrix(width / height);
    const marks = Object.fromEntries(
      Object.keys(this.#edges).map((kind) => [kind, channels(colour(`--${kindOf(kind).colour}`))]),
    );
    this.#renderer.draw({
      matrix,
      eye: this.#camera.eye,
      flat: this.#flat,
      ratio,
      colours: {
        outside: channels(colour('--mesh-outside')),
        inside: channels(colour('--mesh-inside')),
        ground: channels(colour('--mesh-ground')),
        marks,
      },
    });
    const context = this.#overlay.getContext('2d');
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    let marked = 0;
    this.#places.forEach((place, i) => {
      const [x, y, depth] = project(matrix, place.at, width, height);
      if (depth <= 0) return;
      this.#mark(context, place.kind, x, y, i === this.#chosen, colour);
      ++marked;
    });
    this.#frame.dataset.marked = String(marked);
  }

  #mark(context, kind, x, y, chosen, colour) {
    const size = chosen ? 8 : 5.5;
    context.beginPath();
    for (const [dx, dy] of outlineOf(kind)) context.lineTo(x + size * dx, y + size * dy);
    context.closePath();
    context.lineWidth = 3;
    context.strokeStyle = colour('--mark-halo');
    context.stroke();
    context.fillStyle = colour(`--${kindOf(kind).colour}`);
    context.fill();
    if (!chosen) return;
    context.beginPath();
    context.arc(x, y, 16, 0, 2 * Math.PI);
    context.lineWidth = 4;
    context.stroke();
    context.lineWidth = 2;
    context.strokeStyle = colour(`--${kindOf(kind).colour}`);
    context.stroke();
  }
}
