// The list of the places with defects. If the user selects an entry, the mesh view moves its camera to the place.

import { element } from './element.js';
import { count, counted, place } from './format.js';
import { kindOf, signNode, totalOf } from './defect_kinds.js';

/** focus(index): called when the user selects measures.places[index]. */
export function showPlaces(measures, focus) {
  const places = measures.places ?? [];
  const node = element('div', { class: 'places' });
  if (places.length === 0) {
    node.append(element('p', { class: 'muted', text: 'No defect has a place.' }));
    return node;
  }
  const kinds = [...new Set(places.map(({ kind }) => kind))];
  for (const kind of kinds) {
    const total = totalOf(measures, kind);
    const mine = places.map((one, index) => ({ ...one, index })).filter((one) => one.kind === kind);
    const rest = total > mine.length ? `, the first ${mine.length} here` : '';
    node.append(
      element('h4', {}, signNode(kind), element('span', { text: `${counted(total, kindOf(kind).title)}${rest}` })),
      element(
        'ul',
        {},
        ...mine.map((one) =>
          element(
            'li',
            {},
            element(
              'button',
              {
                type: 'button',
                class: 'link',
                'data-place': one.index,
                'aria-label': `Show ${kindOf(kind).title} at ${place(one.at)}`,
                on: { click: () => focus(one.index) },
              },
              `${place(one.at)} · triangle ${count(one.triangle)}`,
            ),
          ),
        ),
      ),
    );
  }
  return node;
}
