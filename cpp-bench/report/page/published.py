# SPDX-License-Identifier: GPL-3.0-or-later
"""What the report RR-6750 itself published. Nothing else on the page is written down by hand."""

INPUTS = ["lloyd_2d_uniform", "lloyd_2d_r2", "lloyd_2d_x2", "lloyd_2d_sin2", "slloyd", "snodt", "man"]

INPUT_TITLES = {
    "lloyd_2d_uniform": "ρ = 1",
    "lloyd_2d_r2": "ρ = x² + y²",
    "lloyd_2d_x2": "ρ = x²",
    "lloyd_2d_sin2": "ρ = sin²√(x² + y²)",
    "slloyd": "slloyd",
    "snodt": "snodt",
    "man": "man",
}

# Speed-ups over rebuilding, iterations 1 to 1000 and 500 to 1000.
TABLE_1 = {
    "rebuilding": [1, 1, 1, 1, 1, 1, 1],
    "placement": [0.38, 0.38, 0.38, 0.36, 0.12, 0.19, None],
    "safe_region": [2.55, 1.53, 1.50, 1.76, 0.36, 0.73, 0.58],
    "tolerance": [6.10, 2.43, 2.24, 2.82, 0.61, 1.52, 1.29],
    "safe_region_tolerance": [3.27, 1.56, 1.52, 1.81, 0.38, 0.88, 0.57],
    "rebuilding_tolerance": [6.80, 2.62, 2.50, 3.08, 1.00, 1.72, 1.51],
}
TABLE_2 = {
    "rebuilding": [1, 1, 1, 1, 1, 1, 1],
    "placement": [0.38, 0.38, 0.37, 0.36, 0.12, 0.18, 0.15],
    "tolerance": [11.50, 3.97, 4.79, 5.03, 0.76, 2.42, 2.25],
}
MAN_PLACEMENT_NOTE = "Table 1 prints 1.00 for placement on man; Table 2's 0.15 shows that this is a misprint."

# Figure 7 (c): two and three dimensions.
FIGURE_7 = {
    "mean_width": (0.255, 0.126),
    "mean_tolerance": (0.014, 0.002),
    "mean_widest": (0.610, 0.742),
    "bicells_per_vertex": (12.0, 66.3),
}
