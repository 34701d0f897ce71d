#!/usr/bin/env python3
"""documented_keys_test.py PROGRAM DOCS [--write]: the tables of keys in jobs.md are those that the program prints, and
the table of fields in results.md has exactly the fields that the program knows. --write replaces the tables of keys."""

import pathlib
import re
import subprocess
import sys

REGION = re.compile(r"(<!-- keys: ([a-z ]+) -->\n).*?(<!-- end -->)", re.DOTALL)
HEADER = "| key | type | unit | range | default | meaning |\n| --- | --- | --- | --- | --- | --- |\n"


def rows_of(program, table):
    return subprocess.run([program, "keys", table, "--markdown"], capture_output=True, text=True, check=True).stdout


def with_tables(program, text):
    return REGION.sub(lambda found: "{}\n{}{}\n{}".format(
        found[1], HEADER, "".join(rows_of(program, table) for table in found[2].split()), found[3]), text)


def known_fields(program):
    row = rows_of(program, "output.fields")
    return set(re.findall(r'"(\w+)"', row.split(" | ")[3])) | {"evaluated"}  # added by itself


def documented_fields(folder):
    table = (folder / "results.md").read_text().split("\n## Fields\n")[1].split("\n## ")[0]
    return {name for row in re.findall(r"^\| (`.*?) \|", table, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)}


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    page = folder / "jobs.md"
    current = with_tables(program, page.read_text())
    if "--write" in sys.argv:
        page.write_text(current)
    all_rows = subprocess.run([program, "keys", "--markdown"], capture_output=True, text=True, check=True).stdout
    missing = [row for row in all_rows.splitlines() if row not in page.read_text()]
    fields = known_fields(program) ^ documented_fields(folder)
    if fields:
        sys.exit(f"{folder / 'results.md'}: either its table of fields or the program lacks {', '.join(fields)}.")
    if missing or current != page.read_text() or len(all_rows.splitlines()) < 40:
        print(*missing, sep="\n")
        sys.exit(f"The tables of {page} are not those of the program; {sys.argv[0]} PROGRAM DOCS --write replaces them.")


if __name__ == "__main__":
    main()
