"""Plots the regions in phase space from closed formulas: what becomes of a block that rocks freely, by its
angle and velocity."""

from matplotlib import pyplot
from overturn.output_file import save
from overturn.phase_space import (HALF_TURN, FreeBlock, draw_boundaries, fill_regions, largest_restitution,
                                  name_phase_axes)
from overturn.tool import USAGE, ToolError, parse_with_picture, parser_of

EXAMPLE = """\
example:
  tools/plot_phase                               # draws phase.png
  tools/plot_phase --slenderness 0.1746 -o regions.pdf

The default block is stout, alpha = 0.4 rad, so that all details are visible (Fig. 4 of the paper);
the default r is the maximum for its slenderness, (1 - 3/2 sin^2 alpha)^2."""

HIGHEST = 1.5  # velocity in the picture, over the largest safe one


def draw(block):
    figure, panel = pyplot.subplots(figsize=(9.5, 7))
    highest = HIGHEST * float(max(block.inward_rate(0.0), block.inward_rate(HALF_TURN)))
    fill_regions(panel, block, highest)
    draw_boundaries(panel, block)
    reach = 0.62 * HALF_TURN
    beside = 1.4 * block.slenderness
    blade = (beside, (float(block.inward_rate(beside))
                      + abs(float(block.separatrix_rate(beside)))) / 2)
    for sign in (1, -1):
        own, other = ("+", "−") if sign == 1 else ("−", "+")
        for name, (angle, rate) in ((f"U0{own}", (reach, 0.3 * highest)),
                                    (f"U1{own}", (-reach * 0.6, 0.8 * highest))):
            panel.text(sign * angle, sign * rate, name, ha="center", va="center", fontsize=14)
        panel.annotate(f"S{own}", (-sign * blade[0], sign * blade[1]),
                       (-sign * 0.68 * HALF_TURN, sign * 0.24 * highest), fontsize=14, ha="center",
                       va="center", arrowprops={"arrowstyle": "-", "linewidth": 0.8})
    panel.text(0, 0, "S", ha="center", va="center", fontsize=14)
    panel.set(xlim=(-HALF_TURN, HALF_TURN), ylim=(-highest, highest))
    panel.set_title("Outcome of free rocking, by initial state", fontsize=11)
    panel.axhline(0, color="0.6", linewidth=0.6, zorder=0)
    panel.axvline(0, color="0.6", linewidth=0.6, zorder=0)
    name_phase_axes(panel)
    alpha = block.slenderness
    panel.set_xticks([-HALF_TURN, -alpha, 0, alpha, HALF_TURN],
                     [r"$-\pi/2$", r"$-\alpha$", "0", r"$\alpha$", r"$\pi/2$"])
    figure.suptitle(f"Phase portrait,  α = {alpha:.4g} rad,  r = {block.restitution:.4g}",
                    x=0.02, y=0.98, ha="left", fontsize=12)
    figure.tight_layout()
    return figure


def read_arguments(argv):
    parser = parser_of("plot_phase", __doc__, EXAMPLE)
    parser.add_argument("--slenderness", type=float, default=0.4, metavar="ALPHA",
                        help="slenderness of the block [rad] (default: 0.4)")
    parser.add_argument("--restitution", type=float, metavar="R",
                        help="energy ratio at an impact (default: the maximum for the slenderness)")
    return parse_with_picture(parser, argv, "phase.png")


def chosen_block(arguments):
    if not 0 < arguments.slenderness < HALF_TURN:
        raise ToolError(f"--slenderness {arguments.slenderness:g} is outside (0, pi/2).", USAGE)
    r = arguments.restitution
    if r is None:
        r = largest_restitution(arguments.slenderness)
    if not 0 < r <= 1:
        raise ToolError(f"--restitution {r:g} is outside (0, 1].", USAGE)
    return FreeBlock(arguments.slenderness, r)


def main(argv=None):
    arguments = read_arguments(argv)
    save(draw(chosen_block(arguments)), arguments.output, dpi=120)
