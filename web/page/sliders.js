// Sliders with a name, a value and a unit.

/** Positions of a slider. */
const POSITIONS = 400;

/** A number with three digits, as short as it can be. */
export const short = (value) => String(Number(value.toPrecision(3)));

/** A range around a value: a factor of ten both ways, or as much as the value to both sides of zero. */
export function around(value) {
  if (value > 0) return { least: value / 10, most: value * 10, isLogarithmic: true };
  const most = value === 0 ? 1 : -2 * value;
  return { least: -most, most, isLogarithmic: false };
}

/** A row of a form, with a method `set` for another value. `onValue` is called while the slider moves. */
export function slider({ id, name, note, unit, value, least, most, isLogarithmic }, onValue) {
  const row = document.createElement("label");
  row.className = "slider";
  row.innerHTML = `<span class="name"></span><span class="note"></span><output></output><input type="range">`;
  const [title, remark, output, input] = row.children;
  title.textContent = name;
  remark.textContent = note;
  input.id = id;
  Object.assign(input, { min: 0, max: POSITIONS, step: 1 });
  const place = (number) => isLogarithmic
    ? Math.log(number / least) / Math.log(most / least)
    : (number - least) / (most - least);
  const number = (part) => isLogarithmic
    ? least * (most / least) ** part
    : least + (most - least) * part;
  const show = (shown) => {
    output.textContent = `${short(shown)} ${unit === "1" ? "" : unit}`.trim();
    input.setAttribute("aria-valuetext", output.textContent);
  };
  row.set = (number) => {
    input.value = Math.round(place(number) * POSITIONS);
    show(number);
  };
  row.set(value);
  input.addEventListener("input", () => {
    const chosen = Number(short(number(Number(input.value) / POSITIONS)));
    show(chosen);
    onValue(chosen);
  });
  return row;
}
