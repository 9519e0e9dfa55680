/* froe.js: what a loaded module makes */
import { Motion } from "./motion.js";
import { given, listener, shown, text, typed, whole } from "./given.js";
import { Scene } from "./scene.js";
import { Tree } from "./tree.js";

const READ = ["features", "groups", "linearised", "flattened", "triangulated", "skipped", "noGeometry", "wrapped", "textures",
    "unread"]; // as in web/core/scene.c
const READ_TEXTS = { format: [0, 64], precision: [64, 16], unreadName: [80, 64] };
const KINDS = ["point", "segment", "polygon", "box", "ball", "hull"];

/* A 64-bit number as WebAssembly takes it: its low and its high half. */
function halves(n) {
    const seed = whole(typeof n === "bigint" ? Number(n) : n, "seed", 0, Number.MAX_SAFE_INTEGER);
    return [seed % 2 ** 32, Math.floor(seed / 2 ** 32)];
}

export class Froe {
    #core;

    constructor(core) { this.#core = core; }

    get version() { return this.#core.text("froe_version"); }
    /** Bytes that froe has of the memory of the page, at most 4 GB. It never gives any back, and uses again what was
     * freed. */
    get memory() { return this.#core.size; }
    /** A function that is told the share done, 0 to 1, now and then while a call runs; if it returns false or throws, the
     * call ends. It cannot use froe itself. Or null. */
    get progress() { return this.#core.progress; }
    set progress(progress) {
        this.#core.progress = listener(progress);
    }

    /** An empty scene of 2 to 8 dimensions. */
    scene(dim) {
        if (!Number.isInteger(dim) || dim < 2 || dim > 8) throw new RangeError(`A scene has 2 to 8 dimensions, and not ${shown(dim)}.`);
        return Scene.made(this.#core, this.#core.made("froe_scene_new", dim, 0));
    }
    /** Segments of the plane (dim 2), 4 numbers each, or in space. */
    segments(coords, more) { return this.#filled("segment", coords, more); }
    /** Triangles in space: vertices, 3 numbers each, and 3 indices for each triangle; without these 9 numbers each. */
    triangles(coords, indices, more) { return this.#filled("polygon", coords, { dim: 3, indices, ...given(more) }); }
    points(coords, more) { return this.#filled("point", coords, more); }
    /** Boxes: of each its lower corner, then its upper. */
    boxes(coords, more) { return this.#filled("box", coords, more); }
    #filled(kind, coords, more) {
        const { dim = 2, ...batch } = given(more);
        return this.scene(dim).add({ ...batch, kind, coords });
    }

    /* `body` with the path of a file of these bytes; `files` are others that it names. */
    #file(name, bytes, files, body) {
        return this.#core.files(({ path, put }) => {
            for (const [other, content] of Object.entries({ ...given(files), [text(name, "The name of a file")]: bytes })) {
                if (!(content instanceof Uint8Array)) throw new TypeError(`The file '${other}' is not given as a Uint8Array, but as ${shown(content)}.`);
                put(other, content);
            }
            return this.#core.within((arena) => body(arena, arena.text(path(name))));
        });
    }
    /** Reads the bytes of a file of a format that needs no library: CSV, GeoJSON, OBJ, OFF, PLY. Options: `files`, others
     * that it names, as { "house.mtl": bytes }; faces ("triangles", "polygons"), boxes, wrap. */
    read(name, bytes, options) {
        const core = this.#core, { files, ...how } = given(options);
        return this.#file(name, bytes, files, (arena, path) => {
            const report = arena.room(144 + 8 * READ.length);
            const scene = Scene.made(core, core.made("web_read", path, core.options(arena, "read", { ...how, name }), report));
            const numbers = core.copy(Float64Array, report + 144, READ.length);
            const texts = Object.entries(READ_TEXTS).map(([text, [offset]]) => [text, core.string(report + offset)]);
            scene.source = { ...Object.fromEntries(texts), ...Object.fromEntries(READ.map((field, i) => [field, numbers[i]])) };
            return scene;
        });
    }
    /** Opens the bytes of a saved tree. */
    open(bytes) {
        const core = this.#core, copy = typed(Uint8Array, bytes, "bytes");
        return core.within((arena) => Tree.made(core, core.made("froe_tree_open_memory", arena.array(copy), copy.length, 0)));
    }

    /* All kinds that a function lists, in structs of so many bytes. */
    #listed(name, words, take) {
        const list = [];
        for (let i = 0, at; (at = this.#core.get(name, i) >>> 0); i++) list.push(take(this.#core.copy(Uint32Array, at, words)));
        return list;
    }
    /** Kinds of made-up scenes: { name, dim, kind, summary, usual }. */
    generators() {
        return this.#listed("froe_generator_at", 5, ([name, dim, kind, summary, usual]) => ({ name: this.#core.string(name), dim,
            kind: KINDS[kind], summary: this.#core.string(summary), usual: (usual & 0xff) !== 0 }));
    }
    /** A made-up scene of about n objects: "segments", "terrain", ... */
    generate(kind, n, seed = 1) {
        const core = this.#core;
        return core.within((arena) => Scene.made(core, core.made("froe_generate", arena.text(text(kind, "kind")), whole(n, "n"), ...halves(seed), 0)));
    }

    /** Nothing that moves yet: { dim, begin, end, tick }. */
    motion(options) { return Motion.of(this.#core, options); }
    /** Kinds of made-up motions: { name, dim, summary, usual }. */
    motionGenerators() {
        return this.#listed("froe_motion_generator_at", 4, ([name, dim, summary, usual]) =>
            ({ name: this.#core.string(name), dim, summary: this.#core.string(summary), usual: (usual & 0xff) !== 0 }));
    }
    /** About n moving objects, from time 0 to 60. */
    generateMotion(kind, n, seed = 1) {
        const core = this.#core;
        return core.within((arena) => Motion.made(core, core.made("froe_generate_motion", arena.text(text(kind, "kind")), whole(n, "n"), ...halves(seed), 0)));
    }
    /** Reads the bytes of a file of OGC Moving Features JSON. */
    readMotion(name, bytes) {
        return this.#file(name, bytes, {}, (arena, path) => Motion.made(this.#core, this.#core.within((inner) => {
            const out = inner.room(4);
            this.#core.call("froe_read_motion", path, 0, out, 0);
            return this.#core.uint(out);
        })));
    }
}
