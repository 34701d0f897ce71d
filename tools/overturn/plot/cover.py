"""What covers a panel: a picture, and a hatch where that is transparent."""

from overturn.regions import HATCH
from overturn.tool import USAGE, ToolError


def expect_empty(ax):
    """Raises an error if there is a picture in the axes of a caller, if any: another one would cover it."""
    if ax is not None and (ax.images or ax.child_axes):
        raise ToolError("the axes already have a picture, which another one would cover. Give other axes, or clear "
                        "them with ax.clear().", USAGE)


def cover(panel, picture, low=0, high=1):
    """Covers the panel, or a part of its height."""
    image = panel.imshow(picture, extent=(0, 1, low, high), transform=panel.transAxes, origin="lower",
                         aspect="auto", interpolation="nearest")
    image.set_in_layout(False)  # Matplotlib takes its extent for one in data coordinates


def hatch(panel):
    """Hatches what a picture does not cover: it is not computed."""
    panel.patch.set(**HATCH, linewidth=0)
