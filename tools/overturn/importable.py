"""Prints what this Python can import, for overturn doctor: a line with its path, and one with the rest."""

import importlib.metadata
import importlib.util
import os
import sys

from overturn.installation import PACKAGES


def module_text():
    try:
        from overturn import core  # noqa: F401
    except ImportError as error:
        return f"cannot import overturn._core ({' '.join(str(error).split())})"
    return "imports overturn._core"


def version_of(package):
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return "of unknown version"


def packages_text():
    found = [package for package in PACKAGES if importlib.util.find_spec(package)]
    lacking = [package for package in PACKAGES if package not in found]
    return [f"{package} {version_of(package)}" for package in found] + ["lacks " + ", ".join(lacking)] * bool(lacking)


def main():
    print(os.path.realpath(sys.executable))
    print("; ".join([f"version {sys.version.split()[0]}", module_text(), ", ".join(packages_text())]))
