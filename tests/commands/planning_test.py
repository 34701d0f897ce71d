"""What is known of a run before it starts, from overturn check, and while it lasts, from overturn info."""

import datetime
import json
import os
import signal
import time
import unittest

from program import JOB, LONG_TILES, PATIENCE, Scratch

JOB_TO_PLAN = JOB.format(columns=70, rows=66, restitutions="[0.7]", tolerance="1e-4")  # 4 tiles
FEW_LINES = ("--set=plane.frequency={ first = 4, last = 8, count = 3 }", "--set=plane.amplitude.count=5")
BYTES = {"region": 1, "angle": 8, "velocity": 8, "margin": 8, "impacts": 2, "status": 1}
POINTS = 70 * 66
INFO = {"file", "bytes", "contains", "title", "program_version", "program_commit", "axes", "fields", "tiles",
        "part", "parts", "tiles_done", "items", "items_all", "items_done", "state", "items_per_second", "elapsed_seconds", "seconds_left",
        "refreshed_seconds_ago", "ranks"}  # fmt: skip
NUMBERS = {"items_all", "tiles", "file_bytes", "ranks", "seconds", "core_hours", "tile_share", "start_seconds",
           "seconds_per_tile", "tiles_sampled", "memory_bytes", "memory_bytes_of_rank_0"}  # fmt: skip
NUMBERS_OR_NULL = {"free_bytes", "quota_bytes", "quota_used_bytes", "creation_seconds", "integrated_share"}


