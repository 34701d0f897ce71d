"""overturn.read_record() against an independent reading of published files, and against ObsPy if it is installed.

The files are not part of the sources: the tests are skipped without them in the folder $OVERTURN_RECORDS. Requires the
package on PYTHONPATH.
"""

import os
import pathlib
import re
import unittest

import numpy as np

import overturn

FOLDER = pathlib.Path(os.environ.get("OVERTURN_RECORDS") or "missing")


def published(pattern):
    files = sorted(FOLDER.glob(pattern))
    if not files:
        raise unittest.SkipTest(f"$OVERTURN_RECORDS has no file {pattern}")
    return files


def columns(lines, width, count):
    """The first `count` numbers in columns of this width."""
    cells = (line.rstrip("\n")[at:at + width] for line in lines for at in range(0, len(line.rstrip()), width))
    return np.array([float(cell) for cell, _ in zip(cells, range(count))])


class APublishedRecord(unittest.TestCase):
    def expect(self, path, component, accelerations, time_step, rounding=0):
        """accelerations: [cm/s2]"""
        record = overturn.read_record(path, component, gravity=0.01)  # 1 cm/s2
        self.assertEqual(record.time_step, time_step, path)
        np.testing.assert_allclose(record.acceleration, accelerations, rtol=0, atol=rounding, err_msg=str(path))

    def test_of_knet_and_kiknet_is_its_counts_without_their_mean(self):
        for path in published("knet/*") + published("kiknet/*"):
            head, data = path.read_text().split("Memo.", 1)
            counts = np.array(data.split(), float)
            gal, of_counts = map(float, re.search(r"Scale Factor +(\d+)\(gal\)/(\d+)", head).groups())
            rate = float(re.search(r"Sampling Freq\(Hz\) +(\d+)", head)[1])
            expected = (counts - counts.mean()) * (gal / of_counts)
            self.expect(path, 1, expected, 1 / rate, rounding=4e-16 * abs(expected).max())

    def test_of_knet_and_kiknet_equals_that_of_obspy(self):
        try:
            import obspy
        except ImportError:
            self.skipTest("ObsPy is not installed")
        for path in published("knet/*") + published("kiknet/*"):
            trace = obspy.read(str(path), format="KNET")[0]
            expected = (trace.data - trace.data.mean()) * trace.stats.calib * 100
            self.expect(path, 1, expected, trace.stats.delta, rounding=4e-16 * abs(expected).max())

    def test_of_cosmos(self):
        for path in published("cosmos/*"):
            lines = path.read_text().splitlines()
            at = next(i for i, line in enumerate(lines) if "acceleration pts" in line)
            count, width = (int(re.search(pattern, lines[at])[1]) for pattern in (r"(\d+)", r"\(\d+[EF](\d+)\."))
            reals = next(i for i, line in enumerate(lines) if "Real-header" in line)
            of_reals = int(re.search(r"\(\d+F(\d+)\.", lines[reals])[1])
            time_step = columns(lines[reals + 1:], of_reals, 62)[61] / 1000
            self.expect(path, 1, columns(lines[at + 1:], width, count), time_step)

    def test_of_csmip(self):
        for path in published("csmip/*"):
            lines = path.read_text().splitlines()
            announcing = [i for i, line in enumerate(lines) if "points of accel data" in line]
            for number, at in enumerate(announcing, 1):
                count, step = re.match(r" *(\d+) .*spaced at +(\S+)", lines[at]).groups()
                self.expect(path, number, columns(lines[at + 1:], 10, int(count)), float(step))

    def test_of_esm(self):
        for path in published("esm/*"):
            lines = path.read_text().splitlines()
            header = dict(line.split(":", 1) for line in lines if ":" in line)
            values = [float(line) for line in lines if ":" not in line]
            self.expect(path, header["STREAM"].strip(), values, float(header["SAMPLING_INTERVAL_S"]))


if __name__ == "__main__":
    unittest.main()
