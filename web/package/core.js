/* core.js: the module of WebAssembly: memory, calls that can fail, structs and arrays that come and go.
 *
 * Numbers and addresses are what WebAssembly takes. `Core.call(name, ...)` gives a function of <froe/*.h> or of
 * web/core its arguments and, last, a diagnostic; a status other than FROE_OK becomes a FroeError. Structs are read
 * where web/core/layout.c asserts that their members are. */

import { given, held, number, shown, text } from "./given.js";

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

/** "No object", "no group" in arrays of numbers. */
export const NONE = 0xffffffff;
const DIAGNOSTIC = 260, BYTES = 16;
const some = (n) => (n === NONE ? null : n);

/* A name without folders, as it is in UTF-8: halves of characters become U+FFFD. */
function fileOf(name) {
    const own = new TextDecoder().decode(new TextEncoder().encode(text(name, "The name of a file").replace(/.*[/\\]/s, "")));
    if (own.includes("\0")) throw new TypeError(`The name of a file, ${shown(own)}, has a character of code 0.`);
    return [".", ".."].includes(own) || !own ? "unnamed" : own;
}

export class Core {
    #wasm;
    #diagnostic;
    #batch;
    #kinds = new Map();
    #depth = 0;          // of within()
    #telling = false;    // does the progress function run?
    #thrown = null;      // by it
    /** Told the share done while a call runs; false cancels the call. */
    progress = null;

