"""The output of tools/to_xdmf: its references are resolved to values, here and by ParaView.

Requires OVERTURN (the binary) in the environment, and for ParaView PVPYTHON, its Python.
"""

import json
import os
import subprocess
import unittest
from xml.etree import ElementTree

import h5py
import numpy as np
from plot_spectrum_test import (F_MINUS, NOT_COMPUTED, OVERTURN, REGIONS, S, UNDECIDED,
                                Picture, add_field)
from tool import run_tool

JOB = """
    title = "A & B < \\"C\\""
    [scene]
    pulse = "one_sine"
    theory = "%s"
    [plane]
    frequency = { first = 0.5, last = 8.0, count = 23, spacing = "log" }
    amplitude = { first = 1.0, last = 12.0, count = 17 }
    restitution = { values = [0.7, 0.85, 1.0], of = "maximum" }
    slenderness = { values = [0.1, 0.2] }
    [output]
    fields = ["region", "angle", "velocity", "margin", "error", "peak", "fall_time", "impacts",
              "steps", "status"]
    """
FIELDS = {"region", "angle", "velocity", "margin", "error", "peak", "fall_time", "impacts", "steps",
          "status"}


def follow(folder, item):
    """Returns the values of a DataItem, by the rules of XDMF 2."""
    shape = [int(count) for count in item.get("Dimensions").split()]
    if item.get("ItemType") == "HyperSlab":
        corners, source = item
        start, stride, count = follow(folder, corners).astype(int)
        part = tuple(slice(*bounds) for bounds in zip(start, start + stride * count, stride))
        return follow(folder, source)[part].reshape(shape)
    if item.get("Format") == "XML":
        return np.array(item.text.split(), np.float64).reshape(shape)
    name, dataset = item.text.rsplit(":", 1)
    with h5py.File(folder / name) as file:
        values = file[dataset][...]
    kinds = {"UChar": "u1", "UShort": "u2", "UInt": "u4", "Float": "f8"}
    assert values.dtype == kinds[item.get("NumberType")], (dataset, values.dtype)
    assert values.itemsize == int(item.get("Precision")), (dataset, values.dtype)
    assert list(values.shape) == shape, (dataset, values.shape)
    return values


class Described(Picture):
    def compute(self, name="spectrum.h5", theory="nonlinear"):
        (self.folder / "job.toml").write_text(JOB % theory)
        subprocess.run([OVERTURN, "run", "job.toml", "-o", name], cwd=self.folder, check=True,
                       capture_output=True, timeout=100)

    def describe(self, *arguments):
        return run_tool("to_xdmf", *arguments, cwd=self.folder)

    def described(self, *arguments, output="spectrum.xdmf2"):
        """Returns the steps in the output of the tool."""
        run = self.describe(*arguments)
        self.assertEqual(run.returncode, 0, run.stderr)
        root = ElementTree.parse(self.folder / output).getroot()
        series, = root.findall("Domain/Grid")
        self.assertEqual((series.get("GridType"), series.get("CollectionType")),
                         ("Collection", "Temporal"))
        self.name = series.get("Name")
        return series.findall("Grid")

    def values(self, step, folder=None):
        """Returns the values at the points of a step, by name."""
        return {field.get("Name"): follow(folder or self.folder, field[0])
                for field in step.findall("Attribute") if field.get("Center") == "Node"}

    def assert_values_of(self, name, steps, folder=None):
        with h5py.File(self.folder / name) as file:
            pairs = list(np.ndindex(file["region"].shape[:-2]))
            self.assertEqual(len(steps), len(pairs))
            for step, pair in zip(steps, pairs):
                found = self.values(step, folder)
                self.assertEqual(set(found), FIELDS & set(file))
                for field, values in found.items():
                    np.testing.assert_array_equal(values[0], file[field][pair], field)


