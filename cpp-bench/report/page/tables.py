# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables 1 and 2: the report's figures, its algorithms on CGAL here, deldrift."""

from engines import LONG_NAMES, TABLE_CGAL, TABLE_DELDRIFT
from plot import short
from published import INPUT_TITLES, INPUTS, TABLE_1, TABLE_2
from words import listed, span


def table(results, which):
    """What page.html shows of the whole inputs (`which` 0) or of their second halves (1)."""
    then, now = sentences(results, which)
    published = (TABLE_1, TABLE_2)[which]

    def measured(engine, algorithms):
        return [
            (LONG_NAMES[a], [measurement(results, s, engine, a, which) for s in INPUTS]) for a in algorithms
        ]

    return {
        "part": ("all iterations", "the second half of the iterations")[which],
        "iterations": ("from the first to the last", "from the middle to the last")[which],
        "then": then,
        "now": now,
        "inputs": [(INPUT_TITLES[s], results.size(s), results.range(s, which)) for s in INPUTS],
        "groups": [
            (
                "Report, 2008 (Pentium 4, CGAL 3.3.1)",
                [(LONG_NAMES[a], [(v, "†" if v is None else "") for v in published[a]]) for a in published],
            ),
            ("Here: CGAL, and the report's algorithms on CGAL", measured("cgal", TABLE_CGAL)),
            ("Here: deldrift", measured("deldrift", TABLE_DELDRIFT)),
            (
                "Here: deldrift's step over CGAL's (the update, both arrays of the cells read, the changes taken)",
                [(LONG_NAMES["auto"], [(results.step_speedup(s, which), "") for s in INPUTS])],
            ),
        ],
    }


def measurement(results, scenario, engine, algorithm, which):
    """A speed-up and its note."""
    row = results.row(scenario, engine, algorithm, which)
    whole = results.row(scenario, "cgal", "rebuilding", which)
    is_sample = row and whole and row["timestamps"] != whole["timestamps"]
    return results.speedup(scenario, engine, algorithm, which), "*" if is_sample else ""


def sentences(results, which):
    """What the report saw and what is seen here."""
    plane, space = INPUTS[:4], INPUTS[4:]

    def speedups(engine, algorithm, scenarios):
        return [results.speedup(s, engine, algorithm, which) for s in scenarios]

    published = (TABLE_1, TABLE_2)[which]
    then = (
        f"T was {span(published['tolerance'][:4])} times as fast as rebuilding in the plane and "
        f"{span(published['tolerance'][4:])} times in space; placement was slower than rebuilding everywhere."
    )
    now = (
        f"The same T on CGAL is {span(speedups('cgal', 'tolerance', plane))} times as fast in the plane and"
        f" {span(speedups('cgal', 'tolerance', space))} times in space; deldrift's T is"
        f" {span(speedups('deldrift', 'tolerance', plane))} and"
        f" {span(speedups('deldrift', 'tolerance', space))} times as fast, its default (auto)"
        f" {span(speedups('deldrift', 'auto', plane))} and {span(speedups('deldrift', 'auto', space))} times."
    )
    now += " " + placement_sentence(results, which) + " " + ordering_sentence(results, which)
    now += " " + comparison_sentence(results, which) + rest_sentence(results, which)
    return then, now


def placement_sentence(results, which):
    faster = [INPUT_TITLES[s] for s in INPUTS if (results.speedup(s, "cgal", "placement", which) or 0) > 1]
    if not faster:
        return "CGAL's placement is slower than rebuilding everywhere, as in the report."
    return (
        f"CGAL's placement is faster than its rebuilding on {listed(faster)}, unlike in the report: CGAL"
        " 3.3.1 had not yet the removal in the plane by cases of low degree (INRIA report RR-7104, 2009)."
    )


def ordering_sentence(results, which):
    if which == 1:
        return ""
    good, bad = [], []
    for scenario in INPUTS[:4]:
        t, st, s = (
            results.speedup(scenario, "cgal", a, 0)
            for a in ("tolerance", "safe_region_tolerance", "safe_region")
        )
        if None in (t, st, s):
            continue
        (good if t > st > s else bad).append(INPUT_TITLES[scenario])
    text = f"The report's order T > S+T > S holds for {listed(good) or 'no input'} in the plane."
    if bad:
        text += (
            f" It does not for {listed(bad)}: there the cost of delimiters at every placement outweighs what"
            " a second test saves."
        )
    return text


def comparison_sentence(results, which):
    slower = []
    for scenario in INPUTS:
        ours, theirs = (results.row(scenario, engine, "tolerance", which) for engine in ("deldrift", "cgal"))
        if ours and theirs and float(ours["seconds"]) > float(theirs["seconds"]):
            slower.append(
                f"{INPUT_TITLES[scenario]} ({float(theirs['seconds']) / float(ours['seconds']):.2f} times)"
            )
    if not slower:
        return "deldrift's T is at least as fast as the report's T on CGAL on every input measured."
    return f"deldrift's T is slower than the report's T on CGAL on {listed(slower)}."


def rest_sentence(results, which):
    """How far points still move, on which the speed-ups of T hang."""
    if which == 0:
        return ""
    moves = []
    for scenario in INPUTS:
        middle = results.range(scenario, 1)
        series = results.statistic(scenario, "mean_displacement")
        if middle and series:
            at, length = min(series, key=lambda p: abs(p[0] - middle[0]))
            moves.append(f"{INPUT_TITLES[scenario]} {short(float(f'{length:.1e}'))}")
    return (
        " The report's recorded positions are not published, and how fast points come to rest decides what T gains: "
        f"here they move, per iteration in the middle of the run and in spacings, {listed(moves)}."
    )
