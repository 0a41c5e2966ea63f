// A headless Chromium, driven over its own protocol through two pipes: no other program and no port is needed.
//   const browser = await Browser.start();
//   const page = await browser.open("/path/report.html", { width: 1366, height: 768 });
//   await page.evaluate("document.title");
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { pathToFileURL } from "node:url";

/** The program, or null where there is none. */
export function findChromium() {
  const folders = (process.env.PATH ?? "").split(delimiter);
  for (const name of ["chromium", "chromium-browser", "google-chrome"])
    for (const folder of folders) if (folder && existsSync(join(folder, name))) return join(folder, name);
  return null;
}

const kFlags = [
  "--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions",
  "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--force-color-profile=srgb", "about:blank",
];

export class Browser {
  static async start() {
    const program = findChromium();
    if (!program) throw new Error("chromium is not installed");
    const browser = new Browser();
    browser.folder = mkdtempSync(join(tmpdir(), "genu-browser-"));
    browser.process = spawn(program, [`--user-data-dir=${browser.folder}`, ...kFlags], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    browser.process.on("exit", () => browser.fail(new Error("chromium ended")));
    browser.process.on("error", (e) => browser.fail(e));
    browser.process.stdio[3].on("error", () => {});
    browser.waiting = new Map();
    browser.listeners = [];
    browser.next = 1;
    let text = "";
    browser.process.stdio[4].setEncoding("utf8");
    browser.process.stdio[4].on("data", (chunk) => {
      const parts = (text + chunk).split("\0");
      text = parts.pop();
      for (const part of parts) browser.receive(JSON.parse(part));
    });
    await browser.send("Browser.getVersion");
    return browser;
  }

  fail(error) {
    for (const { reject } of this.waiting.values()) reject(error);
    this.waiting.clear();
  }

  receive(message) {
    const waiter = this.waiting.get(message.id);
    if (waiter) {
      this.waiting.delete(message.id);
      message.error ? waiter.reject(new Error(message.error.message)) : waiter.resolve(message.result);
    } else for (const listener of this.listeners) listener(message);
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { resolve, reject });
      this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    });
  }

  async open(file, size) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const page = new Page(this, sessionId, targetId);
    for (const domain of ["Page", "Runtime", "Log", "Network"]) await page.send(`${domain}.enable`);
    await page.resize(size);
    const url = pathToFileURL(file).href;
    page.address = url;
    const loaded = page.event("Page.loadEventFired");
    await page.send("Page.navigate", { url });
    await loaded;
    await page.settle();
    return page;
  }

  async close() {
    const ended = new Promise((resolve) => this.process.once("exit", resolve));
    this.send("Browser.close").catch(() => {});
    const slow = setTimeout(() => this.process.kill(), 3000);
    await ended;
    clearTimeout(slow);
    rmSync(this.folder, { recursive: true, force: true, maxRetries: 5 });
  }
}

export class Page {
  constructor(browser, sessionId, targetId) {
    Object.assign(this, { browser, sessionId, targetId, complaints: [], requests: [], expected: [] });
    browser.listeners.push((m) => { if (m.sessionId === sessionId) this.hear(m); });
  }

  hear({ method, params }) {
    if (method === "Runtime.exceptionThrown") this.complaints.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
    if (method === "Runtime.consoleAPICalled" && ["error", "warning", "assert"].includes(params.type)) this.complaints.push(params.args.map((a) => a.value ?? a.description).join(" "));
    if (method === "Log.entryAdded" && ["error", "warning"].includes(params.entry.level)) this.complaints.push(params.entry.text);
    if (method === "Network.requestWillBeSent") this.requests.push(params.request.url);
    this.expected = this.expected.filter((e) => e.method !== method || (e.resolve(params), false));
  }

  send(method, params) { return this.browser.send(method, params, this.sessionId); }
  event(method) { return new Promise((resolve) => this.expected.push({ method, resolve })); }
  close() { return this.browser.send("Target.closeTarget", { targetId: this.targetId }); }

  async resize({ width, height, mobile = false, scale = 1 }) {
    await this.send("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: scale, mobile });
    await this.send("Emulation.setTouchEmulationEnabled", { enabled: mobile });
  }

  /** As for a reader who prefers dark pages. */
  async dark(on = true) {
    await this.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: on ? "dark" : "light" }] });
    await this.settle();
  }

  /** Until two frames have been drawn. */
  settle() {
    return this.evaluate("new Promise((done) => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(() => done(true))), 60))");
  }

  async evaluate(expression) {
    const r = await this.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
    if (r.exceptionDetails) throw new Error(r.exceptionDetails.exception?.description ?? r.exceptionDetails.text);
    return r.result.value;
  }

  async key(key, { code = key, text = undefined, shift = false } = {}) {
    const codes = { ArrowLeft: 37, ArrowUp: 38, ArrowRight: 39, ArrowDown: 40, Home: 36, End: 35, " ": 32, Tab: 9, Enter: 13, PageUp: 33, PageDown: 34 };
    const common = { key, code, windowsVirtualKeyCode: codes[key] ?? key.charCodeAt(0), modifiers: shift ? 8 : 0 };
    await this.send("Input.dispatchKeyEvent", { type: "keyDown", text: text ?? (key.length === 1 ? key : undefined), ...common });
    await this.send("Input.dispatchKeyEvent", { type: "keyUp", ...common });
    await this.settle();
  }

  async press(x, y, to = null) {
    const mouse = (type, at, buttons) => this.send("Input.dispatchMouseEvent", { type, x: at[0], y: at[1], button: "left", buttons, clickCount: 1 });
    await mouse("mousePressed", [x, y], 1);
    if (to) await mouse("mouseMoved", to, 1);
    await mouse("mouseReleased", to ?? [x, y], 0);
    await this.settle();
  }

  /** PNG of what is in the window, or of the whole page. */
  async screenshot({ whole = false } = {}) {
    const { data } = await this.send("Page.captureScreenshot", { format: "png", captureBeyondViewport: whole,
      ...(whole ? { clip: { ...(await this.evaluate("({x: 0, y: 0, width: document.documentElement.clientWidth, height: document.documentElement.scrollHeight})")), scale: 1 } } : {}) });
    return Buffer.from(data, "base64");
  }

  async pdf() {
    const { data } = await this.send("Page.printToPDF", { printBackground: true });
    return Buffer.from(data, "base64");
  }
}
