// node screenshot.mjs REPORT OUT.png [--size WxH] (1366x768) [--phone] [--at SHARE] [--whole] [--pdf] [--dark] [--scale N] [--run SCRIPT]: a picture of a report.html.
import { writeFileSync } from "node:fs";
import { parseArgs } from "node:util";
import { Browser } from "./browser.mjs";

const { values: options, positionals: [report, out] } = parseArgs({ allowPositionals: true, options: {
  size: { type: "string", default: "1366x768" }, phone: { type: "boolean" }, at: { type: "string" }, whole: { type: "boolean" }, pdf: { type: "boolean" },
  scale: { type: "string" }, run: { type: "string" }, dark: { type: "boolean" } } });
const [width, height] = options.phone ? [390, 844] : options.size.split("x").map(Number);
const browser = await Browser.start();
try {
  const page = await browser.open(report, { width, height, mobile: !!options.phone, scale: +(options.scale ?? (options.phone ? 2 : 1)) });
  if (options.dark) await page.dark();
  if (options.at) await page.evaluate(`genu.player.set(Math.round(${+options.at} * (genu.runs[0].rows - 1)))`);
  if (options.run) await page.evaluate(options.run);
  await page.settle();
  writeFileSync(out, options.pdf ? await page.pdf() : await page.screenshot({ whole: options.whole }));
  for (const complaint of page.complaints) console.error(`the page complains: ${complaint}`);
  process.exitCode = page.complaints.length > 0 ? 1 : 0;
} finally {
  await browser.close();
}
