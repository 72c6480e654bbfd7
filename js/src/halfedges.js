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
    }

    /** Brings the arrays up to date with cells, most of which may be those of before. */
    follow({ count, vertices, neighbours }) {
        this.#reserve(3 * count);
        const [triangles, halfedges] = [this.#triangles, this.#halfedges];
        const [before, after] = [3 * this.#count, 3 * count];
        const both = Math.min(before, after);
        this.#count = count;
        // A list of changes would not do: a cell whose corners have another order is in none.
        const changed = takeChanged(vertices, triangles, both);
        for (let e = both; e < after; e += 3) takeRow(e, vertices, triangles);
        // What was beyond is so still, or is joined to a row that has changed, or is on the hull now.
        for (const e of changed) leaveRow(e, halfedges);
        for (let e = both; e < before; e += 3) leaveRow(e, halfedges);
        for (const e of changed) joinRow(e, neighbours, halfedges);
        for (let e = both; e < after; e += 3) joinRow(e, neighbours, halfedges);
    }
}

function takeRow(e, vertices, triangles) {
    triangles[e] = vertices[e];
    triangles[e + 1] = vertices[e + 2];
    triangles[e + 2] = vertices[e + 1];
}

/** Takes over the rows that are others than before, of the first ones, and tells where they begin. */
function takeChanged(vertices, triangles, length) {
    const changed = [];
    for (let e = 0; e < length; e += 3) {
        const f = e + 1;
        const g = e + 2;
        if (vertices[e] === triangles[e] && vertices[f] === triangles[g] && vertices[g] === triangles[f]) continue;
        takeRow(e, vertices, triangles);
        changed.push(e);
    }
    return changed;
}

/** Takes the half-edges of a row from those beyond. */
function leaveRow(e, halfedges) {
    for (let half = e; half < e + 3; half++) {
        if (halfedges[half] !== -1) halfedges[halfedges[half]] = -1;
    }
}

/** Joins the half-edges of a row with those beyond. */
function joinRow(e, neighbours, halfedges) {
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
