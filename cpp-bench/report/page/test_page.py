#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures small inputs, makes the page and opens it in headless Chromium.

    cpp-bench/report/page/test_page.py [PAGE]

With the path of a page, only that page is looked at. Without a Chromium, and only then, the browser's part
is skipped.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree

import browser

HERE = os.path.dirname(os.path.abspath(__file__))

# Runs in the page, into which it is put for the test alone: what can be seen of every figure.
PROBE = """<script>
window.addEventListener('load', () => {
  const figures = {};
  for (const figure of document.querySelectorAll('figure')) {
    const svg = figure.querySelector('svg');
    const texts = [...svg.querySelectorAll('text')].map(
      t => ({text: t.textContent, box: t.getBoundingClientRect()}));
    const frame = svg.getBoundingClientRect();
    const overlaps = [], outside = [];
    texts.forEach((a, i) => {
      if (a.box.left < frame.left - 1 || a.box.right > frame.right + 1 || a.box.top < frame.top - 1 ||
          a.box.bottom > frame.bottom + 1) outside.push(a.text);
      texts.slice(i + 1).forEach(b => {
        const x = Math.min(a.box.right, b.box.right) - Math.max(a.box.left, b.box.left);
        const y = Math.min(a.box.bottom, b.box.bottom) - Math.max(a.box.top, b.box.top);
        if (x > 1 && y > 3) overlaps.push(a.text + ' | ' + b.text);
      });
    });
    figures[figure.id] = {
      width: frame.width, height: frame.height, overlaps, outside,
      drawn: svg.querySelectorAll('path[d], line, circle, rect').length,
      labels: [...svg.querySelectorAll('.axis-label')].filter(t => t.getBoundingClientRect().width > 0)
        .map(t => t.textContent),
      broken: [...svg.querySelectorAll('path')].filter(
        p => /NaN|Infinity|undefined/.test(p.getAttribute('d'))).length,
      caption: figure.querySelector('figcaption') ? figure.querySelector('figcaption').textContent : '',
    };
  }
  const tables = [...document.querySelectorAll('table')].map(t => [t.id, t.querySelectorAll('td').length]);
  const result = {figures, tables,
                  loads: performance.getEntriesByType('resource').map(r => r.name),
                  wide: document.documentElement.scrollWidth > document.documentElement.clientWidth + 1};
  const out = document.createElement('pre');
  out.id = 'probe';
  out.textContent = JSON.stringify(result);
  document.body.append(out);
});
</script>"""


class Failures:
    def __init__(self):
        self.n_checks = 0
        self.messages = []

    def expect(self, holds, what):
        self.n_checks += 1
        if not holds:
            self.messages.append(what)


def measure(folder):
    """The smallest run that has every input and every algorithm."""
    run = os.path.join(HERE, "..", "..", "run")
    done = subprocess.run(
        [run, "--report", "--preset", "smoke", "--results", folder],
        check=False,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
    )
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    subprocess.run(
        [sys.executable, os.path.join(HERE, "page.py"), folder], check=True, stdout=subprocess.DEVNULL
    )


def check_continued(failures, folder):
    """A second run finds everything there."""
    done = subprocess.run(
        [os.path.join(HERE, "..", "..", "run"), "--report", "--preset", "smoke", "--results", folder],
        check=True,
        capture_output=True,
        text=True,
    )
    failures.expect(done.stderr.count("all there") == 11, "a run that is continued measures nothing twice")


def check_files(failures, folder):
    for n in range(3, 11):
        path = os.path.join(folder, "report", f"figure_{n}.svg")
        try:
            xml.etree.ElementTree.parse(path)
            failures.expect(True, "")
        except (OSError, xml.etree.ElementTree.ParseError) as error:
            failures.expect(False, f"figure_{n}.svg is well-formed: {error}")


def check_page(failures, chromium, path):
    with open(path, encoding="utf-8") as file:
        html = file.read()
    failures.expect(
        not re.search(r'(?:src|href)="(?!#|data:|https://inria\.hal\.science/)', html),
        "the page refers to nothing beside it",
    )
    ids = re.findall(r'\bid="([^"]*)"', html)
    failures.expect(len(ids) == len(set(ids)), "every id is there once")
    failures.expect(not re.search(r"#0000[0-9a-f]{2}\b", html), "every colour is a variable of the style")
    with tempfile.TemporaryDirectory() as folder:
        probed = os.path.join(folder, "page.html")
        with open(probed, "w", encoding="utf-8") as file:
            file.write(html.replace("</body>", PROBE + "</body>"))
        document, console = browser.open_page(chromium, probed)
    failures.expect(console == [], f"nothing on the console: {console}")
    found = re.search(r'<pre id="probe">(.*?)</pre>', document, re.DOTALL)
    failures.expect(found is not None, "the page's scripts run")
    if not found:
        return
    text = found.group(1).replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&")
    check_probe(failures, json.loads(text))


def check_probe(failures, probe):
    for n in range(3, 11):
        figure = probe["figures"].get(f"figure-{n}")
        failures.expect(figure is not None, f"figure {n} is there")
        if not figure:
            continue
        failures.expect(
            figure["width"] > 300 and figure["height"] > 150 and figure["drawn"] > 5,
            f"figure {n} shows something",
        )
        failures.expect(len(figure["labels"]) >= 2 and all(figure["labels"]), f"figure {n} has labelled axes")
        failures.expect(figure["broken"] == 0, f"figure {n} has no broken path")
        failures.expect(figure["overlaps"] == [], f"figure {n}: texts overlap: {figure['overlaps'][:5]}")
        failures.expect(figure["outside"] == [], f"figure {n}: texts are cut off: {figure['outside'][:5]}")
        failures.expect(
            "The report:" in figure["caption"] and "Here:" in figure["caption"],
            f"figure {n} says what the report saw and what is seen here",
        )
    for name, n_cells in probe["tables"]:
        failures.expect(n_cells > (100 if name.startswith("table") else 20), f"{name} is filled")
    names = [name for name, _ in probe["tables"]]
    failures.expect(names == ["table-1", "table-2", "section-6"], "all tables are there")
    failures.expect(probe["loads"] == [], f"the page loads nothing: {probe['loads']}")
    failures.expect(not probe["wide"], "the page is not wider than the window")


def main():
    failures = Failures()
    chromium = browser.find()
    if len(sys.argv) > 1:
        if not chromium:
            raise SystemExit("error: no Chromium found (named by CHROMIUM, or chromium in the search path)")
        check_page(failures, chromium, sys.argv[1])
    else:
        with tempfile.TemporaryDirectory() as folder:
            measure(folder)
            check_files(failures, folder)
            check_continued(failures, folder)
            if chromium:
                check_page(failures, chromium, os.path.join(folder, "report", "index.html"))
            else:
                print(
                    "SKIPPED opening the page of the report: no Chromium found "
                    "(named by CHROMIUM, or chromium in the search path)"
                )
    for message in failures.messages:
        print(f"FAILED: {message}")
    print(f"page: {failures.n_checks - len(failures.messages)} passed, {len(failures.messages)} failed")
    sys.exit(1 if failures.messages else 0)


if __name__ == "__main__":
    main()
