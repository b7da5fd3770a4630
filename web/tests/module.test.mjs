// The module without a browser: the bits of the native library, and answers to nonsense.

import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { test } from "node:test";
import { load } from "../page/module.js";

const here = (path) => new URL(path, import.meta.url);
const bytes = await readFile(here("../page/eem.wasm"));

const bits = (value) => {
  const view = new DataView(new ArrayBuffer(8));
  view.setFloat64(0, value);
  return view.getBigUint64(0).toString(16).padStart(16, "0");
};

test("runs have the bits of the native library", async () => {
  const eem = await load(bytes);
  const lines = [];
  const schemes = ["eem-temperature", "midpoint", "trapezoidal"];
  const { examples, sampleSize } = eem.contents();
  examples.forEach((example, index) => {
    assert.notEqual(eem.read(example.sheet).law, null);
    eem.start(example.setting, schemes);
    schemes.forEach((scheme, run) => {
      const { samples, failure } = eem.advance(run, 100);
      const made = samples.length / sampleSize;
      for (let step = 10; step <= made; step += 10) {
        const sample = samples.slice((step - 1) * sampleSize, step * sampleSize);
        lines.push([index, scheme, step, ...Array.from(sample, bits)].join(" "));
      }
      if (failure !== null) lines.push(`${index} ${scheme} ${made + 1} ends`);
    });
  });
  const stored = (await readFile(here("bits.txt"), "utf8")).trim().split("\n");
  assert.deepEqual(lines, stored);
});

test("texts of any kind are answered", async () => {
  let eem = await load(bytes);
  const [{ sheet }] = eem.contents().examples;
  const texts = ["", "\u0000", "ψ", "💧 = 3 J", "|", "k = ", "x".repeat(70000), `${sheet}\n`.repeat(50),
    "|x: Stretch| " + "(".repeat(60) + "x" + ")".repeat(60)];
  for (const text of texts) {
    const { law, mistakes } = eem.read(text);
    assert.ok(law !== null || mistakes.length > 0, text);
  }
  assert.notEqual(eem.read(sheet).law, null);
  assert.deepEqual(eem.start({}, ["eem-entropy"]), []);
  assert.equal(eem.advance(0, 1).failure, "there is no such run");
});

test("memory does not grow while one types and restarts", async () => {
  const eem = await load(bytes);
  const { examples } = eem.contents();
  const type = (times) => {
    for (let time = 0; time < times; time++) {
      const { sheet, setting } = examples[time % examples.length];
      eem.read(sheet.slice(0, -1 - (time % 40)));
      eem.read(sheet.replace("= 1 ", `= 1.${time} `));
      eem.start(setting, ["eem-temperature", "midpoint", "trapezoidal"]);
      eem.advance(0, 20);
    }
    return eem.memoryBytes();
  };
  const [before, after] = [type(100), type(300)];
  assert.ok(after <= before + 65536, `${before} bytes grew to ${after}`);
});
