/* motion.js: objects that move, and when they meet */
import { arraysOf, checkLengths, checkStarts, counted, number, whole } from "./given.js";
import { addGroup, groupOf } from "./groups.js";
import { Kinetic } from "./kinetic.js";
import { AT, CORE, HANDLE, Handle, Resource } from "./resource.js";

const MOVING = { starts: Uint32Array, times: Float64Array, coords: Float64Array, controls: Float64Array,
    secondControls: Float64Array, vertices: Uint32Array, bodies: Uint32Array, births: Float64Array, deaths: Float64Array,
    tags: BigUint64Array, groups: Uint32Array };
const BODY = { times: Float64Array, coords: Float64Array, controls: Float64Array, turns: Float64Array };
const WINDOW = 32, OBJECT = 48, CONTACT = 48; // bytes of froe_motion_options, froe_moving_object, froe_contact

/** Moving objects in a window of time: segments of the plane, or triangles in space. */
export class Motion extends Resource {
    static made(core, address) { return new Motion(core, new Handle(core, "froe_motion_free", address)); }
    static of(core, options) {
        return core.within((arena) => Motion.made(core,
            core.made("froe_motion_new", core.options(arena, "motion", options), 0)));
    }
    constructor(core, handle) { super(core, "motion", handle); }

    get objectCount() { return this[CORE].get("froe_motion_object_count", this[AT]); }
    get vertexCount() { return this[CORE].get("froe_motion_vertex_count", this[AT]); }
    get bodyCount() { return this[CORE].get("froe_motion_body_count", this[AT]); }
    get groupCount() { return this[CORE].get("froe_motion_group_count", this[AT]); }
    /** { dim, begin, end, tick }: the time that is considered, and the length of a tick. */
    get window() {
        return this[CORE].within((arena) => {
            const out = arena.room(WINDOW);
            this[CORE].get("froe_motion_window_into", this[AT], out, WINDOW);
            const [begin, end, tick] = this[CORE].copy(Float64Array, out + 8, 3);
            return { dim: this[CORE].uint(out + 4), begin, end, tick };
        });
    }
    get dim() { return this.window.dim; }

    /** Adds objects. Vertex v passes the point coords[i] at times[i], for i from starts[v] to starts[v + 1] - 1, in
     * between straight on at constant speed, or on the parabola with the control point controls[i] where that is not
     * NaN, or on the cubic with that and secondControls[i] where neither is; one with one time stands still. Segments and
     * triangles join the vertices in `vertices`, by default each once, in order; births and deaths are the times when they
     * appear and disappear. */
    add(batch) {
        const options = arraysOf(MOVING, batch), dim = this.dim;
        for (const name of ["starts", "times", "coords"])
            if (!options[name]) throw new TypeError(`A batch of moving objects has ${name}.`);
        whole(options.vertexCount ??= Math.max(options.starts.length - 1, 0), "vertexCount");
        checkStarts(options.starts, options.vertexCount, options.times.length);
        checkLengths(options, ["coords", "controls", "secondControls"], dim * options.starts[options.vertexCount]);
        checkLengths(options, ["bodies"], options.vertexCount);
        const joined = options.vertices?.length ?? options.vertexCount;
        options.count ??= joined / dim;
        if (!Number.isInteger(options.count) || options.count < 0 || options.count * dim > joined)
            throw new TypeError(`${counted(options.count, dim === 2 ? "segment" : "triangle")} cannot be made of ${counted(joined, "vertex", "vertices")}.`);
        checkLengths(options, ["births", "deaths", "tags", "groups"], options.count);
        this[CORE].within((arena) =>
            this[CORE].call("froe_motion_add", this[AT], this[CORE].options(arena, "moving", options)));
        return this;
    }
    /** Adds a rigid body: where its centre is at each time, and how it is turned: quaternions x, y, z, w, or in the plane
     * the sine and the cosine of half of the angle. Returns its number, for `bodies`. */
    addBody(body) {
        const options = arraysOf(BODY, body), dim = this.dim;
        if (!options.times || !options.coords) throw new TypeError("A body has times and coords.");
        options.count = options.times.length;
        checkLengths(options, ["coords", "controls"], dim * options.count);
        checkLengths(options, ["turns"], (dim === 2 ? 2 : 4) * options.count);
        return this[CORE].within((arena) =>
            this[CORE].made("froe_motion_add_body", this[AT], this[CORE].options(arena, "body", options)));
    }
    addGroup(group) { return addGroup(this[CORE], "froe_motion_add_group", this[AT], group); }
    group(i) { return groupOf(this[CORE], "froe_motion_group", this[AT], i, this.groupCount); }

