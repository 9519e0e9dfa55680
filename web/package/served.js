/* served.js: what runs in the worker of worker.js: it loads froe, keeps objects by number, and answers calls */
import { Answers } from "./answers.js";
import { FroeError } from "./core.js";
import { load } from "./index.js";
import { fromNode } from "./node.js";
import { decode, encode } from "./parcel.js";

const EVERY = 50; // milliseconds between two shares of progress

let port = globalThis;    // where messages come from and go to
const kept = new Map();   // by handle: { object, remotes }, the latter as many as have been sent
let next = 1, told = 0;

/* Objects of classes other than those that parcel.js knows have methods, and stay. */
function keep(value) {
    const kind = Object.getPrototypeOf(value);
    if (kind === Object.prototype || Array.isArray(value) || ArrayBuffer.isView(value)) return undefined;
    if (value instanceof Error || value instanceof Answers) return undefined;
    for (const [handle, it] of kept)
        if (it.object === value) {
            it.remotes++; // add() returns its scene
            return handle;
        }
    kept.set(next, { object: value, remotes: 1 });
    return next++;
}

function progress(share) {
    const now = performance.now();
    if (now - told < EVERY) return;
    told = now;
    port.postMessage({ progress: share });
}

async function answer({ load: options, handle, name, args }) {
    if (options) return load({ ...options, progress });
    const object = kept.get(handle)?.object;
    if (!object && name === "free") return undefined; // as often as one likes
    if (!object) throw new FroeError("FROE_E_ARG", "The object has been freed.");
    if (!(name in object)) throw new TypeError(`There is no ${name} in a ${object.constructor.name}.`);
    const values = args.map((arg) => decode(arg, (held) => kept.get(held)?.object));
    if (typeof object[name] === "function") return object[name](...values);
    if (values.length) object[name] = values[0];
    return object[name];
}

async function serve(message) {
    if (message.forget) {
        const it = kept.get(message.forget);
        if (!it || --it.remotes) return;
        it.object.free?.();
        kept.delete(message.forget);
        return;
    }
    const move = [];
    try {
        const value = await answer(message);
        if (message.name === "free") kept.delete(message.handle);
        const sent = message.load ? keep(value) : encode(value, move, keep, true);
        port.postMessage({ id: message.id, value: sent }, move);
    } catch (error) {
        port.postMessage({ id: message.id, error: encode(error, [], () => undefined) });
    }
}

/* One after the other, as they came: what is forgotten may be an argument of a call before. */
let last = Promise.resolve();
const hear = (message) => { last = last.then(() => serve(message)); };
if (globalThis.postMessage) port.onmessage = (event) => hear(event.data);
else fromNode("worker_threads").then(({ parentPort }) => (port = parentPort).on("message", hear));
