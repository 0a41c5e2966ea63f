// The bodies of a run: surfaces and bones as meshes; where a body has none, sticks from its middle to what is tied to it.
import {
  BufferAttribute, BufferGeometry, CylinderGeometry, DoubleSide, Group, Matrix4, Mesh, MeshBasicMaterial, MeshStandardMaterial,
  SphereGeometry, Vector3,
} from "three";
import { bytes } from "./data.js";
import { kBodies, kGhosts } from "./colours.js";
import { matrixOf } from "./framing.js";

export function geometryOf(raw) {
  const steps = new Uint16Array(bytes(raw.points)), points = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; ++i) points[i] = raw.low[i % 3] + raw.step * steps[i];
  const corners = raw.corners16 !== undefined ? new Uint16Array(bytes(raw.corners16)) : new Uint32Array(bytes(raw.corners32));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(points, 3));
  geometry.setIndex(new BufferAttribute(corners, 1));
  geometry.computeVertexNormals();
  return geometry;
}

/** The points of a mesh that lie farthest out, in many directions. */
function farPoints(position) {
  const directions = [];
  for (const x of [-1, -0.5, 0, 0.5, 1]) for (const y of [-1, -0.5, 0, 0.5, 1]) for (const z of [-1, -0.5, 0, 0.5, 1]) directions.push([x, y, z]);
  const array = position.array, step = 3 * Math.max(1, Math.floor(position.count / 4000)), far = new Set();
  for (const [x, y, z] of directions) {
    let best = 0, most = -Infinity;
    for (let i = 0; i < array.length; i += step) {
      const out = x * array[i] + y * array[i + 1] + z * array[i + 2];
      if (out > most) { most = out; best = i; }
    }
    far.add(best);
  }
  return [...far].map((i) => new Vector3(array[i], array[i + 1], array[i + 2]));
}

/** Points of a body that anything is tied to, in its own frame. */
function tiedPoints(run, body) {
  const points = run.bodies[body].centre_of_mass ? [new Vector3(...run.bodies[body].centre_of_mass)] : [];
  for (const l of run.raw.ligaments) for (const e of l.path) if (e.body === body) points.push(new Vector3(...e.point));
  for (const j of run.raw.joints) {
    if (j.type === "free") continue;
    const at = new Vector3(...j.origin);
    if (j.child === body) points.push(at);
    const row = run.shown(0);
    if (j.parent === body) points.push(at.applyMatrix4(matrixOf(run, row, j.child)).applyMatrix4(matrixOf(run, row, body).invert()));
  }
  return points;
}

/** Surfaces that guide ligaments and nothing else would hide the bones in them. */
export const kWrappedKey = "wrapped", kWrapped = 0.15;

/** Of a body that is seen through only what is nearest is drawn: this takes the depth before the colours come. */
const kVeil = new MeshBasicMaterial({ colorWrite: false, transparent: true, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });

export class Bodies {
  /** `ghost`: 0 for the run itself, else which one of those it is compared with. */
  constructor(run, ghost = 0) {
    this.run = run;
    this.world = new Group();
    this.groups = run.bodies.map(() => new Group());
    this.materials = run.bodies.map((b, i) => this.material(b, i, ghost));
    this.groups.forEach((g) => { g.matrixAutoUpdate = false; this.world.add(g); });
    this.outline = [];
    this.geometries = [];
    this.veils = [];  // { body, mesh }
    this.wrapped = [];  // { body, mesh } of surfaces that only guide paths
    for (const raw of run.raw.meshes) {
      const geometry = geometryOf(raw);
      this.geometries.push(geometry);
      if (raw.kind === "wrapped" && ghost > 0) continue;
      const mesh = new Mesh(geometry, raw.kind === "wrapped" ? this.faint(raw.body) : this.materials[raw.body]);
      mesh.userData.name = raw.name;
      mesh.userData.body = raw.body;
      this.groups[raw.body].add(mesh);
      if (ghost === 0 && raw.kind !== "wrapped") this.veil(raw.body, mesh);
      if (raw.kind === "wrapped") this.wrapped.push({ body: raw.body, mesh });
      this.outline.push({ body: raw.body, points: farPoints(geometry.attributes.position) });
    }
    this.bare = run.bodies.map((_, i) => !run.raw.meshes.some((m) => m.body === i));
  }

