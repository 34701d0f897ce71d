"""Messages of overturn.evaluate() if its arguments are wrong. Requires the package on PYTHONPATH."""

import unittest
import warnings

import numpy as np
import overturn

GOOD = {"width": 0.6, "height": 2.4, "restitution": 0.87, "pulse_period": 0.9, "pga": 0.4}
RECORD = {"width": 0.6, "height": 2.4, "restitution": 0.87, "record": [0.0, 0.3, 0.0], "time_step": 0.1, "scale": 1}


class Refused(unittest.TestCase):
    def assert_refused(self, error, phrase, given=GOOD, **changes):
        arguments = {name: value for name, value in {**given, **changes}.items() if value is not None}
        with self.assertRaises(error) as raised:
            overturn.evaluate(**arguments)
        self.assertIn(phrase, str(raised.exception))
        self.assertNotIn("column", str(raised.exception))


class AFunction(unittest.TestCase):
    HAZARD = overturn.risk.Hazard([0.1, 0.5, 1], [1e-2, 1e-3, 1e-4], "pga", "g")
    CURVE = overturn.risk.lognormal(0.5, 0.4, im="pga", units="g")
    RISK = overturn.risk.annual_rate(HAZARD, CURVE)
    # Functions of one argument; one that is a count, a positive number, or an array.
    COUNTS = {"ranks": lambda value: overturn.run({}, ranks=value)}
    NUMBERS = {"years": lambda value: overturn.risk.largest_factor(AFunction.HAZARD, AFunction.CURVE, value, 0.5),
               "survival": lambda value: overturn.risk.largest_factor(AFunction.HAZARD, AFunction.CURVE, 100, value),
               "median": lambda value: overturn.risk.lognormal(value, 0.4, im="pga", units="g"),
               "beta": lambda value: overturn.risk.lognormal(0.5, value, im="pga", units="g"),
               "mean": lambda value: overturn.risk.Age.normal(value, 1),
               "sigma": lambda value: overturn.risk.Age.lognormal(1000, value),
               "rate": lambda value: AFunction.HAZARD.scaled(rate=value),
               "level": lambda value: AFunction.HAZARD.scaled(level=value)}
    ARRAYS = {"x": HAZARD.at, "years": RISK.survival,
              "edges": lambda value: overturn.risk.annual_rate(AFunction.HAZARD, AFunction.CURVE, edges=value),
              "weights": lambda value: overturn.risk.updated_weights([AFunction.HAZARD], value, AFunction.CURVE, 100),
              "probability": lambda value: overturn.risk.Age.quantiles(value, [1, 2]),
              "low": lambda value: overturn.risk.binned([1, 2, 3], value, im="pga", units="g")}

    def test_names_its_argument_if_it_is_of_another_kind(self):
        for functions, values in ((self.COUNTS, (0, -1, 1.5, True, "2", [1, 2], None, np.nan, np.inf, 1j, {}, "two")),
                                  (self.NUMBERS, (0, -1, True, "2", [1, 2], None, np.nan, 1j, {}, object(), "two")),
                                  (self.ARRAYS, ("2", 1j, {}, object(), ["two"]))):
            for name, function in functions.items():
                for value in values:
                    with self.subTest(name=name, value=value):
                        with self.assertRaises(ValueError) as raised:
                            function(value)
                        self.assertIn(name, str(raised.exception))

    def test_takes_a_list_where_it_takes_an_array(self):
        np.testing.assert_allclose(self.HAZARD.at([0.1, 1, 0, -1]), [1e-2, 1e-4, np.nan, np.nan], rtol=1e-14)
        for survival in (self.RISK.survival, self.RISK.survival_interval):
            np.testing.assert_array_equal(survival([1, 10]), np.stack([survival(1), survival(10)], axis=1))

    def test_leaks_no_warning_of_overflow(self):
        for median in (1e-300, 1e-3, 1e3, 1e300):
            for beta in (1e-6, 0.5, 1e3):
                curve = overturn.risk.lognormal(median, beta, im="pga", units="g", samples=[[1e-300, 1e-3], [1e300, 1]])
                for on in ("rate", "level"):
                    with self.subTest(median=median, beta=beta, on=on), warnings.catch_warnings():
                        warnings.simplefilter("error")
                        overturn.risk.largest_factor(self.HAZARD, curve, 1e4, 0.5, on)


