// What moves on the page. A scene has positions for each frame, follows them with deldrift and, where that can, with
// d3-delaunay, and draws either. Places are from -1 to 1.

import { Delaunay, Triangulation } from "../index.js";

/** Numbers from 0 to 1, the same for everyone. */
function randomNumbers(seed) {
    let state = seed;
    return () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 2 ** 32;
    };
}

function randomPoints(count, dimension) {
    const random = randomNumbers(count);
    return Float64Array.from({ length: count * dimension }, () => 2 * random() - 1);
}

/** How much of the square is shown, so that there are not too many lines to draw. */
function extentFor(count) {
    return Math.min(1, Math.sqrt(8000 / count));
}

/** Has a canvas show the square, or the middle of it. */
function prepare(context, extent) {
    const { width, height } = context.canvas;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.setTransform(width / (2 * extent), 0, 0, height / (2 * extent), width / 2, height / 2);
    context.lineWidth = (1.2 * extent) / width;
}

/** The edges between points, of which one at least is shown. */
function drawEdges(context, { points, triangles, halfedges }, extent) {
    context.beginPath();
    for (let e = 0; e < halfedges.length; e++) {
        if (halfedges[e] > e) continue;
        const [a, b] = [2 * triangles[e], 2 * triangles[e % 3 === 2 ? e - 2 : e + 1]];
        const isShown = (k) => Math.abs(points[k]) <= extent && Math.abs(points[k + 1]) <= extent;
        if (!isShown(a) && !isShown(b)) continue;
        context.moveTo(points[a], points[a + 1]);
        context.lineTo(points[b], points[b + 1]);
    }
    context.stroke();
}

/** A step of motion along the curves of a swirl that keeps points in the square. */
function swirl(points, step) {
    const speed = (x, y) => [
        Math.cos((Math.PI * x) / 2) * Math.sin((Math.PI * y) / 2),
        -Math.sin((Math.PI * x) / 2) * Math.cos((Math.PI * y) / 2),
    ];
    for (let k = 0; k < points.length; k += 2) {
        const [u, v] = speed(points[k], points[k + 1]);
        const [p, q] = speed(points[k] + (step / 2) * u, points[k + 1] + (step / 2) * v);
        points[k] += step * p;
        points[k + 1] += step * q;
    }
}

class Vortex {
    explanation = "All points are carried around by a vortex, each frame by a fifth of their spacing at most. Both "
        + "have the same triangles.";

    constructor(count, D3) {
        this.points = randomPoints(count, 2);
        this.step = 0.4 / Math.sqrt(count);
        this.ours = new Delaunay(this.points.slice());
        this.theirs = D3 && new D3(this.points.slice());
        this.extent = extentFor(count);
    }

    advance() {
        swirl(this.points, this.step);
    }

    followOurs() {
        this.ours.move(this.points);
        return this.ours.halfedges && this.ours.triangles;
    }

    followTheirs() {
        this.theirs.points.set(this.points);
        this.theirs.update();
    }

    drawOurs(context) {
        this.#draw(context, this.ours);
    }

    drawTheirs(context) {
        this.#draw(context, this.theirs);
    }

    #draw(context, delaunay) {
        prepare(context, this.extent);
        context.strokeStyle = "#2a5d9f";
        drawEdges(context, delaunay, this.extent);
    }

    /** Whether both have the same triangles. */
    isSame() {
        const rows = (triangles) => {
            const found = [];
            for (let e = 0; e < triangles.length; e += 3) {
                found.push(Array.from(triangles.subarray(e, e + 3)).sort((a, b) => a - b).join(" "));
            }
            return found.sort().join();
        };
        return rows(this.ours.triangles) === rows(this.theirs.triangles);
    }

    end() {
        this.ours.triangulation.destroy();
    }
}

class Lloyd extends Vortex {
    explanation = "Each point goes to the centroid of its Voronoi cell, again and again, while a slow vortex keeps "
        + "them from coming to rest.";

    advance() {
        // From the second frame on where deldrift has found the centroids.
        if (this.centroids) this.points.set(this.centroids);
        swirl(this.points, this.step / 8);
    }

    followOurs() {
        super.followOurs();
        this.centroids = this.ours.triangulation.voronoiCells([-1, -1], [1, 1]).centroids;
        this.cells = this.ours.voronoi([-1, -1, 1, 1]);
        return this.cells.circumcenters;
    }

