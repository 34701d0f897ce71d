"""Pictures of result files. Each function returns axes of Matplotlib."""

from overturn.plot.fragility_curves import fragility

__all__ = ["fragility"]
