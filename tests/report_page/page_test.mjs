// report.html in a real browser: what is drawn, moved and pressed, held against results.csv, which the page never sees.
// node page_test.mjs GENU ROOT. Exit code 77: there is no browser to test with.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, findChromium } from "../../tools/report/browser.mjs";

const [genu, root] = process.argv.slice(2);
if (!findChromium()) {
  console.log("skipped: chromium is not installed");
  process.exit(77);
}

const folder = mkdtempSync(join(tmpdir(), "genu-page-"));
const kLaptop = { width: 1366, height: 768 }, kPhone = { width: 390, height: 844, mobile: true, scale: 2 };

/** Solves a scene file of the tree, or a text beside the meshes of one, and reads its table. */
function solve(name, file, exit = 0, more = []) {
  const out = join(folder, name), run = spawnSync(genu, ["run", file, "--quiet", "--out", out, ...more], { encoding: "utf8" });
  assert.equal(run.status, exit, run.stderr);
  const [head, ...rows] = readFileSync(join(out, "results.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
  return { page: join(out, "report.html"), rows: rows.length, cell: (row, column) => rows[row][head.indexOf(column)] };
}

function written(name, text) {
  const file = join(folder, name);
  writeFileSync(file, text);
  return file;
}

/** The pixels of the picture that are no background, and how far they lie from the middle. */
const kLit = `(() => {
  genu.view.paintNow();
  const gl = genu.view.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, p = new Uint8Array(4 * w * h);
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, p);
  let lit = 0, warm = 0, edge = 0, hash = 0;
  for (let i = 0; i < p.length; i += 4) {
    if (Math.abs(p[i] - 0xf4) + Math.abs(p[i + 1] - 0xf6) + Math.abs(p[i + 2] - 0xf8) < 12) continue;
    ++lit;
    const x = (i / 4) % w, y = Math.floor(i / 4 / w);
    if (x === 0 || y === 0 || x === w - 1 || y === h - 1) ++edge;
    if (p[i] > p[i + 2] + 70) ++warm;
    hash = (hash * 31 + p[i] + 7 * p[i + 1] + i) | 0;
  }
  return { share: lit / (w * h), warm, edge, hash };
})()`;

const near = (a, b, tolerance, what) => assert.ok(Math.abs(a - b) <= tolerance, `${what}: ${a} is not ${b} to ${tolerance}`);

async function quiet(page) {
  assert.deepEqual(page.complaints, [], "the page complains");
  assert.deepEqual(page.requests.filter((url) => url !== page.address && !url.startsWith("data:")), [], "the page asks for something");
}

async function knee(browser) {
  const result = solve("knee", join(root, "meshes/dortmans1984/scene.toml"));
  const page = await browser.open(result.page, kLaptop);
  const first = await page.evaluate(kLit);
  assert.ok(first.share > 0.05, `only ${first.share} of the picture is drawn`);
  assert.ok(first.warm > 200, "no stretched ligament is seen");
  assert.equal(first.edge, 0, "the knee runs out of the picture");

  // The slider moves the bones: as far as results.csv says, which also says how far they turn.
  const place = `(() => { const g = genu.view.bodies[0].groups[genu.runs[0].bodies.findIndex((b) => !b.fixed)]; return [...g.matrix.elements]; })()`;

  const slide = async (row) => {
    await page.evaluate(`(() => { const s = document.querySelector(".track input[type=range]"); s.value = ${row}; s.dispatchEvent(new Event("input", { bubbles: true })); })()`);
    await page.settle();
    return page.evaluate(place);
  };
  const at0 = await slide(0), at60 = await slide(60);

  for (const [i, axis] of ["x", "y", "z"].entries())
    near(at60[12 + i] - at0[12 + i], result.cell(60, `knee.${axis}_mm`) - result.cell(0, `knee.${axis}_mm`), 1e-4, `moved along ${axis}`);
  const trace = at60[0] * at0[0] + at60[1] * at0[1] + at60[2] * at0[2] + at60[4] * at0[4] + at60[5] * at0[5] + at60[6] * at0[6] + at60[8] * at0[8] + at60[9] * at0[9] + at60[10] * at0[10];
  const turned = (Math.acos((trace - 1) / 2) * 180) / Math.PI;
  near(turned, 60, 0.5, "turned by about the flexion, adduction being a few degrees");
  assert.notEqual((await page.evaluate(kLit)).hash, first.hash, "the picture did not change");

  // The plots follow: the line stands at the flexion, the numbers are the table's.
  const plot = await page.evaluate(`(() => { const p = genu.plots.panels.find((p) => p.raw.title.startsWith("Contact force"));
    return { line: p.graph.xAt(p.graph.box.left + parseFloat(p.now.style.left)), text: p.element.querySelector(".chips").textContent }; })()`);
  near(plot.line, result.cell(60, "knee.flexion_deg"), 0.3, "the line in the plot");
  near(+/medial ([\d.]+)/.exec(plot.text)[1], result.cell(60, "medial.force_N"), 0.06, "the force beside the plot");
  // A press in a plot chooses the pose.
  const box = await page.evaluate(`(() => { const r = genu.plots.panels[0].over.getBoundingClientRect(); return [r.left, r.top, r.width, r.height]; })()`);
  await page.press(box[0] + box[2] / 2, box[1] + box[3] / 2);
  near(await page.evaluate("genu.player.row"), 35, 1, "the pose in the middle");

  await keyboard(page);
  await contactPath(page, result);
  await gaps(page);
  await quiet(page);

  const pdf = await page.pdf();
  assert.ok(pdf.subarray(0, 5).toString() === "%PDF-" && pdf.length > 50_000, "it does not print");
  for (const width of [390, 320]) {
    await page.resize({ ...kPhone, width });
    await page.settle();
    const wide = await page.evaluate("[document.documentElement.scrollWidth, document.documentElement.clientWidth]");
    assert.ok(wide[0] <= wide[1], `a phone of ${width} px must scroll sideways: ${wide}`);
  }
  assert.ok((await page.evaluate(kLit)).share > 0.04, "nothing is seen on a phone");
  await page.close();
}

async function keyboard(page) {
  const row = () => page.evaluate("genu.player.row");
  await page.evaluate("document.activeElement.blur(); genu.player.set(10)");
  await page.key("ArrowRight");
  assert.equal(await row(), 11);
  await page.key("ArrowLeft");
  await page.key("ArrowLeft");
  assert.equal(await row(), 9);
  await page.evaluate('document.querySelector(".track input").focus()');
  await page.key("ArrowRight");
  assert.equal(await row(), 10, "one step on the slider too, not two");
  await page.key("End");
  assert.equal(await row(), 70);
  await page.key("Home");
  assert.equal(await row(), 0);
  await page.evaluate("document.activeElement.blur()");
  await page.key(" ", { code: "Space" });
  assert.ok(await page.evaluate("genu.player.playing || genu.player.row > 0"), "space does not play");  // a slow machine may see its end
  await page.evaluate("new Promise((done) => { const wait = (k) => (k === 0 || genu.player.row > 0 ? done() : setTimeout(wait, 100, k - 1)); wait(100); })");
  if (await page.evaluate("genu.player.playing")) await page.key(" ", { code: "Space" });
  assert.equal(await page.evaluate("genu.player.playing"), false);
  assert.ok((await row()) > 0, "it does not play");
  const before = await page.evaluate("genu.view.camera.position.toArray()");
  await page.evaluate("genu.view.canvas.focus()");
  await page.key("ArrowLeft", { shift: true });
  assert.notDeepEqual(await page.evaluate("genu.view.camera.position.toArray()"), before, "shift and arrow do not turn");
  // Every control can be reached and has a name.
  const nameless = await page.evaluate(`[...document.querySelectorAll("button, input, select, canvas[tabindex]")].filter((e) =>
    !(e.textContent.trim() || e.getAttribute("aria-label") || e.closest("label")?.textContent.trim())).map((e) => e.outerHTML.slice(0, 80))`);
  assert.deepEqual(nameless, []);
}

/** The contact path shows where the file says the contact is. */
async function contactPath(page, result) {
  const shown = await page.evaluate(`(() => { const p = genu.paths[0], i = p.contacts.findIndex((c) => c.name === "medial");
    return { at: p.tracks[i].find((t) => t.row === 40).at, right: p.axes.right.toArray(), up: p.axes.up.toArray() }; })()`);
  const point = ["x", "y", "z"].map((axis) => +result.cell(40, `medial.tibia_medial.${axis}_mm`));
  for (const [k, axis] of [shown.right, shown.up].entries())
    near(shown.at[k], axis.reduce((sum, a, i) => sum + a * point[i], 0), 0.01, "the contact on the plateau");
}

const kPixels = (colours) => `(() => {
  genu.view.paintNow();
  const gl = genu.view.renderer.getContext(), w = gl.drawingBufferWidth, h = gl.drawingBufferHeight, p = new Uint8Array(4 * w * h), wanted = ${JSON.stringify(colours)};
  gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, p);
  let count = 0;
  for (let i = 0; i < p.length; i += 4) if (wanted.some(([r, g, b]) => Math.abs(p[i] - r) + Math.abs(p[i + 1] - g) + Math.abs(p[i + 2] - b) < 10)) ++count;
  return count;
})()`;

/** A ball on a plane of cartilage: pressure is drawn where results.csv has it, on the scale that the legend gives. */
async function pressure(browser) {
  const result = solve("layer", join(root, "tests/report_page/scenes/layer.toml"));
  const page = await browser.open(result.page, kLaptop), row = 3;
  await page.evaluate(`genu.player.set(${row})`);
  await page.settle();
  const found = await page.evaluate(`(() => { const run = genu.runs[0], out = [];
    for (const m of run.pressures) { let peak = 0, x = 0, y = 0, sum = 0; m.each(${row}, (s, p) => { peak = Math.max(peak, p); if (m.mesh < 0) { const w = p * m.radii[s] ** 2; sum += w; x += w * m.places[3 * s]; y += w * m.places[3 * s + 1]; } });
      const c = run.bodies[m.body].centre; out.push({ surface: m.surface, peak, x: x / sum + c[0], y: y / sum + c[1], count: m.count(${row}) }); }
    return out; })()`);
  assert.equal(found.length, 2, "both surfaces cast");
  for (const map of found) {
    near(map.peak, result.cell(row, "foot.max_pressure_MPa"), 0.03 * map.peak, `the peak on ${map.surface}`);
    near(map.x, result.cell(row, `foot.${map.surface}.x_mm`), 0.2, `the centre of pressure on ${map.surface}`);
    near(map.y, result.cell(row, `foot.${map.surface}.y_mm`), 0.2, `the centre of pressure on ${map.surface}`);
    assert.ok(map.count > 50);
  }
  const viridis = [[0x21, 0x90, 0x8d], [0x2a, 0x78, 0x8e], [0x22, 0xa8, 0x84], [0x43, 0xbf, 0x71], [0x7a, 0xd1, 0x51]];
  await page.evaluate('genu.shown.set("body bone", false); genu.view.look(genu.view.views()[5])');
  await page.settle();
  assert.ok(await page.evaluate(kPixels(viridis)) > 30, "no pressure is seen from above");
  for (const seen of [false, true]) {
    await page.evaluate(`[...document.querySelectorAll(".show .tick")].find((t) => t.textContent === "pressure").querySelector("input").click()`);
    await page.settle();
    assert.equal((await page.evaluate(kPixels(viridis))) > 30, seen, "the tick of pressure");
  }
  const legend = await page.evaluate('document.querySelector(".view .legends").textContent');
  assert.match(legend, /pressure 0[\d.]+ MPa/);
  // What is flat shows it as well, at the centre that the file gives.
  const flat = await page.evaluate(`(() => { const p = genu.paths.find((p) => p.maps[0]?.surface === "floor"), g = p.canvas.getContext("2d"), [x, y] = p.at(p.tracks[0].find((t) => t.row === ${row}).at);
    const d = g.getImageData(Math.round((x + 16) * p.ratio), Math.round(y * p.ratio), 1, 1).data; return [...d]; })()`);
  assert.ok(flat[1] > flat[0] || flat[2] > flat[0] + 20, `no colour of pressure in the plan: ${flat}`);
  // A contact that is faded fades its pressure.
  await page.evaluate('genu.shown.fade("contact foot", 0.4)');
  assert.ok(await page.evaluate("genu.view.maps.drawn.every((d) => d.mesh.material.opacity === 0.4 && d.mesh.material.transparent)"), "faded pressure");
  await page.evaluate('genu.shown.fade("contact foot", 1)');
  assert.ok(await page.evaluate("genu.view.maps.drawn.every((d) => d.mesh.material.opacity === 1 && !d.mesh.material.transparent)"), "pressure as it was");
  // Hidden means not drawn, in the picture and in the plan; and back.
  await page.evaluate('genu.shown.set("contact foot", false)');
  await page.settle();
  assert.equal(await page.evaluate(kPixels(viridis)), 0, "hidden pressure is drawn");
  assert.equal(await page.evaluate(`genu.plots.panels.find((p) => p.raw.title.startsWith("Contact area")).chips[0].getAttribute("aria-pressed")`), "false", "hidden in the picture is hidden in the plot");
  await page.evaluate('genu.shown.set("contact foot", true)');
  await quiet(page);
  await page.close();
}

/** Gaps of rigid surfaces: nothing but zero where they touch, and the legend with them. */
async function gaps(page) {
  const found = await page.evaluate(`(() => { const tick = [...document.querySelectorAll(".show .tick")].find((t) => t.textContent === "gap of rigid contacts").querySelector("input"); tick.click();
    const out = genu.view.gaps.pairs.map((p) => ({ name: p.name, least: Math.min(...p.gap), drawn: p.mesh.visible, triangles: p.mesh.geometry.index.count / 3 })), legend = !genu.view.gapLegend.hidden;
    tick.click(); return { out, legend, hidden: genu.view.gaps.pairs.every((p) => !p.mesh.visible) }; })()`);
  assert.equal(found.out.length, 2);
  // Within what the vertices of a drawn plane lie off the contact.
  for (const gap of found.out) assert.ok(gap.drawn && gap.least < 1.5 && gap.triangles > 0, JSON.stringify(gap));
  assert.ok(found.legend && found.hidden);
}

/** A ball that turns by 100 deg is unrolled: its pressure moves by the arc. */
async function unrolled(browser) {
  const text = readFileSync(join(root, "tests/report_page/scenes/layer.toml"), "utf8");
  const result = solve("roll", written("roll.toml", text.replace("[0, 20]", "[0, 100]").replace("increments = 5", "increments = 20")));
  const page = await browser.open(result.page, kLaptop);
  const centres = await page.evaluate(`(() => { const p = genu.paths.find((p) => p.maps[0]?.surface === "ball"); return { unrolled: p.unrolled !== null, title: p.element.querySelector("figcaption").textContent,
    at: [2, 12].map((row) => { let sum = 0, x = 0, y = 0; p.maps[0].each(row, (s, v) => { const [[a, b]] = p.flatSites[0][s]; sum += v; x += v * a; y += v * b; }); return [x / sum, y / sum]; }) }; })()`);
  assert.ok(centres.unrolled);
  assert.match(centres.title, /unrolled/);
  const [[x0, y0], [x1, y1]] = centres.at;
  near(Math.hypot(x1 - x0, y1 - y0), (20 * 50 * Math.PI) / 180, 0.7, "the arc of 50 deg on a ball of 20 mm, but for what the circle through sites beside its equator is smaller");
  await quiet(page);
  await page.close();
}

/** What every viewer has, one control after the other. */
async function controls(browser) {
  const result = solve("controls", join(root, "meshes/dortmans1984/scene.toml"));
  const page = await browser.open(result.page, kLaptop);
  // The field's words come first; translations say where they go; each plan of a knee shows its plateau first.
  assert.deepEqual(await page.evaluate("genu.plots.panels.slice(0, 2).map((p) => p.raw.title)"), ["Grood and Suntay: rotations [deg]", "Grood and Suntay: translations [mm]"]);
  assert.deepEqual(await page.evaluate('genu.plots.panels[0].chips.map((c) => c.getAttribute("aria-pressed"))'), ["false", "true", "true"], "flexion over flexion flattens the others");
  assert.match(await page.evaluate(`genu.plots.panels.find((p) => p.raw.title === "Translations [mm]").element.querySelector(".chips").textContent`), /^x \((lateral|medial)\) .*y \((anterior|posterior)\) .*z \((proximal|distal)\) /);
  assert.equal(await page.evaluate(`genu.plots.panels.some((p) => /-\d/.test(p.element.querySelector(".chips").textContent))`), false, "a hyphen for a minus");
  // The line under the slider, and the axis of the curves.
  await page.evaluate("genu.player.set(36)");
  assert.equal(await page.evaluate('document.querySelector("output.row").textContent'), `Flexion ${(+result.cell(36, "knee.flexion_deg")).toFixed(1)} deg, pose 37 of 71, ${result.cell(36, "stability")}`);
  assert.equal(await page.evaluate("genu.axis.title()"), "Flexion [deg]");
  await page.evaluate(`(() => { const s = document.querySelector(".plotbar select"); s.value = "knee.adduction_deg"; s.dispatchEvent(new Event("change")); })()`);
  assert.equal(await page.evaluate("genu.plots.graphOf(genu.plots.panels[0]).xTitle"), "Adduction [deg]");
  near(await page.evaluate("genu.plots.graphOf(genu.plots.panels[1]).curves[0].x[36]"), result.cell(36, "knee.adduction_deg"), 1e-4, "the curve over another axis");
  await page.evaluate(`genu.axis.choose("knee.flexion_deg")`);

  // A bundle that is hidden in a plot is not drawn; nor is a body.
  const lit = async () => (await page.evaluate(kLit)).share;
  const all = await lit();
  const chip = `genu.plots.panels.find((p) => p.raw.title === "Ligament force [N]").chips[0]`;
  await page.evaluate(`${chip}.click()`);
  await page.settle();
  const name = await page.evaluate(`${chip}.textContent.trim().split(" ")[0]`);
  assert.equal(await page.evaluate(`genu.view.ligaments.bundles.find((b) => b.key === "ligament ${name}").tubes.visible`), false);
  assert.equal(await page.evaluate(`[...document.querySelectorAll(".show .item")].find((i) => i.textContent === "${name}").querySelector("input").checked`), false, "the menu follows");
  await page.evaluate(`[...document.querySelectorAll(".show .item")].find((i) => i.textContent === "${name}").querySelector("input").click()`);
  await page.settle();
  assert.equal(await page.evaluate(`${chip}.getAttribute("aria-pressed")`), "true", "the plot follows the menu");
  near(await lit(), all, 1e-6, "shown again");
  for (const body of ["femur", "tibia"]) {
    await page.evaluate(`genu.shown.set("body ${body}", false)`);
    await page.settle();
    assert.ok((await lit()) < all - 0.01, `${body} is hidden and drawn`);
    await page.evaluate(`genu.shown.fade("body ${body}", 0.5)`);
  }
  assert.equal(await page.evaluate("genu.view.bodies[0].materials[1].opacity"), 0.5);
  assert.ok(await page.evaluate("genu.view.bodies[0].veils.every((v) => v.mesh.visible)"), "behind what is seen through nothing of itself is drawn");

  // Names on hover and on tap.
  await page.evaluate('genu.view.look(genu.view.views()[1]); genu.shown.fade("body femur", 1)');
  await page.settle();
  const spot = await page.evaluate(`(() => { const b = genu.view.bodies[0], i = b.run.bodies.findIndex((x) => x.name === "femur"), o = genu.view.bodies[0].outline.find((o) => o.body === i), v = b.groups[i].children[0].geometry.boundingSphere?.center.clone() ?? o.points[0].clone();
    const r = genu.view.canvas.getBoundingClientRect(), hits = []; for (let y = 0.1; y < 0.9; y += 0.05) for (let x = 0.1; x < 0.9; x += 0.05) { genu.view.point({ clientX: r.left + x * r.width, clientY: r.top + y * r.height }); if (/femur/.test(genu.view.tip.textContent) && !genu.view.tip.hidden) hits.push([r.left + x * r.width, r.top + y * r.height]); } genu.view.tip.hidden = true; return hits[0]; })()`);
  await page.press(spot[0], spot[1]);
  assert.match(await page.evaluate("genu.view.tip.hidden ? '' : genu.view.tip.textContent"), /femur/);

  // Keys without a click first.
  await page.evaluate("document.activeElement.blur()");
  await page.key("2");
  const turned = await page.evaluate("genu.view.looked.name");
  assert.equal(turned, await page.evaluate("genu.view.views()[2].name"));

  // Zoom, move and reset in the plots.
  await page.evaluate(`document.querySelector('.plotbar [aria-label^="Zoom in"]').click()`);
  const zoomed = await page.evaluate("genu.plots.graphOf(genu.plots.panels[0]).x");
  near(zoomed[1] - zoomed[0], 35, 0.01, "half of the axis");
  await page.evaluate(`document.querySelector('.plotbar [aria-label^="Move right"]').click()`);
  near((await page.evaluate("genu.plots.graphOf(genu.plots.panels[0]).x"))[0], zoomed[0] + 8.75, 0.01, "moved by a quarter");
  await page.evaluate(`[...document.querySelectorAll(".plotbar button")].find((b) => b.textContent === "Reset").click()`);
  const whole = await page.evaluate("genu.plots.graphOf(genu.plots.panels[0]).x");
  near(whole[0], 0, 1e-9, "all from the start");
  near(whole[1], 70, 1e-9, "to the end");

  await saved(page, result);
  await quiet(page);
  await page.close();
}

/** A first step in which flexion stands still is folded away: the page begins where the knee flexes. */
async function settling(browser) {
  const text = readFileSync(join(root, "meshes/dortmans1984/scene.toml"), "utf8").replace("[[step]]", '[[step]]\nprescribe = { "knee.flexion" = 0 }\nincrements = 5\n\n[[step]]');
  const result = solve("settling", written("settling.toml", text)), page = await browser.open(result.page, kLaptop);
  let last = 0;
  while (Math.abs(result.cell(last + 1, "knee.flexion_deg")) < 1e-9) ++last;
  assert.ok(last >= 5);
  assert.equal(await page.evaluate("genu.axis.title()"), "Flexion [deg]", "flexion is the axis although it stands still at first");
  assert.deepEqual(await page.evaluate("[genu.axis.settling(genu.runs[0]), genu.player.row]"), [last, last]);
  const graph = await page.evaluate("(() => { const g = genu.plots.graphOf(genu.plots.panels[0]); return { marker: g.settled, first: g.curves.map((c) => c.first) }; })()");
  near(graph.marker, 0, 1e-12, "the marker");
  assert.ok(graph.first.every((f) => f === last), "settling rows are drawn");
  await page.evaluate("genu.player.set(1)");
  assert.match(await page.evaluate('document.querySelector("output.row").textContent'), /^Flexion 0 deg, pose 2 of \d+, settling, stable$/);
  await quiet(page);
  await page.close();
}

/** Files: caught where the page offers them. */
async function saved(page, result) {
  await page.evaluate(`(() => { window.kept = []; const make = URL.createObjectURL.bind(URL); URL.createObjectURL = (b) => { window.kept.push(b); return make(b); }; HTMLAnchorElement.prototype.click = function () { window.keptName = this.download; }; })()`);
  const save = async (text) => {
    await page.evaluate(`(() => { window.kept.length = 0; [...document.querySelectorAll(".save button")].find((b) => b.textContent.startsWith("${text}")).click(); })()`);
    for (let k = 0; k < 300 && !(await page.evaluate("kept.length")); ++k) await page.evaluate("new Promise((d) => setTimeout(d, 100))");
    return page.evaluate("(async () => ({ name: keptName, type: kept[0].type, size: kept[0].size, text: kept[0].type.startsWith('text') || kept[0].type.includes('svg') ? await kept[0].text() : [...new Uint8Array(await kept[0].slice(0, 32).arrayBuffer())] }))()");
  };
  const csv = await save("Numbers"), own = readFileSync(join(folder, "controls", "results.csv"), "utf8").trim().split("\n").map((l) => l.split(",")), made = csv.text.trim().split("\n").map((l) => l.split(","));
  assert.match(csv.name, /\.csv$/);
  assert.deepEqual(made[0], own[0], "the columns of results.csv");
  assert.equal(made.length, own.length);
  for (let r = 1; r < own.length; ++r)
    for (let c = 0; c < own[0].length; ++c)
      if (made[r][c] !== own[r][c]) assert.ok(Math.abs(made[r][c] - own[r][c]) <= 1.3e-7 * Math.abs(own[r][c]) + 1e-38, `${own[0][c]} of row ${r}: ${made[r][c]} is not ${own[r][c]}`);
  const svg = await save("Curves");
  assert.match(svg.text, /^<svg [\s\S]*Ligament force \[N\][\s\S]*Flexion \[deg\][\s\S]*<\/svg>\n$/);
  assert.ok(!/NaN|undefined/.test(svg.text), "the SVG holds no numbers");
  const png = await save("Picture"), word = (at) => ((png.text[at] * 256 + png.text[at + 1]) * 256 + png.text[at + 2]) * 256 + png.text[at + 3];
  const size = await page.evaluate("[genu.view.element.clientWidth, genu.view.element.clientHeight]");
  assert.deepEqual([word(16), word(20)], size.map((v) => 2 * v), "the picture has not twice its size");
  const film = await save("Animation");
  assert.equal(film.type, "video/webm");
  assert.deepEqual(film.text.slice(0, 4), [0x1a, 0x45, 0xdf, 0xa3], "it is no WebM");
  assert.ok(film.size > 5000, `the animation has ${film.size} bytes`);
  // Without a recorder it says so.
  await page.evaluate("window.MediaRecorder = undefined; [...document.querySelectorAll('.save button')].find((b) => b.textContent.startsWith('Animation')).click()");
  assert.match(await page.evaluate('document.querySelector(".said").textContent'), /has no recorder/);
}

/** Whatever there is to remark, the picture, the slider and two plots are in the window; light and dark. */
async function layout(browser) {
  solve("moment", join(root, "meshes/dortmans1984/scene-moment.toml"));
  for (const name of ["knee", "layer", "moment"]) {
    const page = await browser.open(join(folder, name, "report.html"), kLaptop);
    const inside = (selector) => page.evaluate(`[...document.querySelectorAll("${selector}")].filter((e) => { const r = e.getBoundingClientRect(); return r.width > 0 && r.bottom <= innerHeight && r.right <= innerWidth; }).length`);
    assert.equal(await inside(".view"), 1, `${name}: the picture`);
    assert.equal(await inside(".track input[type=range]"), 1, `${name}: the slider`);
    assert.ok((await inside(".plot")) >= 2, `${name}: two plots`);
    if (name === "moment") assert.match(await page.evaluate('document.querySelector(".notes summary").textContent'), /^4 remarks: /);
    const light = await page.evaluate("getComputedStyle(document.body.parentElement).backgroundColor");
    await page.dark();
    const dark = await page.evaluate("getComputedStyle(document.body.parentElement).backgroundColor");
    assert.notEqual(dark, light);
    assert.ok((await page.evaluate(kPixels([[0x20, 0x27, 0x2e]]))) > 1000, `${name}: the picture stays light`);
    await quiet(page);
    await page.close();
  }
}

/** A roll that only guides a ligament is faint, hides nothing, and has its own tick. */
async function wrapped(browser) {
  const result = solve("wrapped", join(root, "tests/report_page/scenes/wrapped.toml"));
  const page = await browser.open(result.page, kLaptop);
  assert.deepEqual(await page.evaluate("genu.runs[0].raw.meshes.map((m) => m.kind)"), ["surface", "surface", "wrapped"]);
  const look = "(() => { const { mesh } = genu.view.bodies[0].wrapped[0]; return [mesh.visible, mesh.material.opacity, mesh.material.depthWrite]; })()";
  assert.deepEqual(await page.evaluate(look), [true, 0.15, false]);
  const seen = (await page.evaluate(kLit)).hash;
  await page.evaluate(`[...document.querySelectorAll(".show .item")].find((i) => i.textContent === "surfaces that paths wrap round").querySelector("input").click()`);
  await page.settle();
  assert.equal((await page.evaluate(look))[0], false);
  assert.notEqual((await page.evaluate(kLit)).hash, seen, "the roll was not drawn");
  await quiet(page);
  await page.close();
}

/** The cup of a hip lies before its one contact: it is seen through, and "Show" says so. A knee's plateau is not. */
async function socket(browser) {
  solve("hip", join(root, "meshes/joints/hip.toml"));
  for (const [name, seen] of [["hip", { femur: 0.5, pelvis: 0.3 }], ["knee", { femur: 0.5, tibia: 1 }]]) {
    const page = await browser.open(join(folder, name, "report.html"), kLaptop);
    for (const [body, opacity] of Object.entries(seen)) {
      assert.equal(await page.evaluate(`genu.view.bodies[0].materials[genu.runs[0].bodies.findIndex((b) => b.name === "${body}")].opacity`), opacity, `${body} of the ${name}`);
      near(await page.evaluate(`+[...document.querySelectorAll(".show .item")].find((i) => i.textContent === "${body}").querySelector("input[type=range]").value`), opacity, 1e-9, `the slider of ${body}`);
    }
    await quiet(page);
    await page.close();
  }
}

/** Measured values are rings where the file has them; the file's name is text, whatever it holds. */
async function beside(browser) {
  const measured = written("<img src=x onerror=alert(1)>.csv", "angle,turn,tilt\n0,0.1,\n0.5,nan,-1\n1,-3,-2\n");
  const result = solve("beside", join(root, "meshes/dortmans1984/scene.toml"), 0, ["--beside", measured, "--columns", "knee.flexion=angle[rad], knee.rotation=turn[deg], knee.adduction=tilt[deg]"]);
  const page = await browser.open(result.page, kLaptop);
  const drawn = await page.evaluate(`(() => { const p = genu.plots.panels[0], g = genu.plots.graphOf(p); return { title: p.raw.title, points: g.points.map((q) => [...q.x].map((x, k) => [x, Number.isFinite(q.y[k]) ? q.y[k] : null])) }; })()`);
  assert.equal(drawn.title, "Rotations [deg]", "what was measured comes first");
  const degree = 180 / Math.PI, expected = [[[0, null], [0.5, -1], [1, -2]], [[0, 0.1], [0.5, null], [1, -3]]];
  assert.equal(drawn.points.length, 2);
  drawn.points.forEach((points, i) => points.forEach(([x, y], k) => {
    near(x, expected[i][k][0] * degree, 1e-4, "the measured angle");
    if (expected[i][k][1] === null) assert.equal(y, null, "NaN is drawn");
    else near(y, expected[i][k][1], 1e-6, "the measured value");
  }));
  assert.ok((await page.evaluate("document.querySelector('.measured').textContent")).startsWith("<img src=x"));
  await page.evaluate('genu.axis.choose("row")');
  assert.equal(await page.evaluate("genu.plots.graphOf(genu.plots.panels[0]).points.length"), 0, "a file without rows is drawn over them");
  await quiet(page);
  await page.close();
}

/** Two ligaments with the same forces: what was measured of one is drawn over that one. */
async function besideAnEqualCurve(browser) {
  const text = readFileSync(join(root, "meshes/dortmans1984/scene.toml"), "utf8"), at = text.indexOf("[[step]]");
  const equal = ["left", "right"].map((name) => `[ligament.${name}]\nfrom = { body = "femur", point = [0, 0, 5] }\nto = { body = "tibia", point = [0, 0, -40] }\nlaw = "spring"\nstiffness = 2\nslack_length = 40\n`).join("");
  const measured = written("right.csv", "knee.flexion_deg,right.force_N,left.force_N\n0,7,\n30,8,6\n");
  const result = solve("equal", written("equal.toml", text.slice(0, at) + equal + text.slice(at)), 0, ["--beside", measured]);
  assert.equal(result.cell(30, "left.force_N"), result.cell(30, "right.force_N"));
  const page = await browser.open(result.page, kLaptop);
  const placed = await page.evaluate("genu.plots.beside.map((b) => [b.column, b.panel.title, b.panel.series[b.series].name])");
  assert.deepEqual(placed.sort(), [["left.force_N", "Ligament force [N]", "left"], ["right.force_N", "Ligament force [N]", "right"]]);
  // Over one of two equal columns the other stays.
  await page.evaluate("genu.runs[0].columns.get('knee.x_mm').numbers.set(genu.runs[0].numbers('knee.rotation_deg')); genu.axis.choose('knee.x_mm')");
  assert.equal(await page.evaluate("genu.plots.panels.find((p) => p.raw.title === 'Rotations [deg]').chips.some((c) => c.hidden)"), false, "an equal curve is hidden");
  assert.equal(await page.evaluate("genu.plots.panels.find((p) => p.raw.title === 'Translations [mm]').chips.filter((c) => c.hidden).length"), 1, "the axis is drawn over itself");
  await quiet(page);
  await page.close();
}

/** 2000 ligaments in 401 poses: less than 20 MB, and the page says what it leaves out. 10 000 poses. */
async function large(browser) {
  const text = readFileSync(join(root, "meshes/dortmans1984/scene.toml"), "utf8"), at = text.indexOf("[[step]]");
  const springs = Array.from({ length: 2000 }, (_, k) => { const x = (k % 40) - 20, y = Math.floor(k / 40) - 25;
    return `[ligament.s${k}x]\nfrom = { body = "femur", point = [${x}, ${y}, 20] }\nto = { body = "tibia", point = [${x}, ${y}, -20] }\nlaw = "spring"\nstiffness = 0.001\nslack_length = 60\n`; }).join("");
  const many = solve("many", written("many.toml", (text.slice(0, at) + springs + text.slice(at)).replace("increments = 70", "increments = 400")));
  const long = solve("long", written("long.toml", text.replace("increments = 70", "increments = 9999")));
  for (const [result, rows] of [[many, 401], [long, 10_000]]) {
    assert.equal(result.rows, rows);
    assert.ok(statSync(result.page).size < 20e6, `the page has ${statSync(result.page).size} bytes`);
    const page = await browser.open(result.page, kLaptop);
    const shown = await page.evaluate("genu.runs[0].rows");
    if (shown < rows) assert.match(await page.evaluate('document.querySelector(".verdict").textContent'), /this page shows every \d+(nd|rd|th) of [\d,]+ rows \(results.csv has all\)/);
    await page.evaluate(`genu.player.set(${shown - 1})`);
    assert.match(await page.evaluate('document.querySelector("output.row").textContent'), new RegExp(`^Flexion 70.0 deg, pose ${rows} of ${rows}`));
    assert.ok((await page.evaluate(kLit)).share > 0.03);
    await quiet(page);
    await page.close();
  }
  assert.ok(many.rows > 0);
}

async function words(browser) {
  const result = solve("ball", join(root, "tests/report_page/scenes/ball.toml"));
  const page = await browser.open(result.page, kPhone);
  const title = '</script><script>window.broken = 1</script> a ball & <b>one</b> plane <!--';
  assert.equal(await page.evaluate("document.title"), title);
  assert.equal(await page.evaluate('document.querySelector("h1").textContent'), title);
  assert.equal(await page.evaluate("typeof window.broken"), "undefined");
  assert.equal(await page.evaluate('document.querySelectorAll("script").length'), 4);
  assert.ok((await page.evaluate("document.body.textContent")).includes("Every pose is solved and certified"));
  assert.ok((await page.evaluate(kLit)).share > 0.05);
  await quiet(page);
  await page.close();
}

async function failedRows(browser) {
  const text = readFileSync(join(root, "meshes/dortmans1984/scene-moment.toml"), "utf8").replace('control = "arc_length"\n', "");  // beyond the limit load
  const result = solve("far", written("far.toml", text), 3);
  const page = await browser.open(result.page, kLaptop);
  await page.evaluate(`genu.player.set(${result.rows - 1})`);
  await page.settle();
  const said = await page.evaluate('document.querySelector("output.row").textContent');
  assert.match(said, /not solved \(no equilibrium\): pose \d+ is shown/);
  assert.ok((await page.evaluate('document.querySelector(".verdict").textContent')).includes("Not all of it is solved."));
  assert.ok((await page.evaluate('document.querySelector(".details").textContent')).includes("Not solved: "));
  assert.ok((await page.evaluate(kLit)).share > 0.05);
  await quiet(page);
  await page.close();
}

/** A page with every second row: rows are called by their numbers in results.csv, and a map says of which pose it is. */
async function thinned(browser) {
  const edited = (name, change) => {
    const html = readFileSync(join(folder, name, "report.html"), "utf8"), data = /(id="genu-data">)([\s\S]*?)(<\/script>)/, all = JSON.parse(data.exec(html)[2]);
    change(all.runs[0]);
    return written(`${name}-thinned.html`, html.replace(data, (_, begin, __, end) => begin + JSON.stringify(all).replaceAll("<", "\\u003c") + end));
  };
  let rows = 0;
  const far = await browser.open(edited("far", (run) => { rows = run.rows; run.every = 2; run.rows_in_full = 2 * rows; }), kLaptop);
  const told = await far.evaluate(`[...document.querySelectorAll(".details details")].find((d) => d.firstChild.textContent.startsWith("Not solved")).textContent`);
  assert.match(told, new RegExp(`^Not solved: 1 of the ${rows} rows of this page.*why${2 * rows}no equilibrium`));
  await quiet(far);
  await far.close();

  const page = await browser.open(edited("layer", (run) => { for (const map of run.pressures) map.every = 2; }), kLaptop);
  for (const [row, words] of [[2, ""], [3, "(of pose 3)"]]) {
    await page.evaluate(`genu.player.set(${row})`);
    await page.settle();
    assert.equal(await page.evaluate('(() => { const e = document.querySelector(".view .legends .other"); return e.hidden ? "" : e.textContent; })()'), words, "which pose a map is of");
  }
  await quiet(page);
  await page.close();
}

/** The first pose has no equilibrium, and there is no other. */
async function oneRow(browser) {
  const text = readFileSync(join(root, "meshes/dortmans1984/scene.toml"), "utf8").replace("[[step]]", '[load.lift]\nbody = "femur"\nmoment = [0, 1e6, 0]\n\n[[step]]');
  const result = solve("one-row", written("one-row.toml", text), 3);
  assert.equal(result.rows, 1);
  const page = await browser.open(result.page, kPhone);
  assert.match(await page.evaluate('document.querySelector("output.row").textContent'), /pose 1 of 1, not solved \(no equilibrium\): the reference pose is shown/);
  assert.equal(await page.evaluate('document.querySelector(".play").disabled'), true);
  assert.ok((await page.evaluate(kLit)).share > 0.04);
  await quiet(page);
  await page.close();
}

async function motion(browser) {
  const result = solve("motion", join(root, "meshes/leskovar2019/scene-bones.toml"));
  const page = await browser.open(result.page, kLaptop);
  const before = await page.evaluate(kLit);
  await page.evaluate("genu.player.set(300)");
  await page.settle();
  const swung = await page.evaluate(kLit);
  assert.notEqual(swung.hash, before.hash);
  assert.equal(swung.edge, 0, "bones swing out of the picture");
  const text = await page.evaluate('document.querySelector("output.row").textContent');
  near(+/Time ([\d.]+) s/.exec(text)[1], result.cell(300, "time_s"), 1e-3, "the time");
  // It plays by the clock: one second is a hundred rows here, give or take a slow machine.
  // The clock starts before the player does, so that a pause between the two cannot count as playing too fast.
  const seconds = await page.evaluate("(async () => { genu.player.set(0); const t = performance.now(); genu.player.play(); await new Promise((d) => setTimeout(d, 700)); await new Promise(requestAnimationFrame); genu.player.stop(); return (performance.now() - t) / 1000; })()");
  const row = await page.evaluate("genu.player.row");
  assert.ok(row > 10 && row <= 100 * seconds + 2, `row ${row} after ${seconds} s`);
  await quiet(page);
  await page.close();
}

/** Two results in one page: the differences it tells are those of the two tables. */
async function compared(browser) {
  const one = solve("one", join(root, "meshes/dortmans1984/scene.toml")), other = solve("other", join(root, "meshes/dortmans1984/scene-outer-15.toml"));
  const file = join(folder, "compared.html"), run = spawnSync(genu, ["compare", join(folder, "one"), join(folder, "other"), "--out", file], { encoding: "utf8" });
  assert.equal(run.status, 0, run.stderr);
  const page = await browser.open(file, kLaptop);
  const cells = await page.evaluate(`[...document.querySelectorAll(".details table tr")].map((r) => [...r.children].map((c) => c.textContent)).find((r) => r[0] === "Rotations [deg]" && r[1] === "adduction")`);
  let largest = 0, at = 0;
  for (let k = 0; k < one.rows; ++k) {
    const d = Math.abs(one.cell(k, "knee.adduction_deg") - other.cell(k, "knee.adduction_deg"));
    if (d > largest) [largest, at] = [d, k];
  }
  assert.ok(largest > 0.1);
  near(Math.abs(+cells[2].replace("−", "-")), largest, 1e-3 * largest + 1e-4, "the largest difference");
  near(+cells[3], one.cell(at, "knee.flexion_deg"), 0.01, "where it is");
  assert.match(await page.evaluate('document.querySelector(".verdict table").textContent'), /(anterior|lateral|distraction) [+−][\d.e-]+ mm at [\d.]+ deg, (adduction|external rotation) [+−][\d.]+ deg at [\d.]+ deg/, "the table at the top says what differs most");
  // Curves of differences in the place of the curves, and the axis without a difference of its own.
  const apart = await page.evaluate(`(() => { const box = document.querySelector(".plotbar input"); box.click(); const p = genu.plots.panels.find((p) => p.raw.title === "Rotations [deg]"); const g = genu.plots.graphOf(p);
    const all = g.curves.map((c) => Math.max(...Array.from(c.y, Math.abs).filter(Number.isFinite))); box.click(); return all; })()`);
  assert.ok(apart.some((d) => Math.abs(d - largest) < 1e-4), `no curve of differences reaches ${largest}: ${apart}`);
  assert.ok(await page.evaluate("genu.view.ghosts[0].ligaments.bundles[0].tubes.count") > 0, "no ligament of the other run");
  await page.evaluate("genu.player.set(50)");
  await page.settle();
  const ghost = await page.evaluate(`(() => { const b = genu.view.bodies[1]; return b.groups[b.run.bodies.findIndex((x) => !x.fixed)].matrix.elements[13]; })()`);
  const own = await page.evaluate(`(() => { const b = genu.view.bodies[0]; return b.groups[b.run.bodies.findIndex((x) => !x.fixed)].matrix.elements[13]; })()`);
  assert.notEqual(ghost, own);
  assert.ok((await page.evaluate(kLit)).share > 0.05);
  await quiet(page);
  await page.close();
}

const browser = await Browser.start();
let failed = 0;
try {
  for (const test of [knee, pressure, unrolled, settling, controls, wrapped, socket, layout, beside, besideAnEqualCurve, large, words, failedRows, thinned, oneRow, motion, compared]) {
    const began = Date.now();
    try {
      await test(browser);
      console.log(`ok     ${test.name} (${Date.now() - began} ms)`);
    } catch (error) {
      ++failed;
      console.log(`FAILED ${test.name}: ${error.stack}`);
    }
  }
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
process.exitCode = failed > 0 ? 1 : 0;
