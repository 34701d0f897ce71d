// Elements of the page, and their texts.
import {texts} from "overturn/texts";

const NAMESPACE = "http://www.w3.org/2000/svg";

function with_content(node, attributes, children) {
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === "function") {
            node.addEventListener(name, value);
        } else if (value !== null) {
            node.setAttribute(name, value);
        }
    }
    node.append(...children);
    return node;
}

/** A new element; functions among the attributes are listeners of events, null leaves an attribute out. */
export function element(tag, attributes = {}, ...children) {
    return with_content(document.createElement(tag), attributes, children);
}

export function svg(tag, attributes = {}, ...children) {
    return with_content(document.createElementNS(NAMESPACE, tag), attributes, children);
}

export const by_id = (id) => document.getElementById(id);

/** A text with {names} replaced by values. No line ends between a number and its unit. */
export function filled(text, values = {}) {
    return text.replace(/\{(\w+)\}/g, (_, name) => values[name])
        .replace(/(\d) (?=(?:g|s|m|mm|cm|%)(?:\W|$))/g, "$1\u00a0");
}

/** The text of a key such as "form.width". */
export function text_of(key, values) {
    return filled(key.split(".").reduce((all, name) => all[name], texts), values);
}

/** Writes the texts into elements with data-text, and the names into those with data-label. */
export function write_texts() {
    document.documentElement.lang = texts.language;
    document.title = texts.title;
    for (const each of document.querySelectorAll("[data-text]")) {
        each.textContent = text_of(each.dataset.text);
    }
    for (const each of document.querySelectorAll("[data-label]")) {
        each.setAttribute("aria-label", text_of(each.dataset.label));
    }
}

/** Calls draw(width [px]) now and whenever the width of an element changes. */
export function on_width(node, draw) {
    let width = 0;
    new ResizeObserver(() => {
        if (node.clientWidth && node.clientWidth !== width) {
            width = node.clientWidth;
            draw(width);
        }
    }).observe(node);
}
