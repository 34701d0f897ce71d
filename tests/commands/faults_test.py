"""Behaviour of overturn with damaged tiles and silent ranks."""

import os
import re
import signal
import socket
import time
import unittest

import h5py
import numpy as np

from program import LONG_TILES, PATIENCE, Scratch, checksum, ranks_of


class ADamagedFile(Scratch):
    TILES = 24

    def setUp(self):
        super().setUp()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "whole.h5"), 0)
        self.whole = checksum(self.folder / "whole.h5")

    def damage(self, name, tiles):
        """Changes one value in each of these tiles; each restitution has 3 x 4 tiles."""
        with h5py.File(self.folder / name, "r+") as file:
            for tile in tiles:
                place = (0, tile // 12, tile % 12 // 4 * 64 + 1, tile % 4 * 64 + 2)
                file["velocity"][place] += 1e-9

    def test_is_reported_by_verify_with_the_numbers_of_its_tiles(self):
        self.assert_exit(self.overturn("verify", "whole.h5"), 0,
                         "24 of 24 tiles are done; coordinates and checksums match")
        self.damage("whole.h5", (0, 7, 23))
        self.assert_exit(self.overturn("verify", "whole.h5"), 74,
                         "the checksums of 3 of 24 finished tiles do not match (tile numbers: 0, 7, 23)",
                         "overturn run JOB.toml -o whole.h5")

    def test_has_tiles_of_another_place_or_job_although_their_checksums_came_with_them(self):
        with h5py.File(self.folder / "whole.h5", "r+") as file:
            for dataset in (each for each in file.values() if len(getattr(each, "shape", ())) == 4):
                first, second = dataset[0, 0, :64, :64], dataset[0, 0, :64, 64:128]
                dataset[0, 0, :64, :64], dataset[0, 0, :64, 64:128] = second, first
            file["run/checksum"][:2] = file["run/checksum"][:2][::-1]
        self.assert_exit(self.overturn("verify", "whole.h5"), 74, "2 of 24 finished tiles do not match", "numbers: 0, 1)")
        self.assert_exit(self.overturn("run", "small.toml", "-o", "whole.h5"), 0, "2 damaged tiles to recompute")
        self.assertEqual(checksum(self.folder / "whole.h5"), self.whole)
        with h5py.File(self.folder / "whole.h5", "r+") as file:
            job = file["run/job_resolved"]
            job[:] = np.frombuffer(job[:].tobytes().replace(b"gravity = 9.81", b"gravity = 9.80"), job.dtype)
        self.assert_exit(self.overturn("verify", "whole.h5"), 74, "24 of 24 finished tiles do not match")

    def test_is_not_complete_if_the_repairing_run_is_stopped(self):
        self.assert_exit(self.overturn("run", "long.toml", "-o", "long.h5", ranks=2), 0)
        with h5py.File(self.folder / "long.h5", "r+") as file:
            file["velocity"][:, :, ::64, ::64] += 1e-9  # all tiles
        with self.start("run", "long.toml", variables=self.with_slow("long.h5")) as process:
            self.assertIn(f"{LONG_TILES} damaged tiles to recompute", process.stdout.readline())
            process.send_signal(signal.SIGUSR1)
            process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 85)
        self.assert_exit(self.overturn("verify", "long.h5"), 0)
        with h5py.File(self.folder / "long.h5") as file:
            unmarked = file["run/checksum"][:] == 0
            self.assertGreater(np.count_nonzero(unmarked), 65)
            # Readers that ignore checksums must not take its values for computed ones either.
            points = unmarked.reshape(1, 2, 7, 7).repeat(64, 2).repeat(64, 3)
            for name in ("region", "status", "impacts"):
                fill = file[name].fillvalue
                self.assertTrue((file[name][:][points] == fill).all(), name)
            for name in ("angle", "velocity", "margin"):
                self.assertTrue((np.isnan(file[name][:]) == points).all(), name)

    def test_is_reported_if_a_checksum_is_damaged(self):
        with h5py.File(self.folder / "whole.h5", "r+") as file:
            file["run/checksum"][11] += np.uint64(1)
        self.assert_exit(self.overturn("verify", "whole.h5"), 74, "tile numbers: 11")

    def test_is_repaired_by_the_same_run_even_if_it_was_complete(self):
        for ranks in (None, 2):
            self.damage("whole.h5", (3, 12))
            result = self.overturn("run", "small.toml", "-o", "whole.h5", ranks=ranks)
            self.assert_exit(result, 0, "22 of 24 tiles done, 2 damaged tiles to recompute")
            self.assertEqual(checksum(self.folder / "whole.h5"), self.whole)

    def test_is_repaired_together_with_missing_tiles(self):
        self.damage("whole.h5", (5, 6))
        self.forget("whole.h5", slice(6, 9))
        self.assert_exit(self.overturn("verify", "whole.h5"), 74, "1 of 21 finished tiles", "tile numbers: 5")
        result = self.overturn("run", "small.toml", "-o", "whole.h5")
        self.assert_exit(result, 0, "20 of 24 tiles done, 1 damaged tile to recompute")
        self.assertEqual(checksum(self.folder / "whole.h5"), self.whole)

    def test_is_repaired_if_a_killed_run_has_left_its_random_number(self):
        for ranks in (None, 2):
            with h5py.File(self.folder / "whole.h5", "r+") as file:
                file["run/checksum"][3] = 0
                file["run/run_token"][()] = 123
            self.assert_exit(self.overturn("run", "small.toml", "-o", "whole.h5", ranks=ranks), 0)
            self.assertEqual(checksum(self.folder / "whole.h5"), self.whole)

    def test_is_not_complete_if_a_checksum_disappears_during_the_run(self):
        for ranks in (None, 2):
            (self.folder / "long.h5").unlink(missing_ok=True)
            with self.start("run", "long.toml", ranks=ranks, variables=self.with_slow("long.h5")) as process:
                self.assertIn("tiles", process.stdout.readline())
                with h5py.File(self.folder / "long.h5", locking=False) as file:
                    place = file["run/checksum"].id.get_offset()
                with (self.folder / "long.h5").open("r+b") as file:
                    mark = bytes(8)
                    while mark == bytes(8):
                        time.sleep(1e-3)
                        mark = os.pread(file.fileno(), 8, place)
                    os.pwrite(file.fileno(), bytes(8), place)
                self.go_on()
                output, _ = process.communicate(timeout=PATIENCE)
            self.assertEqual(process.returncode, 74, output)
            self.assertIn(f"the file lacks 1 of {LONG_TILES}", output)
            self.assertNotIn(": computed", output)

    def test_is_refused_by_verify_if_truncated(self):
        path = self.folder / "whole.h5"
        os.truncate(path, path.stat().st_size - 5000)
        self.assert_exit(self.overturn("verify", "whole.h5"), 74, "damaged")


