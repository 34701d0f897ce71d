"""The package before it is used. Requires OVERTURN (the binary) in the environment and the package on
PYTHONPATH."""

import os
import pathlib
import subprocess
import sys
import tomllib
import unittest


def run_python(text, **environment):
    return subprocess.run([sys.executable, "-c", text], env={**os.environ, **environment}, capture_output=True,
                          text=True)


class ThePackage(unittest.TestCase):
    def test_imports_nothing_before_it_is_used(self):
        done = run_python("import overturn, sys; print({'numpy', 'h5py', 'matplotlib', 'xarray', 'overturn._core'}"
                          " & set(sys.modules))")
        self.assertEqual(done.stdout, "set()\n", done.stderr)

    def test_has_the_version_of_the_program(self):
        done = run_python("import overturn; print(overturn.__version__)")
        program = subprocess.run([os.environ["OVERTURN"], "--version"], capture_output=True, text=True)
        self.assertEqual(done.stdout.strip(), program.stdout.split()[1], done.stderr)
        citation = (pathlib.Path(__file__).resolve().parents[2] / "CITATION.cff").read_text()
        self.assertIn(f"\nversion: {done.stdout}", citation)

    def test_lists_its_functions(self):
        done = run_python("import overturn; print([name for name in overturn.__all__ if not getattr(overturn, name)"
                          " or name not in dir(overturn)])")
        self.assertEqual(done.stdout, "[]\n", done.stderr)

    def test_has_the_same_commands_in_a_checkout_and_installed_by_pip(self):
        folder = pathlib.Path(__file__).resolve().parents[2]
        done = run_python("from overturn.installation import TOOLS; print(*TOOLS)")
        tools = done.stdout.split()
        self.assertEqual({path.name for path in (folder / "tools").iterdir() if path.is_file()
                          and "run_command()" in path.read_text()}, {*tools}, done.stderr)
        scripts = tomllib.loads((folder / "pyproject.toml").read_text())["project"]["scripts"]
        self.assertEqual(scripts, {f"overturn-{name}".replace("_", "-"): "overturn.installation:run_command"
                                   for name in tools})

    def test_says_what_to_do_if_its_module_is_missing(self):
        done = run_python("import overturn; overturn.evaluate()", OVERTURN="/nowhere/overturn")
        self.assertIn("ImportError: the compiled module of overturn is not in", done.stderr)
        self.assertIn("/nowhere/python", done.stderr)

    def test_names_the_python_that_lacks_numpy(self):
        done = run_python("import sys; sys.modules['numpy'] = None; import overturn; overturn.evaluate")
        self.assertIn(f"(Python: {sys.executable}). Install it for this Python, or Debian's python3-numpy for",
                      done.stderr)

    def test_refuses_a_numpy_that_its_module_does_not_support(self):
        done = run_python("import numpy; from overturn import _core; _core.supports_numpy_2 = False; "
                          "numpy.__version__ = '2.4.6'; import overturn; overturn.evaluate")
        self.assertIn("has NumPy 2.4.6, but the compiled module", done.stderr)

    def test_reports_a_missing_program(self):
        done = run_python("import overturn; overturn.check('job.toml')", OVERTURN="/nowhere/overturn")
        self.assertIn('ProgramError: there is no program "/nowhere/overturn"', done.stderr)

    def test_needs_no_mpi_and_no_hdf5(self):
        done = run_python("import overturn; overturn.evaluate; print(open('/proc/self/maps').read())")
        self.assertIn("_core", done.stdout)
        for library in ("libmpi", "libhdf5"):
            self.assertNotIn(library, done.stdout)


if __name__ == "__main__":
    unittest.main()
