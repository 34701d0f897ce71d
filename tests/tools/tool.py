"""Running the tools and the program in a folder. Importing this module makes the package `overturn` of the tools
importable. Running the program requires OVERTURN (the binary) in the environment."""

import contextlib
import functools
import gc
import importlib.machinery
import importlib.util
import io
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
JOBS = TOOLS.parent / "jobs"
PATIENCE = 100  # [s] for one run of a tool; the longest takes a few seconds

gc.set_threshold(100_000)  # to look for unused figures more often takes a twentieth of the time
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))
os.environ["MPLBACKEND"] = "Agg"  # as run_command() sets it


@functools.cache
def module_of(name):
    """Returns the module of a tool, a path below tools/."""
    from overturn import installation
    if name in installation.TOOLS:
        return importlib.import_module(f"overturn.{installation.TOOLS[name]}")
    loader = importlib.machinery.SourceFileLoader(pathlib.Path(name).stem, str(TOOLS / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def run_tool(name, *arguments, cwd, **how):
    """Runs a tool in this process, which saves the import of its modules; with further options, in its own."""
    from overturn import tool
    if how:
        return subprocess.run([sys.executable, TOOLS / name, *arguments], text=True, cwd=cwd,
                              capture_output=True, **{"timeout": PATIENCE, **how})
    output, errors, code = io.StringIO(), io.StringIO(), 0
    with contextlib.chdir(cwd), contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors), \
            mock.patch.object(sys, "argv", [str(TOOLS / name), *map(str, arguments)]):
        try:
            tool.run_tool(pathlib.Path(name).name, module_of(name).main)
        except SystemExit as end:
            code = end.code or 0
            if isinstance(code, str):  # a message
                print(code, file=errors)
                code = 1
    return subprocess.CompletedProcess([name, *arguments], code, output.getvalue(), errors.getvalue())


def new_folder(add_cleanup):
    folder = tempfile.TemporaryDirectory(prefix="overturn-test-")
    add_cleanup(folder.cleanup)
    return pathlib.Path(folder.name)


def run_overturn(folder, command, job, name, *settings):
    """Runs the program; `job` is a path, or the text of a job. settings: of its keys, or options."""
    if not isinstance(job, pathlib.Path):
        (folder / "job.toml").write_text(job)
        job = "job.toml"
    options = [each if each.startswith("--") else f"--set={each}" for each in settings]
    subprocess.run([os.environ["OVERTURN"], command, job, "-o", name, *options], cwd=folder, check=True,
                   capture_output=True, timeout=PATIENCE)


def pixels_of(figure):
    import numpy as np
    figure.canvas.draw()
    return np.asarray(figure.canvas.buffer_rgba())[..., :3].astype(int)


def words_of(figure):
    from matplotlib.backends.backend_agg import RendererAgg

    class Texts(RendererAgg):
        """Lays out what is drawn, and keeps the texts only."""

        def draw_text(self, gc, x, y, text, *font, **how):
            found.append(text)

        def draw_nothing(self, *how, **further):
            pass

        draw_path = draw_markers = draw_image = draw_path_collection = draw_quad_mesh = draw_nothing
    found = []
    figure.draw(Texts(*figure.bbox.size, figure.dpi))
    return found


class InAFolder(unittest.TestCase):
    """A separate folder for each test, in which the tools and the program run."""

    TOOL = None  # the tool that the class tests
    FILE = ""  # the file that it draws
    JOB = ""

    def setUp(self):
        self.folder = new_folder(self.addCleanup)

    def overturn(self, command, name, *settings, job=None):
        run_overturn(self.folder, command, job or self.JOB, name, *settings)

    def run_tool(self, *arguments, tool=None, **how):
        return run_tool(tool or self.TOOL, *arguments, cwd=self.folder, **how)

    def output_of(self, *arguments, tool=None):
        run = self.run_tool(*arguments, tool=tool)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout

    def svg(self, *arguments, tool=None, file=None):
        """Returns the picture as SVG."""
        self.output_of(*filter(None, [file or self.FILE]), "-o", "picture.svg", *arguments, tool=tool)
        return (self.folder / "picture.svg").read_text("utf-8")

    def drawing(self, draw, *arguments, tool=None, file=None):
        """Returns what the tool prints, and draw(figure) in place of a file: to encode it takes as long as to draw it."""
        made = []

        def write_picture(figure, path, dpi=None):
            figure.set_dpi(dpi or figure.dpi)
            made.append(draw(figure))
        with mock.patch("overturn.output_file.write_picture", write_picture):
            text = self.output_of(*filter(None, [file or self.FILE]), "-o", "picture.png", *arguments, tool=tool)
        return text, made[0]

    def printed(self, *arguments):
        """Returns what the tool prints of a picture."""
        return self.drawing(lambda figure: None, *arguments)[0]

    def words(self, *arguments, tool=None, file=None):
        """Returns the texts of the picture."""
        return self.drawing(words_of, *arguments, tool=tool, file=file)[1]

    def picture(self, *arguments, tool=None, file=None):
        """Returns the colours of the picture, from 0 to 255."""
        return self.drawing(pixels_of, *arguments, tool=tool, file=file)[1]

    def refuses(self, code, sentence, *arguments, tool=None, **how):
        run = self.run_tool(*arguments, tool=tool, **how)
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertIn(sentence, run.stderr)
        self.assertNotIn("Traceback", run.stderr)
        return run


class InOneFolder(InAFolder):
    """A folder for all tests of a class."""

    @classmethod
    def setUpClass(cls):
        cls.folder = new_folder(cls.addClassCleanup)

    def setUp(self):
        pass
