// A panic, which only a defect can cause, is an error with a message, and no end of the page.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

test("a panic is a status and a message, again and again", async () => {
    const module = readFileSync(new URL("panic.wasm", import.meta.url));
    const { instance: { exports } } = await WebAssembly.instantiate(module, {});
    for (let k = 0; k < 3; k++) {
        assert.equal(exports.deldrift_js_panic(), 22);
        const start = exports.deldrift_last_error();
        const bytes = new Uint8Array(exports.memory.buffer);
        const text = new TextDecoder().decode(bytes.slice(start, bytes.indexOf(0, start)));
        assert.match(text, /cell 13 went missing/);
    }
});
