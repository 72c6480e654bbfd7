# SPDX-License-Identifier: GPL-3.0-or-later
"""The algorithms: names, colours, and in which order they are shown."""

import os
import re


def algorithms():
    """(name, purpose) of the algorithms of deldrift."""
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src", "algorithms.inc")
    with open(path, encoding="utf-8") as file:
        return re.findall(r"^ALGORITHM\((\w+), \d+, (\w+),", file.read(), re.MULTILINE)


NAMES = {name: name.replace("_", " ") for name, _ in algorithms()}
NAMES.update(
    move="move_if_no_collision",
    placement_flips="placement with flips",
    safe_region="S",
    tolerance="T",
    safe_region_tolerance="S+T",
    rebuilding_tolerance="rebuilding+T",
)

LONG_NAMES = dict(
    NAMES, safe_region="S, safe region", tolerance="T, tolerance", safe_region_tolerance="S+T, both"
)

COLOURS = {
    "rebuilding": "rebuilding",
    "placement": "placement",
    "move": "move",
    "placement_flips": "placement",
    "safe_region": "safe",
    "tolerance": "tolerance",
    "safe_region_tolerance": "both",
    "rebuilding_tolerance": "switch",
    "repair": "repair",
    "auto": "auto",
}

# What the report's figures have, and the same for deldrift.
CGAL = [
    "rebuilding",
    "placement",
    "safe_region",
    "tolerance",
    "safe_region_tolerance",
    "rebuilding_tolerance",
]
DELDRIFT = CGAL + ["repair", "auto"]

TABLE_CGAL = CGAL[:2] + ["move"] + CGAL[2:]
TABLE_DELDRIFT = [name for name, purpose in algorithms() if purpose != "internal"]