class Planning(Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "small.toml").write_text(JOB_TO_PLAN)

    def plan(self, *arguments, **options):
        result = self.overturn("check", *arguments, "--json", **options)
        self.assert_exit(result, 0)
        return json.loads(result.stdout)

    def test_has_the_documented_names(self):
        plan = self.plan("small.toml", "--ranks", "3")
        texts = {"file", "contains", "items", "kernel"}
        self.assertEqual(set(plan), NUMBERS | NUMBERS_OR_NULL | texts | {"fields", "fits", "warnings"})
        for name in NUMBERS:
            self.assertGreater(plan[name], 0, name)
        for name in NUMBERS_OR_NULL - {"quota_used_bytes"}:
            self.assertTrue(plan[name] is None or plan[name] > 0, name)
        self.assertEqual(plan["file"], str(self.folder.resolve() / "small.h5"))
        self.assertEqual([plan["items"], plan["items_all"], plan["tiles"], plan["ranks"]], ["points", POINTS, 4, 3])
        self.assertEqual(plan["fields"], [{"name": name, "bytes_per_value": size, "bytes": size * POINTS}
                                          for name, size in BYTES.items()])  # fmt: skip
        self.assertNotIn("small.h5", self.files())

    def test_core_hours_are_ranks_times_hours(self):
        for ranks in (1, 2, 1000):
            plan = self.plan("small.toml", "--ranks", ranks)
            hours = ranks * plan["seconds"] / 3600
            self.assertLess(abs(plan["core_hours"] / hours - 1), 1e-15 * 4)  # two roundings
            self.assertLessEqual(plan["tile_share"], 1)

    def test_bytes_are_those_of_the_file(self):
        self.overturn("run", "small.toml", "-o", "run.h5")
        self.overturn("boundary", "small.toml", "-o", "boundary.h5", *FEW_LINES)
        for name, arguments in (("run", ()), ("boundary", ("--boundary", *FEW_LINES))):
            plan = self.plan("small.toml", *arguments)
            size = (self.folder / f"{name}.h5").stat().st_size
            # The bound that result_writer.hpp states.
            self.assertLessEqual(size, plan["file_bytes"])
            self.assertLess(plan["file_bytes"], 1.03 * size + 32768)

    def test_of_a_boundary_counts_lines_and_flips(self):
        plan = self.plan("small.toml", "--boundary", *FEW_LINES)
        self.assertEqual([plan["contains"], plan["items"], plan["items_all"]],
                         ["overturning boundary", "lines", 3])
        self.assertEqual(plan["fields"][0], {"name": "flip_amplitude", "bytes_per_value": 8, "bytes": 8 * 64 * 3})
        self.assertEqual(plan["file"], str(self.folder.resolve() / "small_boundary.h5"))

    def test_states_the_share_of_a_filled_spectrum_that_is_integrated(self):
        plan = self.plan("small.toml", "--set=numerics.fill=true", "--set=output.fields=['region']")
        self.assertGreater(plan["integrated_share"], 0)
        self.assertLess(plan["integrated_share"], 1)
        self.assertIsNone(self.plan("small.toml")["integrated_share"])

    def test_space_is_that_of_the_folder_of_the_file(self):
        for place in (place for place in (str(self.folder), "/dev/shm") if os.access(place, os.W_OK)):
            plan = self.plan("small.toml", "-o", f"{place}/out.h5")
            found = os.statvfs(place)
            # Others write there meanwhile.
            self.assertLess(abs(plan["free_bytes"] - found.f_bavail * found.f_frsize), 2**30)
            self.assertTrue(plan["fits"])

    def test_is_unknown_where_the_folder_has_no_disk(self):
        for place in ("/proc", str(self.folder / "missing")):
            plan = self.plan("small.toml", "-o", f"{place}/out.h5")
            for name in ("free_bytes", "quota_bytes", "quota_used_bytes", "fits", "creation_seconds"):
                self.assertIsNone(plan[name], name)
            self.assertGreater(plan["seconds"], 0)
        self.assert_exit(self.overturn("check", "small.toml", "-o", "/proc/out.h5"), 0,
                         "space unknown in /proc; quota unknown", "without the creation of the file")

    def test_quota_is_that_of_the_user_or_group_that_has_less_left(self):
        def plan(**quotas):
            words = [f"LD_PRELOAD={os.environ['FAULTY_DISK']}", *(f"QUOTA_OF_{who}={it}" for who, it in quotas.items())]
            return self.plan("small.toml", shell_setup="export " + " ".join(words))

        for quotas, expected in (
            ({"USER": "2048000000,1000"}, (2048000000, 1000, True)),
            ({"USER": "2048000000,1000", "GROUP": "102400,5"}, (102400, 5, False)),
            ({"USER": "102400,102399", "GROUP": "2048000000,5"}, (102400, 102399, False)),
            ({"GROUP": "0,5"}, (None, 5, True)),  # no limit
            ({}, (None, None, True)),
        ):
            found = plan(**quotas)
            self.assertEqual((found["quota_bytes"], found["quota_used_bytes"], found["fits"]), expected)

    def test_of_ten_billion_points_needs_little_memory(self):
        # The axes take 8 bytes per value, and the simulated list of tiles 20 MB.
        huge = [f"--set=plane.{axis}.count=100000" for axis in ("frequency", "amplitude")]
        limit = None if "ASAN_OPTIONS" in os.environ else "ulimit -d 300000"  # AddressSanitizer reserves more
        plan = self.plan("small.toml", *huge, "--ranks", "256", shell_setup=limit)
        self.assertEqual(plan["items_all"], 10**10)
        self.assertGreater(plan["file_bytes"], sum(BYTES.values()) * 10**10)
        self.assertGreater(plan["core_hours"], 1)

    def test_warns_if_most_ranks_would_wait(self):
        for ranks, is_warned in ((1, False), (4096, True)):
            found = self.overturn("check", "small.toml", "--ranks", ranks)
            self.assert_exit(found, 0)
            self.assertEqual("fewer ranks cost less" in found.stderr, is_warned, found.stderr)

    def test_refuses_an_impossible_number_of_ranks(self):
        for ranks in ("0", "-1", "many"):
            self.assert_exit(self.overturn("check", "small.toml", "--ranks", ranks), 2, "--ranks")