    /** The objects as arrays: vertices (2 or 3 each), births, deaths, groups and tags. */
    objects() {
        return this[CORE].within((arena) => {
            const core = this[CORE], count = this.objectCount, at = arena.room(OBJECT * count);
            core.get("web_moving_objects", this[AT], at);
            return { vertices: core.column(Uint32Array, at, count, OBJECT, 0, this.dim),
                births: core.column(Float64Array, at, count, OBJECT, 16), deaths: core.column(Float64Array, at, count, OBJECT, 24),
                groups: core.column(Uint32Array, at, count, OBJECT, 32), tags: core.column(BigUint64Array, at, count, OBJECT, 40) };
        });
    }
    /** Where all vertices are at a time, for output: NaN where the plan of one does not cover it. */
    positions(time) {
        return this[CORE].within((arena) => {
            const count = this.dim * this.vertexCount, at = arena.room(8 * count);
            this[CORE].get("web_positions", this[AT], number(time, "time"), at);
            return this[CORE].copy(Float64Array, at, count);
        });
    }

    /** All contacts, in the order of their beginnings: { a, b, begins, ends, instant, sinceStart, toStop }. The true time
     * is between the two numbers of begins and of ends. Options: from, to, first (only what may be the first of all), apart
     * (without pairs of one group). */
    contacts(options = {}) {
        const core = this[CORE], take = (at, count) => ({
            a: core.column(Uint32Array, at, count, CONTACT, 0),
            b: core.column(Uint32Array, at, count, CONTACT, 4),
            begins: core.column(Float64Array, at, count, CONTACT, 8, 2),
            ends: core.column(Float64Array, at, count, CONTACT, 24, 2),
            instant: core.column(Uint8Array, at, count, CONTACT, 40),
            sinceStart: core.column(Uint8Array, at, count, CONTACT, 41),
            toStop: core.column(Uint8Array, at, count, CONTACT, 42),
        });
        return core.within((arena) =>
            core.records("web_contacts_of", [this[AT], core.options(arena, "contacts", options)], CONTACT, take));
    }

    /** The same motion without bodies, { motion, reached }: their vertices fly along parabolas of their own, at
     * most `reached` from where the bodies have them, which is not above `deviation`. So partitions follow bodies that turn. */
    withoutBodies(deviation) {
        return this[CORE].within((arena) => {
            const core = this[CORE], reached = arena.room(8), out = arena.room(4);
            core.call("froe_motion_without_bodies", this[AT], number(deviation, "deviation"), 0, out, reached);
            return { motion: Motion.made(core, core.uint(out)), reached: core.copy(Float64Array, reached, 1)[0] };
        });
    }
    /** A partition that follows the motion, at the beginning of the window. Options: seed, order, epoch, swap, augmented. */
    partition(options = {}) {
        const core = this[CORE], all = arraysOf({ order: Uint32Array }, options);
        checkLengths(all, ["order"], this.objectCount);
        return core.within((arena) => new Kinetic(this, new Handle(core, "froe_kinetic_free",
            core.made("froe_kinetic_new", this[AT], core.options(arena, "kinetic", all), 0), this[HANDLE])));
    }

    /** The bytes of a file of OGC Moving Features JSON, which readMotion() takes. */
    write() {
        return this[CORE].files(({ path, take }) => this[CORE].within((arena) => {
            this[CORE].call("froe_write_motion", this[AT], arena.text(path("motion.json")));
            return take("motion.json");
        }));
    }
}
