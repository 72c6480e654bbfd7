# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures 3 to 10, each as (SVG, what the report saw, what is seen here)."""

import matplotlib
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from engines import CGAL, COLOURS, DELDRIFT, NAMES
from plot import Sheet, colour, limits, line
from published import FIGURE_7, INPUT_TITLES, INPUTS
from words import count, crossing, listed, percent, span, times

PLANE, SPACE = INPUTS[:4], INPUTS[4:]
ITERATION_COLOURS = ["one", "two", "three", "four", "ink"]


def iterations(results, scenario):
    return [t for t in results.shown(scenario) if t > 0][:4]


def figure_3(results):
    scenarios = [s for s in PLANE if iterations(results, s)]
    if not scenarios:
        return None
    rows = iterations(results, scenarios[0])
    size, left, top, gap = 240, 56, 28, 14
    points = {}
    for r in results.points:
        points.setdefault((r["scenario"], int(r["timestamp"])), []).append((float(r["x"]), float(r["y"])))
    reach = max(abs(c) for p in points.values() for xy in p for c in xy) * 1.04
    tick = 15 if reach > 16 else max(1, int(0.8 * reach))
    sheet = Sheet(
        left + 4 * (size + gap),
        top + len(rows) * (size + gap) + 34,
        "Points at several iterations of Lloyd's method, for four densities",
    )
    for column, scenario in enumerate(scenarios):
        for row, timestamp in enumerate(iterations(results, scenario)):
            axes = sheet.axes(left + column * (size + gap), top + row * (size + gap), size, size)
            axes.set(xlim=(-reach, reach), ylim=(-reach, reach), xticks=(-tick, 0, tick), yticks=(-tick, 0, tick))
            axes.grid(False)
            axes.spines[:].set_visible(True)
            axes.spines[:].set_color(colour("rule"))
            axes.tick_params(length=0, labelleft=column == 0, labelbottom=row == len(rows) - 1)
            axes.add_patch(dots(points[scenario, timestamp]))
            if row == 0:
                axes.set_title(INPUT_TITLES[scenario])
            if row == len(rows) - 1:
                axes.set_xlabel("x, in spacings")
            if column == 0:
                axes.set_ylabel(f"iteration {timestamp}: y, in spacings")
    then = "1,000 points come to rest in an arrangement that follows the density."
    changes = [f"{INPUT_TITLES[s]}: {movement(results, s)}" for s in scenarios]
    now = (
        "Mean displacement of a point per iteration, at the first and towards the last: "
        + "; ".join(changes)
        + "."
    )
    return sheet.svg(), then, now


def dots(points):
    """One path of round dots: as markers, which have an element each, they would take five times as much room."""
    path = Path([p for p in points for _ in (0, 1)], [Path.MOVETO, Path.LINETO] * len(points))
    return PathPatch(path, fill=False, ec=colour("ink"), lw=2.5, capstyle="round")


def movement(results, scenario):
    series = results.statistic(scenario, "mean_displacement")
    return f"{series[0][1]:.3g} and {series[-1][1]:.2g} spacings" if series else "not measured"


def averages(results, scenario, sheet, box, x_column):
    w = sorted(p for p in results.statistic(scenario, "mean_width", x_column) if p[0] > 0)
    e = sorted(p for p in results.statistic(scenario, "mean_tolerance", x_column) if p[0] > 0)
    xs = [x for x, _ in w]
    axes = sheet.panel(
        *box,
        right=70,
        title=INPUT_TITLES[scenario],
        xlabel="iteration" if x_column == "timestamp" else "mean displacement, in spacings",
        ylabel="spacings",
        xscale="log",
        xlim=(min(xs), max(xs)),
        ylim=limits([y for _, y in w]),
    )
    line(axes, w, "tolerance", "avg(W)")
    line(axes, e, "safe", "avg(ε(V))")
    if x_column != "timestamp":
        mark_iterations(results, scenario, axes)


def mark_iterations(results, scenario, axes):
    by_timestamp = {int(float(r["timestamp"])): r for r in results.statistics if r["scenario"] == scenario}
    for timestamp in (1, 10, 100):
        row = by_timestamp.get(timestamp)
        if row and row["mean_displacement"]:
            place = float(row["mean_displacement"]), float(row["mean_width"])
            axes.plot(*place, "o", color=colour("tolerance"))
            axes.annotate(
                f"it. {timestamp}", place, xytext=(0, 8), textcoords="offset points", ha="center", fontsize=10.5
            )


