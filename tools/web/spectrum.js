// The verdicts under motions near the asked one: a plane of strengths against periods, or widths under a record. It is
// computed coarsely first, then in tiles; what is not computed yet is hatched, never drawn as safe.
import {by_id, element, on_width, svg, text_of} from "overturn/elements";
import {in_words} from "overturn/messages";
import {linear_ticks, logarithmic_ticks, nice_above, short, shifted} from "overturn/numbers";
import {power_of} from "overturn/question";
import {hatch, legend} from "overturn/ranges";

const POINTS = 128, TILE = 32, COARSE = 16; // of each axis
const TOO_HIGH = 2.5; // an axis of strengths, beside that which the question would get
const NAMES = {r: "rests", s: "rocks", g: "gap", t: "topples", u: "undecided"};
const KEYS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
const MARGIN = {left: 52, right: 12, top: 10, bottom: 44};

/** The middles of `count` equal parts of an axis. */
const middles = (axis, count) => Array.from({length: count}, (_, i) => axis.value((i + 0.5) / count));

/** An axis: value(share of its length), and share(value). */
function logarithmic(first, last) {
    return {first, last, value: (share) => first * (last / first) ** share,
            share: (value) => Math.log(value / first) / Math.log(last / first)};
}

function linear(last) {
    return {first: 0, last, value: (share) => last * share, share: (value) => value / last};
}

/** The axes around a question. pga: of the question and of the first lift [g]. */
function axes_around(object, motion, pga, lifting_pga) {
    const x = motion.record !== undefined ? logarithmic(object.width / 2, object.width * 2)
        : logarithmic(Math.min(0.1, motion.period / 1.5), Math.max(3, 1.5 * motion.period));
    return {x, y: linear(nice_above(Math.max(1.3 * pga, 4 * (lifting_pga ?? 0.5))))};
}

const is_inside = ({x, y}, [value, pga]) => x.first < value && value < x.last && 0 < pga && pga < y.last;

/** The path of all points with a letter, in units of points, as runs along rows; the first row is at the bottom. */
function path_of(letters, letter, count) {
    let path = "";
    for (let row = 0; row < count; ++row) {
        for (let first = 0; first < count; ++first) {
            let end = first;
            while (end < count && letters[row * count + end] === letter) {
                ++end;
            }
            if (end > first) {
                path += `M${first} ${count - 1 - row}h${end - first}v1h${first - end}z`;
                first = end;
            }
        }
    }
    return path;
}

/** Letters in which points that stand are "g" if a weaker motion of their column topples the object. */
function with_gaps(letters, count) {
    const topples = new Array(count).fill(false);
    return Array.from(letters, (letter, i) => {
        topples[i % count] ||= letter === "t";
        return topples[i % count] && (letter === "r" || letter === "s") ? "g" : letter;
    });
}

