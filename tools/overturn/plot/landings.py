"""Plots the end states in phase space: the angles and velocities at the end of the ground motion,
coloured by the points of the plane."""

import numpy as np
from matplotlib import pyplot
from overturn.captions import ground_word, heading, is_recorded, plain, subtitle
from overturn.choice import add_choice_arguments, plane_of
from overturn.output_file import save
from overturn.phase_space import HALF_TURN, block_of, draw_boundaries, fill_libration, name_phase_axes
from overturn.plot.bands import set_axes
from overturn.plot.headings import Heading
from overturn.plot.spectra import cover, hatch
from overturn.region_labels import add_label_argument, pieces, thinned, write_label
from overturn.regions import APART, BETWEEN, LEFT_STANDING, NOT_COMPUTED, REGIONS
from overturn.result_file import SPECTRUM, open_result
from overturn.spectrum_planes import without_gaps
from overturn.tool import parse_with_picture, parser_of
from overturn.units import axes_of_plane, name_axes

EXAMPLE = """\
example:
  overturn run jobs/figure_07a.toml              # writes figure_07a.h5
  tools/plot_landing figure_07a.h5               # draws figure_07a_landing.png

Left, the plane: black at the bottom left, red grows to the right, blue upwards; lines separate the
regions. Middle and right, the end states (angle and velocity at the end of the pulse or record)
in the same colours; several points in one pixel give their mean colour; blocks that fell before
the end are not shown, nor undecided ones. Pale blue: the libration region, from which no block
overturns.

The spectrum must have the fields region, angle and velocity. Of several spectra choose one with
--slenderness, --restitution and, under records, --motion."""

LIBRATION = "#dcecf7"
PLANE_PIXELS = 1000
LANDING_PIXELS = 360  # per side: more would leave gaps between a million points
NEAR = 2  # half width of the near view, in slendernesses and largest velocities
LEAST_SHARE = 0.004  # of the plane: smaller pieces of a region get no name


class Landing:
    """Mean colours of the points in each pixel of a window of phase space."""

    def __init__(self, largest_angle, largest_rate):
        self.reach = np.array([largest_angle, largest_rate])
        self.count = np.zeros(LANDING_PIXELS**2)
        self.red, self.blue = self.count.copy(), self.count.copy()

    def extent(self):
        angle, rate = self.reach
        return (-angle, angle, -rate, rate)

    def pixels(self, angle, rate):
        """Returns the pixel of each point in the window and a mask of these points."""
        across, up = (np.floor((values / reach + 1) / 2 * LANDING_PIXELS)
                      for values, reach in zip((angle, rate), self.reach))
        within = (0 <= across) & (across < LANDING_PIXELS) & (0 <= up) & (up < LANDING_PIXELS)
        return (up[within] * LANDING_PIXELS + across[within]).astype(int), within

    def add(self, angle, rate, red, blue):
        pixels, within = self.pixels(angle, rate)
        for total, weights in ((self.count, None), (self.red, red[within]),
                               (self.blue, blue[within])):
            total += np.bincount(pixels, weights, LANDING_PIXELS**2)

    def picture(self):
        """Returns RGBA, transparent where there is no point."""
        seen = np.maximum(self.count, 1)
        layers = (self.red / seen, 0 * seen, self.blue / seen, self.count > 0)
        return np.stack(layers, axis=1).reshape(LANDING_PIXELS, LANDING_PIXELS, 4)


class Spectrum:
    """One spectrum of the file: its plane, its block, and its points at the end."""

    def __init__(self, plane):
        self.plane = plane
        self.across, self.up = axes_of_plane(plane)
        self.block = block_of(plane)

    def blocks(self):
        """Yields angle, velocity, red and blue of points not overturned, some rows at a time."""
        plane = self.plane
        red = self.across.share(plane.values(plane.across, plane.across))
        blue = self.up.share(plane.values(plane.up, plane.up))
        for rows in plane.tiles():
            region, angle, rate = (plane.read(name, rows) for name in ("region", "angle", "velocity"))
            standing = np.isin(region, LEFT_STANDING)
            colours = np.broadcast_to(red, region.shape), np.broadcast_to(blue[rows, None],
                                                                          region.shape)
            yield tuple(values[standing] for values in (angle, rate, *colours))

    def sample(self, pixels, *fields):
        """Returns the fields at evenly spaced pixels of the plane."""
        rows, columns = self.up.cells(pixels), self.across.cells(pixels)
        return [self.plane.read_cells(name, rows, columns) for name in fields]


def land(spectrum):
    """Returns the view near the upright block and the view of all states."""
    sides = spectrum.block, spectrum.block.other
    ratios = [side.frequency_parameter / sides[0].frequency_parameter for side in sides]
    fastest = max((np.abs(rate).max(initial=0) for _, rate, _, _ in spectrum.blocks()), default=0)
    near = Landing(NEAR * max(side.slenderness for side in sides),
                   NEAR * max(side.largest_rate * ratio for side, ratio in zip(sides, ratios)))
    fastest = max(fastest, *(float(side.inward_rate(angle)) * ratio
                             for side, ratio in zip(sides, ratios) for angle in (0.0, HALF_TURN)))
    far = Landing(HALF_TURN, 1.05 * fastest)
    for points in spectrum.blocks():
        near.add(*points)
        far.add(*points)
    return near, far


