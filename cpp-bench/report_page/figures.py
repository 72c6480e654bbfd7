# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 3 to 10, each as (SVG, what the report saw, what is seen here)."""

from engines import CGAL, COLOURS, DELDRIFT, NAMES
from plot import Plot, figure, limits
from published import FIGURE_7, INPUT_TITLES, INPUTS
from words import count, crossing, listed, percent, span, times

PLANE, SPACE = INPUTS[:4], INPUTS[4:]
ITERATION_COLOURS = ["one", "two", "three", "four", "ink"]


def iterations(results, scenario):
    return [t for t in results.shown(scenario) if t > 0][:4]


def frame(x, y, size):
    return f'<rect class="frame" x="{x}" y="{y}" width="{size}" height="{size}"/>'


def figure_3(results):
    scenarios = [s for s in PLANE if iterations(results, s)]
    if not scenarios:
        return None
    rows = iterations(results, scenarios[0])
    size, left, top, gap = 240, 56, 28, 14
    width, height = left + 4 * (size + gap), top + len(rows) * (size + gap) + 34
    points = {}
    for r in results.points:
        points.setdefault((r["scenario"], int(r["timestamp"])), []).append((float(r["x"]), float(r["y"])))
    reach = max(abs(c) for p in points.values() for xy in p for c in xy) * 1.04
    tick = 15 if reach > 16 else max(1, int(0.8 * reach))
    parts = []
    for column, scenario in enumerate(scenarios):
        x = left + column * (size + gap)
        parts.append(f'<text class="panel-title" x="{x}" y="17">{INPUT_TITLES[scenario]}</text>')
        for row, timestamp in enumerate(iterations(results, scenario)):
            y = top + row * (size + gap)
            parts.append(frame(x, y, size))
            scale = size / 2 / reach
            dots = "".join(
                f"M{x + size / 2 + px * scale:.1f} {y + size / 2 - py * scale:.1f}h0"
                for px, py in points.get((scenario, timestamp), [])
            )
            parts.append(
                f'<path d="{dots}"'
                ' style="stroke:var(--ink);stroke-width:2.5;stroke-linecap:round;fill:none"/>'
            )
        bottom = top + len(rows) * (size + gap)
        for value in (-tick, 0, tick):
            at = x + size / 2 + value * size / 2 / reach
            parts.append(
                f'<text class="tick" x="{at:.1f}" y="{bottom + 4}" text-anchor="middle">{value}</text>'
            )
        parts.append(
            f'<text class="axis-label" x="{x + size / 2}" y="{bottom + 24}" text-anchor="middle">'
            "x, in spacings</text>"
        )
    for row, timestamp in enumerate(rows):
        middle = top + row * (size + gap) + size / 2
        parts.append(
            f'<text class="axis-label" transform="translate(14 {middle}) rotate(-90)" '
            f'text-anchor="middle">iteration {timestamp}: y, in spacings</text>'
        )
        for value in (-tick, 0, tick):
            at = middle - value * size / 2 / reach
            parts.append(
                f'<text class="tick" x="{left - 5}" y="{at + 3.6:.1f}" text-anchor="end">{value}</text>'
            )
    then = "1,000 points come to rest in an arrangement that follows the density."
    changes = [f"{INPUT_TITLES[s]}: {movement(results, s)}" for s in scenarios]
    now = (
        "Mean displacement of a point per iteration, at the first and towards the last: "
        + "; ".join(changes)
        + "."
    )
    return (
        figure(width, height, parts, "Points at several iterations of Lloyd's method, for four densities"),
        then,
        now,
    )


def movement(results, scenario):
    series = results.statistic(scenario, "mean_displacement")
    return f"{series[0][1]:.3g} and {series[-1][1]:.2g} spacings" if series else "not measured"


