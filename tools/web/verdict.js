// The answer in words: from the answer of "topple" to sentences that are never more certain than it is.
import {element, text_of} from "overturn/elements";
import {in_words} from "overturn/messages";
import {inside, rounded, short, significant} from "overturn/numbers";

const NO_SLIDE = 0.05; // mm
const LONG_SLIDE = 0.1; // of the width
const MUCH_FRICTION = 1; // few contacts have more

/** The ratio of strengths up to which another verdict is near, under a motion of a question. */
export const near_ratio = ({record}) => (record === undefined ? 1.1 : 1.2);

/** The verdict of an answer of "topple": "safe", "topples" or "undecided". */
export const verdict_of = ({topples}) => (topples === null ? "undecided" : topples ? "topples" : "safe");

/** The nearest strengths of ranges [first, last], one below and one above the asked one, the nearer one first. */
function nearest(ranges, pga) {
    const all = ranges.map(([first, last]) => ({first, last: last ?? Infinity}))
        .filter(({first, last}) => pga < first || last < pga)
        .map((range) => (pga < range.first ? {...range, is_above: true, value: range.first, ratio: range.first / pga}
            : {...range, is_above: false, value: range.last, ratio: pga / range.last}))
        .sort((a, b) => a.ratio - b.ratio);
    return [true, false].map((is_above) => all.find((each) => each.is_above === is_above)).filter((each) => each)
        .sort((a, b) => a.ratio - b.ratio);
}

const is_in = (ranges, pga) => ranges.some(([first, last]) => first <= pga && pga <= (last ?? Infinity));

/** "2 % less", "about twice as strong": of a ratio to the asked strength. */
function how_text(ratio) {
    if (ratio < 1.5) {
        const percent = 100 * Math.abs(ratio - 1);
        return text_of(`verdict.percent_${ratio > 1 ? "more" : "less"}`,
            {percent: percent < 10 ? short(percent, 2) : percent.toFixed(0)});
    }
    const times = Number(rounded(ratio, ratio < 10 ? 1 : 0, -1));
    return times >= 1.9 && times <= 2.1 ? text_of("verdict.twice") : text_of("verdict.times", {times});
}

/** "at 0.881 g, 2.1 % less", or "at 0.881 g (2.1 % less) and at 0.93 g (3.3 % more)": strengths in those ranges. */
function places_text(places, pga) {
    return places.map((place) => {
        const strength = inside(place);
        return text_of(places.length > 1 ? "verdict.place_of_several" : "verdict.place",
            {strength, how: how_text(Number(strength) / pga)});
    }).join(text_of("verdict.between"));
}

