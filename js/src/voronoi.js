// The names of d3-delaunay for Voronoi diagrams, clipped by a rectangle.
//
// A cell that is finite is the polygon of the circumcentres around its point, clipped by the sides of the rectangle.
// One at the hull is the rectangle, clipped by the bisectors between its point and its neighbours.

import { closed, drawPolygon, drawn } from "./path.js";

export class Voronoi {
    #circumcenters = null;
    #vectors = null;

    constructor(delaunay, bounds = [0, 0, 960, 500]) {
        const [xmin, ymin, xmax, ymax] = Array.from(bounds, Number);
        if (!(xmax >= xmin) || !(ymax >= ymin)) throw new Error("invalid bounds");
        this.delaunay = delaunay;
        [this.xmin, this.ymin, this.xmax, this.ymax] = [xmin, ymin, xmax, ymax];
    }

    /** Follows the points, of which any may have changed. */
    update() {
        this.delaunay.update();
        this.#circumcenters = null;
        this.#vectors = null;
        return this;
    }

    get circumcenters() {
        this.#circumcenters ??= this.delaunay.triangulation.circumcentres();
        return this.#circumcenters;
    }

    /** For each point on the hull the directions of the two rays of its cell, where it is infinite. */
    get vectors() {
        if (this.#vectors === null) {
            const { points, hull } = this.delaunay;
            const vectors = new Float64Array(2 * points.length);
            hull.forEach((b, k) => {
                const a = hull.at(k - 1);
                vectors[4 * a + 2] = vectors[4 * b] = points[2 * a + 1] - points[2 * b + 1];
                vectors[4 * a + 3] = vectors[4 * b + 1] = points[2 * b] - points[2 * a];
            });
            this.#vectors = vectors;
        }
        return this.#vectors;
    }

