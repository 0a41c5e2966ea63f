// The page: verdict, picture, curves, details. Runs after the first are drawn as ghosts and thin lines.
import { h } from "./dom.js";
import { readJson, Run } from "./data.js";
import { Player } from "./player.js";
import { View } from "./view.js";
import { Plots } from "./plots.js";
import { pathPlots } from "./path_plot.js";
import { head, details, foot } from "./words.js";

function pictureControls(view, run) {
  if (!view.renderer) return null;
  const buttons = view.views().map((v, i) => h("button", { type: "button", title: `${v.name} (${i})`, onclick: () => { view.moved = false; view.look(v); } }, v.name));
  const hold = h("select", { "aria-label": "Hold still", onchange: () => view.hold(+hold.value) }, h("option", { value: -1 }, "hold still: the world"),
    run.bodies.map((b, i) => (b.fixed ? null : h("option", { value: i }, `hold still: ${b.name}`))));
  const bodies = run.bodies.map((b, i) => h("label.opacity", {}, h("span", {}, b.name), h("input", { type: "range", min: 0, max: 1, step: 0.05,
    value: view.opacity[i], "aria-label": `How solid ${b.name} is drawn`, oninput: (e) => { view.bodies[0].setOpacity(i, +e.target.value); view.paint(); } })));
  const tick = (text, checked, set) => { const box = h("input", { type: "checkbox", checked, onchange: () => { set(box.checked); view.paint(); } }); return h("label.tick", {}, box, text); };
  return h("div.controls", {}, h("div.buttons", { role: "group", "aria-label": "Views" }, buttons),
    h("details.more", {}, h("summary", {}, "Show"), h("div.menu", {}, hold, bodies,
      view.contacts.trails.length > 0 ? tick("contact trail", true, (on) => view.contacts.setVisible(on)) : null,
      tick("axes of the bodies", false, (on) => view.setTriads(on)))));
}

function start() {
  const data = readJson("genu-data"), times = readJson("genu-times");
  const runs = data.runs.map((raw, i) => new Run(raw, times.runs[i]));
  const run = runs[0], player = new Player(run, runs.length > 1), view = new View(runs, player), plots = new Plots(runs, player), paths = pathPlots(runs, player);
  document.getElementById("head").append(...head(runs));
  const forces = plots.panels.find((p) => p.raw.title.startsWith("Contact force"));
  paths.forEach((p) => (forces ? forces.element.after(p.element) : plots.element.append(p.element)));
  document.getElementById("main").append(
    h("section.stage", { "aria-label": "The joint" }, view.element, player.element, pictureControls(view, run)),
    h("section.curves", { "aria-label": "Curves" }, plots.element),
    h("section.details", { "aria-label": "Details" }, details(runs, player)));
  document.getElementById("foot").append(...foot(run));
  const resize = () => { view.resize(); plots.resize(); paths.forEach((p) => p.resize()); player.drawStrip(); };
  addEventListener("keydown", (e) => { const menu = document.querySelector(".more[open]"); if (e.key === "Escape" && menu) menu.open = false; });
  let waiting = 0;
  new ResizeObserver(() => { cancelAnimationFrame(waiting); waiting = requestAnimationFrame(resize); }).observe(document.getElementById("main"));
  addEventListener("beforeprint", () => { document.body.classList.add("printing"); resize(); });
  addEventListener("afterprint", () => { document.body.classList.remove("printing"); resize(); });
  resize();
  player.set(player.row);
  plots.show(player.row);
  // For tests and for who wants to look closer.
  window.genu = { runs, player, view, plots, paths };
}

start();
