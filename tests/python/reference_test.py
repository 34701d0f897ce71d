"""overturn.evaluate() compared with SciPy. Requires the package on PYTHONPATH."""

import unittest

import numpy as np
import overturn

try:
    from scipy.integrate import solve_ivp
except ImportError:
    solve_ivp = None


def largest_tilt(width, height, restitution, pulse_period, pga):
    """Returns the largest |theta| / alpha under a one-sine pulse, infinite if the block overturns; None if it
    comes to rest during the pulse."""
    alpha = np.arctan(width / height)
    p = np.sqrt(3 * 9.81 / (4 * np.hypot(width / 2, height / 2)))
    omega = 2 * np.pi / pulse_period

    def slope(t, y):
        lean = side * alpha - y[0]
        ground = pga * np.sin(omega * t) if t < pulse_period else 0.0
        return [y[1], -p * p * (np.sin(lean) + ground * np.cos(lean))]

    def impact(t, y):
        return side * y[0]

    def turn(t, y):
        return y[1]

    def fall(t, y):
        return abs(y[0]) - np.pi / 2

    impact.terminal, impact.direction, fall.terminal = True, -1, True
    t, y = np.arcsin(np.tan(alpha) / pga) / omega, [0.0, 0.0]
    side, largest = -1, 0.0
    while t < pulse_period + 10 / p:
        # No step crosses the end of the pulse.
        end = pulse_period if t < pulse_period else pulse_period + 20 / p
        motion = solve_ivp(slope, (t, end), y, method="DOP853", rtol=1e-11, atol=1e-13, events=(impact, turn, fall),
                           first_step=1e-5 / p)
        largest = max([largest, *(abs(turned[0]) for turned in motion.y_events[1]), *abs(motion.y[0])])
        if motion.t_events[2].size:
            return np.inf
        t, y = motion.t[-1], list(motion.y[:, -1])
        if motion.t_events[0].size:
            y = [0.0, np.sqrt(restitution) * y[1]]
            side = np.sign(y[1])
            if abs(y[1]) < 0.02 * p * alpha:
                return None if t < pulse_period else largest / alpha
    return largest / alpha


@unittest.skipIf(solve_ivp is None, "SciPy is not installed")
class AgainstSciPy(unittest.TestCase):
    def test_peaks_and_verdicts_of_random_blocks_agree(self):
        random = np.random.default_rng(3)
        compared = []
        for _ in range(25):
            block = dict(width=random.uniform(0.4, 0.8), height=random.uniform(1.5, 3),
                         restitution=random.uniform(0.6, 0.8), pulse_period=random.uniform(0.2, 0.8),
                         pga=random.uniform(0.3, 1.5))
            expected = largest_tilt(**block)
            if expected is None:
                continue
            outcome = overturn.evaluate(**block, tolerance=1e-12)
            # SciPy's errors of 1e-11 grow by less than a thousand; another number of impacts changes the peak by a
            # tenth.
            np.testing.assert_allclose(outcome["peak"], expected, rtol=1e-8, err_msg=str(block))
            compared.append(np.isinf(expected))
        self.assertGreaterEqual(len(compared), 20)
        self.assertTrue(5 < sum(compared) < len(compared) - 5)


if __name__ == "__main__":
    unittest.main()
