// Which row is shown: a slider, a play button and the keyboard. Whoever wants to know is told.
import { h, short, pretty } from "./dom.js";
import { range } from "./data.js";

export class Player {
  constructor(run, several = false) {
    this.run = run;
    this.several = several;
    this.row = Math.max(0, run.shown(0));
    this.listeners = [];
    this.playing = false;
    this.speed = 1;
    this.element = this.build();
    document.addEventListener("keydown", (e) => this.key(e));
  }

  onChange(listener) { this.listeners.push(listener); }

  build() {
    const last = Math.max(0, this.run.rows - 1);
    this.button = h("button.play", { type: "button", "aria-label": "Play", title: "Play or pause (space)",
      onclick: () => this.toggle() }, "▶");
    this.slider = h("input", { type: "range", min: 0, max: last, step: 1, value: this.row, disabled: last === 0,
      "aria-label": this.run.motion ? "Time" : "Pose", oninput: () => { this.stop(); this.set(+this.slider.value); } });
    this.button.disabled = last === 0;
    this.label = h("output.row", {});
    this.strip = h("canvas.strip", { height: 6, "aria-hidden": "true" });
    const speed = h("select", { "aria-label": "Speed", title: "Speed", onchange: () => { this.speed = +speed.value; } },
      [0.25, 0.5, 1, 2, 4].map((s) => h("option", { value: s, selected: s === 1 }, `${s}×`)));
    return h("div.player", {}, h("div.bar", {}, this.button, h("div.track", {}, this.slider, this.strip), speed), this.label);
  }

  /** Rows that were not solved, or are not stable, under the slider. */
  drawStrip() {
    const { run, strip } = this, width = (strip.width = strip.clientWidth || 300), g = strip.getContext("2d");
    const kThumb = 8, at = (row) => kThumb + (width - 2 * kThumb) * (run.rows > 1 ? row / (run.rows - 1) : 0);
    g.clearRect(0, 0, width, 6);
    for (let row = 0; row < run.rows; ++row) {
      const stability = run.word("stability", row);
      const bad = run.status(row) !== "ok", shaky = stability !== "" && stability !== "stable";
      if (!bad && !shaky) continue;
      g.fillStyle = bad ? "#d55e00" : "#cc79a7";
      const half = Math.max(1, (at(1) - at(0)) / 2);
      g.fillRect(at(row) - half, bad ? 0 : 3, 2 * half, bad ? 6 : 3);
    }
  }

  /** In rows a second for poses (all of them in some 6 s), by the clock for motion. */
  toggle() { this.playing ? this.stop() : this.play(); }

  play() {
    if (this.run.rows < 2) return;
    if (this.row >= this.run.rows - 1) this.set(0);
    this.playing = true;
    this.face("❚❚", "Pause");
    const times = this.run.motion ? this.run.columns.get("time_s").numbers : null;
    const from = this.row;
    let began = null;
    const step = (now) => {
      if (!this.playing) return;
      began ??= now;
      const seconds = (this.speed * (now - began)) / 1000;
      let row = from;
      if (times) while (row < this.run.rows - 1 && times[row] < times[from] + seconds) ++row;
      else row = from + Math.floor(seconds * Math.min(Math.max(this.run.rows / 6, 4), 60));
      this.set(Math.min(row, this.run.rows - 1));
      if (row >= this.run.rows - 1) this.stop();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  stop() {
    this.playing = false;
    this.face("▶", "Play");
  }

  face(sign, word) {
    this.button.textContent = sign;
    this.button.setAttribute("aria-label", word);
  }

  set(row) {
    row = Math.min(Math.max(Math.round(row), 0), Math.max(0, this.run.rows - 1));
    if (row === this.row && this.told) return;
    this.row = row;
    this.told = true;
    this.slider.value = row;
    const text = this.describe(row);
    this.slider.setAttribute("aria-valuetext", text);
    this.label.textContent = text;
    this.label.classList.toggle("bad", this.run.rows > 0 && this.run.status(row) !== "ok");
    for (const listener of this.listeners) listener(row);
  }

  /** "Pose 36 of 91: knee.flexion 35 °, stable" */
  describe(row) {
    const { run } = this;
    if (run.rows === 0) return "No pose was computed.";
    let text = `${run.motion ? "Row" : "Pose"} ${row + 1} of ${run.rows}`;
    const [, name, unit] = /^(.*) \[(.*)\]$/.exec(run.chart.x_title) ?? [];
    if (name) text += `: ${name} ${short(run.chart.x[row])} ${pretty(`[${unit}]`).slice(1, -1)}`;
    const status = run.status(row), stability = run.word("stability", row);
    const shown = run.shown(row), stead = shown === row ? "" : shown < 0 ? ": the reference pose is shown" : `: pose ${shown + 1} is shown`;
    if (status !== "ok") text += `, not solved (${status.replaceAll("_", " ")})${stead}`;
    else if (stability) text += `, ${stability}`;
    return text;
  }

  key(e) {
    if (e.altKey || e.ctrlKey || e.metaKey || e.shiftKey) return;
    const tag = e.target.tagName;
    if (tag === "SELECT" || tag === "TEXTAREA" || (tag === "INPUT" && e.target !== this.slider)) return;
    if (e.key === " " && tag !== "BUTTON" && tag !== "SUMMARY") { this.toggle(); e.preventDefault(); return; }
    const far = Math.max(1, Math.round(this.run.rows / 10));
    const to = { ArrowLeft: this.row - 1, ArrowRight: this.row + 1, PageDown: this.row - far, PageUp: this.row + far,
      Home: 0, End: this.run.rows - 1 };
    const moves = e.key in to && (e.target === this.slider || e.key.startsWith("Arrow"));
    if (!moves) return;
    this.stop();
    this.set(to[e.key]);
    e.preventDefault();
  }
}

/** Where x is nearest to a value. */
export function nearestRow(x, value) {
  let best = 0, distance = Infinity;
  for (let k = 0; k < x.length; ++k) {
    const d = Math.abs(x[k] - value);
    if (d < distance) { best = k; distance = d; }
  }
  return best;
}

/** Whether x says anything: more than one number. */
export function varies(x) {
  const r = range(x);
  return r !== null && r[1] > r[0];
}