/** "at 0.25 g under this pulse (one sine, 0.5 s)": the strength as it was typed. */
function at_text(answer, motion) {
    const {pulse, period, scale} = motion;
    if (scale !== undefined) {
        return text_of(scale === 1 ? "verdict.as_recorded" : "verdict.at_scale",
            {pga: short(answer.pga, 4), scale: short(scale, 12)});
    }
    const name = pulse && text_of(`pulses.${pulse}`).replace(/ \(.*/, "");
    return text_of("verdict.at", {pga: short(motion.pga, 12), motion: pulse
        ? text_of("verdict.pulse", {pulse: name, period: short(period, 12)}) : text_of("verdict.record")});
}

function safe_sentence(answer, at, near) {
    const {pga} = answer;
    const toppling = nearest(answer.toppling_pga, pga);
    const ratio_of_toppling = toppling[0]?.ratio ?? Infinity;
    const unknown = nearest(answer.undecided_pga, pga).filter(({ratio}) => ratio < ratio_of_toppling);
    const sentences = [];
    const is_near = toppling.some(({ratio}) => ratio < near);
    if (is_near) {
        const places = toppling.filter(({ratio}) => ratio < near);
        sentences.push(text_of("verdict.but_would", {at, places: places_text(places, pga)}));
    } else if (toppling.some(({is_above}) => !is_above)) {
        sentences.push(text_of(toppling.length > 1 ? "verdict.but_weaker" : "verdict.but_weaker_only",
            {at, places: places_text(toppling, pga)}));
    } else {
        sentences.push(text_of("verdict.safe", {at}));
        sentences.push(toppling.length ? text_of("verdict.would", {place: places_text(toppling, pga)})
            : text_of("verdict.none", {end: short(answer.end_of_search, 4)}));
    }
    if (answer.slip && (answer.slip.slide_peak_over_size !== 0 || !toppling.length)) {
        sentences.push(text_of("verdict.if_friction", {friction: short(answer.slip.friction, 12)}));
    }
    if (unknown.length) {
        sentences.push(text_of("verdict.near_undecided", {places: places_text(unknown.slice(0, 1), pga)}));
    }
    if (pga >= answer.end_of_search) {
        sentences.push(text_of("verdict.not_searched"));
    }
    return {sentences, is_near: is_near || unknown.some(({ratio}) => ratio < near)};
}

function toppling_sentence(answer, at, near) {
    const {pga} = answer;
    const standing = nearest(answer.safe_pga, pga).filter(({ratio}) => ratio < near);
    const unknown = nearest(answer.undecided_pga, pga).filter(({ratio}) => ratio < near);
    const sentences = [standing.length ? text_of("verdict.but_stands", {at, places: places_text(standing, pga)})
        : text_of("verdict.topples", {at})];
    const [first, last] = answer.safe_pga[0] ?? [Infinity, 0];
    if (first === 0 && last < pga && !standing.some(({value}) => value === last)) {
        const [list, key] = (answer.undecided_pga[0]?.[0] ?? Infinity) < answer.toppling_pga[0][0]
            ? [answer.undecided_pga, "first_undecided"] : [answer.toppling_pga, "first_topples"];
        const lowest = {first: list[0][0], last: list[0][1] ?? Infinity, is_above: true};
        sentences.push(text_of(`verdict.${key}`, {strength: inside(lowest)}));
    }
    return {sentences, is_near: standing.length + unknown.length > 0};
}

/** What other restitutions change for an object that does not topple, or null. */
function other_restitution(answer, near) {
    const {pga} = answer;
    const others = answer.by_restitution.filter((each) => each.restitution !== answer.restitution);
    const shares = (list) => list.map((each) => short(each.restitution_of_maximum)).join(", ");
    for (const [list, word] of [["toppling_pga", "other_topples"], ["undecided_pga", "other_undecided"]]) {
        const worse = others.filter((each) => is_in(each[list], pga));
        if (worse.length) {
            return text_of("verdict.other_restitution", {shares: shares(worse), what: text_of(`verdict.${word}`)});
        }
    }
    const own = nearest(answer.toppling_pga, pga)[0]?.ratio ?? Infinity;
    const nearest_other = others.map((each) => ({each, place: nearest(each.toppling_pga, pga)[0]}))
        .filter(({place}) => place && place.ratio < Math.min(own, near))
        .sort((a, b) => a.place.ratio - b.place.ratio)[0];
    return !nearest_other ? null : text_of("verdict.other_near",
        {share: shares([nearest_other.each]), place: places_text([nearest_other.place], pga)});
}

/** R of the side plus: from the centre of mass to that corner, in metres; slides are given over it. */
function size_of(object) {
    return Math.hypot(object.width / 2 - (object.center_offset ?? 0), object.center_height ?? object.height / 2);
}

/** What the object does, and which friction that needs. */
function behaviour(answer, object, {direction}) {
    const {slip} = answer;
    const texts = [];
    const verdict = verdict_of(answer);
    if (verdict === "topples") {
        texts.push(text_of("behaviour.falls"));
    } else if (answer.peak_of_alpha > 0) {
        texts.push(text_of(answer.peak_of_alpha < 1 ? "behaviour.rocks" : "behaviour.rocks_over",
            {percent: rounded(100 * answer.peak_of_alpha, 0, 1)}));
    } else if (answer.peak_of_alpha === 0) {
        texts.push(text_of(slip?.slide_peak_over_size === 0 ? "behaviour.stays" : "behaviour.rests"));
    }
    if (verdict === "topples") {
        // How far it slides while it falls says nothing of where it ends.
    } else if (slip && slip.slide_over_size === null) {
        texts.push(text_of("behaviour.slide_unknown"));
    } else if (slip && slip.slide_peak_over_size > 0) {
        const millimetres = (over_size) => significant(1000 * size_of(object) * Math.abs(over_size), 2, 1);
        const most = millimetres(slip.slide_peak_over_size), end = millimetres(slip.slide_over_size);
        texts.push(...(most < NO_SLIDE ? [text_of("behaviour.slides_little")]
            : [text_of(end < NO_SLIDE ? "behaviour.slides_back" : "behaviour.slides", {end, most}),
               text_of("behaviour.edge")]));
        const without = slip.topples_without_slip;
        if (without !== null && verdict !== "undecided" && without !== answer.topples) {
            texts.push(text_of(without ? "behaviour.slip_helps" : "behaviour.slip_harms"));
        }
    } else if (slip && answer.peak_of_alpha !== 0) {
        texts.push(text_of("behaviour.no_slip"));
    }
    if (!slip) {
        texts.push(answer.friction_demand === null ? text_of("behaviour.friction_unknown")
            : text_of(answer.friction_demand > MUCH_FRICTION ? "behaviour.much_friction"
                : verdict === "topples" ? "behaviour.friction_to_fall" : "behaviour.friction",
            {friction: rounded(answer.friction_demand, 2, 1)}));
    }
    const down = (pga) => ({pga: significant(pga, 3, -1)});
    if (slip && slip.moving_pga !== null && slip.moving_pga < (answer.lifting_pga ?? Infinity)) {
        const key = slip.stays_flat ? "behaviour.slides_from_flat" : "behaviour.slides_from";
        texts.push(text_of(key, down(slip.moving_pga)));
    }
    if (answer.lifting_pga !== null) {
        // Of one direction of two, the other one may lift it at less.
        texts.push(text_of(slip || direction !== undefined ? "behaviour.lifts_from" : "behaviour.not_lifted_below",
            down(answer.lifting_pga)));
    } else if (!slip) {
        texts.push(text_of("behaviour.never_lifts"));
    }
    if (answer.by_direction.length > 1) {
        texts.push(text_of("behaviour.direction", {direction: text_of(`directions.${answer.direction}`)}));
    }
    return texts;
}

/** What follows from the ranges; without a search, only the verdict. */
function sentences_of(answer, motion) {
    const verdict = verdict_of(answer);
    const at = at_text(answer, motion);
    if (answer.end_of_search === null) {
        const searching = text_of(answer.slip ? "answer.searching_long" : "answer.searching");
        return {sentences: [text_of(`verdict.${verdict}`, {at}), searching], is_near: false};
    }
    const near = near_ratio(motion);
    const {sentences, is_near} = verdict === "safe" ? safe_sentence(answer, at, near)
        : verdict === "topples" ? toppling_sentence(answer, at, near)
            : {sentences: [text_of("verdict.undecided", {at})], is_near: false};
    const other = verdict === "safe" ? other_restitution(answer, near) : null;
    if (other) {
        sentences.push(other);
    }
    if (answer.narrower_ranges_exist) {
        sentences.push(text_of("verdict.narrower"));
    }
    return {sentences, is_near: is_near || other !== null};
}

/** The elements of an answer of "topple", with or without a search. */
export function verdict_elements(answer, object, motion, unit) {
    const {sentences: [first, ...others], is_near} = sentences_of(answer, motion);
    const verdict = verdict_of(answer);
    const warnings = answer.warnings.map((each) => text_of("behaviour.warning", {warning: in_words(each, unit)}));
    const slide = answer.slip?.slide_peak_over_size ?? 0; // over R
    const doubts = [...(answer.lifts_off && !answer.slip ? [text_of("verdict.lifts_off")]
        : !answer.slip && answer.friction_demand > MUCH_FRICTION ? [text_of("verdict.will_slide")] : []),
                    ...(slide * size_of(object) > LONG_SLIDE * object.width && verdict !== "topples"
                        ? [text_of("verdict.room", {most: significant(1000 * slide * size_of(object), 2, 1)})] : [])];
    others.unshift(...doubts);
    const is_doubtful = doubts.length + warnings.length > 0;
    return [
        ...(warnings.length ? [element("p", {class: "warning"}, warnings.join(" "))] : []),
        element("p", {class: `sentence ${verdict}`, "data-verdict": verdict, "data-near": is_near || is_doubtful},
            ...(is_near ? [element("strong", {class: "near"}, text_of("answer.near")), " "] : []),
            element("span", {class: "verdict"}, first), ...others.map((each) => ` ${each}`)),
        element("p", {class: "behaviour"}, behaviour(answer, object, motion).join(" ")),
    ];
}
