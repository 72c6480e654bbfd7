// The names of d3-delaunay and Delaunator give what these give: on their own tests' points, and on random ones.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import test from "node:test";

import { Delaunay as D3 } from "d3-delaunay";
import Original from "delaunator";

import Default, { Delaunator, Delaunay } from "../index.js";
import { Random, areNear, setOfRows, shaken } from "./common.js";

const inputs = JSON.parse(readFileSync(new URL("delaunator.json", import.meta.url)));
const { issue13, issue43, robustness1, robustness3, robustness4, ukraine } = inputs;
const SQUARE = [[0, 0], [1, 0], [0, 1], [1, 1]];

/** What must hold of half-edges, whoever has made them. */
function checkHalfedges({ triangles, halfedges, hull, coords }) {
    assert.equal(triangles.length, halfedges.length);
    let open = 0;
    halfedges.forEach((other, e) => {
        const end = triangles[e % 3 === 2 ? e - 2 : e + 1];
        if (other === -1) {
            open++;
            const at = hull.indexOf(triangles[e]);
            assert.equal(hull[(at + 1) % hull.length], end);
        } else {
            assert.equal(halfedges[other], e);
            assert.equal(triangles[other], end);
        }
    });
    assert.equal(open, triangles.length === 0 ? 0 : hull.length);
    let area = 0;
    for (let e = 0; e < triangles.length; e += 3) {
        const [a, b, c] = [0, 1, 2].map((k) => 2 * triangles[e + k]);
        const twice = (coords[b] - coords[a]) * (coords[c + 1] - coords[a + 1])
            - (coords[c] - coords[a]) * (coords[b + 1] - coords[a + 1]);
        // Clockwise where y goes up. A triangle whose corners are nearly on a line rounds to anything near zero.
        area += twice;
    }
    assert.ok(area <= 0);
}

test("triangles in general position are Delaunator's", () => {
    const random = new Random(1);
    for (const count of [3, 4, 5, 10, 100, 1000, 20_000]) {
        const points = random.points(count);
        const [found, expected] = [new Delaunator(points), new Original(points)];
        checkHalfedges(found);
        assert.deepEqual(setOfRows(found.triangles, 3), setOfRows(expected.triangles, 3));
        // From some vertex on, as all around.
        const start = found.hull.indexOf(expected.hull[0]);
        const hull = Array.from(expected.hull, (_, k) => found.hull[(start + k) % found.hull.length]);
        assert.deepEqual(hull, Array.from(expected.hull));
        assert.equal(found.trianglesLen, expected.trianglesLen);
    }
});

test("after each of many moves they are those of Delaunator, too", () => {
    const random = new Random(2);
    const count = 500;
    const coords = random.points(count);
    const [found, expected] = [new Delaunator(coords), new Original(coords.slice())];
    for (let step = 0; step < 200; step++) {
        const sizes = [1e-4, 0.01, 0, 0.3];
        const next = shaken(coords, sizes[step % 4] / Math.sqrt(count), random);
        coords.set(next);
        expected.coords.set(next);
        found.update();
        expected.update();
        // Arrays that are read now and then follow as well.
        if (step % 3 === 0) continue;
        checkHalfedges(found);
        assert.deepEqual(setOfRows(found.triangles, 3), setOfRows(expected.triangles, 3));
    }
});

