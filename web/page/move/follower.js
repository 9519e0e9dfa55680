/* follower.js: a motion, where its objects are at a time, and the partition that follows them.
 *
 * Two workers read the same motion. One goes through all of it at once and lists what happens. The other keeps the
 * partition at the time that is shown; it can only go on, and begins anew where time goes back. */
import { startFroe } from "../link.js";

/** Reads a motion in a worker: { name, made: [kind, n] } or { name, bytes }. */
const motionOf = (froe, source) => (source.made ? froe.generateMotion(...source.made) : froe.readMotion(source.name, source.bytes));

export class Follower {
    #source;
    #shower = null;
    #lister = null;
    #motion = null;
    #partition = null;
    #reached = -Infinity;
    #ended = false;

    /** Reads the source; gives what its window() and objects() are, in one. */
    async open(source) {
        this.#source = source;
        this.#shower = await this.#start();
        this.#motion = await motionOf(this.#shower.froe, source);
        const window = await this.#motion.window(), objects = await this.#motion.objects();
        return { ...window, ...objects };
    }
    async #start() {
        const worker = await startFroe();
        if (this.#ended) worker.end();
        return worker;
    }

    /** Everything that happens, by time, { kinds, times, objects, per }: events of the partition in the plane; contacts in
     * space, where `kinds` is null. Of each there are `per` objects, 0xffffffff where there are fewer. */
    async list() {
        this.#lister = await this.#start();
        const motion = await motionOf(this.#lister.froe, this.#source), { dim, end } = await motion.window();
        let listed;
        if (dim === 2) {
            const partition = await motion.partition(), events = await partition.advance(end);
            listed = { kinds: events.kinds, times: events.late, objects: events.objects, per: 4 };
        } else {
            const contacts = await motion.contacts(), count = contacts.a.length, objects = new Uint32Array(2 * count);
            for (let i = 0; i < count; i++) objects.set([contacts.a[i], contacts.b[i]], 2 * i);
            listed = { kinds: null, times: contacts.begins, objects, per: 2 };
        }
        this.#lister.end();
        this.#lister = null;
        return listed;
    }

    /** Where the vertices are at a time, and in the plane, with `cells`, the cells of the partition. */
    async at(time, cells) {
        if (!cells) return { positions: await this.#motion.positions(time), cells: null };
        if (time < this.#reached || !this.#partition) {
            this.#partition?.free();
            this.#partition = await this.#motion.partition();
        }
        this.#reached = time;
        if (time > await this.#partition.time()) await this.#partition.advance(time);
        const [positions, { tree }] = await Promise.all([this.#motion.positions(time), this.#partition.snapshot()]);
        const shown = await tree.cells();
        tree.free();
        return { positions, cells: shown };
    }

    end() {
        this.#ended = true;
        this.#shower?.end();
        this.#lister?.end();
    }
}
