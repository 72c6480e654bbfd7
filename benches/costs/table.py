"""docs/COSTS.md, from the rows of cpp-bench/results/costs.csv."""

import math
from collections import defaultdict

COLUMNS = ("set", "dimension", "n", "function", "what", "status", "seconds", "units", "asks", "longest_gap",
           "size", "held_bytes", "peak_bytes")
# The set of many random points, where the time between callbacks is measured.
LARGE = "large"
# Exponents above it are marked ...
BOUND = 1.3
# ... unless a vertex or cell costs less than this: caches, and cells that get flatter the more there are.
LEAST_SECONDS_EACH, LEAST_BYTES_EACH = 1e-6, 1000
# Less than this tells nothing of an exponent.
LEAST = {"seconds": 0.002, "held_bytes": 8e6, "peak_bytes": 8e6}
# The longest time that a call may take between two callbacks.
LONGEST_GAP = 0.1


class Cell:
    """A row and column of the table: a call on a set, at ascending sizes."""

    def __init__(self, rows):
        self.rows = sorted(rows, key=lambda row: int(row["n"]))
        self.status = self.rows[-1]["status"]
        self.good = [row for row in self.rows if row["status"] == "ok"][-3:]

    def seconds(self):
        return float(self.good[-1]["seconds"]) if self.good else 0.0

    def each(self, value):
        return float(self.good[-1][value]) / units(self.good[-1], value)

    def exponent(self, value="seconds"):
        """Of what is read and written. Of the one between the last two sizes and the one over all three it is the
        lower one, as noise moves either; None where numbers are too small to tell."""
        if len(self.good) < 2 or float(self.good[-1][value]) < LEAST[value]:
            return None
        last, found = self.good[-1], []
        for before in self.good[0], self.good[-2]:
            more = units(last, value) / units(before, value)
            if more > 1.2:
                found.append(math.log(float(last[value]) / max(1e-9, float(before[value]))) / math.log(more))
        return min(found, default=None)

    def grows_too_fast(self, value, least):
        return (self.exponent(value) or 0) > BOUND and self.each(value) > least

    def is_marked(self):
        return (self.status != "ok" or self.grows_too_fast("seconds", LEAST_SECONDS_EACH)
                or any(self.grows_too_fast(value, LEAST_BYTES_EACH) for value in ("held_bytes", "peak_bytes")))

    def gap_is_too_long(self):
        return bool(self.good) and max(float(row["longest_gap"]) for row in self.good) > LONGEST_GAP

    def text(self):
        if self.status == "too_long":
            return f"**too long at {int(self.rows[-1]['n']):,}**"
        if self.status != "ok":
            return f"**{self.status}**"
        exponent = self.exponent()
        if exponent is None:
            return "·"
        return f"**{exponent:.1f}**" if self.is_marked() else f"{exponent:.1f}"


def units(row, value):
    """What a value should be in proportion to."""
    return max(1.0, float(row["units" if value == "seconds" else "size"]))


def cells(rows):
    """By function, what it is called for, set and dimension."""
    groups = defaultdict(list)
    for row in rows:
        groups[row["function"], row["what"], row["set"], row["dimension"]].append(row)
    return {key: Cell(group) for key, group in groups.items()}


def three_digits(number):
    return f"{number:.3g}" if number < 1000 else f"{number:,.0f}"


def marked_rows(rows):
    yield "| function | for | set | n: time, longest time without a callback | time | held | peak |"
    yield "|---|---|---|---|--:|--:|--:|"
    for (function, what, name, dimension), cell in cells(rows).items():
        if not cell.is_marked():
            continue
        sizes = "; ".join(f"{int(row['n']):,}: {size_text(row)}" for row in cell.rows[-3:])
        exponents = (cell.exponent(value) for value in ("seconds", "held_bytes", "peak_bytes"))
        numbers = " | ".join("·" if exponent is None else f"{exponent:.2f}" for exponent in exponents)
        yield f"| `{function}` | {what} | {name}, {dimension}D | {sizes} | {numbers} |"


