// What is below the names of others: motion, space, weights, segments; and the life of a triangulation.

import assert from "node:assert/strict";
import test from "node:test";

import { DeldriftError, Triangulation, version } from "../index.js";
import { words } from "../src/library.js";
import { Random, areNear, setOfRows, shaken } from "./common.js";

const rowsOf = (t) => setOfRows(t.cells().vertices, t.dimension + 1);

/** The call fails with a status and a message. */
function refused(call, code, message) {
    assert.throws(call, (error) =>
        error instanceof DeldriftError && error.code === code && message.test(error.message));
}

function checkIsFresh(t, options) {
    const fresh = new Triangulation(t.dimension, t.positions(), options);
    assert.deepEqual(rowsOf(t), rowsOf(fresh));
    fresh.destroy();
}

test("the version is that of the package", async () => {
    const { readFileSync } = await import("node:fs");
    assert.equal(version, JSON.parse(readFileSync(new URL("../package.json", import.meta.url))).version);
});

for (const dimension of [2, 3]) {
    test(`200 commits in ${dimension}D, at rest, after refusals, copied, saved and loaded`, () => {
        const random = new Random(dimension);
        let positions = random.points(300, dimension);
        let t = new Triangulation(dimension, positions);
        for (let step = 1; step <= 200; step++) {
            const size = [1e-5, 0, 0.01, 0.1][step % 4];
            positions = shaken(positions, size, random);
            const report = t.move(positions);
            assert.equal(report.timestamp, step);
            if (size === 0) assert.equal(report.moved, 0);
            if (step % 10 !== 0) continue;
            const wrong = positions.slice();
            wrong[7] = NaN;
            refused(() => t.move(wrong), "NOT_FINITE", /NaN/);
            refused(() => t.move(positions.slice(dimension)), "WRONG_COUNT", /./);
            refused(() => t.move(positions.slice(1)), "WRONG_COUNT", /rows/);
            assert.equal(t.timestamp, step);
            assert.deepEqual(t.positions(), positions);
            checkIsFresh(t);
            t.validate();
            const before = t;
            t = step % 20 === 0 ? Triangulation.load(t.save()) : t.clone();
            assert.deepEqual(t.copyCells(), before.copyCells());
            before.destroy();
            refused(() => before.move(positions), "NULL_ARGUMENT", /destroyed/);
            before.destroy();
        }
        assert.equal(t.statistics.timestamp, 200);
        t.destroy();
    });

    test(`vertices come and go in ${dimension}D`, () => {
        const random = new Random(7);
        const t = new Triangulation(dimension, random.points(50, dimension));
        for (let round = 0; round < 50; round++) {
            const place = random.points(1, dimension);
            const vertex = t.insert(place);
            assert.deepEqual([vertex, t.isPresent(vertex)], [50 + 2 * round, true]);
            assert.equal(t.nearest(place), vertex);
            assert.deepEqual(t.locate(place), { kind: "vertex", index: vertex });
            t.relocate(vertex, random.points(1, dimension));
            assert.ok(t.star(vertex).length > 0);
            t.remove(vertex);
            refused(() => t.remove(vertex), "REMOVED_VERTEX", /./);
            assert.equal(t.isPresent(vertex), false);
            const first = t.stageInsertions(random.points(1, dimension));
            t.stageMoves([0, 1], random.points(2, dimension));
            refused(() => t.stageMoves([0], random.points(1, dimension)), "DUPLICATE_MOVE", /./);
            if (round % 2 === 0) {
                t.stageRemovals([first - 2 > 50 && t.isPresent(first - 2) ? first - 2 : 2 + round]);
                assert.equal(t.commit().inserted, 1);
                assert.ok(t.isPresent(first));
            } else {
                t.discard();
                assert.ok(!t.isPresent(first));
                t.insert(random.points(1, dimension));
            }
            t.validate();
        }
        refused(() => t.insert([0.5]), "WRONG_COUNT", /./);
        refused(() => t.insert(new Array(dimension).fill(1e300)), "OUT_OF_RANGE", /./);
    });

    test(`changes are told in ${dimension}D`, () => {
        const random = new Random(8);
        let positions = random.points(200, dimension);
        const t = new Triangulation(dimension, positions);
        let known = new Map();
        for (let step = 0; step < 40; step++) {
            const changes = t.takeChanges();
            const moved = Array.from(changes.renumberedFrom, (from) => known.get(from));
            changes.removed.forEach((cell) => known.delete(cell));
            changes.renumberedFrom.forEach((from) => known.delete(from));
            changes.renumberedTo.forEach((to, k) => known.set(to, moved[k]));
            const { vertices, count, corners } = t.cells();
            const row = (cell) => setOfRows(vertices.slice(corners * cell, corners * (cell + 1)), corners)[0];
            changes.created.forEach((cell) => known.set(cell, row(cell)));
            assert.equal(known.size, count);
            for (const [cell, corners] of known) assert.equal(corners, row(cell));
            positions = shaken(positions, [1e-4, 0.02, 0.2][step % 3], random);
            t.move(positions);
        }
    });

    test(`Voronoi cells fill the box in ${dimension}D`, () => {
        const random = new Random(9);
        const t = new Triangulation(dimension, random.points(100, dimension));
        const [low, high] = [new Array(dimension).fill(0), new Array(dimension).fill(1)];
        const { volumes, areas, centroids } = t.voronoiCells(low, high);
        assert.ok(areNear(volumes.reduce((sum, v) => sum + v), 1));
        assert.ok(areas.every((area) => area > 0));
        for (let axis = 0; axis < dimension; axis++) {
            const moment = volumes.reduce((sum, v, i) => sum + v * centroids[dimension * i + axis], 0);
            assert.ok(areNear(moment, 0.5));
        }
        // Lloyd's iteration.
        t.move(centroids);
        t.validate();
        const cells = t.volumes();
        assert.equal(cells.length, t.cellCount);
        assert.ok(cells.every((volume) => volume > 0));
        assert.equal(t.circumcentres().length, dimension * t.cellCount);
        assert.equal(t.edges().length % 2, 0);
        assert.ok(t.hullFacets().length >= dimension * (dimension + 1));
        assert.ok(t.tolerance(5) >= 0);
        assert.ok(t.memoryBytes > 0);
        assert.throws(() => t.voronoiCells(low, low), DeldriftError);
    });

    test(`vertices with weights in ${dimension}D`, () => {
        const random = new Random(10);
        let positions = random.points(200, dimension);
        const weights = Float64Array.from({ length: 200 }, () => 0.02 * random.unit());
        const t = new Triangulation(dimension, positions, { weights });
        assert.ok(t.hiddenByWeight().length > 0);
        for (let step = 0; step < 50; step++) {
            positions = shaken(positions, 0.01, random);
            weights[step] = 0.02 * random.unit();
            t.move(positions, weights);
        }
        t.stageWeights([3], [1]);
        t.commit();
        t.setWeight(4, 0.5);
        assert.deepEqual([t.weights()[3], t.weights()[4]], [1, 0.5]);
        t.validate();
        checkIsFresh(t, { weights: t.weights() });
        refused(() => new Triangulation(dimension, positions, { weights: [1] }), "WRONG_COUNT", /weights/);
        refused(() => new Triangulation(dimension, positions).weights(), "NOT_WEIGHTED", /./);
    });
}

