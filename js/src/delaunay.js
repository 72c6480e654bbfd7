// The names of d3-delaunay, on a triangulation that moves.

import { Delaunator } from "./delaunator.js";
import { closed, drawPolygon, drawn } from "./path.js";
import { Voronoi } from "./voronoi.js";

export class Delaunay {
    #delaunator;
    #inedges = null;
    #places = null;

    static from(points, fx = (p) => p[0], fy = (p) => p[1], that = undefined) {
        const list = "length" in points ? points : Array.from(points);
        const coords = new Float64Array(2 * list.length);
        for (let i = 0; i < list.length; i++) {
            coords[2 * i] = fx.call(that, list[i], i, points);
            coords[2 * i + 1] = fy.call(that, list[i], i, points);
        }
        return new Delaunay(coords);
    }

    constructor(points) {
        this.#delaunator = new Delaunator(points);
        this.points = points;
    }

    /** What moves: see class Triangulation. Vertices are those of `points`, so that none may be inserted there. */
    get triangulation() {
        return this.#delaunator.triangulation;
    }

    get triangles() {
        return this.#delaunator.triangles;
    }

    get halfedges() {
        return this.#delaunator.halfedges;
    }

    get hull() {
        return this.#delaunator.hull;
    }

    /** The points along their line, if all are on one and more than two are apart; undefined otherwise. */
    get collinear() {
        return this.triangles.length === 0 && this.hull.length > 2 ? Int32Array.from(this.hull) : undefined;
    }

    /** For each point a half-edge that ends there, the one on the hull if there is one; -1 if it is in no triangle. */
    get inedges() {
        if (this.#inedges === null) {
            const { triangles, halfedges } = this;
            const inedges = new Int32Array(this.points.length >> 1).fill(-1);
            for (let e = 0; e < triangles.length; e++) {
                const end = triangles[next(e)];
                if (halfedges[e] === -1 || inedges[end] === -1) inedges[end] = e;
            }
            this.#inedges = inedges;
        }
        return this.#inedges;
    }

    /** Where each vertex is in `hull`. */
    get #onHull() {
        this.#places ??= new Map(Array.from(this.hull, (vertex, k) => [vertex, k]));
        return this.#places;
    }

    /** Follows `points`, of which any may have changed. */
    update() {
        return this.move(this.points);
    }

    /** Moves all points to others, as many and in the same order: x0, y0, x1, ... */
    move(points) {
        this.#delaunator.move(points);
        this.#inedges = null;
        this.#places = null;
        return this;
    }

    voronoi(bounds) {
        return new Voronoi(this, bounds);
    }

    *neighbors(i) {
        const { triangles, halfedges, hull } = this;
        if (triangles.length === 0) {
            const k = this.#onHull.get(i);
            if (k === undefined) return;
            if (k > 0) yield hull[k - 1];
            if (k < hull.length - 1) yield hull[k + 1];
            return;
        }
        const first = this.inedges[i];
        if (first === -1) return;
        let e = first;
        do {
            yield triangles[e];
            const out = next(e);
            e = halfedges[out];
            if (e === -1) yield triangles[next(out)];
        } while (e !== first && e !== -1);
    }

    /** The point nearest to a place, -1 if there is none. Where to begin does not matter. */
    find(x, y) {
        const [px, py] = [+x, +y];
        return Number.isFinite(px) && Number.isFinite(py) ? this.triangulation.nearest([px, py]) : -1;
    }

    render(context) {
        return drawn(context, (to) => {
            const { points, triangles, halfedges } = this;
            for (let e = 0; e < halfedges.length; e++) {
                if (halfedges[e] < e) continue;
                const [a, b] = [2 * triangles[e], 2 * triangles[halfedges[e]]];
                to.moveTo(points[a], points[a + 1]);
                to.lineTo(points[b], points[b + 1]);
            }
            this.renderHull(to);
        });
    }

    renderPoints(context, r) {
        const isContext = typeof context?.moveTo === "function";
        if (r === undefined && !isContext) [context, r] = [null, context];
        const radius = r == null ? 2 : +r;
        return drawn(context, (to) => {
            const { points } = this;
            for (let k = 0; k + 1 < points.length; k += 2) {
                to.moveTo(points[k] + radius, points[k + 1]);
                to.arc(points[k], points[k + 1], radius, 0, 2 * Math.PI);
            }
        });
    }

    #corners(vertices) {
        const { points } = this;
        return Array.from(vertices).flatMap((v) => [points[2 * v], points[2 * v + 1]]);
    }

    renderHull(context) {
        return drawn(context, (to) => {
            if (this.hull.length > 0) drawPolygon(to, this.#corners(this.hull));
        });
    }

    hullPolygon() {
        return this.hull.length === 0 ? null : closed(this.#corners(this.hull));
    }

    renderTriangle(i, context) {
        return drawn(context, (to) => drawPolygon(to, this.#corners(this.triangles.subarray(3 * i, 3 * i + 3))));
    }

    *trianglePolygons() {
        for (let i = 0; 3 * i < this.triangles.length; i++) yield this.trianglePolygon(i);
    }

    trianglePolygon(i) {
        return closed(this.#corners(this.triangles.subarray(3 * i, 3 * i + 3)));
    }
}

function next(e) {
    return e % 3 === 2 ? e - 2 : e + 1;
}
