"""How scenes and results show themselves in a terminal and in a notebook."""
import html

import numpy

_MOST_ROWS = 12
_MOST_COLUMNS = 8


def to_dataframe(table):
    """The columns as a pandas.DataFrame. ImportError where pandas is not installed."""
    import pandas

    return pandas.DataFrame({name: table[name] for name in table.columns})


def _rows_shown(count):
    if count <= _MOST_ROWS:
        return list(range(count))
    return sorted({round(k * (count - 1) / (_MOST_ROWS - 1)) for k in range(_MOST_ROWS)})


def _columns_shown(table):
    """The joint's coordinates first, then what contacts carry, then the verdicts."""
    names = table.columns
    if "status" not in names:
        return names[:_MOST_COLUMNS]
    after = names[names.index("status") + 1 :]
    coordinates = [n for n in after if n.count(".") == 1 and n.endswith(("_deg", "_mm")) and "gap" not in n and "length" not in n]
    forces = [n for n in after if n.endswith(".force_N") and n[: -len(".force_N")] + ".gap_mm" in names]
    ends = [n for n in ("stability", "status") if n in names]
    return (coordinates + forces)[: _MOST_COLUMNS - len(ends)] + ends


def _cell(value):
    if isinstance(value, str):
        return value
    return "" if numpy.isnan(value) else f"{value:.4g}"


def _cells(table):
    columns = _columns_shown(table)
    values = [table[name] for name in columns]
    return columns, [[_cell(column[row]) for column in values] for row in _rows_shown(table.rows)]


def table_text(table):
    columns, rows = _cells(table)
    widths = [max([len(name)] + [len(row[k]) for row in rows]) for k, name in enumerate(columns)]
    lines = ["  ".join(word.rjust(width) for word, width in zip(row, widths)) for row in [columns] + rows]
    return "\n".join(lines + [f"{table.rows} rows, {len(table.columns)} columns"])


def table_html(table):
    columns, rows = _cells(table)
    head = "".join(f"<th>{html.escape(name)}</th>" for name in columns)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(word)}</td>" for word in row) + "</tr>" for row in rows)
    return (
        f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"
        f"<p>{table.rows} rows, {len(table.columns)} columns</p>"
    )


def _lines_of(results):
    lines = [f"{results.title}: {results.verdict}, {results.solved} of {results.asked} poses"]
    if results.changes:
        lines.append("changed: " + "; ".join(results.changes))
    return lines + list(results.sentences)


def results_text(results):
    return "\n".join(_lines_of(results)) + "\n" + table_text(results.table())


def results_html(results):
    said = "".join(f"<p>{html.escape(line)}</p>" for line in _lines_of(results))
    return f"<div>{said}{table_html(results.table())}</div>"


def _parts_of(scene):
    parts = ("bodies", "joints", "coordinates", "surfaces", "contacts", "ligaments", "loads")
    return [(part, getattr(scene, part)) for part in parts if getattr(scene, part)]


def scene_text(scene):
    lines = [scene.title] + [f"  {part:<12}{', '.join(names)}" for part, names in _parts_of(scene)]
    return "\n".join(lines + [f"  changed     {change}" for change in scene.changes])


def scene_html(scene):
    rows = [(part, ", ".join(names)) for part, names in _parts_of(scene)] + [("changed", c) for c in scene.changes]
    body = "".join(f"<tr><th>{part}</th><td>{html.escape(text)}</td></tr>" for part, text in rows)
    return f"<div><p><b>{html.escape(scene.title)}</b></p><table><tbody>{body}</tbody></table></div>"


def mesh_text(check):
    lines = [f"{check.triangles} triangles, {check.vertices} vertices, {check.unit}{' (guessed)' if check.guessed else ''}"]
    lines += [f"  {f.question:<24}{f.number:<34}{f.verdict:<5}{f.why}".rstrip() for f in check.findings]
    return "\n".join(lines)


def ranking(sensitivity, of=None):
    """The numbers by what a standard change of each does to a column, the most important first.

    of: a name of `sensitivity.of`; may be left out where there is one. Returns a list of (name, effect): the effect of
    largest size over all poses, signed, in the unit of the column. Numbers without any effect are left out.
    """
    if of is None:
        if len(sensitivity.of) != 1:
            raise ValueError(f"of must be one of {sensitivity.of}")
        of = sensitivity.of[0]
    if of not in sensitivity.of:
        raise ValueError(f"{of!r} is none of {sensitivity.of}")
    effects = numpy.nan_to_num(sensitivity.effects[:, sensitivity.of.index(of), :])
    if len(effects) == 0:
        return []
    rows = numpy.abs(effects).argmax(axis=0)
    largest = effects[rows, numpy.arange(effects.shape[1])]
    order = sorted(range(len(largest)), key=lambda k: -abs(largest[k]))
    return [(sensitivity.to[k], float(largest[k])) for k in order if largest[k] != 0]
