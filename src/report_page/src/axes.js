// The corner that tells directions: the world's axes, or anatomical ones where the scene names them; and hinges' axes.
import { BufferGeometry, CylinderGeometry, Group, Line, LineBasicMaterial, Mesh, MeshBasicMaterial, Vector3 } from "three";
import { kAxes } from "./framing.js";
import { ink } from "./theme.js";

const kSvg = "http://www.w3.org/2000/svg", kColours = ["#b3471b", "#1f7a4d", "#1d5fa8"], kVariables = ["axis0", "axis1", "axis2"];

function svg(tag, attributes) {
  const e = document.createElementNS(kSvg, tag);
  for (const [k, v] of Object.entries(attributes)) e.setAttribute(k, v);
  return e;
}

export class Compass {
  constructor(known) {
    this.axes = known.named
      ? [{ v: known.front, name: "anterior" }, { v: known.up, name: "proximal" }, { v: known.side, name: "lateral" }]
      : kAxes.map((v, i) => ({ v, name: "xyz"[i] }));
    this.size = known.named ? 150 : 84;
    this.element = svg("svg", { class: "compass", viewBox: `0 0 ${this.size} ${this.size}`, width: this.size, height: this.size,
      role: "img", "aria-label": known.named ? "Anatomical directions" : "Axes of the world" });
    this.drawn = this.axes.map((a, i) => {
      const line = svg("line", { stroke: `var(--${kVariables[i]})`, "stroke-width": 2.4, "stroke-linecap": "round" });
      const text = svg("text", { fill: `var(--${kVariables[i]})`, "font-size": 12, "font-weight": 600, "text-anchor": "middle", "dominant-baseline": "central",
        stroke: "var(--view)", "stroke-width": 3, "paint-order": "stroke" });
      text.textContent = a.name;
      this.element.append(line, text);
      return { line, text };
    });
  }

  /** In the lower left corner of a picture. */
  drawOn(g, height) {
    const number = (e, name) => +e.getAttribute(name);
    g.save();
    g.translate(4, height - this.size - 4);
    this.drawn.forEach(({ line, text }, i) => {
      g.globalAlpha = +line.style.opacity || 1;
      g.strokeStyle = g.fillStyle = ink(kVariables[i]);
      g.lineWidth = 2.4;
      g.beginPath();
      g.moveTo(number(line, "x1"), number(line, "y1"));
      g.lineTo(number(line, "x2"), number(line, "y2"));
      g.stroke();
      g.textAlign = { start: "left", end: "right" }[text.getAttribute("text-anchor")] ?? "center";
      g.fillText(text.textContent, number(text, "x"), number(text, "y"));
    });
    g.restore();
  }

  update(camera) {
    const middle = this.size / 2, length = this.axes[0].name.length > 1 ? 25 : 26, turned = new Vector3();
    this.axes.forEach((a, i) => {
      turned.copy(a.v).applyQuaternion(camera.quaternion.clone().invert());
      const x = middle + length * turned.x, y = middle - length * turned.y;
      const { line, text } = this.drawn[i];
      for (const [k, v] of Object.entries({ x1: middle, y1: middle, x2: x, y2: y })) line.setAttribute(k, v.toFixed(1));
      const flat = Math.hypot(turned.x, turned.y), word = a.name.length > 1, aside = word && Math.abs(turned.x) > 0.35 * flat;
      const out = flat > 0.15 ? (aside ? 4 : 11) / flat : 0;
      if (word) text.setAttribute("text-anchor", !aside ? "middle" : turned.x > 0 ? "start" : "end");
      text.setAttribute("x", (x + out * turned.x).toFixed(1));
      text.setAttribute("y", (y - out * turned.y).toFixed(1));
      const away = Math.max(0.3, flat);
      line.style.opacity = text.style.opacity = away.toFixed(2);
    });
  }
}

/** A thin bar along the axis of each hinge, on its child. */
export function hinges(run, size, groups) {
  for (const joint of run.raw.joints) {
    if (joint.type !== "revolute") continue;
    const bar = new Mesh(new CylinderGeometry(size * 0.004, size * 0.004, size * 0.4, 8), new MeshBasicMaterial({ color: "#747e88" }));
    bar.position.fromArray(joint.origin);
    bar.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), new Vector3(...joint.axis).normalize());
    groups[joint.child].add(bar);
  }
}

/** The axes of each body at its own origin. */
export function triads(run, size, groups) {
  const all = run.bodies.map((body, b) => {
    const triad = new Group();
    kAxes.forEach((v, i) => triad.add(new Line(new BufferGeometry().setFromPoints([new Vector3(), v.clone().multiplyScalar(size * 0.14)]),
      new LineBasicMaterial({ color: kColours[i], depthTest: false, transparent: true }))));
    triad.position.fromArray(body.centre).negate();
    triad.visible = false;
    groups[b].add(triad);
    return triad;
  });
  return (visible) => all.forEach((t) => { t.visible = visible; });
}
