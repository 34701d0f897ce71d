"""Untrusted jobs and result files: their texts must not control the terminal, nor make the program
write to anything but the output and its sidecar."""

import os
import pathlib
import resource
import shutil
import unittest

import h5py
import numpy

from program import JOB, Scratch

TINY = JOB.format(columns=2, rows=2, restitutions="[0.7]", tolerance="1e-4")
PATHS = ("../up", "/tmp/overturn-was-here", "..", "a/b/../../../c", "~/home", "$(touch x)", "a|b", "")
FOUND = pathlib.Path(__file__).parent / "hostile"
CLEAR_SCREEN = "\x1b[2J"


class AHostileJob(Scratch):
    def inner(self):
        """Returns an inner folder, so that a file that leaves it through ".." is detected."""
        folder = self.folder / "inner"
        folder.mkdir(exist_ok=True)
        return folder

    def test_writes_only_the_output_and_its_sidecar(self):
        outside = self.files() + ["inner"]
        for number, path in enumerate(PATHS):
            job = self.inner() / f"{number}.toml"
            job.write_text(TINY.replace("A small plane", path))
            output = self.inner() / f"{number}.h5"
            override = f"title='''{path}'''"
            self.assert_exit(self.overturn("run", job, "-o", output, "--set", override), 0)
        wanted = [f"{number}{ending}" for number in range(len(PATHS))
                  for ending in (".h5", ".h5.json", ".toml")]  # fmt: skip
        self.assertEqual(sorted(path.name for path in self.inner().iterdir()), sorted(wanted))
        self.assertEqual(self.files(), sorted(outside))
        self.assertFalse(os.path.exists("/tmp/overturn-was-here"))

    def test_creates_no_file_named_by_its_keys_and_values(self):
        for path in PATHS[:-1]:
            for line in (f'"{path}" = 1', f'["{path}"]', f'output.path = "{path}"',
                         f'scene.pulse = "{path}"'):  # fmt: skip
                (self.folder / "hostile.toml").write_text(line + "\n")
                self.assert_refused(65, ["hostile.toml"], "run", "hostile.toml", "-o", "out.h5")

    def test_does_not_choose_the_folder_of_its_output(self):
        job = self.inner() / "job.toml"
        job.write_text(TINY)
        self.assert_exit(self.overturn("run", "inner/../inner/job.toml"), 0)
        self.assertIn("job.h5", self.files())

    def test_sends_no_control_characters_to_the_terminal(self):
        (self.folder / "tiny.toml").write_text(TINY.replace("A small plane", "\\u001b[2J\\u009b2J"))
        checked = self.overturn("check", "tiny.toml")
        self.assert_exit(checked, 0, "?[2J?2J")
        self.assertNotIn("\x1b", checked.stdout)
        self.assert_exit(self.overturn("run", "tiny.toml"), 0)
        told = self.overturn("info", "tiny.h5")
        self.assert_exit(told, 0, "?[2J?2J")
        self.assertNotIn("\x1b", told.stdout)


class AHostileResultFile(Scratch):
    """A complete file of the job, altered so that a run has tiles to recompute."""

    def setUp(self):
        super().setUp()
        (self.folder / "tiny.toml").write_text(TINY)
        self.assert_exit(self.overturn("run", "tiny.toml"), 0)
        (self.folder / "elsewhere").write_bytes(b"the only copy of a thesis")

    def replace_region(self, add):
        with h5py.File(self.folder / "tiny.h5", "r+") as file:
            file["run/checksum"][:] = 0
            del file["region"]
            add(file)

    def assert_refused_by_all(self, phrase):
        before = (self.folder / "elsewhere").read_bytes()
        for command in (["info", "tiny.h5"], ["verify", "tiny.h5"], ["run", "tiny.toml"]):
            self.assert_refused(74, [phrase], *command)
            self.assertEqual((self.folder / "elsewhere").read_bytes(), before)

    def test_does_not_make_a_run_write_to_its_external_storage(self):
        def add(file):
            creation = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
            creation.set_external(str(self.folder / "elsewhere").encode(), 0, 25)
            space = h5py.h5s.create_simple((1, 1, 2, 2))
            h5py.h5d.create(file.id, b"region", h5py.h5t.STD_U8LE, space, creation)

        self.replace_region(add)
        self.assert_refused_by_all("stored in another file")

    def test_does_not_make_a_run_write_to_a_linked_file(self):
        with h5py.File(self.folder / "elsewhere", "w") as file:
            file.create_dataset("region", (1, 1, 2, 2), "u1")

        def add(file):
            file["region"] = h5py.ExternalLink("elsewhere", "/region")

        self.replace_region(add)
        self.assert_refused_by_all("a link to another object")

    def test_does_not_make_a_run_write_two_fields_into_one(self):
        (self.folder / "tiny.h5").unlink()
        self.assert_exit(self.overturn("run", "small.toml", "-o", "tiny.h5"), 0)
        with h5py.File(self.folder / "tiny.h5", "r+") as file:
            del file["status"]
            file["status"] = file["region"]
        self.assert_refused_by_all("has two names")

    def test_is_reported_as_damaged_if_hdf5_crashes_or_requests_gigabytes(self):
        # As found by tools/check fuzz: HDF5 1.10.8 crashes at one of these and allocates 6 GB for the
        # other.
        for found in sorted(FOUND.iterdir()):
            shutil.copy(found, self.folder / "found.h5")
            for command in (["info", "found.h5"], ["verify", "found.h5"],
                            ["run", "tiny.toml", "-o", "found.h5"]):  # fmt: skip
                self.assert_refused(74, ['"found.h5"', "damaged"], *command)
            self.assert_refused(74, ['"found.h5"', "damaged"], *command, ranks=2)
        if "ASAN_OPTIONS" not in os.environ:
            most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024
            self.assertLess(most, 2**29 + 2**28)

    def test_sends_no_control_characters_to_the_terminal(self):
        for name in ("kind", "title", "program_version"):
            with h5py.File(self.folder / "tiny.h5", "r+") as file:
                file.attrs.create(name, numpy.bytes_(CLEAR_SCREEN))
            for command in (["info", "tiny.h5"], ["run", "tiny.toml"]):
                result = self.overturn(*command)
                self.assertNotIn("\x1b", result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
