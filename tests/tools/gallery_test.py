"""tools/paper/gallery creates all figures and no other files.

Requires OVERTURN (the binary) in the environment. PICTURES is a folder to keep the gallery in, for
the test of its page.
"""

import os
import pathlib
import shutil
import sys
import tempfile
import unittest

import numpy as np
from tool import TOOLS, run_tool

OVERTURN = os.environ["OVERTURN"]
sys.path.insert(0, str(TOOLS / "paper"))
from packed_spectrum import UNKNOWN, decimal_codes, planes  # noqa: E402

FIGURES = ("02", "03", "04", "05", "07a", "07b_08", "09a", "09b", "10", "11a", "11b", "12a", "12b",
           "14a", "14b", "15a", "15b", "16a", "16b", "17a", "17b")
BEGINNINGS = {".png": b"\x89PNG", ".pdf": b"%PDF", ".html": b"<!doctype html>"}


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def gallery(self, *arguments, **environment):
        return run_tool("paper/gallery", *arguments, cwd=self.folder, timeout=280,
                        env=os.environ | environment)


class TestTheGallery(InAFolder):
    def test_contains_every_figure_in_both_formats_the_page_and_nothing_else(self):
        pictures = pathlib.Path(os.environ.get("PICTURES", self.folder / "pictures"))
        shutil.rmtree(pictures, ignore_errors=True)
        run = self.gallery("-o", pictures, "--points", "60", "--page")
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertLessEqual(set(self.folder.iterdir()), {pictures})
        files = sorted(path.name for path in pictures.iterdir())
        self.assertEqual(files, sorted(["index.html", *(f"figure_{figure}{suffix}"
                                                        for figure in FIGURES
                                                        for suffix in (".png", ".pdf"))]))
        for path in pictures.iterdir():
            self.assertTrue(path.read_bytes().startswith(BEGINNINGS[path.suffix]), path)
        self.assertEqual(len(run.stdout.splitlines()), len(FIGURES) + 1)


class TestANumberOnThePage(unittest.TestCase):
    @staticmethod
    def value_of(code):
        """Decodes a number as described in packed_spectrum.py."""
        if code == 0:
            return 0.0
        exponent, digits = divmod(abs(int(code)) - 1, 900)
        return float(f"{np.sign(code) * (digits + 100)}e{exponent - 32}")

    def test_is_rounded_to_three_digits(self):
        values = np.random.default_rng(1).normal(size=2000) * 10.0**np.arange(-25, 5, 0.015)
        for value, code in zip(values, decimal_codes(values)):
            self.assertEqual(self.value_of(code), float(f"{value:.2e}"))

    def test_is_rounded_to_three_digits_at_powers_of_ten_and_just_below(self):
        for value in (1, 10, 1000, 0.1, 0.001, 9.994, 9.996, -0.9996, -1, 1e-30, 0, -0.0):
            self.assertEqual(self.value_of(decimal_codes(np.array([value]))[0]),
                             float(f"{value:.2e}"))

    def test_is_unknown_if_not_finite_or_too_large_and_zero_if_tiny(self):
        self.assertEqual(list(decimal_codes(np.array([np.nan, np.inf, -np.inf, 2e6, 1e-31, -1e-300]))),
                         [UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN, 0, 0])

    def test_is_restored_from_the_differences_of_the_bytes(self):
        codes = np.array([[30000, -30000, 5], [UNKNOWN, 32767, -1]], np.int16)
        low, high = np.frombuffer(planes(codes), np.uint8).reshape(2, 6).astype(int)
        steps = (low + 256 * high).astype(np.uint16).reshape(2, 3)
        np.testing.assert_array_equal(np.cumsum(steps, axis=1, dtype=np.int16), codes)


class TestAGalleryRefused(InAFolder):
    def refuses(self, code, sentence, *arguments, **environment):
        run = self.gallery(*arguments, **environment)
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertIn(sentence, run.stderr)
        self.assertNotIn("Traceback", run.stderr)
        return run

    def test_without_the_program_states_how_to_get_it(self):
        self.refuses(2, "tools/quickstart", "--overturn", "nowhere")
        self.refuses(2, "nowhere", OVERTURN="nowhere")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_into_an_impossible_folder(self):
        (self.folder / "file").write_text("")
        self.refuses(74, "cannot write into", "-o", "file")

    def test_reports_the_failed_command_and_leaves_no_results(self):
        script = self.folder / "broken"
        script.write_text("#!/bin/sh\necho no such thing >&2\nexit 70\n")
        script.chmod(0o755)
        run = self.refuses(74, "exit code 70", "-o", "pictures", "--overturn", "broken")
        self.assertIn("no such thing", run.stderr)
        self.assertEqual([path.name for path in (self.folder / "pictures").iterdir()
                          if path.is_dir()], [])


if __name__ == "__main__":
    unittest.main()
