// report.html in a real browser: what is drawn, moved and pressed, held against results.csv, which the page never sees.
// node page_test.mjs GENU ROOT. Exit code 77: there is no browser to test with.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
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
function solve(name, file, exit = 0) {
  const out = join(folder, name), run = spawnSync(genu, ["run", file, "--quiet", "--out", out], { encoding: "utf8" });
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
    await page.evaluate(`(() => { const s = document.querySelector(".player input[type=range]"); s.value = ${row}; s.dispatchEvent(new Event("input", { bubbles: true })); })()`);
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
    return { line: p.plot.posToVal(parseFloat(p.line.style.left), "x"), text: p.element.querySelector(".chips").textContent }; })()`);
  near(plot.line, result.cell(60, "knee.flexion_deg"), 0.3, "the line in the plot");
  near(+/medial ([\d.]+)/.exec(plot.text)[1], result.cell(60, "medial.force_N"), 0.06, "the force beside the plot");
  // A press in a plot chooses the pose.
  const box = await page.evaluate(`(() => { const r = genu.plots.panels[0].plot.over.getBoundingClientRect(); return [r.left, r.top, r.width, r.height]; })()`);
  await page.press(box[0] + box[2] / 2, box[1] + box[3] / 2);
  near(await page.evaluate("genu.player.row"), 35, 1, "the pose in the middle");

  await keyboard(page);
  await contactPath(page, result);
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
  await page.evaluate('document.querySelector(".player input").focus()');
  await page.key("ArrowRight");
  assert.equal(await row(), 10, "one step on the slider too, not two");
  await page.key("End");
  assert.equal(await row(), 70);
  await page.key("Home");
  assert.equal(await row(), 0);
  await page.evaluate("document.activeElement.blur()");
  await page.key(" ", { code: "Space" });
  assert.equal(await page.evaluate("genu.player.playing"), true);
  await page.evaluate("new Promise((done) => setTimeout(done, 400))");
  await page.key(" ", { code: "Space" });
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

/** The first pose has no equilibrium, and there is no other. */
async function oneRow(browser) {
  const text = readFileSync(join(root, "meshes/dortmans1984/scene.toml"), "utf8").replace("[[step]]", '[load.lift]\nbody = "femur"\nmoment = [0, 1e6, 0]\n\n[[step]]');
  const result = solve("one-row", written("one-row.toml", text), 3);
  assert.equal(result.rows, 1);
  const page = await browser.open(result.page, kPhone);
  assert.match(await page.evaluate('document.querySelector("output.row").textContent'), /Pose 1 of 1, not solved \(no equilibrium\): the reference pose is shown/);
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
  near(+/time ([\d.]+) s/.exec(text)[1], result.cell(300, "time_s"), 1e-3, "the time");
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
  const cells = await page.evaluate(`[...document.querySelectorAll(".details table tr")].map((r) => [...r.children].map((c) => c.textContent)).find((r) => r[1] === "adduction")`);
  let largest = 0, at = 0;
  for (let k = 0; k < one.rows; ++k) {
    const d = Math.abs(one.cell(k, "knee.adduction_deg") - other.cell(k, "knee.adduction_deg"));
    if (d > largest) [largest, at] = [d, k];
  }
  assert.ok(largest > 0.1);
  near(+cells[2], largest, 1e-3 * largest + 1e-4, "the largest difference");
  near(+cells[3], one.cell(at, "knee.flexion_deg"), 0.01, "where it is");
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
  for (const test of [knee, words, failedRows, oneRow, motion, compared]) {
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
