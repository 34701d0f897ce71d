"""The points of a fragility: how many exceed, under each motion at each value of the intensity measure."""

import math

import numpy as np
from scipy.special import expit
from scipy.stats import t as student_t

from overturn.block_groups import blocks_at_one_site, objects_of
from overturn.exceedance import EXCEEDING, NOT_COMPUTED, SAFE, SLIPPING, UNDECIDED
from overturn.joint_blocks import combined
from overturn.motion_bootstrap import LEVEL

VERDICTS = {"points": (SAFE, EXCEEDING), "exceeding": (EXCEEDING,), "undecided": (UNDECIDED, SLIPPING),
            "not_computed": (NOT_COMPUTED,), "slipping": (SLIPPING,)}


def points_of(dataset, measures, exceedance, friction_demand, together=None):
    """Returns arrays with an entry per motion and value of the measures (and per direction of the motion, for blocks
    together): the motion, the measures (a list), the first of them as "measure", and the numbers of points of each
    kind; which blocks these are, as fields of a Fragility; and notes.

    measures: of every motion at every scale, by name."""
    objects, blocks = objects_of(dataset), blocks_of(dataset)
    has_several_rows = objects and len(np.unique(objects.of_row)) < len(objects.of_row)
    parts, dimension, whose = [dataset], objects.dimension if has_several_rows else None, "rows of an object"
    if together is not None:
        number, parts, dimension = blocks_at_one_site(dataset, together)
        blocks |= {} if together == "azimuth_of" else {"blocks": number, "kind": "blocks"}
        whose = "blocks"
    vary = [name for name, each in measures.items()
            if dimension in each.dims and dimension not in dataset["motion"].dims]
    values = [each.max(dimension, keep_attrs=True) if together is not None and name in vary else each
              for name, each in measures.items()]
    cells = combined([cells_of(part, values, exceedance, friction_demand, together is not None) for part in parts])
    return cells, blocks, [*(f"{name} is the largest of those in the directions of the {whose}" for name in vary),
                           *exceedance.notes(dataset)]


def blocks_of(dataset):
    """Returns the number of blocks, what they are (rows of a table may be one block several times), and whether they
    are several samples of an object."""
    sizes = {name: count for name, count in dataset["region"].sizes.items() if name not in ("motion", "scale", "pga")}
    directions = sizes.pop("direction", 1)
    if objects := objects_of(dataset):
        variants = math.prod(sizes.values()) // sizes[objects.dimension]
        number, kind = objects.counted()
        kind += f", {variants} variants each" * (variants > 1)
    else:
        number = math.prod(sizes.values())
        kind = "rows of the table" if sizes.get("block") == number else "blocks"
    return {"blocks": number, "kind": kind + f" in {directions} directions" * (directions > 1),
            "pools_samples": objects is not None and objects.samples > number}


def cells_of(dataset, measures, exceedance, friction_demand, by_direction=False):
    """Returns the arrays of points_of(), with an entry per direction of the motion if requested."""
    verdict, motion = exceedance.verdicts(dataset, friction_demand), _numbered(dataset)
    if objects := objects_of(dataset):
        verdict, motion, *measures = map(objects.largest, (verdict, motion, *measures))
    kept = [name for name in verdict.dims if name in (*(name for each in (motion, *measures) for name in each.dims),
                                                      *["direction"] * by_direction)]
    others = [name for name in verdict.dims if name not in kept]
    like = verdict.isel(dict.fromkeys(others, 0), drop=True)

    def flat(values):
        return values.broadcast_like(like).transpose(*kept).values.ravel()
    cells = {kind: verdict.isin(codes).astype(np.int32).sum(others).transpose(*kept).values.ravel()
             for kind, codes in VERDICTS.items()}
    values = [flat(each) for each in measures]
    return {**cells, "motion": flat(motion), "measures": values, "measure": values[0]}