def shares(sheet, box, bins, end, **properties):
    """Axes for histograms."""
    axes = sheet.panel(*box, xlim=(0, end), ylabel=f"share per {bins[0][1]:.3g}", **properties)
    axes.yaxis.set_major_formatter(lambda share, _: f"{100 * share:g}\u00a0%")
    return axes


def outline(axes, bins, name, label=None):
    axes.stairs([share for _, _, share in bins], [bins[0][0]] + [b[1] for b in bins], color=colour(name), label=label)


def distributions(results, scenario, quantity, sheet, box, end):
    bins = {t: results.distribution(scenario, t, quantity) for t in iterations(results, scenario)}
    axes = shares(
        sheet,
        box,
        next(iter(bins.values())),
        end,
        title="W" if quantity == "width" else "ε(V)",
        xlabel="width of the annulus, in spacings" if quantity == "width" else "tolerance ε, in spacings",
        ylim=(0, 1.1 * max(share for b in bins.values() for _, _, share in b)),
    )
    for timestamp, name in zip(bins, ITERATION_COLOURS):
        outline(axes, [b for b in bins[timestamp] if b[1] <= end * 1.0001], name, f"iteration {timestamp}")
    for handle in axes.legend(loc="upper right", prop={"weight": "semibold"}).legendHandles:
        handle.set_visible(False)


def grid_of_tolerances(results, scenarios, x_column, description):
    width, height = 352, 214
    sheet = Sheet(3 * width + 12, len(scenarios) * (height + 12), description)
    for row, scenario in enumerate(scenarios):
        boxes = [(column * (width + 6), row * (height + 12), width, height) for column in range(3)]
        averages(results, scenario, sheet, boxes[0], x_column)
        distributions(results, scenario, "width", sheet, boxes[1], 0.98)
        distributions(results, scenario, "tolerance", sheet, boxes[2], 0.245 if scenario in PLANE else 0.048)
    return sheet.svg()


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
        corners = [float(c) for c in r["polygon"].split()]
        sections.setdefault(int(r["timestamp"]), []).append(
            (float(r["radius_ratio"]), list(zip(corners[::2], corners[1::2])))
        )
    if not sections:
        return None
    shown = sorted(sections)
    shown = shown[:1] + [t for t in shown if t >= 10][-3:]
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
        + f" of the cells are below 0.2. The body: {body_of(results)}."
    )
    return draw_sections([(t, sections[t]) for t in shown]), then, now


def draw_sections(sections):
    corners = [corner for _, cells in sections for _, polygon in cells for corner in polygon]
    (low_x, high_x), (low_z, high_z) = ((min(c), max(c)) for c in zip(*corners))
    left, top, n = 48, 28, len(sections)
    scale = min((1022 / n - 18) / (high_x - low_x), 560 / (high_z - low_z))
    width, height = scale * (high_x - low_x), scale * (high_z - low_z)
    gap = min(60, (1022 - width * n) / max(n - 1, 1))
    sheet = Sheet(1080, round(top + height + 110), "A section through the body man at several iterations")
    cividis = matplotlib.colormaps["cividis"].resampled(10)  # reads the same with colour deficiencies
    levels = BoundaryNorm([i / 10 for i in range(11)], 10)
    for column, (timestamp, cells) in enumerate(sections):
        axes = sheet.axes(left + column * (width + gap), top, width, height)
        axes.set(
            title="initially" if timestamp == 0 else f"iteration {timestamp}",
            xlabel="across, in spacings",
            xlim=(low_x, high_x),
            ylim=(low_z, high_z),
            xticks=(round(low_x * 0.9), 0, round(high_x * 0.9)),
            yticks=(round(low_z * 0.95), 0, round(high_z * 0.95)),
        )
        axes.grid(False)
        axes.spines[:].set_visible(False)
        axes.tick_params(length=0, labelleft=column == 0)
        if column == 0:
            axes.set_ylabel("upwards, in spacings")
        for level in range(10):
            paths = [Path(p + p[:1], closed=True) for q, p in cells if min(int(10 * q), 9) == level]
            if paths:
                path = Path.make_compound_path(*paths)
                axes.add_patch(PathPatch(path, fc=cividis(level), ec="#14181d", lw=0.35, clip_on=False))
    bar = sheet.figure.colorbar(
        ScalarMappable(levels, cividis),
        cax=sheet.axes(left, top + height + 58, 260, 13),
        orientation="horizontal",
        ticks=(0, 1),
    )
    bar.set_label("radius ratio of the cell")
    bar.outline.set_visible(False)
    bar.ax.set_xticklabels(["0 (flat)", "1 (regular)"])
    return sheet.svg()


