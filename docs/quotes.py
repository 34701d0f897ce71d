#!/usr/bin/env python3
"""Checks that the numbers of the documentation are those of measured.md. Part of tools/check docs.

A paragraph, table or block of code that states results is preceded by a comment, which names one or more commands:

    <!-- measured: tools/bench run; tools/bench ranks -->

Each number must then be in the report of one of them, rounded to the digits that are given. Not checked are code in
backticks, targets of links, and the first row and column of a table."""

import argparse
import pathlib
import re
import sys

CHECKOUT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(CHECKOUT / "tools" / "benchmarks"))
import everything  # noqa: E402
import reports  # noqa: E402

MARKER = re.compile(r"<!-- measured: ([^\n]+?) -->\n(```.*?^```$|\S.*?(?=\n\n|\Z))", re.DOTALL | re.MULTILINE)


def checked(block):
    """The part of a block that is checked."""
    if block.startswith("```"):
        return block
    block = re.sub(r"\]\([^)]*\)", "]", re.sub(r"`[^`]*`", "", block))
    if not block.startswith("|"):
        return block
    return "\n".join(row.split("|", 2)[2] for row in block.splitlines()[2:])


def check(page, text, measured):
    """Returns the errors of a page, and the commands that it names and that are not measured."""
    errors, missing = [], set()
    for begin in re.finditer(r"<!--\s*measured", text):
        where = f"{page}:{text.count(chr(10), 0, begin.start()) + 1}"
        marker = MARKER.match(text, begin.start())
        if not marker:
            errors.append(f"{where}: not of the form \"<!-- measured: COMMAND; COMMAND -->\", with a block below it")
            continue
        commands = marker[1].split("; ")
        known = (*measured, *everything.BENCHMARKS, *everything.CHECKS)
        errors += [f"{where}: \"{command}\" is neither measured nor a command of tools/bench all"
                   for command in commands if command not in known]
        if unmeasured := {command for command in commands if command not in measured}:
            missing |= unmeasured.intersection(known)
            continue
        exact = [number for command in commands for number in reports.numbers(f"{command}\n{measured[command].text}")]
        wrong = [number for number in reports.numbers(checked(marker[2])) if not any(map(number.is_rounded, exact))]
        if wrong:
            errors.append(f"{where}: not in the report of {marker[1]}: "
                          + ", ".join(f"{number.printed} {number.unit}".rstrip() for number in wrong))
    return errors, missing


def check_pages(unmeasured):
    """Returns the errors of all pages. Commands that are not measured are an error, or are printed."""
    measured = reports.read((CHECKOUT / "docs" / "measured.md").read_text())[1]
    errors, missing = [], set()
    for page in (CHECKOUT / "README.md", *sorted((CHECKOUT / "docs").glob("*.md"))):
        found = check(page.relative_to(CHECKOUT), page.read_text(), measured)
        errors += found[0]
        missing |= found[1]
    if missing:
        line = f"not measured at this commit: {', '.join(sorted(missing))}"
        print(line) if unmeasured else errors.append(line)
    return errors


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unmeasured", action="store_true", help="accept numbers whose command is not in measured.md")
    found = check_pages(parser.parse_args().unmeasured)
    print("\n".join(found or ["the numbers of the documentation are those of docs/measured.md"]))
    sys.exit(1 if found else 0)
