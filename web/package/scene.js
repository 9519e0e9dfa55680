/* scene.js: scenes, and how they become trees */
import { arraysOf, checkLengths, checkStarts, counted, given, shown, text } from "./given.js";
import { NONE } from "./core.js";
import { addGroup, groupOf } from "./groups.js";
import { AT, CORE, HANDLE, Handle, Resource } from "./resource.js";
import { Tree } from "./tree.js";

const ARRAYS = { coords: Float64Array, indices: Uint32Array, starts: Uint32Array, radii: Float64Array, tags: BigUint64Array,
    faces: Uint32Array, groups: Uint32Array };
const CORNERS = { point: 1, segment: 2, polygon: 3, box: 2, ball: 1, hull: 1 };
/** Names of the numbers in `kinds` and `forms` of arrays(). */
export const KINDS = Object.keys(CORNERS);
const SCENE_ARRAYS = 60, METHOD = 64, OPTION = 40, DEFECTS = 80; // bytes of froe_scene_arrays, ...

/** A set of objects in space of some dimension. Coordinates are kept exactly; objects have the ids 0, 1, ... in the order
 * in which they are added. */
export class Scene extends Resource {
    /** How it was read, if it is from a file; otherwise null. */
    source = null;

    constructor(core, handle) { super(core, "scene", handle); }
    static made(core, address) { return new Scene(core, new Handle(core, "froe_scene_free", address)); }

    get dim() { return this[CORE].get("froe_scene_dim", this[AT]); }
    get objectCount() { return this[CORE].get("froe_scene_object_count", this[AT]); }
    get vertexCount() { return this[CORE].get("froe_scene_vertex_count", this[AT]); }
    get groupCount() { return this[CORE].get("froe_scene_group_count", this[AT]); }

    /** Adds objects of one kind: "point", "segment", "polygon", "box", "ball" or "hull". `coords` are points, one after
     * the other; object i has the corners starts[i] .. starts[i + 1], or as many as its kind has (polygons: 3); with
     * `indices` corner c is the point indices[c]. All objects are added, or none. */
    add(batch) {
        const { count, ...options } = arraysOf(ARRAYS, batch), { kind } = options;
        if (!KINDS.includes(kind)) throw new TypeError(`There is no kind of objects called ${shown(kind)}.`);
        if (!options.coords) throw new TypeError("A batch of objects has coords.");
        const points = options.coords.length / this.dim;
        const corners = options.indices ? options.indices.length : points;
        options.count = count ?? (options.starts ? Math.max(options.starts.length - 1, 0) : corners / CORNERS[kind]);
        if (!Number.isInteger(points) || !Number.isInteger(options.count) || options.count < 0)
            throw new TypeError(`coords has ${counted(options.coords.length, "number")}, which are no whole ${kind}s.`);
        if (options.starts) checkStarts(options.starts, options.count, corners);
        else if (options.count * CORNERS[kind] > corners)
            throw new TypeError(`${counted(options.count, kind)} cannot be made of ${counted(corners, "corner")}.`);
        checkLengths(options, ["radii", "tags", "faces", "groups"], options.count);
        if (kind === "ball" && !options.radii) throw new TypeError("Balls need radii.");
        if (options.indices) options.pointCount = points;
        this[CORE].within((arena) =>
            this[CORE].call("froe_scene_add", this[AT], this[CORE].options(arena, "objects", options)));
        return this;
    }

    /** Adds what objects may share: { name, material, left, right, colour }, colour being 0xRRGGBBAA. Returns its number,
     * for `groups`. */
    addGroup(group) { return addGroup(this[CORE], "froe_scene_add_group", this[AT], group); }
    group(i) { return groupOf(this[CORE], "froe_scene_group", this[AT], i, this.groupCount); }

    /** The axis that points up in pictures of a scene in space: 0, 1 or 2. */
    get up() { return this[CORE].get("froe_scene_up", this[AT]); }
    set up(axis) {
        if (this.dim !== 3 || ![0, 1, 2].includes(axis))
            throw new RangeError(`The axis ${shown(axis)} of a scene of dimension ${this.dim} cannot point up in pictures.`);
        this[CORE].call("froe_scene_set_up", this[AT], axis);
    }

    /** { lo, hi }, or null where there are no objects. */
    bounds() { return boundsOf(this[CORE], this[AT]); }

