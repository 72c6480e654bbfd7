"""Fixtures, and the count of scipy's own tests at the end."""

import collections

import numpy as np
import pytest


@pytest.fixture
def rng():
    return np.random.default_rng(20261126)


@pytest.fixture(params=[2, 3])
def ndim(request):
    return request.param


def pytest_terminal_summary(terminalreporter):
    for outcome, reports in sorted(terminalreporter.stats.items()):
        count = sum(1 for report in reports if "test_scipy_suite" in getattr(report, "nodeid", ""))
        if outcome in ("passed", "failed", "skipped") and count:
            terminalreporter.write_line(f"scipy's own tests: {count} {outcome}")
    reasons = collections.Counter()
    for report in terminalreporter.stats.get("skipped", []):
        reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
        if "WAIVED" not in reason:
            reasons[reason.replace("Skipped: ", "")] += 1
    for reason, count in sorted(reasons.items()):
        terminalreporter.write_line(f"SKIPPED python: {count} of its tests: {reason}")
