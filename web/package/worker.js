/* worker.js: froe in a worker, so that a page stays awake while it works.
 *
 *     const worker = await FroeWorker.start({ progress: (share) => bar.value = share });
 *     const scene = await worker.froe.triangles(moved(coords), moved(indices));
 *     const tree = await scene.build({ purpose: "draw" });
 *     const { text } = await tree.render({ shading: "cel" });
 *     worker.end();                                                  // at once, whatever it does: the way to cancel
 *
 * Scenes, trees and what else has methods stay in the worker, and the page has a remote: an object with the same
 * methods, whose results are promises; properties are methods, too: await tree.report(). Arrays that are given are
 * copied, or moved where moved() says so; arrays that come back are moved. Calls are answered one after the other. */
import { FroeError } from "./core.js";
import { given, listener } from "./given.js";
import { fromNode } from "./node.js";
import { decode, encode, moved } from "./parcel.js";

export { moved };

/* Bundlers find the worker where it is spelled out. Node has workers of its own, which speak a little differently. */
async function open() {
    if (globalThis.Worker) {
        const worker = new Worker(new URL("./served.js", import.meta.url), { type: "module" });
        return {
            send: (message, move) => worker.postMessage(message, move),
            hear: (said, failed) => {
                worker.onmessage = (event) => said(event.data);
                worker.onerror = (event) => { event.preventDefault?.(); failed(event.message); };
            },
            end: () => worker.terminate(),
        };
    }
    const { Worker: Thread } = await fromNode("worker_threads"), here = import.meta.url;
    const thread = new Thread(new URL("./served.js", here));
    return {
        send: (message, move) => thread.postMessage(message, move),
        hear: (said, failed) => { thread.on("message", said); thread.on("error", (error) => failed(error.message)); },
        end: () => thread.terminate(),
    };
}

export class FroeWorker {
    #port;
    #progress;
    #waiting = new Map();
    #next = 1;
    #ended = null;
    #forgotten = new FinalizationRegistry((handle) => this.#ended ?? this.#port.send({ forget: handle }));

    /** Starts a worker and loads froe there. Options: those of load(); `progress` is told the share done of the call
     * that runs, 20 times a second at most. */
    static async start(options) {
        const { plain, progress } = given(options, { plain: undefined, progress: null });
        const worker = new FroeWorker();
        worker.#progress = listener(progress);
        worker.#port = await open();
        worker.#port.hear((answer) => worker.#hear(answer), (why) => worker.#fail(why));
        try {
            /** What load() gives, from afar. */
            worker.froe = worker.#remote(await worker.#ask({ load: { plain } }));
        } catch (error) {
            worker.#port.end();
            throw error;
        }
        return worker;
    }

    /** Ends the worker at once. What was asked is refused with FROE_E_CANCELLED, and its remotes are of no use. */
    end() {
        this.#port.end();
        this.#close(new FroeError("FROE_E_CANCELLED", "The work was cancelled."));
    }
    get ended() { return this.#ended !== null; }

    #close(error) {
        this.#ended ??= error;
        for (const { refuse } of this.#waiting.values()) refuse(this.#ended);
        this.#waiting.clear();
    }
    #fail(why) {
        this.#port.end();
        this.#close(new FroeError("FROE_E_MEMORY", `The worker has stopped: ${why || "it could not be loaded"}.`));
    }

    #ask(message, move = []) {
        if (this.#ended) return Promise.reject(this.#ended);
        return new Promise((accept, refuse) => {
            const id = this.#next++;
            this.#port.send({ id, ...message }, move); // or throws: then nothing waits
            this.#waiting.set(id, { accept, refuse });
        });
    }
    #hear({ id, progress, value, error }) {
        if (progress !== undefined) return this.#progress?.(progress);
        const asked = this.#waiting.get(id);
        if (!asked) return;
        this.#waiting.delete(id);
        if (error) asked.refuse(decode(error));
        else asked.accept(decode(value, (handle) => this.#remote(handle)));
    }

    #remote(handle) {
        const call = (name) => async (...args) => {
            const move = [];
            return this.#ask({ handle, name, args: args.map((arg) => encode(arg, move, (it) => it[HANDLE])) }, move);
        };
        const remote = new Proxy({}, {
            get: (_, name) => (name === HANDLE ? handle : UNASKED.includes(name) || typeof name === "symbol" ? undefined : call(name)),
        });
        this.#forgotten.register(remote, handle);
        return remote;
    }
}
const HANDLE = Symbol("handle");
const UNASKED = ["then", "toJSON"]; // what a promise and JSON.stringify() look for by themselves
