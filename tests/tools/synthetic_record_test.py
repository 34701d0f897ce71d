"""The records that tools/synthetic_record writes, and those in jobs/, which it has written."""

import unittest

import numpy as np
from tool import JOBS, InAFolder

GRAVITY = 9.80665  # [m/s2]


class Written(InAFolder):
    TOOL = "synthetic_record"

    def write(self, *arguments, output="synthetic.AT2"):
        """Runs the tool, which must write this file; returns its bytes."""
        self.assertEqual(self.output_of(*arguments), output + "\n")
        return (self.folder / output).read_bytes()

    def values(self, *arguments):
        """Returns the fourth line of the header and the accelerations [g]."""
        _, _, _, sampling, *rows = self.write(*arguments).decode("ascii").splitlines()
        return sampling, np.array(" ".join(rows).split(), float)


class TestTheShippedRecords(Written):
    def test_the_horizontal_one_is_that_of_no_arguments(self):
        self.assertEqual(self.write(), (JOBS / "synthetic.AT2").read_bytes())

    def test_the_vertical_one_has_another_seed_and_half_the_peak(self):
        self.assertEqual(self.write("--seed", "2", "--pga", "0.2", "-o", "v.AT2", output="v.AT2"),
                         (JOBS / "synthetic_vertical.AT2").read_bytes())


class TestASyntheticRecord(Written):
    def test_has_the_peak_the_time_step_and_the_duration_of_its_arguments(self):
        sampling, values = self.values("--duration", "5", "--time-step", "0.005", "--pga", "0.75")
        self.assertEqual(sampling, "NPTS=   1001, DT= 0.005 SEC")
        self.assertEqual(len(values), 1001)
        self.assertEqual(np.abs(values).max(), 0.75)

    def test_differs_with_the_seed(self):
        _, first = self.values()
        _, other = self.values("--seed", "7")
        # Independent records of a few hundred independent values; equal ones give 1.
        self.assertLess(abs(np.corrcoef(first, other)[0, 1]), 0.2)

    def test_ends_at_rest(self):
        for seed in ("1", "2", "3"):
            _, values = self.values("--seed", seed)
            velocity = np.cumsum(values[1:] + values[:-1]) / 2 * 0.01 * GRAVITY  # [m/s]
            # The filter decays as exp(-0.94 t/s) while the envelope decays; without it the velocity
            # of noise would end at about a third of its peak.
            self.assertLess(abs(velocity[-1]), 0.01 * np.abs(velocity).max())
            self.assertLess(abs(np.cumsum(velocity)[-1]) * 0.01, 0.01)  # [m]

    def test_has_its_energy_in_the_frequencies_of_earthquakes(self):
        _, values = self.values()
        power = np.abs(np.fft.rfft(values)) ** 2
        frequency = np.fft.rfftfreq(len(values), 0.01)  # [Hz]
        within = power[(0.5 < frequency) & (frequency < 10)].sum()
        self.assertGreater(within, 0.8 * power.sum())  # 0.87; of white noise, a fifth


class TestASuite(Written):
    def suite(self):
        self.assertEqual(self.output_of("--suite", "20"), "suite\n")
        return sorted((self.folder / "suite").iterdir())

    def test_consists_of_different_records(self):
        paths = self.suite()
        self.assertEqual([path.name for path in paths], [f"{number:02}.AT2" for number in range(1, 21)])
        commands = [path.read_text().splitlines()[1] for path in paths]
        self.assertEqual(len(set(commands)), 20)
        # Of 20 records, 3 in 10 have a pulse; with a probability of 0.999 at least 1 and at most 12.
        self.assertIn(sum("--pulse-period" in command for command in commands), range(1, 13))

    def test_consists_of_records_that_the_command_in_their_header_writes(self):
        for path in self.suite()[:4]:
            words = path.read_text().splitlines()[1].split()
            self.assertEqual(self.write(*words[1:]), path.read_bytes())


