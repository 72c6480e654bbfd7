#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes one self-contained page, and an SVG file for each figure, of what `cpp-bench/run --report`
has measured.

    cpp-bench/report/page/page.py [RESULTS]

Writes RESULTS/report/index.html and RESULTS/report/figure_N.svg. The page needs nothing but a browser. The
interpreter is Debian's, as Debian's packages of Jinja2 and matplotlib are for that one alone.
"""

import os
import sys

import jinja2

from data import Results
from figures import FIGURES
from published import INPUT_TITLES, INPUTS, MAN_PLACEMENT_NOTE
from section_6 import section_6
from tables import table
from words import count, listed, span, times

HERE = os.path.dirname(os.path.abspath(__file__))

ENVIRONMENT = ("processor", "memory", "system", "compiler", "rust compiler")
ENVIRONMENT += ("CGAL", "deldrift", "commit", "date", "command")

TEMPLATES = jinja2.Environment(
    loader=jinja2.FileSystemLoader(HERE),
    autoescape=jinja2.select_autoescape(),
    trim_blocks=True,
    lstrip_blocks=True,
    keep_trailing_newline=True,
    undefined=jinja2.StrictUndefined,
)
TEMPLATES.filters.update(count=count, listed=listed, span=span, times=times)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(HERE, "..", "..", "results")
    results = Results(folder)
    target = os.path.join(folder, "report")
    os.makedirs(target, exist_ok=True)
    figures = [drawn(n, title, make(results)) for n, title, make in FIGURES]
    for figure in figures:
        if figure["svg"]:
            write(os.path.join(target, f"figure_{figure['number']}.svg"), alone(figure["svg"]))
    path = os.path.join(target, "index.html")
    write(path, page(results, figures))
    print(f"written: {os.path.relpath(path)}")


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def drawn(number, title, made):
    svg, then, now = made or (None, None, None)
    return {"number": number, "title": title, "svg": svg, "then": then, "now": now}


def alone(svg):
    """With its own style, and a ground."""
    style = TEMPLATES.get_template("plot.css").render()
    ground = '<rect width="100%" height="100%" style="fill:var(--ground)"/>'
    return svg.replace(">", f">\n<style>\n{style}</style>\n{ground}", 1) + "\n"


def page(results, figures):
    return TEMPLATES.get_template("page.html").render(
        best=lambda engine: best(results, engine),
        is_full=results.state.get("preset") == "full" and results.state.get("timestamps") == "0",
        preset=results.state.get("preset", "unknown"),
        sizes=sizes(results),
        environment=[(name, results.environment[name]) for name in ENVIRONMENT if name in results.environment],
        tables=[table(results, which) for which in (0, 1)],
        misprint=MAN_PLACEMENT_NOTE,
        figures=figures,
        section_6=section_6(),
        n_compared=sum(int(r["compared_timestamps"]) for r in results.checks),
        wrong=wrong(results),
    )


def best(results, engine):
    """The greatest speed-up on each input."""
    speedups = []
    for scenario in INPUTS:
        of_algorithms = [
            float(r["speedup_vs_cgal_rebuild"])
            for r in results.rows
            if (r["scenario"], r["engine"]) == (scenario, engine)
            and r["algorithm"] != "rebuilding"
            and (int(r["first_timestamp"]), int(r["last_timestamp"])) == results.range(scenario, 0)
        ]
        speedups += [max(of_algorithms)] if of_algorithms else []
    return speedups


def sizes(results):
    """The inputs of each size."""
    by_size = {}
    for scenario in INPUTS:
        if results.size(scenario):
            size = f"{count(results.size(scenario))} points and {results.range(scenario, 0)[1]} iterations"
            by_size.setdefault(size, []).append(INPUT_TITLES[scenario])
    return by_size


def wrong(results):
    """How many cells an algorithm has wrongly taken for Delaunay, where it has."""
    found = []
    for r in results.checks:
        n = int(r["cells_wrongly_taken_for_delaunay"])
        if n > 0:
            found.append({"name": f"{INPUT_TITLES.get(r['scenario'], r['scenario'])}, {r['algorithm']}", "n": n})
    return found


if __name__ == "__main__":
    main()
