/** Numbers by index. */
type Numbers = ArrayLike<number>;

/** What is drawn on: a CanvasRenderingContext2D, or anything with these. */
export interface DrawingContext {
    moveTo(x: number, y: number): void;
    lineTo(x: number, y: number): void;
    closePath(): void;
    arc(x: number, y: number, radius: number, from: number, to: number): void;
    rect(x: number, y: number, width: number, height: number): void;
}

export type Point = [number, number];
export type Polygon = Point[];
export type Bounds = [xmin: number, ymin: number, xmax: number, ymax: number];

/** The version of the library, as "major.minor.patch". */
export const version: string;

/** A call that has failed, and has had no effect. */
export class DeldriftError extends Error {
    /** The name of the status in deldrift.h, without DELDRIFT_. */
    readonly code: string;
    constructor(code: string, message: string, options?: ErrorOptions);
}

export type Algorithm = "auto" | "rebuilding" | "placement" | "tolerance" | "repair";

export interface Options {
    /** How commits are made; the cells are the same by all. "auto" by default. */
    algorithm?: Algorithm;
    /** Vertices at one place: the lowest id represents it ("merge", the default), or the call is refused. */
    coincidence?: "merge" | "reject";
    /** Vertices that would pass a segment. "ignore" by default. */
    passing?: "ignore" | "tell" | "refuse";
}

/** What a commit did. */
export interface Report {
    timestamp: number;
    moved: number;
    unchanged: number;
    placements: number;
    flips: number;
    rebuilds: number;
    coincident: number;
    withinTolerance: number;
    tolerances: number;
    certificates: number;
    exactCalls: number;
    inserted: number;
    removed: number;
    reweighted: number;
    hiddenByWeight: number;
    newlyHidden: number;
    newlyShown: number;
}

export interface Cells {
    /** How many there are. */
    count: number;
    /** 3 in the plane, 4 in space. */
    corners: number;
    /** Rows of vertices. */
    vertices: Uint32Array;
    /** Rows of cells: entry i is beyond the facet opposite vertex i, 0xffffffff on the hull. */
    neighbours: Uint32Array;
}

export interface Changes {
    /** Cells that exist and did not. */
    created: Uint32Array;
    /** Cells that existed and do not, by their index of that time, and rows of their vertices. */
    removed: Uint32Array;
    removedVertices: Uint32Array;
    /** Cells that existed under another index. */
    renumberedFrom: Uint32Array;
    renumberedTo: Uint32Array;
    /** Vertices of created and removed cells. */
    stars: Uint32Array;
    /** Vertices that are hidden, as another one is at their place, and were not; and the reverse. */
    hidden: Uint32Array;
    shown: Uint32Array;
}

/** The Delaunay triangulation of points in the plane or in space that move. */
export class Triangulation {
    /** Positions are contiguous: x0, y0, x1, ... or x0, y0, z0, ... With weights it is the regular triangulation. */
    constructor(dimension: 2 | 3, positions: Numbers, options?: Options & { weights?: Numbers });
    /** The triangulation that `save` has written. */
    static load(data: Uint8Array, options?: Options): Triangulation;

    readonly dimension: 2 | 3;
    readonly idCount: number;
    readonly vertexCount: number;
    readonly cellCount: number;
    readonly memoryBytes: number;
    readonly timestamp: number;
    readonly statistics: Report;
    algorithm: Algorithm;

    clone(): Triangulation;
    save(): Uint8Array;
    /** Frees its memory at once. */
    destroy(): void;

    /** Moves all vertices, and makes that the next timestamp. */
    move(positions: Numbers, weights?: Numbers): Report;
    stageMoves(vertices: Numbers, positions: Numbers): void;
    stageInsertions(positions: Numbers): number;
    stageRemovals(vertices: Numbers): void;
    stageWeights(vertices: Numbers, weights: Numbers): void;
    stageSegments(ends: Numbers): number;
    stageSegmentRemovals(segments: Numbers): void;
    /** Makes all that is staged the next timestamp. */
    commit(): Report;
    discard(): void;

