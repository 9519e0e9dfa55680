// The room Partition in Chromium: its figures are those of the program, cut by cut. What browser.mjs needs, and
// FROE_PROGRAM: the program froe.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before } from "node:test";
import { dropped, launch, open, press, said, serve, shown, test, until } from "./browser.mjs";

const folder = mkdtempSync(join(tmpdir(), "froe-partition-"));
let site, chromium;
before(async () => { site = await serve(); chromium = await launch(); });
after(async () => { await chromium?.stop(); site?.stop(); rmSync(folder, { recursive: true }); });

/* The room, once as many pictures as methods are there. */
async function room(state, pictures = 1) {
    const page = await open(chromium.browser, `${site.url}#partition?${state}`);
    await page.waitForFunction((n) => [...document.querySelectorAll(".pane strong")].length === n, {}, pictures);
    return page;
}
const captions = (page) => page.$$eval(".pane figcaption", (all) => all.map((it) => it.textContent));
const told = (page) => page.$eval(".field output", () => [...document.querySelectorAll(".field output")].map((it) => it.value).find((it) => it.includes(" of ")));
function report(file, method) {
    const out = join(folder, `${method}.froe`);
    return JSON.parse(execFileSync(process.env.FROE_PROGRAM, ["build", resolve("data", file), "-o", out, "--method", method, "--json"]));
}

test("two methods side by side have the figures that the program reports", async () => {
    const page = await room("scene=plan&method=density&second=kd", 2), told = await captions(page);
    for (const [i, method] of ["density", "kd"].entries()) {
        const { fragments, objects, height } = report("freedoom-e1m1.geojson", method), n = (x) => x.toLocaleString("en");
        assert.ok(told[i].startsWith(`${method} ${n(fragments)} pieces of ${n(objects)} objects, `), told[i]);
        assert.ok(told[i].endsWith(`, depth ${height}`), `${told[i]} and not ${height}`);
    }
    assert.deepEqual(page.wrong, []);
    await page.close();
});

test("cuts go forwards and back by keys, one by one, and the address keeps where", async () => {
    const page = await room("scene=plan&step=10");
    assert.match(await told(page), /^10 of \d+, to depth \d+$/);
    await press(page, ".pane canvas", ["]", "]", "["]);
    await page.waitForFunction(() => location.hash.includes("step=11"));
    assert.match(await told(page), /^11 of /);
    await page.$$eval("button", (all) => all.find((it) => it.textContent === "All").click());
    assert.match(await told(page), /^(\d+) of \1, to depth 16$/);
    await page.close();
});

test("a piece says its object, its cut and its list", async () => {
    const page = await room("scene=plan");
    await page.type("input[type=number]", "17");
    const facts = await page.$$eval(".facts dd", (all) => all.map((it) => it.textContent));
    assert.equal(facts.length, 4);
    assert.match(facts[0], /^\d+/);
    assert.match(facts[2], /^in (cut [\d,]+, at|a cell at) depth \d+$/);
    assert.match(facts[3], /^\d+ pieces? at node [\d,]+$/);
    await page.close();
});

for (const [room, canvas] of [["partition", ".pane canvas"], ["ask", "canvas"]])
    test(`boxes, balls and hulls are seen as they are, and in space they are refused: ${room}`, async () => {
        const page = await open(chromium.browser, `${site.url}#${room}?scene=rooms`);
        await shown(page, room);
        const solids = { "box.csv": "lo_x,lo_y,hi_x,hi_y\n0,0,4,4\n", "ball.csv": "x,y,radius\n0,0,2\n", "hull.csv": "hull,x,y\n0,0,0\n0,4,4\n0,4,0\n0,0,4\n" };
        for (const [name, table] of Object.entries(solids)) {
            await page.$eval(".status", (it) => it.replaceChildren());
            await dropped(page, { [name]: Buffer.from(table) });
            await page.waitForFunction(() => document.querySelector(".status").textContent);
            assert.equal(await page.$eval(".status", (it) => it.matches(".wrong") && it.textContent), false, name);
            // Ink in all four quarters, from the middle of the picture: a diagonal is in two of them, and a dot in none.
            await until(() => page.$eval(canvas, (it) => {
                const { width, height } = it, { data } = it.getContext("2d").getImageData(0, 0, width, height), found = [0, 0, 0, 0];
                for (let i = 0; i < data.length; i += 4) {
                    const x = (i / 4) % width - width / 2, y = Math.floor(i / 4 / width) - height / 2;
                    if (data[i + 3] > 99 && data[i] < 99 && Math.min(Math.abs(x), Math.abs(y)) > 20) found[(x > 0) + 2 * (y > 0)]++;
                }
                return found.every((count) => count > 20);
            }));
        }
        await dropped(page, { "a.csv": Buffer.from("lo_x,lo_y,lo_z,hi_x,hi_y,hi_z\n0,0,0,1,1,1\n") });
        assert.equal(await said(page), "Boxes, balls and hulls in space are not shown here: the program froe takes them.");
        await page.close();
    });

test("a model is cut, too, and a file that is no scene is refused in a sentence", async () => {
    const page = await room("scene=bracket&step=5");
    writeFileSync(join(folder, "broken.geojson"), '{"type": "FeatureCollection", "features": [');
    const input = await page.$("input[type=file]");
    await input.uploadFile(join(folder, "broken.geojson"));
    await page.waitForSelector(".status.wrong");
    assert.match(await page.$eval(".status", (it) => it.textContent), /broken\.geojson.*\.$/i);
    await page.close();
});
