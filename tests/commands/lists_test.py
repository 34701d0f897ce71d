"""Lists of blocks: a table replaces the axes of the blocks, or all axes."""

import unittest

import h5py
import numpy as np

from program import Scratch

STATUES = """name,width,height,restitution_of_maximum,year
David,0.6,1.8,1.0,1504
"Venus, ""de Milo\""",0.5,2.0,0.9,
Nike,1.0,2.4,0.95,-190
"""
NAMES = ["David", "Venus, \"de Milo\"", "Nike"]
JOB = """
scene.pulse = "one_sine"
blocks.table = "statues.csv"
[plane]
pga = { first = 0.1, last = 2.0, count = 20 }
pulse_period = { first = 0.2, last = 2.0, count = 10 }
[output]
fields = ["region", "angle", "margin", "peak"]
"""
BLOCK = """
scene.pulse = "one_sine"
block = {{ width = {width}, height = {height} }}
[plane]
restitution_of_maximum = {share}
pga = {{ first = 0.1, last = 2.0, count = 20 }}
pulse_period = {{ first = 0.2, last = 2.0, count = 10 }}
[output]
fields = ["region", "angle", "margin", "peak"]
"""
FIELDS = ("region", "angle", "margin", "peak")

# Three tiles of 4096 blocks or fewer.
OWN = "scene.pulse = \"one_sine\"\nblocks.table = \"own.csv\"\n"


def random_blocks(rows):
    generator = np.random.default_rng(5)
    low = [0.3, 1.5, 0.7, 0.2, 0.1]
    high = [1.0, 4.0, 1.0, 2.0, 1.5]
    return generator.uniform(low, high, (rows, 5))


def table_of(values):
    rows = [",".join(map(repr, map(float, row))) for row in values]
    return "width,height,restitution_of_maximum,pulse_period,pga\n" + "\n".join(rows) + "\n"


