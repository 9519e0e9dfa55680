// The room Move in Chromium: what happens is what the program lists, and time goes both ways. What browser.mjs needs,
// and FROE_PROGRAM: the program froe.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { dropped, launch, open, pause, press, serve, test, until } from "./browser.mjs";

const folder = mkdtempSync(join(tmpdir(), "froe-move-"));
let site, chromium;
before(async () => { site = await serve(); chromium = await launch(); });
after(async () => { await chromium?.stop(); site?.stop(); rmSync(folder, { recursive: true }); });

/* The room, once all that happens is listed. */
async function room(state) {
    const page = await open(chromium.browser, `${site.url}#move?${state}`);
    await page.waitForFunction(() => / so far/.test(document.querySelector(".status")?.textContent));
    return page;
}
const status = (page) => page.$eval(".status", (it) => it.textContent);
const time = (page) => page.$eval(".timeline input", (it) => Number(it.value));

test("as much happens as the program counts", async () => {
    const motion = join(folder, "flights.mfjson");
    execFileSync(process.env.FROE_PROGRAM, ["generate", "moving", "-n", "40", "-o", motion, "--quiet"]);
    const told = JSON.parse(execFileSync(process.env.FROE_PROGRAM, ["simulate", motion, "--events", join(folder, "events.csv"), "--json"]));
    const events = told.events.all, page = await room("scene=flight&time=1");
    assert.ok((await status(page)).endsWith(`${events.toLocaleString("en")} of ${events.toLocaleString("en")} events so far`), `${await status(page)}: ${events}`);
    assert.deepEqual(page.wrong, []);
    await page.close();
});

test("time goes from event to event, forwards and back, and the address keeps it", async () => {
    const page = await room("scene=spin&time=0.3");
    assert.equal(await time(page), 0.3);
    await press(page, ".map canvas", ["]", "]", "["]);
    await page.waitForFunction(() => Number(document.querySelector(".timeline input").value) > 0.3 && /time=0.3/.test(location.hash));
    const then = await page.$eval(".events [aria-current=true] strong", (it) => Number(it.textContent));
    await page.$$eval("button", (all) => all.find((it) => it.textContent === "Event before").click());
    await page.waitForFunction((old) => Number(document.querySelector(".events [aria-current=true] strong").textContent) < old, {}, then);
    await page.close();
});

test("points that move are seen", async () => {
    const other = await room("cells=no"), paths = [[[0, 0], [10, 8]], [[0, 8], [10, 0]]];
    await dropped(other, { "points.mfjson": JSON.stringify({ type: "FeatureCollection", features: paths.map((coordinates) => ({ type: "Feature", properties: {},
        temporalGeometry: { type: "MovingPoint", datetimes: [0, 10], coordinates } })) }) });
    await other.waitForFunction(() => /2 objects/.test(document.querySelector(".status").textContent) && / so far/.test(document.querySelector(".status").textContent));
    const inked = () => other.$eval(".map canvas", (canvas) => {
        const { data, width } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height), at = [0, 0];
        for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 128 && data[i] < 90) at[(i / 4) % width < width / 2 ? 0 : 1]++;
        return at;
    });
    await until(async () => (await inked())[0] > 10);
    const before = await inked();
    assert.equal(before[1], 0);
    await other.$eval("[aria-label=Time]", (input) => { input.value = "1"; input.dispatchEvent(new Event("input")); });
    await until(async () => (await inked())[1] > 10);
    assert.deepEqual(other.wrong, []);
    await other.close();
});

test("it plays, and pauses", async () => {
    const page = await room("scene=flight&pace=0.1"); // it ends in minutes, long after it was paused
    const click = (name) => page.$$eval("button", (all, text) => all.find((it) => it.textContent === text).click(), name);
    await click("Play");
    await page.waitForFunction(() => Number(document.querySelector(".timeline input").value) > 0);
    await click("Pause");
    const stood = await time(page);
    await pause(200);
    assert.equal(await time(page), stood);
    assert.deepEqual(page.wrong, []);
    await page.close();
});

test("boxes in space tell their contacts, and a file without motion is refused in a sentence", async () => {
    const page = await room("scene=boxes");
    assert.match(await status(page), /contacts so far$/);
    writeFileSync(join(folder, "broken.mfjson"), "{}");
    await (await page.$("input[type=file]")).uploadFile(join(folder, "broken.mfjson"));
    await page.waitForSelector(".status.wrong");
    assert.match(await status(page), /broken\.mfjson.*\.$/i);
    await page.close();
});