    insert(position: Numbers): number;
    remove(vertex: number): void;
    relocate(vertex: number, position: Numbers): void;
    setWeight(vertex: number, weight: number): void;

    /** Without a copy: valid until the next call of deldrift. */
    cells(): Cells;
    copyCells(): Cells;
    takeChanges(): Changes;
    positions(): Float64Array;
    weights(): Float64Array;
    isPresent(vertex: number): boolean;
    star(vertex: number): Uint32Array;
    edges(): Uint32Array;
    hullFacets(): Uint32Array;
    hiddenVertices(): Uint32Array;
    hiddenByWeight(): Uint32Array;
    nearest(position: Numbers): number;
    locate(position: Numbers): { kind: "vertex" | "cell" | "outside" | "no cells"; index: number };
    tolerance(vertex: number): number;
    volumes(): Float64Array;
    circumcentres(): Float64Array;
    voronoiCells(low?: Numbers, high?: Numbers): {
        volumes: Float64Array;
        areas: Float64Array;
        centroids: Float64Array;
    };
    segments(): { segments: Uint32Array; ends: Uint32Array };
    nestingLevels(): Uint32Array;
    validate(level?: 1 | 2 | 3): void;
}

/** The names of Delaunator. */
export class Delaunator<T extends Numbers = Float64Array> {
    static from<P = Numbers>(points: ArrayLike<P>, getX?: (p: P) => number, getY?: (p: P) => number): Delaunator;
    constructor(coords: T);
    coords: T;
    readonly triangles: Uint32Array;
    readonly halfedges: Int32Array;
    readonly hull: Uint32Array;
    readonly trianglesLen: number;
    readonly triangulation: Triangulation;
    update(): void;
    move(points: Numbers): void;
}
export default Delaunator;

/** The names of d3-delaunay. */
export class Delaunay<T extends Numbers = Float64Array> {
    static from<P = Numbers>(
        points: ArrayLike<P> | Iterable<P>,
        fx?: (p: P, i: number, points: ArrayLike<P> | Iterable<P>) => number,
        fy?: (p: P, i: number, points: ArrayLike<P> | Iterable<P>) => number,
        that?: unknown,
    ): Delaunay;
    constructor(points: T);
    points: T;
    readonly triangles: Uint32Array;
    readonly halfedges: Int32Array;
    readonly hull: Uint32Array;
    readonly inedges: Int32Array;
    readonly collinear: Int32Array | undefined;
    readonly triangulation: Triangulation;
    update(): this;
    move(points: Numbers): this;
    find(x: number, y: number, i?: number): number;
    neighbors(i: number): IterableIterator<number>;
    voronoi(bounds?: Bounds): Voronoi<T>;
    render(): string | null;
    render(context: DrawingContext): void;
    renderHull(): string | null;
    renderHull(context: DrawingContext): void;
    renderPoints(r?: number): string | null;
    renderPoints(context: DrawingContext | null | undefined, r?: number): string | null | void;
    renderTriangle(i: number): string | null;
    renderTriangle(i: number, context: DrawingContext): void;
    hullPolygon(): Polygon | null;
    trianglePolygon(i: number): Polygon;
    trianglePolygons(): IterableIterator<Polygon>;
}

export class Voronoi<T extends Numbers = Float64Array> {
    constructor(delaunay: Delaunay<T>, bounds?: Bounds);
    readonly delaunay: Delaunay<T>;
    readonly circumcenters: Float64Array;
    readonly vectors: Float64Array;
    xmin: number;
    ymin: number;
    xmax: number;
    ymax: number;
    update(): this;
    contains(i: number, x: number, y: number): boolean;
    neighbors(i: number): IterableIterator<number>;
    cellPolygon(i: number): Polygon | null;
    cellPolygons(): IterableIterator<Polygon & { index: number }>;
    render(): string | null;
    render(context: DrawingContext): void;
    renderBounds(): string | null;
    renderBounds(context: DrawingContext): void;
    renderCell(i: number): string | null | undefined;
    renderCell(i: number, context: DrawingContext): void;
}
