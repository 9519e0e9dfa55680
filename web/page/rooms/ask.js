/* ask.js: the room Ask */
import { group } from "../controls.js";
import { h } from "../dom.js";

export const title = "Ask";
export const lead = "What a window, a ball, a ray or a point meets.";
export const defaults = { scene: "plan" };

export async function enter(host) {
    host.stage.prepend(h("p", { class: "lone" }, lead));
    host.panel.append(group("Ask", h("p", {}, lead)));
    return {
        change() {},
        files() {},
        leave() {},
    };
}
