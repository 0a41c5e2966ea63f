// node build.mjs OUT: bundles the page's program and its libraries into OUT/page.html, with a placeholder for the title,
// the data and the times of a result. The same sources give the same bytes on every machine.
import { readFileSync, writeFileSync, mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(here, "bundle");
const read = (...path) => readFileSync(join(here, ...path), "utf8");

const { outputFiles } = await build({
  absWorkingDir: here,
  entryPoints: ["src/main.js"],
  bundle: true,
  minify: true,
  charset: "ascii",
  format: "iife",
  target: "es2020",
  legalComments: "none",
  write: false,
});
const script = outputFiles[0].text.trimEnd();
const css = await build({
  absWorkingDir: here,
  stdin: { contents: read("src/page.css"), loader: "css" },
  minify: true,
  charset: "ascii",
  write: false,
});
if (/<\/script|<!--/i.test(script)) throw new Error("the bundle holds text that ends or opens HTML");

const licence = (name) => {
  const { version } = JSON.parse(read("node_modules", name, "package.json"));
  return `${name} ${version}\n\n${read("node_modules", name, "LICENSE").trim()}`;
};
const notices = [
  "The program of this page is genu's (Apache-2.0, https://www.apache.org/licenses/LICENSE-2.0). It holds:",
  licence("three"),
].join("\n\n----\n\n");
const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
const fill = (text, name, value) => {
  const parts = text.split(`[[${name}]]`);
  if (parts.length !== 2) throw new Error(`src/page.html holds [[${name}]] ${parts.length - 1} times`);
  return parts.join(value);
};

let page = read("src/page.html");
page = fill(page, "style", css.outputFiles[0].text.trim());
page = fill(page, "notices", escaped(notices));
page = fill(page, "script", script);
for (const name of ["title", "more", "data", "times"])
  if (page.split(`{{genu-${name}}}`).length !== 2) throw new Error(`{{genu-${name}}} must stand in the page once`);
if (page.includes(')~genu~"')) throw new Error("the page holds what ends its literal in C++");
mkdirSync(out, { recursive: true });
writeFileSync(join(out, "page.html"), page);
