"""Results as overturn.open returns them, made of given regions, for tests of fragility curves."""

import numpy as np
import xarray

S, S_PLUS, U0, F, UNDECIDED, NOT_COMPUTED = 0, 1, 3, 8, 254, 255


def result(region, scale, motions=None, pgv=1.0, **fields):
    """A result as overturn.open returns it: region (motion, scale, block)."""
    region = np.asarray(region, np.uint8)
    motions = region.shape[0]
    dims = ("motion", "scale", "block")
    names = ["S", "S_plus", "S_minus", "U0_plus", "U0_minus", "U1_plus", "U1_minus", "F_plus", "F_minus", "undecided",
             "not_computed"]
    flags = {"flag_values": np.uint8([*range(9), 254, 255]), "flag_meanings": " ".join(names)}
    data = {"region": (dims, region, flags), **{name: (dims, values) for name, values in fields.items()}}
    measures = {"record_pga": 0.5, "pgv": pgv, "arias_intensity": 3.0, "significant_duration": 8.0}
    return xarray.Dataset(data, coords={
        "motion": np.arange(1.0, motions + 1), "scale": np.asarray(scale, float),
        **{name: ("motion", np.full(motions, value), {"units": "1" if name == "record_pga" else "m s-1"})
           for name, value in measures.items()}})


def graded(motions=10, blocks=8):
    """More blocks overturn at larger scales; motions differ by one block."""
    scale = np.array([0.5, 1.0, 2.0, 4.0])
    counts = np.minimum(np.array([0, 2, 5, 7]) + np.arange(motions)[:, None] % 2, blocks)
    region = np.where(np.arange(blocks) < counts[..., None], F, S_PLUS)
    return region, scale