/** Returns {show, clear}. moved(values of the form) is called when the user moves the point. */
export function create_spectrum(engine, moved) {
    const place = by_id("spectrum");
    let plane = null, point = null;

    /** Asks for a part of the plane: `count` points along each axis, `size` of them from `column` and `row` on. */
    async function ask({question, axes, x_quantity, work}, count, column, row, size, priority) {
        const answer = await engine.ask({...question, question: "spectrum",
            x: {quantity: x_quantity, values: middles(axes.x, count).slice(column, column + size)},
            pga: middles(axes.y, count).slice(row, row + size)}, {signal: work.signal, priority});
        return answer.verdicts;
    }

    /** Asks for all parts; what is refused, such as widths that no object can have, stays without a verdict. */
    function compute() {
        const mine = plane;
        const starts = Array.from({length: POINTS / TILE}, (_, i) => i * TILE);
        const coarse = async () => {
            mine.coarse = [...await ask(mine, COARSE, 0, 0, COARSE, () => 20)];
        };
        const tile = async (column, row) => {
            const distance = () => Math.hypot(column + TILE / 2 - POINTS * mine.axes.x.share(point[0]),
                                              row + TILE / 2 - POINTS * mine.axes.y.share(point[1]));
            const verdicts = await ask(mine, POINTS, column, row, TILE, () => 30 + distance());
            for (let i = 0; i < TILE; ++i) {
                for (let j = 0; j < TILE; ++j) {
                    mine.fine[(row + i) * POINTS + column + j] = verdicts[i * TILE + j];
                }
            }
        };
        for (const part of [coarse(), ...starts.flatMap((row) => starts.map((column) => tile(column, row)))]) {
            part.then(draw, (error) => {
                if (error.name !== "AbortError" && mine === plane) {
                    const {is_refusal, message} = error;
                    mine.failure = text_of(is_refusal ? "spectrum.refused" : "answer.failed",
                        {message: in_words(message, mine.unit)});
                    draw();
                }
            });
        }
    }

    const x_text = (value, unit) => text_of(`spectrum.${plane.is_record ? "width" : "period"}_value`,
        {x: plane.is_record ? short(Number(shifted(String(value), -power_of(unit)))) : short(value), unit});

    /** The verdict at the place of the point, in words. */
    function verdict_at([value, pga]) {
        const index = (axis, at) => Math.min(Math.floor(POINTS * axis.share(at)), POINTS - 1);
        const letter = with_gaps(plane.fine, POINTS)[index(plane.axes.y, pga) * POINTS + index(plane.axes.x, value)];
        return text_of(`spectrum.${letter ?? "unknown"}`);
    }

    function move(value, pga) {
        const {x, y} = plane.axes;
        const within = (number, first, last) => Math.min(Math.max(number, first), last);
        const next = [short(within(value, x.first, x.last)), short(within(pga, y.last / 1000, y.last))];
        moved(plane.is_record ? {width: shifted(next[0], -power_of(plane.unit)), record_pga: next[1], scale: ""}
            : {period: next[0], pga: next[1]});
    }

    function on_key(event) {
        const [dx, dy] = KEYS[event.key] ?? [0, 0];
        if (dx || dy) {
            event.preventDefault();
            const {x, y} = plane.axes, step = (event.shiftKey ? 10 : 1) / 100;
            move(dx ? x.value(x.share(point[0]) + dx * step) : point[0], dy ? point[1] + dy * step * y.last : point[1]);
        }
    }

    /** The frame with axes and the point, which stays while tiles arrive. */
    function draw_frame(width) {
        const size = {x: width - MARGIN.left - MARGIN.right, y: Math.round(Math.min(0.7 * width, 420))};
        const {x, y} = plane.axes;
        const at = (share_x, share_y) => [MARGIN.left + size.x * share_x, MARGIN.top + size.y * (1 - share_y)];
        const [px, py] = at(x.share(point[0]), y.share(point[1]));
        const bottom = MARGIN.top + size.y;
        const unit = plane.is_record ? 10 ** power_of(plane.unit) : 1; // of the axis x
        const ticks_x = logarithmic_ticks(x.first / unit, x.last / unit).map((tick) => [tick * unit, tick]);
        const map = svg("svg", {class: "map", x: MARGIN.left, y: MARGIN.top, width: size.x, height: size.y,
            viewBox: `0 0 ${POINTS} ${POINTS}`, preserveAspectRatio: "none"});
        const handle = svg("g", {class: "handle", id: "point", tabindex: 0, role: "slider", keydown: on_key,
            transform: `translate(${px} ${py})`},
            svg("circle", {class: "outer", r: 9}), svg("circle", {class: "inner", r: 4}));
        const height = bottom + MARGIN.bottom;
        const picture = svg("svg", {width, height, viewBox: `0 0 ${width} ${height}`, class: "spectrum"},
            hatch("hatch_spectrum", "unknown"), hatch("gap_spectrum", "gap", POINTS / size.x),
            svg("rect", {class: "not_computed", x: MARGIN.left, y: MARGIN.top, width: size.x, height: size.y}), map,
            svg("rect", {class: "frame", x: MARGIN.left, y: MARGIN.top, width: size.x, height: size.y}),
            ...ticks_x.flatMap(([value, label]) => {
                const [tick] = at(x.share(value), 0);
                return [svg("line", {class: "tick", x1: tick, x2: tick, y1: bottom, y2: bottom + 5}),
                        svg("text", {x: tick, y: bottom + 18, "text-anchor": "middle"}, short(label))];
            }),
            ...linear_ticks(y.last, 6).flatMap((tick) => {
                const [, place_y] = at(0, y.share(tick));
                return [svg("line", {class: "tick", x1: MARGIN.left - 5, x2: MARGIN.left, y1: place_y, y2: place_y}),
                        svg("text", {x: MARGIN.left - 8, y: place_y + 4, "text-anchor": "end"}, short(tick))];
            }),
            svg("text", {class: "title", x: MARGIN.left + size.x / 2, y: bottom + 38, "text-anchor": "middle"},
                text_of(plane.is_record ? "spectrum.width" : "spectrum.period", {unit: plane.unit})),
            svg("text", {class: "title", transform: `translate(13 ${MARGIN.top + size.y / 2}) rotate(-90)`,
                "text-anchor": "middle"}, text_of("spectrum.pga")), handle);
        picture.addEventListener("click", (event) => {
            const frame = picture.getBoundingClientRect();
            const share_x = (event.clientX - frame.left - MARGIN.left) / size.x;
            const share_y = 1 - (event.clientY - frame.top - MARGIN.top) / size.y;
            if (0 <= share_x && share_x <= 1 && 0 <= share_y && share_y <= 1) {
                move(x.value(share_x), y.value(share_y));
            }
        });
        const had_focus = document.activeElement?.id === "point";
        place.replaceChildren(picture, element("div", {id: "spectrum_legend"}),
            element("p", {class: "hint"}, [text_of(`spectrum.help${plane.is_record ? "_record" : ""}`),
                ...(plane.has_directions ? [text_of("spectrum.direction")] : [])].join(" ")));
        if (had_focus) {
            handle.focus();
        }
        draw();
    }

    /** What is computed so far. */
    function draw() {
        const map = place.querySelector(".map");
        if (!plane || !map) {
            return;
        }
        const computed = plane.fine.filter((letter) => letter).length;
        const is_complete = computed === POINTS ** 2;
        const letters = Object.entries(NAMES);
        const paths = (list, count, name) => letters.map(([letter, each]) => svg("path", {class: `${each} ${name}`,
            d: path_of(list, letter, count), transform: `scale(${POINTS / count})`}));
        const fine = with_gaps(plane.fine, POINTS);
        const coarse = plane.coarse && !is_complete ? [...paths(with_gaps(plane.coarse, COARSE), COARSE, "coarse"),
            svg("rect", {class: "over_coarse", width: POINTS, height: POINTS})] : [];
        map.replaceChildren(...coarse, ...paths(fine, POINTS, "fine"));
        const handle = by_id("point");
        const values = {x: x_text(point[0], plane.unit), pga: short(point[1]), verdict: verdict_at(point)};
        handle.setAttribute("aria-label", text_of("spectrum.label", values));
        handle.setAttribute("aria-valuenow", values.pga);
        handle.setAttribute("aria-valuemin", 0);
        handle.setAttribute("aria-valuemax", plane.axes.y.last);
        handle.setAttribute("aria-valuetext", text_of("spectrum.value", values));
        place.dataset.computed = Math.floor(100 * computed / POINTS ** 2);
        const unfinished = is_complete ? [] : [["coarse_swatch", text_of("spectrum.coarse")],
                                              ["not_computed", text_of("spectrum.not_computed")]];
        by_id("spectrum_legend").replaceChildren(
            legend([...letters.filter(([letter]) => fine.includes(letter))
                .map(([letter, name]) => [name, text_of(`spectrum.${letter}`)]), ...unfinished,
                    ["point", text_of("spectrum.point")]]),
            ...(plane.failure ? [element("p", {class: "error"}, plane.failure)]
                : is_complete ? [] : [element("p", {class: "hint"},
                    text_of("spectrum.computing", {percent: place.dataset.computed}))]));
    }

    on_width(place, (width) => plane && draw_frame(width));

    function clear() {
        plane?.work.abort();
        plane = null;
        place.replaceChildren();
        delete place.dataset.computed;
    }

    return {
        clear,
        /** answer: that of "topple" to the question. What is computed is kept if only the point moves. */
        show(object, motion, unit, answer) {
            const is_record = motion.record !== undefined;
            const {width, ...same_object} = object;
            const {pga, scale, period, ...same_motion} = motion;
            const question = {...same_object, ...same_motion, ...(is_record ? {} : {width})};
            by_id("spectrum_heading").textContent = text_of(is_record ? "spectrum.heading_record" : "spectrum.heading");
            point = [is_record ? width : period, answer.pga];
            const key = JSON.stringify(question);
            const axes = axes_around(object, motion, answer.pga, answer.lifting_pga);
            if (plane?.key !== key || !is_inside(plane.axes, point) || plane.axes.y.last > TOO_HIGH * axes.y.last) {
                plane?.work.abort();
                plane = {key, question, is_record, x_quantity: is_record ? "width" : "pulse_period",
                         axes, work: new AbortController(), coarse: null, fine: new Array(POINTS ** 2)};
                compute();
            }
            Object.assign(plane, {unit, has_directions: answer.by_direction.length > 1});
            draw_frame(place.clientWidth);
        },
    };
}
