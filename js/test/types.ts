// Compiled, not run: what a program in TypeScript writes.

import Default, {
    Delaunator, Delaunay, DeldriftError, Triangulation, Voronoi, version, type Changes,
} from "../index.js";

const delaunay = Delaunay.from([[0, 0], [1, 0], [0, 1]]);
const named: Delaunay = Delaunay.from([{ x: 1, y: 2 }], (p) => p.x, (p) => p.y);
const voronoi: Voronoi = delaunay.voronoi([0, 0, 1, 1]);
for (const polygon of voronoi.cellPolygons()) polygon[0][1] + polygon.index;
const path: string | null = delaunay.render();
const flat = new Delaunator([0, 0, 1, 1]);
const same: Default<number[]> = flat;
const t = new Triangulation(3, new Float32Array(12), { weights: [1, 2, 3, 4], algorithm: "repair" });
const flips: number = t.move(new Float64Array(12)).flips;
const changes: Changes = t.takeChanges();
try {
    t.insert([0, 0, 0]);
} catch (error) {
    if (error instanceof DeldriftError) error.code.toLowerCase();
}
// @ts-expect-error: there is no fourth dimension.
new Triangulation(4, []);
export { changes, flips, named, path, same, version };
