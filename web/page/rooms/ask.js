/* ask.js: the room Ask: a window, a ball, a ray or a point under the pointer, and what it meets */
import { between, oneOf, whole } from "../address.js";
import { answer, answerAll, box, KINDS, many } from "../ask/questions.js";
import { peer } from "../ask/peers.js";
import { Chart, colours, nearness, trace, VIEW, VIEWS, WHOLE } from "../chart.js";
import { button, Controls, group, workOf } from "../controls.js";
import { count, counted, factsOf, h } from "../dom.js";
import { isCancelled, startFroe } from "../link.js";
import { groupsOf, MAP_FILES, MODEL_FILES, NAMED, openFiles, sceneFrom } from "../open.js";
import { outlines } from "../outlines.js";
import { MAPS, MODELS, sampleSource } from "../samples.js";
import { Scenes } from "../scenes.js";

export const title = "Ask";
export const lead = "what a window, a ball, a ray or a point meets.";
export const defaults = { scene: "rooms", kind: "window", size: 0.15, k: 5, px: 0.5, py: 0.5, ox: 0.2, oy: 0.8, ...VIEW };

const SAMPLES = { ...MAPS, ...MODELS };
export const allowed = {
    scene: oneOf([...Object.keys(SAMPLES), "file"]), kind: oneOf(Object.keys(KINDS)), size: between(0.005, 0.6), k: whole(1, 50),
    px: between(0, 1), py: between(0, 1), ox: between(0, 1), oy: between(0, 1), ...VIEWS,
};

const MOST = 300000;     // objects that the page draws at each move of the pointer
const MEASURED = 10000;  // questions by which the time of one is found
const LISTED = 12;       // answers that are named

export async function enter(host) {
    const room = new AskRoom(host);
    room.scenes.load();
    return room;
}

class AskRoom {
    scenes;
    #host;
    #controls;
    #chart;
    #parts = {};
    #worker = null;
    #tree = null;
    #scene = null;     // bounds, up, shapes and groups
    #answered = null;  // { question, ids, values, statistics }
    #asking = false;
    #late = false;     // was there a question meanwhile?
    #age = 0;
    #dark = matchMedia("(prefers-color-scheme: dark)");
    #redraw = () => this.#chart.draw();

