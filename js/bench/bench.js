// deldrift beside d3-delaunay and Delaunator, on the same positions, in one run: js/bench/results.csv, and the table of
// docs/JAVASCRIPT.md.
//
//     node bench/bench.js                 10,000 and 100,000 points
//     node bench/bench.js 1000            other numbers of points, and no record
//     node bench/bench.js --table         the table from the record
//
// All four take turns, some steps each, so that what else the machine does is the same for each, and what is in its
// caches is what they have used themselves. Times are medians of the processor's time, to which other programs do not
// add: with these beside it a long call would be interrupted more often than a short one. A step is from the new
// positions to the cells: as rows of vertices and neighbours ("deldrift, cells"), and as `triangles` and `halfedges`
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

/** Milliseconds of the processor, of all threads of Node, and what comes of the work. */
function timed(work) {
    const start = process.cpuUsage();
    const result = work();
    const { user, system } = process.cpuUsage(start);
    return [(user + system) / 1000, result];
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

const record = new URL("results.csv", import.meta.url);

/** The table of the lines of a record. */
function tableOf(lines) {
    const rows = lines.slice(1).map((line) => {
        const [count, what, ...times] = line.split(",");
        const ratios = [times[2], times[3]].map((time) => `**${(time / times[1]).toPrecision(2)}×**`);
        const shown = times.map((time) => `${Number(time).toPrecision(3)} ms`);
        return `| ${[Number(count).toLocaleString("en"), what, ...shown, ...ratios].join(" | ")} |`;
    });
    return [
        `| points | | ${NAMES.join(" | ")} | names beside delaunator | names beside d3-delaunay |`,
        `|--:|---|${"--:|".repeat(NAMES.length + 2)}`,
        ...rows,
    ].join("\n");
}

function writeTable() {
    const page = new URL("../../docs/JAVASCRIPT.md", import.meta.url);
    const [begin, end] = ["<!-- bench:begin -->", "<!-- bench:end -->"];
    const [before, rest] = readFileSync(page, "utf8").split(begin);
    const table = tableOf(readFileSync(record, "utf8").trim().split("\n"));
    writeFileSync(page, `${before}${begin}\n\n${table}\n\n${end}${rest.split(end)[1]}`);
}

function measured(counts) {
    const random = new Random(1);
    const lines = [["points", "what", ...NAMES.map((name) => `${name.replace(",", "")} (ms)`)].join(",")];
    const add = (count, what, times) => {
        lines.push([count, what, ...times.map((time) => time.toFixed(3))].join(","));
        console.log(lines.at(-1));
    };
    console.log(lines[0]);
    for (const count of counts) {
        add(count, "build", builds(count, random));
        for (const size of SIZES) {
            add(count, size === 0 ? "at rest" : `step of ${size.toExponential()}`, steps(count, size, random));
        }
    }
    return lines;
}

const given = process.argv.slice(2);
if (given[0] !== "--table") {
    const lines = measured(given.length > 0 ? given.map(Number) : [10_000, 100_000]);
    console.log(`\n${tableOf(lines)}`);
    if (given.length === 0) writeFileSync(record, `${lines.join("\n")}\n`);
}
if (given.length === 0 || given[0] === "--table") writeTable();