test("points of Delaunator's tests make a triangulation", () => {
    const sets = [issue13, issue43, robustness1, robustness3, robustness4, ukraine,
        [[516, 661], [369, 793], [426, 539], [273, 525], [204, 694], [747, 750], [454, 390]],
        [[382, 302], [382, 328], [382, 205], [623, 175], [382, 188], [382, 284], [623, 87], [623, 341], [141, 227]]];
    for (const scale of [1, 1e-9, 1e-2, 1e2, 1e9]) sets.push(robustness1.map((p) => p.map((x) => x * scale)));
    for (const points of sets) {
        const d = Delaunator.from(points);
        checkHalfedges(d);
        d.triangulation.validate();
        // Moved to another place and back.
        const coords = d.coords.slice();
        d.coords.set(coords.map((x, k) => x + coords[(k + 2) % coords.length]));
        d.update();
        checkHalfedges(d);
        d.coords.set(coords);
        d.update();
        checkHalfedges(d);
        assert.deepEqual(setOfRows(d.triangles, 3), setOfRows(Delaunator.from(points).triangles, 3));
    }
    const d = Delaunator.from(ukraine);
    assert.equal(d.trianglesLen, 5133);
    d.coords.set([80, 220]);
    d.update();
    assert.equal(d.trianglesLen, 5139);
});

test("few points, and points on a line", () => {
    const hull = (points) => Array.from(Delaunator.from(points).hull);
    assert.deepEqual(hull([]), []);
    assert.deepEqual(hull([[3, 4]]), [0]);
    assert.deepEqual(hull([[3, 4], [1, 4]]), [1, 0]);
    assert.deepEqual(hull([[0, 0], [1, 0], [3, 0], [2, 0]]), [0, 1, 3, 2]);
    assert.deepEqual(hull([[0, 0], [0, 0], [0, 2], [0, 1]]), [0, 3, 2]);
    assert.equal(Delaunator.from([[0, 0], [1, 0], [3, 0], [2, 0]]).triangles.length, 0);
    assert.equal(Default, Delaunator);
    assert.throws(() => new Delaunator(ukraine), /Expected coords to contain numbers/);
    assert.deepEqual(Array.from(Delaunator.from([{ x: 5, y: 5 }, { x: 7, y: 5 }, { x: 7, y: 6 }], (p) => p.x,
        (p) => p.y).triangles), [0, 2, 1]);
});

test("Delaunay.from", () => {
    const ways = [
        Delaunay.from(SQUARE),
        Delaunay.from(new Set(SQUARE)),
        Delaunay.from(SQUARE.map(([x, y]) => ({ x, y })), (p) => p.x, (p) => p.y),
        Delaunay.from({ length: 4 }, (_, i) => i & 1, (_, i) => i >> 1),
        new Delaunay(Float64Array.of(0, 0, 1, 0, 0, 1, 1, 1)),
    ];
    for (const delaunay of ways) {
        assert.deepEqual(delaunay.points, Float64Array.of(0, 0, 1, 0, 0, 1, 1, 1));
        assert.deepEqual(setOfRows(delaunay.triangles, 3), ["0 1 2", "1 2 3"]);
        assert.deepEqual([0, 1, 2, 3].map((i) => [...delaunay.neighbors(i)]), [[1, 2], [3, 2, 0], [0, 1, 3], [2, 1]]);
    }
    const shifted = Delaunay.from(SQUARE, function (p) { return p[0] + this.by; }, (p) => p[1], { by: 7 });
    assert.equal(shifted.points[0], 7);
});

test("neighbours, incoming half-edges and what is nearest are those of d3-delaunay", () => {
    const random = new Random(3);
    for (const count of [3, 10, 400]) {
        const points = random.points(count);
        const [found, expected] = [new Delaunay(points), new D3(points)];
        for (let i = 0; i < count; i++) {
            // Around a point both turn in the same sense; inside of the hull they begin anywhere.
            const [a, b] = [[...found.neighbors(i)], [...expected.neighbors(i)]];
            const start = a.indexOf(b[0]);
            assert.deepEqual(b.map((_, k) => a[(start + k) % a.length]), b);
            assert.equal(a.length, b.length);
            const e = found.inedges[i];
            assert.equal(found.triangles[e % 3 === 2 ? e - 2 : e + 1], i);
            assert.equal(found.halfedges[e] === -1, expected.halfedges[expected.inedges[i]] === -1);
        }
        for (let k = 0; k < 100; k++) {
            const [x, y] = [2 * random.unit() - 0.5, 2 * random.unit() - 0.5];
            assert.equal(found.find(x, y), expected.find(x, y));
        }
    }
    const square = Delaunay.from([[0, 0], [300, 0], [0, 300], [300, 300], [100, 100]]);
    assert.deepEqual([square.find(49, 49), square.find(51, 51, 2), square.find(NaN, 0)], [0, 4, -1]);
    assert.equal(new Delaunay([]).find(0, -1), -1);
    assert.equal(new Delaunay([0]).find(0, -1), -1);
    const two = new Delaunay([0, 1, 0, 2]);
    assert.deepEqual([two.find(0, -1), two.find(0, 2.2), ...two.neighbors(0)], [0, 1, 1]);
});

