// node_answers.mjs MODULE [FILE...] < QUESTIONS: the same as native_answers with the WebAssembly module, through the
// class of the page. At the end, one line on stderr: pages of memory after half of the questions and at the end, of
// instances that were not replaced after a refusal.
import fs from "node:fs";
import path from "node:path";
import readline from "node:readline";
import {Program} from "../../tools/web/engine.js";

const [module, ...paths] = process.argv.slice(2);
const compiled = new WebAssembly.Module(fs.readFileSync(module));
const files = new Map(paths.map((each) => [path.basename(each), fs.readFileSync(each)]));
let program = new Program(compiled, files);
let largest = 0;
for await (const line of readline.createInterface({input: process.stdin})) {
    let answer;
    try {
        answer = JSON.stringify(JSON.parse(program.answer(line)));
        largest = Math.max(largest, program.exports.memory.buffer.byteLength);
    } catch (error) {
        program = new Program(compiled, files);
        answer = JSON.stringify(error.is_refusal ? {refused: error.message, code: error.code} : {failed: String(error)});
    }
    process.stdout.write(answer + "\n");
}
process.stderr.write(`${largest}\n`);
