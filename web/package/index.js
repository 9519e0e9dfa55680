/* index.js: froe for browsers, workers and Node.
 *
 *     import { load } from "froe";
 *     const froe = await load();
 *     const tree = froe.segments(xyxy).build({ purpose: "query" });     // Float64Array, 4 numbers a segment
 *     for (const ids of tree.query([0, 0, 1, 1])) console.log(ids);
 */
import { Answers } from "./answers.js";
import { Core, FroeError, NONE } from "./core.js";
import { Scene } from "./scene.js";
import { Tree } from "./tree.js";

export { Answers, FroeError, NONE, Scene, Tree };

/* Node has no fetch for files. */
async function bytesOf(url) {
    if (url.protocol !== "file:") return undefined;
    const { readFile } = await import(/* @vite-ignore */ "node:fs/promises");
    return readFile(url);
}

/** Loads froe. Options: `plain`, true: without the vector instructions of WebAssembly, for old browsers; `progress`, a
 * function that is told the share done, 0 to 1, while a call runs. */
export async function load({ plain = false, progress = null } = {}) {
    const folder = new URL(plain ? "./plain/" : "./simd/", import.meta.url);
    const { default: start } = await import(new URL("froe.js", folder).href);
    const binary = await bytesOf(new URL("froe.wasm", folder));
    const wasm = await start({
        locateFile: (name) => new URL(name, folder).href,
        progress: (done) => progress?.(done),
        ...(binary ? { wasmBinary: binary } : {}),
    });
    return new Froe(new Core(wasm));
}

export class Froe {
    #core;

    constructor(core) { this.#core = core; }

    get version() { return this.#core.text("froe_version"); }

    /** Bytes that froe has of the memory of the page. It never gives any back, and uses again what was freed. */
    get memory() { return this.#core.size; }

    /** An empty scene of 2 to 8 dimensions. */
    scene(dim) { return Scene.empty(this.#core, dim); }
    /** Segments of the plane (dim 2), 4 numbers each, or in space. */
    segments(coords, { dim = 2, ...more } = {}) { return this.scene(dim).add({ kind: "segment", coords, ...more }); }
    /** Triangles in space: vertices, 3 numbers each, and 3 indices for each triangle; without these 9 numbers each. */
    triangles(coords, indices, more = {}) { return this.scene(3).add({ kind: "polygon", coords, indices, ...more }); }
    points(coords, { dim = 2, ...more } = {}) { return this.scene(dim).add({ kind: "point", coords, ...more }); }
    /** Boxes: of each its lower corner, then its upper. */
    boxes(coords, { dim = 2, ...more } = {}) { return this.scene(dim).add({ kind: "box", coords, ...more }); }

    /** Reads the bytes of a file of a format that needs no library: CSV, GeoJSON, OBJ, OFF, PLY. `files`: others that
     * it names, as { "house.mtl": bytes }. */
    read(name, bytes, files = {}) {
        const core = this.#core, folder = "/read";
        const put = (file, content) => core.fs.writeFile(`${folder}/${file.replace(/.*[/\\]/, "")}`, content);
        core.fs.mkdir(folder);
        try {
            for (const [file, content] of Object.entries({ ...files, [name]: bytes })) put(file, content);
            return core.within((arena) => {
                const out = arena.room(4), format = arena.room(64);
                core.call("web_read", arena.text(`${folder}/${name.replace(/.*[/\\]/, "")}`), arena.text(name), out, format);
                return new Scene(core, core.uint(out));
            });
        } finally {
            for (const file of core.fs.readdir(folder)) if (!file.startsWith(".")) core.fs.unlink(`${folder}/${file}`);
            core.fs.rmdir(folder);
        }
    }
    /** A made-up scene of about n objects: "segments", "hills", ... */
    generate(kind, n, seed = 1) {
        return this.#core.within((arena) => {
            const out = arena.room(4);
            this.#core.call("web_generate", arena.text(kind), n, seed, out);
            return new Scene(this.#core, this.#core.uint(out));
        });
    }
    /** Opens the bytes of a saved tree. */
    open(bytes) {
        return this.#core.within((arena) => {
            const out = arena.room(4);
            this.#core.call("froe_tree_open_memory", arena.array(Uint8Array.from(bytes)), bytes.length, 0, out);
            return new Tree(this.#core, this.#core.uint(out));
        });
    }
}
