// Triangulations in the plane and in space whose vertices move: the functions of C, with arrays of JavaScript.

import {
    DeldriftError, bytes, check, doublesAt, inFrame, longAt, triangulations, wasm, words, wordsAt,
} from "./library.js";

const algorithms = { auto: 0, rebuilding: 1, placement: 2, tolerance: 3, repair: 4 };
const coincidences = { merge: 0, reject: 1 };
const passings = { ignore: 0, tell: 1, refuse: 2 };
const locations = ["vertex", "cell", "outside", "no cells"];

const NONE = 0xffff_ffff;

// Bytes of the structures of C, with pointers of 32 bits.
const VIEW = 16;
const OPTIONS = 36;
const REPORT = 160;
const CHANGES = 72;

const counts = [
    "timestamp", "moved", "unchanged", "placements", "flips", "rebuilds", "coincident", "withinTolerance", "tolerances",
    "certificates", "exactCalls", "inserted", "removed", "reweighted", "hiddenByWeight", "newlyHidden", "newlyShown",
];

function reportAt(start) {
    return Object.fromEntries(counts.map((name, k) => [name, longAt(start + 8 * k)]));
}

function oneOf(choices, name, value) {
    if (!(value in choices)) throw new DeldriftError("INVALID_OPTIONS", `${name} ${value} is unknown`);
    return choices[value];
}

function optionsIn(frame, { algorithm = "auto", coincidence = "merge", passing = "ignore" }) {
    const start = frame.room(OPTIONS);
    words().fill(0, start / 4, (start + OPTIONS) / 4);
    words()[start / 4] = OPTIONS;
    words()[start / 4 + 1] = oneOf(algorithms, "algorithm", algorithm);
    words()[start / 4 + 3] = oneOf(coincidences, "coincidence", coincidence);
    words()[start / 4 + 4] = oneOf(passings, "passing", passing);
    return start;
}

export class Triangulation {
    #pointer;
    #dimension;

    /**
     * The Delaunay triangulation of points, which are contiguous: x0, y0, x1, y1, ... or x0, y0, z0, x1, ...
     * With weights, one for each point, it is the regular triangulation.
     */
    constructor(dimension, positions, options = {}) {
        const pointer = options instanceof Made ? options.pointer : inFrame((frame) => {
            if (dimension !== 2 && dimension !== 3) {
                throw new DeldriftError("INVALID_DIMENSION", `dimension is ${dimension}, but must be 2 or 3`);
            }
            const count = rows(positions, dimension);
            const [places, settings, out] = [frame.doubles(positions), optionsIn(frame, options), frame.room(4)];
            if (options.weights === undefined) {
                check(wasm.deldrift_create(dimension, places, count, settings, out));
            } else {
                sameLength(options.weights, count, "weights");
                const weights = frame.doubles(options.weights);
                check(wasm.deldrift_create_weighted(dimension, places, weights, 0, count, settings, out));
            }
            return words()[out / 4];
        });
        this.#pointer = pointer;
        triangulations.register(this, pointer, this);
        this.#dimension = this.#number((out) => wasm.deldrift_dimension(pointer, out));
    }

    /** The triangulation that `save` has written. */
    static load(data, options = {}) {
        return inFrame((frame) => {
            const start = frame.room(data.length);
            bytes().set(data, start);
            const [settings, out] = [optionsIn(frame, options), frame.room(4)];
            check(wasm.deldrift_load(start, data.length, settings, out));
            return new Triangulation(0, [], new Made(words()[out / 4]));
        });
    }

