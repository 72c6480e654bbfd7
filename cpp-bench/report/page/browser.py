# SPDX-License-Identifier: GPL-3.0-or-later
"""A headless Chromium that opens a file and says what became of it."""

import os
import shutil
import subprocess
import tempfile

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome", "headless_shell")


def find():
    """The path of a Chromium, from CHROMIUM or the search path; None where there is none."""
    named = os.environ.get("CHROMIUM")
    return named if named else next((path for path in map(shutil.which, NAMES) if path), None)


def open_page(chromium, path, timeout=120):
    """(document after scripts have run, messages of the console)."""
    with tempfile.TemporaryDirectory() as profile:
        command = [
            chromium,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-dev-shm-usage",
            "--enable-logging=stderr",
            f"--user-data-dir={profile}",
            "--window-size=1200,900",
            "--virtual-time-budget=10000",
            "--dump-dom",
            "file://" + os.path.abspath(path),
        ]
        done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    console = [line for line in done.stderr.splitlines() if "CONSOLE" in line]
    if done.returncode != 0 or "<html" not in done.stdout:
        raise RuntimeError(f"{chromium} failed:\n{done.stderr[-2000:]}")
    return done.stdout, console
