// What holds in every room against addresses, files and haste: values that make no sense, files of another kind, scenes
// that are changed while one is read, and many scenes, one after the other.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before } from "node:test";
import { assertHeld, cancelled, cancelNext, drawn, dropped, held, launch, open, pause, said, serve, SHOWN, shown, test, until } from "./browser.mjs";

const data = (name) => readFileSync(new URL(`../../data/${name}`, import.meta.url));
let site, chromium;
before(async () => { site = await serve(); chromium = await launch(); });
after(async () => { await chromium?.stop(); site?.stop(); });
const at = (hash, options) => open(chromium.browser, site.url + hash, options);


const NONSENSE = {
    draw: ["scene=none&turn=NaN&tilt=1e9&zoom=-3", "scene=bracket&fov=0&paper=none&shading=none2&lines=none2&scale=none&unit=0", "scene=bracket&parallel=yes&paper=a4&unit=-1&scale=-5",
        "scene=file&zoom=1e308&x=1e308&y=-1e308", "scene=bracket&width=-1&crease=1e6&section=w&at=7&up=up", "scene=__proto__&shading=constructor"],
    partition: ["scene=none&method=none&second=none2", "scene=plan&leaf=-3&step=1e300&zoom=0", "scene=bracket&leaf=2.5&step=0.5&turn=1e300&tilt=NaN&zoom=1e300", "scene=file", "scene=toString&method=constructor"],
    ask: ["scene=none&kind=none&size=-1&k=0", "scene=plan&kind=near&k=1e9", "scene=plan&kind=near&k=2.5", "scene=bracket&kind=ball&size=1e300&px=1e300&py=-4&zoom=-1", "scene=file&zoom=0&x=Infinity", "scene=plan&kind=ray&ox=0.5&oy=0.5"],
    move: ["scene=none&time=-3&pace=-1", "scene=flight&time=1e300&zoom=0", "scene=file&pace=0&time=NaN", "scene=boxes&turn=1e300&cells=perhaps"],
};
for (const [room, states] of Object.entries(NONSENSE))
    test(`values without sense in an address leave what is usual: ${room}`, async () => {
        for (const state of states) {
            const page = await at(`#${room}?${state}`);
            await page.waitForFunction(`document.querySelector(".status.wrong") || (${SHOWN[room]})()`);
            assert.equal(await page.$eval(".status", (it) => it.matches(".wrong") && it.textContent), false, state);
            assert.deepEqual(await page.$$eval("select", (all) => all.filter((it) => it.selectedIndex < 0).length), 0, state);
            assert.deepEqual(await page.$$eval(".switch", (all) => all.filter((it) => !it.querySelector(":checked")).length), 0, state);
            assert.deepEqual(page.wrong, [], state);
            await page.close();
        }
    });

const FOREIGN = {
    draw: [["a b.csv", "x,y\n1,2\n"], ["a b.mfjson", "{}"], ["notes", "x"], ["a b.geojson", "{}"], ["plan b.geojson", data("freedoom-e1m1.geojson")]],
    partition: [["a b.csv", "\0\0\0"], ["a b.mfjson", "{}"], ["a b.glb", "glTF"], ["a b.geojson", "[".repeat(100000)], ["nothing at all.obj", ""], ["a b.geojson", '{"type":"FeatureCollection","features":[]}']],
    ask: [["a b.mfjson", data("cars-bologna.mfjson")], ["a b.csv", "1,2,3,4,5,6,7\n"], ["a b.off", "OFF\n9 9 9\n"], ["a b.stl", ""]],
    move: [["a b.glb", data("fzk-haus.glb")], ["a b.geojson", data("freedoom-e1m1.geojson")], ["empty.mfjson", ""], ["a b.mfjson", "{\"type\":\"MovingPoint\""], ["a b.json", "[]"]],
};
for (const [room, files] of Object.entries(FOREIGN))
    test(`files of another kind are refused by their names, and nothing of the scene before is left: ${room}`, async () => {
        const page = await at(`#${room}${room === "draw" ? "?scene=bracket" : ""}`);
        await shown(page, room);
        for (const [name, content] of files) {
            await dropped(page, { [name]: Buffer.from(content) });
            const told = await said(page);
            assert.ok(!told.includes(name[0].toUpperCase() + name.slice(1)), told);
            assert.match(told, /^[^]* [^]*[.!?]$/);
            assert.equal(await page.evaluate(SHOWN[room]), null, `${name}: ${told}`);
            assert.ok(await page.$eval(".work", (it) => it.hidden));
        }
        await page.select("select", room === "move" ? "spin" : "bracket");
        await shown(page, room);
        await page.waitForFunction(() => !document.querySelector(".status.wrong"));
        await page.close();
    });