  veil(body, of) {
    const mesh = new Mesh(of.geometry, kVeil);
    mesh.visible = false;
    mesh.renderOrder = 1 + body / this.groups.length;
    of.renderOrder = 1 + (body + 0.5) / this.groups.length;
    this.groups[body].add(mesh);
    this.veils.push({ body, mesh });
  }

  /** How the k-th body is painted. */
  colourOf(i) { return `#${this.materials[i].color.getHexString()}`; }

  /** Meshes a ray may meet. */
  targets() { return this.groups.filter((g, i) => g.visible && this.materials[i].opacity > 0.02).flatMap((g) => g.children.filter((c) => c.visible && c.userData.name !== undefined)); }

  material(body, i, ghost) {
    const moving = this.run.bodies.slice(0, i).filter((b) => !b.fixed).length + 1;
    return new MeshStandardMaterial({
      color: ghost > 0 ? kGhosts[(ghost - 1) % kGhosts.length] : kBodies[body.fixed ? 0 : 1 + ((moving - 1) % (kBodies.length - 1))],
      roughness: 0.72, metalness: 0, side: DoubleSide, transparent: ghost > 0, opacity: ghost > 0 ? 0.28 : 1, depthWrite: ghost === 0 });
  }

  faint(body) {
    const material = this.materials[body].clone();
    return Object.assign(material, { transparent: true, opacity: kWrapped, depthWrite: false });
  }

  /** `opacity` of all surfaces that only guide paths, as far as their bodies are shown. */
  setWrapped(opacity) {
    for (const { mesh } of this.wrapped) {
      mesh.visible = opacity > 0;
      mesh.material.opacity = opacity;
    }
  }

  /** Bodies without a surface: needs the size of the whole to know how thick a stick is. */
  addSticks(size) {
    this.bare.forEach((bare, body) => {
      const points = bare ? tiedPoints(this.run, body) : [];
      if (points.length === 0) return;
      const middle = points.reduce((m, p) => m.addScaledVector(p, 1 / points.length), new Vector3());
      const ball = new SphereGeometry(size * 0.014, 16, 12);
      for (const p of points) {
        const joint = new Mesh(ball, this.materials[body]);
        joint.position.copy(p);
        joint.userData = { name: this.run.bodies[body].name, body };
        this.groups[body].add(joint);
        const length = p.distanceTo(middle);
        if (length < 1e-3) continue;
        const stick = new Mesh(new CylinderGeometry(size * 0.011, size * 0.011, length, 12), this.materials[body]);
        stick.position.copy(p).add(middle).multiplyScalar(0.5);
        stick.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), p.clone().sub(middle).normalize());
        stick.userData = { name: this.run.bodies[body].name, body };
        this.groups[body].add(stick);
      }
    });
  }

  setOpacity(body, opacity) {
    const m = this.materials[body];
    this.groups[body].visible = opacity > 0;
    if (m.opacity === opacity) return;
    if (m.transparent !== opacity < 1) m.needsUpdate = true;
    m.opacity = opacity;
    m.transparent = opacity < 1;
    m.depthWrite = true;
    for (const veil of this.veils) if (veil.body === body) veil.mesh.visible = opacity > 0 && opacity < 1;
  }

  show(row) {
    this.groups.forEach((g, body) => { matrixOf(this.run, row, body, g.matrix); g.matrixWorldNeedsUpdate = true; });
  }

  /** Some points of everything, where it is in a row. */
  samples(row) {
    const out = [], m = new Matrix4();
    for (const { body, points } of this.outline) {
      matrixOf(this.run, row, body, m);
      for (const p of points) out.push(p.clone().applyMatrix4(m));
    }
    for (const l of this.run.raw.ligaments)
      for (const e of l.path) out.push(new Vector3(...e.point).applyMatrix4(matrixOf(this.run, row, e.body, m)));
    this.bare.forEach((bare, body) => {
      if (bare) for (const p of tiedPoints(this.run, body)) out.push(p.applyMatrix4(matrixOf(this.run, row, body, m)));
    });
    return out;
  }
}
