/* tree.js: trees: what they consist of, their pictures, and their files */
import { arraysOf, checkLengths, doubles, given, number, text, whole, word } from "./given.js";
import { AT, CORE, Handle } from "./resource.js";
import { Questions } from "./questions.js";
import { Scene, boundsOf } from "./scene.js";

const REPORT = ["dim", "leaf", "seed", "objects", "nodes", "leaves", "fragments", "inCut", "covers", "size", "height",
    "meanDepth", "maxLeaf", "inseparable", "crowded", "bytes", "exact"]; // as in web/core/tree.c
const PICTURE = ["shapes", "lines", "dots", "paths", "patches"]; // as in web/core/picture.c
/** Names of the numbers in `cuts` of nodes(): where the cut of a node comes from. */
export const CUTS = ["none", "axis", "object", "vertices", "edge", "plane", "vertex", "crossing", "fine"];
const FORMATS = ["svg", "pdf", "eps", "csv", "geojson"], PAINTS = ["whole", "regions", "fragments"];
const EXPORTS = ["fragments", "cells", "cuts"];
const RENDER = { sectionPlane: Float64Array, opacity: Float64Array, priorities: Int32Array };
const PIECES = 44, CELLS = 44, CUTS_ROOM = 64, NODE = 48; // bytes of froe_piece_arrays, ..., web_cuts, web_node

/** A binary space partition with its scene. Immutable. */
export class Tree extends Questions {
    #source = null; // of its scene

    static made(core, address, source = null) {
        const tree = new Tree(core, new Handle(core, "froe_tree_free", address));
        tree.#source = source;
        return tree;
    }