class ASilentRank(Scratch):
    def test_ends_the_run_which_can_be_resumed(self):
        self.assert_exit(self.overturn("run", "long.toml", "-o", "whole.h5", ranks=2), 0)
        # Ranks 0 and 2 lead nodes of two ranks.
        for ranks_per_node, silent in ((2, 3), (2, 2), (4, 0)):
            (self.folder / "long.h5").unlink(missing_ok=True)
            with self.start("run", "long.toml", "--patience", "1", ranks=4, variables={
                    **self.with_slow("long.h5"), "OVERTURN_RANKS_PER_NODE": ranks_per_node}) as process:
                self.assertIn("tiles", process.stdout.readline())
                os.kill(ranks_of(process.pid)[silent], signal.SIGSTOP)
                output, _ = process.communicate(timeout=PATIENCE)
            self.assert_stopped(process.returncode, output, ranks=4)
            # Only ranks of its own node know the host of rank 0.
            host = f"( on {re.escape(socket.gethostname())}){'?' if silent == 0 else ''}"
            self.assertRegex(output, f"rank {silent}{host} has not responded for 1 s")
        self.assert_exit(self.overturn("run", "long.toml"), 0)
        self.assertEqual(checksum(self.folder / "long.h5"), checksum(self.folder / "whole.h5"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
