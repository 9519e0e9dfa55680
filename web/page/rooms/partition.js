/* partition.js: the room Partition */
import { group } from "../controls.js";
import { h } from "../dom.js";

export const title = "Partition";
export const lead = "How a map or a model is cut into cells.";
export const defaults = { scene: "plan" };

export async function enter(host) {
    host.stage.prepend(h("p", { class: "lone" }, lead));
    host.panel.append(group("Partition", h("p", {}, lead)));
    return {
        change() {},
        files() {},
        leave() {},
    };
}
