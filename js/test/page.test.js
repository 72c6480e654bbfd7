// The page in a browser without a window: every scene runs, is right, draws, and has nothing to complain of.

import assert from "node:assert/strict";
import test from "node:test";

import { Browser, chromium } from "../page/browser.js";
import { serve } from "../page/serve.js";

const skip = chromium ? false : "there is no Chromium";

test("the page in Chromium", { skip, timeout: 300_000 }, async (t) => {
    const [server, browser] = [await serve(0), await Browser.start()];
    t.after(async () => {
        await browser.end();
        server.closeAllConnections();
        server.close();
    });
    const address = `http://127.0.0.1:${server.address().port}/page/`;
    for (const [scene, points, least] of [
        ["vortex", 2000, 20_000], ["lloyd", 1000, 15_000], ["domain", 2000, 200_000], ["cloud", 2000, 5_000],
    ]) {
        await t.test(scene, async () => {
            await browser.visit(`${address}?frames=25#${scene},${points}`);
            const result = JSON.parse(await browser.value("document.getElementById('result')?.textContent"));
            assert.deepEqual(browser.complaints, []);
            assert.deepEqual([result.scene, result.isSame, result.hasOther], [scene, true, true]);
            const [ours, theirs] = result.pixels;
            assert.ok(ours > least && ours <= 640 * 640, `${ours} pixels`);
            assert.ok(scene === "cloud" ? theirs === 0 : theirs > 10_000, `${theirs} pixels`);
            // The same lines, but for how their ends are rounded.
            if (scene === "vortex") assert.ok(Math.abs(ours - theirs) < 0.02 * ours, `${ours} and ${theirs} pixels`);
        });
    }
    await t.test("as a user sees it", async () => {
        await browser.visit(`${address}#lloyd,500`);
        const text = await browser.value("document.getElementById('ours-text')?.textContent || undefined");
        assert.match(text, /ms a step, .* frames a second/);
        // Another scene, and more points.
        await browser.value("document.forms[0].scene.value = 'vortex'");
        await browser.value("document.forms[0].points.value = 4");
        await browser.value("document.forms[0].points.dispatchEvent(new Event('input'))");
        assert.equal(await browser.value("document.forms[0].count.value"), "10,000");
        await browser.value("/frames/.test(document.getElementById('theirs-text').textContent) || undefined");
        assert.deepEqual(browser.complaints, []);
        assert.equal(await browser.value("document.getElementById('error').textContent"), "");
        assert.ok((await browser.picture()).length > 50_000);
    });
});
