"""Files that the tools write: complete or absent, and never in place of a file of another kind.

Requires OVERTURN (the binary) in the environment.
"""

import random
import re
import resource
import shutil
import signal
import stat
import unittest
import unittest.mock

from matplotlib import pyplot
from tool import JOBS, InAFolder, new_folder, run_overturn, run_tool  # first: adds the package to the path
from overturn import csv_table
from overturn.output_file import OutputError, new_file, write_text
from overturn.result_file import Variable


class TestAWrittenFile(InAFolder):
    WRITERS = (("to_csv", "result.h5", "-o", "{}"), ("synthetic_record", "-o", "{}"),
               ("plot_phase", "regions", "-o", "{}.svg"))

    @classmethod
    def setUpClass(cls):
        folder = new_folder(cls.addClassCleanup)
        cls.result = folder / "result.h5"
        run_overturn(folder, "run", JOBS / "smoke.toml", "result.h5", "plane.frequency.count=20",
                     "plane.amplitude.count=20")

    def setUp(self):
        super().setUp()
        shutil.copy(self.result, self.folder / "result.h5")

    def run_tool(self, *words):
        return run_tool(*words, cwd=self.folder)

    def files(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir()}

    def refuses(self, path, *words):
        before = self.files()
        run = self.run_tool(*words)
        self.assertEqual(run.returncode, 74, (words, run.stderr))
        self.assertRegex(run.stderr, f'cannot write "{path}": it exists and is not an? .*. Remove it, or')
        self.assertEqual({name: data for name, data in self.files().items() if name in before}, before)

    def test_of_another_kind_is_refused_by_every_writer_and_remains(self):
        draw = random.Random(1)
        others = [self.result.read_bytes(), b"inventory,width,height\nA-01,0.42,1.55\n", b"{}",
                  b"pulse_period,pga,width,height,restitution_of_maximum\n0.5,0.4,0.6,1.8,0.9\n",
                  b"frequency,amplitude,region,remark\n1,2,0,precious\n", b"region,width,height\nItaly,0.4,1.5\n",
                  b"region,width\n1,0.4\n", b"width,region\n0.4,1\n0.5,see p. 7\n", b"width,region\n0.4,1,2\n",
                  b"time [s],angle [degree],velocity [degree s-1]\n0,1,2\n", b"RECORD OF A STATION\n",
                  b"<?xml version='1.0'?><other/>", draw.randbytes(100), draw.randbytes(10_000)]
        for *words, pattern in self.WRITERS:
            for content in others if words[0] == "to_csv" else draw.sample(others, 1):
                path = pattern.format("taken")
                (self.folder / path).write_bytes(content)
                self.refuses(path, *words, path)
        self.refuses("result.h5", "to_csv", "result.h5", "-o", "result.h5")

    def test_that_is_a_picture_of_another_program_is_refused_and_remains(self):
        figure, axes = pyplot.subplots(figsize=(2, 2))
        axes.plot([1, 2])
        for suffix in (".png", ".pdf", ".svg"):
            path = f"statue{suffix}"
            figure.savefig(self.folder / path)
            self.refuses(path, "plot_spectrum", "result.h5", "-o", path)
            (self.folder / path).unlink()
            for _ in range(2):  # a picture of its own is replaced
                run = self.run_tool("plot_spectrum", "result.h5", "-o", path)
                self.assertEqual(run.returncode, 0, run.stderr)
        pyplot.close(figure)

    def test_of_another_kind_is_refused_behind_a_link(self):
        (self.folder / "link.csv").symlink_to("result.h5")
        self.refuses("link.csv", "to_csv", "result.h5", "-o", "link.csv")
        (self.folder / "dangling.csv").symlink_to("nowhere")
        run = self.run_tool("to_csv", "result.h5", "-o", "dangling.csv")
        self.assertEqual(run.returncode, 74)
        self.assertIn("a link to a file that does not exist", run.stderr)

    def test_of_no_bytes_is_replaced(self):
        (self.folder / "new.csv").touch()
        self.assertEqual(self.run_tool("to_csv", "result.h5", "-o", "new.csv").returncode, 0)
        self.assertTrue((self.folder / "new.csv").stat().st_size)

    def test_that_is_a_pipe_is_written_directly(self):
        run = run_tool("to_csv", "result.h5", "-o", "/dev/stdout", cwd=self.folder, timeout=60)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertTrue(csv_table.is_own(run.stdout.removesuffix("/dev/stdout\n").encode()))

    def test_is_replaced_by_one_of_its_kind_but_not_on_a_full_disk(self):
        soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
        handler = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # a write beyond the limit fails, as on a full disk
        self.addCleanup(signal.signal, signal.SIGXFSZ, handler)
        self.addCleanup(resource.setrlimit, resource.RLIMIT_FSIZE, (soft, hard))
        for number, (*words, pattern) in enumerate(self.WRITERS):
            path = self.folder / pattern.format(number)
            self.assertEqual(self.run_tool(*words, path.name).returncode, 0, words)
            written = path.read_bytes()
            path.write_bytes(written[:len(written) // 2])
            path.chmod(0o640)
            self.assertEqual(self.run_tool(*words, path.name).returncode, 0, words)
            self.assertEqual((path.stat().st_size, stat.S_IMODE(path.stat().st_mode)), (len(written), 0o640))
            before = self.files()
            resource.setrlimit(resource.RLIMIT_FSIZE, (300, hard))
            run = self.run_tool(*words, path.name)
            resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
            self.assertEqual(run.returncode, 74, (words, run.stderr))
            self.assertRegex(run.stderr, f'cannot write "{path.name}": File too large.')
            self.assertEqual(self.files(), before)

    def test_that_fails_at_any_moment_leaves_the_earlier_one(self):
        draw = random.Random(2)
        path = self.folder / "text"
        for _ in range(20):
            path.write_text("old")
            error = draw.choice([OSError(28, "No space left on device"), OSError("an error without a number"),
                                 KeyboardInterrupt()])
            with self.assertRaises((KeyboardInterrupt, OutputError)) as raised:
                with new_file(path, "a text", lambda _: True) as part, open(part, "w") as file:
                    file.write("n" * draw.randrange(10_000))
                    raise error
            self.assertEqual(isinstance(raised.exception, KeyboardInterrupt), isinstance(error, KeyboardInterrupt))
            self.assertNotIn("None", str(raised.exception))
            self.assertEqual(self.files().keys(), {"result.h5", "text"})
            self.assertEqual(path.read_text(), "old")

    def test_may_be_a_table_of_every_field(self):
        table = (JOBS.parent / "docs" / "results.md").read_text().split("\n## Fields\n")[1].split("\n## ")[0]
        rows = re.findall(r"^\| (`.*?) \|", table, re.MULTILINE)
        self.assertEqual(csv_table.FIELDS, set(re.findall(r"`(\w+)`", " ".join(rows))))

    def test_that_cannot_be_created_is_named_with_the_reason(self):
        (self.folder / "folder").mkdir()
        for path, reason in (("nowhere/a", "No such file or directory"), ("folder", "Is a directory")):
            with self.assertRaises(OutputError) as raised:
                write_text(self.folder / path, "x", "a text", lambda _: True)
            self.assertEqual(str(raised.exception), f'cannot write "{self.folder / path}": {reason}.')

    def test_is_not_blamed_for_an_error_of_reading(self):
        with unittest.mock.patch.object(Variable, "__getitem__", side_effect=OSError("Can't read data")):
            run = self.run_tool("to_csv", "result.h5")
        self.assertEqual(run.returncode, 74)
        self.assertIn('"result.h5" is damaged: Can\'t read data', run.stderr)
        self.assertEqual(self.files().keys(), {"result.h5"})


if __name__ == "__main__":
    unittest.main()
