"""Titles of pictures: they end within the picture, however long they are.

Requires OVERTURN (the binary) in the environment.
"""

import shutil
import unittest

import numpy as np
from tool import JOBS, InAFolder  # first: adds the package to the path
from matplotlib import pyplot
from overturn import plot
from overturn.captions import told_apart
from overturn.plot.headings import width_of, wrapped

TITLE = "A marble figure of 2.1 m, which leans by 1.5 degrees, and of which nobody remembers whom it represents"
JOB = f"""
    title = "{TITLE}"
    scene.record = "{JOBS / 'synthetic.AT2'}"
    [plane]
    width = 0.5
    height = 2.0
    scale = {{ first = 0.5, last = 1.5, count = 11 }}
    restitution_of_maximum = 0.9
    """


class TestALongTitle(InAFolder):
    JOB = JOB

    def expect_within(self, axes):
        figure = axes.figure
        self.addCleanup(pyplot.close, figure)
        figure.draw_without_rendering()
        for text in figure.texts:
            box = text.get_window_extent()
            self.assertLess(box.x1, figure.bbox.x1, text.get_text())
            self.assertLess(box.y1, figure.bbox.y1, text.get_text())
            for panel in figure.axes:
                self.assertFalse(box.overlaps(panel.get_window_extent()), text.get_text())
        heights = figure.bbox.y1 * np.sort([text.get_position()[1] for text in figure.texts])
        self.assertGreater(np.diff(heights).min(), 9)  # pixels between two baselines
        self.assertIn(TITLE, " ".join(text.get_text() for text in figure.texts))

    def test_ends_within_the_narrow_picture_of_one_boundary(self):
        self.overturn("boundary", "boundary.h5", "plane.incline=0.02")
        self.expect_within(plot.boundary(self.folder / "boundary.h5"))

    def test_ends_within_the_picture_of_a_history(self):
        self.overturn("history", "history.h5", "plane.scale=1.1", "plane.center_offset=0.02", "plane.incline=0.02",
                      "plane.direction=180", f"scene.vertical=\"{JOBS / 'synthetic_vertical.AT2'}\"")
        self.expect_within(plot.history(self.folder / "history.h5")[0])

    def test_of_a_panel_is_between_its_neighbours(self):
        for number in range(3):
            shutil.copy(JOBS / "synthetic.AT2", self.folder / f"of_a_station_with_a_long_name_{number}.AT2")
        self.overturn("run", "suite.h5", "scene.record=\"of_*.AT2\"",
                      "plane.center_offset.values=[0,0.02,0.05,0.1]", "plane.incline.values=[0.01,0.02]",
                      "plane.scale.count=3", "plane.direction=180")
        panels = plot.spectrum(self.folder / "suite.h5")
        self.expect_within(panels[0])
        self.assertEqual(len(panels), 12)
        boxes = [panel.title.get_window_extent() for panel in panels]
        others = [*boxes, *(panel.get_window_extent() for panel in panels)]
        for box in boxes:
            self.assertEqual([other for other in others if other is not box and box.overlaps(other)], [])

    def test_is_shortened_where_it_does_not_differ(self):
        for texts, shown in ((["a long name 1", "a long name 2"], ["…name 1", "…name 2"]),
                             (["1 of some", "2 of some"], ["1 of s…", "2 of s…"]), (["a", "b"], ["a", "b"]),
                             ((["begins like 1 ends like", "begins like 2 ends like"],) * 2),
                             (["same same", "same same"], ["same s…", "same s…"])):
            self.assertEqual(told_apart(texts, 7), shown)

    def test_is_broken_between_words_or_after_commas(self):
        words, width = "one two, three four, five", width_of("one two, three", 10)
        self.assertEqual(wrapped(words, 10, width, ","), ["one two,", "three four,", "five"])
        self.assertEqual(wrapped(words, 10, width), ["one two, three", "four, five"])
        self.assertEqual(wrapped("one two three", 10, width_of("one two", 10)), ["one two", "three"])
        self.assertEqual(wrapped("", 10, 1), [""])


if __name__ == "__main__":
    unittest.main()
