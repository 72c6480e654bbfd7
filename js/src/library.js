// The library itself, in WebAssembly: its functions, its memory, and what it says when a call fails.
//
// There is one instance for each realm (page, worker, thread of Node). Its functions are those of include/deldrift.h,
// with pointers as numbers.

const statuses = [
    "OK", "NULL_ARGUMENT", "MISALIGNED_ARGUMENT", "SIZE_OVERFLOW", "INVALID_DIMENSION", "INVALID_OPTIONS",
    "INVALID_LEVEL", "BUFFER_TOO_SMALL", "NOT_FINITE", "OUT_OF_RANGE", "NO_SUCH_VERTEX", "REMOVED_VERTEX",
    "DUPLICATE_MOVE", "WRONG_COUNT", "COINCIDENT", "TOO_MANY_VERTICES", "TOO_MANY_CELLS", "OUT_OF_MEMORY", "CANCELLED",
    "INVALID", "BUSY", "POISONED", "INTERNAL_ERROR", "NO_SUCH_FACET", "INVALID_VALUE", "INVALID_DATA", "IO_ERROR",
    "INVALID_FIELD", "STAGED_VERTEX", "NO_SUCH_SEGMENT", "CROSSING", "ON_SEGMENT", "END_REMOVED", "ENDS_MEET",
    "AMBIGUOUS_SEED", "PASSES_SEGMENT", "PREPARED", "NOT_PREPARED", "PERIODIC", "DEPENDENT_VECTORS",
    "CHANGES_NOT_TAKEN", "UNDECIDED_REGIONS", "WEIGHTED", "NOT_WEIGHTED",
];

/** A call that has failed, and has had no effect. */
export class DeldriftError extends Error {
    /** @param {string} code the name of the status in C, without its prefix */
    constructor(code, message, options) {
        super(message, options);
        this.name = "DeldriftError";
        this.code = code;
    }
}

async function bytesOf(url) {
    if (url.protocol === "file:") {
        const { readFile } = await import(/* webpackIgnore: true */ /* @vite-ignore */ "node:fs/promises");
        return readFile(url);
    }
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
    return response.arrayBuffer();
}

const { instance } = await WebAssembly.instantiate(await bytesOf(new URL("../deldrift.wasm", import.meta.url)), {});
const { memory } = instance.exports;

/** Why the instance cannot be used any more, if so. */
let end = null;

/** The stack was too small, or the library has met a state that it takes to be impossible. */
function ended(error) {
    const message = `deldrift has stopped and cannot be used before the program is loaded again: ${error.message}`;
    end = new DeldriftError("INTERNAL_ERROR", message, { cause: error });
    return end;
}

function guarded(call) {
    return (...args) => {
        if (end !== null) throw end;
        try {
            return call(...args);
        } catch (error) {
            throw ended(error);
        }
    };
}

/** The functions of C by their names. */
export const wasm = {};
for (const [name, value] of Object.entries(instance.exports)) {
    if (typeof value === "function") wasm[name] = guarded(value);
}

let uint8 = new Uint8Array(0);
let uint32 = new Uint32Array(0);
let float64 = new Float64Array(0);

// Memory that grows takes the arrays before with it.
function renew() {
    uint8 = new Uint8Array(memory.buffer);
    uint32 = new Uint32Array(memory.buffer);
    float64 = new Float64Array(memory.buffer);
}

/** All memory as bytes, until the next call. */
export function bytes() {
    if (uint8.length === 0) renew();
    return uint8;
}

/** All memory as 32-bit numbers, until the next call. */
export function words() {
    if (uint32.length === 0) renew();
    return uint32;
}

/** All memory as doubles, until the next call. */
export function doubles() {
    if (float64.length === 0) renew();
    return float64;
}

function textAt(pointer) {
    const start = pointer >>> 0;
    return new TextDecoder().decode(bytes().slice(start, bytes().indexOf(0, start)));
}

/** Throws unless a status is that of a call that has done what it was asked to. */
export function check(status) {
    if (status !== 0) throw new DeldriftError(statuses[status] ?? `${status}`, textAt(wasm.deldrift_last_error()));
}

/** The version of the library, as "major.minor.patch". */
export const version = textAt(wasm.deldrift_version());

/** Memory for the arguments and results of some calls. */
class Frame {
    #blocks = [];

    /** Room for so many bytes, at a multiple of 16. */
    room(size) {
        // A number that needs more than 32 bits would lose some.
        const start = size < 2 ** 32 ? wasm.deldrift_js_allocate(size) >>> 0 : 0;
        if (start === 0) throw new DeldriftError("OUT_OF_MEMORY", `there is no memory for ${size} bytes`);
        this.#blocks.push(start, size);
        return start;
    }

    /** A copy of numbers as doubles. */
    doubles(values) {
        const start = this.room(8 * values.length);
        doubles().set(values, start / 8);
        return start;
    }

    /** A copy of numbers as 32-bit ones. */
    words(values) {
        const start = this.room(4 * values.length);
        words().set(values, start / 4);
        return start;
    }

    free() {
        for (let i = 0; i < this.#blocks.length && end === null; i += 2) {
            wasm.deldrift_js_free(this.#blocks[i], this.#blocks[i + 1]);
        }
    }
}

/** Does work that needs memory, which is free afterwards. */
export function inFrame(work) {
    const frame = new Frame();
    try {
        return work(frame);
    } finally {
        frame.free();
    }
}

/** A copy of doubles in memory. */
export const doublesAt = (start, count) => doubles().slice(start / 8, start / 8 + count);

/** A copy of 32-bit numbers in memory. */
export const wordsAt = (start, count) => words().slice(start / 4, start / 4 + count);

/** A 64-bit number in memory. */
export const longAt = (start) => words()[start / 4] + words()[start / 4 + 1] * 2 ** 32;

/** Where to tell of objects that are gone, if the realm has that. */
export const triangulations = new FinalizationRegistry((pointer) => {
    if (end === null) wasm.deldrift_destroy(pointer);
});
