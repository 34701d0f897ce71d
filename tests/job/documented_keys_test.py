#!/usr/bin/env python3
"""documented_keys_test.py PROGRAM DOCS: the tables of keys in jobs.md and records.md, and that of fields in
results.md, have exactly the keys and fields that the program knows."""

import pathlib
import re
import subprocess
import sys

PARTS = {"values", "first", "last", "count", "spacing"}  # of an axis


def known_keys(program):
    completion = subprocess.run([program, "--bash-completion"], capture_output=True, text=True, check=True).stdout
    keys = {key for key in re.findall(r"(?<![\w.])(title|[a-z]+(?:\.[a-z_]+)+)=", completion)}
    return {key for key in keys if key.split(".")[-1] not in PARTS}


def documented_keys(folder):
    rows = "".join(line for page in ("jobs.md", "records.md")
                   for line in (folder / page).read_text().splitlines(True) if not line.startswith("    "))
    return set(re.findall(r"`((?:scene|plane|block|blocks|numerics|output)\.[a-z_.]+)`", rows)) | {"title"}


def known_fields(program, folder):
    refusal = subprocess.run([program, "check", folder.parent / "jobs" / "smoke.toml", "--set",
                              'output.fields=["none"]'], capture_output=True, text=True).stderr
    return set(re.split(r",\s*|\.\s*$", refusal.split("Allowed: ")[1])) - {""} | {"evaluated"}  # added by itself


def documented_fields(folder):
    table = (folder / "results.md").read_text().split("\n## Fields\n")[1].split("\n## ")[0]
    return {name for row in re.findall(r"^\| (`.*?) \|", table, re.MULTILINE) for name in re.findall(r"`(\w+)`", row)}


def main():
    known, documented = known_keys(sys.argv[1]), documented_keys(pathlib.Path(sys.argv[2]))
    known = {key for key in known if not key.startswith("block.")}  # as in [plane]
    documented = {key for key in documented if not key.startswith("block.")}
    folder = pathlib.Path(sys.argv[2])
    known |= known_fields(sys.argv[1], folder)
    documented |= documented_fields(folder)
    for text, keys in (("not documented", known - documented), ("unknown to the program", documented - known)):
        for key in sorted(keys):
            print(f"{key} is {text}")
    if len(known) < 30 or known != documented:
        sys.exit(1)


if __name__ == "__main__":
    main()
