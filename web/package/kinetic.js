/* kinetic.js: a partition that is kept right while its objects move */
import { NONE } from "./core.js";
import { doubles, given, number, whole } from "./given.js";
import { AT, CORE, Resource } from "./resource.js";
import { Tree } from "./tree.js";

/** Names of the numbers in `kinds` of events. */
export const EVENTS = ["vertices", "vertex-crossing", "crossings", "contact", "triple", "turn", "batch", "plan", "appear",
    "disappear", "flop", "touch"];
const STATISTICS = ["surgeries", "batches", "crowds", "restarts", "nodesTouched", "certificatesMade", "nodes", "certificates"];
const EVENT = 88, FRAGMENT = 40, PLACE = 12, SNAPSHOT = 48; // bytes of web_event, web_fragment, froe_kinetic_place, ...
const VISIT = { all: 0, instants: 1, first: 2 }; // as in web/core/motion.c

/** A partition of moving objects, exact at every instant that it stands at. It keeps the motion in use. */
export class Kinetic extends Resource {
    #end;

    constructor(motion, handle) {
        super(motion[CORE], "partition", handle);
        this.motion = motion;
        this.#end = motion.window.end;
    }

    /** The time that it has reached. */
    get time() { return this[CORE].get("froe_kinetic_time", this[AT]); }
    /** The time of the next event at the earliest; Infinity: nothing happens in the rest of the window. */
    get next() { return this[CORE].get("froe_kinetic_next", this[AT]); }

    #advance(time, visit) {
        const core = this[CORE], take = (at, count) => {
            const named = (offset, counts) => core.column(Uint32Array, at, count, EVENT, offset, 4)
                .map((id, i) => (i % 4 < counts[i >> 2] ? id : NONE));
            const counts = core.column(Uint32Array, at, count, EVENT, 20), edgeCounts = core.column(Uint32Array, at, count, EVENT, 40);
            return {
                kinds: Uint8Array.from(core.column(Uint32Array, at, count, EVENT, 0)),
                objects: named(4, counts), counts, edges: named(24, edgeCounts), edgeCounts,
                ticks: Float64Array.from(core.column(BigInt64Array, at, count, EVENT, 48), Number),
                early: core.column(Float64Array, at, count, EVENT, 72),
                late: core.column(Float64Array, at, count, EVENT, 80),
            };
        };
        return core.records("web_advance", [this[AT], number(time, "time"), visit], EVENT, take);
    }
    /** Lets time go on, and returns what happened: { kinds, objects, counts, edges, edgeCounts, ticks, early, late }.
     * Event i is of the kind EVENTS[kinds[i]], about the objects 4 i .. 4 i + 3 (0xffffffff where there are fewer than
     * counts[i]), and happened between early and late: the ticks around, or with `instants` two doubles next to one
     * another. In space it is about edges, too, as seen from above: edge 3 o + c goes on from corner c of object o. */
    advance(time, options) {
        const { instants } = given(options, { instants: false });
        return this.#advance(time, instants ? VISIT.instants : VISIT.all);
    }
    /** Lets time go on to the next event, at most to a time: the events of that tick, with their instants. */
    step(until = this.#end) { return this.#advance(until, VISIT.first); }

    /** Objects that were added to the motion meanwhile take part from now on. */
    update() { this[CORE].call("froe_kinetic_update", this[AT]); }
    /** Takes an object out, for good. */
    remove(object) { this[CORE].call("froe_kinetic_remove", this[AT], whole(object, "object")); }
    /** Compares the partition with one made from scratch, or throws an error that says what is wrong. */
    audit() { this[CORE].call("froe_kinetic_audit", this[AT]); }

    /** The present as a tree over a scene of its own, { tree, rounded, alike }: `rounded` vertices are less than the last
     * place of a double beside where they are; `alike`: all the same it has the cuts of the partition. Object i is the i-th
     * of those that are there; tags are the motion's. With `refuse` it is rather refused than rounded. */
    snapshot(options = {}) {
        return this[CORE].within((arena) => {
            const core = this[CORE], out = arena.room(SNAPSHOT);
            core.call("froe_kinetic_snapshot", this[AT], core.options(arena, "snapshot", options), out);
            const [tree, , rounded, alike] = core.copy(Uint32Array, out, 4);
            return { tree: Tree.made(core, tree), rounded, alike: (alike & 0xff) !== 0 };
        });
    }

    #point(arena, values, name) { return arena.array(doubles(values, 2, name)); }
    /** Where a point is: { on, above, below }: a segment that it lies on, the next one above, the next one below; null:
     * none. */
    locate(point) {
        return this[CORE].within((arena) => {
            const out = arena.room(PLACE);
            this[CORE].call("froe_kinetic_locate", this[AT], this.#point(arena, point, "point"), out);
            const [on, above, below] = Array.from(this[CORE].copy(Uint32Array, out, 3), (id) => (id === NONE ? null : id));
            return { on, above, below };
        });
    }
    /** The first segment met on the way from one point to another, or null. */
    ray(from, to) {
        return this[CORE].within((arena) => {
            const hit = this[CORE].made("froe_kinetic_ray", this[AT], this.#point(arena, from, "from"), this.#point(arena, to, "to"));
            return hit === NONE ? null : hit;
        });
    }
    /** The pieces between the walls of the partition, those behind first, seen from an eye: { objects, coords }, four
     * numbers each. */
    order(eye) {
        const core = this[CORE], take = (at, count) => ({ objects: core.column(Uint32Array, at, count, FRAGMENT, 0),
            coords: core.column(Float64Array, at, count, FRAGMENT, 8, 4) });
        return core.within((arena) => core.records("web_kinetic_order", [this[AT], this.#point(arena, eye, "eye")], FRAGMENT, take));
    }
    /** What it has cost: events by kind, and other counts since it was made. */
    statistics() {
        return this[CORE].within((arena) => {
            const count = EVENTS.length + STATISTICS.length, out = arena.room(8 * count);
            this[CORE].get("web_kinetic_statistics", this[AT], out);
            const numbers = this[CORE].copy(Float64Array, out, count), named = (names, first) =>
                Object.fromEntries(names.map((name, i) => [name, numbers[first + i]]));
            return { events: named(EVENTS, 0), ...named(STATISTICS, EVENTS.length) };
        });
    }
}
