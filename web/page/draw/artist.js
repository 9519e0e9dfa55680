/* artist.js: a scene, its trees, and the newest picture that was asked for.
 *
 * A worker builds a tree that is made for one picture, and draws. Another one then builds the tree with the fewest
 * pieces; when it is ready it takes over, and the first ends. Each is ended to cancel it. */
import { groupsOf, sceneFrom } from "../open.js";
import { isCancelled, startFroe } from "../link.js";

/* A worker to come, which can be ended before it is there. */
class Helper {
    worker = null;
    #ended = false;

    take(worker) {
        this.worker = worker;
        if (this.#ended) worker.end();
    }
    end() {
        this.#ended = true;
        this.worker?.end();
    }
}

export class Artist {
    #tell;
    #source = null;
    #drawer = null;     // { worker, tree, sections } that draws
    #builder = null;    // a helper that builds the better tree
    #improved = false;  // has a better tree been begun?
    #aside = null;      // a helper that draws all pictures of a turn
    #wanted = null;     // options of the picture to come
    #busy = false;
    #calls = 0;         // to the tree that draws: it is not given up while one runs
    #age = 0;           // counts scenes: what belongs to an older one is dropped

    /** `tell` hears of: scene(model), tree(report, best), progress(what, share), picture(picture, options), rest(). */
    constructor(tell) { this.#tell = tell; }

    /** Reads a source, which `read` gives, and draws it. `allow(objects)` may refuse before anything is built. Fails with
     * what went wrong. */
    async open(read, allow) {
        this.close();
        const age = this.#age;
        try {
            const [source, worker] = await Promise.all([read(), this.#start("Reading")]);
            if (age !== this.#age) return;
            this.#source = source;
            const scene = await sceneFrom(worker.froe, source);
            const model = await modelOf(scene);
            if (age !== this.#age) return;
            this.#tell.scene(model);
            if (!await allow(model.objects) || age !== this.#age) return;
            worker.what = "Building a tree";
            const tree = await scene.build({ purpose: "draw" }), report = await tree.report();
            if (age === this.#age) this.#take(worker, tree, report, false);
        } catch (error) {
            if (age !== this.#age) return; // whatever it was, it is no longer wanted
            this.close();
            throw error;
        }
    }

    async #start(what) {
        const age = this.#age, tell = (share) => { if (age === this.#age) this.#tell.progress(worker.what, share); };
        const worker = await startFroe(tell);
        worker.what = what;
        if (age !== this.#age) worker.end();
        else if (!this.#drawer) this.#drawer = { worker, tree: null, sections: new Map() };
        return worker;
    }
    #take(worker, tree, report, best) {
        if (this.#drawer.worker !== worker) this.#drawer.worker.end();
        this.#drawer = { worker, tree, sections: new Map() };
        this.#tell.tree(report, best);
        this.#pump();
    }

    /** Builds the tree with the fewest pieces, once; until it is there, pictures come from the first. */
    async improve() {
        if (this.#improved || !this.#drawer?.tree) return;
        this.#improved = true;
        const mine = this.#builder = new Helper(), what = "Looking for fewer pieces";
        await this.#help(mine, what, async (worker) => {
            const scene = await sceneFrom(worker.froe, this.#source);
            const tree = await scene.build({ purpose: "pieces" }), report = await tree.report();
            while (this.#calls) await new Promise((resume) => setTimeout(resume, 20));
            if (mine !== this.#builder) return;
            this.#wanted ??= this.#drawer.drawn;
            this.#builder = mine.worker = null;
            this.#take(worker, tree, report, true);
        });
    }

    /** An SVG that turns. Undefined: it was cancelled. */
    async turning({ plane, ...options }) {
        this.#aside?.end();
        const mine = this.#aside = new Helper(), bytes = await this.saved();
        return this.#help(mine, "Drawing all around", async (worker) => {
            const tree = await worker.froe.open(bytes), cut = plane ? await tree.section(plane) : tree;
            return cut.renderTurning({ ...options, ...(plane ? { section: -1 } : {}) });
        });
    }

    /* What a helper does in a worker of its own, which ends with it. */
    async #help(helper, what, work) {
        try {
            helper.take(await this.#start(what));
            return await work(helper.worker);
        } catch (error) {
            if (!isCancelled(error)) throw error;
            return undefined;
        } finally {
            helper.end();
            if (this.#builder === helper) this.#builder = null;
            if (this.#aside === helper) this.#aside = null;
            this.#tell.rest();
        }
    }

    /** Ends what goes on beside the tree that draws. False: nothing does. */
    stay() {
        const one = this.#aside ?? this.#builder;
        one?.end();
        if (one === this.#aside) this.#aside = null;
        else this.#builder = null;
        this.#tell.rest();
        return !!one;
    }
    /** Is nothing going on? */
    get resting() { return !this.#aside && !this.#builder && !this.#busy; }

    /** Asks for a picture; of several that are asked for while one is drawn, the last is. */
    draw(options) {
        this.#wanted = options;
        this.#pump();
    }
    async #pump() {
        if (this.#busy || !this.#wanted || !this.#drawer?.tree) return;
        const age = this.#age, options = this.#wanted, drawer = this.#drawer, began = performance.now();
        this.#wanted = null;
        this.#busy = true;
        drawer.worker.what = "Drawing";
        try {
            const picture = await this.render(options);
            if (age !== this.#age) return;
            drawer.drawn = options;
            this.#tell.picture(picture, options, performance.now() - began);
        } catch (error) {
            if (age === this.#age) this.#tell.failed(error);
        } finally {
            if (age === this.#age) {
                this.#busy = false;
                if (this.#wanted) this.#pump();
                else this.#tell.rest();
            }
        }
    }

    /** A picture of the tree as it is: options of froe.render() with `plane`, what a section leaves. */
    render(options) { return this.#call(() => this.#render(options)); }
    /** The tree as froe build saves it. */
    saved() { return this.#call(() => this.#drawer.tree.save()); }

    async #call(work) {
        this.#calls++;
        try {
            return await work();
        } finally {
            this.#calls--;
        }
    }
    async #render({ plane = null, ...options }) {
        const { tree, sections } = this.#drawer;
        if (!plane) return tree.render(options);
        const key = plane.join();
        if (!sections.has(key)) {
            for (const [old, cut] of sections) {
                cut.then((it) => it.free(), () => {});
                sections.delete(old);
            }
            sections.set(key, tree.section(plane));
        }
        return (await sections.get(key)).render({ ...options, section: -1 });
    }

    /** Ends all work. What was drawn stays; to go on, the source is opened anew. */
    close() {
        this.#age++;
        this.#drawer?.worker.end();
        this.#builder?.end();
        this.#aside?.end();
        this.#drawer = this.#builder = this.#wanted = null;
        this.#busy = this.#improved = false;
    }
}

/* What a preview and a camera need of a scene. */
async function modelOf(scene) {
    const dim = await scene.dim();
    if (dim !== 3) throw new Error("This file is a map. The rooms Partition and Ask take maps; a drawing needs a model in space");
    const [arrays, groups, bounds, up, objects] = await Promise.all([scene.arrays(), groupsOf(scene), scene.bounds(), scene.up(), scene.objectCount()]);
    if (!bounds) throw new Error("There is nothing in this file that can be drawn");
    const materials = new Map();
    for (const { material } of groups) if (!materials.has(material)) materials.set(material, materials.size);
    return { arrays, groups, materials: groups.map(({ material }) => materials.get(material)), lo: [...bounds.lo], hi: [...bounds.hi],
        points: arrays.coords, up, objects };
}
