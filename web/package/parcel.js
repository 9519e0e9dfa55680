/* parcel.js: values on their way between a page and its worker.
 *
 * What can be cloned goes as it is. Objects with methods stay where they are, and a handle goes instead; errors and
 * lists of answers get their class back on the other side. */
import { Answers } from "./answers.js";
import { FroeError } from "./core.js";
import { held, shown } from "./given.js";

const moving = new WeakSet();

/** Says of an array that it is to be moved, not copied: it is empty here afterwards. */
export function moved(array) {
    moving.add(array);
    return array;
}

const ERRORS = { TypeError, RangeError };

/** What is sent for a value. Appends to `move` the memory that moves with it; `handle` gives the handle of an object
 * that stays, or undefined. */
export function encode(value, move, handle, all = false) {
    if (typeof value === "function" || typeof value === "symbol") throw new TypeError(`A worker cannot be given ${shown(value)}.`);
    if (value === null || typeof value !== "object") return value;
    const number = handle(value);
    if (number !== undefined) return { is: "remote", held: number };
    if (ArrayBuffer.isView(value)) {
        held(value, "an array");
        const own = value.buffer instanceof ArrayBuffer; // shared memory is nobody's to give away
        if (own && (all || moving.has(value)) && !move.includes(value.buffer)) move.push(value.buffer);
        return value;
    }
    if (value instanceof Error)
        return { is: "error", name: value.name, message: value.message, status: value.status, at: [value.object, value.corner, value.axis] };
    if (value instanceof Answers)
        return { is: "answers", lists: [value.starts, value.ids, value.values].map((list) => encode(list, move, handle, all)) };
    if (Array.isArray(value)) return value.map((part) => encode(part, move, handle, all));
    return Object.fromEntries(Object.entries(value).map(([name, part]) => [name, encode(part, move, handle, all)]));
}

/** The value that was sent. `remote` makes something of a handle. */
export function decode(value, remote) {
    if (value === null || typeof value !== "object" || ArrayBuffer.isView(value)) return value;
    if (Array.isArray(value)) return value.map((part) => decode(part, remote));
    if (value.is === "remote") return remote(value.held);
    if (value.is === "answers") return new Answers(...value.lists);
    if (value.is === "error") {
        if (value.status) return new FroeError(value.status, value.message, ...value.at);
        return new (ERRORS[value.name] ?? Error)(value.message);
    }
    return Object.fromEntries(Object.entries(value).map(([name, part]) => [name, decode(part, remote)]));
}
