// How far rigid surfaces are apart, as colours on the second: found here, from the triangles that are shown, for the pose that is
// shown. A scene with cartilage shows pressures in its place.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, MeshBasicMaterial, SRGBColorSpace, Vector3 } from "three";
import { gapGradient, gapRgb } from "./colours.js";
import { h } from "./dom.js";
import { matrixOf } from "./framing.js";

const kMostVertices = 60_000, kWidest = 3;  // mm: gaps beyond this are not coloured

/** Triangles in cells, to find the nearest one to a point. */
class Grid {
  constructor(geometry, edge) {
    this.p = geometry.attributes.position.array;
    this.index = geometry.index.array;
    this.edge = edge;
    this.cells = new Map();
    for (let t = 0; t < this.index.length; t += 3) {
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      for (let c = 0; c < 3; ++c) for (let k = 0; k < 3; ++k) { const v = this.p[3 * this.index[t + c] + k]; low[k] = Math.min(low[k], v); high[k] = Math.max(high[k], v); }
      const a = low.map((v) => Math.floor((v - kWidest) / edge)), b = high.map((v) => Math.floor((v + kWidest) / edge));
      if ((b[0] - a[0]) * (b[1] - a[1]) * (b[2] - a[2]) > 4096) continue;  // of an endless plane: too coarse to be coloured
      for (let x = a[0]; x <= b[0]; ++x) for (let y = a[1]; y <= b[1]; ++y) for (let z = a[2]; z <= b[2]; ++z) {
        const key = (x * 73856093) ^ (y * 19349663) ^ (z * 83492791);
        this.cells.has(key) ? this.cells.get(key).push(t) : this.cells.set(key, [t]);
      }
    }
  }

  /** Distance to the nearest triangle, up to kWidest; Infinity beyond. */
  distance(point) {
    const near = this.cells.get((Math.floor(point.x / this.edge) * 73856093) ^ (Math.floor(point.y / this.edge) * 19349663) ^ (Math.floor(point.z / this.edge) * 83492791));
    let best = Infinity;
    for (const t of near ?? []) best = Math.min(best, this.toTriangle(point, t));
    return Math.sqrt(best);
  }

  /** Squared distance to a triangle (Ericson, Real-Time Collision Detection, 5.1.5). */
  toTriangle(q, t) {
    const { p, index } = this, A = 3 * index[t], B = 3 * index[t + 1], C = 3 * index[t + 2];
    const abx = p[B] - p[A], aby = p[B + 1] - p[A + 1], abz = p[B + 2] - p[A + 2], acx = p[C] - p[A], acy = p[C + 1] - p[A + 1], acz = p[C + 2] - p[A + 2];
    const apx = q.x - p[A], apy = q.y - p[A + 1], apz = q.z - p[A + 2];
    const d1 = abx * apx + aby * apy + abz * apz, d2 = acx * apx + acy * apy + acz * apz;
    const bb = abx * abx + aby * aby + abz * abz, bc = abx * acx + aby * acy + abz * acz, cc = acx * acx + acy * acy + acz * acz;
    const d3 = d1 - bb, d4 = d2 - bc, d5 = d1 - bc, d6 = d2 - cc;
    let v, w;
    const vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (d1 <= 0 && d2 <= 0) [v, w] = [0, 0];
    else if (d3 >= 0 && d4 <= d3) [v, w] = [1, 0];
    else if (vc <= 0 && d1 >= 0 && d3 <= 0) [v, w] = [d1 / (d1 - d3), 0];
    else if (d6 >= 0 && d5 <= d6) [v, w] = [0, 1];
    else if (vb <= 0 && d2 >= 0 && d6 <= 0) [v, w] = [0, d2 / (d2 - d6)];
    else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) { w = (d4 - d3) / (d4 - d3 + d5 - d6); v = 1 - w; }
    else { const s = 1 / (va + vb + vc); v = vb * s; w = vc * s; }
    const x = apx - v * abx - w * acx, y = apy - v * aby - w * acy, z = apz - v * abz - w * acz;
    return x * x + y * y + z * z;
  }
}

export class Gaps {
  constructor(run, shown, bodies) {
    Object.assign(this, { run, shown, bodies });
    this.pairs = run.pressures.length > 0 ? [] : (run.raw.pairs ?? []).map((p) => ({ ...p, a: this.meshOf(p.surface_a, p.body_a), b: this.meshOf(p.surface_b, p.body_b) })).filter((p) => p.a >= 0 && p.b >= 0);
    const vertices = this.pairs.reduce((sum, p) => sum + bodies.geometries[p.b].attributes.position.count, 0);
    this.possible = this.pairs.length > 0 && vertices <= kMostVertices;
    this.on = false;
  }

  meshOf(surface, body) { return this.run.raw.meshes.findIndex((m) => m.name === surface && m.body === body); }

  set(on) {
    this.on = on;
    this.shownRow = -2;
    this.show(this.row);
  }

  prepare(pair) {
    const geometry = this.bodies.geometries[pair.b], flat = new BufferGeometry();
    flat.setAttribute("position", geometry.attributes.position);
    flat.setAttribute("color", new BufferAttribute(new Float32Array(3 * geometry.attributes.position.count), 3));
    pair.mesh = new Mesh(flat, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -8 }));
    pair.mesh.frustumCulled = false;
    this.bodies.groups[pair.body_b].add(pair.mesh);
    pair.grid = new Grid(this.bodies.geometries[pair.a], 2 * kWidest);
    pair.gap = new Float32Array(geometry.attributes.position.count);
  }

  show(row) {
    this.row = row;
    if (!this.possible) return;
    for (const pair of this.pairs) if (pair.mesh) pair.mesh.visible = this.on && this.shown.hasPair(pair.name) && this.shown.has(`body ${this.run.bodies[pair.body_b].name}`);
    if (!this.on || row === this.shownRow) return;
    this.shownRow = row;
    for (const pair of this.pairs) this.colour(pair, this.run.shown(row));
  }

  colour(pair, row) {
    if (!pair.mesh) this.prepare(pair);
    const geometry = this.bodies.geometries[pair.b], p = geometry.attributes.position.array, index = geometry.index.array, q = new Vector3(), c = new Color();
    const toA = matrixOf(this.run, row, pair.body_a).invert().multiply(matrixOf(this.run, row, pair.body_b)), colours = pair.mesh.geometry.attributes.color;
    for (let i = 0; i < pair.gap.length; ++i) {
      pair.gap[i] = pair.grid.distance(q.fromArray(p, 3 * i).applyMatrix4(toA));
      const [r, g, b] = gapRgb(pair.gap[i] / kWidest);
      c.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
      colours.array.set([c.r, c.g, c.b], 3 * i);
    }
    const near = [];
    for (let t = 0; t < index.length; t += 3) if ([0, 1, 2].every((k) => pair.gap[index[t + k]] <= kWidest)) near.push(index[t], index[t + 1], index[t + 2]);
    pair.mesh.geometry.setIndex(near);
    colours.needsUpdate = true;
  }

  legend() {
    return h("span.scale", {}, h("span", {}, "gap 0"), h("i.bar", { style: { background: gapGradient() }, "aria-hidden": "true" }), h("span", {}, `${kWidest} mm`));
  }
}
