"""Plots phase portraits of free rocking from closed formulas: which states of a block are safe."""

import numpy as np
from matplotlib import pyplot
from overturn.output_file import save
from overturn.phase_space import (HALF_TURN, FreeBlock, block_of, draw_boundaries, fill_libration,
                                  fill_regions, largest_restitution, map_of_regions, name_phase_axes)
from overturn.region_labels import pieces, thinned, write_label
from overturn.regions import REGIONS
from overturn.result_file import SPECTRUM, open_result
from overturn.spectrum_planes import Plane
from overturn.tool import USAGE, ToolError, parse_with_picture, parser_of

EXAMPLE = """\
example:
  tools/plot_phase pendulum                      # draws phase_pendulum.png
  tools/plot_phase regions --slenderness 0.1746 -o regions.pdf
  tools/plot_phase regions --block leaning.h5    # of the block of a spectrum, which may lean

The portraits are:
  pendulum   a pendulum, and a block without loss at impacts: two strips of the portrait of the
             pendulum, orange, form that of the block (Fig. 2 of the paper)
  libration  how the loss at one impact adds two blades to the safe rhomboid (Fig. 3)
  regions    the seven regions (Fig. 4); of a block with two different sides, nine

The default block is stout, alpha = 0.4 rad, so that all details are visible; the default r is the
maximum for its slenderness, (1 - 3/2 sin^2 alpha)^2."""

LIBRATION = "#bfe0f5"
STRIP = "#f0a040"
ORBIT = {"color": "0.45", "linewidth": 0.9}
SEPARATRIX = {"color": "#1b3f73", "linewidth": 1.8}
RED = "#c8282b"
LEAST_SHARE = 0.001  # of the picture: smaller pieces of a region get no name
HIGHEST = {"pendulum": 1.25, "libration": 1.25, "regions": 1.5}  # over the largest safe velocity


def mark(panel, text, angle, rate, offset, **style):
    """Draws a point and its name; the offset is in points."""
    panel.plot(angle, rate, "o", markersize=5, zorder=6, clip_on=False,
               **{"color": "black", **style})
    panel.annotate(text, (angle, rate), offset, textcoords="offset points", fontsize=12,
                   ha="center", va="center", zorder=7, **style)


def arrow(panel, angle, rate, **style):
    """Draws an arrow along the curve, before its midpoint, which may be a corner."""
    at = len(angle) * 3 // 8
    panel.annotate("", (angle[at + 1], rate[at + 1]), (angle[at], rate[at]),
                   arrowprops={"arrowstyle": "-|>", "mutation_scale": 13, "shrinkA": 0,
                               "shrinkB": 0, **style})


def draw_orbit(panel, angle, rate, **style):
    panel.plot(angle, rate, **style)
    arrow(panel, angle, rate, color=style["color"])


def draw_both_ways(panel, angle, rate, **style):
    """Draws an orbit and its mirror image, in which angle and velocity have the other signs."""
    for sign in (1, -1):
        draw_orbit(panel, sign * angle, sign * rate, **style)


def frame(panel, title, reach, highest):
    panel.set(xlim=(-reach, reach), ylim=(-highest, highest))
    panel.set_title(title, fontsize=11)
    panel.axhline(0, color="0.6", linewidth=0.6, zorder=0)
    panel.axvline(0, color="0.6", linewidth=0.6, zorder=0)
    name_phase_axes(panel)


def name_angles(panel, marks):
    low, high = panel.get_xlim()
    shown = [(angle, name) for angle, name in marks if low <= angle <= high]
    panel.set_xticks([angle for angle, _ in shown], [name for _, name in shown])


def block_ticks(panel, block):
    plus, minus = (r"$\alpha$", r"$-\alpha$") if block.other is block else (r"$\alpha_+$", r"$-\alpha_-$")
    name_angles(panel, [(-HALF_TURN, r"$-\pi/2$"), (-block.other.slenderness, minus), (0, "0"),
                        (block.slenderness, plus), (HALF_TURN, r"$\pi/2$")])


