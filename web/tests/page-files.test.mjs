// Files on the page: each format is dropped, turned and taken away; broken and huge ones are refused in a sentence.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { drawn, dropped, launch, open, press, said, saved, serve, settled, test } from "./browser.mjs";

const data = (name) => readFileSync(new URL(`../../data/${name}`, import.meta.url));
const text = (content) => Buffer.from(content);
const folders = mkdtempSync(join(tmpdir(), "froe-files-"));
let site, chromium, page;
before(async () => {
    site = await serve();
    chromium = await launch();
    page = await open(chromium.browser, `${site.url}#draw?scene=bracket`);
    await drawn(page);
});
after(async () => { await chromium?.stop(); site?.stop(); rmSync(folders, { recursive: true }); });

/* A tetrahedron in each format. */
const POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], FACES = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]];
const ply = text(`ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n` +
    `property list uchar int vertex_indices\nend_header\n${POINTS.map((p) => p.join(" ")).join("\n")}\n${FACES.map((f) => `3 ${f.join(" ")}`).join("\n")}\n`);
const obj = text(`mtllib red.mtl\nusemtl red\n${POINTS.map((p) => `v ${p.join(" ")}`).join("\n")}\n${FACES.map((f) => `f ${f.map((i) => i + 1).join(" ")}`).join("\n")}\n`);
const mtl = text("newmtl red\nKd 1 0 0\n");
const asciiStl = text(`solid t\n${FACES.map((f) => `facet normal 0 0 0\nouter loop\n${f.map((i) => `vertex ${POINTS[i].join(" ")}`).join("\n")}\nendloop\nendfacet`).join("\n")}\nendsolid t\n`);
const binaryStl = (() => {
    const bytes = Buffer.alloc(84 + 50 * FACES.length);
    bytes.writeUInt32LE(FACES.length, 80);
    FACES.forEach((face, f) => face.forEach((i, c) => POINTS[i].forEach((x, k) => bytes.writeFloatLE(x, 84 + 50 * f + 12 + 12 * c + 4 * k))));
    return bytes;
})();
const bin = Buffer.concat([Buffer.from(Float32Array.from(POINTS.flat()).buffer), Buffer.from(Uint16Array.from(FACES.flat()).buffer)]);
const gltf = (uri) => text(JSON.stringify({ asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, name: "tetrahedron" }],
    materials: [{ name: "red", pbrMetallicRoughness: { baseColorFactor: [1, 0, 0, 1] } }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 4, type: "VEC3", min: [0, 0, 0], max: [1, 1, 1] },
        { bufferView: 1, componentType: 5123, count: 12, type: "SCALAR" }],
    bufferViews: [{ buffer: 0, byteOffset: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 24 }],
    buffers: [{ uri, byteLength: bin.length }] }));
/* The same in one file: a header of 12 bytes, then chunks of a length, a name and bytes. */
const glb = (() => {
    const chunk = (name, bytes, filler) => {
        const head = Buffer.alloc(8), rest = Buffer.alloc(-bytes.length & 3, filler);
        head.writeUInt32LE(bytes.length + rest.length);
        head.write(name, 4, "latin1");
        return Buffer.concat([head, bytes, rest]);
    };
    const chunks = Buffer.concat([chunk("JSON", gltf(undefined), " "), chunk("BIN\0", bin, "\0")]), head = Buffer.from("glTF\x02\0\0\0\0\0\0\0", "latin1");
    head.writeUInt32LE(12 + chunks.length, 8);
    return Buffer.concat([head, chunks]);
})();

const FILES = {
    "GLB": { "t.glb": glb }, "OBJ": { "teapot.obj": data("utah-teapot.obj") }, "OFF": { "bracket.off": data("bracket.off") },
    "PLY": { "t.ply": ply }, "STL as text": { "t.stl": asciiStl }, "STL in bytes": { "t.stl": binaryStl },
    "OBJ with its MTL": { "t.obj": obj, "red.mtl": mtl }, "glTF with its BIN": { "t.bin": bin, "t.gltf": gltf("t.bin") },
};
for (const [format, files] of Object.entries(FILES))
    test(`${format} is dropped, turned and taken away`, async () => {
        const folder = mkdtempSync(join(folders, "format-")), name = Object.keys(files).at(format.startsWith("glTF") ? 1 : 0).replace(/\.\w+$/, "");
        await dropped(page, files);
        await drawn(page);
        const first = await page.$eval(".drawing", (image) => image.src);
        await press(page, "canvas", ["ArrowLeft", "ArrowUp"]);
        await page.waitForFunction((old) => document.querySelector(".drawn") && document.querySelector(".drawing").src !== old, {}, first);
        const taken = {};
        for (const [label, ending] of [["Save as SVG", "svg"], ["Save as PDF", "pdf"], ["Save as PNG", "png"]])
            taken[ending] = readFileSync(await saved(page, folder, label, `${name}.${ending}`)).toString("latin1");
        assert.match(taken.svg, /^<svg[^>]*>[^]*<path fill="#[0-9a-f]{3,6}"[^]*<\/svg>\s*$/);
        assert.match(taken.pdf, /^%PDF-1\.4[^]*%%EOF\s*$/);
        assert.equal(taken.png.slice(1, 4), "PNG");
        if (/MTL|BIN|GLB/.test(format)) assert.match(taken.svg, /fill="#([4-9a-f][0-9a-f]0000|[4-9a-f]00)"/);
        assert.deepEqual(page.wrong, []);
    });

