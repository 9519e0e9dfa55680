/* questions.js: what is asked of a tree */
import { answersOf } from "./answers.js";
import { NONE } from "./core.js";
import { arraysOf, counted, given, number, shown, typed, whole, word } from "./given.js";
import { ALSO, AT, CORE, HANDLE, Handle, Resource } from "./resource.js";

/* How many points a shape has in so many dimensions; 0: any number. */
const NEEDED = { box: () => 2, ball: () => 1, simplex: (dim) => dim + 1, capsule: () => 2, halfspaces: () => 0, hull: () => 0,
    segment: () => 2, ray: () => 2 };
/* The shapes that have, and need, other members than points. */
const OWN = { radius: ["ball", "capsule"], offsets: ["halfspaces"] };
const RANGE = { points: Float64Array, offsets: Float64Array };
const STATISTICS = ["queries", "nodes", "leaves", "tests", "exact", "slices", "steps"]; // of froe_query_stats
const MEETINGS = ["cross", "touch", "overlap"], RELATIONS = ["meets", "within", "covers"];
const PAIRS = 16, PAIR = 12, HIT = 16, PLACE = 136, STATS = 96; // bytes of froe_pairs, ...

/* How far rays go. */
const most = (options) => number(given(options, { tMax: Infinity }).tMax, "tMax");

/** Questions to a tree. Objects and ranges are closed, and every answer is the exact one for the numbers given. */
export class Questions extends Resource {
    #dim;
    #asked = null;

