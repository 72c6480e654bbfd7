# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what `cpp-bench/run --report` has written."""

import csv
import os


def read(folder, name):
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text not in (None, "") else None


class Results:
    """The files of one run, by scenario and engine."""

    def __init__(self, folder):
        self.rows = read(folder, "report.csv")
        self.statistics = read(folder, "report_statistics.csv")
        self.segments = read(folder, "report_segments.csv")
        self.distributions = read(folder, "report_distributions.csv")
        self.points = read(folder, "report_points.csv")
        self.sections = read(folder, "report_sections.csv")
        self.curves = read(folder, "report_curves.csv")
        self.steps = read(folder, "report_steps.csv")
        self.checks = read(folder, "report_checks.csv")
        self.environment = pairs(os.path.join(folder, "environment_report.txt"))
        self.state = pairs(os.path.join(folder, "report_state.txt"))
        if not self.rows:
            raise SystemExit(f"error: there is no report.csv in {folder}: run `cpp-bench/run --report` first")

    def row(self, scenario, engine, algorithm, which):
        """The row of a whole input (`which` 0) or its second half (1); None where not measured."""
        rows = [
            r
            for r in self.rows
            if (r["scenario"], r["engine"], r["algorithm"]) == (scenario, engine, algorithm)
        ]
        return rows[which] if len(rows) > which else None

    def speedup(self, scenario, engine, algorithm, which):
        row = self.row(scenario, engine, algorithm, which)
        return float(row["speedup_vs_cgal_rebuild"]) if row else None

    def step_speedup(self, scenario, which):
        """Of auto's step over CGAL's; None where not measured."""
        rows = [r for r in self.steps if r["scenario"] == scenario]
        return float(rows[which]["speedup_vs_cgal_step"]) if len(rows) > which else None

    def range(self, scenario, which):
        row = self.row(scenario, "cgal", "rebuilding", which)
        return (int(row["first_timestamp"]), int(row["last_timestamp"])) if row else None

    def size(self, scenario):
        row = self.row(scenario, "cgal", "rebuilding", 0)
        return int(row["n"]) if row else None

    def curve(self, scenario, engine, algorithm):
        """(middle of the bin, ns per vertex) of an input that iterates."""
        return [
            (
                (int(r["first_timestamp"]) * int(r["last_timestamp"])) ** 0.5,
                float(r["ns_per_vertex_timestamp"]),
            )
            for r in self.curves
            if (r["scenario"], r["engine"], r["algorithm"]) == (scenario, engine, algorithm)
        ]

    def sweep(self, scenario, engine, algorithm, x):
        """(x, ns per vertex) of an input of segments, x being a column of report_segments.csv."""
        of_segment = {
            (r["first_timestamp"], r["last_timestamp"]): float(r[x])
            for r in self.segments
            if r["scenario"] == scenario
        }
        points = [
            (of_segment[r["first_timestamp"], r["last_timestamp"]], float(r["ns_per_vertex_timestamp"]))
            for r in self.rows
            if (r["scenario"], r["engine"], r["algorithm"]) == (scenario, engine, algorithm)
            and (r["first_timestamp"], r["last_timestamp"]) in of_segment
        ]
        return sorted(points)

    def statistic(self, scenario, column, x="timestamp"):
        pairs_ = [(number(r[x]), number(r.get(column))) for r in self.statistics if r["scenario"] == scenario]
        return [(a, b) for a, b in pairs_ if a is not None and b is not None]

    def distribution(self, scenario, timestamp, quantity):
        """(from, to, share) of every bin."""
        return [
            (float(r["from"]), float(r["to"]), float(r["share"]))
            for r in self.distributions
            if (r["scenario"], r["timestamp"], r["quantity"]) == (scenario, str(timestamp), quantity)
        ]

    def shown(self, scenario):
        """The timestamps that have distributions."""
        return sorted({int(r["timestamp"]) for r in self.distributions if r["scenario"] == scenario})


def pairs(path):
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as file:
        return dict(line.rstrip("\n").split(": ", 1) for line in file if ": " in line)
