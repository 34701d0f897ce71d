// The object, drawn to scale, as it moves. The motion is that of the program; here it is only played.
import {by_id, element, svg, text_of} from "overturn/elements";
import {rounded, short} from "overturn/numbers";

const DEGREES = 180 / Math.PI;
const GRAVITY = 9.81; // of the program
const MEMORY = 1; // s
const LEAD = 0.5; // s that are shown before the object moves

/**
 * The displacement of the ground [m] from its acceleration [g], by the trapezoidal rule, in the frame in which the
 * ground rests in the end. memory [s]: how long motions are remembered; a finite one leaves out what is slower.
 */
function displacement_of({time, ground}, memory) {
    const integral = (values) => {
        const sums = [0];
        for (let i = 1; i < time.length; ++i) {
            const step = time[i] - time[i - 1];
            sums.push(sums[i - 1] * Math.exp(-step / memory) + step * (values[i] + values[i - 1]) / 2);
        }
        return sums;
    };
    const from_end = (values) => (memory === Infinity ? values.map((each) => each - values.at(-1)) : values);
    return from_end(integral(from_end(integral(ground.map((each) => GRAVITY * each)))));
}

const reach_of = (values) => values.reduce((most, each) => Math.max(most, Math.abs(each)), 0);

/** Where the corners of the object are [m], at a tilt [rad] and a slide [m] along its base; y points upwards. */
function corners_at(object, angle, slide) {
    const half = object.width / 2, pivot = angle >= 0 ? half : -half;
    const lean = object.incline ?? 0;
    const turned = (x, y, by) => [x * Math.cos(by) + y * Math.sin(by), y * Math.cos(by) - x * Math.sin(by)];
    return [[-half, 0], [half, 0], [half, object.height], [-half, object.height]].map(([x, y]) => {
        const [u, v] = turned(x - pivot, y, angle);
        return turned(u + pivot + slide, v, lean);
    });
}

/** The place of `at` between sorted times: [index, share of the way to the next one]. */
function place_in(time, at) {
    let low = 0, high = time.length - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        [low, high] = time[middle] <= at ? [middle, high] : [low, middle];
    }
    const step = time[high] - time[low];
    return [low, step > 0 ? Math.min(Math.max((at - time[low]) / step, 0), 1) : 1];
}

/** What is drawn of a history: the values at a time, and the box [m] that contains all of it. */
function prepared(history, object) {
    // A larger motion of the ground would leave no place for the object.
    const exact = displacement_of(history, Infinity);
    const is_exact = reach_of(exact) <= object.height;
    const ground = is_exact ? exact : displacement_of(history, MEMORY);
    const factor = Math.min(1, object.height / reach_of(ground));
    const slide = history.slide ?? history.time.map(() => 0);
    const first = history.time.findIndex((_, i) => history.angle[i] !== 0 || slide[i] !== 0);
    const largest = history.angle.reduce((most, each, i) =>
        (Math.abs(each) > Math.abs(history.angle[most]) ? i : most), 0);
    const box = {left: Infinity, right: -Infinity, top: 0};
    for (let i = 0; i < history.time.length; ++i) {
        for (const [x, y] of corners_at(object, history.angle[i], slide[i])) {
            box.left = Math.min(box.left, x + factor * ground[i]);
            box.right = Math.max(box.right, x + factor * ground[i]);
            box.top = Math.max(box.top, y);
        }
    }
    const at = (list, [i, share]) => list[i] + share * ((list[i + 1] ?? list[i]) - list[i]);
    return {
        box, factor, is_exact, begin: Math.max(0, (history.time[first] ?? 0) - LEAD),
        largest: history.time[largest],
        at(time) {
            const place = place_in(history.time, time);
            return {angle: at(history.angle, place), slide: at(slide, place), ground: factor * at(ground, place)};
        },
    };
}

