"""The picture of a history under a record.

Requires OVERTURN (the binary) in the environment.
"""

import unittest

import h5py
import numpy as np
from tool import JOBS, InAFolder  # first: adds the package to the path
import overturn
from matplotlib import pyplot
from overturn.plot import histories
from overturn.result_file import HISTORY, open_result

JOB = """
    title = "A job"
    [scene]
    pulse = "one_sine"
    [plane]
    frequency = { values = [3.0] }
    amplitude = { values = [1.3] }
    restitution_of_maximum = 1.0
    slenderness = { values = [0.2] }
    """
IMPACT = 1  # as numbered in the file


def open_history(path):
    return open_result(path, HISTORY)


class TestTheMotionOfAHistory(InAFolder):
    """The line below the title says what moves the ground."""

    TOOL, FILE = "plot_history", "history.h5"
    JOB = f"""
        scene.record = "{JOBS / 'synthetic.AT2'}"
        [plane]
        width = 0.5
        height = 2.0
        scale = 1.0
        restitution_of_maximum = 0.9
        """

    def words_of(self, *settings):
        self.overturn("history", "history.h5", *settings)
        with open_history(self.folder / "history.h5") as file:
            return histories.describe(file)

    def test_has_components_direction_and_vertical_motion(self):
        other = f"\"{JOBS / 'synthetic_vertical.AT2'}\""
        self.assertIn("synthetic.AT2, scale", self.words_of())
        self.assertIn("synthetic.AT2, direction 180° (mirrored), scale", self.words_of("plane.direction=180"))
        self.assertIn("synthetic.AT2, vertical motion synthetic_vertical.AT2, scale",
                      self.words_of(f"scene.vertical={other}"))
        self.assertIn("synthetic.AT2, components 1 and synthetic_vertical.AT2, direction 0°, scale",
                      self.words_of(f"scene.second_component={other}", "plane.direction=0"))
        self.assertIn("components 1 and synthetic_vertical.AT2, direction 210°, scale",
                      self.words_of(f"scene.second_component={other}", "plane.direction=210"))

    def test_is_followed_by_both_sides_of_a_block(self):
        words = self.words_of("plane.center_offset=0.05")
        self.assertRegex(words, r"1/s \(\+\).*1/s \(−\).*rad \(\+\).*rad \(−\)")
        with open_history(self.folder / "history.h5") as file:
            labels = {name: label for name, label, _ in histories.History(file, 0, 9).panels}
        self.assertIn(r"\theta/\alpha_+", labels["angle"])