    constructor(host) {
        this.#host = host;
        this.scenes = new Scenes(host, { samples: SAMPLES, sampleSource, openFiles, usual: defaults.scene,
            show: (read) => this.#open(read), fresh: WHOLE });
        const p = this.#parts;
        p.canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "The scene. The pointer or the arrow keys move the question, arrows with shift the scene; plus and minus zoom, 0 fits." });
        ({ box: p.work, bar: p.bar } = workOf("Building", () => this.cancel()));
        host.stage.prepend(h("div", { class: "map" }, p.canvas), p.work);
        this.#chart = new Chart(p.canvas, {
            view: () => host.state, change: (patch) => host.set(patch), paint: (context) => this.#paint(context),
            point: (_, at) => this.#probe(at), drag: (event, from, at) => this.#drag(event, from, at), key: (event) => this.#key(event),
        });
        this.#controls = new Controls(host);
        host.panel.append(...this.#settings(this.#controls));
        this.#dark.addEventListener("change", this.#redraw);
        this.#showSettings();
    }
    #settings(c) {
        const p = this.#parts;
        p.size = c.slider("size", "Size, of the whole", { min: 0.005, max: 0.6, step: 0.005, show: (x) => `${(100 * x).toFixed(1)} %` });
        p.k = c.slider("k", "How many", { min: 1, max: 50 });
        p.hint = h("p", { class: "soft" }, "A click sets where the ray begins.");
        p.facts = h("dl", { class: "facts" });
        p.list = h("ol", { class: "found" });
        p.times = h("div", { class: "stack" });
        return [
            this.scenes.group(c, "Scene", "Map or model", `${MAP_FILES},${MODEL_FILES}`),
            group("Question", c.switch("kind", "Kind", Object.entries(KINDS).map(([id, { title }]) => [id, title])), p.size, p.k,
                h("p", { class: "soft" }, "Move the pointer over the picture, or use the arrow keys."), p.hint),
            group("Answer", p.facts, p.list),
            group("Time", button("Measure, beside programs of npm", () => this.measure()), p.times),
        ];
    }

    /* -- scenes ---------------------------------------------------------------------- */

    files(files) { this.scenes.take(files); }
    async #open(source) {
        this.#end();
        const age = this.#age, p = this.#parts;
        this.#host.say();
        p.work.hidden = false;
        p.bar.value = 0;
        try {
            const read = await source();
            if (age !== this.#age) return undefined;
            const worker = await startFroe((share) => { if (age === this.#age) p.bar.value = share; });
            if (age !== this.#age) return worker.end();
            this.#worker = worker;
            const scene = await sceneFrom(worker.froe, read), objects = await scene.objectCount(), bounds = await scene.bounds();
            if (!bounds) throw new Error("There are no objects in this scene");
            if (objects > MOST)
                throw new Error(`This scene has ${count(objects)} objects, and the page asks scenes of at most ${count(MOST)}: the program froe asks any`);
            const began = performance.now(), tree = await scene.build({ purpose: "query" }), took = performance.now() - began;
            const dim = await scene.dim(), [shapes, groups, up] = await Promise.all([scene.arrays(), groupsOf(scene, NAMED), dim === 3 ? scene.up() : 2]);
            if (age !== this.#age) return undefined;
            Object.assign(shapes, outlines(shapes));
            this.#tree = tree;
            this.#scene = { dim, objects, bounds, up, shapes, groups, took, method: (await tree.report()).method };
            this.#chart.fit(bounds, up);
            this.#tellScene();
            this.#showSettings();
            this.#ask();
        } catch (error) {
            if (age === this.#age && !isCancelled(error)) this.#host.fail(error);
        } finally {
            if (age === this.#age) p.work.hidden = true;
        }
        return undefined;
    }
    #tellScene() {
        const s = this.#scene;
        this.#host.say(`${counted(s.objects, "object")}; the tree, by ${s.method}, was built in ${s.took.toFixed(0)} ms`);
    }
    #end() {
        this.#age++;
        this.#worker?.end();
        this.#worker = this.#tree = this.#scene = this.#answered = null;
        this.#asking = this.#late = false;
        const { facts, list, times } = this.#parts;
        for (const part of [facts, list, times]) part.replaceChildren();
        delete facts.dataset.asked;
        delete facts.dataset.found;
        this.#chart.draw();
    }
    cancel() {
        this.#end();
        this.#parts.work.hidden = true;
        this.#host.say(h("span", {}, "Cancelled."), button("Build again", () => this.scenes.again()));
    }

    /* -- questions ------------------------------------------------------------------- */

    #probe([x, y]) {
        const { width, height } = this.#chart;
        this.#host.set({ px: round(x / width), py: round(y / height) });
    }
    /* A click in the plane is where rays begin. With shift or another button the picture moves. */
    #drag(event, from, at) {
        if (this.#scene?.dim !== 2 || event.shiftKey) return false;
        if (event.pointerType === "touch" || event.type === "pointermove") this.#probe(at);
        if (event.type === "pointerdown" && this.#host.state.kind === "ray")
            this.#host.set({ ox: round(at[0] / this.#chart.width), oy: round(at[1] / this.#chart.height) });
        return true;
    }
    #key(event) {
        const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
        if (!step || event.shiftKey) return false;
        const { px, py } = this.#host.state;
        this.#host.set({ px: round(clamp(px + 0.02 * step[0])), py: round(clamp(py + 0.02 * step[1])) });
        return true;
    }
    get #pixel() { return [this.#host.state.px * this.#chart.width, this.#host.state.py * this.#chart.height]; }
    #length() {
        const { lo, hi } = this.#scene.bounds;
        return 2 * this.#host.state.size * Math.max(...lo.map((low, i) => hi[i] / 2 - low / 2)); // the whole may be no double
    }

    /* The question that the state puts. In space all but rays stand where the ray under the pointer meets the scene. */
    async #question() {
        const { state } = this.#host, { kind, k } = state, size = this.#length();
        if (this.#scene.dim === 2) {
            const at = this.#chart.unproject(this.#pixel), origin = this.#chart.unproject([state.ox * this.#chart.width, state.oy * this.#chart.height]);
            const direction = at.map((x, i) => x - origin[i]);
            return { kind, at, size, k, origin, direction: direction.some((x) => x) ? direction : [1, 0] };
        }
        const ray = this.#chart.rayAt(this.#pixel), hit = await this.#tree.ray(ray.origin, ray.direction);
        if (kind !== "ray" && hit.objects[0] === 0xffffffff) return null;
        return { kind, size, k, ...ray, at: kind === "ray" ? null : ray.origin.map((x, i) => x + hit.t[0] * ray.direction[i]) };
    }
    async #ask() {
        if (!this.#tree) return;
        if (this.#asking) {
            this.#late = true;
            return;
        }
        this.#asking = true;
        const age = this.#age;
        try {
            const question = await this.#question();
            if (question) {
                const [, found, statistics] = await Promise.all([this.#tree.statistics(), answer(this.#tree, question), this.#tree.statistics()]);
                if (age === this.#age) this.#answered = { question, ...found, statistics };
            } else if (age === this.#age) this.#answered = null;
            if (age === this.#age) this.#tell();
        } catch (error) {
            if (age === this.#age && !isCancelled(error)) this.#host.fail(error);
        } finally {
            if (age === this.#age) {
                this.#asking = false;
                this.#chart.draw();
                if (this.#late) {
                    this.#late = false;
                    this.#ask();
                }
            }
        }
    }
    #tell() {
        const p = this.#parts, it = this.#answered, kind = it?.question.kind;
        if (!it) {
            p.facts.replaceChildren(...factsOf([["Nothing", "is under the pointer"]]));
            p.list.replaceChildren();
            return;
        }
        const { nodes, leaves, tests, exact } = it.statistics;
        const facts = [["Objects", counted(it.ids.length, ...KINDS[kind].meets)], ["Visited", `${counted(nodes, "node")}, ${counted(leaves, "leaf", "leaves")}`],
            ["Tested", `${counted(tests, "object")}, ${count(exact)} by exact numbers`]];
        p.facts.replaceChildren(...factsOf(facts));
        const ids = [...it.ids.subarray(0, LISTED)], { groups, shapes } = this.#scene;
        const line = (id, i) => {
            const name = groups[shapes.groups[id]]?.name, value = it.values ? `, ${kind === "ray" ? "t" : "distance"} ${it.values[i].toPrecision(5)}` : "";
            return h("li", {}, `${id}${name ? `, of ${name}` : ""}${value}`);
        };
        p.facts.dataset.asked = JSON.stringify(it.question); // as froe was asked, with all digits
        p.facts.dataset.found = it.ids.join(" ");
        p.list.replaceChildren(...ids.map(line), it.ids.length > LISTED ? h("li", { class: "soft" }, `and ${count(it.ids.length - LISTED)} more`) : "");
    }

    /* -- time -------------------------------------------------------------------------- */

    /** Asks many questions of the kind, at random places, of froe and of what npm has. */
    async measure() {
        if (!this.#tree) return;
        const { kind, k } = this.#host.state, { dim, bounds, shapes } = this.#scene, more = { size: this.#length(), k, dim }, p = this.#parts, age = this.#age;
        if (kind === "ball") return p.times.replaceChildren(h("p", { class: "soft" }, "No program of npm that is known here asks for balls; choose another kind."));
        p.times.replaceChildren(h("p", {}, "Measuring …"));
        try {
            const questions = many(bounds, MEASURED), name = KINDS[kind].peers[dim], rows = [];
            const time = async (work) => {
                const began = performance.now(), found = await work();
                return { each: (performance.now() - began) * 1000 / MEASURED, found };
            };
            await answerAll(this.#tree, kind, questions, more); // once before, as for the other
            rows.push(["froe", "objects, exactly", await time(() => answerAll(this.#tree, kind, questions, more))]);
            if (name) {
                const other = await peer(name, shapes);
                other.ask(kind, questions, more);
                rows.push([name, other.what, await time(() => other.ask(kind, questions, more))]);
            }
            if (age !== this.#age || kind !== this.#host.state.kind) return undefined;
            p.times.replaceChildren(h("table", {},
                h("thead", {}, h("tr", {}, ["", "µs a question", "answers"].map((text) => h("th", {}, text)))),
                h("tbody", {}, rows.map(([who, what, { each, found }]) =>
                    h("tr", {}, h("td", {}, h("strong", {}, who), h("br"), h("span", { class: "soft" }, what)), h("td", {}, each.toFixed(2)), h("td", {}, count(found)))))),
            h("p", { class: "soft" }, `${count(MEASURED)} questions at random places, on this machine, ${name ? "one program after the other" : "which no program of npm that is known here answers, too"}.`));
        } catch (error) {
            if (age === this.#age && !isCancelled(error)) p.times.replaceChildren(h("p", {}, `It could not be measured: ${error.message}`));
        }
        return undefined;
    }

    /* -- picture ----------------------------------------------------------------------- */

    #paint(context) {
        if (!this.#scene) return;
        const look = colours(), it = this.#answered, seen = this.#chart.still(context, look.ink, (layer) => this.#paintScene(layer, look));
        const first = it?.question.kind === "ray" && it.ids.length ? it.ids[0] : -1;
        if (it) this.#paintFound(context, look, seen, [...it.ids], first);
        this.#paintQuestion(context, look);
    }
    #paintScene(context, look) {
        const { dim, shapes, objects } = this.#scene;
        const depths = dim === 3 ? new Float64Array(shapes.coords.length / 3) : null, points = this.#chart.project(shapes.coords, depths);
        const order = Uint32Array.from({ length: objects }, (_, i) => i), near = depths ? nearness(depths, shapes.starts, shapes.corners) : null;
        if (near) order.sort((a, b) => near[a] - near[b]);
        context.lineCap = context.lineJoin = "round";
        if (near) this.#paintFaces(context, points, order, () => look.faint, look.soft);
        else this.#paintLines(context, points, order, look.ink, 1);
        return { points, near };
    }
    /* What was found lies over the scene: it is seen where something is before it, too. */
    #paintFound(context, look, { points, near }, ids, first) {
        context.lineCap = context.lineJoin = "round";
        if (near) return this.#paintFaces(context, points, ids.sort((a, b) => near[a] - near[b]), (i) => (i === first ? look.hit : look.mark), look.card);
        this.#paintLines(context, points, ids.filter((i) => i !== first), look.mark, 3);
        if (first >= 0) this.#paintLines(context, points, [first], look.hit, 4);
        return undefined;
    }
    #paintLines(context, points, ids, colour, width) {
        context.beginPath();
        for (const i of ids) this.#trace(context, points, i);
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.stroke();
    }
    #paintFaces(context, points, ids, colourOf, edge) {
        context.strokeStyle = edge;
        context.lineWidth = 0.4;
        for (const i of ids) {
            context.beginPath();
            this.#trace(context, points, i);
            context.fillStyle = colourOf(i);
            context.fill();
            context.stroke();
        }
    }
    #trace(context, points, i) {
        const { starts, corners } = this.#scene.shapes, from = starts[i], to = starts[i + 1];
        if (to - from === 1) {
            const [x, y] = [points[2 * corners[from]], points[2 * corners[from] + 1]];
            context.moveTo(x + 2, y), context.arc(x, y, 2, 0, 7);
        } else for (let c = from; c < to; c++) context[c === from ? "moveTo" : "lineTo"](points[2 * corners[c]], points[2 * corners[c] + 1]);
        if (to - from > 2) context.closePath();
    }
    #paintQuestion(context, look) {
        const question = this.#answered?.question, [x, y] = this.#pixel;
        context.strokeStyle = look.hit;
        context.fillStyle = look.hit;
        context.lineWidth = 1.5;
        if (question?.kind === "ray" && this.#scene.dim === 2) {
            const [ox, oy, tx, ty] = this.#chart.project([...question.origin, ...question.origin.map((o, i) => o + question.direction[i])]);
            const beyond = 2 * (this.#chart.width + this.#chart.height) / (Math.hypot(tx - ox, ty - oy) || 1); // the edge of the picture
            trace(context, [ox, oy, ox + beyond * (tx - ox), oy + beyond * (ty - oy)], 0, 2);
            context.stroke();
            context.beginPath();
            context.arc(ox, oy, 4, 0, 7);
            context.fill();
            for (const t of this.#answered.values ?? []) {
                const [hx, hy] = this.#chart.project(question.origin.map((o, i) => o + t * question.direction[i]));
                context.beginPath();
                context.arc(hx, hy, 3, 0, 7);
                context.fill();
            }
        } else if (question?.kind === "window" || question?.kind === "ball") this.#paintRange(context, question);
        context.beginPath();
        context.arc(x, y, 3, 0, 7);
        context.fill();
    }
    #paintRange(context, { kind, at, size }) {
        const dim = this.#scene.dim;
        if (kind === "ball") {
            const [middle, side] = [this.#chart.project(at), this.#chart.project(at.map((x, i) => x + (i === 0 ? size / 2 : 0)))];
            const radius = dim === 2 ? side[0] - middle[0] : size / 2 * this.#pixelsPerUnit(at);
            context.beginPath();
            context.arc(middle[0], middle[1], radius, 0, 7);
        } else if (dim === 2) {
            const corners = this.#chart.project(box(at, size));
            context.beginPath();
            context.rect(corners[0], corners[1], corners[2] - corners[0], corners[3] - corners[1]);
        } else {
            context.beginPath();
            const corner = (bits) => this.#chart.project(at.map((x, i) => x + (bits >> i & 1 ? size / 2 : -size / 2)));
            for (let bits = 0; bits < 8; bits++)
                for (let i = 0; i < 3; i++) if (!(bits >> i & 1)) {
                    const [a, b] = [corner(bits), corner(bits | 1 << i)];
                    context.moveTo(a[0], a[1]), context.lineTo(b[0], b[1]);
                }
        }
        context.stroke();
        context.globalAlpha = 0.12;
        if (dim === 2 || kind === "ball") context.fill();
        context.globalAlpha = 1;
    }
    /* Views are without perspective: the largest of the three axes' lengths is not shortened by more than this. */
    #pixelsPerUnit(at) {
        const origin = this.#chart.project(at), sums = [0, 1, 2].map((i) => {
            const end = this.#chart.project(at.map((x, k) => x + (k === i ? 1 : 0)));
            return (end[0] - origin[0]) ** 2 + (end[1] - origin[1]) ** 2;
        });
        return Math.sqrt((sums[0] + sums[1] + sums[2]) / 2);
    }

    /* -- what the state says -------------------------------------------------------------- */

    change(changed) {
        this.#controls.update();
        this.#showSettings();
        if (changed.includes("scene")) return this.scenes.load();
        if (changed.includes("kind")) this.#parts.times.replaceChildren();
        this.#ask();
        this.#chart.draw();
        return undefined;
    }
    #showSettings() {
        const { kind } = this.#host.state;
        this.#parts.size.hidden = kind === "ray" || kind === "near";
        this.#parts.k.hidden = kind !== "near";
        this.#parts.hint.hidden = kind !== "ray" || this.#scene?.dim !== 2;
    }
    leave() {
        this.#end();
        this.#dark.removeEventListener("change", this.#redraw);
        this.#chart.close();
    }
}

const clamp = (x) => Math.min(1, Math.max(0, x));
const round = (x) => Math.round(x * 1e4) / 1e4;
