// What a run says in words and tables: the verdict above, details below.
import { digitsOf, h, plain, pretty, short, table } from "./dom.js";
import { range } from "./data.js";
import { kRuns, kGhosts } from "./colours.js";
import { differences } from "./differences.js";

export function head(runs, axis) {
  if (runs.length === 1) return headOf(runs[0]);
  const row = (run, i) => {
    const s = run.summary, { mark, brief } = kClasses[s.class];
    return h("tr", {}, h("td", {}, runLine(i)), h("th", { scope: "row" }, run.name), h("td", {}, `${mark} ${brief}`), h("td", { title: s.verdict[0] ?? "" }, i === 0 ? "the reference" : mostlyApart(runs[0], run, axis)));
  };
  return [h("h1", {}, `${runs.length} results compared`),
    h("div.verdict", { class: `verdict ${worstOf(runs).look}` }, h("div.wide", {}, h("table", {}, h("tbody", {}, runs.map(row))),
      h("p.facts", {}, `In the picture ${runs[0].name} is drawn whole, the others in their colour; each stands where its axis has the same value.`)))];
}

const signed = (v, digits = 3) => { const text = short(Math.abs(v), digits); return text === "0" ? text : (v > 0 ? "+" : "−") + text; };

/** Panels that say what differs most, the first of each that both runs have: clinical words before those of coordinates. */
const kTold = [[/^Grood and Suntay: translations/, /Translations/], [/^Grood and Suntay: rotations/, /Rotations/], [/^Contact force/], [/^Ligament force/]];

/** "anterior +6.10 mm at 25.0 deg, rotation −3.20 deg at 40.0 deg": what differs most of where the bones are, and of forces. */
function mostlyApart(run, other, axis) {
  const all = differences(run, other, axis), { unit } = axis.words(), said = [];
  for (const kinds of kTold) {
    const most = kinds.map((kind) => all.filter((d) => kind.test(d.panel))).find((found) => found.length > 0)?.sort((a, b) => Math.abs(b.largest) - Math.abs(a.largest))[0];
    if (most && Math.abs(most.largest) > 1e-6) said.push(`${plain(most.name)} ${signed(most.largest)} ${most.unit} at ${short(most.at, 3)}${unit ? ` ${unit}` : ""}`);
  }
  return said.join(", ") || (all.length > 0 ? "the same curves" : "no curve in common over this axis");
}

/** How a run's lines look, and its ghost. */
function runLine(i) {
  const line = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  line.setAttribute("width", 46); line.setAttribute("height", 14); line.setAttribute("aria-hidden", "true");
  const dash = kRuns[i % kRuns.length].join(" "), ghost = i === 0 ? "none" : kGhosts[(i - 1) % kGhosts.length];
  for (const [tag, a] of [["line", { x1: 1, y1: 7, x2: 30, y2: 7, stroke: "currentColor", "stroke-width": 2, "stroke-dasharray": dash }], ["circle", { cx: 39, cy: 7, r: 5, fill: ghost, opacity: 0.6 }]]) {
    const e = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [k, v] of Object.entries(a)) e.setAttribute(k, v);
    line.append(e);
  }
  return line;
}

/** Of the classes of a verdict, better ones first: how it looks, its mark, and what comes before its first sentence. */
const kClasses = {
  solved: { look: "good", mark: "✓", brief: "solved", word: "Solved. " },
  doubtful: { look: "doubtful", mark: "?", brief: "solved, with doubts", word: "" },
  not_solved: { look: "bad", mark: "!", brief: "not all solved", word: "Not all of it is solved. " },
};
const worstOf = (runs) => kClasses[Object.keys(kClasses).findLast((c) => runs.some((r) => r.summary.class === c))];

