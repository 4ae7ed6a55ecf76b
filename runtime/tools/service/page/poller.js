// Repeats a query. Pauses while the tab is hidden, and waits longer and longer while the service does not answer.

const longestWait = 15000;

export class Poller {
  #ask;
  #told;
  #period;
  #timer = 0;
  #asking = false;
  #failures = 0;

  /**
   * ask(): sends the query and returns a promise. told({ok, error, retry}): called after each query; retry:
   * milliseconds until the next query. period: milliseconds between successful queries.
   */
  constructor(ask, period, told = () => {}) {
    this.#ask = ask;
    this.#told = told;
    this.#period = period;
    document.addEventListener('visibilitychange', () => (document.hidden ? this.#stop() : this.now()));
  }

  /** Sends a query immediately, and then periodically. */
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
