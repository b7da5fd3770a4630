// The page: what is typed and moved, and what is drawn.

import { colours } from "./canvas.js";
import { Chart } from "./chart.js";
import { Editor } from "./editor.js";
import { Engine } from "./engine.js";
import { ENERGY, ENTROPY, History, TIME } from "./history.js";
import { around, slider } from "./sliders.js";
import { Stage } from "./stage.js";

/** Schemes to begin with: one that keeps the laws, and two that do not. */
const SCHEMES = ["eem-temperature", "midpoint", "trapezoidal"];

/** Sliders of the start: key, name, unit, range, whether only for springs with a temperature. */
const STEP = { key: "step", name: "h", note: "step size", unit: "s", least: 0.001, most: 1, isLogarithmic: true };
const SETTING = [
  { key: "length", name: "Length", unit: "m", least: 0.2, most: 5 },
  { key: "speed", name: "Velocity", note: "across the spring", unit: "m/s", least: 0, most: 10 },
  { key: "mass", name: "Mass", unit: "kg", least: 0.1, most: 10, isLogarithmic: true },
  { key: "gravity", name: "Gravity", unit: "m/s²", least: 0, most: 20 },
  { key: "spring", name: "Spring", note: "its temperature", unit: "K", least: 200, most: 600, isThermal: true },
  { key: "air", name: "Air", note: "its temperature", unit: "K", least: 200, most: 600, isThermal: true },
  { key: "conductance", name: "Conductance", note: "spring to air", unit: "W/K", least: 0.01, most: 100, isLogarithmic: true, isThermal: true },
];

const at = (id) => document.getElementById(id);
const engine = new Engine();
const stage = new Stage(at("stage"));
const charts = [
  new Chart(at("energy"), "Energy: E − E₀ (J)", ENERGY, 1e-3),
  new Chart(at("entropy"), "Entropy: S − S₀ (J/K)", ENTROPY, 1e-3),
];
const editor = new Editor(at("editor"), () => read());

/** Numbers of a sample. */
let sampleSize;
let setting;
let schemes = [...SCHEMES];
/** The last sheet that was right, and what it means. */
let good = { sheet: "", law: null };
/** The text in which the places of values are known, and the parameters. */
let placed = { text: null, parameters: [] };
let runs = [];
/** Time of the picture, s. */
let clock = 0;
let isPlaying = true;
/** Ranges of sliders by name; they stay while values change within them. */
let ranges = new Map();
/** What the sliders of parameters show beside values. */
let shownKind = "";

const say = (text, isBad = false) => {
  at("state").textContent = text;
  at("state").classList.toggle("bad", isBad);
};

/** Runs one task after the other; of those that wait only the last one is done. */
function latest(task) {
  let isBusy = false;
  let isAsked = false;
  return async () => {
    isAsked = true;
    if (isBusy) return;
    isBusy = true;
    while (isAsked) {
      isAsked = false;
      try {
        await task();
      } catch (error) {
        await recover(error);
      }
    }
    isBusy = false;
  };
}

/** After the worker had to be replaced: the last sheet that was right goes on. */
async function recover(error) {
  say(`The solver was restarted: ${error.message}`, true);
  runs = [];
  if (good.law === null) return;
  try {
    await engine.ask("read", { sheet: good.sheet });
    await begin();
  } catch (again) {
    say(`The solver does not work here: ${again.message}`, true);
    good.law = null;
  }
}

const read = latest(async () => {
  const sheet = editor.text;
  const { law, mistakes } = await engine.ask("read", { sheet });
  if (sheet !== editor.text) return read();
  editor.show(mistakes);
  const errors = mistakes.filter((mistake) => !mistake.is_warning).length;
  if (law === null) {
    return say(`${errors} ${errors === 1 ? "mistake" : "mistakes"}; the pendulum goes on with the last material that was right.`, true);
  }
  say("No mistakes.");
  good = { sheet, law };
  placed = { text: sheet, parameters: law.parameters };
  showLaw(law);
  await begin();
});

const restart = latest(() => (good.law === null ? undefined : begin()));

/** Starts all runs with the last material. */
async function begin() {
  const standings = await engine.ask("start", { setting, schemes });
  runs = standings.map(({ samples, ...standing }) => {
    const history = new History(sampleSize);
    history.add(samples);
    return { ...standing, history };
  });
  clock = 0;
  stage.reset();
}

/** Asks for the steps until the next picture, and one more to draw towards. */
async function advance() {
  const steps = Math.ceil(clock / setting.step) + 1;
  const asked = runs;
  const standings = await engine.ask("advance", { runs: runs.length, steps });
  // Another start has come in between.
  if (asked !== runs) return;
  standings.forEach(({ samples, ...standing }, index) => {
    runs[index].history.add(samples);
    Object.assign(runs[index], standing);
  });
}