def averages(results, scenario, width, height, title, x_column="timestamp"):
    w = [p for p in results.statistic(scenario, "mean_width", x_column) if p[0] > 0]
    e = [p for p in results.statistic(scenario, "mean_tolerance", x_column) if p[0] > 0]
    if x_column == "timestamp":
        label, ticks = "iteration", [1, 10, 100, 1000]
    else:
        label, ticks = "mean displacement, in spacings", None
    w, e = sorted(w), sorted(e)
    xs = [p[0] for p in w]
    plot = Plot(
        width,
        height,
        limits(xs, True) if ticks is None else (min(xs), max(xs)),
        limits([p[1] for p in w]),
        label,
        "spacings",
        title,
        x_log=True,
        x_ticks=ticks,
        right=70,
    )
    plot.line(w, "tolerance", "avg(W)")
    plot.line(e, "safe", "avg(ε(V))")
    if x_column != "timestamp":
        mark_iterations(results, scenario, plot)
    return plot


def mark_iterations(results, scenario, plot):
    by_timestamp = {int(float(r["timestamp"])): r for r in results.statistics if r["scenario"] == scenario}
    for timestamp in (1, 10, 100):
        row = by_timestamp.get(timestamp)
        if row and row["mean_displacement"]:
            x, y = float(row["mean_displacement"]), float(row["mean_width"])
            plot.parts.append(
                f'<circle style="fill:var(--tolerance)" cx="{plot.x(x):.1f}" cy="{plot.y(y):.1f}" r="3"/>'
            )
            plot.annotate(x, y, f"it. {timestamp}", dx=0, dy=-8, anchor="middle")


def distributions(results, scenario, quantity, width, height, title, end):
    shown = iterations(results, scenario)
    bins = {t: results.distribution(scenario, t, quantity) for t in shown}
    label = "width of the annulus, in spacings" if quantity == "width" else "tolerance ε, in spacings"
    highest = sorted(share for b in bins.values() for _, _, share in b)[-1]
    plot = Plot(
        width,
        height,
        (0, end),
        (0, highest * 1.1),
        label,
        f"share per {bins[shown[0]][0][1]:.3g}",
        title,
        tick_text=lambda v: f"{100 * v:g} %",
    )
    for timestamp, colour in zip(shown, ITERATION_COLOURS):
        plot.steps([b for b in bins[timestamp] if b[1] <= end * 1.0001], colour)
    plot.key([(f"iteration {t}", c) for t, c in zip(shown, ITERATION_COLOURS)])
    return plot


def grid_of_tolerances(results, scenarios, x_column, description):
    width, height = 352, 214
    parts = []
    for row, scenario in enumerate(scenarios):
        plane = scenario in PLANE
        panels = [
            averages(results, scenario, width, height, INPUT_TITLES[scenario], x_column),
            distributions(results, scenario, "width", width, height, "W", 0.98),
            distributions(results, scenario, "tolerance", width, height, "ε(V)", 0.245 if plane else 0.048),
        ]
        parts += [panel.svg(column * (width + 6), row * (height + 12)) for column, panel in enumerate(panels)]
    return figure(3 * width + 12, len(scenarios) * (height + 12), parts, description)


def last(results, scenario, column):
    series = results.statistic(scenario, column)
    return series[-1][1] if series else None


def figure_4(results):
    scenarios = [s for s in PLANE if iterations(results, s)]
    if not scenarios:
        return None
    svg = grid_of_tolerances(
        results, scenarios, "timestamp", "Widths of bi-cells and tolerances of vertices in the plane"
    )
    w = [last(results, s, "mean_width") for s in scenarios]
    e = [last(results, s, "mean_tolerance") for s in scenarios]
    then = "avg(W) converged to 33–40 % and avg(ε(V)) to 5–10 % of the spacing (the average point density)."
    now = (
        f"At the last iteration, avg(W) is {span(w, percent)} and avg(ε(V))"
        f" {span(e, lambda v: percent(v, 1))} of it."
    )
    return svg, then, now