class TestTheReferences(Described):
    def test_each_step_is_one_spectrum_with_all_its_fields(self):
        for theory in ("nonlinear", "linear"):
            self.compute(theory=theory)
            steps = self.described("spectrum.h5")
            self.assertEqual(len(steps), 6)
            self.assert_values_of("spectrum.h5", steps)
            (self.folder / "spectrum.h5").unlink()

    def test_the_grid_has_the_values_of_the_axes_in_one_layer(self):
        self.compute()
        with h5py.File(self.folder / "spectrum.h5") as file:
            frequency, amplitude = file["frequency"][:], file["amplitude"][:]
        for step in self.described("spectrum.h5"):
            topology, geometry = step.find("Topology"), step.find("Geometry")
            self.assertEqual((topology.get("TopologyType"), topology.get("Dimensions")),
                             ("3DRectMesh", "1 17 23"))
            self.assertEqual(geometry.get("GeometryType"), "VXVYVZ")
            across, up, out = (follow(self.folder, item) for item in geometry)
            np.testing.assert_array_equal(across, frequency)
            np.testing.assert_array_equal(up, amplitude)
            np.testing.assert_array_equal(out, [0])

    def test_steps_have_a_number_and_their_slenderness_and_restitution(self):
        self.compute()
        steps = self.described("spectrum.h5")
        self.assertEqual([step.find("Time").get("Value") for step in steps], list("012345"))
        with h5py.File(self.folder / "spectrum.h5") as file:
            for step, (i, k) in zip(steps, np.ndindex(2, 3)):
                stated = {field.get("Name"): follow(self.folder, field[0])
                        for field in step.findall("Attribute") if field.get("Center") == "Grid"}
                self.assertEqual(stated, {"slenderness": file["slenderness"][i],
                                        "restitution": file["restitution"][k],
                                        "restitution_ratio": file["restitution_ratio"][i, k]})
        self.assertEqual(steps[5].get("Name"), "α = 0.2 rad,  r = r_max = 0.8851")

    def test_the_region_comes_first(self):
        self.compute()
        for step in self.described("spectrum.h5"):
            first = next(field for field in step.findall("Attribute")
                         if field.get("Center") == "Node")
            self.assertEqual(first.get("Name"), "region")

    def test_a_file_in_another_folder_is_found_from_the_output(self):
        for folder in ("results", "views"):
            (self.folder / folder).mkdir()
        self.compute("results/spectrum.h5")
        for output in ("views/a.xdmf2", "results/b.xdmf2", str(self.folder / "views" / "c.xmf")):
            steps = self.described("results/spectrum.h5", "-o", output, output=output)
            self.assert_values_of("results/spectrum.h5", steps, (self.folder / output).parent)

    def test_titles_and_file_names_may_contain_any_letter(self):
        name = "ü&<é> \"1\" 'x'"
        self.spectrum([[S, F_MINUS]], title="from <1> & \"2\"\nin Ω\x01")
        (self.folder / "spectrum.h5").rename(self.folder / (name + ".h5"))
        steps = self.described(name + ".h5", output=name + ".xdmf2")
        self.assert_values_of(name + ".h5", steps)
        self.assertEqual(self.name, "from <1> & \"2\" in Ω ")

    def test_an_unfinished_file_keeps_its_codes(self):
        self.spectrum([[S, UNDECIDED, NOT_COMPUTED]])
        step, = self.described("spectrum.h5")
        np.testing.assert_array_equal(self.values(step)["region"],
                                      [[[S, UNDECIDED, NOT_COMPUTED]]])

    def test_a_file_without_the_region_is_described_too(self):
        self.spectrum([[S, F_MINUS]])
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            add_field(file, "margin", np.array([0.5, np.nan]).reshape(1, 1, 1, 2), np.nan)
            del file["region"]
        step, = self.described("spectrum.h5")
        self.assertEqual(list(self.values(step)), ["margin"])


class TestTheColours(Described):
    def test_each_code_has_its_name_and_the_colour_of_the_maps(self):
        self.spectrum([[S]])
        run = self.describe("spectrum.h5", "--colours", "regions.json")
        self.assertEqual(run.stdout.split(), ["spectrum.xdmf2", "regions.json"], run.stderr)
        preset, = json.loads((self.folder / "regions.json").read_text("utf-8"))
        codes = [int(code) for code in preset["Annotations"][::2]]
        colours = np.reshape(preset["IndexedColors"], (-1, 3))
        self.assertEqual(codes, [*REGIONS, NOT_COMPUTED])
        self.assertEqual(len(colours), len(codes))
        for code, name, colour in zip(codes, preset["Annotations"][1::2], colours):
            short, meaning, expected = REGIONS.get(code, ("", "not computed yet", "#ffffff"))
            self.assertEqual(name, short or meaning)
            self.assertEqual("#" + bytes(np.round(255 * colour).astype(np.uint8)).hex(), expected)


