"""Files of format 3 in the names and shapes of format 4."""

import unittest

import h5py
import numpy as np
import plot_spectrum_test
from plot_spectrum_test import F_MINUS, NOT_COMPUTED, S
import overturn


class TestAFileOfFormat3(plot_spectrum_test.Picture):
    def write(self, axes, attributes, of="maximum", **coordinates):
        """Writes a spectrum, in which each point is a tile; the last one is not computed."""
        shape = [len(values) for values in axes.values()]
        with h5py.File(self.folder / "spectrum.h5", "w") as file:
            file.attrs.update({"kind": "overturning spectrum", "format_version": 3, "program_version": "1.0.0",
                               "title": "Old", "theory": "nonlinear", "gravity": 9.81, **attributes})
            for name, values in axes.items():
                file[name] = values
                file[name].make_scale()
            file["restitution"].attrs["of"] = of
            for name, (dimensions, values) in coordinates.items():
                file[name] = values
                plot_spectrum_test.attach(file[name], *dimensions)
            codes = np.full(shape, S, np.uint8)
            codes[..., -1, :] = F_MINUS
            file.create_dataset("region", data=codes, fillvalue=NOT_COMPUTED)
            plot_spectrum_test.attach(file["region"], *axes)
            file["region"].attrs["coordinates"] = " ".join(coordinates)
            file["run/checksum"] = np.append(np.ones(codes.size - 1, np.uint64), np.uint64(0))
            file["run/checksum"].attrs.update({"tile_shape": [1] * len(axes), "dimensions": " ".join(axes)})

    def pulse(self):
        self.write({"slenderness": [0.2], "restitution": [0.9, 1.0], "amplitude": [1.0, 2.0], "frequency": [3.0, 4.0]},
                   {"pulse": "one_sine", "half_diagonal": 2.0, "half_width": 0.4, "half_height": 1.96},
                   restitution_ratio=(("slenderness", "restitution"), [[0.8, 0.85]]),
                   pulse_period=(("frequency",), [1.1, 0.8]), pga=(("amplitude",), [0.2, 0.4]))

    def record(self):
        self.write({"motion": [1.0, 2.0], "slenderness": [0.2], "restitution": [0.9], "scale": [1.0, 2.0],
                    "size": [0.5, 1.0]}, {"record": "2 records"}, "absolute",
                   restitution_ratio=(("slenderness", "restitution"), [[0.9]]), pga=(("motion",), [0.4, 0.5]),
                   scaled_pga=(("motion", "scale"), [[0.4, 0.8], [0.5, 1.0]]))

    def test_under_a_pulse_has_the_names_and_shapes_of_format_4(self):
        self.pulse()
        with overturn.open(self.folder / "spectrum.h5") as data:
            self.assertEqual(dict(data.sizes), {"restitution_of_maximum": 2, "amplitude": 2, "frequency": 2})
            self.assertEqual(data.slenderness.item(), 0.2)
            self.assertEqual([data[name].item() for name in ("half_width", "half_height", "size")], [0.4, 1.96, 2.0])
            self.assertEqual(data.restitution.dims, ("restitution_of_maximum",))
            self.assertEqual(data.restitution.values.tolist(), [0.8, 0.85])
            self.assertEqual(list(data.data_vars), ["region"])
            self.assertEqual(data.region.values.ravel().tolist(),
                             [S, S, F_MINUS, F_MINUS, S, S, F_MINUS, NOT_COMPUTED])

    def test_under_records_has_the_names_and_shapes_of_format_4(self):
        self.record()
        with overturn.open(self.folder / "spectrum.h5") as data:
            self.assertEqual(dict(data.sizes), {"motion": 2, "scale": 2, "size": 2})
            self.assertEqual(data.record_pga.values.tolist(), [0.4, 0.5])
            self.assertEqual(data.pga.values.tolist(), [[0.4, 0.8], [0.5, 1.0]])
            self.assertEqual(data.restitution.item(), 0.9)
            self.assertNotIn("restitution_ratio", data)
            self.assertEqual(data.region.values[1].tolist(), [[S, S], [F_MINUS, NOT_COMPUTED]])

    def test_is_drawn_and_written_as_a_table(self):
        self.pulse()
        words = self.words("--units", "physical", "--restitution", "1")
        for word in ("Old", "pulse period [s]", "PGA [g]"):
            self.assertIn(word, words)
        self.assertIn("one-sine pulse,  α = 11.46°,  r = r_max = 0.85,  unfinished: 7 of 8 tiles computed", words)
        self.output_of("spectrum.h5", tool="to_csv")
        lines = (self.folder / "spectrum.csv").read_text().splitlines()
        self.assertEqual(lines[0], "frequency,amplitude,restitution_of_maximum,restitution,pulse_period,pga,slenderness,"
                         "half_width,half_height,size,region")
        self.assertTrue(lines[1].startswith("3.0,1.0,0.9,") and lines[1].endswith(",0"))
        self.assertTrue(lines[-1].startswith("4.0,2.0,1.0,") and lines[-1].endswith(",255"))


if __name__ == "__main__":
    unittest.main()
