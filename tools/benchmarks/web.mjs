// web.mjs MODULE SIDE < QUESTION: prints, as JSON, the seconds of the WebAssembly module for compiling it, for the first
// verdict after that, for one with the ranges, for a spectrum of 128 x 128 points in tiles, and for one of SIDE x SIDE.
import fs from "node:fs";
import {Program} from "../web/engine.js";

const [module, side] = process.argv.slice(2);
const question = JSON.parse(fs.readFileSync(0, "utf8"));
const times = {};

function timed(name, work) {
    const begin = performance.now();
    const result = work();
    times[name] = (performance.now() - begin) / 1000;
    return result;
}

function axis({first, last}, count) {
    return Array.from({length: count}, (_, i) => first * (last / first) ** (i / (count - 1)));
}

function spectrum(program, count, tile) {
    const pga = axis(question.pga, count);
    const periods = axis(question.period, count);
    for (let row = 0; row < count; row += tile) {
        for (let column = 0; column < count; column += tile) {
            program.answer(JSON.stringify({question: "spectrum", ...question.block, pga: pga.slice(row, row + tile),
                x: {quantity: "pulse_period", values: periods.slice(column, column + tile)}}));
        }
    }
}

const compiled = timed("compile", () => new WebAssembly.Module(fs.readFileSync(module)));
const one = {question: "topple", ...question.block, pga: question.pga.middle, period: question.period.middle};
const program = timed("first_verdict", () => {
    const fresh = new Program(compiled, new Map());
    fresh.answer(JSON.stringify({...one, search: false}));
    return fresh;
});
timed("ranges", () => program.answer(JSON.stringify(one)));
timed("tiles_128", () => spectrum(program, 128, 32));
timed("spectrum", () => spectrum(program, Number(side), Number(side)));
console.log(JSON.stringify(times));
