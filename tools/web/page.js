// The page: from a change of the question to its answers.
import {joined} from "overturn/directions";
import {create_drawing} from "overturn/drawing";
import {by_id, element, text_of, write_texts} from "overturn/elements";
import {createEngine} from "overturn/engine";
import {create_form} from "overturn/form";
import {create_objects_table} from "overturn/objects_table";
import {in_words} from "overturn/messages";
import {address_of, keys_in, question_of, state_of} from "overturn/question";
import {create_ranges} from "overturn/ranges";
import {create_record} from "overturn/record";
import {create_spectrum} from "overturn/spectrum";
import {texts} from "overturn/texts";
import {near_ratio, verdict_elements} from "overturn/verdict";

const PAUSE = 60; // ms of typing
const LIST_PAUSE = 300;
const MOTION_KEYS = ["pga", "period", "record_pga", "scale"];
const SAMPLES = 600, MOST_SAMPLES = 20000; // of a history

/** The bytes of the program: in the page itself, or its address beside the page. */
async function program() {
    const packed = by_id("overturn_wasm");
    if (!packed) {
        return new URL("overturn.wasm", document.baseURI);
    }
    const bytes = Uint8Array.from(atob(packed.textContent), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Response(stream).arrayBuffer();
}

function start(engine) {
    const sections = ["answer", "ranges", "motion_drawing", "other_motions"].map(by_id);
    const form = create_form(() => changed());
    const ranges = create_ranges();
    const drawing = create_drawing();
    const spectrum = create_spectrum(engine, (values) => {
        form.write({...form.state(), ...values});
        changed();
    });
    const list = create_objects_table(engine, () => changed_list());
    const record = create_record(engine, (name) => {
        spectrum.clear(); // another file may have had this name
        form.write({...form.state(), motion: "record", record: name});
        changed();
    });
    let work = new AbortController();
    let timer = 0, list_timer = 0;

    const set_stale = (section, is_stale) => {
        section.classList.toggle("stale", is_stale);
        section.setAttribute("aria-busy", is_stale);
    };

    function show_no_answer(text) {
        say(text);
        [ranges, drawing, spectrum].forEach((each) => each.clear());
        sections.forEach((section) => {
            section.hidden = section.id !== "answer";
            set_stale(section, false);
        });
    }

    const lacks_record = ({motion, record: name}) => motion === "record" && !record.is_known(name);

    function changed() {
        work.abort();
        work = new AbortController();
        clearTimeout(timer);
        history.replaceState(null, "", address_of(form.state()));
        by_id("copied").textContent = "";
        if (form.state().motion === "record") {
            form.show_components(record.names_of(form.state().record));
            record.show(form.state());
        }
        const {object, motion, errors} = question_of(form.state(), record.names_of(form.state().record));
        form.show_errors(errors);
        if (lacks_record(form.state())) {
            const name = form.state().record;
            show_no_answer(name === "" ? text_of("motion.none") : text_of("motion.missing", {name}));
        } else if (Object.keys(errors).length) {
            show_no_answer(text_of("answer.no_answer"));
        } else {
            sections.forEach((section) => set_stale(section, true));
            timer = setTimeout(() => answer(object, motion, work.signal), PAUSE);
        }
        changed_list();
    }

    function changed_list() {
        clearTimeout(list_timer);
        by_id("table").classList.add("stale");
        list_timer = setTimeout(() => {
            const {motion, errors} = question_of(form.state(), record.names_of(form.state().record));
            const is_usable = !lacks_record(form.state()) && !MOTION_KEYS.some((key) => errors[key]);
            list(is_usable ? motion : null, form.state().unit);
        }, LIST_PAUSE);
    }

    /** The verdict first, then what takes longer. */
    async function answer(object, motion, signal) {
        // Of an object that slides, each restitution takes seconds.
        const question = {question: "topple", ...object, ...motion, other_restitutions: object.friction === undefined};
        const {unit} = form.state();
        const topple = async (search, priority) => {
            const both = joined(await engine.ask({...question, search}, {signal, priority: () => priority}));
            by_id("verdict").replaceChildren(...verdict_elements(both, object, motion, unit));
            return both;
        };
        try {
            const verdict = await topple(false, 0);
            by_id("answer").classList.remove("stale");
            sections.forEach((section) => (section.hidden = false));
            spectrum.show(object, motion, unit, verdict);
            set_stale(by_id("other_motions"), false);
            await Promise.all([
                topple(true, 1).then((answer) => {
                    ranges.show(answer, near_ratio(motion));
                    [by_id("answer"), by_id("ranges")].forEach((section) => set_stale(section, false));
                }),
                engine.ask({question: "history", ...object, ...motion, direction: verdict.direction,
                            samples: samples_of(motion)}, {signal, priority: () => 2}).then((history) => {
                    drawing.show(history, object);
                    set_stale(by_id("motion_drawing"), false);
                }),
            ]);
        } catch (error) {
            if (error.name === "AbortError" || signal.aborted) {
                return;
            }
            work.abort();
            show_no_answer(text_of(error.is_refusal ? "answer.refused" : "answer.failed",
                {message: in_words(error.message, unit)}));
            form.show_errors(Object.fromEntries(keys_in(error.message, form.state()).map((key) => [key, "see_below"])));
        }
    }

    /** As many samples of the motion as the record has, so that the ground is drawn as it moves. */
    function samples_of(motion) {
        return motion.record === undefined ? SAMPLES
            : Math.min(Math.max(2 * record.component(motion.record, motion.component).samples, SAMPLES), MOST_SAMPLES);
    }

    by_id("copy").addEventListener("click", async () => {
        const is_copied = await navigator.clipboard.writeText(location.href).then(() => true, () => false);
        const has_more = form.state().motion === "record" || by_id("cells").value.trim() !== "";
        by_id("copied").textContent = [text_of(is_copied ? "answer.copied" : "answer.not_copied"),
                                       ...(has_more ? [text_of("answer.no_list")] : [])].join(" ");
    });
    const open_address = () => {
        form.write(state_of(location.hash));
        changed();
    };
    addEventListener("hashchange", open_address);
    open_address();
}

const say = (text) => by_id("verdict").replaceChildren(element("p", {class: "sentence none"}, text));

write_texts();
by_id("points").append(...texts.assumptions.points.map((point) => element("li", {}, point)));
say(text_of("answer.computing"));
try {
    const workers = Math.min(Math.max(3, navigator.hardwareConcurrency ?? 3), 8);
    start(await createEngine({module: await program(), workers}));
} catch (error) {
    say(text_of("no_engine", {message: error.message}));
    by_id("answer").removeAttribute("aria-busy");
    throw error;
}
