// Where bodies touch: an arrow for the force on the second body, its point at the contact, and the way the contact takes
// over that body's surface.
import { Color, ConeGeometry, CylinderGeometry, Group, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial, SphereGeometry, Vector3 } from "three";
import { pathColour } from "./colours.js";
import { short } from "./dom.js";
import { ink } from "./theme.js";
import { matrixOf } from "./framing.js";

const kMostDots = 240;

class Arrow {
  constructor(size, colour, thin) {
    this.ink = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    this.group = new Group();
    this.shaft = new Mesh(new CylinderGeometry(size * 0.0048 * thin, size * 0.0048 * thin, 1, 12), this.ink);
    this.head = new Mesh(new ConeGeometry(size * 0.0125 * thin, size * 0.036, 20), this.ink);
    this.dot = new Mesh(new SphereGeometry(size * 0.007 * thin, 16, 12), this.ink);
    this.headLength = size * 0.036;
    this.group.add(this.shaft, this.head, this.dot);
    for (const part of this.group.children) part.renderOrder = 10;
  }

  /** From above the tip, along y turned to -direction. */
  place(tip, direction, length) {
    const body = Math.max(length, this.headLength * 1.15);
    this.group.position.copy(tip);
    this.group.quaternion.setFromUnitVectors(new Vector3(0, -1, 0), direction);
    this.head.rotation.z = Math.PI;
    this.head.position.y = this.headLength / 2;
    this.shaft.scale.y = body - this.headLength;
    this.shaft.position.y = this.headLength + (body - this.headLength) / 2;
  }
}

export class Contacts {
  /** `ghost`: the colour of a run that is compared, whose forces have the scale of `like`. */
  constructor(run, size, groups, shown, ghost = null, like = null) {
    Object.assign(this, { run, shown, ghost });
    this.arrows = run.contacts.map((c) => {
      const arrow = new Arrow(size, ghost ?? ink("arrow"), ghost ? 0.8 : 1);
      arrow.group.children.forEach((part) => { part.userData.contact = c; });
      groups[c.body_b].add(arrow.group);
      return arrow;
    });
    this.most = 0;
    for (const c of run.contacts) for (let k = 0; k < run.rows; ++k) this.most = Math.max(this.most, run.contactForce(c, k));
    if (like) this.most = Math.max(like.most, 1e-12);
    this.longest = size * 0.3;
    this.trails = ghost ? [] : run.contacts.map((c) => this.trail(c, size, groups[c.body_b]));
    this.trailsOn = true;
  }

  trail(contact, size, group) {
    const { run } = this, rows = [];
    for (let k = 0; k < run.rows; ++k) if (run.contactForce(contact, k) > 0) rows.push(k);
    if (rows.length < 2) return null;
    const step = Math.max(1, Math.ceil(rows.length / kMostDots)), dots = rows.filter((_, i) => i % step === 0);
    const onMap = run.pressures.length > 0;  // on colours a trail is grey, and seen through
    const material = new MeshBasicMaterial(onMap ? { depthTest: false, transparent: true, opacity: 0.75 } : {});
    const mesh = new InstancedMesh(new SphereGeometry(size * (onMap ? 0.0038 : 0.0055), 10, 8), material, dots.length);
    const m = new Matrix4(), colour = new Color();
    dots.forEach((k, i) => {
      const share = run.rows > 1 ? k / (run.rows - 1) : 0;
      mesh.setMatrixAt(i, m.makeTranslation(new Vector3().fromArray(contact.point, 3 * k)));
      mesh.setColorAt(i, onMap ? colour.setScalar(0.02 + 0.75 * share) : colour.set(pathColour(share)));
    });
    mesh.frustumCulled = false;
    mesh.renderOrder = onMap ? 9 : 0;
    group.add(mesh);
    return mesh;
  }

  show(row) {
    const tip = new Vector3(), force = new Vector3();
    this.run.contacts.forEach((c, i) => {
      const size = this.run.contactForce(c, row), arrow = this.arrows[i], alpha = this.shown.alpha(`contact ${c.name}`);
      if (this.trails[i]) this.trails[i].visible = this.trailsOn && alpha > 0;
      arrow.group.visible = size > 0 && alpha > 0;
      arrow.ink.opacity = alpha;
      if (!arrow.group.visible) return;
      arrow.place(tip.fromArray(c.point, 3 * row), force.fromArray(c.force, 3 * row).divideScalar(size), (this.longest * size) / this.most);
    });
  }

  recolour() { if (!this.ghost) this.arrows.forEach((a) => a.ink.color.set(ink("arrow"))); }

  targets() { return this.arrows.filter((a) => a.group.visible).flatMap((a) => a.group.children); }

  /** "medial: 231 N" */
  describe(contact, row) { return `${contact.name}: ${short(this.run.contactForce(contact, row), 3)} N`; }

  /** Where the arrows begin, in the world, in some of the rows. */
  tails() {
    const out = [], step = Math.max(1, Math.floor(this.run.rows / 20));
    for (const c of this.run.contacts)
      for (let row = 0; row < this.run.rows; row += step) {
        const size = this.run.contactForce(c, row);
        if (size > 0) out.push(new Vector3().fromArray(c.force, 3 * row).multiplyScalar(-this.longest / this.most).add(new Vector3().fromArray(c.point, 3 * row)).applyMatrix4(matrixOf(this.run, row, c.body_b)));
      }
    return out;
  }

  setTrails(on) {
    this.trailsOn = on;
    this.trails.forEach((t) => { if (t) t.visible = on; });
  }

  legend() { return this.most > 0 ? `longest arrow ${short(this.most, 3)} N` : null; }
}
