# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours and type of the page and of the SVG files beside it.

The hues are those of Okabe and Ito, which people with any of the usual colour deficiencies can tell
apart, made darker for a light ground and lighter for a dark one. Every line is labelled as well.
"""

LIGHT = {
    "ink": "#1d2530",
    "muted": "#5b6672",
    "grid": "#e3e7ec",
    "axis": "#8d97a3",
    "ground": "#ffffff",
    "panel": "#f6f8fa",
    "rule": "#d5dbe1",
    "rebuilding": "#1d2530",
    "placement": "#7a7f87",
    "move": "#9aa0a8",
    "safe": "#b85c00",
    "both": "#9a7400",
    "tolerance": "#0062a8",
    "switch": "#00795a",
    "repair": "#6a4fb3",
    "auto": "#a2437f",
    "better": "#e4f1ea",
    "one": "#0062a8",
    "two": "#b85c00",
    "three": "#00795a",
    "four": "#a2437f",
}
DARK = {
    "ink": "#e8ecf1",
    "muted": "#a3adb8",
    "grid": "#2b323b",
    "axis": "#6f7a86",
    "ground": "#14181d",
    "panel": "#1b2027",
    "rule": "#353d47",
    "rebuilding": "#e8ecf1",
    "placement": "#9aa3ae",
    "move": "#7d8692",
    "safe": "#f09a4a",
    "both": "#d9bb4a",
    "tolerance": "#62b4f0",
    "switch": "#3fc79c",
    "repair": "#b39af0",
    "auto": "#e08fc2",
    "better": "#173427",
    "one": "#62b4f0",
    "two": "#f09a4a",
    "three": "#3fc79c",
    "four": "#e08fc2",
}


def variables(colours):
    return "".join(f"--{name}:{value};" for name, value in colours.items())


def themed():
    return (
        f":root{{color-scheme:light dark;{variables(LIGHT)}}}"
        f"@media(prefers-color-scheme:dark){{:root{{{variables(DARK)}}}}}"
    )


FONT = "system-ui,-apple-system,'Segoe UI',Roboto,'Helvetica Neue',Arial,'DejaVu Sans',sans-serif"

PLOT = (
    f"svg{{font-family:{FONT};font-size:11px}}"
    ".grid{stroke:var(--grid);stroke-width:1}"
    ".axis{stroke:var(--axis);stroke-width:1}"
    ".tick{fill:var(--muted);font-size:10.5px}"
    ".axis-label{fill:var(--muted);font-size:11px}"
    ".panel-title{fill:var(--ink);font-size:12.5px;font-weight:600}"
    ".label{font-size:11px;font-weight:600}"
    ".note{fill:var(--muted);font-size:10.5px}"
    ".line{fill:none;stroke-width:1.8;stroke-linejoin:round;stroke-linecap:round}"
    ".line.dashed{stroke-dasharray:5 4}"
    ".line.dotted{stroke-dasharray:1 4}"
    ".leader{fill:none;stroke-width:.7;opacity:.6}"
    ".point{fill:var(--ink)}"
    ".frame{fill:none;stroke:var(--rule);stroke-width:1}"
)

PAGE = (
    "html{background:var(--ground);color:var(--ink)}"
    f"body{{font:16px/1.55 {FONT};max-width:1100px;margin:0 auto;padding:28px 20px 80px}}"
    "h1{font-size:30px;line-height:1.2;margin:.4em 0 .2em}"
    "h2{font-size:21px;margin:2.2em 0 .5em;padding-top:.6em;border-top:1px solid var(--rule)}"
    "p{max-width:74ch;margin:.5em 0}"
    ".lead{font-size:18px}.small{font-size:14px;color:var(--muted)}"
    ".warning{border-left:4px solid var(--safe);background:var(--panel);padding:.5em 1em;max-width:74ch}"
    "figure{margin:1em 0}figure svg{width:100%;height:auto;display:block}"
    "figcaption{max-width:78ch;margin-top:.5em}figcaption b{font-weight:650}"
    ".then,.now{display:block}.then{color:var(--muted)}"
    ".scroll{overflow-x:auto}"
    "table{border-collapse:collapse;font-size:14.5px;font-variant-numeric:tabular-nums;margin:.8em 0}"
    "caption{text-align:left;color:var(--muted);font-size:14px;padding-bottom:.4em}"
    "th,td{padding:4px 11px;text-align:right;border-bottom:1px solid var(--rule);white-space:nowrap}"
    "th:first-child,td:first-child{text-align:left;padding-left:4px}"
    "thead th{font-weight:600;vertical-align:bottom}"
    "tr.group th{text-align:left;padding-top:14px;color:var(--muted);font-weight:600;white-space:normal}"
    "td.faster{font-weight:700;background:var(--better)}"
    "td.none{color:var(--muted)}"
    "dl{display:grid;grid-template-columns:max-content 1fr;gap:2px 16px;font-size:14.5px}"
    "dt{color:var(--muted)}dd{margin:0}"
    "code{font-size:.92em}li{max-width:74ch}a{color:var(--tolerance)}"
    "nav{font-size:14.5px;margin:1em 0}nav a{margin-right:12px;white-space:nowrap}"
)
