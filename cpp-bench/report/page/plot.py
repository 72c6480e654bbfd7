# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures, which matplotlib draws. Their colours are those of plot.css, so that a page can be light or dark."""

import io
import math
import os
import re
from html import escape

import matplotlib
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullLocator

with open(os.path.join(os.path.dirname(__file__), "plot.css"), encoding="utf-8") as file:
    VARIABLES = sorted(set(re.findall(r"--(\w+):", file.read())))


def colour(name):
    """What stands for a variable of plot.css until a figure is drawn, as matplotlib knows no variables."""
    return f"#{1 + VARIABLES.index(name):06x}"


matplotlib.rcParams.update(
    {
        "svg.fonttype": "none",
        "font.family": "DejaVu Sans",
        "font.size": 11,
        "text.color": colour("muted"),
        "axes.axisbelow": True,
        "axes.edgecolor": colour("axis"),
        "axes.facecolor": "none",
        "axes.grid": True,
        "axes.grid.axis": "y",
        "axes.labelcolor": colour("muted"),
        "axes.linewidth": 1,
        "axes.spines.left": False,
        "axes.spines.right": False,
        "axes.spines.top": False,
        "axes.titlecolor": colour("ink"),
        "axes.titlelocation": "left",
        "axes.titlepad": 11,
        "axes.titlesize": 12.5,
        "axes.titleweight": "semibold",
        "figure.facecolor": "none",
        "grid.color": colour("grid"),
        "grid.linewidth": 1,
        "legend.borderaxespad": 0,
        "legend.frameon": False,
        "legend.handlelength": 0,
        "legend.handletextpad": 0,
        "legend.labelcolor": "linecolor",
        "legend.labelspacing": 0.2,
        "lines.linewidth": 1.8,
        "lines.markersize": 5.2,
        "patch.linewidth": 1.8,
        "path.simplify": False,
        "xtick.color": colour("axis"),
        "xtick.labelcolor": colour("muted"),
        "xtick.labelsize": 10.5,
        "xtick.major.size": 4,
        "xtick.major.width": 1,
        "ytick.labelcolor": colour("muted"),
        "ytick.labelsize": 10.5,
        "ytick.major.size": 0,
    }
)


def short(value, _=None):
    """A number as a tick label and in a sentence. matplotlib sets powers of ten as formulas, for labels alone."""
    if value == 0:
        return "0"
    if abs(value) >= 1e6:
        return f"{value / 1e6:g}M"
    if abs(value) >= 1e4:
        return f"{value / 1e3:g}k"
    if abs(value) >= 1000:
        return f"{value:,.0f}"
    if abs(value) < 1e-3:
        exponent = math.floor(math.log10(abs(value)) + 1e-9)
        mantissa = value / 10**exponent
        power = "10" + "".join("⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".index(c)] for c in str(exponent))
        return power if abs(mantissa - 1) < 1e-6 else f"{mantissa:g}·{power}"
    return f"{value:g}"


def limits(values, is_log=False):
    """Rounded outwards, so that nothing lies on the frame."""
    low, high = min(values), max(values)
    if is_log:
        return low / 1.15, high * 1.25
    return 0, high * 1.06 if high > 0 else 1


# What matplotlib writes, and what a page needs of it: few words, and no ids but those that are referred to.
REPLACEMENTS = (
    (r"<metadata>.*?</metadata>|<style.*?</style>", ""),
    (r"\s*\n\s*", ""),
    (r'<g id="[\w.]+_\d+"/>', ""),
    (r'<g id="[\w.]+_\d+">', "<g>"),
    (r"<g id=", "<g class="),
    (r' transform="rotate\(-0 [^"]*"', ""),
    (r"M (\S+ \S+)L \1", r"M \1h0"),
    (r"#0000([0-9a-f]{2})\b", lambda m: f"var(--{VARIABLES[int(m[1], 16) - 1]})"),
    (r"'DejaVu Sans'", "var(--font)"),
)


