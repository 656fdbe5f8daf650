# SPDX-License-Identifier: AGPL-3.0-or-later
"""results.md: all tables of a session in one text, and the copy for the documentation."""
import datetime
import os
import shutil

PLOTS = {"error": ("error_cantilever.svg", "error_l_shape.svg", "indicators_cantilever.svg",
                   "indicators_l_shape.svg"), "solve": ("solve.svg",),
         "size": ("size.svg", "memory.svg"), "stages": ("stages.svg",)}
TABLES = {"summary": ("summary",), "agreement": ("agreement",), "solve": ("solve",), "size": ("size",),
          "error": ("levels_cantilever", "levels_l_shape"), "ranks": ("ranks",),
          "stages": ("stages",), "startup": ("startup",), "skipping": ("skipping",)}
# Columns that only the CSV files show.
HIDDEN = {"runs", "cpu_seconds_least", "cpu_seconds_most", "memory_over_tetradapt", "products_whole"}


def markdown(rows):
    """A table without the columns that say nothing in it."""
    columns = [c for c in rows[0] if c not in HIDDEN and any(r[c] for r in rows)]
    columns = [c for c in columns if c not in ("body", "degree") or len({r[c] for r in rows}) > 1]
    text = "| " + " | ".join(c.replace("_", " ") for c in columns) + " |\n"
    text += "|" + "---|" * len(columns) + "\n"
    return text + "".join("| " + " | ".join(r[c] for c in columns) + " |\n" for r in rows)


def write_results(session, experiments):
    """results.md from the tables that there are, those of earlier calls included."""
    today = datetime.date.today().isoformat()
    text = (f"# Results of benchmarks/run{' --quick' if session.quick else ''}, {today}\n\n"
            f"{session.machine()}\n\n"
            "CPU seconds are user and system time of the whole process, median of the runs, one thread,\n"
            "programs in turns; `~`: extrapolated. ../benchmarks.md says what is measured and how.\n")
    for name in ("summary", *(n for n in experiments if n != "summary")):
        tables = [session.read(table) for table in TABLES[name]]
        if not any(tables):
            continue
        first = experiments[name].__doc__.strip().splitlines()[0]
        text += f"\n## {first.rstrip('.')}\n"
        for table, rows in zip(TABLES[name], tables):
            if rows:
                title = f"\n{table.replace('_', ' ')}\n" if len(tables) > 1 else ""
                text += f"{title}\n{markdown(rows)}"
        for plot in PLOTS.get(name, ()):
            if os.path.exists(session.path(plot)):
                text += f"\n![{plot[:-4].replace('_', ' ')}]({plot})\n"
    with open(session.path("results.md"), "w", encoding="utf-8") as file:
        file.write(text)


def publish(session, folder):
    """Tables and plots to the documentation."""
    os.makedirs(folder, exist_ok=True)
    for name in sorted(os.listdir(session.output)):
        if name.endswith((".csv", ".svg", ".md")):
            shutil.copyfile(session.path(name), os.path.join(folder, name))
