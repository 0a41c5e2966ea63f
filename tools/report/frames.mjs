// node frames.mjs REPORT FOLDER [options]: PNG frames of a joint that moves through the rows of its report.html and back.
//   --frames N       most frames of the loop (60); the way back repeats those of the way there
//   --seconds S      of the whole loop (6); the motion slows down at both ends
//   --size WxH       CSS pixels (720x540)
//   --from F,S,U     direction of the eye: components along front, side and up (0.6,0.78,0.32)
//   --opacity B=X,…  0 to 1, of surfaces or bodies (default: as in the page)
//   --bones NAME,…   surfaces to paint as bones, beside those that the page marks as bones
// Prints the file and the milliseconds of each frame, in order, for img2webp.
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { parseArgs } from "node:util";
import { Browser } from "./browser.mjs";

/** Rows and milliseconds of a loop over rows 0 to rows - 1, along a cosine. Rows are whole, so each lasts as long as it should. */
function loop(rows, frames, seconds) {
  const last = rows - 1, half = Math.max(Math.round(frames / 2), 1), there = new Set();
  for (let k = 0; k <= half; ++k) there.add(Math.round((last * (1 - Math.cos((Math.PI * k) / half))) / 2));
  const out = [...there].sort((a, b) => a - b);
  // When the way there is at a row; the way back is its mirror image in time.
  const time = (row) => (500 * seconds * Math.acos(1 - (2 * row) / last)) / Math.PI;
  const change = (i) => Math.round((time(out[i - 1]) + time(out[i])) / 2);  // from frame i - 1 to frame i
  const whole = 1000 * seconds, shown = out.map((row, i) => ({ row,
    milliseconds: i === 0 ? 2 * change(1) : i === out.length - 1 ? whole - 2 * change(i) : change(i + 1) - change(i) }));
  return [...shown, ...shown.slice(1, -1).reverse()];
}

// In the page: the picture alone, over the whole window.
function stage({ from, opacity, bones }) {
  const { view, runs: [run] } = window.genu;
  const style = document.createElement("style");
  style.textContent = `
    body { overflow: hidden; }
    main, .stage { position: static !important; }
    .view { position: fixed !important; inset: 0; height: 100vh !important; z-index: 100; background: #fff; }
    .compass { left: 0; bottom: 0; }
    .legends { right: 14px; bottom: 12px; font-size: 15px; }
    #angle { position: absolute; left: 22px; top: 16px; font-size: 26px; font-weight: 600; color: #1c2329; }
    #angle { font-variant-numeric: tabular-nums; }
    #angle span { font-size: 17px; font-weight: 400; color: #55616c; display: block; }`;
  document.head.append(style);
  view.renderer.setClearColor("#ffffff");
  const angle = document.createElement("div");
  angle.id = "angle";
  view.element.append(angle);

  const places = run.bodies.map(() => 0);
  for (const raw of run.raw.meshes) {
    const mesh = view.bodies[0].groups[raw.body].children[places[raw.body]++];
    const bone = raw.kind === "bone" || bones.includes(raw.name);
    mesh.material = mesh.material.clone();
    mesh.material.color.set(bone ? "#eadfc8" : "#8fb9cc");
    const share = opacity[raw.name] ?? opacity[run.bodies[raw.body].name] ?? mesh.material.opacity;
    mesh.material.opacity = share;
    mesh.material.transparent = share < 1;
    mesh.material.depthWrite = share === 1;
    mesh.visible = share > 0;
    mesh.renderOrder = share === 1 ? 0 : bone ? 1 : 2;  // cartilage over bone
  }
  const { up, front, side } = view.known, direction = front.clone().multiplyScalar(from[0]);
  view.looked = { direction: direction.addScaledVector(side, from[1]).addScaledVector(up, from[2]), up };
  view.resize();
}

function show(row) {
  const { view, runs: [run] } = window.genu;
  view.show(row);  // without the curves, which nobody sees here
  const [, name, unit] = /^(.*) \[(.*)\]$/.exec(run.chart.x_title) ?? [null, run.chart.x_title, ""];
  const value = document.createElement("span");
  value.textContent = name.replace(/^.*\./, "");
  const x = run.chart.x[row], text = unit === "deg" ? `${Math.round(x)}°` : `${x.toFixed(2)} ${unit}`;
  document.getElementById("angle").replaceChildren(value, text);
}

const { values: options, positionals: [report, folder] } = parseArgs({ allowPositionals: true, options: {
  frames: { type: "string", default: "60" }, seconds: { type: "string", default: "6" },
  size: { type: "string", default: "720x540" }, from: { type: "string", default: "0.6,0.78,0.32" },
  opacity: { type: "string", default: "" }, bones: { type: "string", default: "" } } });
const [width, height] = options.size.split("x").map(Number);
const call = (f, argument) => `(${f})(${JSON.stringify(argument)})`;
const browser = await Browser.start();
try {
  const page = await browser.open(report, { width, height });
  const rows = await page.evaluate("genu.runs[0].rows");
  if (rows < 2) throw new Error(`${report} has ${rows} row(s): nothing moves`);
  const opacity = Object.fromEntries(options.opacity.split(",").map((o) => o.split("=")).map(([name, share]) => [name, +share]));
  await page.evaluate(call(stage, { from: options.from.split(",").map(Number), bones: options.bones.split(","), opacity }));
  await page.settle();
  mkdirSync(folder, { recursive: true });
  const drawn = new Set();
  for (const { row, milliseconds } of loop(rows, +options.frames, +options.seconds)) {
    const file = join(folder, `${String(row).padStart(5, "0")}.png`);
    if (!drawn.has(row)) {
      await page.evaluate(call(show, row));
      await page.settle();
      writeFileSync(file, await page.screenshot());
      drawn.add(row);
    }
    console.log(`${file} ${milliseconds}`);
  }
  for (const complaint of page.complaints) console.error(`the page complains: ${complaint}`);
  process.exitCode = page.complaints.length > 0 ? 1 : 0;
} finally {
  await browser.close();
}