class TestASuiteOfComponents(Written):
    def suite(self, components, folder):
        self.assertEqual(self.output_of("--suite", "4", "--components", components, "-o", folder), folder + "\n")
        return {path.name: path.read_text() for path in sorted((self.folder / folder).iterdir())}

    def test_has_names_that_pair_and_the_records_of_a_suite_as_first_components(self):
        names = [f"0{number}_{end}.AT2" for number in (1, 2, 3, 4) for end in ("H1", "H2", "V")]
        three, two = self.suite("3", "three"), self.suite("2", "two")
        self.assertEqual(list(three), names)
        self.assertEqual(two, {name: text for name, text in three.items() if "V" not in name})
        self.output_of("--suite", "4")
        for path in (self.folder / "suite").iterdir():
            self.assertEqual(path.read_text(), three[f"{path.stem}_H1.AT2"])

    def test_consists_of_records_that_the_command_in_their_header_writes(self):
        for text in list(self.suite("3", "three").values())[:3]:
            self.assertEqual(self.write(*text.splitlines()[1].split()[1:]).decode(), text)

    def test_has_equal_horizontal_peaks_half_of_it_upwards_and_independent_noise(self):
        three = {name: (text.splitlines()[1], np.array(" ".join(text.splitlines()[4:]).split(), float))
                 for name, text in self.suite("3", "three").items()}
        for number in ("01", "02", "03", "04"):
            (first, h1), (second, h2), (third, v) = (three[f"{number}_{end}.AT2"] for end in ("H1", "H2", "V"))
            peaks = [np.abs(values).max() for values in (h1, h2, v)]
            self.assertEqual(peaks[0], peaks[1])
            self.assertAlmostEqual(peaks[2] / peaks[0], 0.5, delta=0.5 * 0.005)  # of three digits
            self.assertNotIn("--pulse-period", second + third)
            # Of 120 pairs, the standard deviation is 0.09. Equal noise gives 1.
            for one, other in ((h1, h2), (h1, v), (h2, v)):
                self.assertLess(abs(np.corrcoef(one, other)[0, 1]), 0.3)


class TestAPulse(Written):
    def test_has_a_velocity_above_that_of_the_noise_and_ends_at_rest(self):
        def velocity(*arguments):
            _, values = self.values(*arguments)
            return np.cumsum(values[1:] + values[:-1]) / 2 * 0.01 * GRAVITY
        for period in ("1", "3"):
            noise, pulse = velocity(), velocity("--pulse-period", period)
            # The ratio of the peak velocities is 1.5, and the noise adds up to 1; the record is scaled to its PGA.
            ratio = np.abs(pulse).max() / np.abs(noise).max()
            self.assertGreater(ratio, 0.9)
            window = slice(int(500 - 100 * float(period)), int(500 + 100 * float(period)))
            self.assertIn(np.abs(pulse).argmax(), range(window.start, window.stop))
            self.assertLess(abs(pulse[-1]), 0.01 * np.abs(pulse).max())


class TestASyntheticRecordRefused(Written):
    def refuses(self, code, sentence, *arguments):
        super().refuses(code, sentence, *arguments)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_of_arguments_that_are_not_positive(self):
        for name in ("--duration", "--time-step", "--pga"):
            for value in ("0", "-1", "nan", "inf"):
                self.refuses(2, "must be above 0 and finite", f"{name}={value}")
        self.refuses(2, "must be 0 or above", "--seed=-1")

    def test_of_too_few_or_too_many_samples(self):
        self.refuses(2, "must give 11 to 1000000 samples", "--duration", "0.05")
        self.refuses(2, "must give 11 to 1000000 samples", "--duration", "1e300")

    def test_of_a_peak_that_has_no_digits_or_too_many(self):
        for pga in ("1e-9", "1e9"):
            self.refuses(2, "is outside 0.001 to 1000", "--pga", pga)

    def test_of_a_suite_among_other_records(self):
        self.output_of("--suite", "5")
        super().refuses(74, "it holds other records, such as 03.AT2", "--suite", "2")
        self.output_of("--suite", "5")

    def test_of_a_pulse_that_does_not_fit_or_a_suite_of_none(self):
        self.refuses(2, "is above a quarter of the duration", "--pulse-period", "6")
        self.refuses(2, "is outside 1 to 9999", "--suite", "0")
        self.refuses(2, "cannot be combined with --suite", "--suite", "3", "--pulse-period", "1")

    def test_of_components_without_a_suite_or_among_other_records(self):
        self.refuses(2, "--components 3 needs --suite", "--components", "3")
        self.output_of("--suite", "2")
        super().refuses(74, "it holds other records, such as 01.AT2", "--suite", "2", "--components", "2")

    def test_of_an_output_in_a_missing_folder(self):
        self.refuses(74, "cannot write \"nowhere/a.AT2\"", "-o", "nowhere/a.AT2")


if __name__ == "__main__":
    unittest.main()
