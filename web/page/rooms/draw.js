/* draw.js: the room Draw: a model, turned; its exact drawing, as soon as it rests */
import { between, oneOf } from "../address.js";
import { button, Controls, group, opener, workOf } from "../controls.js";
import { count, counted, h, save, size } from "../dom.js";
import { Artist } from "../draw/artist.js";
import { zoomOf } from "../draw/camera.js";
import { cameraOfState, commandOf, optionsOf, planeOf } from "../draw/options.js";
import { PAPERS, pageOf, SCALES, UNITS } from "../draw/papers.js";
import { Preview } from "../draw/preview.js";
import { turnable } from "../draw/turn.js";
import { mainFirst, MODEL_FILES, openFiles } from "../open.js";
import { MODELS, sampleSource } from "../samples.js";
import { isCancelled } from "../link.js";

export const title = "Draw";
export const lead = "an exact vector drawing of a model.";
export const defaults = {
    scene: "house", turn: 31, tilt: 19, zoom: 0, x: 0, y: 0, up: "file", parallel: false, fov: 35,
    shading: "flat", colours: "file", lines: "all", width: 1, hidden: false, crease: 30,
    section: "none", at: 0.5, flip: false, paper: "wide", scale: "fit", unit: 1,
};

const SHADINGS = [["flat", "Light"], ["cel", "Light in four steps"], ["plain", "Colours alone"], ["white", "White"], ["none", "None: lines alone"]];
const LINES = [["all", "Outlines and creases"], ["outlines", "Outlines"], ["mesh", "All edges"], ["none", "None"]];
const names = (options) => oneOf(options.map(([name]) => name));
export const allowed = {
    scene: oneOf([...Object.keys(MODELS), "file"]), turn: between(-180, 180), tilt: between(-90, 90), zoom: between(0, 200), x: between(-1000, 1000), y: between(-1000, 1000),
    up: oneOf(["file", "x", "y", "z"]), fov: between(10, 100), shading: names(SHADINGS), colours: oneOf(["file", "own"]), lines: names(LINES),
    width: between(0.25, 4), crease: between(5, 90), section: oneOf(["none", "x", "y", "z"]), at: between(0, 1),
    paper: oneOf(Object.keys(PAPERS)), scale: oneOf(["fit", ...SCALES.map(String)]), unit: names(UNITS),
};

const RESTS = 250;            // milliseconds without a turn, after which the drawing is made
const LARGE = 300000;         // triangles from which on the page asks before it builds
const QUICK_ENOUGH = 60000;   // triangles up to which the better tree is built unasked
const VIEWS = { Corner: [31, 19], Front: [0, 0], Right: [90, 0], Back: [180, 0], Left: [-90, 0], Top: [0, 90], Bottom: [0, -90] };

export async function enter(host) {
    const room = new DrawRoom(host);
    room.load();
    return room;
}