test("an own file can be chosen in the list only if there is one, and Cancel leaves a way back to it", async () => {
    for (const [room, name] of [["partition", "bracket.off"], ["ask", "bracket.off"], ["move", "cars.mfjson"]]) {
        const page = await at(`#${room}`);
        await shown(page, room);
        const first = await page.$eval("select", (it) => it.value);
        await page.select("select", "file");
        assert.equal(await page.$eval("select", (it) => it.value), first);
        await cancelNext(page);
        await dropped(page, { [name]: data(room === "move" ? "cars-bologna.mfjson" : name) });
        await cancelled(page);
        assert.ok(await page.$eval(".work", (it) => it.hidden));
        await page.$eval(".status button", (it) => it.click());
        assert.match(await shown(page, room), room === "move" ? /^Time/ : /1,040/);
        assert.equal(await page.$eval("select", (it) => it.value), "file");
        assert.deepEqual(page.wrong, []);
        await page.close();
    }
});

test("a scene that comes late does not replace one that was chosen after it", async () => {
    for (const [room, slow, fast, text] of [["draw", "bracket", "hills", /^Hills/], ["partition", "plan", "rooms", /of 600 objects/], ["ask", "plan", "rooms", /^600 objects/], ["move", "cars", "spin", / 60 objects|60 objects/]]) {
        const page = await at(`#${room}?scene=${slow}`, { first: () => {
            const { fetch } = globalThis;
            globalThis.fetch = async (url, ...more) => {
                if (String(url).startsWith("samples/")) await new Promise((resume) => { globalThis.release = resume; });
                return fetch(url, ...more);
            };
        } });
        await page.waitForFunction(() => globalThis.release);
        await page.select("select", fast);
        assert.match(await shown(page, room), text);
        await page.evaluate(() => globalThis.release());
        await pause(1000);
        assert.match(await shown(page, room), text);
        await page.evaluate((slow) => { delete globalThis.release; location.hash = slow; }, `#${room}?scene=${slow}`);
        await page.waitForFunction(() => globalThis.release);
        await page.evaluate((room) => { location.hash = room === "ask" ? "#move" : "#ask"; }, room);
        await page.waitForFunction(SHOWN[room === "ask" ? "move" : "ask"]);
        await page.evaluate(() => globalThis.release());
        await until(() => page.workers().length === 1); // the room that was left does not go on
        await page.close();
    }
});

test("an address that is entered in its own room says the same as anew", async () => {
    for (const [room, state, scene] of [["move", "scene=spin&time=0.5&zoom=2", "flight"], ["partition", "scene=rooms&step=7&zoom=2", "plan"], ["ask", "scene=plan&zoom=2", "rooms"]]) {
        const page = await at(`#${room}?scene=${scene}`);
        await shown(page, room);
        await page.evaluate((hash) => { location.hash = hash; }, `#${room}?${state}`);
        await pause(600);
        assert.equal(await page.evaluate("location.hash"), `#${room}?${state.replace(/^scene=rooms&/, room === "ask" ? "" : "scene=rooms&")}`);
        await page.close();
    }
});

