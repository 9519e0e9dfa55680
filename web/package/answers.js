/* answers.js: a list for each question of a batch */

import { among } from "./given.js";

/** Answers of a batch: those of question i are ids[starts[i] .. starts[i + 1]), with values beside them where there
 * are any (distances, parameters). */
export class Answers {
    constructor(starts, ids, values = null) {
        this.starts = starts;
        this.ids = ids;
        this.values = values;
    }
    get length() { return this.starts.length - 1; }
    at(i) { return this.#of(this.ids, i); }
    valuesAt(i) { return this.#of(this.values, i); }
    #of(list, i) {
        among(i, this.length, "question");
        return list && list.subarray(this.starts[i], this.starts[i + 1]);
    }
    *[Symbol.iterator]() { for (let i = 0; i < this.length; i++) yield this.at(i); }
}

const ANSWERS = 24; // bytes of froe_answers

/** Calls a batch function whose last arguments are its options and a froe_answers. */
export function answersOf(core, name, ...args) {
    return core.filled(name, [...args, core.batch], ANSWERS, "froe_answers_free", ([starts, ids, values, queries]) => {
        const list = core.copy(Uint32Array, starts, queries + 1), count = list[queries];
        return new Answers(list, core.copy(Uint32Array, ids, count), values ? core.copy(Float64Array, values, count) : null);
    });
}
