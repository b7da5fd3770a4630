// What a run has done: all of it in at most a few thousand samples, and the last steps one by one.

/** Samples that are kept of the whole run; then every second one goes. */
const MOST = 3000;
/** Last steps that are kept. */
const RECENT = 240;

/** Numbers of a sample, by their places in it. */
export const [TIME, X, Y, ENERGY, ENTROPY, TEMPERATURE] = [0, 1, 2, 3, 4, 5];

export class History {
  #size;
  #stride = 1;
  #count = 0;
  all = [];
  recent = [];

  constructor(size) {
    this.#size = size;
  }

  add(samples) {
    for (let start = 0; start < samples.length; start += this.#size) {
      const sample = samples.subarray(start, start + this.#size);
      if (this.#count++ % this.#stride === 0) this.all.push(sample);
      this.recent.push(sample);
      if (this.all.length > MOST) {
        this.all = this.all.filter((_, index) => index % 2 === 0);
        this.#stride *= 2;
      }
    }
    // Some more than are drawn, so that this is rare.
    if (this.recent.length > 2 * RECENT) this.recent = this.recent.slice(-RECENT);
  }

  get last() {
    return this.recent.at(-1);
  }

  /** The sample at a time: between two steps on the straight line. */
  at(time) {
    const after = this.recent.findIndex((sample) => sample[TIME] > time);
    if (after < 0) return this.last;
    if (after === 0) return this.recent[0];
    const [a, b] = [this.recent[after - 1], this.recent[after]];
    const part = (time - a[TIME]) / (b[TIME] - a[TIME]);
    return a.map((value, place) => value + part * (b[place] - value));
  }
}
