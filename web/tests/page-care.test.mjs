// What holds in every room: contrast and labels, by axe; no network once the page was open; no growth; an end at once.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before } from "node:test";
import { assertHeld, cancelled, cancelNext, drawn, dropped, held, launch, modules, open, serve, shown, test, until } from "./browser.mjs";

const axe = readFileSync(modules.resolve("axe-core/axe.min.js"), "utf8");
const ROOMS = ["draw?scene=bracket", "partition", "ask", "move"];
let site, chromium;
before(async () => { site = await serve(); chromium = await launch(); });
after(async () => { await chromium?.stop(); site?.stop(); });
const at = (hash, options) => open(chromium.browser, site.url + hash, options);

for (const dark of [false, true])
    for (const width of [1280, 320])
        test(`axe finds nothing: ${dark ? "dark" : "light"}, ${width} pixels wide`, async () => {
            for (const room of ROOMS) {
                const page = await at(`#${room}`, { width, height: 740, dark, still: true });
                await page.waitForSelector(".stage");
                if (room.startsWith("draw")) await drawn(page);
                await page.evaluate(axe.replace(/<\/script>/g, ""));
                const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
                assert.deepEqual(violations.map(({ id, nodes }) => [room, id, nodes[0].html.slice(0, 120), nodes[0].failureSummary]), []);
                const wide = await page.evaluate(() => document.documentElement.scrollWidth);
                assert.ok(wide <= width, `${room} is ${wide} pixels wide`);
                await page.close();
            }
        });

test("a page that was open needs no network", async () => {
    const own = await serve(), page = await open(chromium.browser, `${own.url}#draw?scene=bracket`);
    await drawn(page);
    await page.evaluate(() => navigator.serviceWorker.ready);
    const visit = async (hash) => {
        await page.goto("about:blank");
        await page.goto(own.url + hash);
        await shown(page, /\w+/.exec(hash)[0]);
    };
    for (const room of ROOMS) await visit(`#${room}`); // samples are kept when they are first used
    own.stop();
    for (const hash of ["#draw?scene=bracket&turn=90", "#draw?scene=hills", ...ROOMS.map((room) => `#${room}`)]) await visit(hash);
    assert.deepEqual(page.wrong, []);
    await page.close();
});

test("nothing is loaded from elsewhere, and samples when they are chosen", async () => {
    const own = await serve(), page = await open(chromium.browser, `${own.url}#draw?scene=hills`), urls = [];
    page.on("request", (request) => urls.push(request.url()));
    await drawn(page);
    assert.ok(!own.asked.some((path) => path.startsWith("/samples/")));
    await page.evaluate(() => { location.hash = "#draw?scene=bracket"; });
    await page.waitForFunction(() => document.querySelector(".drawing").alt.startsWith("Bracket"));
    assert.deepEqual(own.asked.filter((path) => path.startsWith("/samples/")), ["/samples/bracket.off"]);
    assert.ok(urls.every((url) => url.startsWith(own.url) || /^(blob|data):/.test(url)), urls.join());
    await page.close();
    own.stop();
});

test("forty models take no more memory than ten", async () => {
    const page = await at("#draw?scene=hills&paper=square", { width: 320, height: 400 });
    await drawn(page);
    const points = Array.from({ length: 24 }, (_, i) => `v ${Math.cos(i)} ${Math.sin(i)} ${i % 5}\n`).join("");
    const faces = Array.from({ length: 22 }, (_, i) => `f ${i + 1} ${i + 2} ${i + 3}\n`).join("");
    const load = async (n) => {
        for (let i = 0; i < n; i++) {
            await dropped(page, { [`m${i}.obj`]: Buffer.from(points + faces) });
            await drawn(page);
        }
    };
    await load(10);
    const before = await held(page);
    await load(30);
    await assertHeld(page, before, 30);
    await page.close();
});

test("Cancel ends what is built, at once, and the drawing stays", async () => {
    const page = await at(""), begun = [];
    await cancelNext(page, "fewer");
    await page.goto("about:blank");
    page.on("workercreated", (worker) => begun.push(worker));
    await page.goto(`${site.url}#draw?scene=house`);
    await page.waitForFunction(() => globalThis.pressed);
    assert.ok(await page.evaluate("pressed.gone"));
    assert.equal(begun.length, 2);
    await until(() => page.workers().length === 1); // Chromium lets a worker be busy for 2 s, beside the page
    assert.ok(await page.$(".sheet.drawn"));
    await page.close();
});

test("Cancel before there is a drawing leaves a way to go on", async () => {
    const page = await at("");
    await cancelNext(page, "tree");
    await page.goto("about:blank");
    await page.goto(`${site.url}#draw?scene=house`);
    assert.match(await cancelled(page), /^Cancelled\./);
    await page.evaluate(() => document.querySelector(".status button").click());
    await drawn(page);
    await page.close();
});

test("on paper there is the picture alone, and it fits", async () => {
    for (const room of ["draw?scene=bracket", "partition", "ask", "move"]) {
        const page = await at(`#${room}`, { width: 794, height: 1123 });
        await shown(page, room.split("?")[0]);
        await page.emulateMediaType("print");
        const seen = await page.evaluate(() => {
            const box = (element) => element.getBoundingClientRect(), picture = box(document.querySelector(".drawing, .map canvas, .pane canvas"));
            return { others: [...document.querySelectorAll(".bar, .panel, .foot, .timeline")].filter((it) => box(it).height).map((it) => it.className),
                wide: picture.width > 0.9 * innerWidth && picture.right <= innerWidth, high: picture.height > 100 && picture.bottom <= innerHeight };
        });
        assert.deepEqual(seen, { others: [], wide: true, high: true }, room);
        await page.close();
    }
});

test("without WebGL there is a drawing all the same", async () => {
    const page = await at("");
    await page.evaluateOnNewDocument(() => { HTMLCanvasElement.prototype.getContext = () => null; });
    await page.goto("about:blank");
    await page.goto(`${site.url}#draw?scene=bracket`);
    await drawn(page);
    await page.close();
});
