/* resource.js: what has memory that JavaScript does not free by itself */
import { FroeError } from "./core.js";

/** Members for this package alone: the module, the address, and what else is to be freed. */
export const CORE = Symbol("core"), AT = Symbol("at"), HANDLE = Symbol("handle"), ALSO = Symbol("also");

/** An address that a function frees once nothing uses it any more. It uses its parent: a partition that follows a
 * motion uses the motion. */
export class Handle {
    #core;
    #free;
    #parent;
    #uses = 1;

    constructor(core, free, address, parent = null) {
        this.#core = core;
        this.#free = free;
        this.address = address;
        this.#parent = parent;
        if (parent) parent.#uses++;
    }
    release() {
        for (let handle = this; handle && --handle.#uses === 0; handle = handle.#parent)
            if (handle.#free) handle.#core.get(handle.#free, handle.address);
    }
}

const forgotten = new FinalizationRegistry((handle) => handle.release());

/** Scenes, trees, motions and partitions of these. free() frees the memory now; otherwise it is freed some time after
 * the last use. With `using`, it is freed at the end of the block. */
export class Resource {
    #core;
    #handles;
    #what;

    constructor(core, what, handle) {
        this.#core = core;
        this.#what = what;
        this.#handles = [];
        this[ALSO](handle);
    }
    get [CORE]() { return this.#core; }
    get [HANDLE]() {
        if (!this.#handles.length) throw new FroeError("FROE_E_ARG", `The ${this.#what} has been freed.`);
        return this.#handles[0];
    }
    get [AT]() { return this[HANDLE].address; }
    [ALSO](handle) {
        this.#handles.push(handle);
        forgotten.register(this, handle, this);
        return handle;
    }

    /** Once freed, it answers nothing any more; what was made of it may stay in use. */
    free() {
        this.#core.idle();
        forgotten.unregister(this);
        for (const handle of this.#handles.splice(0)) handle.release();
    }
    [Symbol.dispose ?? Symbol.for("Symbol.dispose")]() { this.free(); }
}
