// The room Ask in Chromium: its answers are those of the program. What browser.mjs needs, and FROE_PROGRAM: the program
// froe.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before } from "node:test";
import { launch, open, press, serve, test } from "./browser.mjs";

const folder = mkdtempSync(join(tmpdir(), "froe-ask-"));
let site, chromium;
before(async () => { site = await serve(); chromium = await launch(); });
after(async () => { await chromium?.stop(); site?.stop(); rmSync(folder, { recursive: true }); });

/* The room, once it has answered. */
async function room(state) {
    const page = await open(chromium.browser, `${site.url}#ask?${state}`);
    await page.waitForFunction(() => document.querySelector("[data-asked]"));
    return page;
}
const answer = (page) => page.$eval("[data-asked]", (it) => ({ asked: JSON.parse(it.dataset.asked), found: it.dataset.found }));
/* What the program answers: the column `object` of its lines. */
function answered(command, file, header, numbers, ...more) {
    const csv = join(folder, "questions.csv");
    writeFileSync(csv, `${header}\n${numbers.join(",")}\n`);
    const lines = execFileSync(process.env.FROE_PROGRAM, [command, resolve("data", file), "--queries", csv, ...more], { encoding: "utf8" });
    return lines.trim().split("\n").slice(1).map((line) => line.split(",")[1]).join(" ");
}

test("a window, a ball and what is nearest are answered as by the program", async () => {
    const page = await room("scene=plan&kind=window&size=0.2");
    const window = await answer(page), { at, size } = window.asked;
    assert.ok(window.found.split(" ").length > 3);
    assert.equal(window.found, answered("range", "freedoom-e1m1.geojson", "lo_x,lo_y,hi_x,hi_y",
        [...at.map((x) => x - size / 2), ...at.map((x) => x + size / 2)]));
    await page.close();
    const round = await room("scene=plan&kind=ball&size=0.2"), ball = await answer(round);
    assert.equal(ball.found, answered("range", "freedoom-e1m1.geojson", "x,y,r", [...ball.asked.at, ball.asked.size / 2], "--shape", "ball"));
    await round.close();
    const close = await room("scene=plan&kind=near&k=7"), near = await answer(close);
    assert.equal(near.found, answered("near", "freedoom-e1m1.geojson", "x,y", near.asked.at, "-k", "7"));
    await close.close();
});

test("a ray into a model meets what the program says, in its order", async () => {
    const page = await room("scene=bracket&kind=ray&px=0.45&py=0.55"), { asked, found } = await answer(page);
    assert.ok(found.split(" ").length > 1);
    assert.equal(found, answered("ray", "bracket.off", "ox,oy,oz,dx,dy,dz", [...asked.origin, ...asked.direction], "--all"));
    await page.close();
});

test("long names of groups stay within the settings", async () => {
    const page = await room("scene=house&kind=ray");
    assert.ok((await answer(page)).found);
    assert.ok(await page.$eval(".panel", (panel) => panel.scrollWidth <= panel.clientWidth));
    await page.close();
});

test("arrow keys move the question, and the address keeps it", async () => {
    const page = await room("scene=rooms"), before = await answer(page);
    await press(page, "canvas", ["ArrowRight", "ArrowRight", "ArrowDown"]);
    await page.waitForFunction((old) => document.querySelector("[data-asked]").dataset.asked !== old && /px=0.54&py=0.52/.test(location.hash), {}, JSON.stringify(before.asked));
    assert.deepEqual(page.wrong, []);
    await page.close();
});

test("time is measured beside programs of npm, which are loaded then", async () => {
    for (const [state, name] of [["scene=rooms", "flatbush"], ["scene=bracket&kind=ray&px=0.45&py=0.55", "three-mesh-bvh"]]) {
        const page = await room(state);
        assert.ok(!site.asked.some((path) => path.includes(`peers/${name}`)));
        await page.$$eval("button", (all) => all.find((it) => it.textContent.startsWith("Measure")).click());
        await page.waitForSelector("tbody");
        assert.deepEqual(await page.$$eval("tbody strong", (all) => all.map((it) => it.textContent)), ["froe", name]);
        assert.ok(site.asked.some((path) => path.includes(`peers/${name}`)));
        assert.deepEqual(page.wrong, []);
        await page.close();
    }
});
