"""Pictures of results, on the axes of Matplotlib."""

from overturn.plot.fragility import fragility

__all__ = ["fragility"]
