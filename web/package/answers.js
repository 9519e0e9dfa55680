/* answers.js: a list for each question of a batch */

/** Answers of a batch: those of question i are ids[starts[i] .. starts[i + 1]), with values beside them where there
 * are any (distances, parameters). */
export class Answers {
    constructor(starts, ids, values = null) {
        this.starts = starts;
        this.ids = ids;
        this.values = values;
    }
    get length() { return this.starts.length - 1; }
    at(i) { return this.ids.subarray(this.starts[i], this.starts[i + 1]); }
    valuesAt(i) { return this.values && this.values.subarray(this.starts[i], this.starts[i + 1]); }
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
