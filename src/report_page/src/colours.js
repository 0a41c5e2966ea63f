// Colours that people with any colour vision can tell apart, on paper too. Those of the page's parts are in page.css.

const kTension = ["#fdd38a", "#fca55d", "#f46d43", "#d32f27", "#8e0b26", "#4f0618"];
const kCompression = ["#a9cfe6", "#6aaed6", "#3787c0", "#105ba4", "#08306b"];
const kPath = ["#00204d", "#31446b", "#666970", "#958f78", "#cbba69", "#ffe945"];  // cividis
const kPathOnDark = ["#5f8fd8", "#7d95bd", "#9a9da2", "#b5ae8c", "#d6c66e", "#ffe945"];  // its start would be lost there
/** Viridis: perceptually even, also for colour-blind readers. */
const kPressure = ["#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21908d", "#22a884", "#43bf71", "#7ad151", "#bddf26", "#fde725"];
/** Gaps, nearest first: the darkest end for contact. */
const kGap = ["#0b2a6b", "#1f5fa8", "#4a90c9", "#86b9dd", "#bcd8ea", "#e6eff5"];
export const kSlack = "#8d99a6";
export const kUnknown = "#56606b";

const parts = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

/** A colour of a scale at t in [0, 1], [r, g, b] of 255. */
function along(scale, t) {
  const place = Math.min(Math.max(t, 0), 1) * (scale.length - 1);
  const k = Math.min(Math.floor(place), scale.length - 2);
  const a = parts(scale[k]), b = parts(scale[k + 1]);
  return a.map((v, i) => Math.round(v + (place - k) * (b[i] - v)));
}

const css = (rgb) => `rgb(${rgb.join(",")})`;
const bar = (scale) => `linear-gradient(to right, ${scale.join(",")})`;
export const pathColour = (t, dark = false) => css(along(dark ? kPathOnDark : kPath, t));
/** [r, g, b] of 255 at a share of the largest pressure, and of the largest gap that is coloured. */
export const pressureRgb = (t) => along(kPressure, t);
export const pressureColour = (t) => css(along(kPressure, t));
export const gapRgb = (t) => along(kGap, t);

/** The colour of a ligament: slack (no force), stretched from 0 to `most`, or compressed to -`most` (strains). */
export function strainColour(strain, force, most) {
  if (Number.isFinite(force) && force === 0) return kSlack;
  if (!Number.isFinite(strain)) return kUnknown;
  if (strain < 0 && force < 0) return css(along(kCompression, -strain / most));
  return css(along(kTension, strain / most));
}

export const gradient = (compression) => bar([...(compression ? [...kCompression].reverse() : []), ...kTension]);
export const pathGradient = (dark = false) => bar(dark ? kPathOnDark : kPath);
export const pressureGradient = () => bar(kPressure);
export const gapGradient = () => bar(kGap);

/** Of results that are compared: the dash of their lines, and the colour of what the picture shows of them. */
export const kRuns = [[], [7, 4], [2, 3], [10, 3, 2, 3], [4, 4], [1, 2], [12, 5], [6, 2, 1, 2]];
export const kGhosts = ["#7d6aa8", "#c2527a", "#3f9c6f", "#a48d2e", "#3f7fae", "#b0682f", "#808080"];

/** Of bodies, the first for one that does not move. */
export const kBodies = ["#e3d5b8", "#b9cad6", "#cdbcd0", "#b9cfb4", "#d8c0b4", "#c4c4c4"];
