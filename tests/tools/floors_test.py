"""tools/examples/floors.py. Requires OVERTURN (the binary) in the environment."""

import unittest
from unittest import mock

from tool import JOBS, TOOLS, InAFolder, module_of


class TestAPictureOfAFloor(InAFolder):
    TOOL = "examples/floors.py"
    FILE = JOBS / "synthetic.AT2"

    def test_names_what_it_shows(self):
        example = module_of(self.TOOL)
        with mock.patch.object(example, "PERIODS", example.PERIODS[::40]):
            words = self.words("--floor", "3")
        for text in ("Statue of 0.5 m x 2 m on floor 3 of 3", "lifts the statue, 0.25 g", "topples on floor 3",
                     "least that topples it on the ground, 0.59 g"):
            self.assertIn(text, words)

    def test_needs_a_record(self):
        self.refuses(2, "absent.AT2", "absent.AT2")

    def test_has_the_building_of_the_page(self):
        page, script = ((TOOLS.parent / path).read_text() for path in ("docs/floors.md", "tools/examples/floors.py"))
        for first, second in (("mass = np.array([60e3, 60e3, 40e3])", "MASS = np.array([60.0, 60.0, 40.0])"),
                              ("storey = np.array([30e6, 25e6, 20e6])", "STOREY = np.array([30.0, 25.0, 20.0])"),
                              ("periods [0.602", "FIRST_PERIOD = 0.602"),
                              ("width=0.5, height=2.0", '"width": 0.5, "height": 2.0')):
            self.assertIn(first, page)
            self.assertIn(second, script)


if __name__ == "__main__":
    unittest.main()