    /** An independent copy. */
    clone() {
        return new Triangulation(0, [], new Made(this.#number((out) => wasm.deldrift_clone(this.#alive, out))));
    }

    /** All that there is of it, as bytes that `load` reads, here or on any other machine. */
    save() {
        return inFrame((frame) => {
            const out = frame.room(4);
            check(wasm.deldrift_save(this.#alive, 0, 0, out));
            const size = words()[out / 4];
            const start = frame.room(size);
            check(wasm.deldrift_save(this.#alive, start, size, out));
            return bytes().slice(start, start + size);
        });
    }

    /** Frees its memory. Without this that happens some time after nothing refers to it any more. */
    destroy() {
        if (this.#pointer === 0) return;
        triangulations.unregister(this);
        wasm.deldrift_destroy(this.#pointer);
        this.#pointer = 0;
    }

    get #alive() {
        if (this.#pointer === 0) throw new DeldriftError("NULL_ARGUMENT", "the triangulation has been destroyed");
        return this.#pointer;
    }

    /** A 32-bit number that a call writes. */
    #number(call) {
        return inFrame((frame) => {
            const out = frame.room(4);
            check(call(out));
            return words()[out / 4];
        });
    }

    /** A list of rows of which the call tells the number. */
    #list(length, call) {
        return inFrame((frame) => {
            const out = frame.room(4);
            check(call(0, 0, out));
            const count = words()[out / 4];
            const start = frame.room(4 * length * count);
            check(call(start, count, out));
            return wordsAt(start, length * count);
        });
    }

    /** Doubles in rows, of which there are as many as this says. */
    #doubles(count, length, call) {
        return inFrame((frame) => {
            const [out, start] = [frame.room(4), frame.room(8 * length * count)];
            check(call(start, count, out));
            return doublesAt(start, length * count);
        });
    }

    #place(frame, position) {
        sameLength(position, this.#dimension, "coordinates");
        return frame.doubles(position);
    }

    /** 2 or 3. */
    get dimension() {
        return this.#dimension;
    }

    /** How many ids of vertices there are, those of removed vertices included. */
    get idCount() {
        return this.#number((out) => wasm.deldrift_id_count(this.#alive, out));
    }

    /** How many vertices are present. */
    get vertexCount() {
        return this.#number((out) => wasm.deldrift_vertex_count(this.#alive, out));
    }

    /** How many triangles or tetrahedra there are. */
    get cellCount() {
        return this.#number((out) => wasm.deldrift_cell_count(this.#alive, out));
    }

    /** The bytes of memory that it holds. */
    get memoryBytes() {
        return this.#number((out) => wasm.deldrift_memory_bytes(this.#alive, out));
    }

    /** The number of the timestamp: 0 at creation, one more after each commit. */
    get timestamp() {
        return inFrame((frame) => {
            const out = frame.room(8);
            check(wasm.deldrift_timestamp(this.#alive, out));
            return longAt(out);
        });
    }

    /** What all commits so far have done, in sum. */
    get statistics() {
        return this.#report((report) => wasm.deldrift_statistics(this.#alive, report));
    }

    /** How commits are made: "auto", unless another algorithm has been chosen. The cells are the same by all. */
    get algorithm() {
        const found = this.#number((out) => wasm.deldrift_get_algorithm(this.#alive, out));
        return Object.keys(algorithms)[found];
    }

    set algorithm(name) {
        check(wasm.deldrift_set_algorithm(this.#alive, oneOf(algorithms, "algorithm", name)));
    }

    /** The positions of all ids; NaN for removed vertices. */
    positions() {
        return this.#doubles(this.idCount, this.#dimension, (...room) =>
            wasm.deldrift_copy_positions(this.#alive, ...room));
    }

    /** The weights of all ids, if it has weights. */
    weights() {
        return this.#doubles(this.idCount, 1, (...room) => wasm.deldrift_weights(this.#alive, ...room));
    }

    /** Whether there is a vertex of this id. */
    isPresent(vertex) {
        return (this.#number((out) => wasm.deldrift_is_present(this.#alive, id(vertex), out)) & 255) !== 0;
    }

    /**
     * The cells without a copy: rows of vertices, counter-clockwise in the plane, and of neighbours, of which entry i
     * is opposite vertex i, 0xffffffff on the hull. The arrays are valid until the next call of deldrift.
     */
    cells() {
        return inFrame((frame) => {
            const view = frame.room(VIEW);
            check(wasm.deldrift_cells(this.#alive, view));
            const [count, corners, vertices, neighbours] = words().subarray(view / 4, view / 4 + 4);
            const at = (start) => words().subarray(start / 4, start / 4 + corners * count);
            return { count, corners, vertices: at(vertices), neighbours: at(neighbours) };
        });
    }

    /** A copy of the cells, which stays. */
    copyCells() {
        const { count, corners, vertices, neighbours } = this.cells();
        return { count, corners, vertices: vertices.slice(), neighbours: neighbours.slice() };
    }

    #report(call) {
        return inFrame((frame) => {
            const report = frame.room(REPORT);
            check(call(report));
            return reportAt(report);
        });
    }

    /** Moves all vertices, and makes that the next timestamp. With weights, these change as well. */
    move(positions, weights) {
        return inFrame((frame) => {
            const count = rows(positions, this.#dimension);
            const [places, report] = [frame.doubles(positions), frame.room(REPORT)];
            if (weights === undefined) {
                check(wasm.deldrift_commit_positions(this.#alive, places, count, report));
            } else {
                sameLength(weights, count, "weights");
                check(wasm.deldrift_commit_weighted(this.#alive, places, frame.doubles(weights), count, report));
            }
            return reportAt(report);
        });
    }

    /** Stages moves of some vertices for the next `commit`. */
    stageMoves(vertices, positions) {
        inFrame((frame) => {
            sameLength(vertices, rows(positions, this.#dimension), "vertices");
            const [list, places] = [frame.words(ids(vertices)), frame.doubles(positions)];
            check(wasm.deldrift_move_vertices(this.#alive, list, places, vertices.length));
        });
    }

    /** Stages the insertion of vertices; the id of the first one, which the others follow. */
    stageInsertions(positions) {
        return inFrame((frame) => {
            const [places, out] = [frame.doubles(positions), frame.room(4)];
            check(wasm.deldrift_stage_insertions(this.#alive, places, rows(positions, this.#dimension), out));
            return words()[out / 4];
        });
    }

    /** Stages the removal of vertices. */
    stageRemovals(vertices) {
        inFrame((frame) => {
            check(wasm.deldrift_stage_removals(this.#alive, frame.words(ids(vertices)), vertices.length));
        });
    }

    /** Stages other weights of vertices. */
    stageWeights(vertices, weights) {
        inFrame((frame) => {
            sameLength(weights, vertices.length, "weights");
            const [list, numbers] = [frame.words(ids(vertices)), frame.doubles(weights)];
            check(wasm.deldrift_stage_weights(this.#alive, list, numbers, vertices.length));
        });
    }

    /** Stages segments, rows of two vertices, in the plane; the id of the first one, which the others follow. */
    stageSegments(ends) {
        return inFrame((frame) => {
            const out = frame.room(4);
            check(wasm.deldrift_stage_segments(this.#alive, frame.words(ids(ends)), 0, rows(ends, 2), out));
            return words()[out / 4];
        });
    }

    /** Stages the removal of segments. */
    stageSegmentRemovals(segments) {
        inFrame((frame) => {
            check(wasm.deldrift_stage_segment_removals(this.#alive, frame.words(ids(segments)), segments.length));
        });
    }

    /** Makes all that is staged the next timestamp. */
    commit() {
        return this.#report((report) => wasm.deldrift_commit_timestamp(this.#alive, report));
    }

    /** Forgets all that is staged. */
    discard() {
        check(wasm.deldrift_discard_moves(this.#alive));
    }

    /** Inserts a vertex at once, and tells its id. */
    insert(position) {
        return inFrame((frame) => {
            const [place, out] = [this.#place(frame, position), frame.room(4)];
            check(wasm.deldrift_insert_vertex(this.#alive, place, out));
            return words()[out / 4];
        });
    }

    /** Removes a vertex at once. */
    remove(vertex) {
        check(wasm.deldrift_remove_vertex(this.#alive, id(vertex)));
    }

    /** Moves one vertex at once. */
    relocate(vertex, position) {
        inFrame((frame) => check(wasm.deldrift_relocate_vertex(this.#alive, id(vertex), this.#place(frame, position))));
    }

    /** Gives one vertex another weight at once. */
    setWeight(vertex, weight) {
        check(wasm.deldrift_set_weight(this.#alive, id(vertex), weight));
    }

    /** What has changed since the last call of this; the first call lists all cells as created. */
    takeChanges() {
        return inFrame((frame) => {
            const start = frame.room(CHANGES);
            check(wasm.deldrift_take_changes(this.#alive, start));
            const field = (k) => words()[start / 4 + k];
            const list = (k, length = 1) => wordsAt(field(k + 1), length * field(k));
            return {
                created: list(0),
                removed: list(2),
                removedVertices: wordsAt(field(4), (this.#dimension + 1) * field(2)),
                renumberedFrom: list(5),
                renumberedTo: wordsAt(field(7), field(5)),
                stars: list(8),
                hidden: list(10),
                shown: list(12),
            };
        });
    }

    /** The cells that have a vertex as a corner. */
    star(vertex) {
        return this.#list(1, (...room) => wasm.deldrift_star(this.#alive, id(vertex), ...room));
    }

    /** The edges: rows of two vertices. */
    edges() {
        return this.#list(2, (...room) => wasm.deldrift_edges(this.#alive, ...room));
    }

    /** The facets of the convex hull: rows of two or three vertices. */
    hullFacets() {
        return this.#list(this.#dimension, (start, capacity, out) =>
            wasm.deldrift_hull_facets(this.#alive, start, 0, 0, capacity, out));
    }

    /** The vertices that are hidden, as another one is at their place. */
    hiddenVertices() {
        return this.#list(1, (start, capacity, out) =>
            wasm.deldrift_hidden_vertices(this.#alive, start, 0, capacity, out));
    }

    /** The vertices that are hidden by the weights of others. */
    hiddenByWeight() {
        return this.#list(1, (start, capacity, out) =>
            wasm.deldrift_hidden_by_weight(this.#alive, start, 0, capacity, out));
    }

    /** The vertex nearest to a position; -1 if there is none. */
    nearest(position) {
        return inFrame((frame) => {
            const [place, out] = [this.#place(frame, position), frame.room(4)];
            check(wasm.deldrift_nearest_vertex(this.#alive, place, out));
            return words()[out / 4] | 0;
        });
    }

    /** Where a position is, exactly: at a vertex, in a cell, or outside of the hull beyond a cell. */
    locate(position) {
        return inFrame((frame) => {
            const [place, out] = [this.#place(frame, position), frame.room(8)];
            check(wasm.deldrift_locate(this.#alive, place, out));
            const [kind, index] = words().subarray(out / 4, out / 4 + 2);
            return { kind: locations[kind], index: index | 0 };
        });
    }

    /** How far all vertices may move before a cell at this one changes. */
    tolerance(vertex) {
        return inFrame((frame) => {
            const out = frame.room(8);
            check(wasm.deldrift_tolerance(this.#alive, id(vertex), out));
            return doublesAt(out, 1)[0];
        });
    }

    /** The areas or volumes of the cells. */
    volumes() {
        return this.#doubles(this.cellCount, 1, (...room) => wasm.deldrift_volumes(this.#alive, ...room));
    }

    /** The centres of the circumcircles or circumspheres of the cells. */
    circumcentres() {
        return this.#doubles(this.cellCount, this.#dimension, (start, capacity, out) =>
            wasm.deldrift_circumcentres(this.#alive, start, 0, capacity, out));
    }

    /** The Voronoi cells of all ids, within a box if there is one: volumes, areas of their boundary, centroids. */
    voronoiCells(low, high) {
        return inFrame((frame) => {
            const count = this.idCount;
            const [from, to] = low === undefined ? [0, 0] : [this.#place(frame, low), this.#place(frame, high)];
            const [volumes, areas] = [frame.room(8 * count), frame.room(8 * count)];
            const [centroids, out] = [frame.room(8 * count * this.#dimension), frame.room(4)];
            check(wasm.deldrift_voronoi_cells(this.#alive, from, to, 0, 0, volumes, areas, centroids, count, out));
            return {
                volumes: doublesAt(volumes, count),
                areas: doublesAt(areas, count),
                centroids: doublesAt(centroids, count * this.#dimension),
            };
        });
    }

    /** The ids of the segments in force, and rows of their two ends. */
    segments() {
        const list = (length, call) => this.#list(length, call);
        return {
            segments: list(1, (start, capacity, out) =>
                wasm.deldrift_segments(this.#alive, start, 0, 0, capacity, out)),
            ends: list(2, (start, capacity, out) => wasm.deldrift_segments(this.#alive, 0, start, 0, capacity, out)),
        };
    }

    /** How many segments are between each cell and the outside; in a domain the number is odd. */
    nestingLevels() {
        return this.#list(1, (...room) => wasm.deldrift_nesting_levels(this.#alive, ...room));
    }

    /** Throws if anything is wrong with the cells, which would be a defect. */
    validate(level = 3) {
        check(wasm.deldrift_validate(this.#alive, level));
    }
}

/** A triangulation of the library that has none of JavaScript yet. */
class Made {
    constructor(pointer) {
        this.pointer = pointer;
    }
}

/** How many rows of numbers there are. */
function rows(values, length) {
    if (values.length % length === 0) return values.length / length;
    throw new DeldriftError("WRONG_COUNT", `${values.length} numbers are no rows of ${length}`);
}

/** What can name a vertex or a segment. WebAssembly would take what is no number for 0. */
function id(value) {
    if (Number.isInteger(value) && value >= 0 && value < NONE) return value;
    throw new DeldriftError("NO_SUCH_VERTEX", `${value} is no id`);
}

function ids(values) {
    if (!(values instanceof Uint32Array)) Array.prototype.forEach.call(values, id);
    return values;
}

function sameLength(values, length, name) {
    if (values.length === length) return;
    throw new DeldriftError("WRONG_COUNT", `there are ${values.length} ${name} and not ${length}`);
}
