/* index.js: froe for browsers, workers and Node.
 *
 *     import { load } from "froe";
 *     const froe = await load();
 *     const tree = froe.segments(xyxy).build({ purpose: "query" });     // Float64Array, 4 numbers a segment
 *     for (const ids of tree.query([0, 0, 1, 1])) console.log(ids);
 */
import { Core } from "./core.js";
import { Froe } from "./froe.js";
import { given, listener } from "./given.js";
import { fromNode } from "./node.js";

export { Answers } from "./answers.js";
export { FroeError, NONE } from "./core.js";
export { EVENTS, Kinetic } from "./kinetic.js";
export { Motion } from "./motion.js";
export { KINDS, Scene } from "./scene.js";
export { CUTS, Tree } from "./tree.js";
export { Froe };

/* A module of one function that makes a vector: () => v128.const 0; i8x16.all_true. */
const VECTOR = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 127, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253,
    15, 253, 99, 11);

/* Both are spelled out, so that bundlers find them. */
const FOLDERS = {
    simd: { start: () => import("./simd/froe.js"), url: () => new URL("./simd/froe.wasm", import.meta.url) },
    plain: { start: () => import("./plain/froe.js"), url: () => new URL("./plain/froe.wasm", import.meta.url) },
};

/* Node has no fetch for files, and before 19 no global that draws random numbers, of which names of files are made. */
async function bytesOf(url) {
    if (url.protocol !== "file:") return {};
    if (!globalThis.crypto) globalThis.crypto = (await fromNode("crypto")).webcrypto;
    const { readFile } = await fromNode("fs/promises");
    return { wasmBinary: await readFile(url) };
}

/** Loads froe. Options: `plain`, true: without the vector instructions of WebAssembly, as is done by itself where there are
 * none; `progress`: see Froe. */
export async function load(options) {
    const { plain, progress } = given(options, { plain: !WebAssembly.validate(VECTOR), progress: null });
    listener(progress);
    const { start, url } = plain ? FOLDERS.plain : FOLDERS.simd;
    const { default: make } = await start();
    const core = new Core(await make({ locateFile: () => url().href, ...(await bytesOf(url())) }));
    core.progress = progress;
    return new Froe(core);
}