    /** The scene that it was built of, which cannot grow any more. It keeps the tree in use. */
    get scene() { return Object.assign(Scene.of(this), { source: this.#source }); }
    get #scene() { return this[CORE].get("froe_tree_scene", this[AT]); }
    /** { lo, hi } of the scene, or null where there are no objects. */
    bounds() { return boundsOf(this[CORE], this.#scene); }

    /** What was built: method, settings, counts as froe_report has them, and promises: { name, promised, measured }. */
    get report() {
        return this[CORE].within((arena) => {
            const core = this[CORE], out = arena.room(8 * REPORT.length), texts = arena.room(8), promises = [];
            core.get("web_report", this[AT], out, texts);
            const numbers = core.copy(Float64Array, out, REPORT.length), [method, settings] = core.copy(Uint32Array, texts, 2);
            for (let i = 0, at; (at = core.get("web_promise", this[AT], i) >>> 0); i++)
                promises.push({ name: core.string(core.uint(at)), promised: core.double(at + 8), measured: core.double(at + 16) });
            return { method: core.string(method), settings: core.string(settings), promises,
                ...Object.fromEntries(REPORT.map((name, i) => [name, numbers[i]])) };
        });
    }

    /** All nodes, as arrays: node n, of pieces() and cells(), is at n - 1, and the root at 0. `children` are two numbers
     * of nodes each, 0 in leaves; the list of a node are its pieces from firstPieces to firstPieces + pieceCounts - 1, of
     * which the first coverCounts contain its region. Cuts are of the kinds CUTS[cuts[i]], with axes, values, and three
     * ids each; `parents` are numbers of nodes, 0 of the root. */
    nodes() {
        return this[CORE].within((arena) => {
            const core = this[CORE], count = this.report.nodes, at = arena.room(NODE * count);
            core.get("web_nodes", this[AT], at, count);
            const uints = (offset, per = 1) => core.column(Uint32Array, at, count, NODE, offset, per);
            const children = uints(0, 2), parents = new Uint32Array(count), depths = new Uint32Array(count);
            for (const open = count ? [0] : []; open.length;) {
                const node = open.pop();
                for (const child of children.subarray(2 * node, 2 * node + 2)) {
                    if (!child) continue;
                    parents[child - 1] = node + 1;
                    depths[child - 1] = depths[node] + 1;
                    open.push(child - 1);
                }
            }
            return { children, parents, depths, firstPieces: uints(8), pieceCounts: uints(12), coverCounts: uints(16),
                cuts: Uint8Array.from(uints(20)), axes: uints(24), ids: uints(28, 3),
                values: core.column(Float64Array, at, count, NODE, 40) };
        });
    }
    /** The parts into which objects are cut: { objects, nodes, whole, starts, coords, made }. */
    pieces() {
        const core = this[CORE], take = ([dim, count, corners, ...at]) => ({
            objects: core.copy(Uint32Array, at[0], count),
            nodes: core.copy(Uint32Array, at[1], count),
            whole: core.copy(Uint8Array, at[2], count),
            starts: core.copy(Uint32Array, at[3], count + 1),
            coords: core.copy(Float64Array, at[4], dim * corners),
            made: core.copy(Uint32Array, at[5], corners),
        });
        return core.filled("froe_arrays_of_pieces", [this[AT], 0], PIECES, "froe_piece_arrays_free", take);
    }
    /* A box as two addresses: that which is given, or the bounds of the scene and a twentieth of it around them. */
    #box(arena, box) {
        const none = { lo: new Float64Array(this.dim), hi: new Float64Array(this.dim).fill(1) };
        let { lo, hi } = given(box ?? this.bounds() ?? none, { lo: null, hi: null });
        if (!box) {
            const most = Number.MAX_VALUE;
            const margins = lo.map((low, i) => Math.min((hi[i] - low) / 20, most / 20) || 1);
            [lo, hi] = [lo.map((low, i) => Math.max(low - margins[i], -most)), hi.map((high, i) => Math.min(high + margins[i], most))];
        }
        return [arena.array(doubles(lo, this.dim, "lo")), arena.array(doubles(hi, this.dim, "hi"))];
    }
    /** Regions of the leaves (with `inner` of all nodes, parents first), within a box: { nodes, depths, faces, starts,
     * coords }; cell i has the faces faces[i] .. faces[i + 1], and face f the corners starts[f] .. starts[f + 1]. */
    cells(options) {
        const { box, inner } = given(options, { box: null, inner: false }), core = this[CORE], take = ([dim, count, faces, corners, ...at]) => ({
            nodes: core.copy(Uint32Array, at[0], count),
            depths: core.copy(Uint32Array, at[1], count),
            faces: core.copy(Uint32Array, at[2], count + 1),
            starts: core.copy(Uint32Array, at[3], faces + 1),
            coords: core.copy(Float64Array, at[4], dim * corners),
        });
        return core.within((arena) => core.filled("froe_arrays_of_cells",
            [this[AT], ...this.#box(arena, box), inner ? 1 : 0, 0], CELLS, "froe_cell_arrays_free", take));
    }
    /** Cuts within a box, parents first: { nodes, depths, starts, coords }; cut i has the corners starts[i] ..
     * starts[i + 1], two in the plane. */
    cuts(options) {
        const { box } = given(options, { box: null }), core = this[CORE], take = (words) => {
            const column = (Type, i) => core.copy(Type, words[4 * i], words[4 * i + 1] / Type.BYTES_PER_ELEMENT);
            return { nodes: column(Uint32Array, 0), depths: column(Uint32Array, 1), starts: column(Uint32Array, 2),
                coords: column(Float64Array, 3) };
        };
        return core.within((arena) =>
            core.filled("web_cuts_of", [this[AT], ...this.#box(arena, box)], CUTS_ROOM, "web_cuts_free", take));
    }

    /* A picture: what `body` makes of the addresses of its options and of the numbers that it tells. */
    #picture(options, body) {
        const core = this[CORE], all = arraysOf(RENDER, options);
        if (all.sectionPlane) doubles(all.sectionPlane, 4, "sectionPlane");
        for (const name of ["eye", "target", "up"]) if (all[name]) all[name] = Array.from(doubles(all[name], 3, name));
        if (all.lineStyles !== undefined && !Array.isArray(all.lineStyles)) throw new TypeError("lineStyles is not an array of objects.");
        all.lineStyleCount = all.lineStyles?.length ?? 0;
        if (!all.lineStyleCount) delete all.lineStyles;
        checkLengths(all, ["opacity", "priorities"], core.get("froe_scene_group_count", this.#scene));
        return core.within((arena) => {
            const numbers = arena.room(8 * (PICTURE.length + 1));
            const bytes = body(arena, core.options(arena, "render", all), numbers);
            const told = core.copy(Float64Array, numbers, PICTURE.length + 1);
            return { bytes, get text() { return new TextDecoder().decode(bytes); }, paint: PAINTS[told[PICTURE.length]],
                ...Object.fromEntries(PICTURE.map((name, i) => [name, told[i]])) };
        });
    }
    /** A picture with hidden surfaces removed, exactly: { bytes, text, shapes, lines, dots, paths, patches, paint }.
     * `format`: "svg", "pdf", "eps", "csv" or "geojson"; the other options are those of froe_render_options in camelCase:
     * names for enumerations, an array of names for `lines`, arrays for `eye`, `target` and `up`. */
    render(options) {
        const { format, ...more } = { format: "svg", ...given(options) }, place = word(format, FORMATS, "format");
        return this.#picture(more, (arena, at, numbers) => this[CORE].bytes("web_render", this[AT], place, at, numbers));
    }
    /** One SVG that turns: `count` pictures of a turntable in `seconds` a round. Options as of render(). */
    renderTurning(options) {
        const { count, seconds, ...more } = { count: 36, seconds: 12, ...given(options) };
        whole(count, "count", 1, 10000);
        number(seconds, "seconds");
        return this.#picture(more, (arena, at, numbers) => this[CORE].files(({ path, take }) => {
            this[CORE].call("web_render_turning", this[AT], arena.text(path("turning.svg")), at, count, seconds, numbers);
            return take("turning.svg");
        }));
    }
    /** A tree of the same scene whose first cut is plane[0] x + plane[1] y + plane[2] z = plane[3]; of its pictures the
     * options `section`, -1 or 1, and `sectionPlane` show one side. */
    section(plane) {
        const core = this[CORE], numbers = doubles(plane, this.dim + 1, "plane");
        return core.within((arena) => Tree.made(core,
            core.made("froe_tree_section", this[AT], arena.array(numbers), core.options(arena, "build")), this.#source));
    }

    /** The bytes of a saved tree, as `froe build` writes it. */
    save() { return this[CORE].bytes("web_save", this[AT]); }
    /** The bytes of a file for other programs, by the ending of the name: .geojson, .obj or .csv. `what`: "fragments",
     * "cells" or "cuts". */
    export(name, what = "fragments") {
        const core = this[CORE], place = word(what, EXPORTS, "what");
        return core.files(({ path, take }) => core.within((arena) => {
            core.call("froe_export", this[AT], arena.text(path(name)), place, core.options(arena, "export"));
            return take(name);
        }));
    }
    /** Proves that the tree is right, or throws an error that says what is not. */
    audit(options) {
        const core = this[CORE], { exactOnly } = given(options, { exactOnly: false });
        core.within((arena) => core.call("froe_tree_audit", this[AT], core.options(arena, "audit", { exactOnly })));
    }
}