    constructor(wasm) {
        this.#wasm = wasm;
        wasm.progress = (done) => this.#goOn(done);
        this.#diagnostic = this.malloc(DIAGNOSTIC);
        const batch = this.#kind("batch");
        this.#batch = this.malloc(batch.size);
        this.get("web_kind_defaults", batch.at, this.#batch);
    }
    /* An exception must not pass through the frames of WebAssembly: they would leave what they hold. */
    #goOn(done) {
        this.#telling = true;
        try {
            return this.progress === null || this.progress(done) !== false;
        } catch (error) {
            this.#thrown ??= { error };
            return false;
        } finally {
            this.#telling = false;
        }
    }
    #throwAgain() {
        if (!this.#thrown) return;
        const { error } = this.#thrown;
        this.#thrown = null;
        throw error;
    }
    /** Refuses what the progress function asks: the call that it is told of has not finished with its objects. */
    idle() {
        if (this.#telling) throw new FroeError("FROE_E_ARG", "A progress function cannot use froe, which is in the midst of a call.");
    }

    get size() { return this.#wasm.HEAPU8.length; }
    /** Options of a batch of questions. */
    get batch() { return this.#batch; }
    /** The memory as an array of a type; it may move with each call that allocates. */
    view(Type, address, length) { return new Type(this.#wasm.HEAPU8.buffer, address, length); }
    /** A copy of an array in the memory. */
    copy(Type, address, length) { return this.view(Type, address, length).slice(); }
    uint(address) { return this.view(Uint32Array, address, 1)[0]; }
    double(address) { return this.view(Float64Array, address, 1)[0]; }
    /** The text at an address; null where that is 0. */
    string(address) { return address ? this.#wasm.UTF8ToString(address) : null; }
    /** One member of each of `count` structs of `stride` bytes, as an array: `per` values of a Type at `offset`. */
    column(Type, address, count, stride, offset, per = 1) {
        const column = new Type(count * per), size = Type.BYTES_PER_ELEMENT;
        if (!count) return column;
        const values = this.view(Type, address, (count * stride) / size);
        for (let i = 0, from = offset / size; i < count; i++, from += stride / size)
            for (let k = 0; k < per; k++) column[i * per + k] = values[from + k];
        return column;
    }

    malloc(bytes) {
        const address = this.#wasm._malloc(Math.max(bytes, 8)) >>> 0;
        if (!address) throw new FroeError("FROE_E_MEMORY", `The page has no memory for ${bytes} more bytes.`);
        return address;
    }

    /** Calls `body` with an arena: what it puts into the memory is freed afterwards. */
    within(body) {
        this.idle();
        this.#depth++;
        const taken = [];
        const arena = {
            room: (bytes) => { const at = this.malloc(bytes); taken.push(at); return at; },
            array: (values) => {
                const at = arena.room(values.byteLength);
                this.view(Uint8Array, at, values.byteLength).set(new Uint8Array(values.buffer, values.byteOffset, values.byteLength));
                return at;
            },
            text: (text) => {
                if (text.includes("\0")) throw new TypeError(`The text ${shown(text)} has a character of code 0.`);
                const size = this.#wasm.lengthBytesUTF8(text) + 1, at = arena.room(size);
                this.#wasm.stringToUTF8(text, at, size);
                return at;
            },
        };
        try {
            const made = body(arena);
            if (this.#depth === 1) this.#throwAgain(); // what was made is forgotten, and is freed as such
            return made;
        } finally {
            for (const address of taken) this.get("web_free", address);
            if (--this.#depth === 0) this.#thrown = null;
        }
    }

    /** A function that cannot fail. */
    get(name, ...args) {
        this.idle();
        return this.#wasm["_" + name](...args);
    }
    /** The text that a function returns; null where there is none. */
    text(name, ...args) { return this.string(this.get(name, ...args) >>> 0); }
    /** A function that returns a status. Its last argument is a diagnostic; one that takes none does not see it. */
    call(name, ...args) {
        const told = this.view(Uint32Array, this.#diagnostic, 1);
        told[0] = 0;
        const status = this.get(name, ...args, this.#diagnostic);
        if (status || this.#depth === 0) this.#throwAgain();
        if (status) throw this.#failure(status);
    }
    #failure(status) {
        const name = this.text("froe_status_name", status);
        const [told, object, corner, axis] = this.view(Uint32Array, this.#diagnostic, 4);
        if (told) return new FroeError(name, this.string(this.#diagnostic + 16), some(object), some(corner), some(axis));
        const text = this.text("froe_status_text", status);
        return new FroeError(name, `${text[0].toUpperCase()}${text.slice(1)}.`);
    }
    /** The number or address that a function writes into its last argument, or last before a diagnostic. */
    made(name, ...args) {
        return this.within((arena) => {
            const out = arena.room(4);
            this.call(name, ...args, out);
            return this.uint(out);
        });
    }
    /** Lets a function fill a struct of `size` bytes with arrays: what `take` makes of its words, after which `free`
     * frees the arrays. */
    filled(name, args, size, free, take) {
        return this.within((arena) => {
            const out = arena.room(size);
            this.call(name, ...args, out);
            try {
                return take(this.copy(Uint32Array, out, size / 4), out);
            } finally {
                this.get(free, out);
            }
        });
    }
    /** The bytes that a function of web/core gives in a web_bytes. */
    bytes(name, ...args) {
        return this.filled(name, args, BYTES, "web_bytes_free", ([at, count]) => this.copy(Uint8Array, at, count));
    }
    /** The records of `stride` bytes that it gives: what `take` makes of their address and their number. */
    records(name, args, stride, take) {
        return this.filled(name, args, BYTES, "web_bytes_free", ([at, count]) => take(at, count / stride));
    }

    #kind(name) {
        if (!this.#kinds.has(name)) {
            const at = this.within((arena) => this.get("web_kind_of", arena.text(name)) >>> 0);
            this.#kinds.set(name, { at, size: at ? this.get("web_kind_size", at) : 0 });
        }
        return this.#kinds.get(name);
    }
    #named(name, item) { return item !== null && typeof item === "object" && this.#kind(name).at !== 0; }
    /** A struct of options, its members by name: numbers, truths, texts and names of values, arrays as typed arrays,
     * vectors as arrays of three numbers, sets as arrays of names, structs of the kind `name` as arrays of objects. */
    options(arena, kind, options = {}) { return this.list(arena, kind, [options]); }
    /** Such structs, one after the other. */
    list(arena, kind, items) {
        const { at, size } = this.#kind(kind), room = arena.room(items.length * size);
        items.forEach((options, i) => {
            this.get("web_kind_defaults", at, room + i * size);
            for (const [name, value] of Object.entries(given(options))) this.#set(arena, at, room + i * size, name, value);
        });
        return room;
    }
    #set(arena, kind, at, name, value) {
        const set = (type, name, value) => this.call(`web_set_${type}`, kind, at, arena.text(name), value);
        if (ArrayBuffer.isView(value)) set("address", name, arena.array(value));
        else if (typeof value === "string") set("text", name, arena.text(value));
        else if (typeof value === "boolean") set("truth", name, value ? 1 : 0);
        else if (["number", "bigint"].includes(typeof value)) set("number", name, Number(value));
        else if (!Array.isArray(value)) throw new TypeError(`The option ${name} cannot be ${shown(value)}.`);
        else if (this.#named(name, value[0])) set("address", name, this.list(arena, name, value));
        else if (typeof value[0] === "number") value.forEach((part, i) => set("number", `${name}.${i}`, number(part, name)));
        else {
            this.call("web_set_empty", kind, at, arena.text(name));
            for (const part of value) this.call("web_add_name", kind, at, arena.text(name), arena.text(text(part, `What ${name} lists`)));
        }
    }

    /** Calls `body` in an empty folder of the module's own file system, with `put(name, bytes)`, which makes a file, and
     * `take(name)`, which gives the bytes of one. Both drop folders of names, as path(name) does. No file stays. */
    files(body) {
        this.idle();
        const { FS } = this.#wasm, folder = "/froe";
        FS.mkdir(folder);
        FS.chdir(folder);
        try {
            return body({ path: fileOf, put: (name, bytes) => FS.writeFile(fileOf(name), held(bytes, `the file ${shown(name)}`)),
                take: (name) => FS.readFile(fileOf(name)) });
        } finally {
            for (const name of FS.readdir(folder)) if (name !== "." && name !== "..") FS.unlink(`${folder}/${name}`);
            FS.chdir("/");
            FS.rmdir(folder);
        }
    }
}
