// Questions to the program, which is compiled to WebAssembly and runs in workers. Questions and answers are JSON.
// This file imports nothing: workers run the text of some of its functions. They are no modules, which a page that is
// opened from a disk cannot start.

/** A question without an answer. is_refusal: the program refused it; otherwise the program failed. */
export class EngineError extends Error {
    constructor(message, is_refusal, code) {
        super(message);
        Object.assign(this, {name: "EngineError", is_refusal, code});
    }
}

/**
 * Compiles the program and starts workers.
 * module: bytes of the WebAssembly module, or its URL.
 * workers: their number, at least 2. The first one is kept for questions with a priority below URGENT.
 *
 * ask(question, {signal, priority}) returns a promise of the answer. Among waiting questions, the lowest priority() is
 * asked first. An aborted signal cancels the question: its worker is replaced if it is computing the answer.
 * addFile(name, bytes) makes a file, such as a record, known to later questions.
 */
export async function createEngine({module, workers}) {
    const bytes = ArrayBuffer.isView(module) || module instanceof ArrayBuffer
        ? module : await (await fetch(module)).arrayBuffer();
    const compiled = await WebAssembly.compile(bytes);
    const text = [EngineError, Program, serve, "serve();"].map(String).join("\n");
    const source = URL.createObjectURL(new Blob([text], {type: "text/javascript"}));
    const files = new Map();
    const waiting = [];
    const slots = Array.from({length: workers}, (_, i) => ({only_urgent: i === 0, worker: null, job: null}));

    function started(slot) {
        const worker = new Worker(source);
        worker.onmessage = ({data}) => finish(slot, data);
        worker.onerror = (event) => {
            event.preventDefault();
            stop(slot);
            finish(slot, {error: event.message || "the worker failed"});
        };
        worker.postMessage({module: compiled, files: [...files]});
        return worker;
    }

    function stop(slot) {
        slot.worker.terminate();
        slot.worker = null;
    }

    function finish(slot, {answer, error, is_refusal, code}) {
        const {job} = slot;
        slot.job = null;
        if (job && error !== undefined) {
            job.reject(new EngineError(error, is_refusal, code));
        } else if (job) {
            job.resolve(JSON.parse(answer));
        }
        hand_out();
    }

    function hand_out() {
        for (const slot of slots.filter((each) => !each.job)) {
            const suitable = waiting.filter((job) => !slot.only_urgent || job.priority() < URGENT);
            if (suitable.length) {
                const job = suitable.reduce((first, each) => (each.priority() < first.priority() ? each : first));
                waiting.splice(waiting.indexOf(job), 1);
                slot.job = job;
                slot.worker ??= started(slot);
                slot.worker.postMessage({question: JSON.stringify(job.question)});
            }
        }
    }

    function cancel(job) {
        const slot = slots.find((each) => each.job === job);
        if (slot) {
            stop(slot);
            slot.worker = started(slot); // ready when the next question comes
            slot.job = null;
            hand_out();
        } else if (waiting.includes(job)) {
            waiting.splice(waiting.indexOf(job), 1);
        }
        job.reject(new DOMException("cancelled", "AbortError"));
    }

    for (const slot of slots) {
        slot.worker = started(slot);
    }
    return {
        ask(question, {signal, priority = () => 0} = {}) {
            return new Promise((resolve, reject) => {
                const job = {question, priority, resolve, reject};
                if (signal?.aborted) {
                    cancel(job);
                    return;
                }
                signal?.addEventListener("abort", () => cancel(job), {once: true});
                waiting.push(job);
                hand_out();
            });
        },
        addFile(name, content) {
            files.set(name, content);
            slots.forEach((slot) => slot.worker?.postMessage({files: [[name, content]]}));
        },
    };
}

export const URGENT = 10;

/** One instance of the compiled program. It is unusable after an exception. */
export class Program {
    static ENOSYS = 52; // errors of WASI
    static EBADF = 8;

    constructor(compiled, files) {
        const imports = {};
        for (const {module, name} of WebAssembly.Module.imports(compiled)) {
            imports[module] ??= {};
            imports[module][name] = this.functions[module]?.[name] ?? (() => Program.ENOSYS);
        }
        this.exports = new WebAssembly.Instance(compiled, imports).exports;
        this.exports._initialize();
        files.forEach((content, name) => this.add_file(name, content));
    }

    /** The functions that the module imports. Those that are missing here return ENOSYS. */
    functions = {
        overturn: {
            refuse: (code, pointer, size) => {
                throw new EngineError(this.text_at(pointer, size), true, code);
            },
        },
        wasi_snapshot_preview1: {
            fd_write: (_, vectors, count, written) => {
                const view = this.view();
                let text = "", total = 0;
                for (let i = 0; i < count; ++i) {
                    const size = view.getUint32(vectors + 8 * i + 4, true);
                    text += this.text_at(view.getUint32(vectors + 8 * i, true), size);
                    total += size;
                }
                view.setUint32(written, total, true);
                console.error(text);
                return 0;
            },
            fd_close: () => 0,
            fd_prestat_get: () => Program.EBADF, // there are no open folders
            environ_sizes_get: (count, size) => this.set_to_zero(count, size),
            environ_get: () => 0,
            args_sizes_get: (count, size) => this.set_to_zero(count, size),
            args_get: () => 0,
            clock_time_get: (id, precision, time) => {
                this.view().setBigUint64(time, BigInt(Math.round(1e6 * performance.now())), true);
                return 0;
            },
            random_get: (pointer, size) => {
                crypto.getRandomValues(new Uint8Array(this.exports.memory.buffer, pointer >>> 0, size));
                return 0;
            },
            proc_exit: (code) => {
                throw new Error(`the program ended with code ${code}`);
            },
        },
    };

    view() {
        return new DataView(this.exports.memory.buffer);
    }

    set_to_zero(...pointers) {
        pointers.forEach((pointer) => this.view().setUint32(pointer, 0, true));
        return 0;
    }

    text_at(pointer, size) {
        return new TextDecoder().decode(new Uint8Array(this.exports.memory.buffer, pointer >>> 0, size));
    }

    /** Copies bytes to the memory of the module; returns where they are. */
    copied(bytes) {
        const pointer = this.exports.overturn_allocate(bytes.length) >>> 0;
        new Uint8Array(this.exports.memory.buffer, pointer, bytes.length).set(bytes);
        return pointer;
    }

    add_file(name, content) {
        const name_bytes = new TextEncoder().encode(name);
        const pointers = [this.copied(name_bytes), this.copied(content)];
        this.exports.overturn_add_file(pointers[0], name_bytes.length, pointers[1], content.length);
        pointers.forEach((pointer) => this.exports.overturn_release(pointer));
    }

    answer(question) {
        const bytes = new TextEncoder().encode(question);
        const pointer = this.copied(bytes);
        const answer = this.exports.overturn_answer(pointer, bytes.length);
        const text = this.text_at(answer, this.exports.overturn_answer_size());
        this.exports.overturn_release(pointer);
        return text;
    }
}

/** What a worker does: an answer to each question. After an exception, the next question gets a new instance. */
function serve() {
    const files = new Map();
    let compiled, program;
    self.onmessage = ({data}) => {
        compiled = data.module ?? compiled;
        data.files?.forEach(([name, content]) => {
            files.set(name, content);
            program = undefined;
        });
        if (data.question === undefined) {
            return;
        }
        try {
            program ??= new Program(compiled, files);
            self.postMessage({answer: program.answer(data.question)});
        } catch (error) {
            program = undefined;
            self.postMessage({error: error.message, is_refusal: error.is_refusal ?? false, code: error.code});
        }
    };
}
