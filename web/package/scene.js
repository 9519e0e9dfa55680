/* scene.js: scenes, and how they become trees */
import { FroeError } from "./core.js";
import { Tree } from "./tree.js";

const ARRAYS = { coords: Float64Array, indices: Uint32Array, starts: Uint32Array, radii: Float64Array, tags: BigUint64Array,
    faces: Uint32Array, groups: Uint32Array };
const CORNERS = { point: 1, segment: 2, polygon: 3, box: 2, ball: 1, hull: 1 };

/** Numbers as the array that froe takes: as they are where they are one, copied where not. */
function typed(Type, values, name) {
    if (values instanceof Type) return values;
    if (ArrayBuffer.isView(values) || Array.isArray(values)) return Type.from(values);
    throw new TypeError(`${name} is not an array of numbers.`);
}

/** A set of objects in space of some dimension. Coordinates are kept exactly; objects have the ids 0, 1, ... in the order
 * in which they are added. */
export class Scene {
    #core;
    #held;

    constructor(core, address) {
        this.#core = core;
        this.#held = core.watch(this, [["froe_scene_free", address]]);
    }
    static empty(core, dim) {
        return core.within((arena) => {
            const out = arena.room(4);
            core.status("froe_scene_new", dim, 0, out);
            return new Scene(core, core.uint(out));
        });
    }

    get dim() { return this.#core.get("froe_scene_dim", this.#at); }
    get objectCount() { return this.#core.get("froe_scene_object_count", this.#at); }
    get groupCount() { return this.#core.get("froe_scene_group_count", this.#at); }
    get #at() {
        if (!this.#held.length) throw new FroeError("FROE_E_ARG", "The scene has been freed.");
        return this.#held[0][1];
    }

    /** Adds objects of one kind: "point", "segment", "polygon", "box", "ball" or "hull". `coords` are points, one after
     * the other; object i has the corners starts[i] .. starts[i + 1], or as many as its kind has (polygons: 3); with
     * `indices` corner c is the point indices[c]. All objects are added, or none. */
    add({ kind, coords, count, group, ...arrays }) {
        if (!(kind in CORNERS)) throw new TypeError(`There is no kind of objects called ${kind}.`);
        const given = { coords, ...arrays }, options = { kind };
        for (const [name, values] of Object.entries(given)) {
            if (values === undefined || values === null) continue;
            if (!(name in ARRAYS)) throw new TypeError(`A batch of objects has no ${name}.`);
            options[name] = typed(ARRAYS[name], values, name);
        }
        const points = options.coords.length / this.dim;
        const corners = options.indices ? options.indices.length : points;
        options.count = count ?? (options.starts ? options.starts.length - 1 : corners / CORNERS[kind]);
        if (!Number.isInteger(points) || !Number.isInteger(options.count))
            throw new TypeError(`coords has ${options.coords.length} numbers, which are no whole ${kind}s.`);
        this.#lengths(options, corners, kind);
        if (options.indices) options.pointCount = points;
        if (group !== undefined) options.group = group;
        this.#core.within((arena) =>
            this.#core.call("froe_scene_add", this.#at, this.#core.options(arena, "objects", options)));
        return this;
    }
    /* What froe reads beyond the end of an array that is too short, it cannot know. */
    #lengths(options, corners, kind) {
        const n = options.count;
        const ends = options.starts ? options.starts[n] : n * CORNERS[kind];
        if (options.starts && (options.starts.length < n + 1 || options.starts[0] !== 0 ||
            options.starts.some((start, i) => i && start < options.starts[i - 1])))
            throw new TypeError("starts does not begin with 0, or is not ascending.");
        if (ends > corners) throw new TypeError(`${n} ${kind}s have ${ends} corners, and only ${corners} are given.`);
        for (const name of ["radii", "tags", "faces", "groups"])
            if (options[name] && options[name].length < n)
                throw new TypeError(`${name} has ${options[name].length} numbers for ${n} objects.`);
        if (kind === "ball" && !options.radii) throw new TypeError("Balls have radii.");
    }

    /** Adds what objects may share: a name, a material, a colour (0xRRGGBBAA). Returns its number, for `groups`. */
    addGroup({ name = "", material = "", colour = 0 }) {
        return this.#core.within((arena) => {
            const out = arena.room(4);
            this.#core.status("web_scene_add_group", this.#at, arena.text(name), arena.text(material), colour >>> 0, out);
            return this.#core.uint(out);
        });
    }
    group(i) {
        return { name: this.#core.text("web_scene_group_name", this.#at, i),
            colour: this.#core.get("web_scene_group_colour", this.#at, i) >>> 0 };
    }

    /** The axis that points up in pictures of a scene in space: 0, 1 or 2. */
    get up() { return this.#core.get("froe_scene_up", this.#at); }
    set up(axis) { this.#core.status("froe_scene_set_up", this.#at, axis); }

    /** { lo, hi }, or null where there are no objects. */
    bounds() {
        return this.#core.within((arena) => {
            const dim = this.dim, lo = arena.room(8 * dim), hi = arena.room(8 * dim);
            if (!this.#core.get("froe_scene_bounds", this.#at, lo, hi)) return null;
            return { lo: this.#core.copy(Float64Array, lo, dim), hi: this.#core.copy(Float64Array, hi, dim) };
        });
    }

    /** Everything as arrays: coords of the vertices; kinds, starts, faces and groups of the objects; corners. */
    arrays() {
        return this.#core.within((arena) => {
            const core = this.#core, out = arena.room(60);
            core.call("froe_arrays_of_scene", this.#at, 0, out);
            const [dim, objects, vertices, corners, ...at] = core.view(Uint32Array, out, 13);
            const arrays = {
                dim,
                coords: core.copy(Float64Array, at[0], dim * vertices),
                kinds: core.copy(Uint8Array, at[1], objects),
                forms: core.copy(Uint8Array, at[2], objects),
                starts: core.copy(Uint32Array, at[3], objects + 1),
                corners: core.copy(Uint32Array, at[4], corners),
                radii: core.copy(Float64Array, at[5], objects),
                tags: core.copy(BigUint64Array, at[6], objects),
                faces: core.copy(Uint32Array, at[7], objects),
                groups: core.copy(Uint32Array, at[8], objects),
            };
            core.get("froe_scene_arrays_free", out);
            return arrays;
        });
    }

    /** Methods that can build a tree of this scene: { name, summary }. */
    methods() {
        const list = [];
        for (let i = 0, name; (name = this.#core.text("web_method_name", i)) !== null; i++)
            if (this.#core.get("web_method_serves", i, this.#at))
                list.push({ name, summary: this.#core.text("web_method_summary", i) });
        return list;
    }

    /** A tree: options are method ("auto"), purpose ("pieces", "query", "draw"), settings, leaf, seed and maxFragments.
     * The scene cannot grow any more while it has a tree. */
    build(options = {}) {
        return this.#core.within((arena) => new Tree(this.#core,
            this.#core.made("froe_build", this.#at, this.#core.options(arena, "build_options", options))));
    }

    /** Frees the memory now; otherwise it is freed some time after the last use. */
    free() { this.#core.release(this.#held); }
}
