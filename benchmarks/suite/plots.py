# SPDX-License-Identifier: AGPL-3.0-or-later
"""Plots by gnuplot, which is left out where it is not installed."""
import shutil
import subprocess

# Distinguishable also without colours, by their point types.
COLOURS = ("#d62728", "#1f77b4", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b", "#17becf", "#7f7f7f",
           "#bcbd22", "#e377c2")
POINTS = (7, 5, 9, 11, 13, 6, 4, 8, 10, 12)


def _quote(text):
    return '"' + text.replace("_", " ").replace('"', "'") + '"'


def _run(script, path):
    if shutil.which("gnuplot"):
        subprocess.run(["gnuplot"], input=script, text=True, check=True)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(line.rstrip() for line in text.splitlines()) + "\n")


def _head(path, title, x, y, height=560):
    return (f"set terminal svg size 860,{height} font 'sans,13' background '#ffffff'\n"
            f"set output '{path}'\nset encoding utf8\n"
            f"set title {_quote(title)}\nset xlabel {_quote(x)}\nset ylabel {_quote(y)}\n"
            "set grid\nset key outside right top\n")


def _styles(names):
    """Per curve: colour and points by what comes before the last comma, dashes for P1, Tetradapt thick."""
    kinds = list(dict.fromkeys(name.rpartition(", P")[0] or name for name in names))
    styles = []
    for name in names:
        number = kinds.index(name.rpartition(", P")[0] or name)
        width = 3 if name.startswith("Tetradapt") else 1.5
        dash = "dt 2 " if name.endswith(", P1") else ""
        styles.append(f"lw {width} {dash}pt {POINTS[number % len(POINTS)]} ps 0.8 "
                      f"lc rgb '{COLOURS[number % len(COLOURS)]}'")
    return styles


def _range(values):
    return f"[{min(values) / 1.3:g}:{max(values) * 1.3:g}]"


def lines(path, series, title, x, y):
    """Logarithmic axes. series: {name: [(x, y), ...]}, drawn and listed in this order."""
    series = {name: sorted(points) for name, points in series.items() if points}
    if not series:
        return
    points = [point for curve in series.values() for point in curve]
    script = _head(path, title, x, y) + "set logscale xy\n"
    script += f"set xrange {_range([p[0] for p in points])}\n"
    script += f"set yrange {_range([p[1] for p in points])}\n"
    for number, curve in enumerate(series.values()):
        data = "\n".join("%g %g" % point for point in curve)
        script += f"$d{number} << EOD\n{data}\nEOD\n"
    script += "plot " + ", \\\n".join(
        f"$d{number} with linespoints {style} title {_quote(name)}"
        for number, (name, style) in enumerate(zip(series, _styles(list(series)))))
    _run(script + "\n", path)


def bars(path, rows, title, y, stacked=True):
    """rows: {label: {part: value}}: one bar a label, stacked or side by side."""
    parts = list(dict.fromkeys(part for row in rows.values() for part in row))
    data = "\n".join(_quote(label) + " " + " ".join("%g" % row.get(p, 0.) for p in parts)
                     for label, row in rows.items())
    script = _head(path, title, "", y) + f"$d << EOD\n{data}\nEOD\n"
    script += ("set style data histograms\nset style histogram "
               + ("rowstacked" if stacked else "clustered gap 1")
               + "\nset style fill solid 0.8 border -1\nset boxwidth 0.7\nset yrange [0:*]\n"
               "set xtics rotate by -30\n")
    script += "plot " + ", ".join(
        f"$d using {n + 2}:xtic(1) lc rgb '{COLOURS[n % len(COLOURS)]}' title {_quote(part)}"
        for n, part in enumerate(parts)) + "\n"
    _run(script, path)
