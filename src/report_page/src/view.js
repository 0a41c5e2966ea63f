// The joint in three dimensions.
import { AmbientLight, DirectionalLight, Group, HemisphereLight, PerspectiveCamera, Raycaster, Scene, Vector2, Vector3, WebGLRenderer, Matrix4 } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { h } from "./dom.js";
import { Bodies, kWrapped, kWrappedKey } from "./bodies.js";
import { Ligaments } from "./ligaments.js";
import { Contacts } from "./contacts.js";
import { Maps } from "./maps.js";
import { Gaps } from "./gaps.js";
import { Compass, hinges, triads } from "./axes.js";
import { directions, frame, matrixOf } from "./framing.js";
import { kGhosts } from "./colours.js";
import { ink, onTheme } from "./theme.js";

export class View {
  constructor(runs, player, axis, shown) {
    Object.assign(this, { runs, run: runs[0], player, axis, shown });
    this.row = player.row;
    this.held = -1;
    this.known = directions(this.run);
    this.canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "The joint in three dimensions. Drag to turn, scroll or pinch to zoom; with the keyboard: shift and arrows turn, plus and minus zoom, figures choose a view." });
    this.tip = h("div.tip", { hidden: true, role: "status" });
    this.element = h("div.view", {}, this.canvas, this.tip);
    try {
      this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
    } catch {
      this.element.replaceChildren(h("p.plain", {}, "This browser cannot draw in three dimensions (WebGL is missing or switched off). The curves beside hold all the same."));
      this.legend = null;
      return;
    }
    this.renderer.debug.checkShaderErrors = false;  // to ask for them waits for the compiler
    this.renderer.setClearColor(ink("view"));
    this.build();
    player.onChange((row) => this.show(row));
    axis.onChange(() => this.show(this.row));
    shown.onChange(() => this.show(this.row));
    onTheme(() => this.recolour());
    this.listen();
  }

  recolour() {
    if (!this.renderer) return;
    this.renderer.setClearColor(ink("view"));
    this.contacts.recolour();
    this.paint();
  }

  build() {
    const { run, shown } = this, first = run.shown(0);
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
    const kLooks = 14, rows = [...new Set(Array.from({ length: kLooks }, (_, k) => run.shown(Math.round((k / (kLooks - 1)) * Math.max(0, run.rows - 1)))))];
    this.points = rows.flatMap((r) => this.bodies[0].samples(r));
    this.size = this.extent(this.bodies[0].samples(first));
    const reach = 0.21 * this.size;  // of the bars of hinges
    for (const j of run.raw.joints)
      for (const side of j.type === "revolute" ? [-reach, reach] : [])
        this.points.push(...rows.map((r) => new Vector3(...j.origin).addScaledVector(new Vector3(...j.axis).normalize(), side).applyMatrix4(matrixOf(run, r, j.child))));
    this.bodies.forEach((b) => { b.addSticks(this.size); this.stage.add(b.world); });
    // What stands still in both would but lie over itself.
    const still = new Set(run.bodies.filter((b) => b.fixed).map((b) => b.name));
    this.bodies.slice(1).forEach((ghost) => ghost.run.bodies.forEach((b, i) => { if (b.fixed && still.has(b.name)) ghost.groups[i].traverse((o) => { if (o.isMesh) o.visible = false; }); }));
    this.ligaments = new Ligaments(run, this.size, shown);
    this.stage.add(this.ligaments.group);
    this.contacts = new Contacts(run, this.size, this.bodies[0].groups, shown);
    this.points.push(...this.contacts.tails());
    this.ghosts = this.runs.slice(1).map((r, i) => this.ghost(r, i));
    this.maps = new Maps(run, shown, this.bodies[0]);
    this.gaps = new Gaps(run, shown, this.bodies[0]);
    hinges(run, this.size, this.bodies[0].groups);
    this.setTriads = triads(run, this.size, this.bodies[0].groups);
    this.compass = new Compass(this.known);
    this.element.append(this.compass.element);
    const gap = this.gaps.possible ? h("div.legend", { hidden: true }, this.gaps.legend()) : null;
    this.gapLegend = gap;
    this.legend = h("div.legends", {}, this.maps.any ? h("div.legend", {}, this.maps.legend()) : null, gap, this.ligaments.legend(), this.contacts.legend() && h("div.legend.arrows", {}, this.contacts.legend()));
    this.element.append(this.legend);
    this.seeThrough();
  }

  /** Ligaments and contacts of a run that is compared, in its colour. */
  ghost(run, i) {
    const colour = kGhosts[i % kGhosts.length], world = this.bodies[1 + i].world, size = this.size;
    const ligaments = new Ligaments(run, size, null, colour);
    world.add(ligaments.group);
    const groups = this.bodies[1 + i].groups;
    return { ligaments, contacts: new Contacts(run, size, groups, this.shown, colour, this.contacts) };
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

  /** What presses from above is seen through, so that the contacts under it are seen; and so is what hides them all. */
  seeThrough() {
    this.shown.opacity.set(kWrappedKey, kWrapped);
    const carries = new Set([...this.run.contacts.map((c) => c.body_b)]), pressed = this.run.contacts.map((c) => c.body_a).filter((b) => !carries.has(b));
    for (const body of pressed) this.shown.opacity.set(`body ${this.run.bodies[body].name}`, this.run.pressures.length > 0 ? 0.35 : 0.5);
    for (const body of this.hiding(new Set(pressed))) this.shown.opacity.set(`body ${this.run.bodies[body].name}`, 0.3);
  }

  /** Bodies that lie before every contact of the first row with any, from where the picture begins: a socket does. `clear`: seen through already. */
  hiding(clear) {
    const { run } = this, row = Array.from({ length: run.rows }, (_, k) => k).find((k) => run.contacts.some((c) => run.contactForce(c, k) > 0));
    if (row === undefined) return [];
    const toEye = this.views()[0].direction.clone().normalize(), far = 4 * this.size, from = new Vector3(), ray = new Raycaster();
    this.bodies[0].show(row);
    this.bodies[0].world.updateMatrixWorld(true);
    let hiding = run.bodies.map((_, i) => i).filter((i) => !clear.has(i));
    for (const c of run.contacts) {
      if (hiding.length === 0) break;
      if (!(run.contactForce(c, row) > 0)) continue;
      const frame = this.bodies[0].groups[c.body_b].matrixWorld, pushed = from.fromArray(c.force, 3 * row).transformDirection(frame).dot(toEye);
      ray.set(from.fromArray(c.point, 3 * row).applyMatrix4(frame).addScaledVector(toEye, far), toEye.clone().negate());
      ray.far = 0.995 * far;
      // The nearer of the two that touch, however thin; else what a look at the contact meets before it.
      hiding = hiding.filter((i) => i === (pushed > 0 ? c.body_b : c.body_a) || ray.intersectObjects(this.bodies[0].groups[i].children.filter((m) => m.material === this.bodies[0].materials[i]), false).length > 0);
    }
    return hiding;
  }

  views() {
    const { up, front, side, named } = this.known;
    const oblique = side.clone().multiplyScalar(0.78).addScaledVector(front, 0.6).addScaledVector(up, 0.32);
    const both = (v, here, there) => (named ? [here, there] : [`+${this.axisName(v)}`, `−${this.axisName(v)}`]);
    const [lateral, medial] = both(side, "lateral", "medial"), [anterior, posterior] = both(front, "anterior", "posterior"), [proximal, distal] = both(up, "proximal", "distal");
    const from = (v, sign) => v.clone().multiplyScalar(sign);
    return [{ name: "oblique", direction: oblique, up }, { name: anterior, direction: from(front, 1), up }, { name: posterior, direction: from(front, -1), up },
      { name: medial, direction: from(side, -1), up }, { name: lateral, direction: from(side, 1), up }, { name: proximal, direction: from(up, 1), up: front }, { name: distal, direction: from(up, -1), up: front }];
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
    this.run.bodies.forEach((b, i) => this.bodies[0].setOpacity(i, this.shown.alpha(`body ${b.name}`)));
    this.bodies[0].setWrapped(this.shown.alpha(kWrappedKey));
    this.bodies[0].show(shown);
    this.runs.slice(1).forEach((r, i) => {
      const there = r.shown(this.axis.twin(row, r));
      this.bodies[1 + i].show(there);
      this.ghosts[i].ligaments.show(there);
      this.ghosts[i].contacts.show(there);
    });
    this.ligaments.show(shown);
    this.contacts.show(row);
    this.maps.show(row);
    this.maps.tellOther(row);
    this.gaps.show(row);
    if (this.gapLegend) this.gapLegend.hidden = !this.gaps.on;
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

  /** The legends and directions of the picture, for a file of it. */
  drawLegends(g, width, height) {
    const text = ink("ink");
    g.font = "12px system-ui, 'DejaVu Sans', sans-serif";
    g.textBaseline = "middle";
    const around = this.element.getBoundingClientRect();
    for (const part of this.legend.querySelectorAll("span, i, div.arrows")) {
      const box = part.getBoundingClientRect(), x = box.left - around.left, y = box.top - around.top;
      if (box.width === 0) continue;
      if (part.tagName === "I") {
        const colours = getComputedStyle(part).backgroundImage.match(/rgba?\([^)]*\)/g) ?? [getComputedStyle(part).backgroundColor];
        const fill = g.createLinearGradient(x, 0, x + box.width, 0);
        colours.forEach((c, i) => fill.addColorStop(colours.length > 1 ? i / (colours.length - 1) : 0, c));
        g.fillStyle = fill;
        g.fillRect(x, y, box.width, box.height);
      } else {
        g.fillStyle = text;
        const own = [...part.childNodes].filter((n) => n.nodeType === 3).map((n) => n.textContent).join("").trim();
        const after = part.querySelector("i");  // a key's name stands after its mark
        if (own) g.fillText(own, after ? after.getBoundingClientRect().right - around.left + 6 : x, y + box.height / 2);
      }
    }
    this.compass.drawOn(g, height);
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
    let pressed = null, waiting = 0;
    this.canvas.addEventListener("pointermove", (e) => {
      if (e.buttons !== 0 || e.pointerType !== "mouse") return;
      cancelAnimationFrame(waiting);
      waiting = requestAnimationFrame(() => this.point(e));
    });
    this.canvas.addEventListener("pointerdown", (e) => { pressed = [e.clientX, e.clientY]; this.tip.hidden = true; });
    this.canvas.addEventListener("pointerup", (e) => { if (pressed && Math.hypot(e.clientX - pressed[0], e.clientY - pressed[1]) < 6) this.point(e); pressed = null; });
    this.canvas.addEventListener("pointerleave", () => { cancelAnimationFrame(waiting); this.tip.hidden = true; });
    document.addEventListener("keydown", (e) => this.key(e));
  }

  /** The name of what is under the pointer. */
  point(e) {
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector2((2 * (e.clientX - box.left)) / box.width - 1, 1 - (2 * (e.clientY - box.top)) / box.height);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const text = this.nameAt(ray);
    this.tip.hidden = text === "";
    if (!text) return;
    this.tip.textContent = text;
    this.tip.style.left = `${e.clientX - box.left}px`;
    this.tip.style.top = `${e.clientY - box.top}px`;
  }

  /** Arrows lie over all; ligaments before the bodies behind them; empty where nothing is. */
  nameAt(ray) {
    const arrow = ray.intersectObjects(this.contacts.targets(), false)[0];
    if (arrow) return this.contacts.describe(arrow.object.userData.contact, this.row);
    const tube = ray.intersectObjects(this.ligaments.targets(), false)[0], body = ray.intersectObjects(this.bodies[0].targets(), false)[0];
    const clear = body && this.bodies[0].materials[body.object.userData.body].opacity < 0.95;
    if (tube && (!body || clear || tube.distance <= body.distance)) return this.ligaments.describe(tube, this.row);
    if (!body) return "";
    const { name, body: b } = body.object.userData, bone = this.run.bodies[b].name;
    return name === bone ? bone : `${name.replaceAll("_", " ")} (${bone})`;
  }

  /** Without a click first, unless the key means something where the focus is. */
  key(e) {
    if (e.altKey || e.ctrlKey || e.metaKey || /^(INPUT|SELECT|TEXTAREA)$/.test(e.target.tagName) && e.target.type !== "range") return;
    const views = this.views();
    if (!e.shiftKey && e.key >= "0" && e.key < String(views.length)) { this.moved = false; this.look(views[+e.key]); return; }
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
