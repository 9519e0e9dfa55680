/* address.js: the room and its state, as the part of the address behind #: #draw?scene=house&turn=30
 *
 * Only what differs from the defaults of the room is in the address, and a value has the type of its default. */

export function readAddress(hash = location.hash) {
    const [room, query = ""] = hash.replace(/^#/, "").split("?");
    return { room, query };
}

/** What a member of a state may be: a number between two, a whole one, one of several. */
export const between = (min, max) => (value) => value >= min && value <= max;
export const whole = (min, max) => (value) => Number.isInteger(value) && value >= min && value <= max;
export const oneOf = (values) => (value) => values.includes(value);

/** The defaults with what the query changes; what is not known, cannot be read or is not allowed stays as usual.
 * `allowed` has a test for each member that is not just yes or no. */
export function readState(query, defaults, allowed) {
    const state = { ...defaults };
    for (const [name, text] of new URLSearchParams(query)) {
        if (!Object.hasOwn(defaults, name)) continue;
        const value = parse(text, typeof defaults[name]);
        if (value !== undefined && (allowed[name]?.(value) ?? true)) state[name] = value;
    }
    return state;
}
function parse(text, type) {
    if (type === "boolean") return text === "yes" ? true : text === "no" ? false : undefined;
    if (type !== "number") return text;
    const number = Number(text);
    return text.trim() && Number.isFinite(number) ? number : undefined;
}

export function writeState(room, state, defaults) {
    const query = Object.keys(defaults).filter((name) => state[name] !== defaults[name])
        .map((name) => `${name}=${encodeURIComponent(print(state[name])).replaceAll("%2C", ",")}`);
    return `#${room}${query.length ? `?${query.join("&")}` : ""}`;
}
const print = (value) => (typeof value === "boolean" ? (value ? "yes" : "no") : String(value));
