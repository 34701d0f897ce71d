// The bar of strengths: where the object stands, topples, is undecided, and what was not searched.
import {by_id, element, on_width, svg, text_of} from "overturn/elements";
import {linear_ticks, short, significant} from "overturn/numbers";

const ENTRIES = ["rests", "rocks", "topples", "gap", "undecided", "not_searched", "asked", "lifting"];
const MOST_RANGES = 4; // in the text
const HEIGHT = 78, TOP = 22, BAR = 30, SIDE = 14;

/** The last strength of the bar [g]: shows what is near the asked one; at the end of the search, a part beyond it. */
function last_shown(answer) {
    const end = answer.end_of_search;
    const main = Math.max(answer.pga, answer.lifting_pga ?? 0, answer.toppling_pga[0]?.[0] ?? 0);
    const ends = [...answer.toppling_pga, ...answer.undecided_pga].flat().filter((each) => each && each <= 3 * main);
    const last = 1.25 * Math.max(main, ...ends);
    return answer.toppling_pga.length === 0 || last > 0.8 * end ? 1.08 * end : last;
}

/** "0.5135 to 1.032 g, above 1.081 g": rounded outwards; those that touch when they are rounded are one. */
export function ranges_text(ranges, end) {
    const shown = [];
    for (const [from, to] of ranges) {
        const first = significant(from, 4, -1), last = significant(to ?? end, 4, 1), is_last = (to ?? end) >= end;
        const previous = shown.at(-1);
        if (previous && Number(first) <= Number(previous.last)) {
            Object.assign(previous, {last, is_last});
        } else {
            shown.push({first, last, is_last});
        }
    }
    const texts = shown.slice(0, MOST_RANGES)
        .map((range) => text_of(range.is_last ? "ranges.above" : "ranges.from_to", range));
    if (shown.length > MOST_RANGES) {
        texts.push(text_of("ranges.others", shown.at(-1)));
    }
    return texts.join(", ") || text_of("ranges.none");
}

/** Where the search was coarse. */
function coarse_text({first, last, step}) {
    return text_of("ranges.coarse",
        {first: significant(first, 3, -1), last: significant(last, 3, 1), step: significant(100 * step, 2, 1)});
}

function description_of(answer, near) {
    const end = answer.end_of_search;
    return text_of("ranges.description", {
        topples: ranges_text(answer.toppling_pga, end), undecided: ranges_text(answer.undecided_pga, end),
        end: short(end, 4), asked: short(answer.pga, 4), near: short(100 * (near - 1)),
        coarse: answer.coarse_search ? coarse_text(answer.coarse_search) : text_of("ranges.fine"),
        lifts: answer.lifting_pga === null ? (answer.slip ? "" : text_of("behaviour.never_lifts"))
            : text_of("behaviour.lifts_from", {pga: significant(answer.lifting_pga, 3, -1)}),
    });
}

/** A pattern of stripes, with an id that is unique in the page, for "unknown" or "gap"; size: of its unit. */
export function hatch(id, kind, size = 1) {
    return svg("defs", {}, svg("pattern", {id, width: 6, height: 6, patternUnits: "userSpaceOnUse",
        patternTransform: `scale(${size}) rotate(45)`}, svg("rect", {width: 6, height: 6, class: `${kind}_ground`}),
        svg("rect", {width: 2, height: 6, class: `${kind}_line`})));
}

/** The entries of a legend: [class of the swatch, text]. */
export function legend(entries) {
    return element("ul", {class: "legend"}, ...entries.map(([name, text]) =>
        element("li", {}, element("span", {class: `swatch ${name}`}), text)));
}

/** Whether a strength at which the object stands is above one that topples it. */
const is_gap = ({toppling_pga: [lowest]}, pga) => lowest !== undefined && lowest[0] < pga;

function bar(answer, width) {
    const last = last_shown(answer);
    const x = (pga) => SIDE + (width - 2 * SIDE) * Math.min(pga, last) / last;
    const part = (name, first, end) => svg("rect", {class: name, x: x(first), y: TOP, height: BAR,
        width: Math.max(x(end ?? answer.end_of_search) - x(first), name === "not_searched" ? 0 : 1)});
    const lifting = Math.min(answer.lifting_pga ?? Infinity, answer.slip?.moving_pga ?? Infinity);
    const parts = [];
    for (const [first, end] of answer.safe_pga) {
        if (first < lifting) {
            parts.push(part("rests", first, Math.min(end, lifting)));
        }
        if (end > lifting) {
            parts.push(part(is_gap(answer, first) ? "gap" : "rocks", Math.max(first, lifting), end));
        }
    }
    parts.push(...answer.toppling_pga.map(([first, end]) => part("topples", first, end)),
               ...answer.undecided_pga.map(([first, end]) => part("undecided", first, end)));
    if (last > answer.end_of_search) {
        parts.push(part("not_searched", answer.end_of_search, last));
    }
    const ticks = linear_ticks(last, width / 70).flatMap((tick) => [
        svg("line", {class: "tick", x1: x(tick), x2: x(tick), y1: TOP + BAR, y2: TOP + BAR + 5}),
        svg("text", {x: x(tick), y: TOP + BAR + 18, "text-anchor": "middle"}, short(tick, 4))]);
    const mark = (name, pga) => svg("line", {class: name, x1: x(pga), x2: x(pga), y1: TOP - 4, y2: TOP + BAR + 2});
    const marks = [svg("path", {class: "asked", d: `M${x(answer.pga)} ${TOP} l-7 -12 h14 z`}),
                   mark("asked_line", answer.pga)];
    if (answer.lifting_pga !== null && answer.lifting_pga < last) {
        marks.unshift(mark("lifting", answer.lifting_pga));
    }
    return svg("svg", {width, height: HEIGHT, viewBox: `0 0 ${width} ${HEIGHT}`, "aria-hidden": true}, // a text follows
        hatch("hatch_bar", "unknown"), hatch("gap_bar", "gap"), ...parts,
        svg("rect", {class: "frame", x: SIDE, y: TOP, width: width - 2 * SIDE, height: BAR}), ...ticks, ...marks);
}

/** Returns {show(answer of "topple" with a search, ratio of strengths that are near), clear()}. */
export function create_ranges() {
    const place = by_id("bar");
    let answer = null;
    const draw = () => {
        if (answer) {
            place.querySelector("svg").replaceWith(bar(answer, place.clientWidth));
        }
    };
    on_width(place, draw);
    return {
        show(next, near) {
            answer = next;
            const picture = bar(answer, place.clientWidth);
            const entries = ENTRIES.filter((name) => picture.querySelector(`.${name}`)) // what is drawn
                .map((name) => [name, text_of(`ranges.${name}`)]);
            place.replaceChildren(picture,
                element("p", {class: "axis"}, text_of("ranges.axis", {end: short(answer.end_of_search, 4)})),
                legend(entries), element("p", {class: "numbers"}, description_of(answer, near)));
        },
        clear() {
            answer = null;
            place.replaceChildren();
        },
    };
}