function headOf(run) {
  const s = run.summary, { look, mark, word } = kClasses[s.class];
  const facts = [`${s.solved} of ${s.asked} ${run.motion ? "rows" : "poses"} solved`];
  if (s.stable !== undefined) facts.push(`${s.stable} stable`);
  if (s.smallest_gap_mm !== undefined) facts.push(`smallest gap ${Math.abs(s.smallest_gap_mm) < 1e-6 ? 0 : short(s.smallest_gap_mm, 2)} mm`);
  if (s.motion) facts.push(`${short(s.motion.duration_s)} s of motion`);
  facts.push(s.error_bars.length > 0 ? `error bars: ${bars(run)}` : "no error bars asked for");
  if (run.raw.left_out?.length > 0) facts.push(`this page shows ${run.raw.left_out.join(", ")}`);
  for (const t of run.beside) facts.push(`rings: ${t.name}`);
  const on = s.effects.map((e) => `${e.name} (${e.count})`).join(", "), seconds = cost(run);
  return [
    h("h1", {}, s.title || s.scene),
    h("div.verdict", { class: `verdict ${look}` }, h("span.mark", { "aria-hidden": "true" }, mark),
      h("div", {}, h("p", {}, h("strong", {}, word), s.verdict[0] ?? ""),
        h("p.facts", { title: `Effects on: ${on || "none"}` }, facts.join(" · "), seconds > 0 ? ` · ${short(seconds, 3)} s in all` : ""),
        notes(s.verdict.slice(1)))),
  ];
}

/** The largest bar of each coordinate: "adduction ± 0.2 °". */
function bars(run) {
  const out = [];
  for (const panel of run.chart.panels.slice(0, 2))
    for (const s of panel.series) {
      const most = s.bar ? range(s.bar) : null, unit = /\[.*\]/.exec(pretty(panel.title));
      if (most && most[1] > 0) out.push(`${s.name} ± ${short(most[1], 2)} ${unit ? unit[0].slice(1, -1) : ""}`);
    }
  return out.length > 0 ? `at most ${out.join(", ")}` : "see the curves";
}

const cost = (run) => (run.times ? run.times.stages.reduce((sum, t) => sum + t.seconds, 0) : 0);

/** Folded to a line each: however many there are, the picture stays in the window. */
function notes(sentences) {
  if (sentences.length === 0) return null;
  const first = (text) => { const end = text.search(/[.:;](\s|$)/); return end > 0 ? text.slice(0, end + 1) : text; };
  const item = (text) => h("details.note", {}, h("summary", {}, first(text)), h("p", {}, text));
  return h("details.notes", {}, h("summary", {}, sentences.length === 1 ? "One remark: " : `${sentences.length} remarks: `, h("span.brief", {}, first(sentences[0]))), h("div.list", {}, sentences.map(item)));
}

const fold = (title, open, ...content) => h("details", { open }, h("summary", {}, title), h("div.fold", {}, content));

function effects(run) {
  const s = run.summary, times = run.times ?? { effects: [], stages: [] };
  const rows = s.effects.map((e, i) => {
    const t = times.effects[i];
    return [e.name, String(e.count), e.unknowns, t ? t.evaluations.toLocaleString("en") : "–", t ? `${short(t.seconds, 3)} s` : "–"];
  });
  return [
    rows.length > 0 ? table(["effect", "how many", "unknowns of each", "evaluations", "time"], rows) : h("p", {}, "No effects."),
    times.stages.length > 0 ? h("p.small", {}, "Stages: ", times.stages.map((t) => `${t.name} ${short(t.seconds, 3)} s`).join(", "), ".") : null,
  ];
}

function values(run, player) {
  const filter = h("input", { type: "search", placeholder: "Part of a name, such as ACL or force", "aria-label": "Show columns whose name holds" });
  const body = h("tbody", {}), names = [...run.columns.keys()];
  const fill = () => {
    const part = filter.value.toLowerCase(), row = player.row;
    body.replaceChildren(...names.filter((n) => n.toLowerCase().includes(part)).map((n) => {
      const c = run.columns.get(n);
      return h("tr", {}, h("td", {}, n), h("td.number", {}, c.words ? run.word(n, row) : digitsOf(c.numbers[row], 6)));
    }));
  };
  const box = fold("All values of this pose", false, filter, h("div.scroll", {}, h("table", {}, body)));
  filter.addEventListener("input", fill);
  box.addEventListener("toggle", fill);
  player.onChange(() => { if (box.open) fill(); });
  return box;
}

function unsolved(run, player) {
  const bad = [];
  for (let k = 0; k < run.rows; ++k) if (run.status(k) !== "ok") bad.push(k);
  if (bad.length === 0) return null;
  const kMost = 100;
  return fold(`Not solved: ${bad.length} of ${run.every > 1 ? `the ${run.rows} rows of this page` : run.rows}`, true, table(["row", "why", ""], bad.slice(0, kMost).map((k) =>
    [String(run.numberOf(k)), run.status(k).replaceAll("_", " "), h("button", { type: "button", onclick: () => player.set(k) }, "show")])),
  bad.length > kMost ? h("p.small", {}, `and ${bad.length - kMost} more`) : null);
}

