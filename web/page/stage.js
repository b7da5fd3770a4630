// The pendulums: that of the first scheme with its spring, the others as rings, each with its way.

import { clear, round } from "./canvas.js";
import { TEMPERATURE, TIME, X, Y } from "./history.js";

/** Seconds of the way that are drawn. */
const WAY = 4;
const COILS = 15;
/** Part of the way to its right size that the picture goes in a frame, if it is too small. */
const CLOSER = 0.01;

/** From blue over grey to red, for 120 K below to 120 K above the air. */
function warmth(kelvin, air) {
  const part = Math.max(-1, Math.min(1, (kelvin - air) / 120));
  const hue = part > 0 ? 12 : 215;
  return `hsl(${hue} ${Math.round(12 + 70 * Math.abs(part))}% 52%)`;
}

function spring(context, x, y) {
  const length = Math.hypot(x, y) || 1;
  const [along, beside] = [[x / length, y / length], [-y / length, x / length]];
  const width = 7;
  const ends = Math.min(14, length / 4);
  const point = (s, d) => [along[0] * s + beside[0] * d, along[1] * s + beside[1] * d];
  context.beginPath();
  context.moveTo(0, 0);
  context.lineTo(...point(ends, 0));
  for (let coil = 0; coil < COILS; coil++) {
    const s = ends + ((coil + 0.5) / COILS) * (length - 2 * ends);
    context.lineTo(...point(s, coil % 2 === 0 ? width : -width));
  }
  context.lineTo(...point(length - ends, 0));
  context.lineTo(x, y);
  context.stroke();
}

export class Stage {
  #canvas;
  #extent = 0;

  constructor(canvas) {
    this.#canvas = canvas;
  }

  /** Forgets how far the pendulum has gone. */
  reset() {
    this.#extent = 0;
  }

  draw(histories, time, air, colours) {
    const { context, width, height } = clear(this.#canvas);
    const [first] = histories;
    const lead = first?.last ? first : histories.find((history) => history?.last);
    if (!lead) return;
    const isOnWay = (sample) => sample[TIME] <= time && sample[TIME] > time - WAY;
    const far = Math.max(...[...lead.recent.filter(isOnWay), lead.at(time)].map((one) => Math.hypot(one[X], one[Y])));
    // The picture comes closer slowly.
    this.#extent = Math.max(far, this.#extent + CLOSER * (far - this.#extent));
    const scale = (0.44 * Math.min(width, height)) / (this.#extent || 1);
    context.save();
    context.translate(width / 2, height / 2);
    for (let run = histories.length - 1; run >= 0; run--) {
      const history = histories[run];
      if (!history?.last) continue;
      const now = history.at(time);
      const [x, y] = [scale * now[X], -scale * now[Y]];
      const colour = colours.runs[run];
      const way = history.recent.filter(isOnWay);
      context.strokeStyle = colour;
      context.globalAlpha = run === 0 ? 0.55 : 0.3;
      context.lineWidth = 1.5;
      context.beginPath();
      for (const sample of way) context.lineTo(scale * sample[X], -scale * sample[Y]);
      context.lineTo(x, y);
      context.stroke();
      context.globalAlpha = 1;
      if (run === 0) {
        context.strokeStyle = now[TEMPERATURE] > 0 ? warmth(now[TEMPERATURE], air) : colours.faint;
        context.lineWidth = 2.5;
        spring(context, x, y);
      }
      context.beginPath();
      context.arc(x, y, run === 0 ? 11 : 8, 0, 2 * Math.PI);
      context.lineWidth = 2.5;
      context.strokeStyle = colour;
      context.fillStyle = run === 0 ? colour : colours.ground;
      context.fill();
      context.stroke();
    }
    context.fillStyle = colours.text;
    context.beginPath();
    context.arc(0, 0, 4, 0, 2 * Math.PI);
    context.fill();
    context.restore();

    const metres = round(width / 6 / scale);
    context.strokeStyle = context.fillStyle = colours.faint;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(14, height - 14);
    context.lineTo(14 + metres * scale, height - 14);
    context.stroke();
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "bottom";
    context.textAlign = "left";
    context.fillText(`${Number(metres.toPrecision(1))} m`, 14, height - 18);
    context.textAlign = "right";
    context.fillText(`t = ${time.toFixed(1)} s`, width - 14, height - 8);
  }
}
