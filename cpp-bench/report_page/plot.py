# SPDX-License-Identifier: GPL-3.0-or-later
"""Plots as SVG text. Colours are CSS variables, so that a page can be light or dark; see style.py."""

import math
from html import escape

CHARACTER = 6.1  # width of a character of the 11 px labels, in px, a little generous


class Scale:
    """Values to pixels, linear or logarithmic."""

    def __init__(self, low, high, start, end, is_log=False):
        self.low, self.high, self.start, self.end, self.is_log = low, high, start, end, is_log

    def __call__(self, value):
        if self.is_log:
            value = max(value, self.low * 1e-3)
            share = math.log(value / self.low) / math.log(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)

    def ticks(self, count=5):
        if self.is_log:
            return self.log_ticks()
        step = (self.high - self.low) / count
        magnitude = 10 ** math.floor(math.log10(step))
        step = next(m * magnitude for m in (1, 2, 2.5, 5, 10) if m * magnitude >= step * 0.999)
        first = math.ceil(self.low / step - 1e-9)
        last = math.floor(self.high / step + 1e-9)
        return [i * step for i in range(first, last + 1)]

    def log_ticks(self):
        decades = range(math.floor(math.log10(self.low)), math.ceil(math.log10(self.high)) + 1)
        factors = (1,) if self.high / self.low > 300 else (1, 2, 5) if self.high / self.low < 30 else (1, 3)
        ticks = [f * 10.0**d for d in decades for f in factors]
        return [t for t in ticks if self.low * 0.999 <= t <= self.high * 1.001]


def short(value):
    """A number as a tick label."""
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


class Plot:
    """One panel with labelled axes. Draw, then place it with `svg` into a figure."""

    def __init__(
        self,
        width,
        height,
        x,
        y,
        x_label,
        y_label,
        title="",
        x_log=False,
        y_log=False,
        right=16,
        x_ticks=None,
        tick_text=short,
    ):
        self.width, self.height, self.title = width, height, title
        self.left, self.right, self.top, self.bottom = 58, right, 26 if title else 10, 42
        self.x = Scale(*x, self.left, width - self.right, x_log)
        self.y = Scale(*y, height - self.bottom, self.top, y_log)
        self.parts, self.ends = [], []
        self.axes(x_label, y_label, x_ticks, tick_text)

    def axes(self, x_label, y_label, x_ticks, tick_text):
        bottom, end = self.height - self.bottom, self.width - self.right
        add = self.parts.append
        if self.title:
            add(f'<text class="panel-title" x="{self.left}" y="15">{escape(self.title)}</text>')
        for tick in self.y.ticks(4):
            y = self.y(tick)
            add(f'<line class="grid" x1="{self.left}" y1="{y:.1f}" x2="{end}" y2="{y:.1f}"/>')
            add(
                f'<text class="tick" x="{self.left - 6}" y="{y + 3.6:.1f}"'
                f' text-anchor="end">{tick_text(tick)}</text>'
            )
        last = -1e9
        for tick in x_ticks if x_ticks is not None else self.x.ticks(5):
            x, text = self.x(tick), short(tick)
            if not self.left - 0.5 <= x <= end + 0.5 or x - last < CHARACTER * len(text) + 6:
                continue
            last = x
            add(f'<line class="axis" x1="{x:.1f}" y1="{bottom}" x2="{x:.1f}" y2="{bottom + 4}"/>')
            add(f'<text class="tick" x="{x:.1f}" y="{bottom + 16}" text-anchor="middle">{text}</text>')
        add(f'<line class="axis" x1="{self.left}" y1="{bottom}" x2="{end}" y2="{bottom}"/>')
        middle = (self.left + end) / 2
        add(
            f'<text class="axis-label" x="{middle:.0f}" y="{self.height - 7}" text-anchor="middle">'
            f"{escape(x_label)}</text>"
        )
        middle = (self.top + bottom) / 2
        add(
            f'<text class="axis-label" transform="translate(13 {middle:.0f}) rotate(-90)"'
            f' text-anchor="middle">{escape(y_label)}</text>'
        )

    def inside(self, points):
        return [(self.x(x), min(max(self.y(y), self.top), self.height - self.bottom)) for x, y in points]

    def line(self, points, colour, label=None, style="", marks=False):
        """A line with its label at the end."""
        if not points:
            return
        places = self.inside(points)
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in places)
        self.parts.append(f'<path class="line {style}" style="stroke:var(--{colour})" d="{path}"/>')
        if marks:
            self.parts += [
                f'<circle style="fill:var(--{colour})" cx="{x:.1f}" cy="{y:.1f}" r="2.6"/>' for x, y in places
            ]
        if label:
            self.ends.append((places[-1][1], places[-1][0], label, colour))

    def steps(self, bins, colour, style=""):
        """A histogram's outline."""
        base = self.height - self.bottom
        path = f"M{self.x(bins[0][0]):.1f} {base}"
        for low, high, share in bins:
            y = max(self.y(share), self.top)
            path += f"V{y:.1f}H{self.x(high):.1f}"
        self.parts.append(f'<path class="line {style}" style="stroke:var(--{colour})" d="{path}V{base}"/>')

    def key(self, entries, x=None, y=None):
        """Labels with their colours inside the panel, from the right top downwards."""
        x = x if x is not None else self.width - self.right - 4
        y = y if y is not None else self.top + 12
        for i, (label, colour) in enumerate(entries):
            self.parts.append(
                f'<text class="label" style="fill:var(--{colour})" x="{x:.0f}" y="{y + 14 * i:.0f}" '
                f'text-anchor="end">{escape(label)}</text>'
            )

    def annotate(self, x, y, text, dx=5, dy=-5, anchor="start"):
        self.parts.append(
            f'<text class="note" x="{self.x(x) + dx:.1f}" y="{self.y(y) + dy:.1f}" '
            f'text-anchor="{anchor}">{escape(text)}</text>'
        )

    def svg(self, x=0, y=0):
        self.place_labels()
        return f'<g transform="translate({x} {y})">' + "".join(self.parts) + "</g>"

    def place_labels(self):
        """End labels to the right of the panel, moved apart, each with a thin line to its curve's end."""
        gap = 13
        ends = sorted(self.ends)
        places = [max(self.top + 6, end[0]) for end in ends]
        for i in range(1, len(places)):
            places[i] = max(places[i], places[i - 1] + gap)
        lowest = self.height - self.bottom - 2
        for i in range(len(places) - 1, -1, -1):
            limit = lowest if i == len(places) - 1 else places[i + 1] - gap
            places[i] = min(places[i], limit)
        edge = self.width - self.right
        for (y, x, label, colour), place in zip(ends, places):
            self.parts.append(
                f'<path class="leader" style="stroke:var(--{colour})" '
                f'd="M{x + 3:.1f} {y:.1f}L{edge + 6} {place:.1f}"/>'
            )
            self.parts.append(
                f'<text class="label" style="fill:var(--{colour})" x="{edge + 9}" '
                f'y="{place + 3.8:.1f}">{escape(label)}</text>'
            )
        self.ends = []


def figure(width, height, parts, description):
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img" '
        f'aria-label="{escape(description, quote=True)}"><title>{escape(description)}</title>'
        + "".join(parts)
        + "</svg>"
    )