    /** Everything as arrays: coords of the vertices; kinds, forms, starts, radii, tags, faces and groups of the objects;
     * corners, which are numbers of vertices. */
    arrays() {
        const core = this[CORE], take = ([dim, objects, vertices, corners, ...at]) => ({
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
        });
        return core.filled("froe_arrays_of_scene", [this[AT], 0], SCENE_ARRAYS, "froe_scene_arrays_free", take);
    }

    /** What is odd about the scene, and stops nothing: counts, and one example of each sort of pairs, or null. */
    defects() {
        return this[CORE].within((arena) => {
            const core = this[CORE], out = arena.array(Uint32Array.of(DEFECTS, ...new Array(DEFECTS / 4 - 1).fill(0)));
            core.call("froe_scene_defects", this[AT], 1, 0, 0, out);
            const counts = [...core.copy(BigUint64Array, out + 8, 6)].map(Number), ids = core.copy(Uint32Array, out + 56, 6);
            const pair = (i) => (ids[i] === NONE ? null : [ids[i], ids[i + 1]]);
            const [zeroLength, zeroArea, duplicates, crossings, tJunctions, overlaps] = counts;
            return { zeroLength, zeroArea, duplicates, crossings, tJunctions, overlaps,
                firstCrossing: pair(0), firstTJunction: pair(2), firstOverlap: pair(4) };
        });
    }

    /** Methods that can build a tree of this scene: { name, summary, source, guarantee, options }. */
    methods() {
        const core = this[CORE], list = [];
        for (let i = 0, at; (at = core.get("froe_method_at", i) >>> 0); i++) {
            if (!core.get("froe_method_serves", at, this[AT], NONE)) continue;
            const words = core.copy(Uint32Array, at, METHOD / 4);
            const [name, summary, source, guarantee] = [...words.subarray(0, 4)].map((text) => core.string(text));
            list.push({ name, summary, source, guarantee, options: optionsAt(core, words[15]) });
        }
        return list;
    }
    /** The method that "auto" stands for, for a purpose: "pieces", "query" or "draw". */
    autoMethod(purpose = "pieces") {
        return this[CORE].within((arena) => this[CORE].text("froe_method_auto", this[AT], arena.text(text(purpose, "purpose"))));
    }

    /** A tree: options are method ("auto"), purpose ("pieces", "query", "draw"), settings ("name=value ..."), leaf, seed,
     * order and maxFragments. The scene cannot grow any more while it has a tree. */
    build(options = {}) {
        const all = arraysOf({ order: Uint32Array }, options), core = this[CORE];
        if (all.order) all.orderCount = all.order.length;
        return core.within((arena) => Tree.made(core, core.made("froe_build", this[AT], core.options(arena, "build", all)), this.source));
    }

    /** The bytes of a file that read() takes: a name ends in .geojson, .json, .csv, .off or .obj. */
    write(name) {
        return this[CORE].files(({ path, take }) => this[CORE].within((arena) => {
            this[CORE].call("froe_write_scene", this[AT], arena.text(path(name)));
            return take(name);
        }));
    }

    /** The scene of a tree, which stays in use with it. */
    static of(tree) {
        const core = tree[CORE], address = core.get("froe_tree_scene", tree[AT]) >>> 0;
        return new Scene(core, new Handle(core, null, address, tree[HANDLE]));
    }
}

/** Bounds of the scene at an address. */
export function boundsOf(core, scene) {
    return core.within((arena) => {
        const dim = core.get("froe_scene_dim", scene), lo = arena.room(8 * dim), hi = arena.room(8 * dim);
        if (!core.get("froe_scene_bounds", scene, lo, hi)) return null;
        return { lo: core.copy(Float64Array, lo, dim), hi: core.copy(Float64Array, hi, dim) };
    });
}

function optionsAt(core, at) {
    const list = [];
    for (; core.uint(at); at += OPTION) {
        const words = core.copy(Uint32Array, at, OPTION / 4), [standard, least, most] = core.copy(Float64Array, at + 8, 3);
        const choices = [];
        for (let i = 0; words[8] && core.uint(words[8] + 4 * i); i++) choices.push(core.string(core.uint(words[8] + 4 * i)));
        list.push({ name: core.string(words[0]), summary: core.string(words[1]), standard, least, most,
            choices: choices.length ? choices : null, whole: (words[9] & 0xff) !== 0 });
    }
    return list;
}