class TestADescriptionRefused(Described):
    def refuses(self, code, sentence, *arguments):
        run = self.describe(*arguments)
        self.assertEqual(run.returncode, code, run.stderr)
        self.assertIn(sentence, run.stderr)
        self.assertNotIn("Traceback", run.stderr)

    def test_of_other_kinds_of_files(self):
        (self.folder / "text.h5").write_text("not a spectrum")
        self.refuses(74, "not an HDF5 file", "text.h5")
        for kind in ("history", "boundary", "accuracy"):
            with h5py.File(self.folder / "other.h5", "w") as file:
                file.attrs["kind"] = f"overturning {kind}"
            self.refuses(74, "not a spectrum written by overturn run", "other.h5")
        self.assertFalse((self.folder / "other.xdmf2").exists())

    def test_of_a_file_that_lacks_an_axis(self):
        self.spectrum([[S]])
        with h5py.File(self.folder / "spectrum.h5", "a") as file:
            del file["frequency"]
        self.refuses(74, "is damaged", "spectrum.h5")

    def test_to_overwrite_the_result_file(self):
        self.spectrum([[S]])
        before = (self.folder / "spectrum.h5").read_bytes()
        self.refuses(2, "must end in .xdmf2", "spectrum.h5", "-o", "spectrum.h5")
        (self.folder / "link.xdmf2").symlink_to("spectrum.h5")
        self.refuses(74, "is not an XDMF file", "spectrum.h5", "-o", "link.xdmf2")
        (self.folder / "link.json").symlink_to("spectrum.h5")
        self.refuses(74, "is not a preset", "spectrum.h5", "-o", "new.xdmf2", "--colours", "link.json")
        self.assertEqual((self.folder / "spectrum.h5").read_bytes(), before)

    def test_of_an_output_in_a_missing_folder(self):
        self.spectrum([[S]])
        self.refuses(74, "cannot write", "spectrum.h5", "-o", "nowhere/spectrum.xdmf2")

    def test_of_a_name_that_paraview_cannot_open(self):
        self.spectrum([[S]])
        for name in ("a:b.h5", "a\nb.h5"):
            (self.folder / name).symlink_to("spectrum.h5")
            self.refuses(74, "ParaView cannot open", name)


# Writes ParaView's view of each step: the grid, its values, the output of a filter.
LOOK = """
import json, sys
from paraview.simple import Contour, GetColorTransferFunction, ImportPresets, OpenDataFile

def values_of(array):
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]

def by_name(data):
    arrays = [data.GetArray(i) for i in range(data.GetNumberOfArrays())]
    return {array.GetName(): [array.GetDataTypeAsString(), values_of(array)] for array in arrays}

def look(reader, time):
    reader.UpdatePipeline(time)
    grid = reader.GetClientSideObject().GetOutputDataObject(0)
    contour = Contour(Input=reader, ContourBy=["POINTS", "margin"], Isosurfaces=[0.0])
    contour.UpdatePipeline(time)
    return {"class": grid.GetClassName(), "extent": grid.GetExtent(),
            "axes": [values_of(grid.GetXCoordinates()), values_of(grid.GetYCoordinates()),
                     values_of(grid.GetZCoordinates())],
            "points": by_name(grid.GetPointData()), "stated": by_name(grid.GetFieldData()),
            "first": grid.GetPointData().GetScalars().GetName(),
            "contour": contour.GetDataInformation().GetBounds()}

path, preset, output = sys.argv[1:]
reader = OpenDataFile(path)
ImportPresets(preset)
colours = GetColorTransferFunction("region")
colours.ApplyPreset("overturn regions", False)
with open(output, "w") as text:
    json.dump({"reader": reader.GetXMLName(), "names": list(colours.Annotations),
               "steps": [look(reader, time) for time in reader.TimestepValues]}, text)
"""
TYPES = {"uint8": "unsigned char", "uint16": "unsigned short", "uint32": "unsigned int",
         "float64": "double"}


