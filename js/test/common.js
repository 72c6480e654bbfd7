// What the tests share: random numbers that are the same in every run, and cells to be compared.

export class Random {
    #state;

    constructor(seed) {
        this.#state = seed >>> 0;
    }

    /** A number from 0 to 1. */
    unit() {
        this.#state = (Math.imul(this.#state, 1664525) + 1013904223) >>> 0;
        return this.#state / 2 ** 32;
    }

    points(count, dimension = 2) {
        return Float64Array.from({ length: count * dimension }, () => this.unit());
    }
}

/** Moves each coordinate by up to a size in either direction. */
export function shaken(points, size, random) {
    return points.map((x) => x + size * (2 * random.unit() - 1));
}

/** Rows as text, whatever the order of rows and of their entries. */
export function setOfRows(entries, length) {
    const rows = [];
    for (let k = 0; k < entries.length; k += length) {
        rows.push(Array.from(entries.slice(k, k + length)).sort((a, b) => a - b).join(" "));
    }
    return rows.sort();
}

/** Numbers near each other, by a share of the greatest. */
export function areNear(a, b, share = 1e-9) {
    return Math.abs(a - b) <= share * Math.max(1, Math.abs(a), Math.abs(b));
}
