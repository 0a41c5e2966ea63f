// Which row is shown: a slider, a play button and the keyboard. Whoever wants to know is told.
import { h } from "./dom.js";
import { ink, onTheme } from "./theme.js";

export class Player {
  constructor(run, axis, several = false) {
    Object.assign(this, { run, axis, several });
    this.row = Math.max(0, run.shown(axis.settling(run)));
    this.listeners = [];
    this.playing = false;
    this.speed = 1;
    this.element = this.build();
    document.addEventListener("keydown", (e) => this.key(e));
    axis.onChange(() => this.tell());
    onTheme(() => this.drawStrip());
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
    return h("div.player", {}, h("div.bar", {}, this.button, h("div.track", {}, this.slider, this.strip), speed), this.below = h("div.below", {}, this.label));
  }

  /** Rows that were not solved, are not stable, belong to another position or only settle, under the slider. */
  drawStrip() {
    const { run, strip } = this, width = (strip.width = strip.clientWidth || 300), g = strip.getContext("2d");
    const kThumb = 8, at = (row) => kThumb + (width - 2 * kThumb) * (run.rows > 1 ? row / (run.rows - 1) : 0);
    g.clearRect(0, 0, width, 6);
    const settling = this.axis.settling(run);
    if (settling > 0) { g.fillStyle = ink("faint"); g.fillRect(at(0), 2, at(settling) - at(0), 2); }
    for (const row of run.breaks) { g.fillStyle = ink("ink"); g.fillRect(at(row - 0.5) - 1, 0, 2, 6); }
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
    this.say();
    for (const listener of this.listeners) listener(row);
  }

  say() {
    const text = this.describe(this.row);
    this.slider.setAttribute("aria-valuetext", text);
    this.label.textContent = text;
    this.label.classList.toggle("bad", this.run.rows > 0 && this.run.status(this.row) !== "ok");
  }

  tell() {
    this.say();
    this.drawStrip();
    for (const listener of this.listeners) listener(this.row);
  }

  /** "Flexion 36.0 deg, pose 37 of 91, stable" */
  describe(row) {
    const { run, axis } = this;
    if (run.rows === 0) return "No pose was computed.";
    const place = axis.at(row), word = run.motion ? "row" : "pose", all = run.every > 1 ? run.raw.rows_in_full : run.rows;
    let text = `${place ? `${place}, ${word}` : run.motion ? "Row" : "Pose"} ${run.numberOf(row)} of ${all}`;
    if (row < axis.settling(run)) text += ", settling";
    const status = run.status(row), stability = run.word("stability", row), branch = run.number("branch", row);
    const shown = run.shown(row), stead = shown === row ? "" : shown < 0 ? ": the reference pose is shown" : `: pose ${run.numberOf(shown)} is shown`;
    if (status !== "ok") text += `, not solved (${status.replaceAll("_", " ")})${stead}`;
    else if (stability) text += `, ${stability}`;
    if (branch > 1) text += `, after a jump (branch ${branch})`;
    return text;
  }

  key(e) {
    if (e.altKey || e.ctrlKey || e.metaKey || e.shiftKey) return;
    const tag = e.target.tagName;
    if (tag === "SELECT" || tag === "TEXTAREA" || (tag === "INPUT" && e.target !== this.slider && e.target.type !== "checkbox")) return;
    if (e.key === " " && tag !== "BUTTON" && tag !== "SUMMARY" && e.target.type !== "checkbox") { this.toggle(); e.preventDefault(); return; }
    const far = Math.max(1, Math.round(this.run.rows / 10));
    const to = { ArrowLeft: this.row - 1, ArrowRight: this.row + 1, PageDown: this.row - far, PageUp: this.row + far,
      Home: 0, End: this.run.rows - 1 };
    const free = tag === "BODY" || tag === "CANVAS" || e.target === this.slider;  // else the page scrolls
    const moves = e.key in to && (free || e.key === "ArrowLeft" || e.key === "ArrowRight");
    if (!moves) return;
    this.stop();
    this.set(to[e.key]);
    e.preventDefault();
  }
}
