"""Pictures of result files. Each function returns axes of Matplotlib."""

from overturn.plot.boundaries import boundary
from overturn.plot.histories import history
from overturn.plot.spectra import spectrum

__all__ = ["boundary", "history", "spectrum"]
