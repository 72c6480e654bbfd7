// The names of Delaunator, on a triangulation that moves.

import { DeldriftError } from "./library.js";
import { Halfedges } from "./halfedges.js";
import { Triangulation } from "./triangulation.js";

export class Delaunator {
    #halfedges = new Halfedges();
    #isStale = true;
    #hull = null;

    static from(points, getX = (p) => p[0], getY = (p) => p[1]) {
        const coords = new Float64Array(2 * points.length);
        for (let i = 0; i < points.length; i++) {
            coords[2 * i] = getX(points[i]);
            coords[2 * i + 1] = getY(points[i]);
        }
        return new Delaunator(coords);
    }

    constructor(coords) {
        if (coords.length > 0 && typeof coords[0] !== "number") {
            throw new DeldriftError("INVALID_VALUE", "Expected coords to contain numbers.");
        }
        this.coords = coords;
        /** What moves: see class Triangulation. */
        this.triangulation = new Triangulation(2, whole(coords));
    }

    /** Follows `coords`, of which any may have changed. */
    update() {
        this.move(this.coords);
    }

    /** Moves all points to others, as many and in the same order, and writes these to `coords`. */
    move(points) {
        this.triangulation.move(whole(points));
        this.#isStale = true;
        this.#hull = null;
        const { coords } = this;
        if (points === coords) return;
        if (ArrayBuffer.isView(coords)) coords.set(points);
        else for (let k = 0; k < points.length; k++) coords[k] = points[k];
    }

    #follow() {
        if (this.#isStale) this.#halfedges.follow(this.triangulation.cells());
        this.#isStale = false;
        return this.#halfedges;
    }

    /** Rows of three vertices, which the next `update` may write to. */
    get triangles() {
        return this.#follow().triangles;
    }

    /** For each half-edge the other half, -1 on the hull; the next `update` may write to it. */
    get halfedges() {
        return this.#follow().halfedges;
    }

    get trianglesLen() {
        return this.triangles.length;
    }

    /** The vertices of the convex hull, in the order of the half-edges on it. */
    get hull() {
        this.#hull ??= this.triangles.length === 0 ? this.#line() : this.#around();
        return this.#hull;
    }

    #around() {
        const { triangles, halfedges } = this;
        const next = new Map();
        for (let e = 0; e < halfedges.length; e++) {
            if (halfedges[e] === -1) next.set(triangles[e], triangles[e % 3 === 2 ? e - 2 : e + 1]);
        }
        const hull = new Uint32Array(next.size);
        let vertex = next.keys().next().value;
        for (let k = 0; k < hull.length; k++) {
            hull[k] = vertex;
            vertex = next.get(vertex);
        }
        return hull;
    }

    /** Of vertices on a line those that are not hidden, along it. */
    #line() {
        const { coords } = this;
        const hidden = new Set(this.triangulation.hiddenVertices());
        const shown = Array.from({ length: coords.length >> 1 }, (_, i) => i).filter((i) => !hidden.has(i));
        return Uint32Array.from(shown.sort((i, j) =>
            coords[2 * i] - coords[2 * j] || coords[2 * i + 1] - coords[2 * j + 1]));
    }
}

/** Coordinates of points without half of one. */
function whole(coords) {
    return coords.length % 2 === 0 ? coords : coords.slice(0, -1);
}