test("back and forward lead from room to room, to what each has shown", async () => {
    const page = await at("#ask"), go = (room) => page.click(`nav a[href="#${room}"]`);
    const rests = (room, scene) => page.waitForFunction((room, scene) => location.hash.startsWith(`#${room}`) && document.title.toLowerCase().startsWith(room)
        && document.querySelector("select")?.value === scene, {}, room, scene);
    await shown(page, "ask");
    await page.select("select", "streets");
    await page.waitForFunction(() => location.hash === "#ask?scene=streets");
    await go("move");
    await rests("move", "flight");
    await page.goBack();
    await rests("ask", "streets");
    await page.goForward();
    await rests("move", "flight");
    await page.goBack();
    await rests("ask", "streets");
    assert.deepEqual(page.wrong, []);
    await page.close();
});

test("the way past the head of the page leads into the room that is open", async () => {
    const page = await at("#ask?scene=streets");
    await shown(page, "ask");
    await page.focus(".skip");
    await page.keyboard.press("Enter");
    await pause(300);
    assert.deepEqual(await page.evaluate(() => [document.activeElement.id, location.hash, document.title.slice(0, 3)]), ["room", "#ask?scene=streets", "Ask"]);
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement.tagName), "CANVAS");
    await page.close();
});

test("a question about a model draws the answers again, and not the model", async () => {
    const page = await at("#ask?scene=bracket&kind=window&size=0.1&px=0.45&py=0.55");
    await shown(page, "ask");
    const fills = await page.evaluate(async () => {
        const frames = async (count) => { while (count--) await new Promise((resume) => requestAnimationFrame(resume)); };
        await frames(10); // in which the model and the first answers are drawn
        const { prototype } = CanvasRenderingContext2D, { fill } = prototype;
        let count = 0;
        prototype.fill = function (...given) { count++; return fill.apply(this, given); };
        const canvas = document.querySelector(".map canvas"), asked = document.querySelector("[data-asked]"), before = asked.dataset.asked, frame = canvas.getBoundingClientRect();
        canvas.dispatchEvent(new PointerEvent("pointermove", { clientX: frame.left + 0.5 * frame.width, clientY: frame.top + 0.6 * frame.height }));
        while (asked.dataset.asked === before) await new Promise((resume) => setTimeout(resume, 20));
        await frames(2);
        return { count, found: asked.dataset.found.split(" ").length };
    });
    assert.ok(fills.found > 0 && fills.count > 0 && fills.count < 3 * fills.found + 10, JSON.stringify(fills));
    await page.close();
});

for (const room of ["partition", "ask", "move"])
    test(`forty scenes take no more memory than ten: ${room}`, async () => {
        const page = await at(`#${room}`, { width: 320, height: 400 });
        const map = (n) => JSON.stringify({ type: "FeatureCollection", features: Array.from({ length: 5 + n % 2 }, (_, i) =>
            ({ type: "Feature", properties: {}, geometry: { type: "LineString", coordinates: [[i, i % 2], [i + 0.5, 3]] } })) });
        await shown(page, room);
        const load = async (times) => {
            for (let n = 0; n < times; n++) {
                const before = await shown(page, room);
                if (room === "move") await page.select("select", n % 2 ? "spin" : "shapes");
                else await dropped(page, { [`m${n}.geojson`]: Buffer.from(map(n)) });
                await page.waitForFunction(`![null, ${JSON.stringify(before)}].includes((${SHOWN[room]})())`);
            }
        };
        await load(10);
        const before = await held(page);
        await load(30);
        await assertHeld(page, before, 30);
        await page.close();
    });

test("a picture keeps what is drawn where the window becomes another one", async () => {
    const page = await at("#draw?scene=bracket");
    await drawn(page);
    for (const room of Object.keys(SHOWN)) {
        await page.evaluate((room) => { location.hash = `#${room}?scene=${room === "move" ? "spin" : "bracket"}`; }, room);
        await page.waitForFunction((title) => document.title.toLowerCase().startsWith(title), {}, room);
        await shown(page, room);
        for (const [width, height] of [[320, 480], [200, 480], [1600, 500], [1280, 800]]) {
            await page.setViewport({ width, height });
            await until(() => page.evaluate((width) => innerWidth === width && [...document.querySelectorAll(".stage canvas")].every((it) => it.clientWidth > 0), width));
        }
    }
    assert.deepEqual(page.wrong, []);
    await page.close();
});