def body_of(results):
    names = {r["remark"] for r in results.statistics if r["scenario"] == "man"}
    return (
        listed(sorted(n.replace("body: ", "") for n in names)).replace(
            "man.off", "man.off of Debian's libcgal-demo"
        )
        or "unknown"
    )


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
    sheet = Sheet(
        2 * width + 10,
        len(scenarios) * (height + 10),
        "Distributions of widths and tolerances of random points",
    )
    for row, scenario in enumerate(scenarios):
        name = "Two" if scenario.endswith("2d") else "Three"
        for column, (quantity, label, of_quantity) in enumerate(
            (("width", "W", "tolerance"), ("tolerance", "ε(V)", "safe"))
        ):
            bins = results.distribution(scenario, 0, quantity)[:-1]
            if quantity == "tolerance":
                bins = [b for b in bins if b[1] <= (0.101 if name == "Two" else 0.031)]
            axes = shares(
                sheet,
                (column * (width + 10), row * (height + 10), width, height),
                bins,
                bins[-1][1],
                title=f"{name} dimensions, {count(results.size(scenario))} points: {label}",
                xlabel=("width of the annulus" if quantity == "width" else "tolerance ε") + ", in spacings",
                ylim=(0, max(share for _, _, share in bins) * 1.1),
            )
            outline(axes, bins, of_quantity)
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
    return sheet.svg(), then, now


def curves_of(curve_of):
    """The curve of every engine and algorithm."""
    return {
        (engine, a): curve_of(engine, a)
        for engine, algorithms in (("cgal", CGAL), ("deldrift", DELDRIFT))
        for a in algorithms
    }


def comparison(inputs, description, marker=None, **properties):
    """For each input (titles, curves, range of x) two panels side by side with the same axes: the report's algorithms
    on CGAL, deldrift's."""
    inputs = [each for each in inputs if any(each[1].values())]
    if not inputs:
        return None
    sheet = Sheet(1080, 310 * len(inputs), description)
    for row, (titles, curves, xlim) in enumerate(inputs):
        ylim = limits([y for points in curves.values() for _, y in points], True)
        properties.update(xlim=xlim, ylim=ylim, yscale="log")
        for column, (engine, algorithms) in enumerate((("cgal", CGAL), ("deldrift", DELDRIFT))):
            axes = sheet.panel(545 * column, 310 * row, 535, 300, right=110, title=titles[column], **properties)
            for a in algorithms:
                line(axes, curves[engine, a], COLOURS[a], NAMES[a], marker=marker)
        line(axes, curves["cgal", "rebuilding"], "muted", "CGAL rebuilding", linestyle="--")
    return sheet.svg()


def sweeps(results, kind, x_column, xlim):
    """The inputs of segments of a kind, x being a column of report_segments.csv, in %."""

    def curve_of(engine, algorithm):
        return [(100 * x, y) for x, y in results.sweep(scenario, engine, algorithm, x_column)]

    inputs = []
    for scenario, where in ((f"{kind}_2d", "the plane"), (f"{kind}_3d", "space")):
        inputs.append(((f"On CGAL, in {where}", f"deldrift, in {where}"), curves_of(curve_of), xlim))
    return inputs


def figure_8(results):
    svg = comparison(
        sweeps(results, "share", "share_within_tolerance", (0, 100)),
        "Time against the share of vertices within tolerance",
        marker="o",
        xlabel="share of vertices within tolerance, in %",
        ylabel="ns per vertex and timestamp",
    )
    if not svg:
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
    return svg, then, sentence(now)


def sentence(parts):
    text = "; ".join(parts)
    return text[:1].upper() + text[1:] + "."


def figure_9(results):
    svg = comparison(
        sweeps(results, "walk", "displacement_per_tolerance", (1.7, 360)),
        "Time against the displacement in a random walk",
        marker="o",
        xlabel="displacement, in % of avg(ε(V))",
        ylabel="ns per vertex and timestamp",
        xscale="log",
    )
    if not svg:
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
    return svg, then, sentence(now)


def figure_10(results):
    inputs = [
        (
            (f"{INPUT_TITLES[s]}: on CGAL", f"{INPUT_TITLES[s]}: deldrift"),
            curves_of(lambda engine, algorithm, scenario=s: results.curve(scenario, engine, algorithm)),
            (0.9, results.range(s, 0)[1] * 1.1),
        )
        for s in INPUTS
        if results.range(s, 0)
    ]
    svg = comparison(
        inputs,
        "Time of an iteration, for every input and algorithm",
        xlabel="iteration",
        ylabel="ns per vertex and iteration",
        xscale="log",
    )
    if not svg:
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
    return svg, then, sentence(now)


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
