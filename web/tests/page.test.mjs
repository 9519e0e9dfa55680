// The page in Chromium: rooms, addresses, drawings that are those of the program, byte for byte. What browser.mjs
// needs, and FROE_PROGRAM: the program froe.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before } from "node:test";
import { drawn, launch, open, press, saved, serve, settled, test } from "./browser.mjs";

const folders = mkdtempSync(join(tmpdir(), "froe-page-"));
let site, chromium;
before(async () => { site = await serve(); chromium = await launch(); });
after(async () => { await chromium?.stop(); site?.stop(); rmSync(folders, { recursive: true }); });
const at = (hash, options) => open(chromium.browser, site.url + hash, options);

/* What the line of the page that draws the same from a terminal draws. */
function drawnByProgram(line, folder) {
    const path = `${dirname(process.env.FROE_PROGRAM)}:${process.env.PATH}`;
    execFileSync("bash", ["-c", `${line} --quiet`], { cwd: folder, env: { ...process.env, PATH: path } });
}

test("each room has an address, and nothing goes wrong in it", async () => {
    const page = await at("");
    for (const room of ["Draw", "Partition", "Ask", "Move"]) {
        await page.click(`nav a[href="#${room.toLowerCase()}"]`);
        await page.waitForFunction((name) => document.title.startsWith(name), {}, room);
        assert.equal(await page.$eval("nav a[aria-current]", (link) => link.textContent), room);
    }
    assert.deepEqual(page.wrong, []);
    await page.close();
});

const STATES = ["scene=teapot", "scene=bracket&parallel=yes&paper=a4&unit=0.001&scale=1&shading=cel&hidden=yes&width=2&crease=10",
    "scene=hills&turn=-120&tilt=40&section=x&at=0.3&lines=mesh&zoom=1.5&x=0.1&y=-0.05", "scene=city&shading=none&lines=outlines&fov=60&up=y",
    "scene=teapot&tilt=90&turn=0&section=z&flip=yes&shading=white&colours=own&parallel=yes&lines=none&paper=square"];
for (const state of STATES)
    test(`the program draws the same bytes: ${state}`, async () => {
        const page = await at(`#draw?${state}`), name = /scene=(\w+)/.exec(state)[1];
        const folder = mkdtempSync(join(folders, "state-"));
        await settled(page);
        const line = await page.$eval("details code", (code) => code.textContent);
        await saved(page, folder, "Saved tree", `${name}.froe`);
        const own = readFileSync(await saved(page, folder, "Save as SVG", `${name}.svg`));
        drawnByProgram(line, folder);
        assert.ok(own.length > 1000 && own.equals(readFileSync(join(folder, `${name}.svg`))));
        assert.deepEqual(page.wrong, []);
        await page.close();
    });

test("the address keeps the view, and keys change it", async () => {
    const page = await at("#draw?scene=bracket");
    await drawn(page);
    const first = await page.$eval(".drawing", (image) => image.src);
    await press(page, "canvas", ["ArrowRight", "ArrowRight", "ArrowDown", "+"]);
    await page.waitForFunction((old) => document.querySelector(".drawing").src !== old && document.querySelector(".drawn"), {}, first);
    await page.waitForFunction(() => /scene=bracket&turn=21&tilt=24&zoom=/.test(location.hash)); // which takes the state a moment later
    const hash = await page.evaluate("location.hash");
    await page.close();
    const again = await at(hash);
    await drawn(again);
    assert.equal(await again.evaluate("location.hash"), hash);
    await again.close();
});
