// The panel in which the user selects or drops files. Shows the progress of each upload.

import { byId, element, verdict } from './element.js';
import { bytes, percent } from './format.js';
import { showProblem } from './problem_view.js';
import { stateVerdict } from './report_list.js';
import { Uploads, endings } from './uploads.js';

const optionFields = [
  ['region', 'Region', 'x0,y0,z0:x1,y1,z1 in metres'],
  ['cell', 'Cell', 'metres'],
  ['seed', 'Seed', 'a whole number from 0'],
  ['set', 'Parameter', 'name=value'],
];

export class UploadPanel {
  #uploads;
  #open;
  #finished;
  #list = element('ul', { class: 'uploads', 'aria-label': 'Files sent from here' });
  #told = element('p', { class: 'unseen', role: 'status' });
  #items = new Map();
  #limit = element('span');

  /**
   * open(id): called when the user selects a report. finished(upload): called when an upload has been judged, rejected
   * or cancelled.
   */
  constructor(api, node, { open, finished }) {
    this.#open = open;
    this.#finished = finished;
    this.#uploads = new Uploads(api, (upload) => this.#show(upload));
    const input = element('input', {
      type: 'file',
      id: 'upload-input',
      class: 'unseen',
      multiple: true,
      accept: endings.map((ending) => `.${ending}`).join(','),
    });
    input.addEventListener('change', () => {
      this.#add(input.files);
      input.value = '';
    });
    node.append(
      element(
        'div',
        { class: 'drop' },
        input,
        element('label', { for: 'upload-input', class: 'button main', text: 'Choose files' }),
        element(
          'p',
          {},
          'or drop them anywhere on this page: meshes (.glb, .gltf, .obj, .ply, .stl) or grammars (.sgm)',
          this.#limit,
        ),
      ),
      this.#grammarOptions(),
      this.#told,
      this.#list,
    );
    this.#takeDrops();
  }

  limit(max_bytes) {
    this.#uploads.limit(max_bytes);
    this.#limit.textContent = `, up to ${bytes(max_bytes)} each`;
  }

  #grammarOptions() {
    return element(
      'details',
      { class: 'options' },
      element('summary', { text: 'Options for grammars' }),
      element(
        'div',
        { class: 'fields' },
        ...optionFields.map(([name, title, hint]) =>
          element(
            'p',
            { class: 'field' },
            element('label', { for: `option-${name}`, text: title }),
            element('input', {
              id: `option-${name}`,
              type: 'text',
              placeholder: hint,
              autocomplete: 'off',
              spellcheck: 'false',
            }),
          ),
        ),
      ),
    );
  }

  #add(files) {
    const options = optionFields
      .map(([name]) => [name, byId(`option-${name}`).value.trim()])
      .filter(([, value]) => value !== '');
    this.#uploads.add([...files], options);
  }

  #takeDrops() {
    const veil = byId('drop-veil');
    let depth = 0; // counts elements under the dragged file: enter and leave events occur for each nested element
    const holdsFiles = (event) => event.dataTransfer?.types.includes('Files');
    const show = (shown) => {
      veil.hidden = !shown;
    };
    addEventListener('dragenter', (event) => {
      if (!holdsFiles(event)) return;
      event.preventDefault();
      ++depth;
      show(true);
    });
    addEventListener('dragleave', (event) => {
      if (!holdsFiles(event)) return;
      depth = Math.max(depth - 1, 0);
      show(depth > 0);
    });
    addEventListener('dragover', (event) => {
      if (!holdsFiles(event)) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = 'copy';
    });
    addEventListener('drop', (event) => {
      if (!holdsFiles(event)) return;
      event.preventDefault();
      depth = 0;
      show(false);
      this.#add(event.dataTransfer.files);
    });
  }

  #item(upload) {
    const progress = element('progress', { max: '1', value: '0', 'aria-label': `Sending ${upload.file.name}` });
    const state = element('span', { class: 'state' }),
      actions = element('span', { class: 'buttons' }),
      more = element('div');
    const node = element(
      'li',
      {},
      element('span', { class: 'name', text: upload.file.name }),
      element('span', { class: 'muted', text: bytes(upload.file.size) }),
      state,
      actions,
      progress,
      more,
    );
    this.#list.prepend(node);
    return { state, actions, progress, more, last: '' };
  }

  #show(upload) {
    if (!this.#items.has(upload)) this.#items.set(upload, this.#item(upload));
    const item = this.#items.get(upload),
      share = upload.file.size > 0 ? upload.sent / upload.file.size : 1;
    item.progress.value = share;
    if (upload.state === 'sending')
      item.state.replaceChildren(verdict('waiting', `sending ${percent(Math.min(share, 1), 2)}`));
    if (item.last === upload.state) return;
    item.last = upload.state;
    item.progress.hidden = upload.state !== 'sending';
    const button = (text, act) =>
      element('button', { type: 'button', text, 'aria-label': `${text}: ${upload.file.name}`, on: { click: act } });
    const cancellable = ['queued', 'sending'].includes(upload.state);
    item.actions.replaceChildren(
      ...(cancellable ? [button('Cancel', () => this.#uploads.cancel(upload))] : []),
      ...(upload.report ? [button('Open', () => this.#open(upload.report.id))] : []),
    );
    if (upload.state === 'queued') item.state.replaceChildren(verdict('waiting', 'queued'));
    if (upload.state === 'judging') item.state.replaceChildren(verdict('waiting', 'being judged'));
    if (!upload.over) return;
    item.state.replaceChildren(
      upload.state === 'done' ? stateVerdict(upload.report) : stateVerdict({ state: upload.state }),
    );
    const problem =
      upload.problem?.body ?? upload.report?.problem ?? (upload.problem ? { detail: upload.problem.message } : null);
    if (problem && upload.state === 'failed') item.more.replaceChildren(showProblem(problem));
    this.#told.textContent = `${upload.file.name}: ${item.state.textContent}`;
    this.#finished(upload);
  }
}
