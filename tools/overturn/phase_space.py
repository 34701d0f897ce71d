"""Phase space of free rocking in closed form (Eqs. 5, 11-20; docs/two_sides.md): angle, and velocity over p.

Times are in 1/p, so that a velocity is d theta / d(p t) [rad]; q is over p^2.
"""

import functools

import numpy as np
from matplotlib.colors import to_rgba
from overturn.captions import is_linear
from overturn.regions import CODES, SAFE, coloured
from overturn.tool import USAGE, ToolError

HALF_TURN = np.pi / 2  # tilt of an overturned block
PIXELS = 600  # of a map of states, per side; even, so that none is at the angle 0


class FreeBlock:
    """A block of given slenderness [rad] and restitution, in nonlinear or linear theory: one side of it, in its own
    time. The other side is equal unless it is set; size R and frequency parameter p have units that both sides share."""

    def __init__(self, slenderness, restitution, linear=False, size=1.0, frequency_parameter=1.0):
        self.slenderness, self.restitution, self.linear = slenderness, restitution, linear
        self.size, self.frequency_parameter, self.other = size, frequency_parameter, self
        self.largest_rate = float(self.separatrix_rate(0.0))  # Eq. 8
        self.top = size * self.largest_rate**2  # the energy at which it balances, over m g / 2

    @property
    def q_min(self):
        """The least q0 of states that do not overturn after one impact or two (Eq. 18 if the sides are equal)."""
        r = self.restitution
        return self.largest_rate**2 * (1 - min(self.other.top / (r * self.top), 1 / r**2))

    def separatrix_rate(self, angle):
        """c = 2 sin((alpha - |theta|)/2), in linear theory alpha - |theta|; negative for
        |theta| > alpha (Eq. 15)."""
        below_top = self.slenderness - np.abs(angle)
        return below_top if self.linear else 2 * np.sin(below_top / 2)

    def rate(self, angle, q):
        """The speed on the orbit of this q: theta'^2 = c^2 - q (Eq. 21)."""
        return np.sqrt(np.maximum(self.separatrix_rate(angle)**2 - q, 0))

    def inward_rate(self, angle):
        """The largest inward speed at which the block stays safe: q0 = q_min."""
        return self.rate(angle, self.q_min)

    def outermost_angle(self, q):
        """The largest angle on the orbit of 0 <= q <= q_max: c^2 = q."""
        rate = np.sqrt(q)
        return self.slenderness - (rate if self.linear else 2 * np.arcsin(rate / 2))


def block_of(plane):
    """Returns the block of a plane of a result, as seen from its side plus."""
    def value(name):
        if (number := plane.value(name)) is None:
            raise ToolError(f"the block varies along {plane.across} or {plane.up}, but the boundaries in phase space "
                            "are those of one block. Choose it with --index.", USAGE)
        return number
    restitution, linear = value("restitution"), is_linear(plane.file)
    if "slenderness_plus" not in plane.file:
        return FreeBlock(value("slenderness"), restitution, linear)
    plus, minus = (FreeBlock(value(f"slenderness_{side}"), restitution, linear, value(f"size_{side}"), value(p))
                   for side, p in (("plus", "frequency_parameter"), ("minus", "frequency_parameter_minus")))
    plus.other, minus.other = minus, plus
    return plus


def largest_restitution(slenderness):
    """Eq. 17."""
    return (1 - 1.5 * np.sin(slenderness)**2)**2


def regions_of_states(block, angle, velocity):
    """Returns the codes of the regions of states at rest of the ground. velocity: over p of the side plus."""
    angle, velocity = np.broadcast_arrays(angle, velocity)
    codes = np.empty(angle.shape, np.uint8)
    for side, sign, own, other in ((block, 1, "+", "-"), (block.other, -1, "-", "+")):
        on_side = angle > 0 if sign > 0 else angle <= 0
        c = side.separatrix_rate(angle[on_side])
        rate = sign * velocity[on_side] * block.frequency_parameter / side.frequency_parameter
        energy = side.size * (side.largest_rate**2 - c**2 + rate**2)  # over m g / 2
        after = side.restitution * energy
        codes[on_side] = np.select(
            [rate > c, after > side.other.top, side.restitution * after > side.top, rate < -c],
            [CODES[name] for name in ("U0" + own, "U1" + other, "U2" + own, "S" + other)], CODES["S"])
    return codes


@functools.lru_cache(maxsize=4)
def map_of_regions(block, reach, highest):
    """Returns the codes of the regions of angles up to +-reach and velocities up to +-highest, row by row."""
    places = (np.arange(PIXELS) + 0.5) / PIXELS * 2 - 1
    return regions_of_states(block, reach * places, highest * places[:, None])


def show(panel, picture, reach, highest):
    image = panel.imshow(picture, extent=(-reach, reach, -highest, highest), origin="lower", aspect="auto",
                         interpolation="nearest", zorder=0)
    image.set_in_layout(False)


def fill_regions(panel, block, reach, highest):
    """Fills all regions with their colours."""
    show(panel, coloured(map_of_regions(block, reach, highest)), reach, highest)


def fill_libration(panel, block, colour, reach, highest):
    """Fills the set of all safe states (Eq. 20), blades and rhomboid."""
    is_safe = np.isin(map_of_regions(block, reach, highest), SAFE)
    picture = np.zeros((*is_safe.shape, 4), np.uint8)
    picture[is_safe] = [round(255 * part) for part in to_rgba(colour)]
    show(panel, picture, reach, highest)


def boundaries(block, highest):
    """Returns the lines between the regions: angles and velocities, nan where equal regions are on both sides."""
    def edge(angle, velocity, across, along):
        """The part of a line at which the regions just across it differ."""
        # Steps far above round-off, and far below a pixel.
        before, after = (regions_of_states(block, angle + step * across, velocity + step * along)
                         for step in (-1e-9, 1e-9))
        return np.where(before != after, angle, np.nan), velocity

    lines = [edge(0, np.linspace(-highest, highest, 2001), 1, 0)]
    for side, sign in ((block, 1), (block.other, -1)):
        for energy in (side.top, side.other.top / side.restitution, side.top / side.restitution**2):
            q = side.largest_rate**2 - energy / side.size
            tip = side.outermost_angle(max(q, 0))  # where the speed is zero, and its slope infinite
            angle = np.sort(np.append(np.linspace(2e-9, HALF_TURN, 1001), [tip - 1e-8, tip + 1e-8]))
            rate = side.rate(angle, q) * side.frequency_parameter / block.frequency_parameter
            lines += [edge(sign * angle, way * rate, 0, 1) for way in (1, -1)]
    return lines


def draw_boundaries(panel, block, highest, zorder=2):
    """Draws the lines between the regions."""
    lines = boundaries(block, highest)
    for colour, width in (("white", 2.2), ("black", 0.9)):  # visible on dark colours, too
        for line in lines:
            panel.plot(*line, color=colour, linewidth=width, zorder=zorder, scalex=False, scaley=False)


def name_phase_axes(panel):
    panel.set_xlabel(r"angle  $\theta$ [rad]")
    panel.set_ylabel(r"velocity  $\theta'=\dot\theta\,/\,p$ [rad]")
