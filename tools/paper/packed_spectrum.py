"""A spectrum as embedded in a web page: every computed point, in three significant digits.

The bytes are deflated and encoded in base64: frequencies and amplitudes as doubles; then for each
of FIELDS the low bytes of its numbers, then the high bytes; then the region codes. A number has 16
bits: its decimal code minus that of its left neighbour, or the code itself in the first column.
Neighbours differ little: deflating leaves half a byte of the seven bytes of a point."""

import base64
import zlib

import numpy as np

from overturn.fields import read_field
from overturn.spectrum_file import open_spectrum

FIELDS = ("angle", "velocity", "margin")
UNKNOWN = -32768
LEAST_EXPONENT = -30  # smaller values are 0
LIMIT = 9.99e5  # larger values have no code
STEPS = 900  # per power of ten: 100 to 999


def decimal_codes(values):
    """Encodes three decimal digits and an exponent as one number that increases with the value.
    1.00 to 9.99 times 10^LEAST_EXPONENT are 1 to 900, and so on up to 10^6; the sign is that of
    the value."""
    size = np.abs(values)
    size = np.where(np.isfinite(size) & (size >= 10.0**LEAST_EXPONENT), size, 1)
    exponent = np.floor(np.log10(size))
    # Rounding 9.995 and more gives 1000, which is the code of 1.00 of the next power.
    digits = np.rint(100 * (size / 10.0**exponent))
    codes = (exponent - LEAST_EXPONENT) * STEPS + digits - 99
    codes = np.where(np.abs(values) < 10.0**LEAST_EXPONENT, 0, np.sign(values) * codes)
    known = np.abs(values) < LIMIT
    return np.where(known, codes, UNKNOWN).astype(np.int16)


def planes(codes):
    """Returns differences along rows, modulo 2^16: low bytes, then high bytes."""
    steps = np.diff(codes, axis=1, prepend=np.int16(0)).astype("<i2")
    return steps.view(np.uint8).reshape(-1, 2).T.tobytes()


class PackedSpectrum:
    """The packed spectrum of a file that contains only one."""

    def __init__(self, path):
        with open_spectrum(path, ("region", *FIELDS)) as file:
            region = read_field(file, "region", (0, 0))
            parts = [np.asarray(file[axis], "<f8").tobytes() for axis in ("frequency", "amplitude")]
            parts += [planes(decimal_codes(read_field(file, field, (0, 0)))) for field in FIELDS]
            self.source = file.attrs["source"].decode()
        self.rows, self.columns = region.shape
        self.text = base64.b64encode(zlib.compress(b"".join([*parts, region.tobytes()]))).decode()
