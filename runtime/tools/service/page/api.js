// HTTP requests to the service. If the service answers with a problem, the request throws it as an error. If the
// service requires a token, the user is asked for it once.

const tokenKey = 'sgm-token';

/**
 * The reason why a request failed. status: HTTP status, or 0 if no answer arrived. Other members, such as code, detail
 * and pointer: as in the service's answer (RFC 9457).
 */
export class Problem extends Error {
  constructor(status, body) {
    super(body.detail ?? body.title ?? `the service answered ${status}`);
    this.status = status;
    this.body = { code: '', ...body, detail: this.message, status };
  }
}

const gone = (detail) => new Problem(0, { code: 'no_answer', title: 'No answer', detail });

function problemOf(status, text) {
  try {
    const body = JSON.parse(text);
    if (body && typeof body === 'object' && !Array.isArray(body)) return new Problem(status, body);
  } catch {
    // The answer is not JSON: perhaps it comes from a proxy, not from the service.
  }
  return new Problem(status, { detail: `the service answered ${status} without saying why` });
}

export class Api {
  #askToken;
  #asked = null;
  #declined = false;

  /**
   * askToken(wrong): asks the user for a token; returns a promise of the token, or of null if the user enters none.
   * wrong: whether the service has rejected the previous token.
   */
  constructor(askToken) {
    this.#askToken = askToken;
  }

  /** Lets the next request ask the user for a token again, even if the user has declined to enter a token before. */
  askAgain() {
    this.#declined = false;
  }

  async json(path) {
    const response = await this.#get(path);
    return response.json();
  }

  async bytes(path) {
    const response = await this.#get(path);
    return response.arrayBuffer();
  }

  /**
   * Sends a file. Resolves with the file's report in its current state. progress(sent, whole): called with numbers of
   * bytes. signal: AbortSignal that aborts the upload. Uses XMLHttpRequest, because fetch() does not report progress.
   */
  async upload(path, file, type, progress, signal) {
    for (;;) {
      const { status, text } = await this.#send(path, file, type, progress, signal);
      if (status === 401 && (await this.#newToken())) continue;
      if (status === 200 || status === 202) return JSON.parse(text);
      throw status === 0 ? gone('the connection to the service broke off') : problemOf(status, text);
    }
  }

  #send(path, file, type, progress, signal) {
    return new Promise((resolve, reject) => {
      const request = new XMLHttpRequest();
      const cancel = () => request.abort();
      request.upload.onprogress = (event) => progress(event.loaded, file.size);
      request.onabort = () => reject(new DOMException('cancelled', 'AbortError'));
      request.onloadend = () => {
        signal.removeEventListener('abort', cancel);
        resolve({ status: request.status, text: request.responseText });
      };
      request.open('POST', path);
      request.setRequestHeader('Content-Type', type);
      request.setRequestHeader('Prefer', 'respond-async');
      const token = this.#token();
      if (token) request.setRequestHeader('Authorization', `Bearer ${token}`);
      signal.addEventListener('abort', cancel);
      if (signal.aborted) cancel();
      else request.send(file);
    });
  }

  async #get(path) {
    for (;;) {
      const token = this.#token();
      let response;
      try {
        response = await fetch(path, {
          headers: token ? { Authorization: `Bearer ${token}` } : {},
          cache: 'no-store',
          credentials: 'omit',
          signal: AbortSignal.timeout(10000),
        });
      } catch (error) {
        throw gone(
          error.name === 'TimeoutError' ? 'the service took longer than 10 s to answer' : 'the service does not answer',
        );
      }
      if (response.ok) return response;
      if (response.status === 401 && (await this.#newToken())) continue;
      throw problemOf(response.status, await response.text());
    }
  }

  #token() {
    return sessionStorage.getItem(tokenKey);
  }

  /**
   * Asks the user for a token. Resolves with true if the user has entered one. Concurrent requests share one dialog.
   */
  #newToken() {
    if (this.#declined) return false;
    this.#asked ??= this.#askToken(this.#token() !== null).then((token) => {
      this.#asked = null;
      this.#declined = token === null;
      if (token === null) sessionStorage.removeItem(tokenKey);
      else sessionStorage.setItem(tokenKey, token);
      return token !== null;
    });
    return this.#asked;
  }
}
