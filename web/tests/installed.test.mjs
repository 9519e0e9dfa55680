// The package as `npm pack` makes it and `npm install` installs it in an empty folder: in Node, in a thread of Node, in
// Chromium by a plain script, and word for word as its documents show it.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, test } from "node:test";
import { launch, open, serve } from "./browser.mjs";
import { examples, froe, installed, package_, root, run, scratch } from "./support.mjs";

const folder = installed();
let scripts = 0;
const script = (text, name = `examples/${scripts++}.mjs`) => {
    writeFileSync(scratch(name), text);
    return name;
};

/** What every place must print: answers, a picture and a saved tree as one number each. */
const WORK = `
const hash = (bytes) => bytes.reduce((sum, byte) => (Math.imul(sum, 31) + byte) | 0, 7);
export async function work({ load }) {
    const froe = await load();
    const tree = froe.generate("terrain", 400).build({ purpose: "draw" });
    const { objects, t } = tree.ray([0, 0, 1, 5, 5, 1], [1, 1, -1, 1, -2, -1]);
    return [hash(tree.save()), hash(tree.render({ shading: "cel" }).bytes), objects.join(), t.join(), tree.report.fragments].join(" ");
}`;
script(WORK, "work.mjs");
const said = run(process.execPath, [script('import * as froe from "froe"; import { work } from "../work.mjs"; console.log(await work(froe));')]);

test("the parts of the package are all there, with one version", () => {
    const about = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const project = /^project\(froe VERSION ([0-9.]+)/m.exec(readFileSync(join(root, "CMakeLists.txt"), "utf8"))[1];
    assert.equal(about.version, project);
    for (const file of ["README.md", "LICENSE", "index.d.ts", "simd/froe.wasm", "plain/froe.wasm"]) readFileSync(join(folder, file));
});

test("the version of the module is that of the project", async () => {
    const about = JSON.parse(readFileSync(join(package_, "package.json"), "utf8"));
    assert.equal((await froe.load()).version, about.version);
});

test("Node: the same with and without vector instructions", () => {
    assert.match(said, /^-?\d+ -?\d+ \d+,\d+ /);
    assert.equal(run(process.execPath, [script('import * as froe from "froe/plain"; import { work } from "../work.mjs"; console.log(await work(froe));')]), said);
});

test("a thread of Node gives the same", () => {
    script('import { parentPort } from "node:worker_threads"; import * as froe from "froe"; import { work } from "./work.mjs"; parentPort.postMessage(await work(froe));', "thread.mjs");
    const main = 'import { Worker } from "node:worker_threads"; new Worker(new URL("../thread.mjs", import.meta.url)).on("message", (text) => console.log(text));';
    assert.equal(run(process.execPath, [script(main)]), said);
});

for (const [document, least] of [["web/package/README.md", 4], ["docs/howto/javascript.md", 6], ["README.md", 1]])
    test(`what ${document} shows is what is printed`, () => {
        const list = examples(document).filter(({ language }) => language === "js");
        assert.ok(list.length >= least);
        for (const { body, shown } of list) {
            const said = run(process.execPath, [script(body)]);
            if (shown !== null) assert.equal(said, shown, body);
        }
    });

test("Chromium: a plain script, a worker, and the predicates", async (t) => {
    const chromium = await launch(), site = await serve(scratch()), checks = await serve(process.env.FROE_CHECK);
    after(async () => { await chromium.stop(); site.stop(); checks.stop(); });
    const page = async (at, name, body) => {
        const map = '<script type="importmap">{ "imports": { "froe": "./node_modules/froe/index.js" } }</script>';
        writeFileSync(name, `<!doctype html><title>froe</title>${map}<script type="module">${body}</script>`);
        return open(chromium.browser, at);
    };
    const shown = (opened) => opened.waitForFunction("globalThis.said").then((value) => value.jsonValue());

    await t.test("a plain script gives what Node gives", async () => {
        const opened = await page(`${site.url}script.html`, scratch("script.html"),
            'import * as froe from "froe"; import { work } from "./work.mjs"; globalThis.said = await work(froe) + "\\n";');
        assert.equal(await shown(opened), said);
        assert.deepEqual(opened.wrong.filter((text) => !text.includes("404")), []);
    });
    await t.test("so does a worker", async () => {
        script('import * as froe from "./node_modules/froe/index.js"; import { work } from "./work.mjs"; postMessage(await work(froe) + "\\n");', "worker.js");
        const opened = await page(`${site.url}worker.html`, scratch("worker.html"),
            'new Worker("./worker.js", { type: "module" }).onmessage = (event) => { globalThis.said = event.data; };');
        assert.equal(await shown(opened), said);
    });
    for (const kind of ["simd", "plain"])
        await t.test(`predicates are the same by filters as by exact numbers (${kind})`, async () => {
            const opened = await page(`${checks.url}${kind}.html`, join(process.env.FROE_CHECK, `${kind}.html`),
                `import start from "./${kind}/check.js"; const lines = [];
                const module = await start({ print: (line) => lines.push(line), locateFile: (name) => "./${kind}/" + name });
                lines.push(String(module._check(1000000, 2))); globalThis.said = lines;`);
            const lines = await shown(opened);
            assert.equal(lines.at(-1), "0");
            assert.match(lines[0], /^filters trusted, formulas right, \d{7} decisions, 0 wrong$/);
        });
});
