"""Builds the package with the library inside.

The library comes from DELDRIFT_LIBRARY_DIR, a folder with libdeldrift.a and libdeldrift.so, or is compiled by cargo
from sources: those of the repository around this folder, or, in an sdist, those in the folder rust.

With PyPI's ziglang installed it is linked again for glibc 2.17, so that the wheel runs on older systems than the one it
was built on.
"""

import importlib.util
import os
import platform
import shutil
import subprocess
import sys
import sysconfig
import tarfile
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
IN_SDIST = HERE / "rust"
SOURCES = IN_SDIST if IN_SDIST.exists() else HERE.parent
LICENSES = "LICENSE-MIT", "LICENSE-APACHE"
OLD_GLIBC = "2.17"


def run(*command, **options):
    print("+", *command, file=sys.stderr)
    subprocess.run([str(word) for word in command], check=True, **options)


def compiled(scratch):
    """The folder with the library: the one that is given, or of a build."""
    given = os.environ.get("DELDRIFT_LIBRARY_DIR")
    if given:
        return Path(given)
    run(
        "cargo",
        "build",
        "--release",
        "--lib",
        "--locked",
        "--manifest-path",
        SOURCES / "Cargo.toml",
        "--target-dir",
        scratch,
    )
    return scratch / "release"


def make_library(scratch, output):
    folder = compiled(scratch)
    output.parent.mkdir(parents=True, exist_ok=True)
    if importlib.util.find_spec("ziglang"):
        link_for_old_glibc(folder / "libdeldrift.a", scratch, output)
    else:
        run("strip", "-o", output, folder / "libdeldrift.so")


def link_for_old_glibc(archive, scratch, output):
    scratch.mkdir(parents=True, exist_ok=True)
    exports = scratch / "exports.map"
    exports.write_text("{ global: deldrift_*; local: *; };\n")
    target = f"{platform.machine()}-linux-gnu.{OLD_GLIBC}"
    run(
        *(sys.executable, "-m", "ziglang", "cc", "-target", target, "-shared", "-s", "-o", output),
        *("-Wl,--whole-archive", archive, "-Wl,--no-whole-archive", "-Wl,--gc-sections"),
        *(
            f"-Wl,--version-script={exports}",
            "-Wl,-soname,libdeldrift.so",
            "-lm",
            "-lpthread",
            "-ldl",
            "-lrt",
            "-lunwind",
        ),
    )


class WithLibrary(build_py):
    def run(self):
        super().run()
        scratch = Path(self.get_finalized_command("build").build_temp).resolve()
        make_library(scratch, Path(self.build_lib, "deldrift", "libdeldrift.so"))


class ForEveryPython(bdist_wheel):
    """A wheel that has machine code, but none that depends on the Python."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return "py3", "none", sysconfig.get_platform().replace("-", "_").replace(".", "_")


class WithSources(sdist):
    """An sdist with the sources of the library, as cargo packages them."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        if IN_SDIST.exists():
            shutil.copytree(IN_SDIST, Path(base_dir, "rust"), dirs_exist_ok=True)
            return
        target = HERE / "build" / "crate"
        run(
            *("cargo", "package", "--no-verify", "--allow-dirty", "--quiet"),
            *("--manifest-path", SOURCES / "Cargo.toml", "--target-dir", target),
        )
        crate = max(target.glob("package/*.crate"), key=os.path.getmtime)
        with tarfile.open(crate) as archive:
            archive.extractall(target)
        shutil.copytree(target / crate.stem, Path(base_dir, "rust"), dirs_exist_ok=True)


class HasLibrary(Distribution):
    def has_ext_modules(self):
        return True


for name in LICENSES:
    if not (HERE / name).exists():
        shutil.copy(SOURCES / name, HERE / name)

setup(cmdclass={"build_py": WithLibrary, "bdist_wheel": ForEveryPython, "sdist": WithSources}, distclass=HasLibrary)
