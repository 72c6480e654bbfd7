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

    #reserve(count) {
        if (3 * count <= this.#triangles.length) return;
        const [triangles, halfedges] = [new Uint32Array(3 * count + 60), new Int32Array(3 * count + 60)];
        triangles.set(this.#triangles);
        halfedges.set(this.#halfedges);
        [this.#triangles, this.#halfedges] = [triangles, halfedges];
    }

    /** Brings the arrays up to date with cells, most of which may be those of before. */
    follow({ count, vertices, neighbours }) {
        this.#reserve(count);
        const [triangles, halfedges, before] = [this.#triangles, this.#halfedges, this.#count];
        const changed = [];
        for (let cell = 0, e = 0; cell < count; cell++, e += 3) {
            const [a, c, b] = [vertices[e], vertices[e + 1], vertices[e + 2]];
            if (
                cell < before && triangles[e] === a && triangles[e + 1] === b && triangles[e + 2] === c
                && isHalfOf(halfedges[e], neighbours[e + 1]) && isHalfOf(halfedges[e + 1], neighbours[e])
                && isHalfOf(halfedges[e + 2], neighbours[e + 2])
            ) continue;
            triangles[e] = a;
            triangles[e + 1] = b;
            triangles[e + 2] = c;
            changed.push(cell);
        }
        this.#count = count;
        // A cell that is as before may have a neighbour whose corners have another order.
        for (const cell of changed) {
            for (let j = 0; j < 3; j++) {
                const e = 3 * cell + EXCHANGED[j];
                const beyond = neighbours[3 * cell + j];
                if (beyond === NONE) {
                    halfedges[e] = -1;
                    continue;
                }
                const row = 3 * beyond;
                const mirror = neighbours[row] === cell ? 0 : neighbours[row + 1] === cell ? 1 : 2;
                const other = row + EXCHANGED[mirror];
                halfedges[e] = other;
                halfedges[other] = e;
            }
        }
    }
}

/** Whether a half-edge belongs to a cell, or to none where there is none. */
function isHalfOf(halfedge, cell) {
    return halfedge < 0 ? cell === NONE : Math.trunc(halfedge / 3) === cell;
}
