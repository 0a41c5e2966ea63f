// The page: verdict, picture, curves, details. Runs after the first are drawn as ghosts and thin lines.
import { h } from "./dom.js";
import { readJson, Run } from "./data.js";
import { Axis } from "./axis.js";
import { Shown } from "./shown.js";
import { Player } from "./player.js";
import { View } from "./view.js";
import { Plots } from "./plots.js";
import { plans } from "./plan.js";
import { controls } from "./controls.js";
import { head, details, foot } from "./words.js";

function start() {
  const data = readJson("genu-data"), times = readJson("genu-times");
  const runs = data.runs.map((raw, i) => new Run(raw, times.runs[i]));
  const run = runs[0], axis = new Axis(runs), shown = new Shown(run), player = new Player(run, axis, runs.length > 1);
  const view = new View(runs, player, axis, shown), plots = new Plots(runs, player, axis, shown), paths = plans(runs, player, axis, shown);
  document.getElementById("head").append(...head(runs, axis));
  const first = paths.filter((p) => p.maps.length > 0), rest = paths.filter((p) => p.maps.length === 0);
  const forces = plots.panels.find((p) => p.raw.title.startsWith("Contact force"));
  plots.element.prepend(...first.map((p) => p.element));
  forces ? forces.element.after(...rest.map((p) => p.element)) : plots.element.append(...rest.map((p) => p.element));
  const [menus, views] = controls(view, run, shown, plots, player);
  player.below.append(menus);
  document.getElementById("main").append(
    h("section.stage", { "aria-label": "The joint" }, view.element, player.element, views),
    h("section.curves", { "aria-label": "Curves" }, plots.bar, plots.element),
    h("section.details", { "aria-label": "Details" }, details(runs, player, axis)));
  document.getElementById("foot").append(...foot(run));
  const resize = () => { view.resize(); plots.resize(); paths.forEach((p) => p.resize()); player.drawStrip(); };
  document.addEventListener("keydown", (e) => { const menu = document.querySelector(".more[open]"); if (e.key === "Escape" && menu) menu.open = false; });
  document.addEventListener("pointerdown", (e) => document.querySelectorAll(".more[open]").forEach((m) => { if (!m.contains(e.target)) m.open = false; }));
  let waiting = 0;
  new ResizeObserver(() => { cancelAnimationFrame(waiting); waiting = requestAnimationFrame(resize); }).observe(document.getElementById("main"));
  addEventListener("beforeprint", () => { document.documentElement.classList.add("printing"); view.recolour(); resize(); });
  addEventListener("afterprint", () => { document.documentElement.classList.remove("printing"); view.recolour(); resize(); });
  resize();
  player.set(player.row);
  plots.show(player.row);
  // For tests and for who wants to look closer.
  window.genu = { runs, player, view, plots, paths, axis, shown };
}

start();
