/* worker.d.ts: the types of froe in a worker */
import type { Answers, Froe, Kinetic, Motion, Scene, Tree } from "./index.js";

/** Says of an array that it is to be moved to the worker, not copied: it is empty here afterwards. */
export function moved<T extends ArrayBufferView>(array: T): T;

/** An object in the worker: the same methods, whose results are promises. Properties are methods, too; those that can be
 * set take a value. */
export type Remote<T> = {
    readonly [K in Extract<keyof T, string>]: T[K] extends (...args: infer A) => infer R
        ? (...args: A) => Promise<Distant<R>>
        : (value?: T[K]) => Promise<Distant<T[K]>>;
};
/** What comes back: objects with methods stay in the worker, and all else is moved. */
export type Distant<T> = T extends Scene | Tree | Motion | Kinetic ? Remote<T>
    : T extends Answers | ArrayBufferView | string | number | bigint | boolean | null | undefined | void ? T
    : { [K in keyof T]: Distant<T[K]> };

/** froe in a worker of its own, so that a page stays awake. Calls are answered one after the other. */
export class FroeWorker {
    private constructor();
    /** Starts a worker and loads froe there; `progress` is told the share done of the call that runs, 20 times a second at
     * most. */
    static start(options?: { plain?: boolean; progress?: ((done: number) => void) | null }): Promise<FroeWorker>;
    /** What load() gives, from afar. */
    readonly froe: Remote<Froe>;
    readonly ended: boolean;
    /** Ends the worker at once: the way to cancel. What was asked is refused with FROE_E_CANCELLED. */
    end(): void;
}
