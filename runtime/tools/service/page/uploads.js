// Queue of files to upload. One file is sent at a time; each can be cancelled until it has been sent.

import { bytes } from './format.js';

const types = {
  glb: 'model/gltf-binary',
  gltf: 'model/gltf+json',
  obj: 'model/obj',
  stl: 'model/stl',
  ply: 'model/ply',
  sgm: 'text/x-sgm',
};
export const endings = Object.keys(types);

const endingOf = (name) => name.slice(name.lastIndexOf('.') + 1).toLowerCase();
const pause = (milliseconds) =>
  new Promise((resolve) => {
    setTimeout(resolve, milliseconds);
  });

/**
 * Shortens a file name to the 255 bytes of UTF-8 that the service accepts. The end of the name is kept, because it
 * contains the extension.
 */
function shortName(name) {
  let kept = name;
  while (new TextEncoder().encode(kept).length > 255) kept = kept.slice(1);
  return kept;
}

/**
 * The upload of one file. state: queued, sending, judging, done, failed or cancelled. sent: number of bytes sent.
 * problem: why the upload failed.
 */
export class Upload {
  constructor(file, options) {
    this.file = file;
    this.options = options;
    this.state = 'queued';
    this.sent = 0;
    this.problem = null;
    this.report = null;
    this.abort = new AbortController();
  }

  get over() {
    return ['done', 'failed', 'cancelled'].includes(this.state);
  }
}

export class Uploads {
  #api;
  #told;
  #queue = [];
  #sending = false;
  #maxBytes = Infinity;

  /** told(upload): called whenever an upload's state has changed. */
  constructor(api, told) {
    this.#api = api;
    this.#told = told;
  }

  /** Sets the maximum file size that the service accepts. Larger files fail without being sent. */
  limit(max_bytes) {
    this.#maxBytes = max_bytes;
  }

  /** Adds files to the queue. options: query parameters for grammars, [[name, value]]. */
  add(files, options) {
    for (const file of files) {
      const upload = new Upload(file, endingOf(file.name) === 'sgm' ? options : []);
      this.#queue.push(upload);
      this.#told(upload);
    }
    this.#run();
  }

  /** Cancels an upload. Has no effect once the file has been sent completely: the service then always judges it. */
  cancel(upload) {
    if (upload.state === 'queued') this.#set(upload, 'cancelled');
    if (upload.state === 'sending') upload.abort.abort();
  }

  #set(upload, state) {
    upload.state = state;
    this.#told(upload);
  }

  /** The reason why the service would reject a file, if it is known before the file is sent; otherwise null. */
  #whyNot({ name, size }) {
    if (!(endingOf(name) in types))
      return `This file cannot be validated: the service takes ${endings.map((ending) => `.${ending}`).join(', ')}`;
    if (size > this.#maxBytes)
      return `This file is too large: ${bytes(size)}, and the service takes ${bytes(this.#maxBytes)} at most`;
    return null;
  }

  async #run() {
    if (this.#sending) return;
    this.#sending = true;
    while (this.#queue.length > 0) {
      const upload = this.#queue.shift();
      if (upload.state === 'queued') await this.#send(upload);
    }
    this.#sending = false;
  }

  async #send(upload) {
    const { file } = upload;
    this.#set(upload, 'sending');
    try {
      const why_not = this.#whyNot(file);
      if (why_not) throw new Error(why_not);
      const query = new URLSearchParams([['name', shortName(file.name)], ...upload.options]);
      const type = types[endingOf(file.name)];
      upload.report = await this.#api.upload(
        `/api/v1/validate?${query}`,
        file,
        type,
        (sent) => {
          upload.sent = sent;
          this.#told(upload);
        },
        upload.abort.signal,
      );
      this.#set(upload, 'judging');
      this.#follow(upload);
    } catch (error) {
      upload.problem = error;
      this.#set(upload, error.name === 'AbortError' ? 'cancelled' : 'failed');
    }
  }

  /** Waits until the upload's report is finished. Meanwhile, the next file is sent. */
  async #follow(upload) {
    try {
      for (let wait = 100; ['waiting', 'running'].includes(upload.report.state); wait = Math.min(wait * 1.5, 1000)) {
        await pause(wait);
        upload.report = await this.#api.json(`/api/v1/reports/${encodeURIComponent(upload.report.id)}`);
      }
      this.#set(upload, upload.report.state);
    } catch (error) {
      upload.problem = error;
      this.#set(upload, 'failed');
    }
  }
}
