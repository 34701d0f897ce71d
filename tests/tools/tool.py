"""Running the tools in a given folder. Importing this module makes the package `overturn` of the tools
importable."""

import contextlib
import importlib
import io
import os
import pathlib
import re
import subprocess
import sys

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
PATIENCE = 100  # [s] for one run of a tool; the longest takes a few seconds

sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))
os.environ["MPLBACKEND"] = "Agg"  # as run_command() sets it


def run_tool(name, *arguments, cwd, **how):
    """Runs a tool in this process if it is a command of the package, which saves the import of its
    modules; otherwise, or with further options, in its own. `name` is a path below tools/."""
    command = re.search(r'run_command\("(\w+)", "([\w.]+)"\)', (TOOLS / name).read_text())
    if how or not command:
        return subprocess.run([sys.executable, TOOLS / name, *arguments], text=True, cwd=cwd,
                              capture_output=True, **{"timeout": PATIENCE, **how})
    from overturn import result_file
    main = importlib.import_module(command[2]).main
    output, errors, code = io.StringIO(), io.StringIO(), 0
    with contextlib.chdir(cwd), contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
        try:
            result_file.run_tool(command[1], lambda: main([str(word) for word in arguments]))
        except SystemExit as end:
            code = end.code or 0
    return subprocess.CompletedProcess([name, *arguments], code, output.getvalue(), errors.getvalue())
