// Two pens that draw the same: on a canvas, and as text of an SVG file. Points are [x, y] in pixels.

export class CanvasPen {
  constructor(context) { this.g = context; }

  within(x, y, width, height, draw) {
    const { g } = this;
    g.save();
    g.beginPath();
    g.rect(x, y, width, height);
    g.clip();
    draw();
    g.restore();
  }

  line(points, { colour, width = 1, dash = [], opacity = 1 }) {
    const { g } = this;
    g.globalAlpha = opacity; g.strokeStyle = colour; g.lineWidth = width; g.setLineDash(dash); g.lineJoin = "round";
    g.beginPath();
    points.forEach(([x, y], i) => (i ? g.lineTo(x, y) : g.moveTo(x, y)));
    g.stroke();
    g.setLineDash([]);
    g.globalAlpha = 1;
  }

  area(points, { colour, opacity = 1 }) {
    const { g } = this;
    g.globalAlpha = opacity; g.fillStyle = colour;
    g.beginPath();
    points.forEach(([x, y], i) => (i ? g.lineTo(x, y) : g.moveTo(x, y)));
    g.closePath();
    g.fill();
    g.globalAlpha = 1;
  }

  dot([x, y], radius, { colour, open = false, width = 1.5 }) {
    const { g } = this;
    g.beginPath();
    g.arc(x, y, radius, 0, 2 * Math.PI);
    if (open) { g.strokeStyle = colour; g.lineWidth = width; g.stroke(); } else { g.fillStyle = colour; g.fill(); }
  }

  text(text, [x, y], { colour, align = "center", base = "middle", size = 12, bold = false, turn = 0 }) {
    const { g } = this;
    g.save();
    g.translate(x, y);
    g.rotate(turn);
    g.fillStyle = colour; g.textAlign = align; g.textBaseline = base;
    g.font = `${bold ? "600 " : ""}${size}px system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif`;
    g.fillText(text, 0, 0);
    g.restore();
  }
}

const escaped = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;").replace(/"/g, "&quot;");
const two = (v) => String(Math.round(100 * v) / 100);

export class SvgPen {
  constructor() { this.parts = []; this.clips = 0; }

  way(points) { return points.map(([x, y], i) => `${i ? "L" : "M"}${two(x)} ${two(y)}`).join(""); }

  within(x, y, width, height, draw) {
    const id = `c${this.clips++}`;
    this.parts.push(`<clipPath id="${id}"><rect x="${two(x)}" y="${two(y)}" width="${two(width)}" height="${two(height)}"/></clipPath><g clip-path="url(#${id})">`);
    draw();
    this.parts.push("</g>");
  }

  line(points, { colour, width = 1, dash = [], opacity = 1 }) {
    this.parts.push(`<path d="${this.way(points)}" fill="none" stroke="${colour}" stroke-width="${width}"${opacity < 1 ? ` stroke-opacity="${opacity}"` : ""}${dash.length ? ` stroke-dasharray="${dash.join(" ")}"` : ""}/>`);
  }

  area(points, { colour, opacity = 1 }) { this.parts.push(`<path d="${this.way(points)}Z" fill="${colour}" fill-opacity="${opacity}"/>`); }

  dot([x, y], radius, { colour, open = false, width = 1.5 }) {
    this.parts.push(`<circle cx="${two(x)}" cy="${two(y)}" r="${radius}" ${open ? `fill="none" stroke="${colour}" stroke-width="${width}"` : `fill="${colour}"`}/>`);
  }

  text(text, [x, y], { colour, align = "center", base = "middle", size = 12, bold = false, turn = 0 }) {
    const anchor = { center: "middle", left: "start", right: "end" }[align], down = base === "middle" ? 0.35 * size : base === "top" ? 0.8 * size : 0;
    this.parts.push(`<text transform="translate(${two(x)} ${two(y)}) rotate(${two((turn * 180) / Math.PI)})" y="${two(down)}" fill="${colour}" font-size="${size}"${bold ? ' font-weight="600"' : ""} text-anchor="${anchor}">${escaped(text)}</text>`);
  }

  /** The file. */
  file(width, height, ground) {
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, 'DejaVu Sans', sans-serif"><rect width="100%" height="100%" fill="${ground}"/>${this.parts.join("")}</svg>\n`;
  }
}
