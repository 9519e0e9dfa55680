/* partition.js: the room Partition: how a map or a model is cut, cut by cut, by one method or by two side by side */
import { oneOf, whole } from "../address.js";
import { VIEW, VIEWS, WHOLE } from "../chart.js";
import { button, Controls, group, workOf } from "../controls.js";
import { count, counted, factsOf, h } from "../dom.js";
import { MAP_FILES, MODEL_FILES, openFiles } from "../open.js";
import { Pane } from "../partition/pane.js";
import { MAPS, MODELS, sampleSource } from "../samples.js";
import { Scenes } from "../scenes.js";

export const title = "Partition";
export const lead = "how a map or a model is cut into cells.";
export const defaults = { scene: "plan", method: "auto", second: "none", leaf: 0, step: -1, ...VIEW };

const MOST = 60000; // objects whose partition the page shows
const PACE = 250;   // milliseconds for a cut while it plays
const SAMPLES = { ...MAPS, ...MODELS };
const METHODS = [["auto", "As froe chooses"], ["grain", "grain: fewest pieces"], ["density", "density: linear size"], ["index", "index: for queries"],
    ["autopartition", "autopartition: along objects"], ["cylindrical", "cylindrical: walls"], ["paterson_yao", "paterson_yao: slabs"],
    ["kd", "kd: by medians"], ["quad", "quad: by halves"], ["grid", "grid"]];

export const allowed = {
    scene: oneOf([...Object.keys(SAMPLES), "file"]), method: oneOf(METHODS.map(([id]) => id)), second: oneOf(["none", ...METHODS.map(([id]) => id)]),
    leaf: whole(0, 16), step: whole(-1, 1e9), ...VIEWS,
};

export async function enter(host) {
    const room = new PartitionRoom(host);
    room.scenes.load();
    return room;
}

class PartitionRoom {
    scenes;
    #host;
    #controls;
    #parts = {};
    #panes = [];
    #source = null;
    #age = 0;           // counts scenes: what belongs to an older one is dropped
    #playing = 0;
    #dark = matchMedia("(prefers-color-scheme: dark)");
    #redraw = () => { for (const pane of this.#panes) pane.chart.draw(); };

