"""Effect of --durable: when files are synced. Requires OVERTURN and FAULTY_DISK (the library) in
the environment."""

import os
import pathlib
import subprocess
import tempfile
import unittest

OVERTURN, LIBRARY = os.environ["OVERTURN"], os.environ["FAULTY_DISK"]
SMOKE = pathlib.Path(__file__).resolve().parents[2] / "jobs" / "smoke.toml"
TILES = 4  # of 100 x 100 points


class ADurableRun(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_job(self, name, *arguments):
        """Returns the number of times that the file was synced."""
        count = self.folder / f"{name}.count"
        subprocess.run([OVERTURN, "run", SMOKE, "-o", name, *arguments], cwd=self.folder,
                       check=True, timeout=60, capture_output=True,
                       env=os.environ | {"LD_PRELOAD": LIBRARY, "COUNT_WRITES_IN": str(count),
                                         "FAULTY_FILE": str(self.folder / name)})
        return int(count.read_text().split()[1])

    def test_syncs_each_tile_and_gives_the_same_bytes(self):
        once = self.run_job("plain.h5")  # when the file is created
        self.assertEqual(self.run_job("durable.h5", "--durable"), once + TILES + 1)
        self.assertEqual((self.folder / "durable.h5").read_bytes(),
                         (self.folder / "plain.h5").read_bytes())


if __name__ == "__main__":
    unittest.main()
