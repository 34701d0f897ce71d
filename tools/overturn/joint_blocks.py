"""Several blocks at one site. Under one motion their fates are not independent of each other, so survival is
multiplied within each motion, before any mean over motions:

    P(x) = 1 - mean over motions of the product over blocks of S_i(motion, x)

S_i is the share of the points of block i that are safe. Two blocks with equal verdicts have the P of one."""

import math

import numpy as np

KINDS = ("points", "exceeding", "undecided", "not_computed", "slipping")
MOST_POINTS = 2**53  # exact as numbers of floating point


def combined(parts):
    """Returns the points of fragility_points.cells_of() in which a point is a combination of one point of each part,
    under one motion at one value of the measure. It exceeds if one of them does, whatever the others; it has no verdict
    if none is known to exceed and one of them has no verdict.

    Raises ValueError if there are more than 2^53 combinations."""
    if len(parts) == 1:
        return parts[0]
    numbers = [{kind: part[kind].astype(np.int64) for kind in KINDS} for part in parts]
    total = [each["points"] + each["undecided"] + each["not_computed"] for each in numbers]
    count = math.prod(int(each.max(initial=1)) for each in total) * len(total[0])
    if count > MOST_POINTS:
        raise ValueError(f"there are up to {count:.2g} combinations of the points of {len(parts)} blocks, more than "
                         "2^53. Choose fewer points of each block by isel().")

    def product(*without):
        return math.prod(all_points - sum(each[kind] for kind in without)
                         for each, all_points in zip(numbers, total))
    none_exceeds, safe = product("exceeding"), product("exceeding", "undecided", "not_computed")
    computed = product("exceeding", "not_computed")
    return {**parts[0], "exceeding": product() - none_exceeds, "points": product() - none_exceeds + safe,
            "not_computed": none_exceeds - computed, "undecided": computed - safe,
            "slipping": computed - product("exceeding", "not_computed", "slipping")}
