#!/usr/bin/env python3
"""Builds the documentation as a site and checks links and anchors, the API of the headers, the
spelling and the measured numbers; runs every code block of sh, python, toml and, where R is installed, r, and the
notebooks, and compares what they print with the documentation. Called by tools/check docs."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import quotes

CHECKOUT = pathlib.Path(__file__).resolve().parent.parent
BUILT = CHECKOUT / "build-docs"
PAGES = ["README.md", "CONTRIBUTING.md", "jobs/README.md", *sorted(
    str(page.relative_to(CHECKOUT)) for page in (CHECKOUT / "docs").glob("*.md"))]

LANGUAGES = ("sh", "python", "toml", "r")
# Blocks that are not run: the page, the beginning of the block, and the reason.
NOT_RUN = {
    ("README.md", "tools/quickstart"): "installs, builds and tests, as CI does",
    ("docs/clusters.md", "sbatch"): "needs Slurm; tools/check slurm runs the scripts",
    ("docs/clusters.md", "job=(jobs/figure_07a.toml"): "needs Slurm, like the block before",
    ("docs/installing.md", "cmake --preset release"): "configures the build used by the other blocks",
    ("docs/developing.md", "cmake --preset dev"): "a second build; tools/check docs has already made the first",
    ("docs/opensees.md", "/usr/bin/python3 -m venv"): "installs OpenSeesPy from PyPI; takes a quarter of an hour",
    ("CONTRIBUTING.md", "ctest"): "runs all tests",
    ("docs/python.md", "sudo apt-get install"): "installs the package from PyPI, as tools/check wheel does",
    ("docs/python.md", "import obspy"): "needs ObsPy; tests/python/traces_test.py runs it where ObsPy is installed",
}


def blocks_of(page):
    """Yields the language, the number of the first line and the text of each code block. The language
    is "printed" if the block is what the previous one prints."""
    text = (CHECKOUT / page).read_text()
    for match in re.finditer(r"^```(\w+)\n(.*?)^```$", text, re.DOTALL | re.MULTILINE):
        introduction = text[:match.start()].rstrip().rpartition("\n")[2]
        is_printed = match[1] == "text" and "prints" in introduction
        yield "printed" if is_printed else match[1], text.count("\n", 0, match.start()) + 2, match[2]


def not_printed(text, output):
    """Returns the lines of a text that a program did not print."""
    printed = {line.rstrip() for line in output.splitlines()}
    return [line for line in text.splitlines() if line.strip() and line.rstrip() not in printed]


def run_block(language, text, folder, python):
    if language == "toml":
        (folder / "block.toml").write_text(text)
        command = [CHECKOUT / "build/overturn", "check", "block.toml"]
    elif language == "python":
        command = [python, "-c", text]
    elif language == "r":
        command = ["Rscript", "--vanilla", "-e", text]
    else:
        command = ["bash", "-euo", "pipefail", "-c", text]
    environment = dict(os.environ, MPLBACKEND="Agg", OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1",
                       PYTHONPATH=str(folder / "tools"))
    return subprocess.run(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def run_blocks(python):
    """Runs the blocks of each page in order, in a copy of the checkout."""
    failed, count, unused = [], 0, set(NOT_RUN)
    for page in PAGES:
        folder = BUILT / "blocks" / page.replace("/", "_")
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(CHECKOUT, folder, ignore=shutil.ignore_patterns(".git", "build*", "results", "gallery"))
        (folder / "build").symlink_to(CHECKOUT / "build")
        result = None
        for language, line, text in blocks_of(page):
            if language == "printed" and result:
                failed += [f"{page}:{line}: not printed by the previous block: {missing}"
                           for missing in not_printed(text, result.stdout)]
            if language not in LANGUAGES:
                continue
            if language == "r" and not shutil.which("Rscript"):
                print(f"{page}:{line}: skipped, because R is not installed")
                result = None
                continue
            exception = next((key for key in NOT_RUN if key[0] == page and text.startswith(key[1])), None)
            if exception:
                unused.discard(exception)
                result = None
                continue
            count += 1
            began = time.monotonic()
            result = run_block(language, text, folder, python)
            print(f"{page}:{line}: {time.monotonic() - began:.0f} s", flush=True)
            if result.returncode != 0:
                failed.append(f"{page}:{line}: the {language} block exited with {result.returncode}:\n"
                              f"{text}--\n{result.stdout}")
    failed += [f"{page}: no block begins with \"{start}\"; remove it from NOT_RUN" for page, start in unused]
    print(f"{count} code blocks run, {len(NOT_RUN)} not run")
    return failed


def texts_of(notebook):
    """Returns what each code cell of a notebook prints."""
    return ["".join("".join(output["text"]) for output in cell["outputs"] if output["output_type"] == "stream")
            for cell in json.loads(notebook.read_text())["cells"] if cell["cell_type"] == "code"]


def run_notebooks():
    """Runs the notebooks and compares what they print with what is stored in them."""
    failed = []
    for notebook in sorted((CHECKOUT / "docs").glob("*.ipynb")):
        executed = BUILT / notebook.name
        environment = dict(os.environ, PYTHONPATH=str(CHECKOUT / "tools"))
        failed += run(f"notebook {notebook.name}", "/usr/bin/python3", "-m", "nbconvert", "--execute", "--to", "notebook",
                      "--output", str(executed), str(notebook), env=environment)
        if not failed and texts_of(executed) != texts_of(notebook):
            failed.append(f"{notebook.name} prints something else than what is stored in it; {executed} is the new one")
    return failed


def run(what, *command, **options):
    result = subprocess.run(command, cwd=CHECKOUT, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            **options)
    print(f"{what}: {'failed' if result.returncode else 'passed'}")
    return [f"{what}:\n{result.stdout}"] if result.returncode else []


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--python", default="/usr/bin/python3", help="what runs the Python blocks")
    parser.add_argument("--unmeasured", action="store_true", help="accept numbers whose command is not in measured.md")
    arguments = parser.parse_args()
    BUILT.mkdir(exist_ok=True)
    site = BUILT / "site"
    failed = run("site, links and anchors", "/usr/bin/python3", "-m", "sphinx", "-E", "-W", "--keep-going", "-q",
                 "-c", "docs", "-d", str(BUILT / "doctrees"), ".", str(site))
    doxyfile = BUILT / "Doxyfile"
    doxyfile.write_text((CHECKOUT / "docs/Doxyfile").read_text() + f"OUTPUT_DIRECTORY = {site}\n")
    failed += run("API of the headers", "doxygen", str(doxyfile))
    sources = subprocess.run(["git", "ls-files", "*.md", "*.hpp", "*.cpp", "*.py", "*.toml", "*.txt", "tools", "jobs"], text=True,
                             cwd=CHECKOUT, check=True, stdout=subprocess.PIPE).stdout.split()
    failed += run("spelling", "codespell", "--ignore-words", "docs/words", "--skip", "*.png,docs/measured.md", *sources)
    failed += quotes.check_pages(arguments.unmeasured)
    failed += run_notebooks()
    failed += run_blocks(arguments.python)
    for failure in failed:
        print(f"\n{failure}", file=sys.stderr)
    print(f"The site is {site}/docs/index.html")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