test("points at one place, and on a line", () => {
    const pair = Delaunay.from([[0, 0], [1, 0], [0, 1], [1, 0]]);
    assert.deepEqual([0, 1, 2, 3].map((i) => [...pair.neighbors(i)]), [[1, 2], [2, 0], [0, 1], []]);
    assert.equal(pair.inedges[3], -1);
    const voronoi = pair.voronoi([-1, -1, 2, 2]);
    assert.deepEqual([voronoi.contains(1, 1, 0), voronoi.contains(3, 1, 0)], [true, false]);
    assert.equal(voronoi.renderCell(3), undefined);
    const line = Delaunay.from([[0, 1], [0, 2], [0, 4], [0, 0], [0, 3], [0, 4]]);
    assert.deepEqual(Array.from(line.collinear), [3, 0, 1, 4, 2]);
    assert.deepEqual([0, 3, 2, 5].map((i) => [...line.neighbors(i)]), [[3, 1], [0], [4], []]);
    assert.equal(line.find(10, 10), 2);
    const places = [...line.voronoi([-1, 0, 1, 4]).cellPolygons()].map(({ index }) => index);
    assert.deepEqual(places, [0, 1, 2, 3, 4]);
    // Into the plane, and back to a line.
    line.points.set([5, 1, 0, 2, -3, 4]);
    line.update();
    assert.equal(line.collinear, undefined);
    checkHalfedges({ ...named(line), coords: line.points });
    line.move(line.points.map((x, k) => (k % 2 ? x : 0)));
    assert.equal(line.collinear.length, 5);
    // A move that is refused changes nothing.
    const before = line.points.slice();
    assert.throws(() => line.move(before.map((x, k) => (k === 3 ? NaN : x + 1))), { code: "NOT_FINITE" });
    assert.throws(() => line.move([1, 2]), { code: "WRONG_COUNT" });
    assert.deepEqual(line.points, before);
    assert.equal(line.find(10, 10), 2);
});

const named = ({ triangles, halfedges, hull }) => ({ triangles, halfedges, hull });

/** Corners of a closed polygon that are not nearly on the line between their neighbours. */
function corners(polygon, size) {
    const places = polygon.slice(1);
    return places.filter(([x, y], k) => {
        const [[a, b], [c, d]] = [places.at(k - 1), places[(k + 1) % places.length]];
        return Math.abs((c - a) * (y - b) - (d - b) * (x - a)) > 1e-9 * size * size;
    });
}

/** Whether two closed polygons are the same, wherever they begin. */
function assertSamePolygon(found, expected, size) {
    const [a, b] = [corners(found, size), corners(expected, size)];
    const near = ([x, y], [u, v]) => Math.hypot(x - u, y - v) <= 1e-6 * size;
    const isFrom = (start) => b.every((p, k) => near(a[(start + k) % a.length], p));
    const isSame = a.length === b.length && (a.length === 0 || a.some((_, start) => isFrom(start)));
    assert.ok(isSame, `${JSON.stringify(a)} is not ${JSON.stringify(b)}`);
}

