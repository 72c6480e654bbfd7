# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of docs/FUTURE_WORK.md."""

import os

FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "docs", "FUTURE_WORK.md")


def section_6():
    """The cells of the head, and of each row."""
    with open(FILE, encoding="utf-8") as file:
        lines = [line.strip() for line in file if line.startswith("|")]
    head, _, *rows = [[cell.strip() for cell in line.replace("`", "").strip("|").split("|")] for line in lines]
    return {"head": head, "rows": rows}
