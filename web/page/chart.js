// A chart of one quantity of all runs over time, with axes, ticks and units.

import { clear, round } from "./canvas.js";
import { TIME } from "./history.js";

const DASHES = [[], [7, 4], [2, 3]];
const MARGIN = { left: 58, right: 12, top: 26, bottom: 34 };
const FONT = "12px system-ui, sans-serif";
/** A scheme whose energy explodes would make lines of all others: more than so many times the others' range is cut off. */
const CUT = 100;

/** Ticks within a range. */
function ticks(least, most, count) {
  const step = round((most - least) / count);
  const first = Math.ceil(least / step - 1e-9);
  const last = Math.floor(most / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, index) => (first + index) * step);
}

/** A number of an axis. */
function label(value, span) {
  if (Math.abs(value) < span * 1e-9) return "0";
  const size = Math.max(Math.abs(value), span);
  const text = size >= 1e5 || size < 1e-3
    ? value.toExponential(1).replace(".0e", "e").replace("e+", "e")
    : String(Number(value.toPrecision(4)));
  return text.replace("-", "−");
}

/** What a quantity ranges over: that of the runs that do not go far beyond the others. */
function range(histories, place) {
  const ranges = histories.map(({ all, last }) => {
    const values = [...all, last].map((sample) => sample[place]);
    return [Math.min(0, ...values), Math.max(0, ...values)];
  });
  const spans = ranges.map(([least, most]) => most - least).sort((a, b) => a - b);
  // Half of the runs have no more than this.
  const usual = spans[Math.floor((spans.length - 1) / 2)] ?? 0;
  const limit = usual > 0 ? CUT * usual : Infinity;
  let [least, most] = [0, 0];
  for (const [low, high] of ranges) {
    least = Math.min(least, Math.max(low, -limit));
    most = Math.max(most, Math.min(high, limit));
  }
  return [least, most];
}

export class Chart {
  #canvas;
  #title;
  #place;
  #floor;

  /** `floor` is the least height of the axis: smaller changes are rounding and shall look so. */
  constructor(canvas, title, place, floor) {
    this.#canvas = canvas;
    this.#title = title;
    this.#place = place;
    this.#floor = floor;
  }

  draw(histories, time, colours) {
    const { context, width, height } = clear(this.#canvas);
    const shown = histories.filter((history) => history?.last);
    let [least, most] = range(shown, this.#place);
    if (most - least < this.#floor) {
      const middle = (most + least) / 2;
      [least, most] = [middle - this.#floor / 2, middle + this.#floor / 2];
    }
    const pad = 0.08 * (most - least);
    [least, most] = [least - pad, most + pad];
    const end = [5, 10, 20, 50, 100, 200, 500].find((one) => time <= one) ?? 1000 * Math.ceil(time / 1000);

    const inner = [width - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom];
    const across = (t) => MARGIN.left + (t / end) * inner[0];
    const up = (value) => MARGIN.top + (1 - (value - least) / (most - least)) * inner[1];

    context.font = FONT;
    context.lineWidth = 1;
    context.strokeStyle = colours.line;
    context.fillStyle = colours.faint;
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const value of ticks(least, most, 4)) {
      const y = Math.round(up(value)) + 0.5;
      context.beginPath();
      context.moveTo(MARGIN.left, y);
      context.lineTo(width - MARGIN.right, y);
      context.stroke();
      context.fillText(label(value, most - least), MARGIN.left - 6, y);
    }
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const value of ticks(0, end, inner[0] < 360 ? 4 : 8)) {
      context.fillText(label(value, end), across(value), height - MARGIN.bottom + 6);
    }
    context.textAlign = "right";
    context.textBaseline = "bottom";
    context.fillText("time (s)", width - MARGIN.right, height);
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillStyle = colours.text;
    context.fillText(this.#title, 4, 4);

    context.save();
    context.beginPath();
    context.rect(MARGIN.left, MARGIN.top, inner[0], inner[1]);
    context.clip();
    // The first one is drawn last, above the others.
    for (let run = histories.length - 1; run >= 0; run--) {
      const history = histories[run];
      if (!history?.last) continue;
      context.strokeStyle = colours.runs[run];
      context.lineWidth = run === 0 ? 2.5 : 1.75;
      context.setLineDash(DASHES[run]);
      context.beginPath();
      for (const sample of history.all) {
        if (sample[TIME] > time) break;
        context.lineTo(across(sample[TIME]), up(sample[this.#place]));
      }
      const now = history.at(time);
      context.lineTo(across(now[TIME]), up(now[this.#place]));
      context.stroke();
    }
    context.restore();
  }
}
