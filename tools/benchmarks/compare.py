"""Compares two pages of reports, number by number."""

import pathlib
import re

import reports
from building import fail

EXPLANATION = """\
Compares the reports of two pages that tools/bench all has written. The texts must be the same but for the numbers, and
so must the counts, which are integers without a unit; instructions may differ by 0.1 %. Of all other numbers, the
quotient new/old is printed; a ratio that differs by more than 20 % is marked with '!'. Counts of commands that work
for a given time, or until they are killed, and of OpenSees, which depend on the processor, are compared like ratios; a
line of them that only one report has, such as one of a rare event, is printed."""

VARYING = ("tools/check faults", "tools/check fuzz", "tools/check scale", "tools/check slurm", "tools/bench estimates",
           "$OPENSEES_PYTHON")
INSTRUCTIONS, RATIOS = 0.001, 0.2  # relative differences


def add_arguments(parser):
    parser.add_argument("old", type=pathlib.Path, metavar="OLD.md")
    parser.add_argument("new", type=pathlib.Path, metavar="NEW.md")


def without_numbers(line):
    return " ".join(reports.NUMBER.sub("#", line).split())


def differ(old, new, share):
    return abs(new.value - old.value) > share * abs(old.value) + old.half_digit + new.half_digit


def in_both(before, after):
    """The lines that two reports have in common but for their numbers, and the others, with the name of their report."""
    old, new = ({without_numbers(line): line for line in report} for report in (before, after))
    others = [f"{name}: {line}" for name, lines, other in (("only old", old, new), ("only new", new, old))
              for text, line in lines.items() if text not in other]
    return [old[text] for text in old if text in new], [new[text] for text in old if text in new], others


def compared(command, old, new):
    """The lines to print about two reports, and what differs that must not."""
    before, after = ([line for line in report.splitlines() if line.strip()] for report in (old, new))
    printed, wrong = [], []
    if command.startswith(VARYING):
        before, after, printed = in_both(before, after)
    elif [without_numbers(line) for line in before] != [without_numbers(line) for line in after]:
        return [], [f"{command}: the text differs:\n  old: {one}\n  new: {other}" for one, other in zip(
            before + ["nothing"], after + ["nothing"]) if without_numbers(one) != without_numbers(other)][:1]
    are_instructions = "instructions" in old
    for one, other in zip(before, after):
        quotients = []
        for was, now in zip(reports.numbers(one), reports.numbers(other)):
            is_count = not was.unit and not re.search("[.e]", was.printed) and not command.startswith(VARYING)
            if are_instructions or is_count:
                if differ(was, now, INSTRUCTIONS) if are_instructions else was.value != now.value:
                    wrong.append(f"{command}: {was.printed} is now {now.printed}:\n  old: {one}\n  new: {other}")
                continue
            is_ratio = reports.SCALES[was.unit][1] == ""
            quotients.append((f"{now.value / was.value:.2f}" if was.value else f"{now.printed}/{was.printed}")
                             + "!" * (is_ratio and differ(was, now, RATIOS)))
        if quotients:
            printed.append(f"{other}   [{' '.join(quotients)}]")
    return printed, wrong


def run(options):
    (commit, old), (new_commit, new) = (reports.read(path.read_text()) for path in (options.old, options.new))
    if not old or not new:
        fail(f"{options.new if old else options.old} contains no reports")
    for what, name, page in (("old", commit, old), ("new", new_commit, new)):
        machines = dict.fromkeys(report.machine for report in page.values())
        print("\n".join([f"{what}: commit {name}", *machines]), end="\n\n")
    wrong = []
    for command in (command for command in old if command in new):
        printed, found = compared(command, old[command].text, new[command].text)
        print("\n".join(["", command, *printed]))
        wrong += found
    for what, names in (("only in the old page", old.keys() - new), ("only in the new page", new.keys() - old)):
        if names:
            print(f"\n{what}: {', '.join(sorted(names))}")
    if wrong:
        fail("\n".join(["the reports differ", *wrong]))
    print("\nthe texts and the counts are the same")