class ARefusal(Refused):
    def test_names_the_argument_and_its_index(self):
        self.assert_refused(ValueError, "at index (1,): width = -1 is outside (0, inf)", width=[1, -1])
        self.assert_refused(ValueError, "at index (1, 2): pga = nan is outside [0, inf)",
                            pga=[[0, 0, 0], [0, 0, np.nan]])
        self.assert_refused(ValueError, "at index (1, 0): pulse_period = inf is outside (0, inf)",
                            pulse_period=[[1], [np.inf]], pga=[0.1, 0.2, 0.3])
        self.assert_refused(ValueError, "at index (0, 1): scale = -1 is outside", RECORD, scale=[[1, -1]])

    def test_suggests_the_nearest_word(self):
        for name, value, meant in (("pulse", "ricker", "symmetric_ricker"), ("method", "rk4", "rk45"),
                                   ("theory", "Linear", "linear"), ("fields", ["peaks"], "peak")):
            self.assert_refused(ValueError, f'Did you mean "{meant}"?', **{name: value})

    def test_names_no_index_of_a_number(self):
        for name, value, phrase in (("restitution", 1.2, "restitution = 1.2 is outside (0, 1]"),
                                    ("height", np.nan, "height = nan is outside"),
                                    ("tolerance", 1, "tolerance = 1 is outside [1e-14, 0.01]"),
                                    ("gravity", np.nan, "gravity = nan is outside (0, inf)"),
                                    ("pulse", "square", 'pulse = "square" is not one of one_sine'),
                                    ("theory", "quantum", 'theory = "quantum" is not one of nonlinear, linear'),
                                    ("cycles", 2, "cycles has no meaning for the pulse"),
                                    ("gravity", [1, 2], "gravity has the shape (2,)"),
                                    ("pulse", ["one_sine"], "pulse = ['one_sine'] is not a word"),
                                    ("method", None, "method = None is not a word"),
                                    ("width", True, "width is not a number"),
                                    ("width", "0.5", "width is not a number"),
                                    ("width", [0.5, "0.6"], "width is not a number")):
            with self.assertRaises(ValueError) as raised:
                overturn.evaluate(**{**GOOD, name: value})
            self.assertTrue(str(raised.exception).startswith(phrase), str(raised.exception))

    def test_of_lengths_in_centimetres_or_millimetres_asks_for_those_in_metres(self):
        for unit in (100, 1000):
            self.assert_refused(ValueError, "Lengths are in metres: 0.6 m x 2.4 m?", width=[0.6, 0.6 * unit],
                                height=[2.4, 2.4 * unit])

    def test_of_shapes_that_do_not_broadcast(self):
        self.assert_refused(ValueError, "do not broadcast: width (3,), pga (2,)", width=[1, 2, 3], pga=[1, 2])

    def test_of_a_restitution_that_no_slenderness_allows(self):
        self.assert_refused(ValueError, "r_max is defined only for a slenderness below", restitution=None,
                            restitution_of_maximum=1, width=6)

    def test_of_a_factor_on_a_record_that_overflows(self):
        for peak in (1e-309, 5e-324, 1e-320, -1e-310):
            self.assert_refused(ValueError, "pga = 1: scale = inf is outside [0, inf). The factor on a record", RECORD,
                                record=[0, peak, 0], scale=None, pga=1)
        self.assert_refused(ValueError, "scale = 1e+200: vertical_pga = inf is outside", RECORD, record=[0, 1e200, 0],
                            vertical=[0, 2e200, 0], scale=1e200)

    def test_of_masked_values(self):
        for masked in (np.ma.array([0.5, 0.6], mask=[0, 1]), [np.ma.array([0.5], mask=[1])], np.ma.masked):
            self.assert_refused(ValueError, "width has masked values", width=masked)
        self.assert_refused(ValueError, "record has masked values", RECORD,
                            record=np.ma.array([0, 0.3, 0], mask=[0, 1, 0]))
        self.assertEqual(overturn.evaluate(**{**GOOD, "width": np.ma.array([0.6, 0.7])})["region"].shape, (2,))

    def test_of_arrays_that_are_not_numbers(self):
        for array in (np.array([0.6 + 0.1j]), np.array([0.6 + 0j], object), np.array(["2020"], "M8[D]"),
                      np.array([1], "m8[s]"), np.array([np.datetime64("2020")], object), np.array([object()])):
            self.assert_refused(ValueError, "width is not a number or an array of numbers", width=array)
        self.assert_refused(ValueError, "width has an integer beyond the range of double precision", width=10**400)

    def test_of_samples(self):
        self.assert_refused(ValueError, "record[1] = nan is not finite", RECORD, record=[0, np.nan])
        self.assert_refused(ValueError, "vertical has 2 samples, but record has 3", RECORD, vertical=[0, 0])
        for component in ("vertical", "second_component"):
            self.assert_refused(ValueError, f"{component} has the accelerations of record", RECORD,
                                **{component: RECORD["record"]})
        self.assert_refused(ValueError, "two or more samples", RECORD, record=[0, 0])
        self.assert_refused(ValueError, "record has 2 dimensions", RECORD, record=[[1, 2]])
        self.assert_refused(ValueError, "time_step = 0 is outside", RECORD, time_step=0)
        self.assert_refused(ValueError, 'method = "rk45" is for pulses only', RECORD, method="rk45")

    def test_of_a_tolerance_at_which_errors_are_not_known(self):
        self.assert_refused(ValueError, "too loose for resolve", resolve=True, method="rk45", tolerance=1e-3)


class AnArgumentError(Refused):
    def test_for_a_pulse_beside_a_record(self):
        for kind in (TypeError, ValueError):
            self.assert_refused(kind, "pulse cannot be combined with record", RECORD, pulse="one_sine")

    def test_of_missing_arguments(self):
        self.assert_refused(TypeError, "Give width and height", width=None)
        self.assert_refused(TypeError, "restitution is missing", restitution=None)
        self.assert_refused(TypeError, "the ground motion is incomplete", pga=None)
        self.assert_refused(TypeError, "the ground motion is incomplete", pulse_period=None)
        self.assert_refused(TypeError, "pulse_period needs the dimensions of the block", width=None, height=None,
                            slenderness=0.2)
        self.assert_refused(TypeError, "a record needs time_step", RECORD, time_step=None)
        self.assert_refused(TypeError, "either scale or pga", RECORD, scale=None)

    def test_of_arguments_that_contradict_each_other(self):
        self.assert_refused(TypeError, "half_width cannot be combined with width", half_width=1)
        self.assert_refused(TypeError, "pga cannot be combined with amplitude", amplitude=1)
        self.assert_refused(TypeError, "pulse_period cannot be combined with frequency", frequency=1)
        self.assert_refused(TypeError, "pulse_period cannot be combined with record", RECORD, pulse_period=1)
        self.assert_refused(TypeError, "scale has no meaning without record", scale=1)
        self.assert_refused(TypeError, "either scale or pga", RECORD, pga=1)


if __name__ == "__main__":
    unittest.main()
