// What is hidden, by name: bodies, bundles of ligaments and contacts. The picture, the plots and the menu all ask here, so that
// what is hidden in one is hidden in all.
export class Shown {
  constructor(run) {
    this.run = run;
    this.hidden = new Set();
    this.opacity = new Map();
    this.listeners = [];
    this.bundles = new Set(run.bundles().map(([name]) => name));
  }

  onChange(listener) { this.listeners.push(listener); }
  has(key) { return key.startsWith("pair ") ? this.hasPair(key.slice(5)) : !this.hidden.has(key); }
  alpha(key) { return this.hidden.has(key) ? 0 : this.opacity.get(key) ?? 1; }

  set(key, shown) {
    const keys = key.startsWith("pair ") ? this.ofPair(key.slice(5)).map((c) => `contact ${c.name}`) : [key];
    for (const k of keys) shown ? this.hidden.delete(k) : this.hidden.add(k);
    this.tell();
  }

  fade(key, opacity) {
    this.opacity.set(key, opacity);
    opacity > 0 ? this.hidden.delete(key) : this.hidden.add(key);
    this.tell();
  }

  all() {
    this.hidden.clear();
    this.tell();
  }

  /** A pair is hidden with all its regions or points. */
  ofPair(name) { return this.run.contacts.filter((c) => c.name === name || c.name.startsWith(`${name}.`)); }

  hasPair(name) {
    const own = this.ofPair(name);
    return own.length === 0 || own.some((c) => this.has(`contact ${c.name}`));
  }

  tell() { for (const listener of this.listeners) listener(); }

  /** How solid a pair is drawn: as its most solid region. */
  alphaPair(name) {
    const own = this.ofPair(name);
    return own.length === 0 ? 1 : Math.max(...own.map((c) => this.alpha(`contact ${c.name}`)));
  }

  /** What a curve stands for: "ligament ACL", "contact medial"; null where nothing in the picture. */
  keyOf(panel, series) {
    if (/^Ligament/.test(panel) && this.bundles.has(series)) return `ligament ${series}`;
    if (!/^Contact|pressure/i.test(panel)) return null;
    const contact = this.run.contacts.find((c) => c.name === series || c.name.endsWith(`.${series}`));
    if (contact) return `contact ${contact.name}`;
    const stem = series === "whole pair" ? this.run.contacts[0]?.name.split(".")[0] : series;
    return stem && this.ofPair(stem).length > 0 ? `pair ${stem}` : null;
  }
}