test("the timeline is as sharp after its window became another one", async () => {
    const page = await at("#move?scene=spin");
    await shown(page, "move");
    await page.setViewport({ width: 500, height: 700 });
    await page.waitForFunction(() => document.querySelector(".density").clientWidth < 450);
    await until(() => page.$eval(".density", (it) => it.width === it.clientWidth &&
        it.getContext("2d").getImageData(0, 0, it.width, it.height).data.some((byte) => byte)));
    await page.close();
});

test("times of another kind of question are not shown", async () => {
    const page = await at("#ask");
    await shown(page, "ask");
    await page.evaluate(() => {
        [...document.querySelectorAll("button")].find((it) => it.textContent.startsWith("Measure")).click();
        document.querySelector("input[value=ray]").click();
    });
    await pause(1500);
    assert.equal(await page.$("tbody"), null);
    await page.close();
});

test("one answer meets, several meet", async () => {
    const page = await at("#ask?kind=near&k=1");
    await shown(page, "ask");
    assert.equal(await page.$eval(".facts dd", (it) => it.textContent), "1 is nearest");
    await page.close();
});

for (const [where, coordinates] of [["far from the origin", [[1e15, 1e15], [1e15 + 1, 1e15 + 2]]], ["in a scene as large as numbers are", [[-1e308, -1e308], [1e308, 1e308]]]])
    test(`${where} the question is where the pointer is, and one object is one`, async () => {
        const page = await at("#ask"), line = { type: "LineString", coordinates };
        await shown(page, "ask");
        await dropped(page, { "far.geojson": Buffer.from(JSON.stringify({ type: "FeatureCollection", features: [{ type: "Feature", properties: {}, geometry: line }] })) });
        await page.waitForFunction(() => /^1 object;/.test(document.querySelector(".status").textContent) && document.querySelector("[data-asked]"));
        await until(() => page.$eval(".map canvas", (it) => [-8, 8].every((x) => it.getContext("2d").getImageData(it.width / 2 + x, it.height / 2, 1, 1).data[3] > 0)));
        await page.close();
    });

for (const width of [1280, 320])
    test(`the Tab key leads to all, and what has the focus is seen, ${width} pixels wide`, async () => {
        for (const room of Object.keys(SHOWN)) {
            const page = await at(`#${room}${room === "draw" ? "?scene=bracket" : ""}`, { width, height: 740 });
            await shown(page, room);
            const wanted = await page.evaluate(() => [...document.querySelectorAll(":is(button, input, select, summary, canvas[tabindex]):not([type=radio])")]
                .filter((it) => it.checkVisibility({ visibilityProperty: true }) && !it.closest(".work")).length); // work comes and goes
            const reached = new Set();
            for (let i = 0; i < 80; i++) {
                await page.keyboard.press("Tab");
                const at = await page.evaluate(() => {
                    const it = document.activeElement, box = (it.closest("label") ?? it).getBoundingClientRect();
                    if (it === document.body) return null;
                    const top = document.elementFromPoint(box.left + box.width / 2, box.top + Math.min(box.height / 2, 40));
                    const around = [it, it.nextElementSibling, it.parentElement, it.closest(".sheet")].filter(Boolean);
                    globalThis.tabbed ??= [];
                    if (!globalThis.tabbed.includes(it)) globalThis.tabbed.push(it);
                    return { index: globalThis.tabbed.indexOf(it), counts: it.matches(":is(button, input, select, summary, canvas):not([type=radio])") && !it.closest(".work"), text: it.outerHTML.slice(0, 90),
                        covered: it.closest(".panel") && !(top && (it.contains(top) || top.contains(it) || it.closest("label")?.contains(top))),
                        outlined: around.some((one) => getComputedStyle(one).outlineStyle !== "none") };
                });
                if (!at) break;
                assert.ok(!at.covered, `${room}: covered: ${at.text}`);
                assert.ok(at.outlined, `${room}: without an outline: ${at.text}`);
                if (at.counts) reached.add(at.index);
            }
            assert.equal(reached.size, wanted, room);
            await page.close();
        }
    });
