// What ends the library, as a stack that is too small would, is told by every later call.

import assert from "node:assert/strict";
import test from "node:test";

import { DeldriftError, Triangulation } from "../index.js";
import { inFrame, wasm, words } from "../src/library.js";
import { Random } from "./common.js";

test("after a trap every call says why it cannot be served", () => {
    const t = new Triangulation(2, new Random(1).points(10));
    const stopped = (error) => error instanceof DeldriftError && error.code === "INTERNAL_ERROR"
        && /stopped/.test(error.message) && error.cause instanceof WebAssembly.RuntimeError;
    assert.throws(() => inFrame((frame) => {
        const [points, options, out] = [frame.doubles(new Random(2).points(50_000)), frame.room(36), frame.room(4)];
        words().fill(0, options / 4, options / 4 + 9);
        words()[options / 4] = 36;
        // A callback where there is no function.
        words()[options / 4 + 6] = 1e6;
        wasm.deldrift_create(2, points, 50_000, options, out);
    }), stopped);
    assert.throws(() => t.cells(), stopped);
    assert.throws(() => new Triangulation(2, []), stopped);
});
