"""Draws a rock on its contacts, and its slenderness around it."""

import math

import numpy as np
from matplotlib import pyplot

from overturn.rock import towards

LINE, AREA, WEAKEST = "#1f5c99", "#cfe0f2", "#b2331d"


def rock(found, x_azimuth=None):
    """Draws the outlines of a rock (overturn.rock.Rock) and of its contacts in plan, and alpha around it, and returns both
    axes. x_azimuth: of x on a compass [degree]; north is then up."""
    figure = pyplot.figure(figsize=(10, 5.2), layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0.07, 1, 0.93))  # below it, the legend
    plan, polar = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2, projection="polar")
    turn = math.radians(90 - x_azimuth) if x_azimuth is not None else 0
    least, azimuth = found.weakest()

    def seen(points):
        return (points[:, 0] * math.cos(turn) - points[:, 1] * math.sin(turn),
                points[:, 0] * math.sin(turn) + points[:, 1] * math.cos(turn))
    plan.fill(*seen(found.outline), color="0.9", label="rock (convex outline)")
    plan.fill(*seen(found.hull), facecolor=AREA, edgecolor=LINE, label="outline of the contacts")
    plan.plot(*seen(found.contacts), "o", color=LINE, markersize=4, label="contacts")
    plan.plot(0, 0, "k+", markersize=10, label="centre of mass")
    distance = found.section(np.array([azimuth]))[0]
    plan.plot(*seen(np.array([[0, 0], [math.cos(azimuth), math.sin(azimuth)]]) * distance), color=WEAKEST, linewidth=2,
              label="weakest azimuth")
    if not found.is_dense():
        for number, middle in enumerate((found.hull + np.roll(found.hull, -1, axis=0)) / 2, 1):
            plan.annotate(f"{number}", [each[0] for each in seen(middle[None])], fontsize=9, ha="center", va="center",
                          bbox={"boxstyle": "circle,pad=0.15", "facecolor": "white", "edgecolor": LINE})
    axes = ("x [m]", "y [m]") if x_azimuth is None else ("east [m]", "north [m]")
    plan.set(aspect="equal", xlabel=axes[0], ylabel=axes[1], title="Plan, from the centre of mass")
    around = np.radians(np.arange(0, 360.25, 0.25))
    if x_azimuth is not None:
        polar.set_theta_zero_location("N")
        polar.set_theta_direction(-1)

    def shown(azimuths):
        return azimuths if x_azimuth is None else math.radians(x_azimuth) - azimuths
    polar.plot(shown(around), np.degrees(found.slenderness(around)), color=LINE)
    polar.plot(shown(found.edges()), np.degrees(found.slenderness(found.edges())), "D", color=LINE, markersize=4,
               label="planes across the edges")
    polar.plot([shown(azimuth)] * 2, [0, math.degrees(least)], color=WEAKEST, linewidth=2)
    polar.set_ylim(0)
    figure.legend(fontsize=8, loc="lower center", ncols=6)
    polar.set_title(f"alpha [degree], least {math.degrees(least):.1f}\ntowards {towards(azimuth, x_azimuth)}")
    return plan, polar