def _numbered(dataset):
    """Returns the coordinate motion, with different numbers for motions of different names: results that were joined
    number theirs alike."""
    motion = dataset["motion"]
    if "motion_name" not in dataset or dataset["motion_name"].dims != motion.dims:
        return motion
    names = np.char.add(motion.values.astype(str), np.char.add(" ", dataset["motion_name"].values.astype(str)))
    return motion.copy(data=np.unique(names, return_inverse=True)[1].reshape(motion.shape))


def is_measurable(cells):
    """Whether the logarithm of the measure exists."""
    return np.isfinite(cells["measure"]) & (cells["measure"] > 0)


def edges_of(cells, bins, equal_counts=False):
    """Returns the edges of the bins, over the range of the points with a verdict, evenly spaced in the logarithm or
    with as equal numbers of points as equal values of the measure allow; none without such points."""
    kept = is_measurable(cells) & (cells["points"] > 0)
    measure = cells["measure"][kept]
    if not measure.size:
        return np.empty(0)
    low, high = measure.min(), measure.max()
    if low == high:
        return np.array([low / 1.05, high * 1.05])
    if equal_counts:
        values, place = np.unique(measure, return_inverse=True)
        below = np.cumsum(np.bincount(place, cells["points"][kept]))
        wanted = below[-1] * np.arange(1, bins) / bins
        cuts = np.unique(abs(below[:-1] - wanted[:, None]).argmin(axis=1))
        return np.array([low, *np.sqrt(values[cuts] * values[cuts + 1]), high])
    edges = np.geomspace(low, high, bins + 1)
    edges[0], edges[-1] = low, high
    return edges


def share_interval(points, exceeding):
    """Returns the 95 % confidence of the share of the points that exceed, (2, bins); NaN with fewer than two motions.

    points, exceeding: with a verdict, of each motion in each bin (motions, bins).

    Points under one motion are not independent: the variance of the share p = sum y / sum n is sum (y - p n)^2 /
    (sum n)^2 over the motions, or that of independent points if this is larger. The interval is that of Student's t of
    ln(p / (1 - p)). If none or all of the points exceed, it is that of Clopper and Pearson for as many points as there
    are motions."""
    motions, total = (points > 0).sum(axis=0), points.sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = exceeding.sum(axis=0) / total
        variance = np.maximum(((exceeding - share * points) ** 2).sum(axis=0) / total**2, share * (1 - share) / total)
        width = student_t.ppf((1 + LEVEL) / 2, motions - 1) * np.sqrt(variance) / (share * (1 - share))
        low, high = expit(np.log(share / (1 - share)) + np.multiply.outer([-1, 1], width))
        furthest = ((1 - LEVEL) / 2) ** (1 / motions)
    low, high = np.where(share == 0, 0, np.where(share == 1, furthest, low)), \
        np.where(share == 1, 1, np.where(share == 0, 1 - furthest, high))
    return np.where(motions > 1, [low, high], np.nan)


def left_out(cells, im, friction_demand):
    """Returns notes on the points that are not in the curve."""
    undecided, not_computed = (int(cells[name].sum()) for name in ("undecided", "not_computed"))
    total = int(cells["points"].sum()) + undecided + not_computed
    unmeasured = int(cells["points"][~is_measurable(cells)].sum())
    motions = len(np.unique(cells["motion"]))
    without = motions - len(np.unique(cells["motion"][cells["points"] > 0]))
    return ([f"the result is unfinished: {not_computed} of {total} points are not computed and left out"]
            * (not_computed > 0)
            + [f"{without} of {motions} motions have no point with a verdict"] * (without > 0)
            + [f"left out: {undecided} of {total} points, which {_undecided(cells, friction_demand)}"] * (undecided > 0)
            + [f"left out: {unmeasured} points whose {im} is not positive"] * (unmeasured > 0))


def _undecided(cells, friction_demand):
    """Returns why points are undecided."""
    undecided, slipping = (int(cells[name].sum()) for name in ("undecided", "slipping"))
    if not slipping:
        return "are undecided"
    need = f"need a friction coefficient above {friction_demand:g}, or an unknown one"
    return need if slipping == undecided else f"are undecided, {slipping} of them because they {need}"
