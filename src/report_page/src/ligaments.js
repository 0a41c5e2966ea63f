// Ligaments as tubes, coloured by strain; slack ones are thin and grey.
import { Color, CylinderGeometry, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion, SphereGeometry, Vector3 } from "three";
import { strainColour } from "./colours.js";
import { matrixOf } from "./framing.js";
import { h, short } from "./dom.js";
import { gradient } from "./colours.js";

const kUp = new Vector3(0, 1, 0);

/** A round number at or above. */
function roundUp(v) {
  const power = 10 ** Math.floor(Math.log10(v));
  return [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].map((f) => f * power).find((f) => f >= v * 0.999);
}

export class Ligaments {
  constructor(run, size) {
    this.run = run;
    this.all = run.raw.ligaments;
    this.pieces = this.piecesIn(0);
    this.radius = size * (this.all.length > 20 ? 0.0055 : 0.0085);
    const most = Math.max(1, this.mostPieces()), matte = () => new MeshStandardMaterial({ roughness: 0.6 });
    this.tubes = new InstancedMesh(new CylinderGeometry(1, 1, 1, 10, 1, true), matte(), most);
    this.ends = new InstancedMesh(new SphereGeometry(1, 12, 8), matte(), 2 * most);
    for (const mesh of [this.tubes, this.ends]) { mesh.frustumCulled = false; mesh.count = 0; }
    this.scale = this.largest();
  }

  /** The straight pieces of all ligaments; of one that wraps round a surface its course in that row. */
  piecesIn(row) {
    return this.all.flatMap((l, i) => {
      const path = l.rows?.[row]?.length > 0 ? l.rows[row] : l.path;
      return path.slice(1).map((_, k) => ({ ligament: i, from: path[k], to: path[k + 1] }));
    });
  }

  mostPieces() {
    return this.all.reduce((sum, l) => sum + (l.rows ?? []).reduce((most, path) => Math.max(most, path.length), l.path.length) - 1, 0);
  }

  strain(i, row) { return this.run.number(`${this.all[i].name}.strain`, row); }
  force(i, row) { return this.run.number(`${this.all[i].name}.force_N`, row); }

  /** The strain at the end of the colours, of any that carries force in any row, and whether any is compressed. */
  largest() {
    let most = 0, compression = false, any = false;
    for (const l of this.all) {
      const strain = this.run.columns.get(`${l.name}.strain`)?.numbers, force = this.run.columns.get(`${l.name}.force_N`)?.numbers;
      if (!strain || !force) continue;
      for (let k = 0; k < strain.length; ++k) {
        if (!Number.isFinite(strain[k]) || force[k] === 0) continue;
        any = true;
        most = Math.max(most, Math.abs(strain[k]));
        compression ||= strain[k] < 0 && force[k] < 0;
      }
    }
    return { most: most > 0 ? roundUp(100 * most) / 100 : 0.01, compression, any };
  }

  show(row) {
    const m = new Matrix4(), a = new Vector3(), b = new Vector3(), q = new Quaternion(), colour = new Color();
    const bodies = this.run.bodies.map((_, i) => matrixOf(this.run, row, i));
    let count = 0;
    this.pieces = this.piecesIn(row);
    this.pieces.forEach((piece) => {
      const { strain, force } = { strain: this.strain(piece.ligament, row), force: this.force(piece.ligament, row) };
      a.fromArray(piece.from.point).applyMatrix4(bodies[piece.from.body]);
      b.fromArray(piece.to.point).applyMatrix4(bodies[piece.to.body]);
      const length = Math.max(a.distanceTo(b), 1e-6), radius = this.radius * (force === 0 ? 0.45 : 1);
      q.setFromUnitVectors(kUp, b.clone().sub(a).divideScalar(length));
      m.compose(a.clone().add(b).multiplyScalar(0.5), q, new Vector3(radius, length, radius));
      this.tubes.setMatrixAt(count, m);
      colour.set(strainColour(strain, force, this.scale.most));
      this.tubes.setColorAt(count, colour);
      for (const [k, end] of [a, b].entries()) {
        m.compose(end, q.identity(), new Vector3().setScalar(1.45 * radius));
        this.ends.setMatrixAt(2 * count + k, m);
        this.ends.setColorAt(2 * count + k, colour);
      }
      ++count;
    });
    this.tubes.count = count;
    this.ends.count = 2 * count;
    for (const mesh of [this.tubes, this.ends]) {
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
      mesh.boundingSphere = null;
    }
  }

  /** "ACLam1: strain 3.2 %, 41 N" */
  describe(piece, row) {
    const i = this.pieces[piece].ligament, strain = this.strain(i, row), force = this.force(i, row);
    const parts = [];
    if (Number.isFinite(strain)) parts.push(`strain ${short(100 * strain, 3)} %`);
    if (Number.isFinite(force)) parts.push(force === 0 ? "slack" : `${short(force, 3)} N`);
    return `${this.all[i].name}: ${parts.join(", ") || "no values"}`;
  }

  legend() {
    if (this.all.length === 0) return null;
    const { most, compression, any } = this.scale, percent = short(100 * most, 2);
    const slack = h("span.key", {}, h("i.slack", { "aria-hidden": "true" }), "slack");
    if (!any) return this.all.some((l) => this.run.columns.get(`${l.name}.force_N`)?.numbers?.some((f) => f === 0)) ? h("div.legend", {}, slack) : null;
    return h("div.legend", {}, slack, h("span.scale", {}, h("span", {}, "strain "), h("span", {}, compression ? `−${percent}` : "0"),
      h("i.bar", { style: { background: gradient(compression) }, "aria-hidden": "true" }), h("span", {}, `${percent} %`)));
  }
}
