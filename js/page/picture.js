// Writes a picture of the page as it is after some seconds: node page/picture.js FILE [SCENE,POINTS]
import { writeFile } from "node:fs/promises";

import { Browser } from "./browser.js";
import { serve } from "./serve.js";

const [file, what = "domain,2000"] = process.argv.slice(2);
const [server, browser] = [await serve(0), await Browser.start()];
await browser.visit(`http://127.0.0.1:${server.address().port}/page/#${what}`);
await browser.value("document.getElementById('ours-text')?.textContent || undefined");
await new Promise((resolve) => { setTimeout(resolve, 4000); });
await writeFile(file, await browser.picture());
await browser.end();
server.closeAllConnections();
server.close();
