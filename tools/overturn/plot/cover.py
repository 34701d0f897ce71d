"""What covers a panel: a picture, and a hatch where that is transparent."""

from overturn.regions import HATCH


def cover(panel, picture):
    image = panel.imshow(picture, extent=(0, 1, 0, 1), transform=panel.transAxes, origin="lower",
                         aspect="auto", interpolation="nearest")
    image.set_in_layout(False)  # Matplotlib takes its extent for one in data coordinates


def hatch(panel):
    """Hatches what a picture does not cover: it is not computed."""
    panel.patch.set(**HATCH, linewidth=0)
