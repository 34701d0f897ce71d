// What is asked: state (texts as typed) <-> address of the page; state -> question to the program in SI units.
import {parsed, shifted} from "overturn/numbers";

const LENGTH = "length", ANGLE = "angle", NUMBER = "number";

/**
 * The numbers of the form. quantity: the member of the question; initial: the text at the beginning; is_positive: other
 * numbers are refused; most: the largest one; is_needed: unless the motion is the other one.
 */
export const NUMBERS = [
    {key: "width", group: "object", kind: LENGTH, initial: "18", is_positive: true, is_needed: true},
    {key: "height", group: "object", kind: LENGTH, initial: "45", is_positive: true, is_needed: true},
    {key: "lean", group: "object_more", kind: ANGLE, quantity: "incline"},
    {key: "center_height", group: "object_more", kind: LENGTH, is_positive: true},
    {key: "center_offset", group: "object_more", kind: LENGTH},
    {key: "friction", group: "object_more", kind: NUMBER, is_positive: true},
    {key: "restitution", group: "object_more", kind: NUMBER, quantity: "restitution_of_maximum", is_positive: true,
     most: 1},
    {key: "pga", group: "pulse", kind: NUMBER, initial: "0.25", is_positive: true, is_needed: true},
    {key: "period", group: "pulse", kind: NUMBER, initial: "0.5", is_positive: true, is_needed: true},
    {key: "record_pga", group: "record", kind: NUMBER, quantity: "pga", is_positive: true},
    {key: "scale", group: "record", kind: NUMBER, is_positive: true},
].map((each) => ({quantity: each.key, initial: "", ...each}));

/** What is chosen from a list; the first value is the initial one. */
export const CHOICES = {
    unit: ["cm", "m"],
    motion: ["pulse", "record"],
    direction: ["both", "0", "180"],
    pulse: ["one_sine", "one_cosine", "half_sine", "rectangular", "triangular", "symmetric_ricker",
            "antisymmetric_ricker"],
};

/** Keys of the form that describe only one kind of motion. */
const KEYS_OF = {pulse: ["pga", "period", "pulse"], record: ["record", "component", "record_pga", "scale"]};

export function initial_state() {
    return {
        ...Object.fromEntries(NUMBERS.map(({key, initial}) => [key, initial])),
        ...Object.fromEntries(Object.entries(CHOICES).map(([key, values]) => [key, values[0]])),
        record: "", component: "",
    };
}

/** State in the address, such as "#width=18&height=45&unit=cm&pga=0.25&period=0.5". */
export function address_of(state) {
    const start = initial_state();
    const always = ["width", "height", "unit", ...(state.motion === "pulse" ? ["pga", "period"] : ["record"])];
    const other = KEYS_OF[state.motion === "pulse" ? "record" : "pulse"];
    const keys = [...new Set([...always, ...Object.keys(start)])].filter(
        (key) => key !== "motion" && !other.includes(key) && (always.includes(key) || state[key] !== start[key]));
    return "#" + new URLSearchParams(keys.map((key) => [name_of(key), with_point(key, state[key])]));
}

const name_of = (key) => (key === "record_pga" ? "pga" : key); // in the address

const with_point = (key, text) => (NUMBERS.some((each) => each.key === key) ? text.trim().replace(",", ".") : text);

export function state_of(address) {
    const given = new URLSearchParams(address.replace(/^#/, ""));
    const state = initial_state();
    state.motion = given.has("record") ? "record" : "pulse";
    for (const key of Object.keys(state).filter((each) => each !== "motion" && is_of_motion(state, each))) {
        const text = given.get(name_of(key));
        if (text !== null && (!CHOICES[key] || CHOICES[key].includes(text))) {
            state[key] = text;
        }
    }
    return state;
}

/** State with lengths in another unit, which are the same lengths. */
export function in_unit(state, unit) {
    const power = unit === state.unit ? 0 : unit === "m" ? -2 : 2;
    const lengths = NUMBERS.filter(({key, kind}) => kind === LENGTH && state[key].trim() !== "");
    return {...state, unit, ...Object.fromEntries(lengths.map(({key}) => [key, shifted(state[key], power)]))};
}

export const is_of_motion = (state, key) => !KEYS_OF[state.motion === "pulse" ? "record" : "pulse"].includes(key);

/** Whether the two sides of the object differ, so that the direction of the motion matters. */
export const has_two_sides = (state) => ["lean", "center_offset"].some((key) => (parsed(state[key]) || 0) !== 0);

/** The power of ten that makes metres of the lengths of the form. */
export const power_of = (unit) => (unit === "cm" ? -2 : 0);

/**
 * components: the names of those of the record. Returns {object, motion, errors}: the members of the question about
 * the object and the motion, and for keys whose texts are not usable, the key of a message.
 */
export function question_of(state, components = []) {
    const object = {}, motion = {}, errors = {};
    for (const {key, group, kind, quantity, is_positive, most, is_needed} of NUMBERS) {
        if (!is_of_motion(state, key)) {
            continue;
        }
        if (state[key].trim() === "") {
            if (is_needed) {
                errors[key] = "needed";
            }
            continue;
        }
        const value = parsed(state[key], kind === LENGTH ? power_of(state.unit) : 0);
        if (Number.isNaN(value)) {
            errors[key] = "number";
        } else if (is_positive && value <= 0) {
            errors[key] = "positive";
        } else if (value > most) {
            errors[key] = "most";
        } else {
            (group.startsWith("object") ? object : motion)[quantity] = kind === ANGLE ? value * Math.PI / 180 : value;
        }
    }
    if (has_two_sides(state) && state.direction !== "both") {
        motion.direction = Number(state.direction);
    }
    if (state.motion === "pulse") {
        motion.pulse = state.pulse;
    } else {
        motion.record = state.record;
        if (state.component !== "") {
            motion.component = components.indexOf(state.component) + 1; // names may be numbers
        }
        if (motion.pga !== undefined && motion.scale !== undefined) {
            errors.scale = "one_strength";
        }
        if (motion.pga === undefined) {
            motion.scale ??= 1;
        }
    }
    return {object, motion, errors};
}

/** The keys of the form whose quantities a message of the program names. */
export function keys_in(message, state) {
    return NUMBERS.filter(({key, quantity}) => is_of_motion(state, key) && state[key].trim() !== "" &&
                                               new RegExp(`(^|[^a-z_])${quantity}[^a-z_]`).test(message))
        .map(({key}) => key);
}
