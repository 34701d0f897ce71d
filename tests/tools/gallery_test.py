"""tools/paper/gallery creates all figures and no other files.

Requires OVERTURN (the binary) in the environment.
"""

import os
import pathlib
import unittest
from unittest import mock

from tool import InAFolder, module_of

FIGURES = ("02", "03", "04", "05", "07a", "07b_08", "09a", "09b", "10", "11a", "11b", "12a", "12b",
           "14a", "14b", "15a", "15b", "16a", "16b", "17a", "17b")


class Gallery(InAFolder):
    TOOL = "paper/gallery"

    def setUp(self):
        """Figures are laid out as PNG, not encoded, nor drawn again as PDF: the tests of each tool do that."""
        super().setUp()

        def write(figure, path, **_):
            figure.draw_without_rendering()
            pathlib.Path(path).touch()

        def unless_pdf(draw):
            return lambda words: pathlib.Path(words[-1]).touch() if words[-1].endswith(".pdf") else draw(words)
        self.enterContext(mock.patch("overturn.output_file.write_picture", write))
        for tool in module_of(self.TOOL).PLOTS.values():
            self.enterContext(mock.patch.object(tool, "main", unless_pdf(tool.main)))


class TestTheGallery(Gallery):
    def test_contains_every_figure_in_both_formats_and_nothing_else(self):
        with mock.patch("shutil.which", lambda name: None):  # to start two ranks takes longer than they compute
            text = self.output_of("-o", "pictures", "--points", "30")
        self.assertEqual([path.name for path in self.folder.iterdir()], ["pictures"])
        self.assertEqual(sorted(path.name for path in (self.folder / "pictures").iterdir()),
                         sorted(f"figure_{figure}.{suffix}" for figure in FIGURES for suffix in ("png", "pdf")))
        self.assertEqual(len(text.splitlines()), len(FIGURES))


class TestAGalleryRefused(Gallery):
    def test_without_the_program_states_how_to_get_it(self):
        self.refuses(2, "tools/quickstart", "--overturn", "nowhere")
        with mock.patch.dict(os.environ, OVERTURN="nowhere"):
            self.refuses(2, "nowhere")
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_into_an_impossible_folder(self):
        (self.folder / "file").write_text("")
        self.refuses(74, "cannot write", "-o", "file")

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
