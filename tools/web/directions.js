// The answer of "topple" for all directions of the motion together. This file imports nothing, so that Node reads it.

/** The union of lists of ranges [first, last], sorted; ranges that touch are one. */
function union(lists) {
    const ranges = [];
    for (const [first, last] of lists.flat().sort((a, b) => a[0] - b[0])) {
        const previous = ranges.at(-1);
        if (previous && first <= previous[1]) {
            previous[1] = Math.max(previous[1], last);
        } else {
            ranges.push([first, last]);
        }
    }
    return ranges;
}

/** What remains of ranges without holes, both sorted. */
function without(ranges, holes) {
    return holes.reduce((left, [begin, end]) => left.flatMap(([first, last]) =>
        (end <= first || last <= begin ? [[first, last]]
            : [[first, begin], [end, last]].filter((each) => each[0] < each[1]))), ranges);
}

/** A strength topples if it does so in one direction; it is safe if it is safe in all of them. null: not searched. */
function ranges_of(directions) {
    const end = Math.min(...directions.map((each) => each.end_of_search ?? 0));
    if (end === 0) {
        return {toppling_pga: null, safe_pga: null, undecided_pga: null, end_of_search: null};
    }
    // In answers, null is the end of a range that may go on beyond the search.
    const searched = (list) => list.map(([first, last]) => [first, Math.min(last ?? end, end)])
        .filter(([first]) => first < end);
    const lists = (key) => directions.map((each) => searched(each[key]));
    const toppling = union(lists("toppling_pga"));
    const undecided = without(union(lists("undecided_pga")), toppling);
    const open = (list) => list.map(([first, last]) => [first, last < end ? last : null]);
    return {
        toppling_pga: open(toppling), undecided_pga: open(undecided), end_of_search: end,
        safe_pga: lists("safe_pga").reduce((all, each) => without(all, without([[0, end]], each)), [[0, end]]),
    };
}

const least = (values) => values.reduce((all, each) => (each === null ? all : Math.min(all ?? each, each)), null);

/** How the search was coarse, in the directions in which it was; null if it was so in none. */
function coarse_search_of(directions) {
    const all = directions.map((each) => each.coarse_search).filter((each) => each);
    return !all.length ? null : {first: Math.min(...all.map((each) => each.first)),
                                 last: Math.max(...all.map((each) => each.last)),
                                 step: Math.max(...all.map((each) => each.step))};
}

/** The answer with the ranges, verdict and needs of all directions; the motion remains that of the worst one. */
export function joined(answer) {
    const directions = answer.by_direction;
    const slips = directions.map((each) => each.slip).filter((each) => each);
    const demands = directions.map((each) => each.friction_demand);
    return {
        ...answer, ...ranges_of(directions),
        topples: directions.some((each) => each.topples) || (directions.some((each) => each.topples === null) ? null
            : false),
        lifting_pga: least(directions.map((each) => each.lifting_pga)),
        lifts_off: directions.some((each) => each.lifts_off),
        friction_demand: demands.includes(null) ? null : Math.max(...demands),
        slip: answer.slip && {...answer.slip, moving_pga: least(slips.map((each) => each.moving_pga)),
                              stays_flat: slips.every((each) => each.stays_flat)},
        coarse_search: coarse_search_of(directions),
        by_restitution: (answer.by_restitution ?? []).map((own, i) => ({...own,
            ...ranges_of(directions.map((each) => each.by_restitution[i]))})),
    };
}
