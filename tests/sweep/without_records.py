#!/usr/bin/env python3
"""without_records.py RECORDS HEADER OUTPUT: writes the header of the forced stage without records:
every block `if (... name ...) { ... }` or `if constexpr (...)` whose condition names such a member
of struct Records is removed. Each member must have one. Line numbers are kept."""

import pathlib
import re
import sys


def end_of_block(text, opening):
    depth = 0
    for position in range(opening, len(text)):
        depth += {"{": 1, "}": -1}.get(text[position], 0)
        if depth == 0:
            return position + 1
    sys.exit("without_records: missing closing brace")


def without(text, member):
    condition = re.compile(r"\bif\s*(?:constexpr\s*)?\([^(){}]*\b" + member + r"\b[^(){}]*\)\s*\{")
    cuts = 0
    while found := condition.search(text):
        end = end_of_block(text, found.end() - 1)
        text = text[:found.start()] + "\n" * text[found.start():end].count("\n") + text[end:]
        cuts += 1
    if not cuts:
        sys.exit(f"without_records: no block records {member}. Records must be in an "
                 f"\"if constexpr (records.{member})\" block")
    return text


def main():
    records = pathlib.Path(sys.argv[1]).read_text()
    text = pathlib.Path(sys.argv[2]).read_text()
    members = re.search(r"// Recorded in every step(.*?)// Computed from the end", records, re.DOTALL)
    names = re.findall(r"bool (\w+)", members.group(1)) if members else []
    if not names:
        sys.exit("without_records: found no members that are recorded in every step")
    for name in names:
        text = without(text, name)
    pathlib.Path(sys.argv[3]).write_text(text)


if __name__ == "__main__":
    main()
