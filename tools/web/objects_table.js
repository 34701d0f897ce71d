// A list of objects, pasted from a spreadsheet: the table of "assess".
import {by_id, element, text_of} from "overturn/elements";
import {in_words} from "overturn/messages";
import {rounded, short, significant} from "overturn/numbers";
import {texts} from "overturn/texts";
import {near_ratio} from "overturn/verdict";

const LENGTHS = ["width", "height", "half_width", "half_height", "center_height", "center_offset", "radius_of_gyration",
                 "size"];
const ANGLES = ["incline", "lean", "lean_deg", "lean_degrees", "incline_degrees"]; // the program has incline_deg

/** The cells of the first line, and the separator: a tab, else a semicolon, else a comma. */
function split(line) {
    const separator = ["\t", ";"].find((each) => line.includes(each)) ?? ",";
    return [line.split(separator), separator];
}

/** The name of a column for the program: "Width (cm)" is width_cm; lengths and angles without a unit get one. */
function column_name(cell, unit) {
    const name = cell.trim().replace(/^"(.*)"$/, "$1").toLowerCase()
        .replace(/\s*[([]\s*(\w+)\s*[)\]]$/, "_$1").replace(/centre/, "center").replace(/\s+/g, "_");
    return LENGTHS.includes(name) && unit !== "m" ? `${name}_${unit}` : ANGLES.includes(name) ? "incline_deg" : name;
}

/** The pasted cells: a header for the program, and rows with their lines. Cells that lack at the end are empty. */
function parts_of(cells, unit) {
    const lines = cells.trimEnd().split(/\r?\n/).map((text, i) => ({text, line: i + 1}));
    const [header, ...rows] = lines.filter(({text}) => text.trim() !== "");
    const [names, separator] = split(header.text);
    return {
        header: names.map((name) => column_name(name, unit)).join(separator),
        rows: rows.map(({text, line}) => {
            const given = text.split(separator);
            const missing = text.includes('"') ? 0 : Math.max(names.length - given.length, 0);
            return {line, title: given[0].trim(), text: text + separator.repeat(missing)};
        }),
    };
}

const table_of = (header, rows) => [header, ...rows.map(({text}) => text)].join("\n") + "\n";

/** The index of the row that a message names, such as "objects:3:2: ..."; -1 for none. The header is line 1. */
const row_named = (message) => Number(/^objects:(\d+):/.exec(message)?.[1] ?? 1) - 2;

/** The answer about the rows that ask(table) does not refuse, null if none is left, and the others with messages. */
async function answer_without_refused({header, rows}, ask) {
    const refused = [];
    const message_of = (row) => ask(table_of(header, [row])).then(() => null, (error) => {
        if (!error.is_refusal) {
            throw error;
        }
        return error.message;
    });
    for (let left = rows, answer = null; ;) {
        try {
            answer = left.length || !rows.length ? await ask(table_of(header, left)) : null;
            return {answer, refused: refused.sort((a, b) => a.line - b.line)};
        } catch (error) {
            const named = left[row_named(error.message)];
            const messages = !error.is_refusal ? [] : named ? left.map((row) => (row === named ? error.message : null))
                : await Promise.all(left.map(message_of)); // of a row that is not named
            if (!messages.some((each) => each) || (!named && messages.every((each) => each === error.message))) {
                throw error; // not about a row
            }
            refused.push(...left.map((row, i) => ({...row, message: messages[i]})).filter(({message}) => message));
            left = left.filter((_, i) => !messages[i]);
        }
    }
}

/** What people call the objects: the column `name`, else the first column of texts, else their number. */
function titles_of(rows) {
    const key = ["name", ...Object.keys(rows[0])].find((each) => !["verdict", "note", "worst_motion"].includes(each) &&
                                                                typeof rows[0][each] === "string");
    return rows.map((row, i) => (key ? row[key] : text_of("list.numbered", {number: i + 1})));
}

const strength = (pga, otherwise) => (pga === null ? otherwise : rounded(pga, 4, -1));

function tilt_text(row) {
    return row.verdict === "topples" ? text_of("list.over")
        : row.peak_of_alpha === null ? text_of("list.unknown") : `${significant(100 * row.peak_of_alpha, 2, 1)} %`;
}

/** Whether another verdict is within a ratio of strengths. */
const is_near = ({factor_below: below, factor_above: above}, near) =>
    (below !== null && below > 1 / near) || (above !== null && above < near);