function showLaw({ parameters, is_thermal, formulas }) {
  const names = parameters.map((one) => one.name);
  ranges = new Map([...ranges].filter(([name]) => names.includes(name)));
  const rows = parameters.map((one) => {
    let range = ranges.get(one.name);
    if (!range || one.value < range.least || one.value > range.most) {
      range = around(one.value);
      ranges.set(one.name, range);
    }
    return { ...one, ...range };
  });
  // Sliders stay while only values change: one of them may be in a hand.
  const kind = JSON.stringify(rows.map(({ name, note, unit, least, most }) => [name, note, unit, least, most]));
  if (kind === shownKind) {
    rows.forEach(({ value }, index) => at("parameters").children[index].set(value));
  } else {
    shownKind = kind;
    at("parameters").replaceChildren(...rows.map((one) =>
      slider({ ...one, id: `parameter-${one.name}` }, (value) => setParameter(one.name, value))));
  }
  for (const { key, isThermal } of SETTING) {
    if (isThermal) at(`setting-${key}`).closest("label").hidden = !is_thermal;
  }
  at("formulas").replaceChildren(...formulas.map(([, equation, unit]) => {
    const row = document.createElement("dd");
    row.textContent = `${equation}${unit === "1" ? "" : `   [${unit}]`}`;
    return row;
  }));
}

/** Writes a value into the sheet, where the parameter has its own. */
function setParameter(name, value) {
  const parameter = placed.parameters.find((one) => one.name === name);
  // The text has been changed otherwise, and is being read.
  if (placed.text !== editor.text || !parameter) return;
  const text = String(value);
  editor.replace(parameter, text);
  parameter.width = text.length;
  placed.text = editor.text;
  read();
}

function showSetting() {
  const row = (one) => slider({ note: "", ...one, id: `setting-${one.key}`, value: setting[one.key] }, (value) => {
    setting = { ...setting, [one.key]: value };
    restart();
  });
  at("step").replaceChildren(row(STEP));
  at("setting").replaceChildren(...SETTING.map(row));
}

function showSchemes(all) {
  const rows = schemes.map((chosen, run) => {
    const row = document.createElement("tr");
    row.innerHTML = `<th scope="row"><span class="key"></span><select></select></th>`;
    const key = row.querySelector(".key");
    key.style.borderTopColor = `var(--${["first", "second", "third"][run]})`;
    key.style.borderTopStyle = ["solid", "dashed", "dotted"][run];
    const select = row.querySelector("select");
    select.setAttribute("aria-label", `Scheme ${run + 1}`);
    for (const isExact of [true, false]) {
      const group = document.createElement("optgroup");
      group.label = isExact ? "keeps both laws in every step" : "for comparison";
      group.append(...all.filter(([, exact]) => exact === isExact).map(([name]) => new Option(name)));
      select.append(group);
    }
    select.value = chosen;
    select.addEventListener("change", () => {
      schemes[run] = select.value;
      restart();
    });
    return row;
  });
  document.querySelector("#balance tbody").replaceChildren(...rows);
}

const scientific = (value) =>
  value === 0 ? "0" : (Math.abs(value) >= 0.01 && Math.abs(value) < 1e4
    ? value.toPrecision(3)
    : value.toExponential(1)).replace("e+", "e").replaceAll("-", "−");

function cell(value, isBad) {
  const box = document.createElement("td");
  const data = document.createElement("data");
  data.value = value ?? "";
  data.textContent = value === null ? "–" : scientific(value);
  box.append(data);
  if (isBad !== undefined) box.className = isBad ? "bad" : "good";
  return box;
}

function showBalance() {
  const rows = document.querySelectorAll("#balance tbody tr");
  runs.forEach(({ balance, failure }, run) => {
    const row = rows[run];
    while (row.children.length > 1) row.lastChild.remove();
    if (failure !== null) {
      const box = document.createElement("td");
      box.className = "failure";
      box.colSpan = 3;
      box.textContent = `Stopped: ${failure}`;
      return row.append(box);
    }
    const isRounding = balance.drift <= balance.bound;
    row.append(cell(balance.drift, !isRounding), cell(balance.production), cell(balance.least, balance.least < 0));
  });
  const bound = runs.find((run) => run.balance)?.balance.bound;
  at("rounding").textContent = bound === undefined
    ? ""
    : `Red: more than rounding explains, which is ${scientific(bound)} J so far, or entropy that was destroyed in a step.`;
}

let last = performance.now();
let shown = 0;

function frame(now) {
  requestAnimationFrame(frame);
  const passed = Math.min(now - last, 100) / 1000;
  last = now;
  const ends = runs.filter((run) => run.failure === null).map((run) => run.history.last[TIME]);
  if (isPlaying && ends.length > 0) {
    clock = Math.min(clock + passed * Number(at("speed").value), ...ends);
    if (engine.isIdle) advance().catch(recover);
  }
  const histories = runs.map((run) => run.history);
  const palette = colours();
  at("stage").dataset.time = clock;
  stage.draw(histories, clock, setting?.air, palette);
  charts.forEach((chart) => chart.draw(histories, clock, palette));
  // Numbers that change sixty times a second cannot be read.
  if (now - shown > 200) {
    shown = now;
    showBalance();
  }
}

function take(example) {
  setting = { ...example.setting };
  ranges.clear();
  showSetting();
  editor.text = example.sheet;
  editor.show([]);
  read();
}

at("play").addEventListener("click", () => {
  isPlaying = !isPlaying;
  at("play").textContent = isPlaying ? "Pause" : "Go on";
});
at("restart").addEventListener("click", () => restart());

try {
  const { examples, schemes: all, ...contents } = await engine.ask("contents");
  sampleSize = contents.sampleSize;
  at("example").append(...examples.map(({ name }, index) => new Option(name, index)));
  at("example").addEventListener("change", (event) => take(examples[event.target.value]));
  showSchemes(all);
  take(examples[0]);
  requestAnimationFrame(frame);
} catch (error) {
  say(`The solver does not start: ${error.message}`, true);
}
