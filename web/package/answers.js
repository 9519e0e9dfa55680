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
    valuesAt(i) { return this.values.subarray(this.starts[i], this.starts[i + 1]); }
    *[Symbol.iterator]() { for (let i = 0; i < this.length; i++) yield this.at(i); }
}

const SIZE = 24; // of froe_answers

/** Calls a batch function whose last arguments are its options (none) and a froe_answers. */
export function answersOf(core, name, ...args) {
    return core.within((arena) => {
        const out = arena.room(SIZE);
        core.call(name, ...args, 0, out);
        const [starts, ids, values, queries] = core.view(Uint32Array, out, 4);
        const list = core.copy(Uint32Array, starts, queries + 1), count = list[queries];
        const answers = new Answers(list, core.copy(Uint32Array, ids, count),
            values ? core.copy(Float64Array, values, count) : null);
        core.get("froe_answers_free", out);
        return answers;
    });
}
