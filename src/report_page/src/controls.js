// Below the picture: where to look from, what to show, what to save.
import { kWrappedKey } from "./bodies.js";
import { h } from "./dom.js";
import { saveMenu } from "./save.js";

/** A tick and a slider for one thing that can be hidden. */
function item(shown, key, name, swatch = null) {
  const tick = h("input", { type: "checkbox", checked: shown.has(key), onchange: () => shown.set(key, tick.checked) });
  const slide = h("input", { type: "range", min: 0, max: 1, step: 0.05, value: shown.alpha(key), "aria-label": `How solid ${name} is drawn`, oninput: () => shown.fade(key, +slide.value) });
  shown.onChange(() => { tick.checked = shown.has(key); if (document.activeElement !== slide) slide.value = shown.alpha(key); });
  return h("div.item", {}, h("label.tick", {}, tick, swatch, name), slide);
}

function list(title, shown, keys) {
  if (keys.length === 0) return null;
  const several = keys.length > 1, set = (on) => () => keys.forEach(([key]) => shown.set(key, on));
  return h("fieldset", {}, h("legend", {}, title, several ? h("span.pair", {}, h("button.link", { type: "button", onclick: set(true) }, "all"), h("button.link", { type: "button", onclick: set(false) }, "none")) : null),
    keys.map(([key, name, swatch]) => item(shown, key, name, swatch ?? null)));
}

/** The buttons of the views, and the menus, which stand beside the line of the pose. */
export function controls(view, run, shown, plots, player) {
  if (!view.renderer) return [h("div.menus", {}, saveMenu(view, plots, player)), null];
  const buttons = view.views().map((v, i) => h("button", { type: "button", title: `${v.name} (key ${i})`, onclick: () => { view.moved = false; view.look(v); } }, v.name));
  const hold = h("select", { "aria-label": "Hold still", onchange: () => view.hold(+hold.value) }, h("option", { value: -1 }, "hold still: the world"),
    run.bodies.map((b, i) => (b.fixed ? null : h("option", { value: i }, `hold still: ${b.name}`))));
  const tick = (text, checked, set) => { const box = h("input", { type: "checkbox", checked, onchange: () => { set(box.checked); view.paint(); } }); return h("label.tick", {}, box, text); };
  const swatch = (colour) => h("i.blob", { "aria-hidden": "true", style: { background: colour } });
  const menu = h("div.menu.wide", {}, hold,
    list("Bodies", shown, [...run.bodies.map((b, i) => [`body ${b.name}`, b.name, swatch(view.bodies[0].colourOf(i))]),
      ...(view.bodies[0].wrapped.length > 0 ? [[kWrappedKey, "surfaces that paths wrap round"]] : [])]),
    list("Contacts", shown, run.contacts.map((c) => [`contact ${c.name}`, c.name])),
    list("Ligaments", shown, run.bundles().map(([name]) => [`ligament ${name}`, name])),
    h("fieldset", {}, h("legend", {}, "Marks"),
      view.contacts.trails.some((t) => t) ? tick("centre of pressure, its trail", true, (on) => view.contacts.setTrails(on)) : null,
      view.maps.any ? tick("pressure", true, (on) => { view.maps.setVisible(on); view.show(view.row); }) : null,
      view.gaps.possible ? tick("gap of rigid contacts", view.gaps.on, (on) => { view.gaps.set(on); view.show(view.row); }) : null,
      tick("axes of the bodies", false, (on) => view.setTriads(on))));
  return [h("div.menus", {}, h("details.more.show", {}, h("summary", {}, "Show"), menu), saveMenu(view, plots, player)),
    h("div.controls.buttons", { role: "group", "aria-label": "Views" }, buttons)];
}
