"""Every benchmark whose numbers are in the documentation, one after another."""

import pathlib
import subprocess
import sys
import time

from building import SOURCE, fail

EXPLANATION = """\
Runs every benchmark of README.md and docs, as the documentation states it, one after another:
about half an hour, and the first time a few more to build. Each writes its report, its JSON and
its picture to a folder, beside `machine.txt`: processor, versions, date and commit. Do not run
other programs meanwhile."""

COMMANDS = ("peers", "peers --record", "kernel", "effects", "run", "ranks",
            "ranks --record --points 512", "records", "records --museum", "sliding", "estimates", "scale", "fill",
            "picture")


def add_arguments(parser):
    parser.add_argument("--only", nargs="+", metavar="COMMAND", default=COMMANDS, choices=COMMANDS,
                        help="some of: " + ", ".join(f'"{command}"' for command in COMMANDS))
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("bench"),
                        help="the folder (default: bench)")


def report_of(command, folder, path):
    """Runs a command in the folder; its output is shown and written to a file."""
    with path.open("w") as file, subprocess.Popen(
            command, cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        for line in process.stdout:
            print(line, end="", flush=True)
            file.write(line)
    return process.returncode


def run(options):
    folder = options.output.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    overturn = SOURCE / "build" / "overturn"
    if not overturn.exists():
        fail(f"{overturn} does not exist; build it by tools/quickstart")
    if report_of([overturn, "doctor"], folder, folder / "machine.txt"):
        fail("overturn doctor failed")
    with (folder / "machine.txt").open("a") as file:
        print(f"date         {time.strftime('%Y-%m-%d')}", file=file)
    failed = []
    for command in options.only:
        print(f"\ntools/bench {command}", flush=True)
        words = command.split()
        name = "_".join(word.strip("-") for word in words)
        if words[0] == "peers" and words[1:]:
            words += ["--output", f"bench_{name}.json"]
        if report_of([sys.executable, SOURCE / "tools" / "bench", *words], folder,
                     folder / f"{name}.txt"):
            failed.append(command)
    if failed:
        fail(f"failed: {', '.join(failed)}")
    print(f"written: {folder}")