class Sheet:
    """A figure of panels. Lengths are in px, from its upper left corner. Panels are not left to matplotlib's layout,
    which settles their places last: labels at the ends of curves must know them."""

    def __init__(self, width, height, description):
        self.width, self.height, self.description = width, height, description
        self.figure = Figure(figsize=(width / 72, height / 72), dpi=72)

    def axes(self, left, top, width, height, **properties):
        box = [left / self.width, 1 - (top + height) / self.height, width / self.width, height / self.height]
        axes = self.figure.add_axes(box, **properties)
        axes.xaxis.label.set_gid("axis-label")
        axes.yaxis.label.set_gid("axis-label")
        return axes

    def panel(self, left, top, width, height, right=16, **properties):
        """Axes with room for labels around them."""
        axes = self.axes(left + 58, top + 26, width - 58 - right, height - 68, **properties)
        for axis, n_ticks in ((axes.xaxis, 5), (axes.yaxis, 4)):
            low, high = axis.get_view_interval()
            factors = (1,) if high > 300 * low else (1, 3) if high > 30 * low else (1, 2, 5)
            is_log = axis.get_scale() == "log"
            axis.set_major_locator(
                LogLocator(subs=factors) if is_log else MaxNLocator(n_ticks, steps=(1, 2, 2.5, 5, 10))
            )
            axis.set_minor_locator(NullLocator())
            axis.set_major_formatter(short)
        return axes

    def svg(self):
        """To be put into a page with plot.css, in no size of its own."""
        for axes in self.figure.axes:
            label_ends(axes)
        file = io.StringIO()
        with matplotlib.rc_context({"svg.hashsalt": self.description}):
            self.figure.savefig(file, format="svg")
        drawing = re.search(r"<svg[^>]*>(.*</svg>)", file.getvalue(), re.DOTALL)[1]
        drawing = re.sub(r'="[^"]*"', lambda m: re.sub(r"\d+\.\d{3,}", rounded, m[0]), drawing)
        for pattern, replacement in REPLACEMENTS:
            drawing = re.sub(pattern, replacement, drawing, flags=re.DOTALL)
        description = escape(self.description)
        return (
            '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" role="img"'
            f' viewBox="0 0 {self.width} {self.height}" aria-label="{description}">'
            f"<title>{description}</title>{drawing}"
        )


def rounded(number):
    return f"{float(number[0]):.1f}"


def line(axes, points, name, label=None, **style):
    """A line. If it has a label, that will be at its end."""
    if points:
        axes.plot(*zip(*points), color=colour(name), clip_on=False, label=label, **style)


def label_ends(axes):
    """Labels to the right of a panel, moved apart, each with a thin line to its curve's end. matplotlib would make a
    legend of them, in which as many as nine curves would have to be looked up."""
    lines = [line for line in axes.get_lines() if not line.get_label().startswith("_")]
    ends = [line.get_xydata()[-1] for line in lines]
    below_top = [axes.bbox.y1 - axes.transData.transform(end)[1] for end in ends]
    gap, place, places = 13, -7, {}
    for i in sorted(range(len(ends)), key=below_top.__getitem__):
        places[i] = place = max(below_top[i], place + gap)
    lowest = axes.bbox.height - 2
    for i in reversed(places):
        places[i] = lowest = min(places[i], lowest)
        lowest -= gap
    for i, place in places.items():
        of_line = lines[i].get_color()
        axes.annotate(
            lines[i].get_label(),
            ends[i],
            xytext=(1 + 9 / axes.bbox.width, 1 - place / axes.bbox.height),
            textcoords="axes fraction",
            annotation_clip=False,
            color=of_line,
            fontweight="semibold",
            va="center",
            arrowprops={"arrowstyle": "-", "color": of_line, "alpha": 0.6, "lw": 0.7, "relpos": (0, 0.5)},
        )
