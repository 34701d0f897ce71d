"""overturn.read_record(). Requires the package on PYTHONPATH."""

import pathlib
import tempfile
import unittest
import warnings

import numpy as np

import overturn

JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"


class ARecord(unittest.TestCase):
    def text_file(self, text):
        folder = tempfile.TemporaryDirectory(prefix="overturn-test-")
        self.addCleanup(folder.cleanup)
        path = pathlib.Path(folder.name) / "record.txt"
        path.write_text(text)
        return path

    def test_of_a_format_that_states_everything(self):
        record = overturn.read_record(JOBS / "synthetic.AT2")
        self.assertEqual((record.format, record.time_step), ("AT2", 0.01))
        self.assertAlmostEqual(abs(record.acceleration).max(), 0.4, delta=1e-3)  # tools/synthetic_record --pga 0.4
        self.assertEqual(record.acceleration.dtype, float)

    def test_of_text_is_converted_to_g(self):
        record = overturn.read_record(self.text_file("# a comment\n0\n4.905\n-9.81\n"), time_step=0.5, units="m/s2")
        self.assertEqual(record.acceleration.tolist(), [0, 0.5, -1])
        self.assertEqual((record.time_step, record.header), (0.5, ["# a comment"]))
        on_the_moon = overturn.read_record(self.text_file("0\n1.62\n"), time_step=0.5, units="m/s2", gravity=1.62)
        self.assertEqual(on_the_moon.acceleration.tolist(), [0, 1])

    def v2a_file(self, *names):
        """A file of components with these names, of two samples each; the peak of the first is 2 % too large."""
        lines = []
        for number, name in enumerate(names, 1):
            header = {1: "Corrected accelerogram", 10: "Number of points 2", 13: f"Component {name}",
                      14: f"Acceleration: peak {102 if number == 1 else 100 * number}.00 mm/s/s",
                      20: "       0       0       0       2       0       0",
                      23: "       0       0       0       0       0     0.1"}
            lines += [header.get(line, "") for line in range(1, 27)] + [f"       0{100 * number:8}"]
        return self.text_file("\n".join(lines) + "\n")

    def test_is_chosen_by_a_name_that_no_other_component_has(self):
        path = self.v2a_file("360", "90", "360")
        for choice, acceleration in (("90", 200), (2, 200), (1, 100), (np.int64(3), 300)):
            record = overturn.read_record(path, choice, gravity=0.001)
            self.assertEqual(record.acceleration.tolist(), [0, acceleration])
        with self.assertRaisesRegex(ValueError, 'component = 360 is the name of 2 components of .*1 \\("360"\\), 2 '
                                                '\\("90"\\), .* Give the number of one'):
            overturn.read_record(path, "360")
        with self.assertRaisesRegex(ValueError, "component = None is neither"):
            overturn.read_record(path, None)

    def test_warns_of_a_header_that_differs_by_little(self):
        path = self.v2a_file("Up", "360")
        with self.assertWarnsRegex(UserWarning, "record.txt:14: the peak is 102.00 mm/s2, but that of the samples is "
                                                "100 mm/s2[.]$") as warned:
            overturn.read_record(path, "Up")
        self.assertEqual(warned.filename, __file__)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            overturn.read_record(path, "360")

    def test_refusals(self):
        path = self.text_file("0\n1\n")
        for error, phrase, arguments in (
                (overturn.RecordError, "not state the unit", {"time_step": 0.5}),
                (overturn.RecordError, "time_step", {"units": "g"}),
                (ValueError, 'units = "feet" is not one of g, m/s2', {"time_step": 0.5, "units": "feet"}),
                (ValueError, "component = 2 is not a component", {"time_step": 0.5, "units": "g", "component": 2})):
            with self.assertRaises(error) as raised:
                overturn.read_record(path, **arguments)
            self.assertIn(phrase, str(raised.exception))
        with self.assertRaisesRegex(overturn.RecordError, "cannot be read"):
            overturn.read_record("missing.AT2")


if __name__ == "__main__":
    unittest.main()
