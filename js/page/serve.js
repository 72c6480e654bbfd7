// Serves the page to this machine: node page/serve.js [PORT]
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const types = {
    ".css": "text/css", ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript",
    ".wasm": "application/wasm",
};

/** A server of the package's folder, on a port, or any free one for 0. */
export function serve(port) {
    const server = createServer(async ({ url }, response) => {
        const path = normalize(decodeURIComponent(new URL(url, "http://localhost").pathname));
        try {
            const body = await readFile(join(root, path.endsWith("/") ? `${path}index.html` : path));
            const type = types[extname(path) || ".html"] ?? "application/octet-stream";
            response.writeHead(200, { "Content-Type": type }).end(body);
        } catch {
            response.writeHead(404).end("not found");
        }
    });
    return new Promise((resolve) => {
        server.listen(port, "127.0.0.1", () => resolve(server));
    });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
    const server = await serve(Number(process.argv[2] ?? 8000));
    console.log(`http://localhost:${server.address().port}/page/ (Ctrl-C ends it)`);
}
