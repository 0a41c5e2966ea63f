// What `genu compare` says lies between two results, without a browser. node differences_test.mjs GENU ROOT.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Axis } from "../../src/report_page/src/axis.js";
import { Run } from "../../src/report_page/src/data.js";
import { differenceOf, differences, stretches } from "../../src/report_page/src/differences.js";

const [genu, root] = process.argv.slice(2);

/** An axis of given values; `first` rows settle. */
const axisOf = (values, first = 0) => ({ values: (run) => values[run], settling: () => first });

const ramp = (from, to, steps) => Array.from({ length: steps }, (_, k) => from + ((to - from) * (k + 1)) / steps);
/** Loaded at rest, flexed, loaded, and back: what a curve is depends on the way. */
const course = (steps) => {
  const flexed = [0, ...ramp(0, 60, steps)], held = Array(4).fill(60), back = ramp(60, 0, 2 * steps);
  return { x: [...flexed, ...held, ...back], y: [...flexed.map((x) => x / 10), ...ramp(6, 10, 4), ...back.map((x) => x / 6)] };
};

function waysOfAnAxis() {
  assert.deepEqual(stretches([5, 0, 1, 1, 1, 0, NaN, -1], 1), [
    { way: 1, rows: [1, 2] }, { way: 0, rows: [2, 3, 4] }, { way: -1, rows: [4, 5, 7] }]);
  assert.deepEqual(stretches([NaN, 3], 0), [{ way: 0, rows: [1] }]);
  assert.deepEqual(stretches([], 0), []);
}

function noDifferenceBetweenEqualCourses() {
  const { x, y } = course(6);
  assert.ok(differenceOf("a", y, "b", y, axisOf({ a: x, b: [...x] })).every((d) => d === 0));
}

/** Other increments: the way out is compared with the way out, and load with load where the rows are as many. */
function otherIncrements() {
  const one = course(6), two = course(9), d = differenceOf("a", one.y, "b", two.y, axisOf({ a: one.x, b: two.x }));
  assert.ok(d.every((v) => Math.abs(v) < 1e-9), `${d}`);
  const off = differenceOf("a", one.y, "b", two.y.map((v) => v + 0.5), axisOf({ a: one.x, b: two.x }));
  assert.ok(off.every((v) => Math.abs(v - 0.5) < 1e-9), `${off}`);
}

/** Where one goes on in a way that the other does not, nothing is said. */
function asFarAsBothGo() {
  const d = differenceOf("a", [0, 1, 2, 9, 9], "b", [0, 1, 2, 3, 4, 5], axisOf({ a: [0, 1, 2, 2, 2], b: [0, 1, 2, 1, 0, -1] }));
  assert.deepEqual([...d], [0, 0, 0, NaN, NaN]);
  // A single way each may be gone from either end.
  assert.deepEqual([...differenceOf("a", [0, 1, 2], "b", [2, 1.5, 1, 0], axisOf({ a: [0, 1, 2], b: [2, 1.5, 1, 0] }))], [0, 0, 0]);
  assert.deepEqual([...differenceOf("a", [0, 1, 2], "b", [3, 4], axisOf({ a: [0, 1, 2], b: [3, 4] }))], [NaN, NaN, NaN]);
}

/** Rows that only one has solved, and rows that settle. */
function rowsLeftOut() {
  assert.deepEqual([...differenceOf("a", [7, 0, 1, 2], "b", [8, 0, NaN, 3], axisOf({ a: [0, 0, 1, 2], b: [0, 0, NaN, 2] }, 1))], [NaN, 0, NaN, 1]);
}

/** Every scene of the tree that can be solved as it is, in seconds, has the curves of itself, whatever they are over. */
function scenesAgainstThemselves() {
  const folder = mkdtempSync(join(tmpdir(), "genu-differences-")), slow = ["total-knee.toml"], kNotAScene = ["bones.toml", "calibration.toml", "sweep.toml"];
  try {
    let scenes = 0;
    for (const place of ["dortmans1984", "wismans1980", "joints", "lenhart_polynomial", "leskovar2019"])
      for (const file of readdirSync(join(root, "meshes", place)).filter((f) => f.endsWith(".toml") && !slow.includes(f) && !kNotAScene.includes(f))) {
        const out = join(folder, place, file), run = spawnSync(genu, ["run", join(root, "meshes", place, file), "--quiet", "--out", out], { encoding: "utf8" });
        assert.equal(run.status, 0, run.stderr);
        const data = /id="genu-data">([\s\S]*?)<\/script>/.exec(readFileSync(join(out, "report.html"), "utf8"))[1];
        const [a, b] = [0, 1].map(() => new Run(JSON.parse(data).runs[0], null)), axis = new Axis([a, b]);
        for (const column of axis.choices) {
          axis.choose(column);
          const all = differences(a, b, axis);
          assert.ok(all.length > 0, `${file} over ${column}: no curve`);
          assert.deepEqual(all.filter((d) => d.largest !== 0), [], `${file} over ${column}`);
        }
        ++scenes;
      }
    assert.ok(scenes >= 15, `only ${scenes} scenes`);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

let failed = 0;
for (const test of [waysOfAnAxis, noDifferenceBetweenEqualCourses, otherIncrements, asFarAsBothGo, rowsLeftOut, scenesAgainstThemselves]) {
  try {
    test();
    console.log(`ok     ${test.name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED ${test.name}: ${error.stack}`);
  }
}
process.exitCode = failed > 0 ? 1 : 0;
