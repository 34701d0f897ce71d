// The form: its fields, made from the tables of question.js, and the messages beside them.
import {by_id, element, text_of} from "overturn/elements";
import {texts} from "overturn/texts";
import {CHOICES, NUMBERS, has_two_sides, in_unit} from "overturn/question";

const PLACES = {object: "object", object_more: "object_more", pulse: "pulse_fields", record: "record_fields"};

function unit_text(key, kind, unit) {
    return kind === "length" ? texts.units[unit] : kind === "angle" ? texts.units.angle : texts.units[key] ?? "";
}

function field(key, control, unit = null) {
    const {label, hint} = texts.fields[key];
    control.setAttribute("aria-describedby", `${key}_hint ${key}_error`);
    return element("div", {class: "field", id: `${key}_field`},
        element("label", {for: key}, label),
        element("span", {class: "control"}, control, ...(unit ? [unit] : [])),
        element("small", {class: "hint", id: `${key}_hint`}, hint ?? ""),
        element("span", {class: "error", id: `${key}_error`, role: "alert"}));
}

function radios(name, labels) {
    by_id(name).append(...CHOICES[name].map((value) => element("label", {},
        element("input", {type: "radio", name, value}), " ", labels[value])));
}

function select(key, labels) {
    return element("select", {id: key}, ...CHOICES[key].map((value) => element("option", {value}, labels[value])));
}

/** Makes the form. changed(state) is called with each change by the user. */
export function create_form(changed) {
    let state;
    const units = {};

    for (const {key, group, kind} of NUMBERS) {
        units[key] = element("span", {class: "unit", "data-kind": kind});
        const input = element("input", {id: key, type: "text", inputmode: "decimal"});
        by_id(PLACES[group]).append(field(key, input, units[key]));
    }
    by_id("pulse_more").append(field("pulse", select("pulse", texts.pulses)));
    by_id("direction_field").append(field("direction", select("direction", texts.directions)));
    by_id("record_fields").prepend(field("component", element("select", {id: "component"})));
    radios("unit", {cm: texts.units.cm, m: texts.units.m});
    radios("motion", {pulse: texts.motion.pulse, record: texts.motion.record});

    const controls = [...NUMBERS.map(({key}) => key), "pulse", "direction", "component"];
    const on_input = ({target}) => {
        if (target.name === "unit" && target.value !== state.unit) {
            write(in_unit(state, target.value));
        } else if (target.name === "motion" && target.value !== state.motion) {
            write({...state, motion: target.value});
        } else if (controls.includes(target.id) && target.value !== state[target.id]) {
            state = {...state, [target.id]: target.value};
            show_what_applies();
        } else {
            return;
        }
        changed(state);
    };
    ["input", "change"].forEach((event) => by_id("form").addEventListener(event, on_input)); // some send only one
    by_id("form").addEventListener("submit", (event) => event.preventDefault());

    function show_what_applies() {
        by_id("of_pulse").hidden = state.motion !== "pulse";
        by_id("of_record").hidden = state.motion !== "record";
        by_id("direction_field").hidden = !has_two_sides(state);
        by_id("component_field").hidden = by_id("component").options.length < 2;
        for (const {key, kind} of NUMBERS) {
            units[key].textContent = unit_text(key, kind, state.unit);
        }
    }

    /** Shows a state. Folded parts that differ from the beginning are opened. */
    function write(next) {
        state = next;
        controls.forEach((key) => (by_id(key).value = state[key]));
        for (const name of ["unit", "motion"]) {
            document.querySelector(`input[name=${name}][value=${state[name]}]`).checked = true;
        }
        const is_given = (each) => each.group === "object_more" && state[each.key] !== each.initial;
        by_id("object_details").open ||= NUMBERS.some(is_given);
        by_id("pulse_details").open ||= state.pulse !== CHOICES.pulse[0];
        show_what_applies();
    }

    return {
        write,
        state: () => state,
        /** names: of the components of the record; none while it is not known. In the state, "" is the first one. */
        show_components(names) {
            const options = names.map((name, i) => element("option", {value: i ? name : ""}, name));
            by_id("component").replaceChildren(...options);
            if (names.length && names.indexOf(state.component) < 1) {
                state = {...state, component: ""};
            }
            by_id("component").value = state.component;
            show_what_applies();
        },
        /** errors: keys of messages, by keys of fields. */
        show_errors(errors) {
            for (const key of controls) {
                const is_wrong = errors[key] !== undefined;
                by_id(key).setAttribute("aria-invalid", is_wrong);
                const message = is_wrong ? text_of(`errors.${errors[key]}`) : "";
                if (by_id(`${key}_error`).textContent !== message) {
                    by_id(`${key}_error`).textContent = message;
                }
                if (is_wrong) {
                    by_id(key).closest("details")?.setAttribute("open", "");
                }
            }
        },
    };
}