    /** The edge between the cells at a half-edge, within the rectangle; null if nothing is left. */
    #edge(e) {
        const { points, triangles, halfedges } = this.delaunay;
        const { circumcenters } = this;
        const [from, other] = [Math.trunc(e / 3), halfedges[e]];
        const [x, y] = [circumcenters[2 * from], circumcenters[2 * from + 1]];
        if (other !== -1) {
            const to = Math.trunc(other / 3);
            return this.#clipped(x, y, circumcenters[2 * to] - x, circumcenters[2 * to + 1] - y, 1);
        }
        const [a, b] = [2 * triangles[e], 2 * triangles[e % 3 === 2 ? e - 2 : e + 1]];
        return this.#clipped(x, y, points[a + 1] - points[b + 1], points[b] - points[a], Infinity);
    }

    /** Of the places (x, y) + t (dx, dy), t from 0 to a greatest one, those in the rectangle. */
    #clipped(x, y, dx, dy, greatest) {
        if (!Number.isFinite(x + y) || !Number.isFinite(dx + dy)) return null;
        let [low, high] = [0, greatest];
        const sides = [[dx, this.xmin - x, this.xmax - x], [dy, this.ymin - y, this.ymax - y]];
        for (const [d, least, most] of sides) {
            if (d === 0) {
                if (least > 0 || most < 0) return null;
            } else {
                low = Math.max(low, (d > 0 ? least : most) / d);
                high = Math.min(high, (d > 0 ? most : least) / d);
            }
        }
        if (!(low < high) || high === Infinity) return null;
        return [x + low * dx, y + low * dy, x + high * dx, y + high * dy];
    }

    render(context) {
        const { halfedges, hull, points } = this.delaunay;
        if (hull.length <= 1) return null;
        return drawn(context, (to) => {
            const draw = (edge) => {
                if (edge === null) return;
                to.moveTo(edge[0], edge[1]);
                to.lineTo(edge[2], edge[3]);
            };
            for (let e = 0; e < halfedges.length; e++) {
                if (halfedges[e] === -1 || halfedges[e] > e) draw(this.#edge(e));
            }
            // Points on a line: a bisector between each and the next one.
            for (let k = 1; halfedges.length === 0 && k < hull.length; k++) {
                const [a, b] = [2 * hull[k - 1], 2 * hull[k]];
                const [dx, dy] = [points[a + 1] - points[b + 1], points[b] - points[a]];
                const [x, y] = [(points[a] + points[b]) / 2, (points[a + 1] + points[b + 1]) / 2];
                const reach = 2 * Math.hypot(this.xmax - this.xmin, this.ymax - this.ymin, x, y) / Math.hypot(dx, dy);
                draw(this.#clipped(x - reach * dx, y - reach * dy, 2 * reach * dx, 2 * reach * dy, 1));
            }
        });
    }

    renderBounds(context) {
        return drawn(context, (to) => to.rect(this.xmin, this.ymin, this.xmax - this.xmin, this.ymax - this.ymin));
    }

    renderCell(i, context) {
        const cell = this.#cell(i);
        return cell === null ? undefined : drawn(context, (to) => drawPolygon(to, cell));
    }

    *cellPolygons() {
        for (let i = 0; 2 * i + 1 < this.delaunay.points.length; i++) {
            const polygon = this.cellPolygon(i);
            if (polygon !== null) yield Object.assign(polygon, { index: i });
        }
    }

    cellPolygon(i) {
        const cell = this.#cell(i);
        return cell === null ? null : closed(cell);
    }

    contains(i, x, y) {
        const [px, py] = [+x, +y];
        if (!Number.isFinite(px) || !Number.isFinite(py)) return false;
        const { points } = this.delaunay;
        if (!this.#isShown(i)) return false;
        const j = this.delaunay.find(px, py);
        const distance = (k) => (points[2 * k] - px) ** 2 + (points[2 * k + 1] - py) ** 2;
        return distance(i) <= distance(j);
    }

    /** The points whose cells share an edge with that of a point, within the rectangle. */
    *neighbors(i) {
        const { delaunay } = this;
        const { triangles, halfedges, inedges } = delaunay;
        if (triangles.length === 0) {
            for (const j of delaunay.neighbors(i)) {
                if (this.#cell(i) !== null && this.#cell(j) !== null) yield j;
            }
            return;
        }
        const first = inedges[i];
        if (first === -1) return;
        let e = first;
        do {
            if (this.#edge(e) !== null) yield triangles[e];
            const out = e % 3 === 2 ? e - 2 : e + 1;
            e = halfedges[out];
            if (e === -1 && this.#edge(out) !== null) yield triangles[out % 3 === 2 ? out - 2 : out + 1];
        } while (e !== first && e !== -1);
    }

    /** Whether a point represents its place, and so has a cell. */
    #isShown(i) {
        const { inedges, halfedges, hull } = this.delaunay;
        return halfedges.length === 0 ? hull.includes(i) : inedges[i] !== -1;
    }

    /** The polygon of a cell within the rectangle, counter-clockwise where y goes up; null if nothing is left. */
    #cell(i) {
        const { points, inedges, halfedges } = this.delaunay;
        if (!this.#isShown(i)) return null;
        const first = inedges[i];
        let cell = halfedges.length === 0 || halfedges[first] === -1 ? null : this.#around(first);
        if (cell === null) {
            cell = [this.xmax, this.ymin, this.xmax, this.ymax, this.xmin, this.ymax, this.xmin, this.ymin];
            const [x, y] = [points[2 * i], points[2 * i + 1]];
            for (const j of this.delaunay.neighbors(i)) {
                const [dx, dy] = [points[2 * j] - x, points[2 * j + 1] - y];
                cell = clip(cell, dx, dy, dx * (x + dx / 2) + dy * (y + dy / 2));
            }
        } else {
            cell = clip(cell, 1, 0, this.xmax);
            cell = clip(cell, -1, 0, -this.xmin);
            cell = clip(cell, 0, 1, this.ymax);
            cell = clip(cell, 0, -1, -this.ymin);
        }
        return cell.length < 6 ? null : cell;
    }

    /** The circumcentres around the end of a half-edge, each place once in a row; null if one is not finite. */
    #around(first) {
        const { halfedges } = this.delaunay;
        const { circumcenters } = this;
        const cell = [];
        let e = first;
        do {
            const k = 2 * Math.trunc(e / 3);
            const [x, y] = [circumcenters[k], circumcenters[k + 1]];
            if (!Number.isFinite(x) || !Number.isFinite(y)) return null;
            if (cell.at(-2) !== x || cell.at(-1) !== y) cell.push(x, y);
            e = halfedges[e % 3 === 2 ? e - 2 : e + 1];
        } while (e !== first);
        while (cell.length > 2 && cell[0] === cell.at(-2) && cell[1] === cell.at(-1)) cell.length -= 2;
        return cell;
    }
}

/** What of a convex polygon is where nx x + ny y is at most an offset. */
function clip(polygon, nx, ny, offset) {
    const n = polygon.length;
    const over = new Float64Array(n / 2);
    let isCut = false;
    for (let k = 0; k < n; k += 2) {
        over[k / 2] = nx * polygon[k] + ny * polygon[k + 1] - offset;
        isCut ||= over[k / 2] > 0;
    }
    if (!isCut) return polygon;
    const left = [];
    for (let k = 0; k < n; k += 2) {
        const [m, before, here] = [(k + n - 2) % n, over[(k / 2 + n / 2 - 1) % (n / 2)], over[k / 2]];
        if (before > 0 && here < 0 || before < 0 && here > 0) {
            const t = before / (before - here);
            // Along a side of the rectangle exactly.
            left.push(
                nx !== 0 && ny === 0 ? offset / nx : polygon[m] + t * (polygon[k] - polygon[m]),
                nx === 0 && ny !== 0 ? offset / ny : polygon[m + 1] + t * (polygon[k + 1] - polygon[m + 1]),
            );
        }
        if (here <= 0) left.push(polygon[k], polygon[k + 1]);
    }
    return left;
}
