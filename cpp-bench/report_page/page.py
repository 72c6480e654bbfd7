#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes one self-contained page, and an SVG file for each figure, of what `cpp-bench/run --report`
has measured.

    cpp-bench/report_page/page.py [RESULTS]

Writes RESULTS/report/index.html and RESULTS/report/figure_N.svg. Nothing but Python's standard library is
needed, and the page needs nothing but a browser.
"""

import os
import sys
from html import escape

import style
from data import Results
from figures import FIGURES
from published import INPUT_TITLES, INPUTS
from tables import sentences, table
from words import count, listed, span


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.join(here, "..", "results")
    results = Results(folder)
    target = os.path.join(folder, "report")
    os.makedirs(target, exist_ok=True)
    drawn = [(n, title, made) for n, title, make in FIGURES for made in [make(results)]]
    for n, _, made in drawn:
        if made:
            write(os.path.join(target, f"figure_{n}.svg"), alone(made[0]))
    path = os.path.join(target, "index.html")
    write(path, page(results, drawn))
    print(f"written: {os.path.relpath(path)}")


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def alone(svg):
    """With its own style, and a ground."""
    start = svg.index(">") + 1
    return (
        svg[:start]
        + f"<style>{style.themed()}{style.PLOT}</style>"
        '<rect width="100%" height="100%" style="fill:var(--ground)"/>'
        + svg[start:]
        + "\n"
    )


def then_now(then, now):
    return (
        f'<span class="then"><b>The report:</b> {escape(then)}</span>'
        f'<span class="now"><b>Here:</b> {escape(now)}</span>'
    )


def page(results, drawn):
    links = ['<a href="#table-1">Table 1</a>', '<a href="#table-2">Table 2</a>']
    links += [f'<a href="#figure-{n}">Figure {n}</a>' for n, _, _ in drawn]
    body = [
        "<h1>Delaunay triangulations for moving points, repeated</h1>",
        lead(results),
        scaled_down(results),
        environment(results),
        f"<nav>{''.join(links)}</nav>",
    ]
    for which in (0, 1):
        part = ("all iterations", "the second half of the iterations")[which]
        body.append(f"<h2>Table {which + 1}: speed-up over rebuilding, {part}</h2>")
        body.append(f"<p>{then_now(*sentences(results, which))}</p>")
        body.append(table(results, which))
    for n, title, made in drawn:
        body.append(f"<h2>Figure {n}: {escape(title)}</h2>")
        if made:
            body.append(
                f'<figure id="figure-{n}">{made[0]}<figcaption>{then_now(*made[1:])}</figcaption></figure>'
            )
        else:
            body.append(f'<p class="small" id="figure-{n}">Its input has not been measured in this run.</p>')
    body.append(method(results))
    return (
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8">'
        '<meta name="viewport" content="width=device-width,initial-scale=1">'
        '<link rel="icon" href="data:,">'
        "<title>RR-6750 repeated: deldrift beside CGAL</title>"
        f"<style>{style.themed()}{style.PLOT}{style.PAGE}</style></head><body>"
        + "\n".join(body)
        + "</body></html>\n"
    )


def lead(results):
    def best(engine):
        value = []
        for scenario in INPUTS:
            rows = [
                r
                for r in results.rows
                if r["scenario"] == scenario and r["engine"] == engine and r["algorithm"] != "rebuilding"
            ]
            whole = [
                float(r["speedup_vs_cgal_rebuild"])
                for r in rows
                if (int(r["first_timestamp"]), int(r["last_timestamp"])) == results.range(scenario, 0)
            ]
            if whole:
                value.append(max(whole))
        return value

    return (
        '<p class="lead">Points move a little at every timestamp; how does one update their Delaunay'
        " triangulation "
        "faster than by rebuilding it? In 2008 the INRIA report "
        '<a href="https://inria.hal.science/inria-00344053">RR-6750</a> answered: give every vertex a'
        " certified "
        "<em>tolerance</em> within which it may move and nothing changes. Here its inputs are recorded again"
        " and replayed, "
        "with identical positions, to CGAL, to the report's algorithms on CGAL's triangulations, and to"
        " deldrift.</p>"
        f'<p class="lead">The best algorithm on CGAL other than rebuilding is {span(best("cgal"))} times as'
        " fast as "
        f"rebuilding with CGAL, depending on the input; deldrift's best, {span(best('deldrift'))} times.</p>"
    )


def scaled_down(results):
    if results.state.get("preset") == "full" and results.state.get("timestamps") == "0":
        return ""
    by_size = {}
    for scenario in INPUTS:
        if results.size(scenario):
            size = f"{count(results.size(scenario))} points and {results.range(scenario, 0)[1]} iterations"
            by_size.setdefault(size, []).append(INPUT_TITLES[scenario])
    sizes = "; ".join(f"{listed(names)}: {size}" for size, names in by_size.items())
    return (
        f'<p class="warning"><b>Scaled down</b> (preset {escape(results.state.get("preset", "unknown"))}):'
        f" {sizes}. <code>make report PRESET=full</code> has the report's sizes.</p>"
    )


def environment(results):
    entries = "".join(
        f"<dt>{escape(name)}</dt><dd>{escape(results.environment[name])}</dd>"
        for name in (
            "processor",
            "memory",
            "system",
            "compiler",
            "rust compiler",
            "CGAL",
            "deldrift",
            "commit",
            "date",
            "command",
        )
        if name in results.environment
    )
    return f"<dl>{entries}</dl>"


def method(results):
    compared = sum(int(r["compared_timestamps"]) for r in results.checks)
    wrong = sum(int(r["cells_wrongly_taken_for_delaunay"]) for r in results.checks)
    wrongly = [
        f"{INPUT_TITLES.get(r['scenario'], r['scenario'])}, {r['algorithm']}: "
        f"{count(int(r['cells_wrongly_taken_for_delaunay']))}"
        for r in results.checks
        if int(r["cells_wrongly_taken_for_delaunay"])
    ]
    gap = (
        "No such cell was met in this run."
        if wrong == 0
        else f"{count(wrong)} such cells were met at the timestamps compared ({'; '.join(wrongly)})."
    )
    return f"""<h2>How it is measured</h2>
