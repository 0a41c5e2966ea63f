// node screenshot.mjs REPORT OUT.png [--size WxH] (1366x768) [--phone] [--at SHARE] [--whole] [--pdf] [--dark] [--scale N] [--run SCRIPT]: a picture of a report.html.
// node screenshot.mjs REPORT OUT --looks [--at SHARE]: OUT-laptop-light.png, OUT-laptop-dark.png, OUT-phone-light.png, OUT-phone-dark.png.
import { writeFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { Browser } from "./browser.mjs";

const { values: options, positionals: [report, out] } = parseArgs({ allowPositionals: true, options: {
  size: { type: "string", default: "1366x768" }, phone: { type: "boolean" }, at: { type: "string" }, whole: { type: "boolean" }, pdf: { type: "boolean" },
  scale: { type: "string" }, run: { type: "string" }, dark: { type: "boolean" }, looks: { type: "boolean" } } });
const start = options.at ? `genu.player.set(Math.round(${+options.at} * (genu.runs[0].rows - 1)))` : "0";
const complaints = [];
const [width, height] = options.phone ? [390, 844] : options.size.split("x").map(Number);
const browser = await Browser.start();

async function looks() {
  const sizes = { laptop: { width: 1366, height: 768 }, phone: { width: 390, height: 844, mobile: true, scale: 2 } };
  for (const [name, size] of Object.entries(sizes)) {
    const page = await browser.open(report, size);
    for (const look of ["light", "dark"]) {
      await page.dark(look === "dark");
      await page.evaluate(start);
      await page.settle();
      writeFileSync(`${out}-${name}-${look}.png`, await page.screenshot());
      console.log(`${out}-${name}-${look}.png`);
    }
    complaints.push(...page.complaints);
    await page.close();
  }
}

async function one() {
  const page = await browser.open(report, { width, height, mobile: !!options.phone, scale: +(options.scale ?? (options.phone ? 2 : 1)) });
  if (options.dark) await page.dark();
  await page.evaluate(start);
  if (options.run) await page.evaluate(options.run);
  await page.settle();
  writeFileSync(out, options.pdf ? await page.pdf() : await page.screenshot({ whole: options.whole }));
  complaints.push(...page.complaints);
}

try {
  await (options.looks ? looks() : one());
  for (const complaint of complaints) console.error(`the page complains: ${complaint}`);
  process.exitCode = complaints.length > 0 ? 1 : 0;
} finally {
  await browser.close();
}
