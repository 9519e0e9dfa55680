/* move.js: the room Move */
import { group } from "../controls.js";
import { h } from "../dom.js";

export const title = "Move";
export const lead = "A partition that follows what moves.";
export const defaults = { scene: "plan" };

export async function enter(host) {
    host.stage.prepend(h("p", { class: "lone" }, lead));
    host.panel.append(group("Move", h("p", {}, lead)));
    return {
        change() {},
        files() {},
        leave() {},
    };
}