/** The columns of the table: heading, class, text of a row. */
function columns_of(rows, near) {
    const titles = new Map(titles_of(rows).map((title, i) => [rows[i], title]));
    const columns = [
        ["object", "text", (row) => titles.get(row)],
        ["verdict", "text", (row) => texts.list.verdicts[row.verdict] ?? row.verdict],
        ["topples_from", "number", (row) => strength(row.topples_from,
            text_of("list.above", {end: short(row.end_of_search, 4)}))],
        ["tilt", "number", tilt_text],
        ["lifts_from", "number", (row) => strength(row.lifts_from, text_of("list.never"))],
        ["note", "text", (row) => [...(is_near(row, near) ? [text_of("answer.near")] : []), row.note]
            .filter((each) => each).join(": ")],
    ];
    if ("slides_from" in rows[0]) {
        const text = (row) => strength(row.slides_from, text_of("list.lifts_first"));
        columns.splice(-1, 0, ["slides_from", "number", text]);
    }
    return columns;
}

function csv_of(rows) {
    const cell = (value) => {
        const text = value === null ? "" : String(value);
        return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
    };
    const names = Object.keys(rows[0]);
    const lines = [names, ...rows.map((row) => names.map((name) => row[name]))];
    return lines.map((line) => line.map(cell).join(",") + "\r\n").join("");
}

function elements_of({objects: rows, warnings, step_of_search}, unit, near) {
    const columns = columns_of(rows, near);
    const download = () => {
        const address = URL.createObjectURL(new Blob([csv_of(rows)], {type: "text/csv"}));
        element("a", {href: address, download: text_of("list.file")}).click();
        URL.revokeObjectURL(address);
    };
    const heading = ([key, kind]) => element("th", {class: kind, scope: "col"}, text_of(`list.${key}`));
    const cell = (row, [key, kind, text], i) => element(i ? "td" : "th", {class: `${kind} ${key}`,
        scope: i ? null : "row", "data-verdict": key === "verdict" ? row.verdict : null}, text(row));
    const line = (row) => element("tr", {}, ...columns.map((column, i) => cell(row, column, i)));
    const table = element("table", {}, element("caption", {}, text_of("list.caption")),
        element("thead", {}, element("tr", {}, ...columns.map(heading))), element("tbody", {}, ...rows.map(line)));
    return [
        element("div", {class: "wide", tabindex: 0, role: "region", "aria-label": text_of("list.caption")}, table),
        element("p", {class: "hint scrolls"}, text_of("list.scrolls")),
        element("p", {class: "tools"}, element("button", {type: "button", click: download}, text_of("list.download"))),
        element("p", {class: "hint"}, text_of("list.steps", {step: significant(100 * step_of_search, 2, 1)})),
        ...warnings.map((warning) => element("p", {class: "hint"}, text_of("behaviour.warning",
            {warning: in_words(warning, unit)}))),
    ];
}

function elements_of_refused(rows, unit) {
    const text = ({message, ...row}) => text_of("list.row", {...row, message: in_words(message, unit)});
    return rows.length === 0 ? [] : [element("p", {class: "error"}, text_of("list.left_out")),
        element("ul", {class: "error"}, ...rows.map((row) => element("li", {}, text(row))))];
}

/** Returns update(motion, unit): asks about the cells under a motion of a question; null if it is not usable. */
export function create_objects_table(engine, changed) {
    const place = by_id("table");
    let work = new AbortController();
    by_id("cells").addEventListener("input", changed);
    by_id("example").addEventListener("click", () => {
        by_id("cells").value = text_of("list.example");
        changed();
    });
    return async function update(motion, unit) {
        work.abort();
        work = new AbortController();
        const cells = by_id("cells").value;
        place.classList.add("stale");
        const show = (...elements) => {
            place.replaceChildren(...elements);
            place.classList.remove("stale");
        };
        const show_error = (text) => show(element("p", {class: "error"}, text));
        if (cells.trim() === "") {
            show();
            return;
        }
        if (motion === null) {
            show_error(text_of("list.motion_first"));
            return;
        }
        const {record, period, direction: _, ...other} = motion; // each object in both directions
        const question = {question: "assess", ...other,
                          ...(record === undefined ? {periods: [period]} : {records: [record]})};
        const {signal} = work;
        const ask = (table) => engine.ask({...question, table}, {signal, priority: () => 3});
        try {
            const {answer, refused} = await answer_without_refused(parts_of(cells, unit), ask);
            show(...(answer ? elements_of(answer, unit, near_ratio(motion)) : []),
                ...elements_of_refused(refused, unit));
        } catch (error) {
            if (error.name !== "AbortError") {
                show_error(text_of(error.is_refusal ? "list.refused" : "answer.failed",
                    {message: in_words(error.message, unit)}));
            }
        }
    };
}
