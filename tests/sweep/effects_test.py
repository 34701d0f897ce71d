#!/usr/bin/env python3
"""Options cost nothing unless requested: the minimal scene, which computes only the region, costs
nothing else. Instruction counts are exact and repeatable; each is compared with that of the
same build when it calls the kernel directly, or for another scene, so that none depends on the
compiler.

Changes that make these tests fail, each tried:
  TheMinimalScene   the sweep runs the kernel that counts impacts, or computes a field, in any scene
                    or with every region, whether it keeps the values or not; one kernel for both
  EveryField        a field that is computed for the region; all fields in every scene; memory for
                    fields that were not requested
  Choices           the linear theory, or the rectangular pulse, computes the sine of the others
The cost of regions() and margins() inside a kernel is not tested."""

import functools
import json
import os
import subprocess
import sys
import unittest

sys.path.insert(0, os.environ["BENCHMARKS"])
import effects  # noqa: E402

SIDE = 20  # one-time costs, such as those of the heap, are small beside those of the cheapest field
# Method: a loose and a fine tolerance. Both tolerances of Taylor are within the range of order 20,
# which the benchmark program uses when it calls the kernel directly.
TOLERANCES = {"rk45": ("1e-4", "1e-8"), "taylor": ("1e-8", "1e-12")}
# Per point: the heap also holds the few numbers of a row, and lists of fields.
BYTES_OF_A_POINT = {"region": 1, "angle": 8, "velocity": 8, "margin": 8, "status": 1, "error": 8, "impacts": 2,
                    "steps": 4, "peak": 8, "fall_time": 8, "friction_demand": 8, "normal": 8}
BYTES_BESIDE = 0.25
# Impacts, errors, peaks and the contact have kernels of their own. The compiler may make the one that counts impacts cheaper than the one without: it has no cost
# that a test could rely on.
MEASURED = [field for field in effects.FIELDS if field not in ("impacts", "error", "peak", "friction_demand", "normal")]


@functools.cache
def counter():
    return effects.Counter(os.environ["BENCH_EFFECTS"])


def tearDownModule():
    counter().close()


@functools.cache
def measure(*words):
    return counter().measure(*words)


def sweep(*fields, method="rk45", pulse="one_sine", theory="nonlinear", side=SIDE,
          tolerance="1e-5"):
    return measure("sweep", method, pulse, theory, "avx2", side, tolerance, *fields)


@functools.cache
def heap(*fields):
    """The sweep without counting instructions, for its memory."""
    words = ("sweep", "rk45", "one_sine", "nonlinear", "avx2", str(SIDE), "1e-5", *fields)
    return json.loads(subprocess.run([os.environ["BENCH_EFFECTS"], *words], check=True, capture_output=True).stdout)


def by_hand(what, method="rk45", side=SIDE, tolerance="1e-5"):
    return measure("by-hand", method, side, tolerance, what)


def difference(larger, smaller, of="instructions"):
    """Returns the difference per point."""
    return (larger[of] - smaller[of]) / larger["points"]


def cost_of(field):
    return difference(sweep("region", field), sweep("region"))


def overhead(fields, what):
    """Returns what the sweep needs per point in addition to the direct call; on a larger tile, on
    which one-time costs are small."""
    large = {"side": 48, "tolerance": "1e-3"}
    return difference(sweep(*fields, **large), by_hand(what, **large))


class TheMinimalScene(unittest.TestCase):
    def test_runs_the_kernel_that_records_nothing(self):
        # The cost around the kernel does not depend on the tolerance: the difference between two
        # tolerances is that of the kernel, to the instruction.
        for method, (loose, fine) in TOLERANCES.items():
            with self.subTest(method=method):
                def kernel_alone(run):
                    return (run(side=16, tolerance=fine)["instructions"]
                            - run(side=16, tolerance=loose)["instructions"])

                lean = kernel_alone(functools.partial(by_hand, "nothing", method))
                counting = kernel_alone(functools.partial(by_hand, "impacts", method))
                self.assertNotEqual(lean, counting, "the two kernels cannot be distinguished")
                for fields in (("region",), ("region", "angle", "velocity", "margin", "status")):
                    swept = kernel_alone(functools.partial(sweep, *fields, method=method))
                    self.assertEqual(swept, lean, fields)

    def test_computes_only_its_kernel_and_its_region(self):
        cheapest = min(cost_of(field) for field in MEASURED)
        self.assertLess(overhead((), "nothing"), 0.5 * cheapest)
        self.assertLess(overhead(("region",), "region"), 0.5 * cheapest)

    def test_allocates_only_outcomes_and_regions(self):
        self.assertLess(difference(sweep(), by_hand("nothing"), "bytes"), BYTES_BESIDE)
        self.assertAlmostEqual(difference(heap("region"), heap(), "bytes"), 1, delta=BYTES_BESIDE)


class EveryField(unittest.TestCase):
    def test_costs_instructions_only_where_it_is_requested(self):
        for field in MEASURED:
            with self.subTest(field=field):
                other = "angle" if field == "status" else "status"
                beside_other = difference(sweep(other, field), sweep(other))
                # A field that the region computes anyway would be cheaper together with it, and a
                # field computed in any case would cost nothing.
                self.assertGreater(beside_other, 2 * overhead((), "nothing"))
                self.assertAlmostEqual(cost_of(field), beside_other, delta=0.1 * beside_other)

    def test_allocates_its_own_memory(self):
        for field in effects.FIELDS:
            with self.subTest(field=field):
                self.assertAlmostEqual(difference(heap("region", field), heap("region"), "bytes"),
                                       BYTES_OF_A_POINT[field], delta=BYTES_BESIDE)


class Choices(unittest.TestCase):
    # In instructions, the linear theory takes 0.70 of the nonlinear one, and 0.90 if it also
    # computes the sine; the rectangular pulse takes 0.57 of the half sine, and 0.78.
    def test_the_linear_theory_does_not_compute_the_sine_of_the_tilt(self):
        linear = sweep("region", theory="linear", tolerance="1e-6")["instructions"]
        self.assertLess(linear, 0.8 * sweep("region", tolerance="1e-6")["instructions"])

    def test_a_constant_push_does_not_compute_the_sine_of_the_phase(self):
        rectangular = sweep("region", pulse="rectangular", tolerance="1e-6")["instructions"]
        half_sine = sweep("region", pulse="half_sine", tolerance="1e-6")["instructions"]
        self.assertLess(rectangular, 0.7 * half_sine)


if __name__ == "__main__":
    unittest.main(verbosity=2)
