/* tree.js: trees, and what is asked of them */
import { answersOf } from "./answers.js";
import { FroeError } from "./core.js";

const REPORT = ["dim", "leaf", "seed", "objects", "nodes", "leaves", "fragments", "inCut", "covers", "size", "height",
    "meanDepth", "maxLeaf", "inseparable", "bytes", "exact"]; // as in web/core/tree.c
const FORMATS = ["svg", "pdf", "eps", "csv", "geojson"];
const MEETINGS = ["cross", "touch", "overlap"];
const CUT = 40; // bytes of a web_cut

/** A binary space partition with its scene. Immutable. Objects and ranges are closed, and every answer is the exact one
 * for the numbers given. */
export class Tree {
    #core;
    #held; // the tree and, once something was asked, the context of questions

    constructor(core, address) {
        this.#core = core;
        this.#held = core.watch(this, [["froe_tree_free", address]]);
    }
    get #at() {
        if (!this.#held.length) throw new FroeError("FROE_E_ARG", "The tree has been freed.");
        return this.#held[0][1];
    }
    get #context() {
        const tree = this.#at;
        if (this.#held.length === 1) this.#held.push(["froe_query_free", this.#core.made("froe_query_new", tree)]);
        return this.#held[1][1];
    }

    /** What was built: method, settings, and counts as froe_report has them. */
    get report() {
        return this.#core.within((arena) => {
            const out = arena.room(8 * REPORT.length);
            this.#core.get("web_report", this.#at, out);
            const numbers = this.#core.copy(Float64Array, out, REPORT.length);
            const report = { method: this.#core.text("web_report_method", this.#at),
                settings: this.#core.text("web_report_settings", this.#at) };
            REPORT.forEach((name, i) => { report[name] = numbers[i]; });
            return report;
        });
    }
    get dim() { return this.report.dim; }
    bounds() {
        return this.#core.within((arena) => {
            const dim = this.dim, lo = arena.room(8 * dim), hi = arena.room(8 * dim);
            if (!this.#core.get("froe_scene_bounds", this.#core.get("froe_tree_scene", this.#at), lo, hi)) return null;
            return { lo: this.#core.copy(Float64Array, lo, dim), hi: this.#core.copy(Float64Array, hi, dim) };
        });
    }

    /* Calls `ask` with the address of points, `each` numbers a question, and their count. */
    #batch(points, each, ask) {
        const values = points instanceof Float64Array ? points : Float64Array.from(points);
        const count = values.length / each;
        if (!Number.isInteger(count)) throw new TypeError(`${values.length} numbers are no questions of ${each} numbers each.`);
        return this.#core.within((arena) => ask(arena.array(values), count, arena));
    }

    /** Objects that meet boxes: for each its lower corner, then its upper. */
    query(boxes) {
        return this.#batch(boxes, 2 * this.dim, (at, count) => answersOf(this.#core, "froe_batch_boxes", this.#context, at, count));
    }
    /** Objects that meet a range: { shape, points, radius, offsets, eps }; shapes are "box", "ball", "simplex", "capsule",
     * "halfspaces", "hull", "segment" and "ray". */
    range({ shape = "box", points, ...rest }) {
        const values = Float64Array.from(points), dim = this.dim;
        const needed = { box: 2, ball: 1, simplex: dim + 1, capsule: 2, segment: 2, ray: 2 }[shape];
        if (needed !== undefined && values.length !== needed * dim)
            throw new TypeError(`A ${shape} has ${needed * dim} numbers, and ${values.length} are given.`);
        const options = { shape, points: values, ...rest, count: values.length / dim };
        if (rest.offsets) options.offsets = Float64Array.from(rest.offsets);
        if (shape === "halfspaces" && options.offsets?.length !== options.count)
            throw new TypeError("Halfspaces have as many offsets as normals.");
        return this.#core.within((arena) =>
            answersOf(this.#core, "froe_batch_range", this.#context, this.#core.options(arena, "range", options), 1).at(0));
    }
    /** The objects that contain each point. */
    locate(points) {
        return this.#batch(points, this.dim, (at, count) => answersOf(this.#core, "froe_batch_locate", this.#context, at, count));
    }
    /** The groups (areas) that each point of the plane lies in. */
    groups(points) {
        return this.#batch(points, 2, (at, count) => answersOf(this.#core, "froe_batch_groups", this.#context, at, count));
    }
    /** The k objects nearest to each point, with distances as values. */
    nearest(points, { k = 1, bound = Infinity } = {}) {
        return this.#batch(points, this.dim, (at, count) =>
            answersOf(this.#core, "froe_batch_near", this.#context, at, count, k, bound));
    }
    /** The first segment of the plane above each point (below: direction -1); 0xffffffff where there is none. */
    above(points, direction = 1) {
        return this.#batch(points, 2, (at, count, arena) => {
            const out = arena.room(4 * count);
            this.#core.call("froe_batch_vertical", this.#context, at, count, direction, 0, out);
            return this.#core.copy(Uint32Array, out, count);
        });
    }
    /** The first object that each ray meets: { objects, t }; 0xffffffff where there is none. With `all` every object, by t,
     * with t as values. */
    ray(origins, directions, { tMax = Infinity, all = false } = {}) {
        return this.#batch(directions, this.dim, (way, rays) => this.#batch(origins, this.dim, (at, count, arena) => {
            if (rays !== count) throw new TypeError(`There are ${count} origins and ${rays} directions.`);
            if (all) return answersOf(this.#core, "froe_batch_ray_all", this.#context, at, way, count, tMax);
            const out = arena.room(16 * count);
            this.#core.call("froe_batch_ray", this.#context, at, way, count, tMax, 0, out);
            const ids = this.#core.view(Uint32Array, out, 4 * count), ts = this.#core.view(Float64Array, out, 2 * count);
            const hits = { objects: new Uint32Array(count), t: new Float64Array(count) };
            for (let i = 0; i < count; i++) {
                hits.objects[i] = ids[4 * i];
                hits.t[i] = ts[2 * i + 1];
            }
            return hits;
        }));
    }
    /** All pairs of objects that meet: { a, b, kinds }, kinds being "cross", "touch" or "overlap". */
    pairs({ shared = true } = {}) {
        return this.#core.within((arena) => {
            const out = arena.room(16);
            this.#core.call("froe_batch_pair_array", this.#context, shared ? 1 : 0, 0, out);
            const [at, count] = this.#core.view(Uint32Array, out, 2), items = this.#core.view(Uint32Array, at, 3 * count);
            const pairs = { a: new Uint32Array(count), b: new Uint32Array(count), kinds: [] };
            for (let i = 0; i < count; i++) {
                pairs.a[i] = items[3 * i];
                pairs.b[i] = items[3 * i + 1];
                pairs.kinds.push(MEETINGS[items[3 * i + 2]]);
            }
            this.#core.get("froe_pairs_free", out);
            return pairs;
        });
    }
    /** What the questions since the last call have cost: { nodes, leaves, tests }. */
    statistics() {
        return this.#core.within((arena) => {
            const out = arena.room(24);
            this.#core.get("web_statistics", this.#context, out);
            const [nodes, leaves, tests] = this.#core.copy(Float64Array, out, 3);
            return { nodes, leaves, tests };
        });
    }

    /** The parts into which objects are cut: { objects, nodes, whole, starts, coords, made }. */
    pieces() {
        return this.#core.within((arena) => {
            const core = this.#core, out = arena.room(44);
            core.call("froe_arrays_of_pieces", this.#at, 0, out);
            const [dim, count, corners, ...at] = core.view(Uint32Array, out, 9);
            const pieces = {
                objects: core.copy(Uint32Array, at[0], count),
                nodes: core.copy(Uint32Array, at[1], count),
                whole: core.copy(Uint8Array, at[2], count),
                starts: core.copy(Uint32Array, at[3], count + 1),
                coords: core.copy(Float64Array, at[4], dim * corners),
                made: core.copy(Uint32Array, at[5], corners),
            };
            core.get("froe_piece_arrays_free", out);
            return pieces;
        });
    }
    /* A box as two addresses: that which is given, or the bounds of the scene and a twentieth of it around them. */
    #box(arena, box) {
        if (!box) {
            box = this.bounds() ?? { lo: new Float64Array(this.dim), hi: new Float64Array(this.dim).fill(1) };
            for (let i = 0; i < this.dim; i++) {
                const margin = (box.hi[i] - box.lo[i]) / 20 || 1;
                box.lo[i] -= margin;
                box.hi[i] += margin;
            }
        }
        return [arena.array(Float64Array.from(box.lo)), arena.array(Float64Array.from(box.hi))];
    }
    /** Regions of the leaves (with `inner` of all nodes, parents first), within a box: { nodes, depths, faces, starts,
     * coords }; cell i has the faces faces[i] .. faces[i + 1], and face f the corners starts[f] .. starts[f + 1]. */
    cells({ box = null, inner = false } = {}) {
        return this.#core.within((arena) => {
            const core = this.#core, out = arena.room(44), [lo, hi] = this.#box(arena, box);
            core.call("froe_arrays_of_cells", this.#at, lo, hi, inner ? 1 : 0, 0, out);
            const [dim, count, faces, corners, ...at] = core.view(Uint32Array, out, 9);
            const cells = {
                nodes: core.copy(Uint32Array, at[0], count),
                depths: core.copy(Uint32Array, at[1], count),
                faces: core.copy(Uint32Array, at[2], count + 1),
                starts: core.copy(Uint32Array, at[3], faces + 1),
                coords: core.copy(Float64Array, at[4], dim * corners),
            };
            core.get("froe_cell_arrays_free", out);
            return cells;
        });
    }
    /** The cuts of a tree of the plane, parents first: { nodes, depths, ends }, four numbers for the ends of each. */
    cuts({ box = null } = {}) {
        return this.#core.within((arena) => {
            const core = this.#core, [lo, hi] = this.#box(arena, box), out = arena.room(8);
            core.call("web_cuts_of", this.#at, lo, hi, out, out + 4);
            const [at, count] = core.view(Uint32Array, out, 2);
            const cuts = { nodes: new Uint32Array(count), depths: new Uint32Array(count), ends: new Float64Array(4 * count) };
            const ids = core.view(Uint32Array, at, count * CUT / 4), ends = core.view(Float64Array, at, count * CUT / 8);
            for (let i = 0; i < count; i++) {
                cuts.nodes[i] = ids[i * CUT / 4];
                cuts.depths[i] = ids[i * CUT / 4 + 1];
                cuts.ends.set(ends.subarray(i * CUT / 8 + 1, i * CUT / 8 + 5), 4 * i);
            }
            core.free(at);
            return cuts;
        });
    }

    /** A picture with hidden surfaces removed, exactly: { bytes, shapes, lines }, and `text` of SVG. `format`: "svg",
     * "pdf", "eps", "csv" or "geojson"; the other options are those of froe_render_options in camelCase. */
    render({ format = "svg", ...options } = {}) {
        if (!FORMATS.includes(format)) throw new TypeError(`There are no pictures in the format ${format}.`);
        return this.#core.within((arena) => {
            const core = this.#core, out = arena.room(8), counts = arena.room(16);
            core.call("web_render", this.#at, FORMATS.indexOf(format), core.options(arena, "render_options", options), out,
                out + 4, counts);
            const [at, count] = core.view(Uint32Array, out, 2), [shapes, lines] = core.copy(Float64Array, counts, 2);
            const bytes = core.copy(Uint8Array, at, count);
            core.free(at);
            return { bytes, shapes, lines, get text() { return new TextDecoder().decode(bytes); } };
        });
    }
    /** A tree of the same scene whose first cut is plane[0] x + plane[1] y + plane[2] z = plane[3]; of its pictures the
     * option `section` takes one side away. */
    section(plane) {
        return this.#core.within((arena) =>
            new Tree(this.#core, this.#core.made("web_section", this.#at, arena.array(Float64Array.from(plane)))));
    }

    /** The bytes of a saved tree, as `froe build` writes it. */
    save() {
        return this.#core.within((arena) => {
            const out = arena.room(8);
            this.#core.call("web_save", this.#at, out, out + 4);
            const [at, count] = this.#core.view(Uint32Array, out, 2), bytes = this.#core.copy(Uint8Array, at, count);
            this.#core.free(at);
            return bytes;
        });
    }
    /** Proves that the tree is right, or throws an error that says what is not. */
    audit() { this.#core.call("froe_tree_audit", this.#at, 0); }

    /** Frees the memory now; otherwise it is freed some time after the last use. */
    free() { this.#core.release(this.#held); }
}