class Lists(Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "statues.csv").write_text(STATUES)
        (self.folder / "job.toml").write_text(JOB)
        (self.folder / "own.toml").write_text(OWN)

    def compute(self, job, name, *arguments, ranks=None):
        self.assert_exit(self.overturn("run", job, "-o", name, *arguments, ranks=ranks), 0)
        return self.opened(name)

    def test_is_bit_identical_to_a_plane_per_block(self):
        data = self.compute("job.toml", "list.h5")
        self.assertEqual(data.region.dims, ("block", "pga", "pulse_period"))
        for row in range(3):
            (self.folder / "one.toml").write_text(BLOCK.format(
                width=data.width.values[row], height=data.height.values[row],
                share=data.restitution_of_maximum.values[row]))
            plane = self.compute("one.toml", f"{row}.h5")
            for field in FIELDS:
                self.assertTrue(np.array_equal(data[field].values[row], plane[field].values,
                                               equal_nan=True), (row, field))
            for coordinate in ("slenderness", "restitution"):
                self.assertEqual(float(data[coordinate][row]), plane[coordinate].item())

    def test_keeps_the_other_columns(self):
        data = self.compute("job.toml", "list.h5")
        self.assertEqual(list(data.name.values), NAMES)
        np.testing.assert_array_equal(data.year.values, [1504, np.nan, -190])
        self.assertEqual(data.width.attrs["units"], "m")

    def test_with_own_motions_has_one_point_per_block(self):
        values = random_blocks(40)
        (self.folder / "own.csv").write_text(table_of(values))
        data = self.compute("own.toml", "own.h5", "--set",
                            "output.fields=[\"region\", \"margin\"]")
        self.assertEqual(data.region.dims, ("block",))
        for row in range(0, 40, 10):
            width, height, share, period, pga = map(float, values[row])
            plane = self.compute(
                "job.toml", f"{row}.h5", "--set", f"block.width={width!r}", "--set",
                f"block.height={height!r}", "--set", f"plane.pga={pga!r}", "--set",
                f"plane.pulse_period={period!r}", "--set", f"plane.restitution_of_maximum={share!r}")
            self.assertEqual(float(data.margin[row]), float(plane.margin.values.item()))
            self.assertEqual(int(data.region[row]), int(plane.region.values.item()))

    def test_has_equal_bytes_on_any_number_of_ranks_and_when_resumed(self):
        (self.folder / "own.csv").write_text(table_of(random_blocks(10000)))
        for job in ("job", "own"):
            one = f"{job}_1.h5"
            self.compute(f"{job}.toml", one)
            whole = (self.folder / one).read_bytes()
            for ranks in (2, 3):
                name = f"{job}_{ranks}.h5"
                self.compute(f"{job}.toml", name, ranks=ranks)
                self.assertEqual((self.folder / name).read_bytes(), whole)
            with h5py.File(self.folder / one, "r+") as file:
                self.assertEqual(len(file["run/checksum"]), 1 if job == "job" else 3)
                file["run/checksum"][-1] = 0
            self.compute(f"{job}.toml", one, ranks=2)
            self.assertEqual((self.folder / one).read_bytes(), whole)
            self.assert_exit(self.overturn("verify", one), 0, "checksums match")

    def test_under_a_record_is_bit_identical_to_a_plane_per_block(self):
        rise = np.sin(np.linspace(0, 12, 300)) * 4
        (self.folder / "a.txt").write_text("".join(f"{value!r}\n" for value in rise))
        (self.folder / "b.txt").write_text("".join(f"{value!r}\n" for value in rise[::-1] / 2))
        scene = ("[scene]\nrecord = [\"a.txt\", \"b.txt\"]\ntime_step = 0.01\nunits = \"m/s2\"\n"
                 "[output]\nfields = [\"region\", \"margin\"]\n")
        (self.folder / "axes.toml").write_text(
            scene + "[blocks]\ntable = \"statues.csv\"\n[plane]\nscale = { values = [1, 2, 4] }\n")
        data = self.compute("axes.toml", "axes.h5")
        self.assertEqual(data.region.dims, ("motion", "block", "scale"))
        (self.folder / "rows.csv").write_text(
            "half_width,half_height,restitution_of_maximum,motion,scale\n"
            "0.3,0.9,1.0,b,2\n0.25,1,0.9,a.txt,4\n0.5,1.2,0.95,b.txt,1\n")
        (self.folder / "rows.toml").write_text(scene + "[blocks]\ntable = \"rows.csv\"\n")
        rows = self.compute("rows.toml", "rows.h5")
        self.assertEqual(list(rows.motion_name.values), ["b.txt", "a.txt", "b.txt"])
        table = rows.to_dataframe()  # a row per point
        np.testing.assert_array_equal(table.motion, [2, 1, 2])
        for name in ("record_pga", "pgv", "arias_intensity", "significant_duration"):
            np.testing.assert_array_equal(table[name], data[name].values[[1, 0, 1]])
        for field in ("region", "margin"):
            values = data[field].values
            np.testing.assert_array_equal(
                rows[field].values, [values[1, 0, 1], values[0, 1, 2], values[1, 2, 0]])
        for name in ("axes.h5", "rows.h5"):
            self.assert_exit(self.overturn("verify", name), 0)

    def test_is_described_by_check_and_info(self):
        self.assert_exit(self.overturn("check", "job.toml"), 0, "3 of statues.csv", "600 in 1 tile",
                         "peak 0.1 to 2 g")
        self.compute("job.toml", "list.h5")
        self.assert_exit(self.overturn("info", "list.h5"), 0, "3 values from 1 to 3",
                         "3 x 20 x 10 points each")

    def test_is_damaged_if_a_column_was_altered(self):
        self.compute("job.toml", "list.h5")
        for name in ("width", "year", "slenderness"):
            with h5py.File(self.folder / "list.h5", "r+") as file:
                kept = file[name][0]
                file[name][0] += 0.01
            self.assertNotEqual(self.overturn("verify", "list.h5").returncode, 0, name)
            with h5py.File(self.folder / "list.h5", "r+") as file:
                file[name][0] = kept
        self.assert_exit(self.overturn("verify", "list.h5"), 0)

    def test_of_a_table_that_changed_is_another_job(self):
        self.compute("job.toml", "list.h5")
        (self.folder / "statues.csv").write_text(STATUES.replace("1.8", "1.9"))
        self.assert_exit(self.overturn("run", "job.toml", "-o", "list.h5"), 74,
                         'belongs to another job: the table "statues.csv" has changed since then')

    def refused(self, table, *phrases, command=("check", "job.toml"), code=65):
        (self.folder / "statues.csv").write_text(table)
        self.assert_exit(self.overturn(*command), code, *phrases)
        self.assertFalse((self.folder / "job.h5").exists())

    def test_is_refused_with_file_line_and_column(self):
        rows = "\n".join(["a,0.5,2,1"] * 15)
        self.refused(f"name,width,height,restitution\n{rows}\nb,-0.5,2,1\n",
                     "statues.csv:17:2: width = -0.5 is outside (0, inf)")
        self.refused(f"name,width,height,restitution\n{rows}\nb,2,1\n",
                     "statues.csv:17: the row has 3 values, but the first line names 4 columns")

    def test_is_refused_where_a_plane_is_needed_or_contradicts_it(self):
        for key, words in (("restitution", "statues.csv:1:4: restitution_of_maximum cannot be combined with "
                                           "plane.restitution"),
                           ("size", "plane.size cannot be combined with the column width")):
            self.assert_exit(self.overturn("check", "job.toml", "--set", f"plane.{key}=0.9"), 65, words)
        self.refused(STATUES, "a list of blocks", command=("boundary", "job.toml"))
        self.refused(STATUES, "follows one block", code=2,
                     command=("history", "job.toml", "-o", "history.h5"))
        self.refused(STATUES, "studied on a plane", code=2,
                     command=("accuracy", "job.toml", "-o", "accuracy.h5"))
        self.refused("width,height,restitution,frequency\n1,2,0.9,2\n",
                     "plane.pulse_period cannot be combined with the column frequency")
        self.assert_exit(self.overturn("check", "job.toml", "--set", "blocks.table=none.csv"), 65,
                         "none.csv: cannot be read")


if __name__ == "__main__":
    unittest.main()