def draw_pendulum(panel, block):
    """Draws orbits theta'^2 = 4 cos^2(theta/2) - q; the strips at +-pi are those of a block."""
    angle = np.linspace(-np.pi, np.pi, 1201)
    separatrix = 2 * np.cos(angle / 2)
    panel.fill_between(angle, -separatrix, separatrix, color=LIBRATION, linewidth=0)
    for side in (-1, 1):
        panel.axvspan(*sorted((side * np.pi, side * (np.pi - block.slenderness))), color=STRIP,
                      alpha=0.55, linewidth=0)
    for q in (0.6, 1.6, 2.6, 3.5):  # inside
        turning = 2 * np.arccos(np.sqrt(q) / 2)
        inside = turning * np.sin(np.linspace(-HALF_TURN, HALF_TURN, 401))
        draw_both_ways(panel, inside, np.sqrt(np.maximum(4 * np.cos(inside / 2)**2 - q, 0)), **ORBIT)
    for q in (-0.8, -2.2):  # full turns
        draw_both_ways(panel, angle, np.sqrt(separatrix**2 - q), **ORBIT)
    draw_both_ways(panel, angle, separatrix, **SEPARATRIX)
    frame(panel, "(a) Pendulum", np.pi, 2.9)
    name_angles(panel, [(-np.pi, r"$-\pi$"), (-HALF_TURN, r"$-\pi/2$"), (0, "0"),
                        (HALF_TURN, r"$\pi/2$"), (np.pi, r"$\pi$")])
    for side in (-1, 1):
        panel.text(side * (np.pi - block.slenderness / 2), -2.7, r"$\alpha$", ha="center",
                   fontsize=12)


def draw_libration_orbits(panel, block, shares):
    """Draws orbits inside the separatrix, for fractions of q_max, without loss."""
    for q in np.array(shares) * block.largest_rate**2:
        outermost = block.outermost_angle(q)
        angle = outermost * np.sin(np.linspace(-HALF_TURN, HALF_TURN, 401))
        draw_both_ways(panel, angle, block.rate(angle, q), **ORBIT)


def draw_toppling_orbits(panel, block, shares):
    """Draws orbits outside the separatrix, for fractions -q/q_max, that pass the top."""
    angle = np.linspace(-HALF_TURN, HALF_TURN, 801)
    for q in -np.array(shares) * block.largest_rate**2:
        draw_both_ways(panel, angle, block.rate(angle, q), **ORBIT)


def draw_returning_orbits(panel, block, shares):
    """Draws orbits beyond the top, for fractions of q_max, that turn back before it."""
    for q in np.array(shares) * block.largest_rate**2:
        turning = 2 * block.slenderness - block.outermost_angle(q)
        if turning < HALF_TURN:
            way = np.linspace(-1, 1, 801)
            angle = turning + (HALF_TURN - turning) * way**2
            draw_both_ways(panel, angle, np.sign(way) * block.rate(angle, q), **ORBIT)


def draw_lossless(panel, block, highest):
    alpha, largest = block.slenderness, block.largest_rate
    panel.axvspan(-alpha, alpha, color=STRIP, alpha=0.25, linewidth=0)
    angle = np.linspace(-alpha, alpha, 601)
    c = block.separatrix_rate(angle)
    panel.fill_between(angle, -c, c, color=LIBRATION, linewidth=0)
    draw_libration_orbits(panel, block, (0.15, 0.45, 0.8))
    draw_toppling_orbits(panel, block, (1, 3.2))
    draw_returning_orbits(panel, block, (0.4, 1.6))
    outside = np.linspace(alpha, HALF_TURN, 401)
    draw_both_ways(panel, angle, c, **SEPARATRIX)
    draw_both_ways(panel, outside, -block.separatrix_rate(outside), **SEPARATRIX)
    draw_both_ways(panel, outside[::-1], block.separatrix_rate(outside[::-1]), **SEPARATRIX)
    half = alpha / 2
    mark(panel, "$A$", alpha, 0, (13, 0))
    mark(panel, "$A'$", -alpha, 0, (-13, 0))
    mark(panel, "$B$", 0, largest, (0, 12))
    mark(panel, "$B'$", 0, -largest, (0, -12))
    mark(panel, "$D$", half, block.separatrix_rate(half), (11, 8))
    mark(panel, r"$\bar D$", half, -block.separatrix_rate(half), (11, -8))
    frame(panel, "(b) Rocking block without loss at impacts", HALF_TURN, highest)
    block_ticks(panel, block)


