"""Phase space of free rocking in closed form (Eqs. 5, 11-20): angle, and velocity over p.

Times are in 1/p, so that a velocity is d theta / d(p t) [rad]; q is over p^2.
"""

import numpy as np
from matplotlib import patheffects
from overturn.regions import CODES, REGIONS

HALF_TURN = np.pi / 2  # tilt of an overturned block
BOUNDARY = {"color": "black", "linewidth": 0.9,  # visible on dark colours, too
            "path_effects": [patheffects.withStroke(linewidth=2.2, foreground="white")]}


class FreeBlock:
    """A block of given slenderness [rad] and restitution, in nonlinear or linear theory."""

    def __init__(self, slenderness, restitution, linear=False):
        self.slenderness, self.restitution, self.linear = slenderness, restitution, linear
        self.largest_rate = float(self.separatrix_rate(0.0))  # Eq. 8
        self.q_min = self.largest_rate**2 * (1 - 1 / restitution)  # Eq. 18

    def separatrix_rate(self, angle):
        """c = 2 sin((alpha - |theta|)/2), in linear theory alpha - |theta|; negative for
        |theta| > alpha (Eq. 15)."""
        below_top = self.slenderness - np.abs(angle)
        return below_top if self.linear else 2 * np.sin(below_top / 2)

    def rate(self, angle, q):
        """The speed on the orbit of this q: theta'^2 = c^2 - q (Eq. 21)."""
        return np.sqrt(np.maximum(self.separatrix_rate(angle)**2 - q, 0))

    def inward_rate(self, angle):
        """The largest inward speed at which the block stays safe after one impact: q0 = q_min."""
        return self.rate(angle, self.q_min)

    def outermost_angle(self, q):
        """The largest angle on the orbit of 0 <= q <= q_max: c^2 = q."""
        rate = np.sqrt(q)
        return self.slenderness - (rate if self.linear else 2 * np.arcsin(rate / 2))


def largest_restitution(slenderness):
    """Eq. 17."""
    return (1 - 1.5 * np.sin(slenderness)**2)**2


def bands(block, angle):
    """Regions for theta >= 0 in ascending velocity: region, lowest and highest velocity; None means
    unbounded. For theta <= 0 the same holds with the signs of velocity and region reversed."""
    c = block.separatrix_rate(angle)
    return (("U1-", None, -block.inward_rate(angle)),
            ("S-", -block.inward_rate(angle), -np.abs(c)),
            ("S", -np.maximum(c, 0), np.maximum(c, 0)),
            ("U0+", c, None))


def fill_regions(panel, block, highest):
    """Fills all seven regions with their colours, up to the given velocity."""
    angle = np.linspace(0, HALF_TURN, 1001)
    for name, low, high in bands(block, angle):
        low = np.full_like(angle, -highest) if low is None else low
        high = np.full_like(angle, highest) if high is None else high
        for sign in (1, -1):
            turned = name if sign == 1 else name.translate(str.maketrans("+-", "-+"))
            panel.fill_between(sign * angle, sign * low, sign * high, linewidth=0,
                               color=REGIONS[CODES[turned]][2])


def fill_libration(panel, block, colour):
    """Fills the set of all safe states (Eq. 20), blades and rhomboid."""
    half = np.linspace(0, HALF_TURN, 1001)
    angle = np.concatenate([-half[::-1], half])  # 0 is repeated: the edges are discontinuous there
    side = np.repeat([-1, 1], len(half))
    edges = -side * block.inward_rate(angle), side * block.separatrix_rate(angle)
    panel.fill_between(angle, *edges, color=colour, linewidth=0)


def draw_boundaries(panel, block, **style):
    """Draws the lines between the seven regions: the separatrix (for |theta| > alpha, too), the
    outer edge of the blades, and theta = 0 outside of them, which separates U0 from U1."""
    style = BOUNDARY | style
    angle = np.linspace(0, HALF_TURN, 1001)
    c, inward = block.separatrix_rate(angle), block.inward_rate(angle)
    for sign in (1, -1):
        panel.plot(sign * angle, sign * c, **style)
        panel.plot(sign * angle, -sign * np.abs(c), **style)
        panel.plot(sign * angle, -sign * inward, **style)
        panel.plot([0, 0], [sign * block.largest_rate, sign * 100], **style)


def name_phase_axes(panel):
    panel.set_xlabel(r"angle  $\theta$ [rad]")
    panel.set_ylabel(r"velocity  $\theta'=\dot\theta\,/\,p$ [rad]")
