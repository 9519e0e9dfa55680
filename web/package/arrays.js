/* arrays.js: the arrays that callers give, and whether they are long enough: what is read beyond the end of one that is
 * too short, WebAssembly cannot know */

/** Numbers as an array of a type: as they are where they are one, copied where not. */
export function typed(Type, values, name) {
    if (values instanceof Type) return values;
    if (ArrayBuffer.isView(values) && !(values instanceof DataView)) return Type.from(values);
    if (Array.isArray(values)) return Type.from(values, Type === BigUint64Array ? BigInt : undefined);
    throw new TypeError(`${name} is not an array of numbers.`);
}

/** Of `given`, what `types` names as arrays, and the rest as it is. What is undefined or null is left out. */
export function arraysOf(types, given) {
    const options = {};
    for (const [name, value] of Object.entries(given))
        if (value !== undefined && value !== null) options[name] = types[name] ? typed(types[name], value, name) : value;
    return options;
}

/** Starts of `count` items of `total` corners: 0 first, ascending. */
export function checkStarts(starts, count, total, name = "starts") {
    if (starts.length < count + 1 || starts[0] !== 0)
        throw new TypeError(`${name} does not have ${count + 1} numbers of which the first is 0.`);
    for (let i = 0; i < count; i++) if (starts[i + 1] < starts[i]) throw new TypeError(`${name} is not ascending.`);
    if (starts[count] > total)
        throw new TypeError(`${name} ends with ${starts[count]}, and only ${total} are given.`);
}

/** Each array of `names` that is given has `count` numbers. */
export function checkLengths(options, names, count, what) {
    for (const name of names)
        if (options[name] && options[name].length < count)
            throw new TypeError(`${name} has ${options[name].length} numbers, and ${count} ${what} need as many.`);
}