def portrait_pendulum(block, highest):
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(13, 5.8))
    draw_pendulum(left, block)
    draw_lossless(right, block, highest)
    return figure


def swings(block, q, count):
    """Yields the arcs of rocking after the first impact; q_max - q is multiplied by r at each
    impact (Eq. 5)."""
    side = 1
    for _ in range(count):
        q = block.largest_rate**2 - block.restitution * (block.largest_rate**2 - q)
        angle = block.outermost_angle(q) * np.cos(np.linspace(-HALF_TURN, HALF_TURN, 401))
        speed = block.rate(angle, q) * np.sign(np.arange(401)[::-1] - 200)
        yield side * angle, side * speed
        side = -side


def draw_orbit_from_c(panel, block):
    """Draws the orbit from C, beyond -alpha, through the blade and the impacts that follow."""
    q = block.q_min * 0.55
    start = -(block.slenderness + 0.45 * (HALF_TURN - block.slenderness))
    angle = np.linspace(start, 0, 401)
    draw_orbit(panel, angle, block.rate(angle, q), color=RED, linewidth=1.8, zorder=5)
    last = float(block.rate(0.0, q))
    for arc, speed in swings(block, q, 5):
        panel.plot([0, 0], [last, speed[0]], color=RED, linewidth=1.8, linestyle=":", zorder=5)
        draw_orbit(panel, arc, speed, color=RED, linewidth=1.8, zorder=5)
        last = speed[-1]
    without_loss = np.linspace(0, HALF_TURN, 401)
    draw_orbit(panel, without_loss, block.rate(without_loss, q), color=RED, linewidth=1.2,
               linestyle=(0, (4, 3)), zorder=5)
    mark(panel, "$C$", start, float(block.rate(start, q)), (0, 13), color=RED)


def mark_blades(panel, block):
    """Marks the points of Eqs. 8, 16, 18 and 19."""
    alpha, largest = block.slenderness, block.largest_rate
    before = float(block.inward_rate(0.0))
    at_the_top = float(block.inward_rate(alpha))
    for sign, prime, other in ((1, "", "'"), (-1, "'", "")):
        mark(panel, f"$A{prime}$", sign * alpha, 0, (sign * 4, sign * 13))
        mark(panel, f"$B{prime}$", 0, sign * largest, (sign * 12, sign * 10))
        mark(panel, rf"$\bar B{prime}$", 0, sign * before, (-sign * 12, sign * 8))
        mark(panel, rf"$\bar A{other}$", -sign * alpha, sign * at_the_top,
             (sign * 5, sign * 13))


def portrait_libration(block, highest):
    figure, panel = pyplot.subplots(figsize=(9.5, 7))
    fill_libration(panel, block, LIBRATION, HALF_TURN, highest)
    draw_boundaries(panel, block, highest)
    draw_orbit_from_c(panel, block)
    mark_blades(panel, block)
    frame(panel, "The libration region with the loss at the first impact", HALF_TURN, highest)
    block_ticks(panel, block)
    panel.plot([], [], color=RED, linewidth=1.8, label="from C, with loss at each impact")
    panel.plot([], [], color=RED, linewidth=1.2, linestyle=(0, (4, 3)), label="without loss")
    panel.legend(loc="lower left", frameon=False, fontsize=9.5)
    return figure