def size_text(row):
    if row["status"] != "ok":
        return row["status"].replace("_", " ")
    return f"{three_digits(1e3 * float(row['seconds']))} ms, {three_digits(1e3 * float(row['longest_gap']))} ms"


def exponents(rows, dimension):
    table = {key: cell for key, cell in cells(rows).items() if key[3] == dimension and key[2] != LARGE}
    names = list(dict.fromkeys(key[2] for key in table))
    yield "| function | for | " + " | ".join(name.replace("_", " ") for name in names) + " | most, ns each |"
    yield "|---|---" + "|--:" * (len(names) + 1) + "|"
    for function, what in dict.fromkeys(key[:2] for key in table):
        row = [table.get((function, what, name, dimension)) for name in names]
        most = max((1e9 * cell.each("seconds") for cell in row if cell and cell.good), default=0)
        texts = " | ".join(cell.text() if cell else "" for cell in row)
        yield f"| `{function}` | {what} | {texts} | {three_digits(most)} |"


def callbacks(rows):
    yield "| function | for | 2D: time | calls | longest gap | 3D: time | calls | longest gap |"
    yield "|---|---|--:|--:|--:|--:|--:|--:|"
    table = {key: cell for key, cell in cells(rows).items() if key[2] == LARGE}
    for function, what in dict.fromkeys(key[:2] for key in table):
        texts = [callback_text(table.get((function, what, LARGE, dimension))) for dimension in "23"]
        yield f"| `{function}` | {what} | {' | '.join(texts)} |"


def callback_text(cell):
    if cell is None:
        return " | | "
    row = cell.rows[-1]
    if row["status"] != "ok":
        return f"**{row['status'].replace('_', ' ')}** | | "
    gap = f"{three_digits(1e3 * float(row['longest_gap']))} ms"
    asks = three_digits(float(row["asks"]))
    return f"{three_digits(1e3 * float(row['seconds']))} ms | {asks} | {f'**{gap}**' if cell.gap_is_too_long() else gap}"


def page(rows, environment):
    sizes = {dimension: {row["n"] for row in rows if row["set"] == LARGE and row["dimension"] == dimension}
             for dimension in "23"}
    many = [f"{int(min(sizes[dimension], key=int)):,}" if sizes[dimension] else "no" for dimension in "23"]
    return f"""# Costs

How the time of every function of the [header](../include/deldrift.h) grows with the size, on sets of points that are
hard for a triangulation. `make costs` measures and writes it; the rows are in
[costs.csv](../cpp-bench/results/costs.csv). Commit {environment["commit"]}, {environment["date"]}, one thread on
{environment["processor"]}.

An exponent is that of time, by what a call reads and writes, in vertices and cells: 1 is in proportion, 2 would be
quadratic. Sets with n²/2 cells (the moment curve) or n²/4 (two skew lines) in space so are not blamed for their cells.
It is measured at three sizes, each twice the one before. Marked, in bold, is what is above {BOUND}, at five sizes, and
where a vertex or cell takes more than a microsecond; · is where no size took {1e3 * LEAST["seconds"]:.0f} ms. Time is that
of a processor. "Most, ns each" is the time for a vertex or cell at the last size, on the slowest of the sets. Calls on
one vertex are made for one vertex in eight, one after the other, and their input and output is the cells created and
removed. Every call runs in a process of its own, which is ended where it takes too long. Sets are described in
[sets.hpp](../benches/costs/sets.hpp).

## What is marked

{chr(10).join(marked_rows(rows))}

## Exponents in the plane

{chr(10).join(exponents(rows, "2"))}

## Exponents in space

{chr(10).join(exponents(rows, "3"))}

## Callbacks

How often the callbacks of the options are called in calls on {many[0]} random points in the plane and {many[1]} in space,
and the longest time of one call without. Marked is what is above {1e3 * LONGEST_GAP:.0f} ms.

{chr(10).join(callbacks(rows))}
"""