def figure_5(results):
    sections = {}
    for r in results.sections:
        sections.setdefault(int(r["timestamp"]), []).append(
            (float(r["radius_ratio"]), [float(c) for c in r["polygon"].split()])
        )
    if not sections:
        return None
    shown = sorted(sections)
    xs = [c for section in sections.values() for _, p in section for c in p[::2]]
    zs = [c for section in sections.values() for _, p in section for c in p[1::2]]
    low_x, high_x, low_z, high_z = min(xs), max(xs), min(zs), max(zs)
    gap, left, top = 18, 48, 28
    shown = shown[:1] + [t for t in shown if t >= 10][-3:]
    panel = (1070 - left - gap * (len(shown) - 1)) / len(shown)
    scale = min(panel / (high_x - low_x), 560 / (high_z - low_z))
    panel, tall = scale * (high_x - low_x), scale * (high_z - low_z)
    gap = min(60, (1070 - left - panel * len(shown)) / max(len(shown) - 1, 1))
    parts = []
    for column, timestamp in enumerate(shown):
        x0 = left + column * (panel + gap)
        title = "initially" if timestamp == 0 else f"iteration {timestamp}"
        parts.append(f'<text class="panel-title" x="{x0:.0f}" y="16">{title}</text>')
        for level in range(len(QUALITY)):
            path = ""
            for quality, polygon in sections[timestamp]:
                if min(int(quality * len(QUALITY)), len(QUALITY) - 1) != level:
                    continue
                corners = [
                    f"{x0 + (polygon[i] - low_x) * scale:.1f} {top + (high_z - polygon[i + 1]) * scale:.1f}"
                    for i in range(0, len(polygon), 2)
                ]
                path += "M" + "L".join(corners) + "Z"
            if path:
                parts.append(
                    f'<path d="{path}" style="fill:{QUALITY[level]};stroke:#14181d;stroke-width:.35;'
                    'stroke-linejoin:round"/>'
                )
        parts.append(
            f'<text class="axis-label" x="{x0 + panel / 2:.0f}" y="{top + tall + 36:.0f}" '
            'text-anchor="middle">across, in spacings</text>'
        )
        for value in (round(low_x * 0.9), 0, round(high_x * 0.9)):
            parts.append(
                f'<text class="tick" x="{x0 + (value - low_x) * scale:.1f}" y="{top + tall + 18:.0f}" '
                f'text-anchor="middle">{value}</text>'
            )
    for value in (low_z * 0.95, 0, high_z * 0.95):
        parts.append(
            f'<text class="tick" x="{left - 6}" y="{top + (high_z - value) * scale + 3:.1f}" '
            f'text-anchor="end">{value:.0f}</text>'
        )
    parts.append(
        f'<text class="axis-label" transform="translate(14 {top + tall / 2:.0f}) rotate(-90)" '
        'text-anchor="middle">upwards, in spacings</text>'
    )
    y = top + tall + 58
    parts.append(
        f'<text class="axis-label" x="{left}" y="{y + 10:.0f}">radius ratio of the cell: 0 (flat)</text>'
    )
    for level, colour in enumerate(QUALITY):
        parts.append(
            f'<rect x="{left + 190 + 26 * level}" y="{y:.0f}" width="26" height="13" style="fill:{colour}"/>'
        )
    parts.append(
        f'<text class="axis-label" x="{left + 198 + 26 * len(QUALITY)}" y="{y + 10:.0f}">1 (regular)</text>'
    )
    poor = [(t, sum(q < 0.2 for q, _ in sections[t]) / len(sections[t])) for t in shown]
    mean = [(t, sum(q for q, _ in sections[t]) / len(sections[t])) for t in shown]
    then = (
        "100 iterations were not sufficient for a high-quality mesh; the cells' shapes improved up to 1,000."
    )
    now = (
        "In this section through the body, the mean radius ratio is "
        + listed(f"{m:.2f} at iteration {t}" for t, m in mean)
        + "; "
        + listed(f"{percent(p, 1)} at {t}" for t, p in poor)
        + " of the cells are below 0.2."
    )
    now += f" The body: {body_of(results)}."
    return (
        figure(1080, round(y + 26), parts, "A section through the body man at several iterations"),
        then,
        now,
    )