test("segments stay edges while a domain turns", () => {
    const random = new Random(11);
    const sides = 12;
    const corner = (k, angle) => [1.5 * Math.cos(angle + k), 1.5 * Math.sin(angle + k)];
    const turned = (angle) => Array.from({ length: sides }, (_, k) => corner((2 * Math.PI * k) / sides, angle)).flat();
    const others = Array.from(random.points(200), (x) => 6 * x - 3)
        .reduce((list, x, k, all) => (k % 2 && Math.abs(Math.hypot(all[k - 1], x) - 1.5) > 0.2
            ? [...list, all[k - 1], x] : list), []);
    const t = new Triangulation(2, [...turned(0), ...others]);
    const ends = Array.from({ length: sides }, (_, k) => [k, (k + 1) % sides]).flat();
    assert.equal(t.stageSegments(ends), 0);
    t.commit();
    for (let step = 1; step < 100; step++) {
        t.move([...turned(0.02 * step), ...others]);
        const edges = new Set(setOfRows(t.edges(), 2));
        setOfRows(t.segments().ends, 2).forEach((segment) => assert.ok(edges.has(segment)));
    }
    const areas = t.volumes();
    const inside = t.nestingLevels().reduce((sum, level, cell) => sum + (level % 2 ? areas[cell] : 0), 0);
    assert.ok(areNear(inside, (sides / 2) * 1.5 ** 2 * Math.sin((2 * Math.PI) / sides)));
    refused(() => { t.stageSegments([0, 6, 3, 9]); t.commit(); }, "CROSSING", /./);
    t.discard();
    t.stageSegmentRemovals(t.segments().segments);
    t.commit();
    assert.equal(t.segments().ends.length, 0);
    t.validate();
});

