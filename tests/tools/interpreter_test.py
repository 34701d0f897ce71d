"""Tools started by a Python that lacks their modules."""

import os
import pathlib
import subprocess
import unittest
import venv

from tool import PATIENCE, TOOLS, InOneFolder
from overturn.installation import SYSTEM, system_has

NAMES = sorted(path.relative_to(TOOLS) for path in (*TOOLS.iterdir(), *(TOOLS / "paper").iterdir())
               if path.is_file() and b"python" in path.read_bytes().split(b"\n")[0])


class TestAPythonWithoutTheModules(InOneFolder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        venv.create(cls.folder / "bare")
        cls.programs = cls.folder / "bare" / "bin"

    def run_here(self, *command):
        path = f"{self.programs}{os.pathsep}{os.environ['PATH']}"
        return subprocess.run(command, cwd=self.folder, timeout=PATIENCE, capture_output=True,
                              text=True, env={**os.environ, "PATH": path})

    def test_is_the_first_on_the_path_and_used_by_every_tool(self):
        self.assertIn(pathlib.Path("plot_spectrum"), NAMES)
        self.assertIn(pathlib.Path("paper/gallery"), NAMES)
        for name in NAMES:
            self.assertEqual((TOOLS / name).read_text().splitlines()[0], "#!/usr/bin/env python3")

    @unittest.skipUnless(all(map(system_has, ("h5py", "matplotlib"))), f"{SYSTEM} lacks them, too")
    def test_is_replaced_by_the_systems_python(self):
        one_of = {(TOOLS / name).read_text(): name for name in NAMES}  # most have the same text
        for name in one_of.values():
            run = self.run_here(TOOLS / name, "--help")
            self.assertEqual(run.returncode, 0, run.stderr)
            self.assertIn(f"usage: {name.name} ", run.stdout)
            self.assertEqual(run.stderr, "")
        run = self.run_here(TOOLS / "plot_phase", "regions", "-o", "a picture.png")
        self.assertEqual((run.returncode, run.stdout), (0, "a picture.png\n"), run.stderr)

    def test_ends_with_the_packages_to_install_if_the_systems_lacks_them_too(self):
        for system in (self.programs / "python3", self.folder / "nothing"):
            code = (f"import sys; sys.path.insert(0, {str(TOOLS)!r}); sys.argv = ['a_tool']\n"
                    f"from overturn import installation; installation.SYSTEM = {str(system)!r}\n"
                    "try: import h5py\n"
                    "except ImportError as error: installation.run_elsewhere(error)\n")
            run = self.run_here(self.programs / "python3", "-c", code)
            self.assertEqual(run.returncode, 1)
            self.assertIn("a_tool: No module named 'h5py'", run.stderr)
            self.assertIn("tools/install_dependencies plot", run.stderr)


if __name__ == "__main__":
    unittest.main()
