#!/usr/bin/env python3
"""Checks that every Python class with tests, or its script, is named in the CMakeLists.txt of its folder: ctest runs no
others."""

import ast
import pathlib
import re
import sys

TESTS = pathlib.Path(__file__).resolve().parents[1]


def classes_with_tests(path):
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.ClassDef) and any(
                isinstance(each, ast.FunctionDef) and each.name.startswith("test") for each in node.body):
            yield node.name


def unregistered():
    for path in sorted(TESTS.rglob("*_test.py")):
        listed = (path.parent / "CMakeLists.txt").read_text()
        whole = " ".join(re.findall(r"(?:add_script_tests|foreach)\(([\w\s]+)\)", listed)).split()
        if f"{path.name})" in listed or {path.stem, path.stem.removesuffix("_test")} & set(whole):  # runs as a whole
            continue
        words = set(re.findall(r"\w+", listed))
        for name in classes_with_tests(path):
            if name not in words:
                yield f"{path.relative_to(TESTS.parent)}: {name} is not named in {path.parent.name}/CMakeLists.txt"


found = list(unregistered())
print("\n".join(found))
sys.exit(1 if found else 0)
