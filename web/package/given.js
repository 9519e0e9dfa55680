/* given.js: what callers give: numbers, texts, options and arrays of the right sorts and lengths. What is read beyond the
 * end of an array that is too short, WebAssembly cannot know; and it makes a number of anything. */

const LONGEST = 40; // characters of a text that messages show

/** Any value, as messages show it. */
export function shown(value) {
    if (typeof value === "string") return `'${value.length > LONGEST ? `${value.slice(0, LONGEST)} …` : value}'`;
    if (typeof value === "bigint") return `${value}n`;
    if (typeof value === "function") return "a function";
    if (Array.isArray(value) || ArrayBuffer.isView(value)) return "an array";
    return value !== null && typeof value === "object" ? "an object" : String(value);
}
/** 1 number, 2 numbers. */
export const counted = (n, one, several = `${one}s`) => `${n} ${n === 1 ? one : several}`;

export function text(value, name) {
    if (typeof value !== "string") throw new TypeError(`${name} is not a text, but ${shown(value)}.`);
    return value;
}
export function number(value, name) {
    if (typeof value !== "number") throw new TypeError(`${name} is not a number, but ${shown(value)}.`);
    return value;
}
/** A function that is told the progress, or null. */
export function listener(value) {
    if (value !== null && typeof value !== "function") throw new TypeError(`progress is not a function, but ${shown(value)}.`);
    return value;
}
export function whole(value, name, least = 0, most = 0xffffffff) {
    if (!(Number.isInteger(value) && value >= least && value <= most))
        throw new RangeError(`${name} is not a whole number from ${least} to ${most}, but ${shown(value)}.`);
    return value;
}
/** The number of one of `count` things. */
export function among(i, count, one) {
    if (!(Number.isInteger(i) && i >= 0 && i < count)) throw new RangeError(`There is no ${one} ${shown(i)} among ${count}.`);
    return i;
}
/** One of some words: its place among them. */
export function word(value, words, name) {
    const place = words.indexOf(value);
    if (place < 0) throw new TypeError(`${name} is none of ${words.join(", ")}, but ${shown(value)}.`);
    return place;
}

/** Options: those that are given, without undefined and null, and for the others the standard ones. With `standard` there
 * are no others than those in it. */
export function given(options, standard = null) {
    const all = { ...standard };
    if (options === undefined || options === null) return all;
    if (typeof options !== "object" || options[Symbol.iterator] || ArrayBuffer.isView(options))
        throw new TypeError(`Options are an object with their names, and not ${shown(options)}.`);
    for (const [name, value] of Object.entries(options)) {
        if (standard && !Object.hasOwn(standard, name)) throw new TypeError(`There is no option ${name}.`);
        if (value !== undefined && value !== null) all[name] = value;
    }
    return all;
}

/** An array whose memory is still its own: one whose memory was moved to a worker, or ends before the array does, has no
 * numbers, and methods of arrays refuse it. */
export function held(array, name) {
    try {
        if (array.byteLength === 0) array.keys();
    } catch {
        throw new TypeError(`The memory of ${name} has been moved to somewhere else, or has shrunk.`);
    }
    return array;
}

/** Numbers as an array of a type: as they are where they are one, copied where not. A number that the type does not have
 * is refused, but for those that floats round. */
export function typed(Type, values, name) {
    if (values instanceof Type) return held(values, name);
    const long = Type === BigUint64Array, allowed = (value) => typeof value === "number" || (long && typeof value === "bigint");
    if (!Array.isArray(values) && !(ArrayBuffer.isView(values) && !(values instanceof DataView)))
        throw new TypeError(`${name} is not an array of numbers, but ${shown(values)}.`);
    if (ArrayBuffer.isView(values)) held(values, name);
    for (let i = 0; i < values.length; i++)
        if (!allowed(values[i]) || (long && !Number.isInteger(Number(values[i]))))
            throw new TypeError(`Number ${i} of ${name} is ${shown(values[i])}.`);
    const array = long ? Type.from(values, BigInt) : Type.from(values);
    if (Type !== Float64Array)
        for (let i = 0; i < array.length; i++)
            if (Number(array[i]) !== Number(values[i])) throw new RangeError(`Number ${i} of ${name} is ${shown(values[i])}, which is out of range.`);
    return array;
}

/** Options of which `types` names those that are arrays. */
export function arraysOf(types, options) {
    const all = given(options);
    for (const name of Object.keys(all)) if (Object.hasOwn(types, name)) all[name] = typed(types[name], all[name], name);
    return all;
}
/** An array of so many doubles. */
export function doubles(values, count, name) {
    const array = typed(Float64Array, values, name);
    if (array.length !== count) throw new TypeError(`${name} has ${counted(array.length, "number")}, and not ${count}.`);
    return array;
}

/** Starts of `count` items of `total` corners: 0 first, ascending. */
export function checkStarts(starts, count, total, name = "starts") {
    if (starts.length < count + 1 || starts[0] !== 0)
        throw new TypeError(`${name} does not have ${counted(count + 1, "number")} of which the first is 0.`);
    for (let i = 0; i < count; i++) if (starts[i + 1] < starts[i]) throw new TypeError(`${name} is not ascending.`);
    if (starts[count] > total)
        throw new TypeError(`${name} ends with ${starts[count]}, and only ${total} ${total === 1 ? "is" : "are"} given.`);
}

/** Each array of `names` that is given has `count` numbers. */
export function checkLengths(options, names, count) {
    for (const name of names)
        if (options[name] && options[name].length < count)
            throw new TypeError(`${name} has ${counted(options[name].length, "number")}, and ${count} ${count === 1 ? "is" : "are"} needed.`);
}