    followTheirs() {
        super.followTheirs();
        this.theirCells = this.theirs.voronoi([-1, -1, 1, 1]);
        this.found = new Float64Array(this.points.length);
        for (const cell of this.theirCells.cellPolygons()) this.found.set(centroid(cell), 2 * cell.index);
    }

    drawOurs(context) {
        this.#draw(context, this.cells);
    }

    drawTheirs(context) {
        this.#draw(context, this.theirCells);
    }

    #draw(context, cells) {
        prepare(context, this.extent);
        context.strokeStyle = "#b5542b";
        context.beginPath();
        cells.render(context);
        context.stroke();
    }

    isSame() {
        return super.isSame() && this.centroids.every((x, k) => Math.abs(x - this.found[k]) < 1e-6);
    }
}

function centroid(polygon) {
    let [x, y, sum] = [0, 0, 0];
    for (let k = 1; k < polygon.length; k++) {
        const [[a, b], [c, d]] = [polygon[k - 1], polygon[k]];
        const twice = a * d - c * b;
        x += (a + c) * twice;
        y += (b + d) * twice;
        sum += twice;
    }
    return [x / (3 * sum), y / (3 * sum)];
}

const TEETH = 9;

/** Where the outline of a wheel is. */
function wheel(count, angle) {
    const outline = [];
    for (let k = 0; k < count; k++) {
        const along = (2 * Math.PI * k) / count;
        const radius = 0.55 + 0.12 * Math.tanh(4 * Math.sin(TEETH * along));
        outline.push(radius * Math.cos(along + angle), radius * Math.sin(along + angle));
    }
    return outline;
}

class Domain {
    explanation = "A wheel turns in a fluid that a vortex moves. Its outline is made of segments, which stay edges for "
        + "deldrift; d3-delaunay has none, and the edges that it lacks are red.";

    constructor(count, D3) {
        this.outline = Math.max(TEETH * 4, Math.round(5 * Math.sqrt(count)));
        this.angle = 0;
        this.others = randomPoints(Math.max(0, count - this.outline), 2);
        this.step = 0.2 / Math.sqrt(count);
        this.points = this.#positions();
        this.ours = new Triangulation(2, this.points);
        const ends = Array.from({ length: this.outline }, (_, k) => [k, (k + 1) % this.outline]).flat();
        this.ours.stageSegments(ends);
        this.ours.commit();
        this.theirs = D3 && new D3(this.points.slice());
        this.extent = extentFor(count);
    }

    #positions() {
        return Float64Array.from([...wheel(this.outline, this.angle), ...this.others]);
    }

    advance() {
        this.angle += this.step;
        swirl(this.others, this.step);
        this.points = this.#positions();
    }

    followOurs() {
        this.ours.move(this.points);
        this.levels = this.ours.nestingLevels();
    }

    followTheirs() {
        this.theirs.points.set(this.points);
        this.theirs.update();
    }

    drawOurs(context) {
        const { points, extent, levels, outline } = this;
        prepare(context, extent);
        context.fillStyle = "#e4eef8";
        context.fillRect(-1, -1, 2, 2);
        context.fillStyle = "#f4c67a";
        context.beginPath();
        for (let k = 0; k < 2 * outline; k += 2) context.lineTo(points[k], points[k + 1]);
        context.fill();
        const { vertices, neighbours, count } = this.ours.cells();
        for (const isInside of [false, true]) {
            context.strokeStyle = isInside ? "#8a5a00" : "#7f9fc0";
            context.beginPath();
            for (let cell = 0; cell < count; cell++) {
                if ((levels[cell] % 2 === 1) !== isInside) continue;
                for (let j = 0; j < 3; j++) {
                    // Each edge once, and the outline as that of the inside.
                    const beyond = neighbours[3 * cell + j];
                    if (beyond < cell && levels[beyond] % 2 === levels[cell] % 2) continue;
                    const a = 2 * vertices[3 * cell + ((j + 1) % 3)];
                    const b = 2 * vertices[3 * cell + ((j + 2) % 3)];
                    if (Math.abs(points[a]) > extent || Math.abs(points[a + 1]) > extent) continue;
                    context.moveTo(points[a], points[a + 1]);
                    context.lineTo(points[b], points[b + 1]);
                }
            }
            context.stroke();
        }
    }

    drawTheirs(context) {
        prepare(context, this.extent);
        context.strokeStyle = "#7f9fc0";
        drawEdges(context, this.theirs, this.extent);
        context.strokeStyle = "#d00000";
        context.lineWidth *= 3;
        context.beginPath();
        for (const [a, b] of this.missing()) {
            context.moveTo(this.points[2 * a], this.points[2 * a + 1]);
            context.lineTo(this.points[2 * b], this.points[2 * b + 1]);
        }
        context.stroke();
    }

    /** Segments that are no edges of d3-delaunay's. */
    missing() {
        return Array.from({ length: this.outline }, (_, k) => [k, (k + 1) % this.outline])
            .filter(([a, b]) => ![...this.theirs.neighbors(a)].includes(b));
    }

    /** Whether all segments are edges, and the cells inside have the area of the wheel. */
    isSame() {
        const edges = this.ours.edges();
        const known = new Set();
        for (let k = 0; k < edges.length; k += 2) known.add(edges[k] * 2 ** 26 + edges[k + 1]);
        const areas = this.ours.volumes();
        let area = 0;
        this.levels.forEach((level, cell) => { area += level % 2 ? areas[cell] : 0; });
        const outline = Array.from({ length: this.outline }, (_, k) => k);
        const shoelace = outline.reduce((sum, k) => {
            const [a, b] = [2 * k, 2 * ((k + 1) % this.outline)];
            return sum + (this.points[a] * this.points[b + 1] - this.points[b] * this.points[a + 1]) / 2;
        }, 0);
        return Math.abs(area - shoelace) < 1e-9 && outline.every((k) => {
            const other = (k + 1) % this.outline;
            return known.has(Math.min(k, other) * 2 ** 26 + Math.max(k, other));
        });
    }

    end() {
        this.ours.destroy();
    }
}

