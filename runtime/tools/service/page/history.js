// The samples of a world over the last five minutes.

export const historySeconds = 300;

export class History {
  #samples = [];

  /** Adds a sample, and removes samples that are older than historySeconds. sample.time: seconds, ascending. */
  add(sample) {
    this.#samples.push(sample);
    const first = this.#samples.findIndex((old) => old.time >= sample.time - historySeconds - 2);
    if (first > 0) this.#samples.splice(0, first);
  }

  get samples() {
    return this.#samples;
  }
}
