/* groups.js: what objects of a scene or of a motion may share */
import { among, given, text, whole } from "./given.js";

const GROUP = 20; // bytes of froe_group

/** Adds a group by a function, and gives its number. */
export function addGroup(core, name, address, group) {
    const { colour, ...texts } = given(group, { name: "", material: "", left: "", right: "", colour: 0 });
    return core.within((arena) => {
        const fields = ["name", "material", "left", "right"].map((field) => arena.text(text(texts[field], field)));
        return core.made(name, address, arena.array(Uint32Array.of(...fields, whole(colour, "colour"))));
    });
}
/** Group `i`, by a function that returns it. */
export function groupOf(core, name, address, i, count) {
    among(i, count, "group");
    return core.within((arena) => {
        const out = arena.room(GROUP);
        core.get(name, out, address, i);
        const [label, material, left, right, colour] = core.copy(Uint32Array, out, 5);
        return { name: core.string(label) ?? "", material: core.string(material) ?? "", left: core.string(left) ?? "",
            right: core.string(right) ?? "", colour };
    });
}