/** Returns {show(history, object), clear()}. */
export function create_drawing() {
    const place = by_id("drawing");
    let stop = () => {};

    function show(history, object) {
        stop();
        const motion = prepared(history, object);
        const end = history.time.at(-1);
        const {box} = motion;
        const width = box.right - box.left;
        const margin = 0.08 * Math.max(width, box.top);
        const depth = 2 * margin + Math.abs(Math.sin(object.incline ?? 0)) * width / 2;
        const unit = (width + 2 * margin) / 400; // of lines
        const lean = (object.incline ?? 0) * DEGREES;
        const wide = 4 * (width + object.height);
        const block = svg("g", {}, svg("rect", {class: "object", x: -object.width / 2, y: -object.height,
            width: object.width, height: object.height}),
            svg("circle", {class: "centre", cx: object.center_offset ?? 0,
                cy: -(object.center_height ?? object.height / 2), r: 3 * unit}));
        const soil = svg("rect", {class: "ground", x: -wide, y: 0, width: 2 * wide, height: wide});
        const stones = Array.from({length: 161}, (_, i) => svg("line", {class: "stone", x1: (i - 80) * wide / 160,
            x2: (i - 80) * wide / 160, y1: 0.2 * margin, y2: 0.8 * margin}));
        const ground = svg("g", {}, soil, ...stones, block);
        const picture = svg("svg", {class: "motion", role: "img", "aria-label": text_of("drawing.label"),
            viewBox: `${box.left - margin} ${-box.top - margin} ${width + 2 * margin} ${box.top + margin + depth}`,
            "stroke-width": unit}, ground);

        const slider = element("input", {type: "range", min: 0, max: 1000, value: 0,
            "aria-label": text_of("drawing.time"), input: () => {
                pause();
                draw(end * slider.value / 1000);
            }});
        const button = element("button", {type: "button", click: () => (is_playing ? pause() : play())},
            text_of("drawing.play"));
        const slow = element("input", {type: "checkbox"});
        const label = element("output", {class: "time"});
        let now = 0, is_playing = false, request = 0;

        function draw(time) {
            now = Math.min(time, end);
            const {angle, slide, ground: moved} = motion.at(now);
            const pivot = (angle >= 0 ? 1 : -1) * object.width / 2;
            ground.setAttribute("transform", `translate(${moved} 0) rotate(${lean})`);
            block.setAttribute("transform", `translate(${slide} 0) rotate(${angle * DEGREES} ${pivot} 0)`);
            const text = text_of("drawing.time_value", {time: now.toFixed(2), angle: rounded(angle * DEGREES, 1)});
            label.textContent = text;
            slider.value = end > 0 ? 1000 * now / end : 0;
            slider.setAttribute("aria-valuetext", text);
            picture.dataset.angle = angle;
        }
        function play() {
            is_playing = true;
            button.textContent = text_of("drawing.pause");
            if (now >= end) {
                now = motion.begin;
            }
            let before = null;
            const frame = (moment) => {
                draw(now + (before === null ? 0 : (moment - before) / (slow.checked ? 4000 : 1000)));
                before = moment;
                if (now >= end) {
                    pause();
                } else {
                    request = requestAnimationFrame(frame);
                }
            };
            request = requestAnimationFrame(frame);
        }
        function pause() {
            is_playing = false;
            cancelAnimationFrame(request);
            button.textContent = text_of("drawing.play");
        }
        stop = pause;

        const notes = [text_of(motion.is_exact ? "drawing.frame" : "drawing.slow_parts")];
        if (motion.factor < 1) {
            notes.push(text_of("drawing.reduced", {factor: short(1 / motion.factor, 2)}));
        }
        if (history.is_shortened) {
            notes.push(text_of("drawing.shortened"));
        }
        if (!history.is_curve_certain) {
            notes.push(text_of("drawing.uncertain"));
        }
        place.replaceChildren(picture, element("div", {class: "player"}, button, slider,
            element("label", {}, slow, " ", text_of("drawing.slow")), label),
            element("p", {class: "hint"}, notes.join(" ")));
        draw(motion.largest); // what matters is seen without playing
        now = motion.begin;
    }

    return {
        show,
        clear() {
            stop();
            place.replaceChildren();
        },
    };
}