def reach_of(portrait, block):
    """Returns the largest angle of a portrait; of slender blocks, the regions are near the upright position."""
    widest = max(block.slenderness, block.other.slenderness)
    near = 4 if block.other is block else 2
    return min(HALF_TURN, near * widest) if portrait == "regions" else HALF_TURN


def portrait_regions(block, highest):
    figure, panel = pyplot.subplots(figsize=(9.5, 7))
    reach = reach_of("regions", block)
    fill_regions(panel, block, reach, highest)
    draw_boundaries(panel, block, highest)
    codes = map_of_regions(block, reach, highest)
    cells = thinned(np.arange(len(codes)))
    codes = codes[np.ix_(cells, cells)]
    for code in np.unique(codes):
        for piece in pieces(codes == code, LEAST_SHARE * codes.size):
            write_label(panel, piece, REGIONS[code][0], size=13)
    frame(panel, "Outcome of free rocking, by initial state", reach, highest)
    block_ticks(panel, block)
    return figure


PORTRAITS = {"pendulum": portrait_pendulum, "libration": portrait_libration,
             "regions": portrait_regions}


def draw(portrait, block):
    fastest = max(float(side.inward_rate(angle)) * side.frequency_parameter / block.frequency_parameter
                  for side in (block, block.other) for angle in (0.0, reach_of(portrait, block)))
    figure = PORTRAITS[portrait](block, HIGHEST[portrait] * fastest)
    words = ("the orange strips of (a), joined, form that of (b)" if portrait == "pendulum"
             else f"r = {block.restitution:.4g}")
    angles = (f"α = {block.slenderness:.4g} rad" if block.other is block
              else f"α = {block.slenderness:.4g} rad (+), {block.other.slenderness:.4g} rad (−)")
    figure.suptitle(f"Phase portrait,  {angles},  {words}",
                    x=0.02, y=0.98, ha="left", fontsize=12)
    figure.tight_layout()
    return figure


def read_arguments(argv):
    parser = parser_of("plot_phase", __doc__, EXAMPLE)
    parser.add_argument("portrait", choices=PORTRAITS, help="the portrait to plot")
    parser.add_argument("--slenderness", type=float, default=0.4, metavar="ALPHA",
                        help="slenderness of the block [rad] (default: 0.4)")
    parser.add_argument("--restitution", type=float, metavar="R",
                        help="energy ratio at an impact (default: the maximum for the slenderness)")
    parser.add_argument("--block", metavar="FILE.h5",
                        help="the block of a spectrum or a boundary, in place of these; its first one, if there are "
                             "several")
    arguments = parse_with_picture(parser, argv, "phase_PORTRAIT.png")
    if arguments.block and arguments.portrait != "regions":
        parser.error("--block is for the portrait regions")
    if arguments.portrait == "pendulum" and arguments.restitution is not None:
        parser.error("the portrait pendulum has no loss at impacts: omit --restitution")
    return arguments


def block_of_file(path):
    with open_result(path, SPECTRUM) as file:
        return block_of(Plane(file, dict.fromkeys(file.dimensions, 0), None, file.dimensions[-1]))


def chosen_block(arguments):
    if arguments.block:
        return block_of_file(arguments.block)
    if not 0 < arguments.slenderness < HALF_TURN:
        raise ToolError(f"--slenderness {arguments.slenderness:g} is outside (0, pi/2).", USAGE)
    r = 1.0 if arguments.portrait == "pendulum" else arguments.restitution
    if r is None:
        r = largest_restitution(arguments.slenderness)
    if not 0 < r <= 1:
        raise ToolError(f"--restitution {r:g} is outside (0, 1].", USAGE)
    return FreeBlock(arguments.slenderness, r)


def main(argv=None):
    arguments = read_arguments(argv)
    block = chosen_block(arguments)
    figure = draw(arguments.portrait, block)
    save(figure, arguments.output, dpi=120)