    constructor(host) {
        this.#host = host;
        this.scenes = new Scenes(host, { samples: SAMPLES, sampleSource, openFiles, usual: defaults.scene,
            show: (read) => this.#open(read), fresh: { ...WHOLE, step: -1 } });
        const p = this.#parts;
        ({ box: p.work, bar: p.bar } = workOf("Building", () => this.cancel()));
        p.panes = h("div", { class: "panes" });
        host.stage.prepend(p.panes, p.work);
        this.#controls = new Controls(host);
        host.panel.append(...this.#settings(this.#controls));
        this.#dark.addEventListener("change", this.#redraw);
    }
    #settings(c) {
        const p = this.#parts;
        p.steps = h("input", { type: "range", min: 0, step: 1, oninput: () => this.#host.set({ step: Number(p.steps.value) }) });
        p.told = h("output", {});
        p.play = button("Play", () => this.#play());
        p.number = h("input", { type: "number", min: 0, step: 1, placeholder: "number", oninput: () => this.#pick(p.number.value === "" ? -1 : Number(p.number.value)) });
        p.about = h("dl", { class: "facts" });
        return [
            this.scenes.group(c, "Scene", "Map or model", `${MAP_FILES},${MODEL_FILES}`),
            group("Method", c.choice("method", "Method", METHODS), c.choice("second", "Beside it", [["none", "None"], ...METHODS]),
                c.slider("leaf", "Objects in a leaf", { min: 0, max: 16, show: (n) => (n ? `up to ${n}` : "as usual") })),
            group("Cuts",
                h("label", { class: "field" }, h("span", {}, "Cuts made", p.told), p.steps),
                h("div", { class: "buttons" },
                    button("None", () => this.#host.set({ step: 0 })), button("Back", () => this.#by(-1), { "aria-label": "One cut back" }),
                    button("Next", () => this.#by(1), { "aria-label": "One cut on" }), button("All", () => this.#host.set({ step: -1 })),
                    button("− level", () => this.#byLevel(-1), { "aria-label": "One level back" }), button("+ level", () => this.#byLevel(1), { "aria-label": "One level on" }), p.play),
                h("p", { class: "soft" }, "Cuts come by their depth. Where the picture has the focus, the keys [ and ] step.")),
            group("Piece", h("label", { class: "field" }, h("span", {}, "Point at a piece, or give its number"), p.number), p.about),
        ];
    }

    /* -- scenes -------------------------------------------------------------------- */

    files(files) { this.scenes.take(files); }
    async #open(source) {
        this.#end();
        const age = this.#age, p = this.#parts;
        this.#host.say();
        p.bar.value = 0;
        p.work.hidden = false;
        try {
            const read = await source();
            if (age !== this.#age) return;
            this.#source = read;
            this.#furnishPanes();
            for (const pane of this.#panes) this.#build(pane);
        } catch (error) {
            if (age !== this.#age) return;
            p.work.hidden = true;
            this.#host.fail(error);
        }
    }
    /* Ends what is read and built. Nothing of it is shown any more. */
    #end() {
        this.#halt();
        this.#age++;
        this.#source = null;
        this.#building.clear();
        for (const pane of this.#panes) {
            pane.clear();
            pane.caption.replaceChildren();
        }
        this.#parts.about.replaceChildren();
    }

    /* As many pictures as methods. */
    #furnishPanes() {
        const { state } = this.#host, methods = [state.method, ...(state.second === "none" ? [] : [state.second])];
        while (this.#panes.length > methods.length) {
            const pane = this.#panes.pop();
            pane.close();
            pane.frame.remove();
        }
        while (this.#panes.length < methods.length) this.#addPane();
        this.#panes.forEach((pane, i) => { pane.method = methods[i]; });
    }
    #addPane() {
        const canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "The partition. Arrow keys move it, plus and minus zoom, 0 fits it, [ and ] step through the cuts." });
        const caption = h("figcaption", {});
        const pane = new Pane(canvas, {
            state: () => this.#host.state, change: (patch) => this.#host.set(patch), key: (event) => this.#key(event),
            progress: (it, share) => { if (this.#building.has(it)) this.#parts.bar.value = share; },
            built: (it) => this.#built(it), failed: (it, error) => this.#failed(it, error),
            hover: (it, piece) => this.#tellPiece(it, piece),
        });
        pane.frame = h("figure", { class: "pane" }, canvas, caption);
        pane.caption = caption;
        pane.step = this.#host.state.step;
        this.#parts.panes.append(pane.frame);
        this.#panes.push(pane);
    }

    #building = new Set();
    #build(pane) {
        const { leaf } = this.#host.state;
        this.#building.add(pane);
        this.#parts.bar.value = 0;
        this.#parts.work.hidden = false;
        pane.build(this.#source, { method: pane.method, leaf }, MOST);
    }
    #built(pane) {
        const r = pane.report;
        pane.caption.replaceChildren(h("strong", {}, r.method), ` ${counted(r.fragments, "piece")} of ${counted(r.objects, "object")}, ${counted(r.leaves, "cell")}, depth ${r.height}`);
        this.#done(pane);
        this.#tell();
        this.#tellPiece(pane, -1);
    }
    #failed(pane, error) {
        this.#done(pane);
        this.#host.fail(error);
    }
    #done(pane) {
        this.#building.delete(pane);
        this.#parts.work.hidden = this.#building.size === 0;
    }
    cancel() {
        this.#end();
        this.#parts.work.hidden = true;
        this.#host.say(h("span", {}, "Cancelled."), button("Build again", () => this.scenes.again()));
    }

    /* -- steps --------------------------------------------------------------------- */

    get #most() { return Math.max(0, ...this.#panes.map((pane) => pane.cutCount)); }
    get #step() { return this.#host.state.step < 0 ? this.#most : Math.min(this.#host.state.step, this.#most); }
    #by(steps) { this.#host.set({ step: Math.min(this.#most, Math.max(0, this.#step + steps)) }); }
    #byLevel(levels) {
        const pane = this.#panes.reduce((a, b) => (b.cutCount > a.cutCount ? b : a));
        if (!pane.cutCount) return;
        const { depth } = pane, whole = pane.stepsTo(depth) === this.#step;
        this.#host.set({ step: pane.stepsTo(levels > 0 ? depth + (whole ? 1 : 0) : depth - 1) });
    }
    #key(event) {
        const by = { "[": -1, "]": 1 }[event.key];
        if (by) this.#by(by);
        return by !== undefined;
    }
    #play() {
        if (this.#playing) return this.#halt();
        if (this.#step === this.#most) this.#host.set({ step: 0 });
        this.#parts.play.textContent = "Pause";
        this.#playing = setInterval(() => {
            this.#by(Math.max(1, Math.round(this.#most / 400)));
            if (this.#step === this.#most) this.#halt();
        }, PACE);
        return undefined;
    }
    #halt() {
        clearInterval(this.#playing);
        this.#playing = 0;
        this.#parts.play.textContent = "Play";
    }
    #tell() {
        const p = this.#parts, step = this.#step, depth = Math.max(0, ...this.#panes.map((pane) => (pane.report ? pane.depth : 0)));
        p.steps.max = this.#most;
        p.steps.value = step;
        p.told.value = `${count(step)} of ${count(this.#most)}, to depth ${depth}`;
        p.steps.setAttribute("aria-valuetext", p.told.value);
        if (this.#panes.some((pane) => pane.report)) this.#host.say(...this.#panes.filter((pane) => pane.report).map((pane) =>
            h("span", {}, `${pane.report.method}: ${(pane.report.fragments / pane.report.objects).toFixed(2)} pieces for each object`)));
    }

    /* -- pieces --------------------------------------------------------------------- */

    #pick(piece) {
        const pane = this.#panes[0];
        if (pane?.report && Number.isInteger(piece) && piece < pane.pieceCount) pane.hover(piece);
    }
    #tellPiece(pane, piece) {
        const p = this.#parts;
        if (document.activeElement !== p.number) p.number.value = piece < 0 ? "" : piece;
        p.number.max = Math.max(0, pane.pieceCount - 1);
        if (piece < 0) return p.about.replaceChildren();
        const it = pane.about(piece);
        const facts = [["Object", it.name ? `${it.object}, of ${it.name}` : String(it.object)],
            ["Part", it.whole ? "the whole object" : `one of ${it.siblings} pieces`],
            ["Lies", it.inCut ? `in cut ${count(it.cut)}, at depth ${it.depth}` : `in a cell at depth ${it.depth}`],
            ["List", `${counted(it.list, "piece")} at node ${count(it.node)}`]];
        return p.about.replaceChildren(...factsOf(facts));
    }

    /* -- what the state says ---------------------------------------------------------- */

    change(changed) {
        this.#controls.update();
        if (changed.includes("scene")) return this.scenes.load();
        if (this.#source && changed.some((name) => ["method", "second", "leaf"].includes(name))) {
            const before = this.#panes.map((pane) => pane.method);
            this.#furnishPanes();
            this.#panes.forEach((pane, i) => { if (changed.includes("leaf") || pane.method !== before[i]) this.#build(pane); });
        }
        for (const pane of this.#panes) pane.step = this.#host.state.step;
        if (changed.includes("step")) this.#tell();
        return undefined;
    }
    leave() {
        this.#end();
        this.#dark.removeEventListener("change", this.#redraw);
        for (const pane of this.#panes) pane.close();
    }
}
