// browser.mjs: the page in Chromium, for tests. FROE_PAGE: its folder; FROE_MODULES: the node_modules of
// web/package-lock.json; CHROMIUM: the browser, where it is not the one of Debian.
import assert from "node:assert/strict";
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { test as register } from "node:test";

export const modules = createRequire(join(process.env.FROE_MODULES, "of-the-page.js"));
const puppeteer = modules("puppeteer-core");
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".mjs": "text/javascript", ".css": "text/css", ".wasm": "application/wasm", ".svg": "image/svg+xml" };

/** Limits are for what hangs: a test takes some seconds where nothing else runs. */
const MOST = 600000;
export const test = (name, body) => register(name, { timeout: 2 * MOST }, body);

/** Serves the page: { url, stop }, and `asked`, the paths that were asked for. */
export function serve(folder = process.env.FROE_PAGE) {
    const asked = [];
    const server = createServer(async (request, answer) => {
        const path = decodeURIComponent(new URL(request.url, "http://page").pathname);
        asked.push(path);
        try {
            const bytes = await readFile(join(folder, normalize(path.endsWith("/") ? `${path}index.html` : path)));
            answer.writeHead(200, { "content-type": TYPES[extname(path)] ?? (path.endsWith("/") ? "text/html" : "application/octet-stream") });
            answer.end(bytes);
        } catch {
            answer.writeHead(404);
            answer.end();
        }
    });
    server.unref(); // a test that has failed before it stops its server ends all the same
    return new Promise((ready) => server.listen(0, "127.0.0.1", () => ready({
        url: `http://127.0.0.1:${server.address().port}/`, asked,
        stop: () => { server.closeAllConnections(); server.close(); },
    })));
}

/** Chromium without a window: { browser, stop }. */
export async function launch() {
    const folder = mkdtempSync(join(tmpdir(), "froe-chromium-"));
    const browser = await puppeteer.launch({
        executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, userDataDir: folder, timeout: MOST, protocolTimeout: MOST,
        args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--disable-dev-shm-usage"],
    });
    return { browser, stop: async () => { await browser.close(); rmSync(folder, { recursive: true, force: true, maxRetries: 30 }); } };
}

/** A page at an address; what its console says wrong is collected in `page.wrong`. `first` runs in it before all else. */
export async function open(browser, url, { width = 1280, height = 800, dark = false, still = false, first = () => {} } = {}) {
    const page = await browser.newPage();
    page.setDefaultTimeout(MOST); // other tests run meanwhile, and browsers that draw without a graphics card
    const wait = page.waitForFunction.bind(page); // by the clock: without a graphics card frames may be far apart
    page.waitForFunction = (what, options, ...given) => wait(what, { polling: 50, ...options }, ...given);
    page.wrong = [];
    page.on("console", (message) => { if (message.type() === "error") page.wrong.push(`${message.text()} ${message.location().url ?? ""}`); });
    page.on("pageerror", (error) => page.wrong.push(error.message));
    await page.setViewport({ width, height });
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" },
        ...(still ? [{ name: "prefers-reduced-motion", value: "reduce" }] : [])]);
    await page.evaluateOnNewDocument(first);
    await page.goto(url);
    return page;
}

/** Waits until the room Draw shows the drawing, or says what is wrong, which it throws. */
export async function drawn(page) {
    await page.waitForFunction(() => document.querySelector(".sheet.drawn, .status.wrong"));
    const wrong = await page.$(".status.wrong");
    if (wrong) throw new Error(await wrong.evaluate((status) => status.textContent));
}

/** What each room shows once it is done: a text that differs from scene to scene, or null. */
export const SHOWN = {
    draw: () => (document.querySelector(".sheet.drawn") ? document.querySelector(".drawing").alt : null),
    partition: () => (document.querySelector(".work[hidden]") && document.querySelector(".pane strong") ? document.querySelector(".pane figcaption").textContent : null),
    ask: () => (document.querySelector("[data-asked]") ? document.querySelector(".status").textContent : null),
    move: () => (/ so far/.test(document.querySelector(".status")?.textContent) ? document.querySelector(".status").textContent : null),
};
/** Waits until a room is done; what it shows then. */
export const shown = async (page, room) => (await page.waitForFunction(SHOWN[room])).jsonValue();

/** Waits until nothing is built any more, too: the tree that draws stays. */
export async function settled(page) {
    await drawn(page);
    await page.waitForFunction(() => document.querySelector(".sheet.drawn") && document.querySelector(".work").hidden);
}

