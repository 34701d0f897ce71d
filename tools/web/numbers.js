// Numbers as people write and read them.

/** The number in a text, with a decimal point or comma; NaN if it is none. power: of ten, by which it is multiplied. */
export function parsed(text, power = 0) {
    const trimmed = text.trim().replace(",", ".").replace("−", "-");
    const match = /^([+-]?(?:\d+\.?\d*|\.\d+))(?:e([+-]?\d+))?$/i.exec(trimmed);
    return match ? Number(`${match[1]}e${Number(match[2] ?? 0) + power}`) : NaN;
}

/** The shortest text that is read as the number in `text` times a power of ten. */
export function shifted(text, power) {
    const value = parsed(text, power);
    return Number.isNaN(value) ? text : String(value);
}

const ROUND_OFF = 1e-12; // of the program, relative: 0.39999999999999997 rounded down is 0.4

/** Rounded down (way < 0), up (way > 0) or to the nearest (0), as a text. */
export function rounded(value, decimals, way = 0, round_off = ROUND_OFF) {
    const nearest = Number(value.toFixed(decimals));
    const is_beyond = way * (value - nearest) > round_off * Math.abs(value);
    return (is_beyond ? nearest + way * 10 ** -decimals : nearest).toFixed(decimals);
}

/** With at most so many digits, and without zeros at the end of the decimals. */
export function significant(value, digits, way = 0, round_off = ROUND_OFF) {
    const decimals = value === 0 ? 0 : digits - 1 - Math.floor(Math.log10(Math.abs(value)));
    return String(Number(rounded(value, Math.min(Math.max(decimals, 0), 15), way, round_off)));
}

/** The number of a range that is next to the asked one: the fewest digits, at least three, that are in the range. */
export function inside({first, last, is_above}) {
    for (let digits = 3; digits <= 15; ++digits) {
        const shown = significant(is_above ? first : last, digits, is_above ? 1 : -1, 0);
        if (first <= Number(shown) && Number(shown) <= last) {
            return shown;
        }
    }
    return String(is_above ? first : last);
}

/** Rounded to the nearest. */
export const short = (value, digits = 3) => String(Number(value.toPrecision(digits)));

/** The least of 1, 2, 3 and 5 times a power of ten that is not below a number. */
export function nice_above(value) {
    const power = 10 ** Math.floor(Math.log10(value));
    return Number((power * [1, 2, 3, 5, 10].find((each) => each * power >= value * (1 - 1e-9))).toPrecision(3));
}

/** Ticks of a linear axis from 0 to `last`, about `count` of them. */
export function linear_ticks(last, count) {
    const step = nice_above(last / count);
    return Array.from({length: Math.floor(last / step + 1e-9) + 1}, (_, i) => Number((i * step).toPrecision(6)));
}

/** Ticks of a logarithmic axis: 1, 2 and 5 times powers of ten; more on less than a decade. */
export function logarithmic_ticks(first, last) {
    const factors = last / first < 10 ? [1, 1.5, 2, 3, 4, 5, 7] : [1, 2, 5];
    const ticks = [];
    for (let power = Math.floor(Math.log10(first)); power <= Math.log10(last); ++power) {
        ticks.push(...factors.map((each) => Number(`${each}e${power}`)));
    }
    return ticks.filter((each) => each >= first && each <= last);
}