class Cloud {
    explanation = "A cloud in space, which turns faster inside than outside. Shown are the edges near its middle "
        + "plane. d3-delaunay is for the plane alone.";

    constructor(count) {
        const random = randomNumbers(count);
        const points = [];
        while (points.length < 3 * count) {
            const place = [0, 0, 0].map(() => 2 * random() - 1);
            if (Math.hypot(...place) < 1) points.push(...place);
        }
        this.points = Float64Array.from(points);
        this.step = 0.15 / Math.cbrt(count);
        this.ours = new Triangulation(3, this.points);
        this.slice = Math.min(1, 30 / Math.cbrt(count) ** 2);
        this.angle = 0.5;
    }

    advance() {
        const { points } = this;
        for (let k = 0; k < points.length; k += 3) {
            const angle = this.step * (1.2 - Math.hypot(points[k], points[k + 2]));
            const [x, z] = [points[k], points[k + 2]];
            points[k] = Math.cos(angle) * x - Math.sin(angle) * z;
            points[k + 2] = Math.sin(angle) * x + Math.cos(angle) * z;
        }
    }

    followOurs() {
        this.ours.move(this.points);
        this.ours.cells();
    }

    drawOurs(context) {
        prepare(context, 1.1);
        const { points, slice } = this;
        const [sin, cos] = [Math.sin(this.angle), Math.cos(this.angle)];
        const edges = this.ours.edges();
        const shown = [[], [], []];
        for (let k = 0; k < edges.length; k += 2) {
            const [a, b] = [3 * edges[k], 3 * edges[k + 1]];
            if (Math.abs(points[a + 1]) > slice || Math.abs(points[b + 1]) > slice) continue;
            const depth = cos * (points[a + 2] + points[b + 2]) - sin * (points[a + 1] + points[b + 1]);
            shown[depth < -0.6 ? 0 : depth < 0.6 ? 1 : 2].push(a, b);
        }
        shown.forEach((list, k) => {
            context.strokeStyle = ["#c9dccf", "#6fa77f", "#1d5c33"][k];
            context.beginPath();
            for (let j = 0; j < list.length; j += 2) {
                const [a, b] = [list[j], list[j + 1]];
                context.moveTo(points[a], cos * points[a + 1] + sin * points[a + 2]);
                context.lineTo(points[b], cos * points[b + 1] + sin * points[b + 2]);
            }
            context.stroke();
        });
    }

    /** Whether the cells are those of a triangulation made anew. */
    isSame() {
        const fresh = new Triangulation(3, this.points);
        const rows = (t) => {
            const { vertices, count } = t.cells();
            return Array.from({ length: count }, (_, cell) =>
                Array.from(vertices.subarray(4 * cell, 4 * cell + 4)).sort((a, b) => a - b).join(" ")).sort().join();
        };
        const isSame = rows(fresh) === rows(this.ours);
        fresh.destroy();
        return isSame;
    }

    end() {
        this.ours.destroy();
    }
}

export const scenes = { vortex: Vortex, lloyd: Lloyd, domain: Domain, cloud: Cloud };
