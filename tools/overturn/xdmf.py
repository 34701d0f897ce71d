"""Writes a small XDMF file with which ParaView opens a result file; no values are copied."""

import argparse
import json
import os
import pathlib
from xml.etree import ElementTree

import numpy as np
from overturn.captions import heading, spectrum_words
from overturn.fields import (dimensions_of, fields_of, has_values_without_mark,
                             slenderness_and_restitution)
from overturn.output_file import write_text
from overturn.regions import NOT_COMPUTED, REGIONS
from overturn.result_file import PlotError
from overturn.spectrum_file import open_spectrum, rows_of_tiles

EXAMPLE = """\
example:
  overturn run jobs/four_axes.toml               # writes four_axes.h5
  tools/to_xdmf four_axes.h5 --colours regions.json
                                                 # writes four_axes.xdmf2 and regions.json
  paraview four_axes.xdmf2

Frequency (or pulse_period, pulse_frequency) is along x, amplitude (or pga) along y, each at its own
values; under records, size or frequency_parameter and scale or pga. A file of several spectra
becomes a time series: step 0 is the first record, slenderness and restitution, and restitution
varies fastest. The field data of a step contain its motion (the number of its record), slenderness,
restitution and restitution_ratio. The XDMF file refers to the result file, which contains the
values: keep both together. Unfinished files can be opened, too, unless tiles that are not marked as
computed contain values.

The preset of --colours names the regions and colours them as tools/plot_spectrum does. In ParaView:
colour by region, then Choose preset, Import; tick Annotations, Apply."""

# ParaView opens .xdmf2 directly. For the other suffixes it asks which of three readers to use, and
# only XDMF Reader can read a part of a dataset.
ENDINGS = (".xdmf2", ".xdmf", ".xmf")
PRESET = "overturn regions"
NUMBERS = {"uint8": ("UChar", 1), "uint16": ("UShort", 2), "uint32": ("UInt", 4),
           "float64": ("Float", 8)}


def words(values):
    return " ".join(str(value) for value in values)


def add(parent, tag, text=None, **attributes):
    element = ElementTree.SubElement(parent, tag, {name: str(value)
                                                   for name, value in attributes.items()})
    element.text = text
    return element


def add_number(parent, value):
    add(parent, "DataItem", repr(float(value)), Format="XML", NumberType="Float", Precision=8,
        Dimensions=1)


def add_dataset(parent, reference, data):
    kind, size = NUMBERS[data.dtype.name]
    add(parent, "DataItem", reference + ":" + data.name, Format="HDF", NumberType=kind,
        Precision=size, Dimensions=words(data.shape))


def add_geometry(grid, reference, file):
    # A volume of one layer: in a 2-D mesh ParaView swaps the axes, and filters find no data.
    up, across = (file[name] for name in dimensions_of(file)[-2:])
    add(grid, "Topology", TopologyType="3DRectMesh",
        Dimensions=words((1, len(up), len(across))))
    geometry = add(grid, "Geometry", GeometryType="VXVYVZ")
    add_dataset(geometry, reference, across)
    add_dataset(geometry, reference, up)
    add_number(geometry, 0)


def add_value(grid, name, value):
    add_number(add(grid, "Attribute", Name=name, Center="Grid"), value)


def add_field(grid, reference, data, outer):
    """Adds the part of a field that belongs to one spectrum."""
    plane, rank = data.shape[-2:], data.ndim
    kind, size = NUMBERS[data.dtype.name]
    attribute = add(grid, "Attribute", Name=data.name.strip("/"), Center="Node")
    part = add(attribute, "DataItem", ItemType="HyperSlab", NumberType=kind, Precision=size,
               Dimensions=words((1, *plane)))
    start, stride, count = (*outer, 0, 0), (1,) * rank, (*(1 for _ in outer), *plane)
    add(part, "DataItem", words(start + stride + count), Format="XML", NumberType="Int",
        Dimensions=words((3, rank)))
    add_dataset(part, reference, data)


def fields_in_order(file):
    """Returns the fields with the region first, because ParaView shows the first one."""
    return [file[name] for name in sorted(fields_of(file), key=lambda name: name != "region")]