def body_of(results):
    names = {r["remark"] for r in results.statistics if r["scenario"] == "man"}
    return (
        listed(sorted(n.replace("body: ", "") for n in names)).replace(
            "man.off", "man.off of Debian's libcgal-demo"
        )
        or "unknown"
    )


# Cividis, which reads the same with and without colour deficiencies, in ten steps.
QUALITY = [
    "#00224e",
    "#123570",
    "#3b496c",
    "#575d6d",
    "#707173",
    "#8a8678",
    "#a59c74",
    "#c3b369",
    "#e1cc55",
    "#fee838",
]


def figure_6(results):
    scenarios = [s for s in SPACE if iterations(results, s)]
    if not scenarios:
        return None
    svg = grid_of_tolerances(
        results, scenarios, "mean_displacement", "Widths of bi-cells and tolerances of vertices in space"
    )
    then = (
        "avg(W) of slloyd stayed at about 30 % of the spacing and avg(ε(V)) at about 1 %; both converge more"
        " slowly than in the plane. (The report's third panel in man goes to 0.2, as its points were sparse.)"
    )
    now = (
        "At the last iteration: "
        + listed(
            f"{INPUT_TITLES[s]} {percent(last(results, s, 'mean_width'))} and "
            f"{percent(last(results, s, 'mean_tolerance'), 1)}"
            for s in scenarios
        )
        + "."
    )
    return svg, then, now


def figure_7(results):
    scenarios = [s for s in ("share_2d", "share_3d") if results.distribution(s, 0, "width")]
    if not scenarios:
        return None
    width, height = 535, 230
    parts = []
    for row, scenario in enumerate(scenarios):
        name = "Two" if scenario.endswith("2d") else "Three"
        for column, (quantity, label, colour) in enumerate(
            (("width", "W", "tolerance"), ("tolerance", "ε(V)", "safe"))
        ):
            bins = results.distribution(scenario, 0, quantity)[:-1]
            if quantity == "tolerance":
                bins = [b for b in bins if b[1] <= (0.101 if name == "Two" else 0.031)]
            plot = Plot(
                width,
                height,
                (0, bins[-1][1]),
                (0, max(share for _, _, share in bins) * 1.1),
                ("width of the annulus" if quantity == "width" else "tolerance ε") + ", in spacings",
                f"share per {bins[0][1]:.3g}",
                f"{name} dimensions, {count(results.size(scenario))} points: {label}",
                tick_text=lambda v: f"{100 * v:g} %",
            )
            plot.steps(bins, colour)
            parts.append(plot.svg(column * (width + 10), row * (height + 10)))
    then = (
        "; ".join(
            f"{name} {two:g} in the plane and {three:g} in space"
            for name, (two, three) in (
                ("avg(W)", FIGURE_7["mean_width"]),
                ("avg(ε(V))", FIGURE_7["mean_tolerance"]),
                ("average greatest width at a vertex", FIGURE_7["mean_widest"]),
                ("bi-cells per vertex", FIGURE_7["bicells_per_vertex"]),
            )
        )
        + "."
    )
    then = "Random points at unit density: " + then
    names = {
        "mean_width": "avg(W)",
        "mean_tolerance": "avg(ε(V))",
        "mean_widest": "average greatest width",
        "bicells_per_vertex": "bi-cells per vertex",
    }
    now = "; ".join(
        names[column] + " " + listed(f"{last(results, s, column):.3g}" for s in scenarios) for column in names
    )
    now += (
        ". Standard delimiters, finite bi-cells only; points next to the hull, whose bi-cells are wide, are"
        " counted. The report's avg(W) is that of the least annuli, which are narrower where the opposing"
        " vertices' line misses the facet."
    )
    return (
        figure(
            2 * width + 10,
            len(scenarios) * (height + 10),
            parts,
            "Distributions of widths and tolerances of random points",
        ),
        then,
        now,
    )


