// What cartilage carries, coloured on the surface that casts: triangles of its mesh, or discs about the places of its lattice. One
// scale for all maps of a run.
import { BufferAttribute, BufferGeometry, CircleGeometry, Color, DoubleSide, DynamicDrawUsage, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial, Quaternion, SRGBColorSpace, Vector3 } from "three";
import { pressureGradient, pressureRgb } from "./colours.js";
import { h, short } from "./dom.js";

const kOut = new Vector3(0, 0, 1);
const look = (more) => new MeshBasicMaterial({ side: DoubleSide, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -8, ...more });

/** Colours of a scale with 256 parts, as three.js takes them. */
function table(rgb) {
  return Array.from({ length: 256 }, (_, i) => { const [r, g, b] = rgb(i / 255); return new Color().setRGB(r / 255, g / 255, b / 255, SRGBColorSpace); });
}
const kColours = table(pressureRgb);
const colourAt = (t) => kColours[Math.min(255, Math.max(0, Math.round(255 * t)))];

/** Triangles of a mesh that carry load. */
class TriangleMap {
  constructor(map, geometry) {
    this.map = map;
    this.points = geometry.attributes.position.array;
    this.corners = geometry.index.array;
    const most = 9 * map.triangles.length, flat = new BufferGeometry();
    this.position = new BufferAttribute(new Float32Array(most), 3).setUsage(DynamicDrawUsage);
    this.colour = new BufferAttribute(new Float32Array(most), 3).setUsage(DynamicDrawUsage);
    flat.setAttribute("position", this.position);
    flat.setAttribute("color", this.colour);
    this.mesh = new Mesh(flat, look({ vertexColors: true }));
    this.mesh.frustumCulled = false;
  }

  show(row, most) {
    let at = 0;
    const { position, colour, points, corners, map } = this;
    map.each(row, (site, pressure) => {
      const c = colourAt(pressure / most);
      for (let k = 0; k < 3; ++k) {
        const v = 3 * corners[3 * map.triangles[site] + k];
        position.array.set([points[v], points[v + 1], points[v + 2]], at);
        colour.array.set([c.r, c.g, c.b], at);
        at += 3;
      }
    });
    this.mesh.geometry.setDrawRange(0, at / 3);
    position.needsUpdate = colour.needsUpdate = true;
  }
}

/** The normal of the mesh at the vertex nearest to each place: how a disc lies. */
function normalsAt(places, geometry) {
  const p = geometry.attributes.position.array, n = geometry.attributes.normal.array, cells = new Map(), out = new Float32Array(places.length);
  geometry.computeBoundingSphere();
  const edge = Math.max(1e-3, geometry.boundingSphere.radius / 24), key = (x, y, z) => `${Math.floor(x / edge)},${Math.floor(y / edge)},${Math.floor(z / edge)}`;
  for (let i = 0; i < p.length; i += 3) { const k = key(p[i], p[i + 1], p[i + 2]); cells.has(k) ? cells.get(k).push(i) : cells.set(k, [i]); }
  for (let s = 0; s < places.length; s += 3) {
    let best = -1, distance = Infinity;
    for (let reach = 1; best < 0 && reach <= 4; ++reach)
      for (let dx = -reach; dx <= reach; ++dx) for (let dy = -reach; dy <= reach; ++dy) for (let dz = -reach; dz <= reach; ++dz)
        for (const i of cells.get(key(places[s] + dx * edge, places[s + 1] + dy * edge, places[s + 2] + dz * edge)) ?? []) {
          const d = (p[i] - places[s]) ** 2 + (p[i + 1] - places[s + 1]) ** 2 + (p[i + 2] - places[s + 2]) ** 2;
          if (d < distance) { distance = d; best = i; }
        }
    for (let k = 0; k < 3; ++k) out[s + k] = best < 0 ? (k === 2 ? 1 : 0) : n[best + k];
  }
  return out;
}

/** Discs about the places of a lattice. */
class DiscMap {
  constructor(map, geometry) {
    this.map = map;
    const normals = geometry ? normalsAt(map.places, geometry) : null, q = new Quaternion(), n = new Vector3(), p = new Vector3();
    this.mesh = new InstancedMesh(new CircleGeometry(1, 12), look({}), Math.max(1, map.radii.length));
    this.mesh.frustumCulled = false;
    this.matrices = Array.from(map.radii, (radius, s) => {
      normals ? n.fromArray(normals, 3 * s).normalize() : n.copy(kOut);
      q.setFromUnitVectors(kOut, n);
      const r = 1.25 * radius;
      return new Matrix4().compose(p.fromArray(map.places, 3 * s).addScaledVector(n, 0.03 * radius), q, new Vector3(r, r, r));
    });
  }

  show(row, most) {
    let count = 0;
    this.map.each(row, (site, pressure) => {
      this.mesh.setMatrixAt(count, this.matrices[site]);
      this.mesh.setColorAt(count, colourAt(pressure / most));
      ++count;
    });
    this.mesh.count = count;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }
}

function fade(material, alpha) {
  if (material.transparent !== alpha < 1) material.needsUpdate = true;
  material.transparent = alpha < 1;
  material.opacity = alpha;
}

export class Maps {
  constructor(run, shown, bodies) {
    Object.assign(this, { run, shown });
    this.visible = true;
    this.any = run.pressures.length > 0;
    this.most = run.pressures.reduce((most, m) => Math.max(most, m.most), 0);
    this.drawn = run.pressures.map((map) => {
      const i = map.mesh >= 0 ? map.mesh : run.raw.meshes.findIndex((m) => m.name === map.surface && m.body === map.body);
      const drawn = map.mesh >= 0 ? new TriangleMap(map, bodies.geometries[i]) : new DiscMap(map, bodies.geometries[i] ?? null);
      drawn.mesh.userData.map = map;
      bodies.groups[map.body].add(drawn.mesh);
      return drawn;
    });
  }

  setVisible(visible) { this.visible = visible; }

  show(row) {
    for (const { map, mesh } of this.drawn) {
      mesh.visible = this.visible && this.shown.hasPair(map.contact) && this.shown.has(`body ${this.run.bodies[map.body].name}`);
      fade(mesh.material, this.shown.alphaPair(map.contact));
    }
    for (const d of this.drawn) if (d.mesh.visible) d.show(row, this.most);
  }

  legend() {
    if (!this.any) return null;
    this.other = h("span.other", { hidden: true }, "");
    return [pressureLegend(this.most), this.other];
  }

  /** Says of which pose the maps are, where they are not of the one that is shown. */
  tellOther(row) {
    if (!this.any) return;
    const kept = this.drawn[0].map.keptRow(row);  // all maps of a run are thinned alike
    this.other.hidden = kept === row || !this.visible;
    this.other.textContent = kept === row ? "" : `(of pose ${this.run.numberOf(kept)})`;
  }
}

export const pressureLegend = (most) => h("span.scale", {}, h("span", {}, "pressure 0"), h("i.bar", { style: { background: pressureGradient() }, "aria-hidden": "true" }), h("span", {}, `${short(most, 3)} MPa`));