<ul>
<li>Only the update is on the clock: from the call that hands over positions to the triangulation at these
positions. One thread. Engines take turns in blocks of consecutive timestamps.</li>
<li>In the last group of either table the step is on the clock: the update, then both arrays of the cells (corners
and neighbours) and, for deldrift, what has changed. CGAL's step is its rebuilding, and the writing of the two
arrays, timed apart at ten timestamps.</li>
<li>Cells were compared with those of CGAL's rebuilding {count(compared)} times in all, at timestamps spread
over every input, right after the update that was timed. A difference ends the run, unless exact arithmetic
finds the points exactly cospherical.</li>
<li>One difference is counted instead: in space the report's Proposition 1 does not hold where the line
through the opposing vertices of a bi-cell misses its facet, so that its algorithms may keep a cell that is
no longer Delaunay. {gap} deldrift adds a bound that excludes them.</li>
<li>The report leaves out the hull. Its algorithms on CGAL hold the vertices of hull cells by half the least
width of their d + 1 points, so that the result is the Delaunay triangulation there as well. Static filters
are those of its section 4.</li>
<li>snodt and man move one vertex after another, and every engine relocates it at once; engines that rebuild
do so once for each sweep, as in the report. Vertices on the boundary stay.</li>
<li>In space, engines without tolerances that relocate every vertex are timed at a sample of the iterations
(*), and the speed-up is over CGAL's rebuilding at the same ones.</li>
<li>Spacings are the unit of length at which there is one point per unit of area or volume on average.</li>
</ul>
<p class="small">The numbers behind the page are in report.csv and the files beside it; cpp-bench/README.md
has the rest.</p>"""


if __name__ == "__main__":
    main()
