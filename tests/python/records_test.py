"""overturn.read_record(). Requires the package on PYTHONPATH."""

import pathlib
import tempfile
import unittest

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