/** Presses keys on an element. */
export async function press(page, selector, keys) {
    await page.focus(selector);
    for (const key of keys) await page.keyboard.press(key);
}

/** The path of the file `name` in `folder` that a button saves, once the browser says that all of it is there: it makes an
 * empty file of that name first. */
export async function saved(page, folder, label, name) {
    const session = await page.browser().target().createCDPSession(), path = join(folder, name);
    await session.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder, eventsEnabled: true });
    const state = new Promise((resolve, reject) => {
        session.on("Browser.downloadProgress", ({ state }) => state !== "inProgress" && resolve(state));
        setTimeout(() => reject(new Error(`${name} has not been saved.`)), MOST).unref();
    });
    await page.evaluate((text) => [...document.querySelectorAll("button")]
        .find((button) => (button.getAttribute("aria-label") ?? button.textContent) === text).click(), label);
    if (await state !== "completed" || !existsSync(path)) throw new Error(`The browser has not saved ${name}.`);
    await session.detach();
    return path;
}

/** Drops files, { name: bytes }, on the page. What was drawn or said before is taken away, so that a wait sees what is
 * new. */
export async function dropped(page, files) {
    const list = Object.entries(files).map(([name, bytes]) => [name, Buffer.from(bytes).toString("base64")]);
    await page.evaluate(async (list) => {
        document.querySelector(".sheet")?.classList.remove("drawn");
        document.querySelector(".status").classList.remove("wrong");
        const transfer = new DataTransfer();
        for (const [name, text] of list)
            transfer.items.add(new File([await (await fetch(`data:;base64,${text}`)).arrayBuffer()], name));
        dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer: transfer }));
    }, list);
}

/** The sentence that says what is wrong. */
export async function said(page) {
    await page.waitForFunction(() => document.querySelector(".status.wrong"));
    return page.$eval(".status", (status) => status.textContent);
}

/** The page presses Cancel, once what is being done has a word in its name: by itself, since it may be done before a
 * test has looked. Then `pressed` is there, and says whether the work was gone at once. */
export async function cancelNext(page, word = "") {
    const watch = (word) => {
        const seen = new MutationObserver(() => {
            const work = document.querySelector(".work:not([hidden])");
            if (!work?.textContent.includes(word)) return;
            seen.disconnect();
            work.querySelector("button").click();
            globalThis.pressed = { gone: work.hidden };
        });
        seen.observe(document, { subtree: true, childList: true, attributes: true, characterData: true });
    };
    await page.evaluate(watch, word);
    await page.evaluateOnNewDocument(watch, word);
}
/** The sentence that says what was cancelled. */
export async function cancelled(page) {
    await page.waitForFunction(() => /^Cancelled/.test(document.querySelector(".status")?.textContent));
    return page.$eval(".status", (status) => status.textContent);
}

export const pause = (milliseconds) => new Promise((resume) => setTimeout(resume, milliseconds));
/** Waits until something holds: other tests may keep the processors busy. */
export async function until(holds) {
    for (const began = performance.now(); !await holds(); await pause(50))
        assert.ok(performance.now() - began < MOST, `never: ${holds}`);
}

/* What a page holds, once garbage is collected: { heap, nodes }. */
async function counted(page, session) {
    await session.send("HeapProfiler.collectGarbage");
    const { JSHeapUsedSize } = await page.metrics(), { nodes } = await session.send("Memory.getDOMCounters");
    return { heap: JSHeapUsedSize, nodes };
}
/** What a page holds: documents of pictures come and go, so the least counts of some seconds are what stays. */
export async function held(page) {
    const session = await page.createCDPSession(), least = { heap: Infinity, nodes: Infinity };
    for (let round = 0; round < 10; round++) {
        const { heap, nodes } = await counted(page, session);
        least.heap = Math.min(least.heap, heap);
        least.nodes = Math.min(least.nodes, nodes);
        await pause(300);
    }
    await session.detach();
    return least;
}
/** After `count` more scenes a page holds no more than `before`, sooner or later: not one more node for each. */
export async function assertHeld(page, before, count) {
    const session = await page.createCDPSession();
    let after;
    for (let round = 0; round < 200; round++) {
        after = await counted(page, session);
        if (after.heap < before.heap + 1e6 && after.nodes < before.nodes + count && page.workers().length <= 2) return;
        await pause(300);
    }
    assert.fail(`${JSON.stringify(before)} grow to ${JSON.stringify(after)} and ${page.workers().length} workers`);
}
