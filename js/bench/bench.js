// deldrift beside d3-delaunay and Delaunator, on the same positions, in one run: js/bench/results.csv, and the table of
// docs/JAVASCRIPT.md.
//
//     node bench/bench.js                 10,000 and 100,000 points
//     node bench/bench.js 1000            other numbers of points, and no record
//
// All four take turns, some steps each, so that what else the machine does is the same for each, and what is in its
// caches is what they have used themselves. Times are medians. A step is from the
// new positions to the cells: as rows of vertices and neighbours ("deldrift, cells"), and as `triangles` and `halfedges`
// ("deldrift, names"), which is what the other two give. At the end of each series all have the same triangles.

import { readFileSync, writeFileSync } from "node:fs";

import { Delaunay as D3 } from "d3-delaunay";
import Original from "delaunator";

import { Delaunay, Triangulation } from "../index.js";
import { Random, setOfRows, shaken } from "../test/common.js";

const BUILDS = 15;
const STEPS_OF_TURN = 8;
const TURNS = 6;
// Engines compile what is called often, and again when they know more; the first calls take several times as long.
const WARM_UP_TURNS = 3;
/** By how many spacings each coordinate moves at most. */
const SIZES = [0, 1e-5, 1e-3, 1e-2];
const NAMES = ["deldrift, cells", "deldrift, names", "delaunator", "d3-delaunay"];

function median(times) {
    return times.slice().sort((a, b) => a - b)[times.length >> 1];
}

/** What is compared: how each is made, how it follows, and its triangles. */
const ways = [
    {
        make: (points) => new Triangulation(2, points),
        follow: (t, points) => t.move(points),
        read: (t) => t.cells().vertices,
        end: (t) => t.destroy(),
    },
    {
        make: (points) => new Delaunay(points.slice()),
        follow: (t, points) => t.move(points),
        read: (t) => t.halfedges && t.triangles,
        end: (t) => t.triangulation.destroy(),
    },
    {
        make: (points) => new Original(points.slice()),
        follow: (t, points) => { t.coords.set(points); t.update(); },
        read: (t) => t.triangles,
        end: () => {},
    },
    {
        make: (points) => new D3(points.slice()),
        follow: (t, points) => { t.points.set(points); t.update(); },
        read: (t) => t.triangles,
        end: () => {},
    },
];

function timed(work) {
    const start = performance.now();
    const result = work();
    return [performance.now() - start, result];
}

function builds(count, random) {
    const times = ways.map(() => []);
    for (let k = -5; k < BUILDS; k++) {
        const points = random.points(count);
        const rows = ways.map((way, w) => {
            const [time, made] = timed(() => {
                const t = way.make(points);
                way.read(t);
                return t;
            });
            if (k >= 0) times[w].push(time);
            const found = k === 0 && count <= 10_000 ? setOfRows(way.read(made), 3).join() : "";
            way.end(made);
            return found;
        });
        if (new Set(rows).size > 1) throw new Error("other triangles");
    }
    return times.map(median);
}

function steps(count, size, random) {
    let points = random.points(count);
    const made = ways.map((way) => way.make(points));
    const times = ways.map(() => []);
    for (let turn = -WARM_UP_TURNS; turn < TURNS; turn++) {
        const series = Array.from({ length: STEPS_OF_TURN }, () => {
            points = shaken(points, size / Math.sqrt(count), random);
            return points;
        });
        ways.forEach((way, w) => {
            for (const next of series) {
                const [time] = timed(() => {
                    way.follow(made[w], next);
                    way.read(made[w]);
                });
                if (turn >= 0) times[w].push(time);
            }
        });
    }
    const rows = new Set(ways.map((way, w) => setOfRows(way.read(made[w]), 3).join()));
    if (rows.size > 1) throw new Error("other triangles");
    ways.forEach((way, w) => way.end(made[w]));
    return times.map(median);
}

const given = process.argv.slice(2).map(Number);
const random = new Random(1);
const lines = [["points", "what", ...NAMES.map((name) => `${name.replace(",", "")} (ms)`)].join(",")];
const table = [
    `| points | | ${NAMES.join(" | ")} | names beside delaunator | names beside d3-delaunay |`,
    `|--:|---|${"--:|".repeat(NAMES.length + 2)}`,
];
for (const count of given.length > 0 ? given : [10_000, 100_000]) {
    const row = (what, times) => {
        lines.push([count, what, ...times.map((time) => time.toFixed(3))].join(","));
        const ratios = [times[2], times[3]].map((time) => `**${(time / times[1]).toPrecision(2)}×**`);
        const shown = times.map((time) => `${time.toPrecision(3)} ms`);
        table.push(`| ${[count.toLocaleString("en"), what, ...shown, ...ratios].join(" | ")} |`);
        console.log(table.at(-1));
    };
    row("build", builds(count, random));
    for (const size of SIZES) {
        row(size === 0 ? "at rest" : `step of ${size.toExponential()}`, steps(count, size, random));
    }
}
if (given.length === 0) {
    writeFileSync(new URL("results.csv", import.meta.url), `${lines.join("\n")}\n`);
    const page = new URL("../../docs/JAVASCRIPT.md", import.meta.url);
    const marked = /(<!-- bench:begin -->\n\n)[^]*(\n\n<!-- bench:end -->)/;
    writeFileSync(page, readFileSync(page, "utf8").replace(marked, (_, begin, end) => begin + table.join("\n") + end));
}
