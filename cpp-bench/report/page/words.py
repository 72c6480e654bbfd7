# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in sentences, and what is read off curves."""

import math


def times(value):
    """A speed-up, to two or three digits."""
    if value is None:
        return "–"
    if value >= 100:
        return f"{value:.0f}"
    return f"{value:.1f}" if value >= 20 else f"{value:.2f}"


def percent(share, digits=0):
    return f"{100 * share:.{digits}f}\u00a0%"


def span(values, text=times):
    values = [v for v in values if v is not None]
    if not values:
        return "not measured"
    low, high = text(min(values)), text(max(values))
    return low if low == high else f"{low} to {high}"


def listed(items):
    items = list(items)
    if len(items) < 2:
        return "".join(items)
    return ", ".join(items[:-1]) + " and " + items[-1]


def count(n):
    return f"{n:,}"


def crossing(a, b):
    """The x at which curve a passes curve b, by interpolation of log y; None where it never does."""
    common = sorted(set(x for x, _ in a) & set(x for x, _ in b))
    a, b = dict(a), dict(b)
    excess = [(x, math.log(a[x] / b[x])) for x in common]
    for (x0, d0), (x1, d1) in zip(excess, excess[1:]):
        if d0 * d1 <= 0 and d0 != d1:
            return x0 + (x1 - x0) * d0 / (d0 - d1)
    return None
