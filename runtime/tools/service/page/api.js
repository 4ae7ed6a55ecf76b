// The service's answers, and its problems as errors. Where it wants a token, whoever looks at the page is asked once.

const tokenKey = 'sgm-token';

/** Why a request did not succeed. status: 0 where no answer came; code, detail, pointer, ...: as RFC 9457 has them. */
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
    // Not a problem of ours: a proxy's, perhaps.
  }
  return new Problem(status, { detail: `the service answered ${status} without saying why` });
}

export class Api {
  #askToken;
  #asked = null;
  #declined = false;

  /** askToken(wrong): a promise of the token, or of null where there is none to be had. */
  constructor(askToken) {
    this.#askToken = askToken;
  }

  /** The next request that wants a token may ask for it again. */
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
   * Sends a file; resolves with the report as it then is. progress(sent, whole): in bytes. signal: aborts.
   * Not by fetch(), which tells nothing of how much has gone out.
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

  /** Whether there is a token now. All who wait for one share one question. */
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
