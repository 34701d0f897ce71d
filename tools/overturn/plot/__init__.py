"""Pictures of result files. Each function returns axes of Matplotlib."""

from overturn.plot.azimuths import fragility_azimuths
from overturn.plot.boundaries import boundary
from overturn.plot.logic_trees import branches
from overturn.plot.fragility_curves import fragility
from overturn.plot.fragility_planes import fragility_plane
from overturn.plot.histories import history
from overturn.plot.risks import risk
from overturn.plot.spectra import spectrum

__all__ = ["boundary", "branches", "fragility", "fragility_azimuths", "fragility_plane", "history", "risk", "spectrum"]
