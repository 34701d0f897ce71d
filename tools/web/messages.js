// Messages of the program in the words and units of the page.
import {text_of} from "overturn/elements";
import {short, shifted} from "overturn/numbers";
import {NUMBERS, power_of} from "overturn/question";

const KNOWN = [[/slenderness_(plus|minus) = (-|0 )/, "falls"],
               [/slenderness_(plus|minus)|\br_max\b.*Eq\. 17|moment_kept/, "squat"],
               [/\bincline = \S+ is outside/, "lean"]];
const REMARKS = [/^objects:[\d:]+ /, /\s*\((?:lengths|angles|periods|times) [^()]*\)/g, /; angles are in radians/g,
                 / (?:Lengths are in metres|It is a length in metres)[^?]*?[.?](?=\s|$)/g,
                 /,? (?:which is )?in (?:metres|radians)/g]; // lines of a list, and units of the program

/** A message or warning of the program. Lengths get the unit of the form: the program has them in metres. */
export function in_words(message, unit) {
    const [, known] = KNOWN.find(([mark]) => mark.test(message)) ?? [];
    if (known) {
        return text_of(`messages.${known}`);
    }
    const lengths = NUMBERS.filter(({kind}) => kind === "length").map(({quantity}) => quantity).join("|");
    const length = (_, name, value) => `${name} = ${short(Number(shifted(value, -power_of(unit))), 12)} ${unit}`;
    return REMARKS.reduce((text, each) => text.replace(each, ""), message)
        .replace(new RegExp(`\\b(${lengths}) = (-?[\\d.e+-]*\\d)(?: m\\b)?`, "g"), length)
        .replace(/\bincline = (\S*\d)( degrees)?(?!\S)/g, (_, value, in_degrees) =>
            `lean = ${in_degrees ? value : short(Number(value) * 180 / Math.PI, 12)} degrees`);
}
