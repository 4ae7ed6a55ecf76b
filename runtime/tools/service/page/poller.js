// Asks again and again: not while the tab is hidden, and less and less often while nobody answers.

const longestWait = 15000;

export class Poller {
  #ask;
  #told;
  #period;
  #timer = 0;
  #asking = false;
  #failures = 0;

  /**
   * ask(): a promise. told({ok, error, retry}): after each; retry: milliseconds until the next.
   * period: milliseconds between two, while all is well.
   */
  constructor(ask, period, told = () => {}) {
    this.#ask = ask;
    this.#told = told;
    this.#period = period;
    document.addEventListener('visibilitychange', () => (document.hidden ? this.#stop() : this.now()));
  }

  /** At once, and then as often as it should be. */
  now() {
    this.#stop();
    if (!document.hidden && !this.#asking) this.#run();
  }

  #stop() {
    clearTimeout(this.#timer);
    this.#timer = 0;
  }

  async #run() {
    const began = performance.now();
    let error = null;
    this.#asking = true;
    try {
      await this.#ask();
      this.#failures = 0;
    } catch (caught) {
      error = caught;
      ++this.#failures;
    }
    this.#asking = false;
    const took = performance.now() - began;
    const retry = error
      ? Math.min(this.#period * 2 ** (this.#failures - 1), longestWait)
      : Math.max(this.#period - took, this.#period / 4);
    this.#told({ ok: error === null, error, retry });
    this.#stop();
    if (!document.hidden) this.#timer = setTimeout(() => this.#run(), retry);
  }
}
