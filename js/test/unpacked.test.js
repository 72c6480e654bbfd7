// What is in no package: a panic, which only a defect can cause, and the calls for files, of which there are none.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

const module = readFileSync(new URL("unpacked.wasm", import.meta.url));
const { instance: { exports } } = await WebAssembly.instantiate(module, {});
const { memory } = exports;
const [INTERNAL_ERROR, IO_ERROR] = [22, 26];

function message() {
    const start = exports.deldrift_last_error();
    const bytes = new Uint8Array(memory.buffer);
    return new TextDecoder().decode(bytes.slice(start, bytes.indexOf(0, start)));
}

test("a panic is a status and a message, again and again", () => {
    for (let k = 0; k < 3; k++) {
        assert.equal(exports.deldrift_js_panic(), INTERNAL_ERROR);
        assert.match(message(), /cell 13 went missing/);
    }
});

test("files are refused, and the triangulation is as before", () => {
    const [points, path, out] = [48, 16, 8].map((size) => exports.deldrift_js_allocate(size));
    new Float64Array(memory.buffer, points, 6).set([0, 0, 1, 0, 0, 1]);
    new Uint8Array(memory.buffer, path, 16).set(new TextEncoder().encode("cells.bin\0"));
    const words = () => new Uint32Array(memory.buffer, out, 2);
    assert.equal(exports.deldrift_create(2, points, 3, 0, out), 0);
    const [t] = words();
    for (let k = 0; k < 2; k++) {
        assert.equal(exports.deldrift_save_file(t, path), IO_ERROR);
        assert.match(message(), /cannot create "cells.bin": there are no files here/);
        assert.equal(exports.deldrift_load_file(path, 0, out), IO_ERROR);
        assert.match(message(), /cannot open "cells.bin": there are no files here/);
        assert.equal(exports.deldrift_cell_count(t, out), 0);
        assert.equal(words()[0], 1);
    }
});
