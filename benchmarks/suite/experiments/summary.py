# SPDX-License-Identifier: AGPL-3.0-or-later
"""What was wanted, and what was measured."""
from suite import levels
from suite.bodies import BODIES

# The two indicators that a user is told to take; the best of all would be found only afterwards.
OURS = ("Tetradapt spr", "Tetradapt residual", "Tetradapt uniform")


def run(session):
    rows = [*solve_bars(session), *size_bars(session), *error_bars(session), *stage_bars(session),
            *rank_bars(session)]
    session.write("summary", [
        {"what": what, "measured": measured, "wanted": wanted, "met": met} for
        what, measured, wanted, met in rows])
    for what, measured, wanted, met in rows:
        session.say(f"  {what}: {measured} (wanted: {wanted}) {met.upper() if met == 'no' else ''}")


def bar(what, value, wanted, at_least, mark="", counts=True):
    """One row. counts: whether the sizes are those that the bar is about; not in quick sessions."""
    met = value >= wanted if at_least else value <= wanted
    sign = "at least" if at_least else "at most"
    return what, f"{mark}{value:.3g}", f"{sign} {wanted:g}", ("yes" if met else "no") if counts else "-"


def solve_bars(session):
    rows = session.read("solve")
    if not rows:
        return
    ours = next(r for r in rows if r["program"] == "Tetradapt")
    dofs, full = ours["dofs"], int(ours["dofs"]) > 150000
    if ours.get("products_solve"):
        yield bar(f"P2, {dofs} unknowns: set-up and solve, in products with the assembled matrix",
                  float(ours["products_solve"]), 60, False, counts=full)
    for family, wanted in (("CalculiX", 10), ("FEniCSx", 4)):
        best = [float(r["cpu_over_tetradapt"]) for r in rows if r["program"].startswith(family)]
        if best:
            yield bar(f"P2, {dofs} unknowns: CPU of {family}'s best solver over Tetradapt's",
                      min(best), wanted, True, counts=full)
    memory = {r["program"]: float(r["memory_over_tetradapt"]) for r in rows if r is not ours}
    if memory:
        least = min(memory, key=memory.get)
        yield bar(f"P2, {dofs} unknowns: least memory of the others ({least}) over Tetradapt's",
                  memory[least], 1, True, counts=full)


def size_bars(session):
    rows = [r for r in session.read("size") if r["degree"] == "2"]
    for key, what, wanted in (("iterations", "iterations", 1.2),
                              ("solve_microseconds_per_dof", "solve seconds per unknown", 1.3)):
        values = [float(r[key]) for r in rows]
        if len(values) > 1:
            # So that the least is as far below it as the most is above.
            middle = (max(values) + min(values)) / 2
            yield bar(f"P2, {rows[0]['dofs']} to {rows[-1]['dofs']} unknowns: most {what} over their "
                      "middle", max(values) / middle, wanted, False)


def error_bars(session):
    for body in BODIES:
        rows = session.read(f"error_{body}")
        curves = {}
        for row in rows:
            curves.setdefault(levels.curve(row), []).append(row)
        others = {name: points for name, points in curves.items() if not name.startswith("Tetradapt")}
        if not others:
            continue
        # A little more, for the digits that the programs print.
        least = 1.001 * min(float(p["error"]) for points in others.values() for p in points)
        for level, wanted in ((least, 4), (0.02, 4), (0.01, 50)):
            found = {name: levels.seconds(points, level) for name, points in curves.items()}
            found = {name: text for name, text in found.items() if text}
            ours = fastest(found, lambda name: name.startswith(OURS))
            best = fastest(found, lambda name: name in others)
            if ours and best:
                mark = "~" if found[best][0] == "~" else ""
                seconds = levels.number(found[ours]), levels.number(found[best])
                yield bar(f"{body}, error {100 * level:.3g} %: seconds of the fastest other ({best}, "
                          f"{mark}{seconds[1]:.3g}) over Tetradapt's ({ours[10:]}, {seconds[0]:.3g})",
                          seconds[1] / seconds[0], wanted, True, mark=mark)


def fastest(found, chosen):
    names = [name for name in found if chosen(name)]
    return min(names, key=lambda name: levels.number(found[name])) if names else None


def stage_bars(session):
    rows = session.read("stages")
    if rows:
        most = max(rows, key=lambda r: float(r["all_but_solve_percent_of_run"]))
        yield bar(f"adaptive runs: all stages but the solve, % of the run ({most['body']} "
                  f"{most['case'].split(' ', 1)[1]}; without start-up {most['percent_of_stages']} %)",
                  float(most["all_but_solve_percent_of_run"]), 50, False)


def rank_bars(session):
    rows = session.read("ranks")
    if len(rows) == 2:
        yield bar(f"2 ranks, {rows[1]['dofs']} unknowns: solve stage faster by",
                  float(rows[1]["solve_wall_faster"]), 1.7, True, counts=int(rows[1]["dofs"]) > 900000)