class DrawRoom {
    #host;
    #artist = new Artist({
        scene: (model) => this.#showModel(model),
        tree: (report, best) => this.#showTree(report, best),
        progress: (what, share) => this.#showProgress(what, share),
        picture: (picture, options, time) => this.#showPicture(picture, options, time),
        failed: (error) => this.#fail(error),
        rest: () => this.#rest(),
    });
    #model = null;
    #tree = null;
    #picture = null;
    #asked = null;      // options of the picture of the view as it is
    #file = "model";
    #own = false;       // is it a file that was dropped?
    #frame = 0;
    #timer = 0;
    #saves = [];        // buttons of what there is once something is drawn
    #preview = null;
    #stopTurning;
    #resized;
    #controls;
    #parts = {};

    constructor(host) {
        this.#host = host;
        this.#furnish();
        try {
            this.#preview = new Preview(this.#parts.canvas);
        } catch (error) {
            console.warn(error); // a browser without WebGL shows nothing while the model turns, and the drawing after it
        }
        this.#stopTurning = turnable(this.#parts.canvas, () => host.state, (patch) => host.set(patch),
            () => (this.#model ? zoomOf(cameraOfState(host.state, this.#model), host.state, this.#model, pageOf(host.state.paper)) : 1));
        this.#resized = new ResizeObserver(() => this.#layOut());
        this.#resized.observe(this.#parts.desk);
    }

    /* -- furniture ------------------------------------------------------------ */

    #furnish() {
        const { stage, foot, panel } = this.#host, p = this.#parts;
        p.canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "The model. Arrow keys turn it, plus and minus zoom, 0 fits it to the page." });
        p.drawing = h("img", { class: "drawing", alt: "" });
        p.sheet = h("div", { class: "sheet" }, p.canvas, p.drawing);
        ({ box: p.work, what: p.what, bar: p.bar } = workOf("", () => this.cancel()));
        p.desk = h("div", { class: "desk" }, p.sheet);
        stage.prepend(p.desk);
        foot.append(p.work);
        this.#controls = new Controls(this.#host);
        panel.append(...this.#settings(this.#controls));
    }
    #settings(c) {
        const p = this.#parts, { set } = this.#host, percent = (x) => `${Math.round(100 * x)} %`;
        p.credit = h("p", { class: "soft" });
        p.opener = opener("Open a file …", MODEL_FILES, (files) => this.#host.take(files));
        p.section = h("div", { class: "stack" }, c.slider("at", "Where", { min: 0, max: 1, step: 0.01, show: percent }), c.toggle("flip", "Keep the other side"));
        p.fov = c.slider("fov", "Angle of view", { min: 10, max: 100, show: (x) => `${x}°` });
        p.scale = h("div", { class: "stack" }, c.choice("scale", "Scale", [["fit", "As fits"], ...SCALES.map((s) => [String(s), `1 : ${s}`])]),
            c.switch("unit", "The model is in", UNITS));
        p.command = h("code", {});
        const saver = (label, format, more) => {
            this.#saves.push(button(label, () => this.#download(format), { disabled: true, ...more }));
            return this.#saves.at(-1);
        };
        p.downloads = h("div", { class: "buttons three" }, ["SVG", "PDF", "PNG"].map((format) =>
            saver(format, format.toLowerCase(), { "aria-label": `Save as ${format}` })));
        return [
            group("Model",
                c.choice("scene", "Sample", [...Object.entries(MODELS).map(([id, { title }]) => [id, title]), ["file", "Own file"]]),
                p.opener, p.credit),
            group("View",
                h("p", { class: "soft" }, "Drag the model to turn it, or use the arrow keys. The wheel zooms after a click."),
                h("div", { class: "buttons" }, Object.entries(VIEWS).map(([name, [turn, tilt]]) =>
                    button(name, () => set({ turn, tilt, zoom: 0, x: 0, y: 0 }))), button("Fit", () => set({ zoom: 0, x: 0, y: 0 }))),
                c.switch("parallel", "Projection", [[false, "Perspective"], [true, "Parallel"]]), p.fov,
                c.switch("up", "Points up", [["file", "As the file says"], ["x", "x"], ["y", "y"], ["z", "z"]])),
            group("Faces",
                c.choice("shading", "Shading", SHADINGS),
                c.switch("colours", "Colours", [["file", "Of the file"], ["own", "froe's"]])),
            group("Lines",
                c.choice("lines", "Kinds", LINES),
                c.slider("width", "Width", { min: 0.25, max: 4, step: 0.25, show: (x) => `${x}` }),
                c.slider("crease", "Creases from", { min: 5, max: 90, step: 5, show: (x) => `${x}°` }),
                c.toggle("hidden", "Hidden lines, dashed")),
            group("Section",
                c.switch("section", "Across", [["none", "None"], ["x", "x"], ["y", "y"], ["z", "z"]]), p.section),
            group("Paper",
                c.choice("paper", "Size", Object.entries(PAPERS).map(([id, { title }]) => [id, title])), p.scale),
            group("Take away", p.downloads,
                h("div", { class: "buttons two" }, saver("Turning SVG", "turning"), saver("Saved tree", "froe")),
                h("details", {}, h("summary", {}, "The same from a terminal"), h("p", { class: "soft" }, "With the saved tree, this line draws the same bytes."), p.command)),
        ];
    }

    /* -- scenes --------------------------------------------------------------- */

    /** Loads the sample that the state names. */
    async load() {
        const { state } = this.#host;
        if (!MODELS[state.scene]) {
            state.scene = defaults.scene; // the address is that of a file of somewhere else
            this.#host.write();
        }
        const sample = MODELS[state.scene];
        this.#parts.credit.textContent = `${sample.title}: ${sample.credit}.`;
        this.#file = state.scene;
        this.#own = false;
        await this.#open(() => sampleSource(sample), sample.title);
    }
    /** Opens files that were dropped or chosen. */
    async files(given) {
        const files = mainFirst(given), { name } = files[0];
        this.#own = true;
        this.#host.set({ scene: "file", zoom: 0, x: 0, y: 0, section: "none" });
        this.#parts.credit.textContent = `${name} stays in this browser; nothing is sent.`;
        this.#file = name.replace(/\.\w+$/, "");
        await this.#open(() => openFiles(files), this.#file);
    }
    async #open(source, title) {
        this.#showProgress("Reading", 0);
        this.#hideDrawing();
        this.#parts.canvas.style.opacity = 0;
        this.#model = null; // nothing of the scene before is drawn or saved any more
        this.#keep(null);
        this.#title = title;
        this.#source = source;
        try {
            await this.#artist.open(source, (objects) => this.#allow(objects));
        } catch (error) {
            if (!isCancelled(error)) this.#fail(error);
        }
    }
    #title = "";
    #source = null;

    /* What building takes is told before it is begun. */
    #allow(objects) {
        if (objects < LARGE) return true;
        this.#parts.work.hidden = true;
        return new Promise((answer) => {
            const seconds = Math.round(objects * 1e-4), memory = size(objects * 1000);
            this.#host.say(h("span", {}, `${count(objects)} objects: the first drawing takes about ${seconds} seconds and ${memory} of memory.`),
                button("Draw it", () => { this.#host.say(); answer(true); }), button("Leave it", () => { this.#host.say("Not drawn."); answer(false); }));
        });
    }

    /** Ends what goes on beside the drawing; where nothing does, everything. */
    cancel() {
        if (this.#artist.stay()) return;
        this.#artist.close();
        this.#keep(null);
        this.#rest();
        this.#host.say(h("span", {}, "Cancelled."), button("Draw again", () => this.#open(this.#source, this.#title)));
    }

    /* -- what the artist tells -------------------------------------------------- */

    #showModel(model) {
        this.#model = { ...model, title: this.#title };
        this.#parts.canvas.style.opacity = "";
        this.#preview?.show(this.#model);
        this.change([]);
    }
    #showTree(report, best) {
        this.#tree = report;
        if (!best) this.#ask();
    }
    #showPicture(picture, options, time) {
        this.#keep(picture);
        const p = this.#parts, url = URL.createObjectURL(new Blob([picture.bytes], { type: "image/svg+xml" }));
        const old = p.drawing.src;
        p.drawing.onload = () => {
            if (options === this.#asked) p.sheet.classList.add("drawn");
            if (old.startsWith("blob:")) URL.revokeObjectURL(old);
        };
        p.drawing.src = url;
        const contents = [[picture.shapes, "shape"], [picture.lines, "line"]].filter(([n]) => n).map(([n, what]) => counted(n, what));
        if (!contents.length) contents.push("Nothing is visible");
        p.drawing.alt = `${this.#title}: ${contents.join(" and ")}`;
        p.command.textContent = commandOf(options, this.#host.state, this.#model, this.#file);
        this.#host.say(h("span", {}, h("b", {}, "Exact. "), [...contents, size(picture.bytes.length)].join(", ")),
            h("span", { class: "soft" }, `${(time / 1000).toFixed(2)} s, from ${counted(this.#tree.fragments, "piece")} of ${counted(this.#tree.objects, "object")}`));
        if (this.#tree.objects <= QUICK_ENOUGH) this.#artist.improve().catch((error) => this.#fail(error));
    }
    #keep(picture) {
        this.#picture = picture;
        for (const button of this.#saves) button.disabled = !picture;
    }
    #showProgress(what, share) {
        const p = this.#parts;
        p.work.hidden = false;
        p.what.textContent = what;
        p.bar.value = share;
    }
    #rest() { this.#parts.work.hidden = this.#artist.resting; }
    #fail(error) {
        this.#parts.work.hidden = true;
        this.#host.fail(error);
    }

    /* -- the view ---------------------------------------------------------------- */

    change(changed) {
        this.#controls.update();
        const { state } = this.#host, p = this.#parts;
        p.section.hidden = state.section === "none";
        p.fov.hidden = state.parallel;
        p.scale.hidden = !(state.parallel && pageOf(state.paper).millimetres);
        if (changed.includes("scene") && state.scene === "file" && !this.#own) {
            this.#host.set({ scene: this.#file });
            p.opener.querySelector("input").click();
            return;
        }
        if (changed.includes("scene") && state.scene !== "file") {
            if (state.scene === this.#file && !this.#own) return;
            this.#host.set({ zoom: 0, x: 0, y: 0 });
            this.load();
            return;
        }
        this.#layOut();
        if (changed.every((name) => name === "scene")) { this.#ask(); return; }
        this.#hideDrawing();
        clearTimeout(this.#timer);
        this.#timer = setTimeout(() => { this.#timer = 0; this.#ask(); }, RESTS);
    }
    #ask() {
        if (!this.#model || this.#timer) return;
        this.#asked = optionsOf(this.#host.state, this.#model);
        this.#artist.draw(this.#asked);
    }
    #hideDrawing() {
        this.#asked = null;
        this.#parts.sheet.classList.remove("drawn");
    }

    /* The sheet fills the desk; the preview is drawn once a frame at most. */
    #layOut() {
        const { desk, sheet } = this.#parts, page = pageOf(this.#host.state.paper), style = getComputedStyle(desk);
        const room = [desk.clientWidth - 2 * parseFloat(style.paddingLeft), desk.clientHeight - 2 * parseFloat(style.paddingTop)];
        const scale = Math.max(0, Math.min(room[0] / page.width, room[1] / page.height));
        const width = Math.floor(page.width * scale), height = Math.floor(page.height * scale);
        sheet.style.width = `${width}px`;
        sheet.style.height = `${height}px`;
        if (!this.#model || this.#frame || !width) return;
        this.#frame = requestAnimationFrame(() => {
            this.#frame = 0;
            if (!this.#model) return; // of the scene before
            const { state } = this.#host;
            this.#preview?.style({ shading: state.shading, ownColours: state.colours === "own", lines: state.lines !== "none", section: planeOf(state, this.#model) });
            this.#preview?.draw(cameraOfState(state, this.#model), width, height, this.#model);
        });
    }

    /* -- files ------------------------------------------------------------------- */

    async #download(format) {
        const options = optionsOf(this.#host.state, this.#model), name = `${this.#file}.${format}`;
        try {
            if (format === "turning") {
                this.#showProgress("Drawing all around", 0);
                const turning = await this.#artist.turning(options);
                if (turning) save(`${this.#file}-turning.svg`, turning.bytes, TYPES.svg);
            } else if (format === "froe") save(name, await this.#artist.saved(), "application/octet-stream");
            else if (format === "png") save(name, await pixels(this.#picture, options), "image/png");
            else save(name, (await this.#artist.render({ ...options, format })).bytes, TYPES[format]);
        } catch (error) {
            if (!isCancelled(error)) this.#fail(error);
        }
    }

    leave() {
        cancelAnimationFrame(this.#frame);
        clearTimeout(this.#timer);
        this.#resized.disconnect();
        this.#stopTurning();
        this.#artist.close();
        this.#preview?.close();
        if (this.#parts.drawing.src.startsWith("blob:")) URL.revokeObjectURL(this.#parts.drawing.src);
    }
}

const TYPES = { svg: "image/svg+xml", pdf: "application/pdf" };
const FINE = 2, DOTS = 300 / 25.4; // pixels of a PNG for each pixel of the page, and for each millimetre

/* An SVG as pixels, on white. */
async function pixels({ bytes }, { width, height, millimetres }) {
    const scale = millimetres ? DOTS : FINE, image = new Image();
    const url = URL.createObjectURL(new Blob([bytes], { type: "image/svg+xml" }));
    image.src = url;
    try {
        await image.decode();
        const canvas = h("canvas", { width: Math.round(width * scale), height: Math.round(height * scale) }), paint = canvas.getContext("2d");
        paint.fillStyle = "#fff";
        paint.fillRect(0, 0, canvas.width, canvas.height);
        paint.drawImage(image, 0, 0, canvas.width, canvas.height);
        return await new Promise((accept, refuse) =>
            canvas.toBlob((blob) => (blob ? accept(blob) : refuse(new Error("The browser cannot make a picture of this size"))), "image/png"));
    } finally {
        URL.revokeObjectURL(url);
    }
}