test("wrong arguments are refused, and say what is wrong", () => {
    refused(() => new Triangulation(4, []), "INVALID_DIMENSION", /dimension is 4/);
    refused(() => new Triangulation(2, [0, 0, 1, 0, 0, NaN]), "NOT_FINITE", /positions\[2\], coordinate 1/);
    refused(() => new Triangulation(2, ["a", "b"]), "NOT_FINITE", /./);
    refused(() => new Triangulation(2, [0, 0, 0, 0], { coincidence: "reject" }), "COINCIDENT", /./);
    refused(() => new Triangulation(2, [], { algorithm: "best" }), "INVALID_OPTIONS", /algorithm best/);
    refused(() => Triangulation.load(new Uint8Array(100)), "INVALID_DATA", /./);
    const t = new Triangulation(3, [], { algorithm: "repair" });
    assert.deepEqual([t.algorithm, t.cellCount, t.nearest([0, 0, 0])], ["repair", 0, -1]);
    t.algorithm = "tolerance";
    assert.equal(t.algorithm, "tolerance");
    refused(() => t.star(0), "NO_SUCH_VERTEX", /./);
    for (const vertex of [undefined, NaN, -1, 0.5, "0"]) {
        refused(() => t.remove(vertex), "NO_SUCH_VERTEX", /is no id/);
        refused(() => t.stageRemovals([vertex]), "NO_SUCH_VERTEX", /is no id/);
    }
    refused(() => new Triangulation(3.5, new Float64Array(12)), "INVALID_DIMENSION", /3.5/);
    assert.deepEqual(t.locate([1, 2, 3]), { kind: "no cells", index: -1 });
    const data = new Triangulation(2, new Random(1).points(20)).save();
    data[data.length >> 1] ^= 1;
    refused(() => Triangulation.load(data), "INVALID_DATA", /./);
});

test("memory is given back", () => {
    const random = new Random(12);
    const points = random.points(20_000);
    const cycle = () => {
        const t = new Triangulation(2, points);
        t.move(shaken(points, 1e-4, random));
        t.copyCells();
        t.destroy();
    };
    cycle();
    const bytes = words().buffer.byteLength;
    for (let k = 0; k < 30; k++) cycle();
    assert.equal(words().buffer.byteLength, bytes);
});

test("memory that cannot be had is an error, and no more", () => {
    const t = new Triangulation(2, new Random(13).points(1000));
    const before = rowsOf(t);
    // More than there are addresses; the array itself has no entries.
    refused(() => t.move({ length: 2 ** 31 }), "OUT_OF_MEMORY", /memory/);
    assert.deepEqual(rowsOf(t), before);
    t.validate();
});

test("views are of the memory of the library", () => {
    const t = new Triangulation(2, new Random(14).points(100));
    const { vertices } = t.cells();
    assert.equal(vertices.buffer, words().buffer);
    assert.deepEqual(vertices.slice(), t.copyCells().vertices);
});
