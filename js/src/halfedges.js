// Cells of the plane as Delaunator has them: `triangles` in rows of three vertices, clockwise where y goes up, and
// `halfedges`, of which entry e is the other half of the edge from corner e to the next one, -1 on the hull.
//
// A row of deldrift is counter-clockwise; its last two corners are exchanged. Corner j of the one is then opposite the
// half-edge EXCHANGED[j] of the other, and the reverse.

const EXCHANGED = [1, 0, 2];
const NONE = 0xffff_ffff;

export class Halfedges {
    #triangles = new Uint32Array(0);
    #halfedges = new Int32Array(0);
    #count = 0;
    // The rows that the arrays have been made of. A list of changes would not do: a cell whose corners have another
    // order is in none.
    #vertices = new Uint32Array(0);
    #neighbours = new Uint32Array(0);

    get triangles() {
        return this.#triangles.subarray(0, 3 * this.#count);
    }

    get halfedges() {
        return this.#halfedges.subarray(0, 3 * this.#count);
    }

    /** Makes room for so many entries. */
    #reserve(length) {
        if (length <= this.#triangles.length) return;
        const longer = (array) => {
            const copy = new array.constructor(length + (length >> 4));
            copy.set(array);
            return copy;
        };
        this.#triangles = longer(this.#triangles);
        this.#halfedges = longer(this.#halfedges);
        this.#vertices = longer(this.#vertices);
        this.#neighbours = longer(this.#neighbours);
    }

    /** Brings the arrays up to date with cells, most of which may be those of before. */
    follow({ count, vertices, neighbours }) {
        this.#reserve(3 * count);
        const both = 3 * Math.min(count, this.#count);
        this.#count = count;
        const changed = changedRows(vertices, neighbours, this.#vertices, this.#neighbours, both);
        for (const e of changed) this.#take(e, vertices, neighbours);
        for (let e = both; e < 3 * count; e += 3) this.#take(e, vertices, neighbours);
        for (const e of changed) this.#join(e);
        for (let e = both; e < 3 * count; e += 3) this.#join(e);
    }

    #take(e, vertices, neighbours) {
        for (let k = e; k < e + 3; k++) {
            this.#vertices[k] = vertices[k];
            this.#neighbours[k] = neighbours[k];
        }
        this.#triangles[e] = vertices[e];
        this.#triangles[e + 1] = vertices[e + 2];
        this.#triangles[e + 2] = vertices[e + 1];
    }

    /** Joins the half-edges of a row with those beyond: in rows that are as before these may be others, too. */
    #join(e) {
        const [neighbours, halfedges] = [this.#neighbours, this.#halfedges];
        const cell = e / 3;
        for (let j = 0; j < 3; j++) {
            const half = e + EXCHANGED[j];
            const beyond = neighbours[e + j];
            if (beyond === NONE) {
                halfedges[half] = -1;
                continue;
            }
            const row = 3 * beyond;
            const mirror = neighbours[row] === cell ? 0 : neighbours[row + 1] === cell ? 1 : 2;
            const other = row + EXCHANGED[mirror];
            halfedges[half] = other;
            halfedges[other] = half;
        }
    }
}

/** Where rows begin that are others than before, among the first ones. */
function changedRows(vertices, neighbours, oldVertices, oldNeighbours, length) {
    const changed = [];
    for (let e = 0; e < length; e += 3) {
        if (
            vertices[e] !== oldVertices[e] || vertices[e + 1] !== oldVertices[e + 1]
            || vertices[e + 2] !== oldVertices[e + 2] || neighbours[e] !== oldNeighbours[e]
            || neighbours[e + 1] !== oldNeighbours[e + 1] || neighbours[e + 2] !== oldNeighbours[e + 2]
        ) changed.push(e);
    }
    return changed;
}