@unittest.skipUnless("PVPYTHON" in os.environ, "ParaView is not installed")
class TestInParaView(Described):
    def look(self, name):
        """Reads a file from another folder, because ParaView is rarely started in that of the
        file."""
        run = self.describe(name + ".h5", "--colours", "regions.json")
        self.assertEqual(run.returncode, 0, run.stderr)
        (self.folder / "elsewhere").mkdir()
        (self.folder / "elsewhere" / "look.py").write_text(LOOK)
        run = subprocess.run(
            [os.environ["PVPYTHON"], "--disable-registry", "look.py",
             self.folder / (name + ".xdmf2"), self.folder / "regions.json", "seen.json"],
            cwd=self.folder / "elsewhere", timeout=100, capture_output=True, text=True)
        self.assertNotIn("XDMF Error", run.stderr)
        self.assertEqual(run.returncode, 0, run.stderr)
        return json.loads((self.folder / "elsewhere" / "seen.json").read_text())

    def assert_same(self, step, file, pair):
        shape = file["region"].shape[2:]
        self.assertEqual(set(step["points"]), FIELDS & set(file))
        for name, (kind, values) in step["points"].items():
            expected = file[name][pair]
            self.assertEqual(kind, TYPES[expected.dtype.name], name)
            np.testing.assert_array_equal(np.reshape(values, shape), expected, name)

    def test_each_step_has_the_axes_the_values_and_the_types_of_the_file(self):
        self.compute("ö results.h5")
        seen = self.look("ö results")
        self.assertEqual(len(seen["steps"]), 6)
        with h5py.File(self.folder / "ö results.h5") as file:
            for step, (i, k) in zip(seen["steps"], np.ndindex(2, 3)):
                self.assertEqual((step["class"], step["extent"], step["first"]),
                                 ("vtkRectilinearGrid", [0, 22, 0, 16, 0, 0], "region"))
                self.assertEqual(step["axes"], [file["frequency"][:].tolist(),
                                                file["amplitude"][:].tolist(), [0]])
                self.assert_same(step, file, (i, k))
                stated = {name: value for name, (_, [value]) in step["stated"].items()}
                self.assertEqual(stated, {"slenderness": file["slenderness"][i],
                                        "restitution": file["restitution"][k],
                                        "restitution_ratio": file["restitution_ratio"][i, k]})
                # Filters process the whole plane: the verdict flips from side to side.
                left, right, _, top, *_ = step["contour"]
                self.assertEqual((left, top), (0.5, 12))
                self.assertGreater(right, 6)

    def test_opens_with_the_reader_that_supports_hyperslabs_and_names_the_regions(self):
        self.compute()
        seen = self.look("spectrum")
        self.assertEqual(seen["reader"], "XdmfReader")
        names = dict(zip(seen["names"][::2], seen["names"][1::2]))
        self.assertEqual((names["0"], names["3"], names["255"]), ("S", "U0+", "not computed yet"))

    def test_reads_points_not_computed_as_such(self):
        with h5py.File(self.folder / "whole.h5", "w") as whole:
            self.spectrum(np.zeros((1, 2, 6, 5)))
            with h5py.File(self.folder / "spectrum.h5") as file:
                for name in set(file) - {"region"}:
                    file.copy(name, whole)
                whole.attrs.update(file.attrs)
            for name, kind, fill in (("region", "u1", 255), ("margin", "f8", np.nan)):
                field = whole.create_dataset(name, (1, 2, 6, 5), kind, chunks=(1, 1, 3, 5),
                                             fillvalue=fill)
                field[0, 1, :3] = 1  # one of four tiles
        seen = self.look("whole")
        with h5py.File(self.folder / "whole.h5") as file:
            for step, k in zip(seen["steps"], range(2)):
                self.assert_same(step, file, (0, k))


if __name__ == "__main__":
    unittest.main()
