// Chromium without a window, driven through a pipe by its DevTools protocol.

import { spawn } from "node:child_process";
import { accessSync, constants } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";

function isProgram(path) {
    try {
        accessSync(path, constants.X_OK);
        return true;
    } catch {
        return false;
    }
}

/** Where Chromium is, if it is there. */
export const chromium = (process.env.PATH ?? "").split(delimiter)
    .flatMap((folder) => ["chromium", "chromium-browser", "google-chrome"].map((name) => join(folder, name)))
    .find(isProgram);

/** A browser with one page. */
export class Browser {
    #process;
    #profile;
    #session;
    #waiting = new Map();
    #sent = 0;
    /** What the page has complained of: lines of its console, and errors that nothing has caught. */
    complaints = [];

    static async start() {
        const browser = new Browser();
        await browser.#start();
        return browser;
    }

    async #start() {
        this.#profile = await mkdtemp(join(tmpdir(), "deldrift-page-"));
        const flags = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
            "--remote-debugging-pipe", `--user-data-dir=${this.#profile}`, "--window-size=1140,860", "about:blank"];
        this.#process = spawn(chromium, flags, { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
        let text = "";
        this.#process.stdio[4].setEncoding("utf8").on("data", (data) => {
            const messages = (text + data).split("\0");
            text = messages.pop();
            messages.forEach((message) => this.#hear(JSON.parse(message)));
        });
        const { targetInfos } = await this.#ask("Target.getTargets");
        const { targetId } = targetInfos.find(({ type }) => type === "page");
        this.#session = (await this.#ask("Target.attachToTarget", { targetId, flatten: true })).sessionId;
        await this.#ask("Runtime.enable");
        await this.#ask("Log.enable");
    }

    #ask(method, params = {}) {
        const id = ++this.#sent;
        const message = { id, method, params, ...(this.#session && { sessionId: this.#session }) };
        this.#process.stdio[3].write(`${JSON.stringify(message)}\0`);
        return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
    }

    #hear({ id, result, error, method, params }) {
        if (id !== undefined) {
            const { resolve, reject } = this.#waiting.get(id);
            this.#waiting.delete(id);
            if (error) reject(new Error(error.message));
            else resolve(result);
        }
        if (method === "Runtime.consoleAPICalled") {
            this.complaints.push(params.args.map(({ value }) => value).join(" "));
        }
        if (method === "Runtime.exceptionThrown") this.complaints.push(params.exceptionDetails.exception?.description);
        if (method === "Log.entryAdded") this.complaints.push(`${params.entry.text} ${params.entry.url ?? ""}`);
    }

    async visit(address) {
        // Another part of the same page would not be loaded again.
        await this.#ask("Page.navigate", { url: "about:blank" });
        this.complaints = [];
        await this.#ask("Page.navigate", { url: address });
    }

    /** The value of an expression in the page, as soon as it is there. */
    async value(expression, seconds = 60) {
        const end = Date.now() + 1000 * seconds;
        while (Date.now() < end) {
            const { result } = await this.#ask("Runtime.evaluate", { expression, returnByValue: true });
            const isThere = result.type !== "undefined" && result.subtype !== "null" && result.subtype !== "error";
            if (isThere) return result.value;
            await new Promise((resolve) => { setTimeout(resolve, 100); });
        }
        throw new Error(`${expression}: nothing; ${this.complaints.join("\n")}`);
    }

    /** A picture of the page, as a JPEG file. */
    async picture() {
        const { data } = await this.#ask("Page.captureScreenshot", { format: "jpeg", quality: 75 });
        return Buffer.from(data, "base64");
    }

    async end() {
        const gone = new Promise((resolve) => { this.#process.once("exit", resolve); });
        this.#process.kill();
        await gone;
        await rm(this.#profile, { recursive: true, force: true, maxRetries: 5 });
    }
}