def add_spectrum(series, reference, file, number, outer):
    names = dimensions_of(file)[:-2]
    grid = add(series, "Grid", Name=",  ".join(spectrum_words(file, outer)), GridType="Uniform")
    add(grid, "Time", Value=number)
    add_geometry(grid, reference, file)
    for name, place in zip(names, outer):
        add_value(grid, name, file[name][place])
    add_value(grid, "restitution_ratio", slenderness_and_restitution(file, outer)[1])
    for data in fields_in_order(file):
        add_field(grid, reference, data, outer)


def refuse_values_without_mark(file):
    """Refuses values in tiles not marked as computed: ParaView would show them."""
    for data in fields_in_order(file):
        for outer in np.ndindex(*data.shape[:-2]):
            if any(has_values_without_mark(file, data.name, outer, rows)
                   for rows in rows_of_tiles(data)):
                raise PlotError(f"\"{file.filename}\" has values of {data.name.strip('/')} in "
                                "tiles that are not marked as computed, which ParaView would show. "
                                "Run its command again to compute them.")


def describe(file, reference):
    """Returns XML that describes all spectra of the file."""
    outer_shape = [len(file[name]) for name in dimensions_of(file)[:-2]]
    spectra = list(np.ndindex(*outer_shape))
    title = "".join(letter if letter.isprintable() else " " for letter in heading(file, spectra))
    root = ElementTree.Element("Xdmf", Version="2.0")
    series = add(add(root, "Domain"), "Grid", Name=title or "spectra", GridType="Collection",
                 CollectionType="Temporal")
    for number, outer in enumerate(spectra):
        add_spectrum(series, reference, file, number, outer)
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="utf-8", xml_declaration=True).decode() + "\n"


def preset():
    """Returns names and colours of the regions as a ParaView preset."""
    entries = [(code, name or meaning, colour) for code, (name, meaning, colour) in REGIONS.items()]
    entries.append((NOT_COMPUTED, "not computed yet", "#ffffff"))
    names = [text for code, name, _ in entries for text in (str(code), name)]
    colours = [part / 255 for *_, colour in entries for part in bytes.fromhex(colour[1:])]
    return json.dumps([{"Name": PRESET, "Annotations": names,
                        "IndexedColors": colours}], indent=1) + "\n"


def reference_from(output, path):
    """Returns the path of the result file relative to the output, so that both can be moved."""
    relative = os.path.relpath(path, os.path.dirname(output) or os.curdir)
    if ":" in relative or not relative.isprintable():
        raise PlotError(f"ParaView cannot open \"{relative}\": "
                        "rename it without colons and control characters.")
    # ParaView drops a leading space or non-ASCII letter of a name.
    return os.path.join(os.curdir, relative)


def read_arguments(argv):
    parser = argparse.ArgumentParser(prog="to_xdmf", description=__doc__, epilog=EXAMPLE,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE.h5", help="written by overturn run")
    parser.add_argument("-o", "--output", metavar="OUT.xdmf2",
                        help="the XDMF file (default: FILE.xdmf2 in the working directory)")
    parser.add_argument("--colours", metavar="OUT.json",
                        help="also write the colours of the regions as a ParaView preset")
    arguments = parser.parse_args(argv)
    if arguments.output is None:
        arguments.output = pathlib.Path(arguments.file).stem + ENDINGS[0]
    for name, endings in ((arguments.output, ENDINGS), (arguments.colours, (".json",))):
        if name is not None and pathlib.Path(name).suffix not in endings:
            parser.error(f"\"{name}\" must end in {' or '.join(endings)}")
    return arguments


def main(argv=None):
    arguments = read_arguments(argv)
    with open_spectrum(arguments.file, fields=()) as file:
        try:
            refuse_values_without_mark(file)
            text = describe(file, reference_from(arguments.output, arguments.file))
        except KeyError as error:
            raise PlotError(f"\"{arguments.file}\" is damaged: {error}.") from error
    write_text(arguments.output, text, "an XDMF file", lambda beginning: b"<Xdmf" in beginning)
    print(arguments.output)
    if arguments.colours:
        write_text(arguments.colours, preset(), "a preset of tools/to_xdmf",
                   lambda beginning: f"\"{PRESET}\"".encode() in beginning)
        print(arguments.colours)
