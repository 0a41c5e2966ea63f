// Ligaments as tubes, coloured by strain; slack ones are thin and grey. Those of runs that are compared: thin, in the run's colour.
import { Color, CylinderGeometry, Group, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion, SphereGeometry, Vector3 } from "three";
import { gradient, strainColour } from "./colours.js";
import { matrixOf } from "./framing.js";
import { h, short } from "./dom.js";

const kUp = new Vector3(0, 1, 0), kMostBundles = 64;  // more than this are drawn together, and fade by hiding alone

/** A round number at or above. */
function roundUp(v) {
  const power = 10 ** Math.floor(Math.log10(v));
  return [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].map((f) => f * power).find((f) => f >= v * 0.999);
}

/** The tubes of some ligaments. */
class Bundle {
  constructor(owner, key, members) {
    Object.assign(this, { owner, key, members });
    const most = Math.max(1, members.reduce((sum, i) => { const l = owner.all[i]; return sum + (l.rows ?? []).reduce((m, path) => Math.max(m, path.length), l.path.length) - 1; }, 0));
    this.material = new MeshStandardMaterial({ roughness: 0.6 });
    this.tubes = new InstancedMesh(new CylinderGeometry(1, 1, 1, 10, 1, true), this.material, most);
    this.ends = new InstancedMesh(new SphereGeometry(1, 12, 8), this.material, 2 * most);
    for (const mesh of [this.tubes, this.ends]) { mesh.frustumCulled = false; mesh.count = 0; mesh.userData.bundle = this; }
    this.of = [];  // the ligament of each tube
  }

  fade(alpha) {
    this.tubes.visible = this.ends.visible = alpha > 0;
    this.material.transparent = alpha < 1;
    this.material.opacity = alpha;
    this.material.needsUpdate = true;
  }

  show(row, bodies) {
    const { owner } = this, m = new Matrix4(), a = new Vector3(), b = new Vector3(), q = new Quaternion(), colour = new Color();
    let count = 0;
    this.of.length = 0;
    for (const i of this.members) {
      if (this.key === null && owner.shown && !owner.shown.has(owner.keyOf(i))) continue;
      const l = owner.all[i], path = l.rows?.[row]?.length > 0 ? l.rows[row] : l.path, strain = owner.strain(i, row), force = owner.force(i, row);
      const radius = owner.radius * (owner.ghost ? 0.5 : force === 0 ? 0.45 : 1);
      colour.set(owner.ghost ?? strainColour(strain, force, owner.scale.most));
      for (let k = 0; k + 1 < path.length; ++k) {
        a.fromArray(path[k].point).applyMatrix4(bodies[path[k].body]);
        b.fromArray(path[k + 1].point).applyMatrix4(bodies[path[k + 1].body]);
        const length = Math.max(a.distanceTo(b), 1e-6);
        q.setFromUnitVectors(kUp, b.clone().sub(a).divideScalar(length));
        m.compose(a.clone().add(b).multiplyScalar(0.5), q, new Vector3(radius, length, radius));
        this.tubes.setMatrixAt(count, m);
        this.tubes.setColorAt(count, colour);
        [a, b].forEach((end, e) => {
          const last = k + e === 0 || k + e === path.length - 1;  // between them balls only round the corners off
          m.compose(end, q.identity(), new Vector3().setScalar((last ? 1.45 : 1) * radius));
          this.ends.setMatrixAt(2 * count + e, m);
          this.ends.setColorAt(2 * count + e, colour);
        });
        this.of.push(i);
        ++count;
      }
    }
    this.tubes.count = count;
    this.ends.count = 2 * count;
    for (const mesh of [this.tubes, this.ends]) {
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
      mesh.boundingSphere = null;
    }
  }
}

export class Ligaments {
  /** `ghost`: the colour of a run that is compared. */
  constructor(run, size, shown, ghost = null) {
    Object.assign(this, { run, shown, ghost, all: run.raw.ligaments });
    this.radius = size * (this.all.length > 20 ? 0.0055 : 0.0085);
    this.scale = this.largest();
    const bundles = run.bundles();
    this.nameOf = [];
    bundles.forEach(([name, members]) => members.forEach((i) => { this.nameOf[i] = name; }));
    const apart = !ghost && bundles.length <= kMostBundles;
    this.bundles = apart ? bundles.map(([name, members]) => new Bundle(this, `ligament ${name}`, members)) : [new Bundle(this, null, this.all.map((_, i) => i))];
    this.group = new Group();
    this.bundles.forEach((b) => this.group.add(b.tubes, b.ends));
  }

  keyOf(i) { return `ligament ${this.nameOf[i]}`; }
  strain(i, row) { return this.run.number(`${this.all[i].name}.strain`, row); }
  force(i, row) { return this.run.number(`${this.all[i].name}.force_N`, row); }

  /** The strain at the end of the colours, of any that carries force in any row, and whether any is compressed. */
  largest() {
    let most = 0, compression = false, any = false;
    for (const l of this.all) {
      const strain = this.run.numbers(`${l.name}.strain`), force = this.run.numbers(`${l.name}.force_N`);
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
    const bodies = this.run.bodies.map((_, i) => matrixOf(this.run, row, i));
    for (const bundle of this.bundles) {
      if (bundle.key) bundle.fade(this.shown.alpha(bundle.key));
      bundle.show(row, bodies);
    }
  }

  /** Tubes a ray may meet. */
  targets() { return this.bundles.filter((b) => b.tubes.visible && b.tubes.count > 0).map((b) => b.tubes); }

  /** "ACLam1: strain 3.2 %, 41 N" of a hit. */
  describe(hit, row) {
    const i = hit.object.userData.bundle.of[hit.instanceId], strain = this.strain(i, row), force = this.force(i, row), parts = [];
    if (Number.isFinite(strain)) parts.push(`strain ${short(100 * strain, 3)} %`);
    if (Number.isFinite(force)) parts.push(force === 0 ? "slack" : `${short(force, 3)} N`);
    return `${this.all[i].name}: ${parts.join(", ") || "no values"}`;
  }

  legend() {
    if (this.all.length === 0) return null;
    const { most, compression, any } = this.scale, percent = short(100 * most, 2);
    const slack = h("span.key", {}, h("i.slack", { "aria-hidden": "true" }), "slack");
    if (!any) return this.all.some((l) => this.run.numbers(`${l.name}.force_N`)?.some((f) => f === 0)) ? h("div.legend", {}, slack) : null;
    return h("div.legend", {}, slack, h("span.scale", {}, h("span", {}, "ligament strain "), h("span", {}, compression ? `−${percent}` : "0"),
      h("i.bar", { style: { background: gradient(compression) }, "aria-hidden": "true" }), h("span", {}, `${percent} %`)));
  }
}
