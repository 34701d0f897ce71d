"""Traces of ObsPy as records of overturn.evaluate(), and the units of records. Stand-ins have the attributes that are
used; if ObsPy is installed, its own traces are tested as well. Requires the package on PYTHONPATH."""

import pathlib
import re
import subprocess
import sys
import tempfile
import types
import unittest

import numpy as np
import overturn

try:
    import obspy
except ImportError:
    obspy = None

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
BLOCK = {"width": 0.5, "height": 2.0, "restitution_of_maximum": 0.9}
SCALE = np.linspace(0.5, 3, 40)
STEP = 0.01


def samples(seed=1):
    """Two seconds of 0.5 g."""
    t = np.arange(200) * STEP
    return 0.5 * np.sin(2 * np.pi * (t + seed / 7)) * np.sin(np.pi * t / 2)


class AnArray(unittest.TestCase):
    def outcome(self, record, **arguments):
        return overturn.evaluate(**BLOCK, record=record, time_step=STEP, scale=SCALE, **arguments)["margin"].tobytes()

    def test_in_another_unit_is_converted(self):
        for units, factor in (("g", 1), ("m/s2", 8), ("cm/s2", 800), ("gal", 800), ("mm/s2", 8000)):
            whole = np.round(samples() * 1024) / 1024  # so that products and quotients are exact
            self.assertEqual(self.outcome(whole * factor, units=units, gravity=8), self.outcome(whole, gravity=8))

    def test_in_an_unknown_unit_is_refused(self):
        with self.assertRaisesRegex(ValueError, "^units = 'ft/s2' is not one of g, m/s2, cm/s2, mm/s2, gal"):
            self.outcome(samples(), units="ft/s2")
        with self.assertRaisesRegex(ValueError, r"^gravity = 0 is outside \(0, inf\)"):
            self.outcome(samples(), units="gal", gravity=0)
        with self.assertRaisesRegex(TypeError, "units has no meaning without record"):
            overturn.evaluate(**BLOCK, pulse_period=1, pga=1, units="g")


class AMotionOfThisPackage(unittest.TestCase):
    RECORD, UP = (overturn.read_record(CHECKOUT / "jobs" / f"synthetic{name}.AT2") for name in ("", "_vertical"))
    BUILDING = {"periods": 0.5, "damping": 0.05, "shape": 1.2}

    def evaluate(self, record, **arguments):
        return overturn.evaluate(**BLOCK, record=record, scale=SCALE, **arguments)["margin"].tobytes()

    def test_is_its_samples(self):
        record, up = self.RECORD, self.UP
        self.assertEqual(self.evaluate(record, vertical=up, units="g"),
                         self.evaluate(record.acceleration, vertical=up.acceleration, time_step=record.time_step))
        floor = overturn.floor_motion(record, **self.BUILDING)
        other = overturn.floor_motion(record.acceleration, record.time_step, **self.BUILDING)
        self.assertEqual(floor.acceleration.tobytes(), other.acceleration.tobytes())
        self.assertEqual(floor.time_step, other.time_step)
        self.assertEqual(self.evaluate(floor), self.evaluate(other.acceleration, time_step=other.time_step))

    def test_beside_something_else_or_in_another_unit_is_refused(self):
        for other in (self.UP.acceleration, types.SimpleNamespace(id="A", data=self.UP.acceleration, stats=None)):
            with self.assertRaisesRegex(TypeError, "^vertical is an array or a Trace, but another component is a"):
                self.evaluate(self.RECORD, vertical=other)
        with self.assertRaisesRegex(TypeError, "units = 'm/s2', but record is a Record or FloorMotion, whose"):
            self.evaluate(self.RECORD, units="m/s2")
        with self.assertRaisesRegex(TypeError, "time_step = 1, but record"):
            self.evaluate(self.RECORD, time_step=1)
        floor = overturn.floor_motion(self.RECORD, periods=0.05, damping=0.05, shape=1)
        with self.assertRaisesRegex(ValueError, r"^vertical \(FloorMotion\) has a sample every .* record \(Record\)"):
            self.evaluate(self.RECORD, vertical=floor)


