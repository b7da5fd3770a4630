// Questions to the worker. One that breaks, or does not answer, is replaced by a new one.

/** Milliseconds that a question may take: texts of 64 KiB take seconds. */
const PATIENCE = 20000;

export class Engine {
  #worker = null;
  #number = 0;
  #pending = new Map();

  #hire() {
    this.#worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    this.#worker.onmessage = ({ data: { number, answer, broken } }) => {
      const question = this.#pending.get(number);
      if (broken !== undefined) return this.#replace(broken);
      clearTimeout(question.timer);
      this.#pending.delete(number);
      question.resolve(answer);
    };
    this.#worker.onerror = (event) => {
      event.preventDefault();
      this.#replace(event.message || "the worker could not be started");
    };
  }

  #replace(reason) {
    // The next question hires another one, so that one that cannot start is not tried for ever.
    this.#worker?.terminate();
    this.#worker = null;
    const left = [...this.#pending.values()];
    this.#pending.clear();
    for (const { timer, reject } of left) {
      clearTimeout(timer);
      reject(new Error(reason));
    }
  }

  /** Whether all is answered. */
  get isIdle() {
    return this.#pending.size === 0;
  }

  /** The answer to a question; an error if the worker had to be replaced, which then knows nothing of the past. */
  ask(kind, question = {}) {
    const number = ++this.#number;
    if (this.#worker === null) this.#hire();
    return new Promise((resolve, reject) => {
      const timer = setTimeout(
        () => this.#replace(`no answer within ${PATIENCE / 1000} s`), PATIENCE);
      this.#pending.set(number, { resolve, reject, timer });
      this.#worker.postMessage({ number, kind, question });
    });
  }
}
