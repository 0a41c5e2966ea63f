// Colours that people with any colour vision can tell apart, on paper too.

/** Of lines: Okabe and Ito 2008, without their yellow, which white paper swallows; each with a dash of its own. */
export const kLines = [
  { colour: "#0072b2", dash: [] }, { colour: "#d55e00", dash: [] }, { colour: "#009e73", dash: [] },
  { colour: "#111111", dash: [] }, { colour: "#cc79a7", dash: [7, 3] }, { colour: "#e69f00", dash: [7, 3] },
  { colour: "#56b4e9", dash: [7, 3] }, { colour: "#6b6b6b", dash: [2, 3] },
];

const kTension = ["#fdd38a", "#fca55d", "#f46d43", "#d32f27", "#8e0b26", "#4f0618"];
const kCompression = ["#a9cfe6", "#6aaed6", "#3787c0", "#105ba4", "#08306b"];
const kPath = ["#00204d", "#31446b", "#666970", "#958f78", "#cbba69", "#ffe945"];  // cividis
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
export const pathColour = (t) => css(along(kPath, t));

/** The colour of a ligament: slack (no force), stretched from 0 to `most`, or compressed to -`most` (strains). */
export function strainColour(strain, force, most) {
  if (Number.isFinite(force) && force === 0) return kSlack;
  if (!Number.isFinite(strain)) return kUnknown;
  if (strain < 0 && force < 0) return css(along(kCompression, -strain / most));
  return css(along(kTension, strain / most));
}

export const gradient = (compression) =>
  `linear-gradient(to right, ${[...(compression ? [...kCompression].reverse() : []), ...kTension].join(",")})`;
export const pathGradient = () => `linear-gradient(to right, ${kPath.join(",")})`;

/** Of results that are compared: the dash of their lines, and the colour of their ghosts. */
export const kRuns = [[], [7, 4], [2, 3], [10, 3, 2, 3], [4, 4], [1, 2], [12, 5], [6, 2, 1, 2]];
export const kGhosts = ["#7d6aa8", "#a8486a", "#4d8a6f", "#8a7a3a", "#3f7fae", "#9a5f2f", "#6b6b6b"];

/** Of bodies, the first for one that does not move. */
export const kBodies = ["#e3d5b8", "#b9cad6", "#cdbcd0", "#b9cfb4", "#d8c0b4", "#c4c4c4"];