def borders(codes):
    """Returns the pixels on both sides of a change of region."""
    change = np.zeros(codes.shape, bool)
    rows, columns = codes[1:] != codes[:-1], codes[:, 1:] != codes[:, :-1]
    change[1:] |= rows
    change[:-1] |= rows
    change[:, 1:] |= columns
    change[:, :-1] |= columns
    return change


def draw_plane(panel, spectrum):
    codes = without_gaps(*spectrum.sample(PLANE_PIXELS, "region"), spectrum.up, spectrum.across)
    shade = (np.arange(PLANE_PIXELS) + 0.5) / PLANE_PIXELS
    picture = np.zeros((PLANE_PIXELS, PLANE_PIXELS, 4))
    picture[..., 0], picture[..., 2], picture[..., 3] = shade, shade[:, None], 1
    picture[borders(codes)] = 1
    picture[np.isin(codes, [NOT_COMPUTED, BETWEEN])] = 0
    picture[codes == APART] = 1
    set_axes(panel, spectrum.across, spectrum.up)
    hatch(panel)
    cover(panel, picture)
    across, up = name_axes(spectrum.plane)
    title = "The record and the block" if is_recorded(spectrum.plane.file) else "The pulse"
    panel.set(xlabel=across, ylabel=up, title=title)


def draw_landing(panel, spectrum, landing, title):
    fill_libration(panel, spectrum.block, LIBRATION, *landing.reach)
    panel.imshow(landing.picture(), extent=landing.extent(), origin="lower", aspect="auto",
                 interpolation="nearest", zorder=2)
    draw_boundaries(panel, spectrum.block, landing.reach[1], zorder=3)
    left, right, bottom, top = landing.extent()
    panel.set(xlim=(left, right), ylim=(bottom, top), title=title)
    name_phase_axes(panel)


def named_pieces(codes, labels, across, up):
    """Yields text, code and cells of each piece of a region that is labelled or large enough."""
    unlabelled = codes.copy()
    for label in labels:
        piece = label.piece(codes, across, up)
        if piece.any():
            unlabelled[piece] = NOT_COMPUTED
            yield f"{label.text}  {REGIONS[label.code][0]}", label.code, piece
    for code, (name, _, _) in REGIONS.items():
        for piece in pieces(unlabelled == code, LEAST_SHARE * codes.size):
            yield name or "undecided", code, piece


def write_names(panels, views, spectrum, labels):
    """Labels pieces in the plane and in phase space: in the near view if it shows half of one."""
    cells = len(thinned(np.arange(PLANE_PIXELS)))
    codes, angle, rate = spectrum.sample(cells, "region", "angle", "velocity")
    for text, code, piece in named_pieces(codes, labels, spectrum.across, spectrum.up):
        write_label(panels[0], piece, text, size=9)
        if code not in LEFT_STANDING:
            continue
        for panel, view in zip(panels[1:], views):
            pixels, within = view.pixels(angle[piece], rate[piece])
            if np.count_nonzero(within) >= len(within) / 2:
                write_label(panel, covered(pixels), text, size=9)
                break


def covered(pixels):
    """Returns the part of a view covered by a sample of points, coarse enough to have no gaps."""
    coarse = 8
    mask = np.zeros((LANDING_PIXELS // coarse,) * 2, bool)
    mask[pixels // LANDING_PIXELS // coarse, pixels % LANDING_PIXELS // coarse] = True
    return mask


def draw(plane, title, labels):
    spectrum = Spectrum(plane)
    title = heading([plane]) if title is None else title
    words = Heading(plain(title), subtitle([plane]), 16, (14, 11))
    height = 6.2 + words.extra
    figure, panels = pyplot.subplots(1, 3, figsize=(17, height))
    figure.subplots_adjust(left=0.045, right=0.99, bottom=0.62 / height, top=5.084 / height, wspace=0.19)
    words.write(figure, 0.765, (0.34, 0.62))
    views = land(spectrum)
    draw_plane(panels[0], spectrum)
    for panel, view, name in zip(panels[1:], views, ("near upright", "full range")):
        title_of_view = f"State at the end of the {ground_word(plane.file)}, {name}"
        draw_landing(panel, spectrum, view, title_of_view)
    write_names(panels, views, spectrum, labels)
    return figure


def read_arguments(argv):
    parser = parser_of("plot_landing", __doc__, EXAMPLE, "overturn run")
    add_choice_arguments(parser)
    add_label_argument(parser)
    parser.add_argument("--title", help="title of the picture (default: the job's title, or the name "
                                        "of its record)")
    return parse_with_picture(parser, argv, "FILE_landing.png")


def main(argv=None):
    arguments = read_arguments(argv)
    with open_result(arguments.file, SPECTRUM, ("region", "angle", "velocity")) as file:
        plane = plane_of(file, arguments)
        figure = draw(plane, arguments.title, arguments.label)
    save(figure, arguments.output, dpi=150)
