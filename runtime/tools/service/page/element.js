// Makes DOM elements. Text is always inserted as text, never as HTML, because it may contain file names from any
// client.

function build(node, options, children) {
  for (const [key, value] of Object.entries(options)) {
    if (value === undefined || value === null || value === false) continue;
    if (key === 'text') node.textContent = value;
    else if (key === 'on') for (const [type, listener] of Object.entries(value)) node.addEventListener(type, listener);
    else node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/**
 * Makes an HTML element. options: the element's attributes by name; in addition, `text`: the text content, and `on`:
 * event listeners, {event: listener}. Attributes that are null or false are omitted.
 */
export function element(tag, options = {}, ...children) {
  return build(document.createElement(tag), options, children);
}

export function svg(tag, options = {}, ...children) {
  return build(document.createElementNS('http://www.w3.org/2000/svg', tag), options, children);
}

export const byId = (id) => document.getElementById(id);

/** A <data> element: a number as readable text, with its exact value for programs. */
export function datum(value, text, options = {}) {
  return element('data', { value: String(value), text, ...options });
}

const icons = {
  ok: 'M3 8.5 6.5 12 13 4.5',
  attention: 'M8 2 14.5 13.5H1.5Z M8 6.2V9.6 M8 11.6V11.7',
  defect: 'M4 4 12 12 M12 4 4 12',
  unknown: 'M5.4 6A2.6 2.6 0 1 1 8 8.6V9.8 M8 12.4V12.5',
  waiting: 'M8 1.8A6.2 6.2 0 1 0 8.01 1.8 M8 4.5V8L10.6 9.8',
  info: 'M8 7V12 M8 4V4.1',
};

/**
 * A verdict, shown by an icon and a word in addition to its colour. kind: ok, attention, defect, unknown, waiting or
 * info.
 */
export function verdict(kind, text) {
  return element(
    'span',
    { class: `verdict ${kind}` },
    svg('svg', { viewBox: '0 0 16 16', class: 'sign', 'aria-hidden': 'true' }, svg('path', { d: icons[kind] })),
    element('span', { text }),
  );
}

export const reducedMotion = () => matchMedia('(prefers-reduced-motion: reduce)').matches;