test("Voronoi cells are those of d3-delaunay", () => {
    const random = new Random(4);
    const boxes = [[0, 0, 1, 1], [-1, -1, 2, 2], [0.25, 0.3, 0.7, 0.6], [0.5, -3, 9, 0.4]];
    for (const count of [1, 2, 3, 4, 10, 300]) {
        const points = random.points(count);
        const [ours, theirs] = [new Delaunay(points), new D3(points.slice())];
        for (let step = 0; step < 3; step++) {
            for (const box of boxes) {
                const [found, expected] = [ours.voronoi(box), theirs.voronoi(box)];
                for (let i = 0; i < count; i++) {
                    const [a, b] = [found.cellPolygon(i), expected.cellPolygon(i)];
                    assert.equal(a === null, b === null);
                    if (a !== null) assertSamePolygon(a, b, box[2] - box[0]);
                    const sorted = (list) => [...list].sort((x, y) => x - y);
                    assert.deepEqual(sorted(found.neighbors(i)), sorted(expected.neighbors(i)));
                }
                assert.deepEqual(found.vectors.map((x) => Math.sign(x)), expected.vectors.map((x) => Math.sign(x)));
                const [a, b] = [found.render(), expected.render()].map((path) => (path ?? "").split("M").length);
                // Of two points d3-delaunay draws one bisector in two parts.
                if (count !== 2) assert.equal(a, b);
            }
            points.set(shaken(points, 0.02, random));
            theirs.points.set(points);
            ours.update();
            theirs.update();
        }
    }
});

test("areas of Voronoi cells add up to the box, whatever the points", () => {
    const random = new Random(5);
    const grid = Float64Array.from({ length: 200 }, (_, k) => (k % 2 ? Math.floor(k / 20) : (k / 2) % 10) / 10);
    const circle = Float64Array.from({ length: 80 }, (_, k) => (k % 2 ? Math.sin(k >> 1) : Math.cos(k >> 1)));
    for (const points of [random.points(50), grid, circle, Float64Array.from(ukraine.flat()), new Float64Array(10)]) {
        const voronoi = new Delaunay(points).voronoi([-2, -1, 700, 500]);
        let sum = 0;
        for (const polygon of voronoi.cellPolygons()) {
            for (let k = 1; k < polygon.length; k++) {
                sum += (polygon[k - 1][0] * polygon[k][1] - polygon[k][0] * polygon[k - 1][1]) / 2;
            }
        }
        assert.ok(areNear(sum, 702 * 501), `${sum}`);
    }
});

test("what is drawn is text of SVG, or goes to a context", () => {
    const delaunay = Delaunay.from(SQUARE);
    assert.equal(Delaunay.from([[0, 0]]).renderPoints(5), "M5,0A5,5,0,1,1,-5,0A5,5,0,1,1,5,0");
    assert.equal(delaunay.renderTriangle(0), "M0,0L0,1L1,0Z");
    assert.equal(delaunay.renderHull(), "M0,0L0,1L1,1L1,0Z");
    assert.equal(delaunay.render().split("M").length, 3);
    assert.deepEqual(delaunay.hullPolygon().length, 5);
    assert.deepEqual([...delaunay.trianglePolygons()].length, 2);
    assert.deepEqual(delaunay.trianglePolygon(0), [[0, 0], [0, 1], [1, 0], [0, 0]]);
    const voronoi = delaunay.voronoi([-1, -1, 2, 2]);
    assert.equal(voronoi.renderBounds(), "M-1,-1h3v3h-3Z");
    assert.equal(Delaunay.from([]).voronoi().render(), null);
    const calls = [];
    const context = { moveTo: (...to) => calls.push(to), lineTo: (...to) => calls.push(to), closePath: () => {} };
    assert.equal(voronoi.renderCell(0, context), undefined);
    assert.equal(calls.length, 4);
    assert.deepEqual([voronoi.xmin, voronoi.ymax, delaunay.voronoi().xmax], [-1, 2, 960]);
    assert.throws(() => delaunay.voronoi([1, 0, 0, 1]), /invalid bounds/);
});
