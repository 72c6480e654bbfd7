# SPDX-License-Identifier: GPL-3.0-or-later
"""The algorithms: names, colours, and in which order they are shown."""

NAMES = {
    "rebuilding": "rebuilding",
    "placement": "placement",
    "move": "move_if_no_collision",
    "placement_flips": "placement with flips",
    "safe_region": "S",
    "tolerance": "T",
    "safe_region_tolerance": "S+T",
    "rebuilding_tolerance": "rebuilding+T",
    "repair": "repair",
    "auto": "auto",
}

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

TABLE_CGAL = [
    "rebuilding",
    "placement",
    "move",
    "safe_region",
    "tolerance",
    "safe_region_tolerance",
    "rebuilding_tolerance",
]
TABLE_DELDRIFT = [
    "rebuilding",
    "placement",
    "placement_flips",
    "safe_region",
    "tolerance",
    "safe_region_tolerance",
    "rebuilding_tolerance",
    "repair",
    "auto",
]
