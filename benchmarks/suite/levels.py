# SPDX-License-Identifier: AGPL-3.0-or-later
"""Seconds to a given error, from runs that reached other errors."""
import math

LEVELS = (0.2, 0.1, 0.05, 0.02, 0.01)


def curve(row):
    """The name of the curve that a run belongs to."""
    kind = row["case"].rsplit(" ", 1)[0]
    name = row["program"] if row["program"] != "Tetradapt" else f"Tetradapt {kind}"
    return f"{name}, P{row['degree']}"


def seconds(rows, level):
    """CPU seconds to an error, as text: empty if not to be told, ~ before an extrapolated time.

    A refined run counts if it got there: the time is that of the cheapest such run, and nothing is
    interpolated, since its user named a tolerance and got that run. A uniform mesh could have had
    any fineness: the time is interpolated in logarithms between meshes, in favour of its program.
    Beyond the finest mesh the slope of the last two goes on, down to a third of the least error.
    """
    points = sorted((float(r["error"]), float(r["cpu_seconds"])) for r in rows)
    if not rows[0]["case"].startswith("uniform"):
        reached = [time for error, time in points if error <= level]
        return f"{min(reached):.3g}" if reached else ""
    points.reverse()
    if len(points) < 2:
        return ""
    if level >= points[0][0]:
        return f"{points[0][1]:.3g}"
    for (e0, t0), (e1, t1) in zip(points, points[1:]):
        if e1 <= level:
            break
    if level < e1 / 3 or e1 >= e0:
        return ""
    time = math.exp(math.log(t1) + math.log(t1 / t0) / math.log(e1 / e0) * math.log(level / e1))
    return ("~" if e1 > level else "") + f"{time:.3g}"


def number(text):
    """The seconds in such a text, or None."""
    return float(text.lstrip("~")) if text else None