test("the preview shows models of every size", async () => {
    let looks = 0;
    const inked = async (scale, more) => {
        const corners = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 1]].map((corner) => `v ${corner.map((x) => x * scale).join(" ")}\n`);
        await dropped(page, { "t.obj": text(`${corners.join("")}f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n`) });
        await drawn(page);
        // The address may still be that of the view before, which the page forgot with the file before: a number that no room
        // knows makes each address a new one. The page has entered it before this listener.
        await page.evaluate((hash) => new Promise((entered) => {
            addEventListener("hashchange", entered, { once: true });
            location.hash = hash;
        }), `#draw?scene=file&${more}&look=${++looks}`);
        await page.waitForFunction(() => document.querySelector(".sheet.drawn"));
        await page.evaluate(() => new Promise((painted) => { // the preview is drawn by the next frame
            document.querySelector(".sheet").classList.remove("drawn");
            requestAnimationFrame(() => requestAnimationFrame(painted));
        }));
        const shot = (await (await page.$(".sheet canvas")).screenshot()).toString("base64");
        return page.evaluate(async (shot) => {
            const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${shot}`)).blob());
            const paint = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
            paint.drawImage(bitmap, 0, 0);
            const all = new Uint32Array(paint.getImageData(0, 0, bitmap.width, bitmap.height).data.buffer), { length } = all, ground = all[bitmap.width * 8 + 8];
            return all.filter((colour) => colour !== ground).length / length;
        }, shot);
    };
    for (const more of ["parallel=no", "parallel=yes", "section=x"]) {
        const usual = await inked(1, more);
        assert.ok(usual > 0.05 && usual < 0.9, `${more}: ${usual}`);
        for (const scale of [1e-60, 1e60, 1e300]) assert.ok(Math.abs(await inked(scale, more) - usual) < 0.01, `${more}, ${scale}`);
    }
});

test("a model turns in an SVG of its own", async () => {
    const folder = mkdtempSync(join(folders, "turning-"));
    await dropped(page, { "t.ply": ply });
    await settled(page);
    const svg = readFileSync(await saved(page, folder, "Turning SVG", "t-turning.svg")).toString();
    assert.ok(svg.match(/<animate|@keyframes|animation/) && svg.split("<g").length > 20);
});

const BROKEN = {
    "an OBJ that names a corner that is not there": [{ "a.obj": text("v 0 0 0\nv 1 0 0\nf 1 2 7\n") }, /a\.obj.*\.$/],
    "a GLB that is cut off": [{ "a.glb": data("fzk-haus.glb").subarray(0, 5000) }, /^a\.glb could not be read as glTF: .*\.$/],
    "a GLB that is none": [{ "a.glb": text("This is no model.") }, /a\.glb could not be read as glTF/],
    "a glTF without its BIN": [{ "t.gltf": gltf("the%20t.bin") }, /t\.gltf could not be read as glTF: it needs the t\.bin, which/],
    "a glTF without anything": [{ "a.gltf": text('{ "asset": { "version": "2.0" } }') }, /^a\.gltf could not be read as glTF: it is damaged or not complete\.$/],
    "an STL with NaN": [{ "a.stl": Buffer.concat([binaryStl.subarray(0, 96), Buffer.from([0, 0, 0xc0, 0x7f]), binaryStl.subarray(100)]) }, /^a\.stl: corner 0 of polygon 0: .* nan/],
    "an STL as text with NaN": [{ "a.stl": text(asciiStl.toString().replace("vertex 1 0 0", "vertex NaN 0 0")) }, /^a\.stl has a triangle without three corners\.$/],
    "two scenes": [{ "a.ply": ply, "red.mtl": mtl, "b.obj": obj }, /^a\.ply and b\.obj are two scenes, which are opened one by one\.$/],
    "pictures alone": [{ "a.png": text("x"), "t.bin": bin }, /^a\.png is not of a format that is read here/],
    "an STL that is none": [{ "a.stl": text("This is no model at all, but it is long enough to have a header of eighty bytes, and four more bytes after it.") }, /a\.stl could not be read as STL: [^]*\.$/],
    "a PLY without an end": [{ "a.ply": ply.subarray(0, 100) }, /a\.ply/],
    "a PLY with NaN": [{ "a.ply": text(ply.toString().replace("1 0 0", "nan 0 0")) }, /a\.ply/],
    "an empty file": [{ "a.obj": Buffer.alloc(0) }, /^a\.obj is empty\.$/],
    "a file of another kind": [{ "a.docx": text("x") }, /a\.docx is not of a format that is read here: /],
    "a map": [{ "a.geojson": data("freedoom-e1m1.geojson") }, /^This file is a map\. .*\.$/],
};
for (const [what, [files, sentence]] of Object.entries(BROKEN))
    test(`${what} is refused in a sentence`, async () => {
        await dropped(page, files);
        const told = await said(page);
        assert.match(told, sentence);
        assert.match(told, /^([A-Z]|[at]\.)[^]* [^]*[.!?]$/);
        const disabled = () => page.$$eval("button", (all) => all.filter((it) => /^(Save as|Turning|Saved)/.test(it.getAttribute("aria-label") ?? it.textContent)).map((it) => it.disabled));
        assert.deepEqual(await disabled(), new Array(5).fill(true)); // there is nothing to take away
        await dropped(page, { "t.ply": ply });
        await drawn(page);
        assert.deepEqual(await disabled(), new Array(5).fill(false));
        page.wrong.length = 0;
    });

test("of a scene that could not be read nothing is shown or saved, neither of it nor of the one before", async () => {
    await dropped(page, { "t.ply": ply });
    await settled(page);
    await dropped(page, { "x.obj": text("f 1 2 3\n") });
    await said(page);
    assert.deepEqual(await page.$eval(".sheet", (sheet) => [sheet.classList.contains("drawn"), getComputedStyle(sheet.querySelector("canvas")).opacity]), [false, "0"]);
    const taken = await page.evaluate(async () => {
        const names = [], { click } = HTMLAnchorElement.prototype, before = document.querySelector(".status").textContent;
        HTMLAnchorElement.prototype.click = function () { names.push(this.download); };
        for (const button of document.querySelectorAll(".three button, .two button")) button.click();
        await new Promise((resume) => setTimeout(resume, 500));
        HTMLAnchorElement.prototype.click = click;
        return [names, before === document.querySelector(".status").textContent];
    });
    assert.deepEqual(taken, [[], true]);
    page.wrong.length = 0;
});

test("a scene is found among what it names, and one that cannot be seen is told of", async () => {
    await dropped(page, { "a readme.txt": text("Read me."), "red.mtl": mtl, "t.obj": obj });
    await drawn(page);
    assert.match(await page.$eval(".panel", (panel) => panel.textContent), /t\.obj stays in this browser/);
    assert.match(await page.$eval(".status", (status) => status.textContent), /^Exact\. \d shapes?, \d+ lines?, .* from 4 pieces of 4 objects$/);
    const long = `${"x".repeat(200)}.off`, off = (x) => text(`OFF\n3 1 0\n0 0 0\n1 0 0\n${x} 1 0\n3 0 1 2\n`);
    await dropped(page, { [long]: off(0) });
    await drawn(page);
    assert.match(await page.$eval(".status", (status) => status.textContent), /^Exact\. 1 shape, 1 line, .* from 1 piece of 1 object$/);
    assert.ok(await page.$eval(".panel", (panel) => panel.scrollWidth <= panel.clientWidth));
    await dropped(page, { "flat.off": text("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n") });
    await drawn(page);
    assert.match(await page.$eval(".status", (status) => status.textContent), /^Exact\. Nothing is visible, /);
    page.wrong.length = 0;
});

test("a huge file is refused before it is read, and a large model before it is built", async () => {
    await page.evaluate(() => {
        const file = new File([], "huge.stl");
        Object.defineProperty(file, "size", { value: 3e9 });
        const event = new DragEvent("drop", { bubbles: true, cancelable: true });
        Object.defineProperty(event, "dataTransfer", { value: { types: ["Files"], files: [file] } });
        dispatchEvent(event);
    });
    assert.match(await said(page), /huge\.stl has 3000 MB, and a page can read 600 MB at most/);
    await dropped(page, { "large.stl": grid(400) });
    await page.waitForFunction(() => /319,?000|320,?000/.test(document.querySelector(".status").textContent));
    assert.match(await page.$eval(".status", (status) => status.textContent), /takes about \d+ seconds and/);
    await page.evaluate(() => [...document.querySelectorAll(".status button")].find((button) => button.textContent === "Leave it").click());
    assert.equal(await page.$eval(".status", (status) => status.textContent), "Not drawn.");
});

/* n x n squares, two triangles each, as STL. */
function grid(n) {
    const bytes = Buffer.alloc(84 + 100 * n * n);
    bytes.writeUInt32LE(2 * n * n, 80);
    let at = 84;
    const corner = (x, y) => { bytes.writeFloatLE(x, at), bytes.writeFloatLE(y, at + 4), bytes.writeFloatLE(x % 7, at + 8), at += 12; };
    for (let x = 0; x < n; x++)
        for (let y = 0; y < n; y++)
            for (const corners of [[[0, 0], [1, 0], [1, 1]], [[0, 0], [1, 1], [0, 1]]]) {
                at += 12;
                for (const [i, j] of corners) corner(x + i, y + j);
                at += 2;
            }
    return bytes;
}
