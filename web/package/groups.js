/* groups.js: what objects of a scene or of a motion may share */
const GROUP = 20; // bytes of froe_group

/** Adds a group by a function, and gives its number. */
export function addGroup(core, name, address, { colour = 0, ...texts }) {
    return core.within((arena) => {
        const fields = ["name", "material", "left", "right"].map((field) => arena.text(String(texts[field] ?? "")));
        return core.made(name, address, arena.array(Uint32Array.of(...fields, colour)));
    });
}
/** Group `i`, by a function that returns it. */
export function groupOf(core, name, address, i) {
    return core.within((arena) => {
        const out = arena.room(GROUP);
        core.get(name, out, address, i);
        const [label, material, left, right, colour] = core.copy(Uint32Array, out, 5);
        return { name: core.string(label) ?? "", material: core.string(material) ?? "", left: core.string(left) ?? "",
            right: core.string(right) ?? "", colour };
    });
}