class TestAHistoryUnderARecord(InAFolder):
    TOOL, FILE, JOB = "plot_history", "history.h5", JOB

    def setUp(self):
        super().setUp()
        self.overturn("history", "history.h5")

    def under_a_record(self, **attributes):
        """Replaces the pulse of the history by a record."""
        if "pga" not in attributes:
            attributes["scale"] = 0.6
        attributes.setdefault("size", 3.0)
        attributes.setdefault("frequency_parameter", np.sqrt(3 * 9.81 / (4 * attributes["size"])))
        with h5py.File(self.folder / "history.h5", "a") as file:
            for name in ("pulse", "frequency", "amplitude", "pga"):
                del file.attrs[name]
            file.attrs.update({"record": "records/a_$1$.AT2", "gravity": 9.81, **attributes})

    def history(self, start=0, until=np.inf):
        with open_history(self.folder / "history.h5") as file:
            return histories.History(file, start, until)

    def test_has_ticks_without_a_common_factor_and_explains_its_dashed_lines(self):
        draw = np.random.default_rng(1)
        for power in draw.choice([-5, -4, -3, 4, 5, 6], 2, replace=False):
            with h5py.File(self.folder / "history.h5", "a") as file:
                for name in ("ground", "velocity", "q"):
                    file[name][:] = draw.uniform(0.1, 1) * 10.0**power * file[name][:] / np.abs(file[name][:]).max()
            panels = overturn.plot.history(self.folder / "history.h5")
            panels[0].figure.canvas.draw()
            self.assertEqual({panel.yaxis.get_offset_text().get_text() for panel in panels}, {""})
            self.assertIn("balance on an edge", panels[1].get_legend().get_texts()[0].get_text())
            pyplot.close("all")

    def test_has_four_digits(self):
        draw = np.random.default_rng(2)
        for size in draw.uniform(1, 9, 3):
            self.under_a_record(size=size)
            with open_history(self.folder / "history.h5") as file:
                self.assertIn(f"$R$ = {size:.4g} m", histories.describe(file))
            (self.folder / "history.h5").unlink()
            self.overturn("history", "history.h5")

    def test_has_all_digits_of_a_given_number(self):
        self.under_a_record(pga=0.46845)
        with open_history(self.folder / "history.h5") as file:
            self.assertIn("PGA = 0.46845 g", histories.describe(file))
        for name, value, text in (("pga", 0.1 + 0.2, "0.3"), ("pga", 1 / 3, "0.3333333"), ("size", 1 / 3, "0.3333"),
                                  ("size", 2.34567, "2.34567"), ("frequency", 3.0, "3")):
            self.assertEqual(histories.number_text(name, value), text)

    def test_is_in_seconds_and_in_alpha(self):
        self.under_a_record()
        p = np.sqrt(3 * 9.81 / (4 * 3.0))
        history = self.history()
        with h5py.File(self.folder / "history.h5") as file:
            np.testing.assert_allclose(history.time, file["time"][:] / p)
            np.testing.assert_allclose(history.values["angle"], file["angle"][:] / 0.2)
            np.testing.assert_array_equal(history.values["ground"], file["ground"][:])
            self.assertAlmostEqual(history.end_of_ground_motion, file.attrs["end_of_pulse"] / p)
            impacts = file["events/time"][:][file["events/kind"][:] == IMPACT]
            np.testing.assert_allclose(history.impacts(), impacts / p)
        self.assertEqual(history.limits("angle"), (-1, 1))

    def test_shows_ground_and_tilt_with_their_events(self):
        self.under_a_record()
        picture = self.svg()
        for words in ("A job", "uplift", "at rest", "time since the start of the record  [s]"):
            self.assertIn(f">{words}<", picture)
        with h5py.File(self.folder / "history.h5") as file:
            count = np.count_nonzero(file["events/kind"][:] == IMPACT)
        self.assertRegex(picture, f">{count} impacts?<")
        self.assertNotIn("velocity", picture)

    def test_states_the_point_and_the_outcome(self):
        for strength, words in (({}, "scale = 0.6"), ({"pga": 0.5}, "PGA = 0.5 g")):
            self.under_a_record(region=8, restitution=0.9, **strength)
            with open_history(self.folder / "history.h5") as file:
                self.assertEqual(histories.describe(file),
                                 rf"a_\$1\$.AT2, {words}, $R$ = 3 m, $\alpha$ = 0.2 rad, "
                                 "$r$ = 0.9: falls during the record (F−)")
            (self.folder / "history.h5").unlink()
            self.overturn("history", "history.h5")

    def test_does_not_present_an_uncertain_curve_as_the_outcome(self):
        for region, words in ((254, "undecided"), (8, r"falls during the record \(F−\)")):
            self.under_a_record(region=region, margin_error=np.inf, curve_is_certain=0)
            with open_history(self.folder / "history.h5") as file:
                self.assertRegex(histories.describe(file), f"{words}; the curve is uncertain$")
            (self.folder / "history.h5").unlink()
            self.overturn("history", "history.h5")

    def test_without_a_title_is_titled_by_its_record(self):
        self.under_a_record(title="")
        self.assertIn(">a_$1$.AT2<", self.svg())

    def test_is_drawn_from_and_until_given_times(self):
        self.under_a_record()
        history = self.history(1.0, 2.0)
        self.assertTrue((history.time >= 1).all() and (history.time <= 2).all())
        self.assertTrue(all(1 <= when <= 2 for when, _, _ in history.events))
        self.svg("--from", "1", "--until", "2")
        self.refuses(74, "has no data from 3 s to 2 s", "history.h5", "--from", "3", "--until", "2")

    def test_without_the_frequency_parameter_is_damaged(self):
        self.under_a_record()
        with h5py.File(self.folder / "history.h5", "a") as file:
            del file.attrs["frequency_parameter"]
        self.refuses(74, "is damaged", "history.h5")

    def test_under_a_pulse_keeps_its_units_and_panels(self):
        history = self.history()
        with h5py.File(self.folder / "history.h5") as file:
            np.testing.assert_array_equal(history.time, file["time"][:])
            np.testing.assert_array_equal(history.values["angle"], file["angle"][:])
        picture = self.svg()
        for words in ("velocity", "acceleration"):
            self.assertIn(words, picture)


if __name__ == "__main__":
    unittest.main()
