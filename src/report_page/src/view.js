// The joint in three dimensions.
import { AmbientLight, DirectionalLight, Group, HemisphereLight, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer, Matrix4 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { h } from "./dom.js";
import { twinRow } from "./data.js";
import { Bodies } from "./bodies.js";
import { Ligaments } from "./ligaments.js";
import { Contacts } from "./contacts.js";
import { Compass, hinges, triads } from "./axes.js";
import { directions, frame, matrixOf } from "./framing.js";

export class View {
  constructor(runs, player) {
    this.runs = runs;
    this.run = runs[0];
    this.player = player;
    this.row = player.row;
    this.held = -1;
    this.known = directions(this.run);
    this.canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "The joint in three dimensions. Drag to turn, scroll or pinch to zoom; with the keyboard: shift and arrows turn, plus and minus zoom, 0 to 3 choose a view." });
    this.tip = h("div.tip", { hidden: true, role: "status" });
    this.element = h("div.view", {}, this.canvas, this.tip);
    try {
      this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
    } catch {
      this.element.replaceChildren(h("p.plain", {}, "This browser cannot draw in three dimensions (WebGL is missing or switched off). The curves beside hold all the same."));
      this.legend = null;
      return;
    }
    this.renderer.setClearColor("#f4f6f8");
    this.build();
    player.onChange((row) => this.show(row));
    this.listen();
  }

  build() {
    const run = this.run, shown = run.shown(0);
    this.scene = new Scene();
    this.stage = new Group();
    this.stage.matrixAutoUpdate = false;
    this.scene.add(this.stage, this.sky(), new AmbientLight("#ffffff", 0.3));
    this.camera = new PerspectiveCamera(28, 1, 0.1, 1e4);
    const lamp = new DirectionalLight("#ffffff", 1.9);
    lamp.position.set(-0.5, 0.9, 1);
    this.camera.add(lamp, lamp.target);
    lamp.target.position.set(0, 0, -1);
    this.scene.add(this.camera);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => this.paint());
    this.bodies = this.runs.map((r, i) => new Bodies(r, i));
    this.runs.forEach((r, i) => this.bodies[i].world.position.fromArray(r.raw.origin.map((v, k) => v - run.raw.origin[k])));
    // What stands still in both would but lie over itself.
    const still = new Set(run.bodies.filter((b) => b.fixed).map((b) => b.name));
    this.bodies.slice(1).forEach((ghost) => ghost.run.bodies.forEach((b, i) => { if (b.fixed && still.has(b.name)) ghost.groups[i].visible = false; }));
    const kLooks = 14, rows = [...new Set(Array.from({ length: kLooks }, (_, k) => run.shown(Math.round((k / (kLooks - 1)) * Math.max(0, run.rows - 1)))))];
    this.points = rows.flatMap((r) => this.bodies[0].samples(r));
    this.size = this.extent(this.bodies[0].samples(shown));
    const reach = 0.21 * this.size;  // of the bars of hinges
    for (const j of run.raw.joints)
      for (const side of j.type === "revolute" ? [-reach, reach] : [])
        this.points.push(...rows.map((r) => new Vector3(...j.origin).addScaledVector(new Vector3(...j.axis).normalize(), side).applyMatrix4(matrixOf(run, r, j.child))));
    this.bodies.forEach((b) => { b.addSticks(this.size); this.stage.add(b.world); });
    this.ligaments = new Ligaments(run, this.size);
    this.stage.add(this.ligaments.tubes, this.ligaments.ends);
    this.contacts = new Contacts(run, this.size, this.bodies[0].groups);
    this.points.push(...this.contacts.tails());
    hinges(run, this.size, this.bodies[0].groups);
    this.setTriads = triads(run, this.size, this.bodies[0].groups);
    this.compass = new Compass(this.known);
    this.element.append(this.compass.element);
    this.legend = h("div.legends", {}, this.ligaments.legend(), this.contacts.legend() && h("div.legend.arrows", {}, this.contacts.legend()));
    this.element.append(this.legend);
    this.seeThrough();
  }

  /** Light from where up is. */
  sky() {
    const light = new HemisphereLight("#ffffff", "#b9b4a8", 1.7);
    light.position.copy(this.known.up);
    return light;
  }

  extent(points) {
    const low = new Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
    for (const p of points) { low.min(p); high.max(p); }
    const size = points.length > 0 ? high.distanceTo(low) : 0;
    return size > 1e-6 ? size : 20;
  }

  /** What presses from above is seen through, so that the contacts under it are seen. */
  seeThrough() {
    this.opacity = this.run.bodies.map(() => 1);
    const carries = new Set(this.run.contacts.map((c) => c.body_b));
    for (const c of this.run.contacts) if (!carries.has(c.body_a)) this.opacity[c.body_a] = 0.5;
    this.opacity.forEach((o, b) => this.bodies[0].setOpacity(b, o));
  }

  views() {
    const { up, front, side, named } = this.known;
    const oblique = side.clone().multiplyScalar(0.78).addScaledVector(front, 0.6).addScaledVector(up, 0.32);
    const name = (v, word) => (named ? word : `along ${this.axisName(v)}`);
    return [{ name: "oblique", direction: oblique, up }, { name: name(side, "lateral"), direction: side, up },
      { name: name(front, "anterior"), direction: front, up }, { name: name(up, "from above"), direction: up, up: front }];
  }

  axisName(v) {
    const size = v.toArray(), i = size.map(Math.abs).indexOf(Math.max(...size.map(Math.abs)));
    return "xyz"[i];
  }

  look(view) {
    if (!this.renderer) return;
    frame(this.camera, this.controls, this.points.map((p) => p.clone().applyMatrix4(this.stage.matrix)), view.direction, view.up, this.free);
    this.looked = view;
    this.paint();
  }

  /** Shows everything from a body that is held still; -1: from the world. */
  hold(body) {
    this.held = body;
    this.show(this.row);
    this.controls.update();
  }

  show(row) {
    this.row = row;
    if (!this.renderer) return;
    const shown = this.run.shown(row);
    this.stage.matrix.identity();
    if (this.held >= 0) this.stage.matrix.copy(matrixOf(this.run, shown, this.held)).invert().premultiply(matrixOf(this.run, this.run.shown(0), this.held));
    this.stage.matrixWorldNeedsUpdate = true;
    this.bodies[0].show(shown);
    this.runs.slice(1).forEach((r, i) => { this.bodies[1 + i].show(r.shown(twinRow(this.run, row, r))); });
    this.ligaments.show(shown);
    this.contacts.show(row);
    this.paint();
  }

  paint() {
    if (!this.renderer || this.waiting) return;
    this.waiting = requestAnimationFrame(() => { this.waiting = 0; this.paintNow(); });
  }

  paintNow() {
    this.renderer.render(this.scene, this.camera);
    this.compass.update(this.camera);
  }

  resize() {
    if (!this.renderer) return;
    const width = this.element.clientWidth, height = this.element.clientHeight;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    const below = Math.max(this.legend.offsetHeight, 20) + 12;
    this.free = (height - below) / height;
    this.camera.setViewOffset(width, height, 0, below / 2, width, height);
    this.camera.updateProjectionMatrix();
    if (!this.looked) this.look(this.views()[0]);
    else if (!this.moved) this.look(this.looked);
    this.paintNow();
  }

  listen() {
    this.controls.addEventListener("start", () => { this.moved = true; });
    this.canvas.addEventListener("pointermove", (e) => { if (e.buttons === 0 && e.pointerType === "mouse") this.point(e); });
    this.canvas.addEventListener("pointerleave", () => { this.tip.hidden = true; });
    this.canvas.addEventListener("keydown", (e) => this.key(e));
  }

  /** The ligament under the mouse. */
  point(e) {
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector2((2 * (e.clientX - box.left)) / box.width - 1, 1 - (2 * (e.clientY - box.top)) / box.height);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const hit = this.ligaments.tubes.count > 0 ? ray.intersectObject(this.ligaments.tubes)[0] : undefined;
    this.tip.hidden = !hit;
    if (!hit) return;
    this.tip.textContent = this.ligaments.describe(hit.instanceId, this.row);
    this.tip.style.left = `${e.clientX - box.left}px`;
    this.tip.style.top = `${e.clientY - box.top}px`;
  }

  key(e) {
    const views = this.views();
    if (e.key >= "0" && e.key <= "3") { this.moved = false; this.look(views[+e.key]); return; }
    const turns = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (e.shiftKey && e.key in turns) { this.turn(...turns[e.key]); e.preventDefault(); }
    if (e.key === "+" || e.key === "-") this.zoom(e.key === "+" ? 1 / 1.15 : 1.15);
  }

  turn(around, over) {
    this.moved = true;
    const { camera, controls } = this, from = camera.position.clone().sub(controls.target), step = Math.PI / 18;
    const right = camera.up.clone().cross(from).normalize();
    from.applyMatrix4(new Matrix4().makeRotationAxis(camera.up.clone().normalize(), -around * step));
    const raised = from.clone().applyMatrix4(new Matrix4().makeRotationAxis(right, -over * step));
    if (Math.abs(raised.clone().normalize().dot(camera.up)) < 0.995) from.copy(raised);
    camera.position.copy(controls.target).add(from);
    controls.update();
    this.paint();
  }

  zoom(factor) {
    this.moved = true;
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
    this.controls.update();
    this.paint();
  }
}
