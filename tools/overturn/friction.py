"""Friction coefficients that users give."""

import numbers

LARGEST = 2  # rubber on rock has 1


def expect_coefficient(friction):
    """Raises ValueError unless this is a friction coefficient, not an angle."""
    if isinstance(friction, bool) or not isinstance(friction, numbers.Real) or not 0 < friction <= LARGEST:
        raise ValueError(f"friction = {friction!r} is not a number above 0 and up to {LARGEST}. Give the coefficient "
                         "between block and ground, the tangent of the friction angle.")