def comparison(results, scenario, x_column, x_label, x, x_scale=1.0, x_log=False, ticks=None):
    """Two panels side by side with the same axes: the report's algorithms on CGAL, deldrift's."""
    width, height = 535, 300
    curves = {
        (engine, a): [(px * x_scale, py) for px, py in results.sweep(scenario, engine, a, x_column)]
        for engine, algorithms in (("cgal", CGAL), ("deldrift", DELDRIFT))
        for a in algorithms
    }
    values = [py for points in curves.values() for _, py in points]
    if not values:
        return []
    panels = []
    for engine, algorithms in (("cgal", CGAL), ("deldrift", DELDRIFT)):
        dimension = "the plane" if scenario.endswith("2d") else "space"
        title = f"{'On CGAL' if engine == 'cgal' else 'deldrift'}, in {dimension}"
        plot = Plot(
            width,
            height,
            x,
            limits(values, True),
            x_label,
            "ns per vertex and timestamp",
            title,
            y_log=True,
            x_log=x_log,
            x_ticks=ticks,
            right=110,
        )
        for a in algorithms:
            plot.line(curves[engine, a], COLOURS[a], NAMES[a], marks=True)
        if engine == "deldrift":
            plot.line(curves["cgal", "rebuilding"], "muted", "CGAL rebuilding", "dashed")
        panels.append(plot)
    return panels


