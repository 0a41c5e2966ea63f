"""A chart of lines as SVG, so that the scripts beside it need no other package. Use matplotlib for your own."""

_COLOURS = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b", "#17becf")
_WIDTH, _HEIGHT, _LEFT, _TOP = 640, 360, 60, 20


def _ticks(low, high):
    """Some five round numbers between two."""
    step = 10.0 ** len(str(int((high - low) / 5))) / 10 if high - low > 5 else 0.1
    while (high - low) / step > 8:
        step *= 2
    first = int(low // step) + (low > low // step * step)
    return [step * k for k in range(first, int(high // step) + 1)]


def line_chart(file, x, lines, x_title, y_title):
    """lines: {name: numbers}, as many as x."""
    values = [v for line in lines.values() for v in line]
    x_low, x_high = min(x), max(x)
    y_low, y_high = min(0.0, min(values)), max(values)
    right, bottom = _WIDTH - 165, _HEIGHT - 45

    def at(u, v):
        across = _LEFT + (right - _LEFT) * (u - x_low) / (x_high - x_low)
        return f"{across:.1f},{bottom - (bottom - _TOP) * (v - y_low) / (y_high - y_low):.1f}"

    def text(place, words, more=""):
        px, py = place.split(",")
        return f'<text x="{px}" y="{py}" {more}>{words}</text>'

    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}" font-family="sans-serif" font-size="12">']
    parts.append(f'<rect width="{_WIDTH}" height="{_HEIGHT}" fill="white"/>')
    for u in _ticks(x_low, x_high):
        parts.append(f'<polyline points="{at(u, y_low)} {at(u, y_high)}" stroke="#ddd"/>')
        parts.append(text(at(u, y_low), f"{u:g}", 'dy="16" text-anchor="middle"'))
    for v in _ticks(y_low, y_high):
        parts.append(f'<polyline points="{at(x_low, v)} {at(x_high, v)}" stroke="#ddd"/>')
        parts.append(text(at(x_low, v), f"{v:g}", 'dx="-6" dy="4" text-anchor="end"'))
    for k, (name, line) in enumerate(lines.items()):
        colour = _COLOURS[k % len(_COLOURS)]
        points = " ".join(at(u, v) for u, v in zip(x, line))
        parts.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="2"/>')
        parts.append(f'<text x="{right + 12}" y="{_TOP + 12 + 18 * k}" fill="{colour}">{name}</text>')
    parts.append(text(f"{(_LEFT + right) / 2},{_HEIGHT - 8}", x_title, 'text-anchor="middle"'))
    parts.append(f'<text transform="translate(14,{(_TOP + bottom) / 2}) rotate(-90)" text-anchor="middle">{y_title}</text>')
    with open(file, "w", encoding="utf-8") as out:
        out.write("\n".join(parts + ["</svg>"]) + "\n")
