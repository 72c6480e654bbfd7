// The page: positions move, deldrift follows, and d3-delaunay beside it.
//
// page/#vortex,2000 begins with a scene and a number of points. page/?frames=30#vortex,2000 makes so many frames, one
// after the other, and then tells in the element `result` what has come of them, for the test of the page.

import { scenes } from "./scenes.js";

const form = document.querySelector("form");
const [ours, theirs] = ["ours", "theirs"].map((id) => document.getElementById(id).getContext("2d"));
const [ourText, theirText] = ["ours-text", "theirs-text"].map((id) => document.getElementById(id));

/** The other library, if it is there. */
async function other() {
    try {
        return (await import("../node_modules/d3-delaunay/dist/d3-delaunay.min.mjs")).Delaunay;
    } catch {
        return null;
    }
}

const D3 = await other();
let scene = null;
let times = { ours: [], theirs: [] };

function timed(work) {
    const start = performance.now();
    work();
    return performance.now() - start;
}

function begin() {
    const count = Math.round(10 ** Number(form.points.value));
    scene?.end();
    scene = new scenes[form.scene.value](count, form.beside.checked ? D3 : null);
    times = { ours: [], theirs: [] };
    form.count.value = count.toLocaleString("en");
    document.getElementById("explanation").textContent = scene.explanation;
    theirs.setTransform(1, 0, 0, 1, 0, 0);
    theirs.clearRect(0, 0, theirs.canvas.width, theirs.canvas.height);
    theirText.textContent = scene.theirs ? "" : "not shown";
}

function median(list) {
    return list.slice().sort((a, b) => a - b)[list.length >> 1];
}

/** Adds what a frame has taken to the last ones, and shows the time and the rate that one alone would have. */
function tell(list, step, draw, output) {
    list.push([step, draw]);
    if (list.length > 30) list.shift();
    const [ofStep, ofDrawing] = [0, 1].map((k) => median(list.map((entry) => entry[k])));
    const rate = 1000 / Math.max(ofStep + ofDrawing, 1e-3);
    output.innerHTML = `<b>${ofStep.toFixed(2)} ms</b> a step, ${ofDrawing.toFixed(1)} ms to draw: `
        + `${rate.toFixed(0)} frames a second alone`;
}

function frame() {
    scene.advance();
    const step = timed(() => scene.followOurs());
    tell(times.ours, step, timed(() => scene.drawOurs(ours)), ourText);
    if (scene.theirs) {
        const other = timed(() => scene.followTheirs());
        tell(times.theirs, other, timed(() => scene.drawTheirs(theirs)), theirText);
    }
}

function show(error) {
    document.getElementById("error").textContent = `${error.stack ?? error}`;
    throw error;
}

function go() {
    try {
        if (form.runs.checked) frame();
    } catch (error) {
        show(error);
    }
    requestAnimationFrame(go);
}

/** How many pixels of a canvas are not blank. */
function inked({ canvas }) {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    let count = 0;
    for (let k = 3; k < data.length; k += 4) count += data[k] > 0 ? 1 : 0;
    return count;
}

const [name, points] = location.hash.slice(1).split(",");
if (name in scenes) form.scene.value = name;
if (Number(points) > 0) form.points.value = Math.log10(Number(points));
form.addEventListener("change", begin);
form.points.addEventListener("input", begin);
begin();

const frames = Number(new URLSearchParams(location.search).get("frames"));
if (frames > 0) {
    for (let k = 0; k < frames; k++) frame();
    const result = document.createElement("pre");
    result.id = "result";
    result.hidden = true;
    result.textContent = JSON.stringify({
        scene: form.scene.value,
        isSame: scene.isSame(),
        hasOther: D3 !== null,
        pixels: [inked(ours), inked(theirs)],
    });
    document.body.append(result);
} else {
    requestAnimationFrame(go);
}