function events(run) {
  const e = run.chart.events;
  if (e.length === 0) return null;
  const kMost = 300;
  const more = (run.raw.events_in_full ?? e.length) - Math.min(e.length, kMost);
  return fold(`Events: ${(run.raw.events_in_full ?? e.length).toLocaleString("en")}`, e.length <= 12, h("ul.events", {}, e.slice(0, kMost).map((one) =>
    h("li", {}, h(`i.mark.${one.kind}`, { "aria-hidden": "true" }), one.text))),
  more > 0 ? h("p.small", {}, `and ${more.toLocaleString("en")} more in events.csv`) : null,
  h("p.small", {}, "In the plots: contacts gained are dashed lines, contacts lost dotted ones, stretches stepped over bands, all else full lines. Ligaments that became taut or slack stand in events.csv."));
}

export function details(runs, player, axis) {
  if (runs.length === 1) return detailsOf(runs[0], player);
  return [compared(runs, axis), ...runs.map((run) => fold(run.name, false, h("div.details", {}, headOf(run).slice(1), detailsOf(run, player).filter((d) => d !== null)))), keys()];
}

/** How far each curve lies from the first run's, over the axis that is chosen. */
function compared(runs, axis) {
  return runs.slice(1).map((other) => {
    const body = h("div", {}), fill = () => {
      const rows = differences(runs[0], other, axis);
      body.replaceChildren(rows.length === 0 ? h("p", {}, "They have no curve in common over the same axis.") : table(["curve", "", "largest difference", `at ${axis.title()}`, "root mean square", "of a range of"],
        rows.map((d) => [pretty(d.panel), plain(d.name), signed(d.largest, 4), short(d.at), short(d.rms), short(d.range)])));
    };
    fill();
    axis.onChange(fill);
    return fold(`Differences of ${other.name} from ${runs[0].name}`, true, body);
  });
}

function detailsOf(run, player) {
  const s = run.summary;
  const thinned = run.raw.meshes.filter((m) => m.triangles < m.triangles_in_full);
  const facts = [...s.surfaces.map((f) => `${f.name}: ${f.facts}`), ...s.bodies,
    ...thinned.map((m) => `${m.name}: shown with ${m.triangles.toLocaleString("en")} of its ${m.triangles_in_full.toLocaleString("en")} triangles; computed with all of them`)];
  return [
    player.run === run ? unsolved(run, player) : null,
    events(run),
    player.run === run ? values(run, player) : null,
    fold("Effects and what they cost", true, effects(run)),
    s.error_bars.length > 0 ? fold("Error bars", false, h("p", {}, "The same path on other surfaces that the meshes might have given; a bar is how far a result may be off."),
      table(["cause", "variant", "poses solved"], s.error_bars.map((v) => [v.cause, v.name, String(v.poses_solved)]))) : null,
    facts.length > 0 ? fold("Surfaces and bodies", false, h("ul", {}, facts.map((f) => h("li", {}, f)))) : null,
    fold("The scene", false, h("pre", { tabindex: 0 }, run.raw.scene_text)),
    player.run === run && !player.several ? keys() : null,
    player.run !== run ? null : fold("Licences", false, h("pre", { tabindex: 0 }, document.getElementById("genu-notices").textContent)),
  ];
}

function keys() {
  return fold("Keys", false, table(["key", "does"], [
    ["space", "play or pause"], ["← →", "the pose before, the next one"], ["Page up, Page down, Home, End", "far steps, first and last pose"],
    ["shift and arrows", "turn the picture"], ["+ −", "nearer, farther"], ["0 to 6", "oblique, anterior, posterior, medial, lateral, proximal, distal"],
    ["ctrl and wheel, shift and drag, double click", "in a plot: zoom, move, show all"], ["Esc", "close a menu"]]));
}

export const foot = (run) => [h("p", {}, `genu ${run.summary.version}, scene ${run.summary.scene}. The numbers are those of results.csv, in single precision. `,
  "No tool for diagnosis or treatment.")];
