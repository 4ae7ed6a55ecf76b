// A cursor in a chart, which the user moves with the pointer or the arrow keys. Screen readers read its text.

/**
 * Makes the chart `svg` a slider with size() positions. indexAt(x): returns the position nearest to x, in the svg's
 * units. show(index): draws the cursor, or hides it if index is null, and returns the text for that position. The
 * result is a function refresh(), which the caller must call when the chart's data have changed.
 */
export function addCursor(svg, { label, size, indexAt, show }) {
  let index = null;
  svg.setAttribute('role', 'slider');
  svg.setAttribute('tabindex', '0');
  svg.setAttribute('aria-label', label);
  svg.setAttribute('aria-valuemin', '0');

  function put(next) {
    const last = size() - 1;
    index = next === null || last < 0 ? null : Math.min(Math.max(next, 0), last);
    const text = show(index);
    const of = index ?? Math.max(last, 0);
    svg.setAttribute('aria-valuemax', String(Math.max(last, 0)));
    svg.setAttribute('aria-valuenow', String(of));
    svg.setAttribute('aria-valuetext', text);
  }

  const atPointer = (event) => {
    const matrix = svg.getScreenCTM();
    if (matrix) put(indexAt((event.clientX - matrix.e) / matrix.a));
  };
  svg.addEventListener('pointermove', atPointer);
  svg.addEventListener('pointerdown', atPointer);
  svg.addEventListener('pointerleave', () => put(null));
  svg.addEventListener('blur', () => put(null));
  svg.addEventListener('focus', () => {
    if (svg.matches(':focus-visible')) put(size() - 1);
  });
  svg.addEventListener('keydown', (event) => {
    const last = size() - 1,
      at = index ?? last;
    const next = {
      ArrowLeft: at - 1,
      ArrowDown: at - 1,
      ArrowRight: at + 1,
      ArrowUp: at + 1,
      PageUp: at - 10,
      PageDown: at + 10,
      Home: 0,
      End: last,
      Escape: null,
    }[event.key];
    if (next === undefined) return;
    event.preventDefault();
    put(next);
  });
  put(null);
  return () => put(index);
}