class ATrace(unittest.TestCase):
    def trace(self, data, channel="HNE", delta=STEP, start=1000.0):
        stats = types.SimpleNamespace(delta=delta, starttime=start)
        return types.SimpleNamespace(id=f"XX.STA..{channel}", data=data, stats=stats)

    def stream(self, *traces):
        return types.SimpleNamespace(traces=list(traces))

    def evaluate(self, record, **arguments):
        return overturn.evaluate(**{**BLOCK, "record": record, "units": "g", "scale": SCALE, **arguments})

    def assert_refused(self, phrase, record, error=ValueError, **arguments):
        with self.assertRaises(error) as raised:
            self.evaluate(record, **arguments)
        self.assertIn(phrase, str(raised.exception))

    def test_is_its_samples(self):
        one, other, up = samples(), samples(2), 0.3 * samples(3)
        components = {"second_component": (other, "HNN"), "vertical": (up, "HNZ")}
        by_array = self.evaluate(one, time_step=STEP, direction=30, **{name: data for name, (data, _) in
                                                                       components.items()})
        by_trace = self.evaluate(self.trace(one), direction=30, **{name: self.trace(*given) for name, given in
                                                                   components.items()})
        for field, values in by_array.items():
            self.assertEqual(by_trace[field].tobytes(), values.tobytes())
        self.assertEqual(len(np.unique(by_array["verdict"])), 2)

    def test_in_a_stream_of_one_is_that_trace(self):
        trace = self.trace(samples())
        for field, values in self.evaluate(trace).items():
            self.assertEqual(self.evaluate(self.stream(trace))[field].tobytes(), values.tobytes())

    def test_needs_its_unit(self):
        self.assert_refused("Give units, one of g, m/s2", self.trace(samples()), TypeError, units=None)

    def test_states_its_time_step(self):
        trace = self.trace(samples())
        self.evaluate(trace, time_step=STEP)
        self.evaluate(self.trace(samples(), delta=float(np.float32(STEP))), time_step=STEP)  # as in SAC files
        self.assert_refused("time_step = 0.02, but record (XX.STA..HNE) has a sample every 0.01 s. Remove time_step.",
                            trace, TypeError, time_step=0.02)

    def test_of_several_is_to_be_chosen(self):
        trace = self.trace(samples())
        self.assert_refused('record is a Stream of 2 channels: XX.STA..HNE, XX.STA..HNZ. Choose one, for example by '
                            'stream.select(channel="HNE").',
                            self.stream(trace, self.trace(samples(2), "HNZ")))
        self.assert_refused("record is a Stream of 2 traces of one channel, XX.STA..HNE. Join them by stream.merge()",
                            self.stream(trace, self.trace(samples(), start=1010.0)))
        self.assert_refused("record is a Stream without traces", self.stream())

    def test_with_gaps_is_refused(self):
        data = np.ma.array(samples(), mask=np.arange(200) == 50)
        self.assert_refused("record (XX.STA..HNE) has gaps: 1 of 200 samples are masked. Choose", self.trace(data))
        self.evaluate(self.trace(np.ma.array(samples())))

    def test_at_another_time_is_refused(self):
        record = self.trace(samples())
        for late in (-0.004, 0.004):
            self.evaluate(record, vertical=self.trace(0.3 * samples(2), "HNZ", start=1000 + late))
        self.assert_refused("vertical (XX.STA..HNZ) begins 0.006 s after record (XX.STA..HNE). Cut both", record,
                            vertical=self.trace(samples(2), "HNZ", start=1000.006))
        self.assert_refused("begins 5 s before record", record, vertical=self.trace(samples(2), start=995.0))

    def test_with_other_steps_or_another_length_is_refused(self):
        record = self.trace(samples())
        self.assert_refused("second_component (XX.STA..HNN) has a sample every 0.005 s, but record (XX.STA..HNE) every "
                            "0.01 s. Resample one", record,
                            second_component=self.trace(samples(2), "HNN", delta=0.005), direction=0)
        self.assert_refused("vertical has 199 samples, but record has 200. Give both at the same times", record,
                            vertical=self.trace(samples(2)[:-1], "HNZ"))

    def test_without_samples_is_refused(self):
        self.assert_refused("record needs two or more samples", self.trace(np.empty(0)))

    def test_beside_an_array_is_refused(self):
        self.assert_refused("vertical is an array, but another component is a Trace", self.trace(samples()), TypeError,
                            vertical=samples(2))
        self.assert_refused("record is an array, but another component is a Trace", samples(), TypeError,
                            vertical=self.trace(samples(2)), time_step=STEP)


@unittest.skipIf(obspy is None, "ObsPy is not installed")
class ATraceOfObsPy(ATrace):
    def trace(self, data, channel="HNE", delta=STEP, start=1000.0):
        return obspy.Trace(data, {"network": "XX", "station": "STA", "channel": channel, "delta": delta,
                                  "starttime": obspy.UTCDateTime(start)})

    def stream(self, *traces):
        return obspy.Stream(list(traces))

    def test_of_merged_parts_has_gaps_until_they_are_filled(self):
        record = self.trace(samples())
        parts = self.stream(*(record.slice(*(obspy.UTCDateTime(time) for time in times))
                              for times in ((1000, 1000.5), (1000.6, 1002))))
        self.assert_refused("Join them by stream.merge()", parts)
        self.assert_refused("has gaps: 9 of 200 samples", parts.copy().merge())
        self.evaluate(parts.copy().merge(fill_value="interpolate"))


@unittest.skipIf(obspy is None, "ObsPy is not installed")
class TheExample(unittest.TestCase):
    def test_of_the_documentation_runs(self):
        text = (CHECKOUT / "docs/python.md").read_text()
        example = re.search(r"^```python\n(import obspy\n.*?)^```$", text, re.DOTALL | re.MULTILINE)[1]
        with tempfile.TemporaryDirectory(prefix="overturn-test-") as folder:
            subprocess.run([CHECKOUT / "tools/synthetic_record", "--suite", "20", "-o", f"{folder}/suite"], check=True,
                           stdout=subprocess.DEVNULL)
            done = subprocess.run([sys.executable, "-c", example], cwd=folder, capture_output=True, text=True)
        self.assertIn("20 motions, 1 block", done.stdout, done.stderr)


class ThePackage(unittest.TestCase):
    def test_does_not_import_obspy(self):
        done = subprocess.run([sys.executable, "-c", "import sys, overturn; overturn.evaluate, overturn.read_record; "
                               "print('obspy' in sys.modules)"], capture_output=True, text=True)
        self.assertEqual(done.stdout, "False\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