class Watching(Scratch):
    def sidecar(self):
        return json.loads((self.folder / "long.h5.json").read_text())

    def info(self):
        result = self.overturn("info", "long.h5", "--json")
        self.assert_exit(result, 0)
        return json.loads(result.stdout)

    def start_slow_run(self, ranks=None):
        """Returns when the run has printed its first line."""
        run = self.start("run", "long.toml", ranks=ranks, variables=self.with_slow("long.h5"))
        self.assertIn(f"in {LONG_TILES} tiles", run.stdout.readline())
        return run

    def wait_for_tiles(self, run):
        deadline = time.monotonic() + PATIENCE
        while self.info()["tiles_done"] == 0:
            self.assertIsNone(run.poll(), "the run ended too early")
            self.assertLess(time.monotonic(), deadline)

    def test_a_run_has_a_sidecar_from_its_start_that_is_replaced_at_its_end(self):
        for ranks in (None, 2):
            with self.start_slow_run(ranks) as run:
                first = self.sidecar()
                self.assertEqual(first["state"], "running")
                self.assertEqual([first["items"], first["items_all"], first["items_done"], first["rank_count"]],
                                 ["points", 448 * 448 * 2, 0, ranks or 1])
                self.assertIsNone(first["seconds_left"])
                with (self.folder / "long.h5.json").open() as opened:
                    self.go_on()
                    run.communicate(timeout=PATIENCE)
                    self.assertEqual(json.load(opened), first)  # not truncated
            last = self.sidecar()
            self.assertEqual([last["state"], last["items_done"], last["seconds_left"]],
                             ["finished", 448 * 448 * 2, 0])
            self.assertEqual(sum(rank["tiles"] for rank in last["ranks"]), LONG_TILES)
            self.assertNotIn("long.h5.json.part", self.files())
            (self.folder / "long.h5").unlink()

    def test_info_follows_a_run_that_is_stopped_and_resumed(self):
        with self.start_slow_run() as run:
            self.wait_for_tiles(run)
            found = self.info()
            self.assertEqual(set(found), INFO)
            self.assertEqual([found["state"], found["tiles"], found["items"], found["items_all"], found["ranks"]],
                             ["running", LONG_TILES, "points", 448 * 448 * 2, 1])
            self.assertEqual(found["items_done"], int(448 * 448 * 2 * found["tiles_done"] / LONG_TILES))
            self.assertLess(found["refreshed_seconds_ago"], PATIENCE)
            # Of this moment, whenever the sidecar was written.
            left = (found["items_all"] - found["items_done"]) / found["items_per_second"]
            self.assertLess(abs(found["seconds_left"] / left - 1), 1e-14)
            self.assert_exit(self.overturn("info", "long.h5"), 0, "a run on 1 rank writes this file: ", " points/s, ", " left")
            run.send_signal(signal.SIGUSR1)
            run.communicate(timeout=PATIENCE)
        found = self.info()
        self.assertEqual([found["state"], found["seconds_left"]], ["stopped", None])
        self.assertGreater(found["items_per_second"], 0)
        self.assert_exit(self.overturn("info", "long.h5"), 0, "no run writes this file")
        self.go_on()
        self.assert_exit(self.overturn("run", "long.toml"), 0)
        found = self.info()
        self.assertEqual([found["state"], found["seconds_left"], found["tiles_done"]], ["finished", 0, LONG_TILES])

    def test_info_does_not_know_the_state_after_a_kill(self):
        with self.start_slow_run() as run:
            self.wait_for_tiles(run)
            run.kill()
            run.communicate()
        found = self.sidecar()
        self.assertEqual(found["state"], "running")
        before = datetime.datetime.now(datetime.timezone.utc) - datetime.timedelta(seconds=100)
        text = (self.folder / "long.h5.json").read_text()
        (self.folder / "long.h5.json").write_text(
            text.replace(found["refreshed"], before.strftime("%Y-%m-%dT%H:%M:%S.000Z")))
        found = self.info()
        self.assertEqual([found["state"], found["seconds_left"]], ["unknown", None])
        self.assertGreaterEqual(found["refreshed_seconds_ago"], 100)
        self.assert_exit(self.overturn("info", "long.h5"), 0, "the last report of a run is 1 min 4")
        odd = '{\n  "program_version": "3", "state": "running", "refreshed": "%s", "items_before": %s}'
        for broken in (odd % ("9999-12-31T23:59:59.999Z", 0), odd % ("2000-01-01T00:00:00.000Z", -(2**63)),
                       odd % ("today", 1e300)):
            (self.folder / "long.h5.json").write_text(broken)
            self.assertEqual(self.info()["state"], "unknown")
        for broken in ("", "{", '{\n  "program_version": []}', '{\n  "program_version": "3", "state": 7}'):
            (self.folder / "long.h5.json").write_text(broken)
            found = self.info()
            self.assertEqual([found["state"], found["refreshed_seconds_ago"]], ["unknown", None])

    def test_info_of_a_history_has_no_tiles(self):
        at = "frequency=3,amplitude=1.5,restitution_of_maximum=0.7"
        self.assert_exit(self.overturn("history", "small.toml", "--at", at, "-o", "h.h5"), 0)
        result = self.overturn("info", "h.h5", "--json")
        self.assertEqual(json.loads(result.stdout)["contains"], "rocking history")
        self.assertNotIn("tiles", json.loads(result.stdout))


if __name__ == "__main__":
    unittest.main(verbosity=2)
