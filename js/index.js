// Exact Delaunay triangulations of moving points: docs/JAVASCRIPT.md.
export { Delaunator, Delaunator as default } from "./src/delaunator.js";
export { Delaunay } from "./src/delaunay.js";
export { DeldriftError, version } from "./src/library.js";
export { Triangulation } from "./src/triangulation.js";
export { Voronoi } from "./src/voronoi.js";
