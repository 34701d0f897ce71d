// Records of earthquakes: files that are chosen or dropped.
import {by_id, text_of} from "overturn/elements";
import {significant} from "overturn/numbers";

/** Handles files of records. chosen(name) is called when the program has read one, or could not. */
export function create_record(engine, chosen) {
    const known = new Map(); // names to components
    const failures = new Map(); // names to messages
    const say = (text, is_error = false) => {
        by_id("record_state").textContent = text;
        by_id("record_state").classList.toggle("error", is_error);
    };

    async function read(file) {
        say(text_of("motion.reading", {name: file.name}));
        known.delete(file.name);
        failures.delete(file.name);
        try {
            engine.addFile(file.name, new Uint8Array(await file.arrayBuffer()));
            const {components} = await engine.ask({question: "record", record: file.name});
            known.set(file.name, components);
        } catch (error) {
            const {is_refusal, message} = error;
            failures.set(file.name, text_of(is_refusal ? "motion.refused" : "answer.failed", {message}));
        }
        chosen(file.name);
    }

    by_id("file").addEventListener("change", ({target}) => {
        if (target.files.length) {
            read(target.files[0]);
            target.value = ""; // so that the same file can be chosen again
        }
    });
    const set_dropping = (is_dropping) => document.body.classList.toggle("dropping", is_dropping);
    addEventListener("dragover", (event) => {
        event.preventDefault();
        set_dropping(true);
    });
    addEventListener("dragleave", () => set_dropping(false));
    addEventListener("drop", (event) => {
        event.preventDefault();
        set_dropping(false);
        if (event.dataTransfer.files.length) {
            read(event.dataTransfer.files[0]);
        }
    });

    return {
        names_of: (name) => known.get(name)?.map((each) => each.name) ?? [],
        component: (name, component) => {
            const components = known.get(name);
            return components.find((each, i) => each.name === component || i + 1 === component) ?? components[0];
        },
        is_known: (name) => known.has(name),
        /** Says which record is in use, or which one is missing. */
        show({record, component}) {
            if (record === "") {
                say(text_of("motion.none"));
            } else if (!known.has(record)) {
                say(failures.get(record) ?? text_of("motion.missing", {name: record}), true);
            } else {
                const {name, pga, duration, samples, remarks} = this.component(record, component);
                const text = text_of(name === "" ? "motion.loaded_one" : "motion.loaded", {name: record, samples,
                    component: name, pga: significant(pga, 3), duration: significant(duration, 4)});
                say([text, ...remarks].join(" "));
            }
        },
    };
}
