"""python -m overturn: tests an installation of the package, in a second."""

import platform
import sys
import time

import numpy as np
import overturn
from overturn import core

FREQUENCIES = np.linspace(0.5, 8, 60)[:, np.newaxis]  # over p
AMPLITUDES = np.linspace(1.05, 10, 60)  # over the acceleration that lifts the block
BLOCK = {"slenderness": 0.25, "restitution_of_maximum": 0.95}


def plane(**options):
    return overturn.evaluate(**BLOCK, frequency=FREQUENCIES, amplitude=AMPLITUDES, **options)


def methods_agree():
    """Compares verdicts of the Taylor method with those of the Runge-Kutta method."""
    verdicts = [plane(method=method, resolve=True)["verdict"] for method in ("taylor", "rk45")]
    has_both = {overturn.Verdict.SAFE, overturn.Verdict.OVERTURNS} == set(np.unique(verdicts[0]))
    return has_both and np.array_equal(*verdicts)


def mirror_images_agree():
    """Compares the bits of a motion with those of its mirror image."""
    results = [plane(direction=direction) for direction in (0, 180)]
    return all(np.array_equal(results[0][name], results[1][name], equal_nan=True) for name in ("peak", "margin"))


def records_agree():
    """Compares a sine with a record of its samples, whose linear pieces differ from it by at most 1.3e-6 of its peak."""
    pga = np.linspace(0.1, 1.0, 30)
    period, samples = 0.8, 2000
    record = np.sin(2 * np.pi * np.arange(samples + 1) / samples)
    block = {"width": 0.4, "height": 1.6, "restitution_of_maximum": 0.95, "pga": pga}
    pulse = overturn.evaluate(**block, pulse_period=period)
    recorded = overturn.evaluate(**block, record=record, time_step=period / samples)
    clear = np.abs(pulse["margin"]) > 1e-3
    return clear.sum() > 20 and np.array_equal(pulse["verdict"][clear], recorded["verdict"][clear])


def main():
    print(f"overturn {overturn.__version__}, Python {platform.python_version()}, NumPy {np.__version__}, {core.__file__}")
    passed = True
    for name, test in (("two methods give the same verdicts of 3600 points", methods_agree),
                       ("a motion and its mirror image give the same bits", mirror_images_agree),
                       ("a pulse and a record of it give the same verdicts", records_agree)):
        begin = time.perf_counter()
        agrees = test()
        print(f"{'passed' if agrees else 'FAILED'}: {name} ({time.perf_counter() - begin:.2f} s)")
        passed = passed and agrees
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
