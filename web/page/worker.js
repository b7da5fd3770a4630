// The worker: answers one question after the other, so that the page never waits.

import { load } from "./module.js";

/** Milliseconds of stepping in one answer, so that pictures keep coming. */
const BUDGET = 12;
/** Steps of one run before the others have their turn. */
const TURN = 16;

const ready = fetch(new URL("eem.wasm", import.meta.url)).then(async (response) => {
  if (!response.ok) throw new Error(`eem.wasm: ${response.status} ${response.statusText}`);
  return load(await response.arrayBuffer());
});

/** Steps that each run has made. */
let made = 0;

const answers = {
  contents: (eem) => eem.contents(),
  read: (eem, { sheet }) => eem.read(sheet),
  start(eem, { setting, schemes }) {
    made = 0;
    return eem.start(setting, schemes);
  },
  /** Goes on until each run has made so many steps, or time is up. */
  advance(eem, { runs, steps }) {
    const end = performance.now() + BUDGET;
    const parts = Array.from({ length: runs }, () => []);
    const last = [];
    while (made < steps && performance.now() < end) {
      const turn = Math.min(TURN, steps - made);
      for (let run = 0; run < runs; run++) {
        const { samples, ...standing } = eem.advance(run, turn);
        parts[run].push(...samples);
        last[run] = standing;
      }
      made += turn;
    }
    return last.map((standing, run) => ({ ...standing, samples: Float64Array.from(parts[run]) }));
  },
};

onmessage = async ({ data: { number, kind, question } }) => {
  try {
    postMessage({ number, answer: answers[kind](await ready, question) });
  } catch (error) {
    postMessage({ number, broken: String(error) });
  }
};
