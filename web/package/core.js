/* core.js: the module of WebAssembly: memory, calls that can fail, arrays that come and go.
 *
 * Numbers and addresses are what WebAssembly takes. `Core.call(name, ...)` gives a function of <froe/*.h> or of web/core
 * its arguments and, last, a diagnostic; a status other than FROE_OK becomes a FroeError. Structs are read where
 * web/core/layout.c asserts that their members are. */

/** What a call could not do. `status` is a name of the C interface ("FROE_E_INPUT"); `object`, `corner` and `axis` tell
 * what it was about, or are null. */
export class FroeError extends Error {
    constructor(status, message, object = null, corner = null, axis = null) {
        super(message);
        this.name = "FroeError";
        this.status = status;
        this.object = object;
        this.corner = corner;
        this.axis = axis;
    }
}

export const NONE = 0xffffffff;
const STATUS = ["FROE_OK", "FROE_E_ARG", "FROE_E_OPTIONS", "FROE_E_MEMORY", "FROE_E_INPUT", "FROE_E_LIMIT", "FROE_E_BUDGET",
    "FROE_E_CANCELLED", "FROE_E_UNSUPPORTED", "FROE_E_IO", "FROE_E_FORMAT", "FROE_E_FROZEN", "FROE_E_AUDIT"];
const DIAGNOSTIC = 260;
const some = (n) => (n === NONE ? null : n);

export class Core {
    #wasm;
    #diagnostic;
    #forgotten = new FinalizationRegistry((held) => this.#let(held));

    constructor(wasm) {
        this.#wasm = wasm;
        this.#diagnostic = this.malloc(DIAGNOSTIC);
    }

    get size() { return this.#wasm.HEAPU8.length; }
    get fs() { return this.#wasm.FS; }
    /** The memory as an array of a type; it may move with each call that allocates. */
    view(Type, address, length) { return new Type(this.#wasm.HEAPU8.buffer, address, length); }
    /** A copy of an array in the memory. */
    copy(Type, address, length) { return this.view(Type, address, length).slice(); }
    uint(address) { return this.view(Uint32Array, address, 1)[0]; }

    malloc(bytes) {
        const address = this.#wasm._malloc(Math.max(bytes, 8));
        if (!address) throw new FroeError("FROE_E_MEMORY", `The page has no memory for ${bytes} more bytes.`);
        return address;
    }
    free(address) { this.#wasm._web_free(address); }

    /** Calls `body` with an arena: what it puts into the memory is freed afterwards. */
    within(body) {
        const taken = [];
        const arena = {
            room: (bytes) => { const at = this.malloc(bytes); taken.push(at); return at; },
            array: (values) => {
                const at = arena.room(values.byteLength);
                this.view(values.constructor, at, values.length).set(values);
                return at;
            },
            text: (text) => {
                const size = this.#wasm.lengthBytesUTF8(text) + 1, at = arena.room(size);
                this.#wasm.stringToUTF8(text, at, size);
                return at;
            },
            own: (address) => { taken.push(address); return address; },
        };
        try {
            return body(arena);
        } finally {
            for (const address of taken) this.free(address);
        }
    }

    /** A function that cannot fail. */
    get(name, ...args) { return this.#wasm["_" + name](...args); }
    text(name, ...args) {
        const address = this.get(name, ...args);
        return address ? this.#wasm.UTF8ToString(address) : null;
    }
    /** A function whose last argument is a diagnostic. */
    call(name, ...args) { this.#check(this.get(name, ...args, this.#diagnostic), true); }
    /** A function that has a status, but no diagnostic. */
    status(name, ...args) { this.#check(this.get(name, ...args), false); }

    #check(status, told) {
        if (!status) return;
        const [, object, corner, axis] = this.view(Uint32Array, this.#diagnostic, 4);
        const message = told ? this.#wasm.UTF8ToString(this.#diagnostic + 16) : "The call failed.";
        if (told) throw new FroeError(STATUS[status], message, some(object), some(corner), some(axis));
        throw new FroeError(STATUS[status], message);
    }

    /** The address that a function writes into its last argument but one. */
    made(name, ...args) {
        return this.within((arena) => {
            const out = arena.room(4);
            this.call(name, ...args, out);
            return this.uint(out);
        });
    }

    /** Frees what `held` lists, [name of the function, address] each, from the last to the first, when `object` is
     * forgotten, unless release() was called before. More may be added to `held` later. */
    watch(object, held) {
        this.#forgotten.register(object, held, held);
        return held;
    }
    release(held) {
        this.#forgotten.unregister(held);
        this.#let(held);
    }
    #let(held) {
        while (held.length) {
            const [free, address] = held.pop();
            this.get(free, address);
        }
    }

    /** Options by name: numbers, truths, names of values, texts, vectors of three. */
    options(arena, kind, options) {
        const at = arena.own(this.get(`web_${kind}_new`));
        if (!at) throw new FroeError("FROE_E_MEMORY", "The page has no more memory.");
        const number = (name, value) => this.call(`web_${kind}_number`, at, arena.text(name), Number(value));
        for (const [name, value] of Object.entries(options)) {
            if (value === undefined) continue;
            if (ArrayBuffer.isView(value)) number(name, arena.array(value));
            else if (Array.isArray(value)) value.forEach((part, i) => number(`${name}.${i}`, part));
            else if (typeof value !== "string") number(name, value);
            else if (TEXTS.has(name)) number(name, arena.text(value));
            else this.call(`web_${kind}_name`, at, arena.text(name), arena.text(value));
        }
        return at;
    }
}
const TEXTS = new Set(["method", "purpose", "settings", "title", "description"]);
