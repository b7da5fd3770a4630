// The text area of the sheet, with marks at guilty places and their drawings below.

/** Replaces the text of an element by others, some of them marked. */
function mark(layer, text, places) {
  const lines = text.split("\n");
  const rows = lines.map((line, index) => {
    const here = places.filter((place) => place.line === index + 1);
    const letters = Array.from(line);
    const row = document.createDocumentFragment();
    let done = 0;
    for (const { column, width, is_warning } of here) {
      const start = Math.max(column - 1, done);
      const end = Math.max(start, column - 1 + width);
      if (start > done) row.append(letters.slice(done, start).join(""));
      const guilty = document.createElement("mark");
      guilty.className = is_warning ? "warning" : "error";
      // Beyond the end of the line there is no letter to mark.
      guilty.textContent = letters.slice(start, end).join("") || " ";
      row.append(guilty);
      done = end;
    }
    row.append(letters.slice(done).join("") + "\n");
    return row;
  });
  layer.replaceChildren(...rows);
}

export class Editor {
  #area;
  #layer;
  #list;

  /** `onText` is called with what was typed. */
  constructor(root, onText) {
    this.#area = root.querySelector("textarea");
    this.#layer = root.querySelector(".marks");
    this.#list = root.querySelector(".faults");
    this.#area.addEventListener("input", () => {
      this.#grow();
      // Marks of the text before would stand at wrong places.
      mark(this.#layer, this.text, []);
      onText(this.text);
    });
    this.#area.addEventListener("scroll", () => {
      this.#layer.scrollTop = this.#area.scrollTop;
      this.#layer.scrollLeft = this.#area.scrollLeft;
    });
  }

  get text() {
    return this.#area.value;
  }

  set text(text) {
    this.#area.value = text;
    this.#grow();
  }

  #grow() {
    this.#area.rows = Math.min(30, Math.max(6, this.text.split("\n").length));
  }

  /** Offsets in the text of a place in lines and characters. */
  #offsets({ line, column, width }) {
    const lines = this.text.split("\n");
    const before = lines.slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
    const letters = Array.from(lines[line - 1] ?? "");
    const length = (from, to) => letters.slice(from, to).join("").length;
    const start = before + length(0, column - 1);
    return [start, start + length(column - 1, column - 1 + width)];
  }

  /** Replaces what stands at a place. */
  replace(place, text) {
    const [start, end] = this.#offsets(place);
    this.#area.setRangeText(text, start, end, "preserve");
    mark(this.#layer, this.text, []);
  }

  /** Shows what is wrong with the text. */
  show(mistakes) {
    mark(this.#layer, this.text, mistakes);
    const items = mistakes.map((mistake) => {
      const item = document.createElement("li");
      const button = document.createElement("button");
      button.type = "button";
      button.className = mistake.is_warning ? "warning" : "error";
      button.title = "Go there";
      button.textContent = mistake.drawing;
      button.addEventListener("click", () => {
        this.#area.focus();
        this.#area.setSelectionRange(...this.#offsets(mistake));
      });
      item.append(button);
      return item;
    });
    this.#list.replaceChildren(...items);
    this.#area.setAttribute("aria-invalid", mistakes.some((one) => !one.is_warning));
  }
}
