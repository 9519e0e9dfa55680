/* address.js: the room and its state, as the part of the address behind #: #draw?scene=house&turn=30
 *
 * Only what differs from the defaults of the room is in the address, and a value has the type of its default. */

export function readAddress(hash = location.hash) {
    const [room, query = ""] = hash.replace(/^#/, "").split("?");
    return { room, query };
}

/** The defaults with what the query changes; what it does not know or cannot read, it leaves. */
export function readState(query, defaults) {
    const state = { ...defaults };
    for (const [name, text] of new URLSearchParams(query)) {
        if (!Object.hasOwn(defaults, name)) continue;
        const value = parse(text, typeof defaults[name]);
        if (value !== undefined) state[name] = value;
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