def two_by_two(panels, description):
    parts = [panel.svg((i % 2) * 545, (i // 2) * 310) for i, panel in enumerate(panels)]
    return figure(1080, 310 * ((len(panels) + 1) // 2), parts, description)


def figure_8(results):
    panels = []
    for scenario in ("share_2d", "share_3d"):
        panels += comparison(
            results,
            scenario,
            "share_within_tolerance",
            "share of vertices within tolerance, in %",
            (0, 100),
            100,
        )
    if not panels:
        return None
    then = (
        "T equalled rebuilding when about 25 % of the vertices in the plane, 55 % in space, were beyond their"
        " tolerance; at best it was 17 and 125 times as fast. Testing S took 4 and 55 times as long as"
        " testing T."
    )
    now = []
    for scenario, where in (("share_2d", "the plane"), ("share_3d", "space")):
        rebuilding = results.sweep(scenario, "cgal", "rebuilding", "share_within_tolerance")
        for engine, name in (("cgal", "T on CGAL"), ("deldrift", "deldrift's T")):
            t = results.sweep(scenario, engine, "tolerance", "share_within_tolerance")
            s = results.sweep(scenario, engine, "safe_region", "share_within_tolerance")
            if not t or not rebuilding:
                continue
            at = crossing(t, rebuilding)
            best = max(dict(rebuilding)[x] / y for x, y in t)
            text = f"in {where} {name} equals CGAL's rebuilding with " + (
                f"{percent(1 - at)} beyond tolerance" if at is not None else "no share measured"
            )
            text += f", is at best {times(best)} times as fast"
            uncertain = last(results, scenario, "share_uncertain")
            if engine == "cgal" and uncertain:
                text += (
                    f" ({percent(uncertain, 1)} of the vertices have a tolerance that the report's static"
                    " filters cannot certify, and always take placement)"
                )
            if s:
                text += f", and S takes {times(s[-1][1] / t[-1][1])} times as long where all are within"
            now.append(text)
    return two_by_two(panels, "Time against the share of vertices within tolerance"), then, sentence(now)


def sentence(parts):
    text = "; ".join(parts)
    return text[:1].upper() + text[1:] + "."


def figure_9(results):
    panels = []
    for scenario in ("walk_2d", "walk_3d"):
        panels += comparison(
            results,
            scenario,
            "displacement_per_tolerance",
            "displacement, in % of avg(ε(V))",
            (1.7, 360),
            100,
            True,
            [2, 5, 10, 20, 50, 100, 200],
        )
    if not panels:
        return None
    then = (
        "With displacements of 20 % of avg(ε(V)), T still outperformed rebuilding, in the plane and in space;"
        " up to avg(ε(V)) in space, T was more than three times as fast as placement."
    )
    now = []
    for scenario, where in (("walk_2d", "the plane"), ("walk_3d", "space")):
        rebuilding = results.sweep(scenario, "cgal", "rebuilding", "displacement_per_tolerance")
        for engine, name in (("cgal", "T on CGAL"), ("deldrift", "deldrift's T")):
            t = results.sweep(scenario, engine, "tolerance", "displacement_per_tolerance")
            if not t or not rebuilding:
                continue
            at = crossing(t, rebuilding)
            now.append(
                f"in {where} {name} is faster than CGAL's rebuilding "
                + (
                    f"up to {percent(at)} of avg(ε(V))"
                    if at is not None
                    else "throughout" if t[0][1] < rebuilding[0][1] else "nowhere"
                )
            )
    t, p = (
        results.sweep("walk_3d", "cgal", a, "displacement_per_tolerance") for a in ("tolerance", "placement")
    )
    near = [(abs(x - 1), dict(p)[x] / y) for x, y in t if x in dict(p)]
    if near:
        now.append(f"at 100 % in space, T on CGAL is {times(min(near)[1])} times as fast as CGAL's placement")
    return two_by_two(panels, "Time against the displacement in a random walk"), then, sentence(now)


def figure_10(results):
    panels = []
    for scenario in INPUTS:
        curves = {
            (engine, a): results.curve(scenario, engine, a)
            for engine, algorithms in (("cgal", CGAL), ("deldrift", DELDRIFT))
            for a in algorithms
        }
        values = [y for points in curves.values() for _, y in points]
        if not values:
            continue
        end = results.range(scenario, 0)[1]
        for engine, algorithms in (("cgal", CGAL), ("deldrift", DELDRIFT)):
            title = f"{INPUT_TITLES[scenario]}: {'on CGAL' if engine == 'cgal' else 'deldrift'}"
            plot = Plot(
                535,
                300,
                (0.9, end * 1.1),
                limits(values, True),
                "iteration",
                "ns per vertex and iteration",
                title,
                x_log=True,
                y_log=True,
                x_ticks=[1, 3, 10, 30, 100, 300, 1000],
                right=110,
            )
            for a in algorithms:
                plot.line(curves[engine, a], COLOURS[a], NAMES[a])
            if engine == "deldrift":
                plot.line(curves["cgal", "rebuilding"], "muted", "CGAL rebuilding", "dashed")
            panels.append(plot)
    if not panels:
        return None
    then = (
        "In the plane S, T, S+T and rebuilding+T all outperformed rebuilding and placement; in space T did"
        " for snodt and man, not for slloyd, where slivers keep tolerances small. T becomes faster as"
        " iterations go on."
    )
    now = []
    for scenarios, where in ((PLANE, "in the plane"), (SPACE, "in space")):
        for engine, name in (("cgal", "on CGAL"), ("deldrift", "of deldrift")):
            faster = {
                a: [INPUT_TITLES[s] for s in scenarios if (results.speedup(s, engine, a, 0) or 0) > 1]
                for a in ("safe_region", "tolerance", "safe_region_tolerance", "rebuilding_tolerance")
            }
            now.append(
                f"{where} those {name} that outperform CGAL's rebuilding over all iterations: "
                + ", ".join(
                    f"{NAMES[a]} on {'all' if len(f) == len(scenarios) else listed(f) or 'none'}"
                    for a, f in faster.items()
                )
            )
    return two_by_two(panels, "Time of an iteration, for every input and algorithm"), then, sentence(now)


FIGURES = [
    (3, "Points of Lloyd's method in the plane", figure_3),
    (4, "Widths and tolerances in the plane", figure_4),
    (5, "The body man", figure_5),
    (6, "Widths and tolerances in space", figure_6),
    (7, "Widths and tolerances of random points", figure_7),
    (8, "Time against the share of vertices within tolerance", figure_8),
    (9, "Time against the length of displacements", figure_9),
    (10, "Time of every iteration", figure_10),
]