    constructor(core, handle) {
        super(core, "tree", handle);
        this.#dim = core.get("froe_scene_dim", core.get("froe_tree_scene", handle.address));
    }
    get dim() { return this.#dim; }

    /* The context of questions, made with the first. */
    get #context() {
        const tree = this[HANDLE];
        this.#asked ??= this[ALSO](new Handle(this[CORE], "froe_query_free", this[CORE].made("froe_query_new", tree.address), tree));
        return this.#asked.address;
    }
    /* `body` with the addresses of arrays of numbers, `width` for each question, and the number of questions. */
    #batch(width, arrays, body) {
        return this[CORE].within((arena) => {
            let count = null;
            const at = Object.entries(arrays).map(([name, values]) => {
                const numbers = typed(Float64Array, values, name);
                if (numbers.length % width)
                    throw new TypeError(`${name} has ${numbers.length} numbers, and ${width} for each question are needed.`);
                count ??= numbers.length / width;
                if (count * width !== numbers.length)
                    throw new TypeError(`There are ${count} questions, and ${name} has numbers for ${numbers.length / width}.`);
                return arena.array(numbers);
            });
            return body(at, count, arena);
        });
    }
    /* The same for one question, of `dim` numbers. */
    #one(arrays, body) {
        return this.#batch(this.dim, arrays, (at, count, arena) => {
            if (count !== 1) throw new TypeError(`${Object.keys(arrays)[0]} has ${this.dim * count} numbers, and not ${this.dim}.`);
            return body(at, arena);
        });
    }
    #answers(name, width, arrays, ...more) {
        return this.#batch(width, arrays, (at, count) => answersOf(this[CORE], name, this.#context, ...at, count, ...more));
    }
    /* One number of 4 bytes for each question. */
    #numbers(name, width, arrays, ...more) {
        return this.#batch(width, arrays, (at, count, arena) => {
            const out = arena.room(4 * count);
            this[CORE].call(name, this.#context, ...at, count, ...more, this[CORE].batch, out);
            return this[CORE].copy(Uint32Array, out, count);
        });
    }

    /** Objects that meet boxes: for each its lower corner, then its upper. */
    query(boxes) { return this.#answers("froe_batch_boxes", 2 * this.dim, { boxes }); }

    /* A range as an address. */
    #range(arena, range) {
        const dim = this.dim, options = { shape: "box", ...arraysOf(RANGE, range) }, { shape } = options;
        if (typeof shape !== "string" || !Object.hasOwn(NEEDED, shape)) throw new TypeError(`There is no shape of ranges called ${shown(shape)}.`);
        if (!options.points) throw new TypeError("A range has points.");
        for (const [name, shapes] of Object.entries(OWN))
            if (shapes.includes(shape) !== (options[name] !== undefined))
                throw new TypeError(`A range of the shape ${shape} ${shapes.includes(shape) ? "needs the" : "takes no"} option ${name}.`);
        const count = options.points.length, needed = NEEDED[shape](dim);
        if (needed && count !== needed * dim)
            throw new TypeError(`A ${shape} has ${needed * dim} numbers, and ${count} are given.`);
        if (count % dim) throw new TypeError(`A ${shape} has ${dim} numbers for each point, and ${count} are given.`);
        options.count = count / dim;
        if (options.offsets && options.offsets.length !== options.count)
            throw new TypeError(`${counted(options.count, "normal")} cannot have ${counted(options.offsets.length, "offset")}.`);
        return this[CORE].options(arena, "range", options);
    }
    /** Objects that meet a range: { shape, points, radius, offsets, eps, walk }; shapes are "box", "ball", "simplex",
     * "capsule", "halfspaces", "hull", "segment" and "ray". */
    range(range) {
        return this[CORE].within((arena) =>
            answersOf(this[CORE], "froe_batch_range", this.#context, this.#range(arena, range), 1).at(0));
    }
    /** Groups of the plane that meet a range, lie "within" it, or that "covers" it. */
    groupsOf(range, relation = "meets") {
        const place = word(relation, RELATIONS, "relation");
        return this[CORE].within((arena) =>
            answersOf(this[CORE], "froe_batch_groups_range", this.#context, this.#range(arena, range), 1, place).at(0));
    }
    /** The objects that contain each point. */
    locate(points) { return this.#answers("froe_batch_locate", this.dim, { points }); }
    /** The groups (areas) that each point of the plane lies in. */
    groups(points) { return this.#answers("froe_batch_groups", 2, { points }); }
    /** The k objects nearest to each point, with distances as values. */
    nearest(points, options) {
        const { k, bound } = given(options, { k: 1, bound: Infinity });
        return this.#answers("froe_batch_near", this.dim, { points }, whole(k, "k"), number(bound, "bound"));
    }
    /** The point of an object that is nearest to a point. */
    nearestPoint(object, point) {
        whole(object, "object");
        return this.#one({ point }, ([at], arena) => {
            const out = arena.room(8 * this.dim);
            this[CORE].call("froe_query_nearest_point", this.#context, object, at, out);
            return this[CORE].copy(Float64Array, out, this.dim);
        });
    }
    /** The first segment of the plane above each point (below: direction -1); 0xffffffff where there is none. */
    above(points, direction = 1) {
        if (direction !== 1 && direction !== -1) throw new RangeError(`direction is 1 or -1, and not ${shown(direction)}.`);
        return this.#numbers("froe_batch_vertical", 2, { points }, direction);
    }
    /** The first object that each ray meets: { objects, t }; 0xffffffff and Infinity where there is none. */
    ray(origins, directions, options) {
        const tMax = most(options);
        return this.#batch(this.dim, { origins, directions }, (at, count, arena) => {
            const core = this[CORE], out = arena.room(HIT * count);
            core.call("froe_batch_ray", this.#context, ...at, count, tMax, core.batch, out);
            const objects = core.column(Uint32Array, out, count, HIT, 0);
            return { objects, t: core.column(Float64Array, out, count, HIT, 8).map((t, i) => (objects[i] === NONE ? Infinity : t)) };
        });
    }
    /** Every object that each ray meets, by t, with t as values. */
    rayAll(origins, directions, options) {
        return this.#answers("froe_batch_ray_all", this.dim, { origins, directions }, most(options));
    }
    /** Any object that each ray meets; 0xffffffff where there is none. */
    rayAny(origins, directions, options) {
        return this.#numbers("froe_batch_ray_any", this.dim, { origins, directions }, most(options));
    }
    /** What lies where a ray meets an object first: { point, normal, distance }; normal null where there is none. */
    hitPlace(object, origin, direction) {
        whole(object, "object");
        return this.#one({ origin, direction }, (at, arena) => {
            const core = this[CORE], out = arena.room(PLACE);
            core.call("froe_query_hit_place", this.#context, object, ...at, out);
            const normal = core.copy(Float64Array, out + 64, this.dim);
            return { point: core.copy(Float64Array, out, this.dim), normal: normal.some((x) => x) ? normal : null,
                distance: core.double(out + 128) };
        });
    }
    /** All pairs of objects that meet: { a, b, kinds }, kinds being "cross", "touch" or "overlap". `shared` false leaves
     * out pairs that touch in nothing but one corner of both. */
    pairs(options) {
        const { shared } = given(options, { shared: true }), core = this[CORE], args = [this.#context, shared ? 1 : 0, core.batch];
        return core.filled("froe_batch_pair_array", args, PAIRS, "froe_pairs_free", ([at, count]) => ({
            a: core.column(Uint32Array, at, count, PAIR, 0),
            b: core.column(Uint32Array, at, count, PAIR, 4),
            kinds: Array.from(core.column(Uint32Array, at, count, PAIR, 8), (kind) => MEETINGS[kind]),
        }));
    }
    /** What the questions since the last call have cost: { queries, nodes, leaves, tests, exact, slices, steps }. */
    statistics() {
        return this[CORE].within((arena) => {
            const out = arena.room(STATS);
            this[CORE].get("froe_query_statistics", out, this.#context);
            const numbers = this[CORE].copy(BigUint64Array, out, STATISTICS.length);
            return Object.fromEntries(STATISTICS.map((name, i) => [name, Number(numbers[i])]));
        });
    }
}
