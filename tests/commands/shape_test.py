"""Jobs and commands with a pulse of one's own, scene.pulse = "table"."""

import json
import unittest

import h5py
import numpy as np

from program import Scratch, checksum

JOB = """
[scene]
pulse = "table"
shape = "shape.csv"
[plane]
width = 0.6
height = 1.8
pulse_period = { first = 0.2, last = 2.0, count = 70 }
pga = { first = 0.1, last = 2.0, count = 70 }
restitution_of_maximum = 1.0
[output]
fields = ["region", "margin", "peak", "status"]
"""
TRIANGLE = "# time over period; value\nt/T; a\n1; 0\n1,25; -5\n1,5; 0\n"
STATUE = ("--width", "0.6", "--height", "1.8", "--period", "0.5")
TABLE = ("--pulse", "table", "--shape", "shape.csv")


class AShape(Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "shape.csv").write_text(TRIANGLE)
        (self.folder / "job.toml").write_text(JOB)

    def run_job(self, out, *arguments, ranks=None):
        self.assert_exit(self.overturn("run", "job.toml", "-o", out, *arguments, ranks=ranks), 0)

    def test_is_printed_with_its_peak(self):
        text = "shape.csv: 3 rows over 0.5 periods, values divided by 5"
        self.assert_exit(self.overturn("check", "job.toml"), 0, "pulse table", f"shape {text}")
        self.assert_exit(self.overturn("topple", *STATUE, *TABLE, "--pga", "0.4"), 0, f"motion table, period 0.5 s; {text}")
        motion = json.loads(self.overturn("topple", *STATUE, *TABLE, "--json").stdout)["motion"]
        self.assertEqual(motion, {"pulse": "table", "period": 0.5, "shape": "shape.csv", "shape_peak": 5})
        (self.folder / "objects.csv").write_text("name,width,height\na,0.6,1.8\nb,0.3,1.8\n")
        arguments = ("assess", "objects.csv", *TABLE, "--period", "0.5,1", "--pga", "0.4")
        self.assert_exit(self.overturn(*arguments), 0, f"motion table, period 0.5, 1 s; {text}")
        answer = json.loads(self.overturn(*arguments, "--json").stdout)
        self.assertEqual(answer["motion"], {"pulse": "table", "periods": [0.5, 1], "shape": "shape.csv", "shape_peak": 5})

    def test_of_a_triangle_topples_as_the_triangular_pulse(self):
        table, pulse = (json.loads(self.overturn("topple", *STATUE, *shape, "--pga", "0.7", "--json").stdout)
                        for shape in (TABLE, ("--pulse", "triangular")))
        self.assertEqual(table["topples"], pulse["topples"])
        self.assertTrue(table["toppling_pga"])
        ranges = (np.array(answer["toppling_pga"], float) for answer in (table, pulse))  # an open end is null
        np.testing.assert_allclose(*ranges, rtol=1e-9)
        np.testing.assert_allclose(table["friction_demand"], pulse["friction_demand"], rtol=1e-3)

    def test_is_part_of_the_result(self):
        self.run_job("out.h5")
        data = self.opened("out.h5")
        self.assertEqual(data.region.dims, ("pga", "pulse_period"))
        self.assertEqual(data.attrs["pulse"], "table")
        with h5py.File(self.folder / "out.h5") as file:
            np.testing.assert_array_equal(file["run/shape_phase"][:], np.array([0, np.pi / 2, np.pi]))
            np.testing.assert_array_equal(file["run/shape_value"][:], [0, -1, 0])
            self.assertIn("divided by 5", file["run/shape_value"].attrs["comment"].decode())
        self.assert_exit(self.overturn("info", "out.h5"), 0, 'shape = { file = "shape.csv", rows = 3, periods = 0.5')
        self.assert_exit(self.overturn("verify", "out.h5"), 0)

    def test_is_the_same_on_every_number_of_ranks_and_after_a_stop(self):
        self.run_job("out.h5")
        for ranks in (2, 3):
            self.run_job("ranks.h5", ranks=ranks)
            self.assertEqual(checksum(self.folder / "ranks.h5"), checksum(self.folder / "out.h5"))
            self.forget("ranks.h5", [0, 2])
            self.run_job("ranks.h5", ranks=ranks)
            self.assertEqual(checksum(self.folder / "ranks.h5"), checksum(self.folder / "out.h5"))
            (self.folder / "ranks.h5").unlink()

    def test_that_changed_does_not_resume_a_run(self):
        self.run_job("out.h5")
        self.forget("out.h5", [0])
        (self.folder / "shape.csv").write_text(TRIANGLE.replace("1,25", "1,3"))
        self.assert_refused(74, ['the table "shape.csv" has changed since then'], "run", "job.toml", "-o", "out.h5")

    def test_may_be_a_list_in_the_job(self):
        self.run_job("file.h5")
        self.run_job("list.h5", "--set=scene.shape=[[1, 0], [1.25, -5], [1.5, 0]]")
        one, other = map(self.opened, ("file.h5", "list.h5"))
        for field in ("region", "margin", "peak"):
            self.assertEqual(one[field].values.tobytes(), other[field].values.tobytes())

    def test_has_boundaries_histories_and_accuracy(self):
        self.assert_exit(self.overturn("boundary", "job.toml", "-o", "b.h5", "--set=plane.pulse_period.count=4"), 0)
        self.assertEqual(self.opened("b.h5").flip_amplitude.dims, ("crossing", "pulse_period"))
        self.assert_exit(self.overturn("history", "job.toml", "--at", "pga=0.9,pulse_period=0.5", "-o", "h.h5"), 0, "uplift")
        with h5py.File(self.folder / "h.h5") as file:
            p = np.sqrt(3 * 9.81 / (4 * np.hypot(0.3, 0.9)))
            time, ground = file["time"][:] / p, file["ground"][:]
            self.assertIn("shape_value", file["run"])
        np.testing.assert_allclose(ground, np.interp(time, [0, 0.125, 0.25], [0, -0.9, 0]), atol=1e-9)
        self.assert_exit(self.overturn("accuracy", "job.toml", "--points", "200", "--digits", "10", "-o", "a.h5"), 0)

    def test_of_4000_rows_is_computed(self):
        time = np.linspace(0, 1, 4000)
        np.savetxt(self.folder / "shape.csv", np.c_[time, np.sin(2 * np.pi * time)], delimiter=",")
        self.run_job("out.h5", "--set=numerics.resolve=true")
        self.run_job("sine.h5", "--set=numerics.resolve=true", "--set=scene.pulse=one_sine")
        table, sine = map(self.opened, ("out.h5", "sine.h5"))
        clear = np.abs(sine.margin.values) > 1e-4
        self.assertGreater(clear.mean(), 0.99)
        np.testing.assert_array_equal((table.region.values < 3)[clear], (sine.region.values < 3)[clear])

    def test_belongs_to_the_pulse_table(self):
        def refused(code, phrase, *arguments):
            self.assert_refused(code, [phrase], *arguments)

        refused(65, 'scene.shape has no meaning for the pulse "one_sine", only for table', "topple", *STATUE,
                "--shape", "shape.csv")
        refused(65, "scene.shape is missing. Give the path of a table", "topple", *STATUE, "--pulse", "table")
        refused(2, "--shape", "topple", "--width", "0.6", "--height", "1.8", "--record", "a.AT2", "--shape", "shape.csv")
        refused(2, "--set takes keys of [scene]", "topple", *STATUE, *TABLE, "--set", "scene.shape=other.csv")
        refused(65, "none.csv: cannot be read", "topple", *STATUE, "--pulse", "table", "--shape", "none.csv")
        refused(65, "numerics.fill = true is not possible", "run", "job.toml", "-o", "o.h5", "--set=numerics.fill=true")


if __name__ == "__main__":
    unittest.main(verbosity=2)
