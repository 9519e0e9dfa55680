/* move.js: the room Move: objects that move, the partition that follows them, and what happens to it, event by event */
import { between, oneOf } from "../address.js";
import { cellColour, Chart, colours, trace, VIEW, VIEWS, WHOLE } from "../chart.js";
import { button, Controls, group } from "../controls.js";
import { count, counted, factsOf, h } from "../dom.js";
import { EVENTS } from "froe/kinetic.js";
import { isCancelled } from "../link.js";
import { Follower } from "../move/follower.js";
import { MOTIONS, motionSource } from "../samples.js";
import { Scenes } from "../scenes.js";

export const title = "Move";
export const lead = "a partition that follows moving objects, event by event.";
export const defaults = { scene: "flight", time: 0, pace: 1, cells: true, ...VIEW };
export const allowed = { scene: oneOf([...Object.keys(MOTIONS), "file"]), time: between(0, 1), pace: between(0.1, 4), ...VIEWS };

const LARGEST = 100e6;   // bytes of a file of moving objects
const MOST = 20000;      // objects
const ROUND = 40;        // seconds in which a whole motion plays at pace 1
const BINS = 160;        // columns of the timeline
const AROUND = 9;        // events that are listed
/* What an event is, in words. */
const WORDS = { vertices: "an end passes over an end", "vertex-crossing": "an end passes over a crossing", crossings: "a crossing passes over a crossing",
    contact: "an end meets a segment", triple: "three segments meet in a point", turn: "a segment turns upright", batch: "several at once",
    plan: "a flight goes on differently", appear: "an object appears", disappear: "an object disappears", flop: "a triangle turns over" };

export async function enter(host) {
    const room = new MoveRoom(host);
    room.scenes.load();
    return room;
}

class MoveRoom {
    scenes;
    #host;
    #controls;
    #chart;
    #parts = {};
    #follower = null;
    #motion = null;   // window and vertices of the objects
    #shown = null;    // positions and cells, at a time
    #events = null;
    #busy = false;
    #late = false;
    #playing = 0;
    #age = 0;
    #dark = matchMedia("(prefers-color-scheme: dark)");
    #resized = new ResizeObserver(() => this.#paintTimeline());
    #redraw = () => { this.#chart.draw(); this.#paintTimeline(); };

    constructor(host) {
        this.#host = host;
        this.scenes = new Scenes(host, { samples: MOTIONS, sampleSource: motionSource, openFiles: readMotion, usual: defaults.scene,
            show: (read) => this.#open(read), fresh: { ...WHOLE, time: 0 } });
        const p = this.#parts;
        p.canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": "The moving objects. Arrow keys move the view, plus and minus zoom, 0 fits, [ and ] go to the event before and after." });
        p.time = h("input", { type: "range", min: 0, max: 1, step: "any", "aria-label": "Time", oninput: () => this.#host.set({ time: Number(p.time.value) }) });
        p.density = h("canvas", { class: "density", role: "img", "aria-label": "How much happens when" });
        p.play = button("Play", () => this.#play());
        p.work = h("div", { class: "work", hidden: true }, h("span", {}, "Reading"), button("Cancel", () => this.cancel()));
        host.stage.prepend(h("div", { class: "film" }, h("div", { class: "map" }, p.canvas),
            h("div", { class: "timeline" }, p.play, h("div", {}, p.density, p.time))), p.work);
        this.#chart = new Chart(p.canvas, { view: () => host.state, change: (patch) => host.set(patch), paint: (context) => this.#paint(context), key: (event) => this.#key(event) });
        this.#controls = new Controls(host);
        host.panel.append(...this.#settings(this.#controls));
        this.#dark.addEventListener("change", this.#redraw);
        this.#resized.observe(p.density);
    }
    #settings(c) {
        const p = this.#parts;
        p.cells = c.toggle("cells", "Cells of the partition");
        p.list = h("ol", { class: "events" });
        p.counts = h("dl", { class: "facts" });
        return [
            this.scenes.group(c, "Motion", "Motion", ".mfjson,.json"),
            group("Play", c.slider("pace", "Pace", { min: 0.1, max: 4, step: 0.1, show: (x) => `${x} ×` }), p.cells,
                h("div", { class: "buttons two" }, button("Event before", () => this.#toEvent(-1)), button("Event after", () => this.#toEvent(1)))),
            group("What happens", p.list), group("In all", p.counts),
        ];
    }

    /* -- motions ------------------------------------------------------------------------ */

    files(files) { this.scenes.take(files); }
    async #open(source) {
        this.#end();
        const age = this.#age, follower = new Follower(), p = this.#parts;
        this.#follower = follower;
        this.#host.say();
        p.work.hidden = false;
        try {
            const read = await source();
            if (age !== this.#age) return;
            const motion = await follower.open(read);
            if (age !== this.#age) return;
            const objects = motion.births.length;
            if (!objects) throw new Error("Nothing moves in this file");
            if (objects > MOST) throw new Error(`${count(objects)} objects move, and the page shows at most ${count(MOST)}: froe simulate takes any number`);
            this.#motion = { ...motion, corners: motion.vertices.length / objects };
            p.work.hidden = true;
            await this.#fit(follower);
            if (age !== this.#age) return;
            this.#show();
            this.#tell();
            const events = await follower.list();
            if (age !== this.#age) return;
            this.#events = { ...events, next: 0 };
            this.#paintTimeline();
            this.#tellAll();
            this.#tell();
        } catch (error) {
            if (age === this.#age && !isCancelled(error)) this.#host.fail(error);
        } finally {
            if (age === this.#age) p.work.hidden = true;
        }
    }
    /* The view holds everything at all times that are looked at here. */
    async #fit(follower) {
        const { dim, begin, end } = this.#motion, lo = new Array(dim).fill(Infinity), hi = new Array(dim).fill(-Infinity);
        for (let i = 0; i <= 24; i++) {
            const { positions } = await follower.at(begin + (end - begin) * i / 24, false);
            for (let k = 0; k < positions.length; k++) {
                if (Number.isNaN(positions[k])) continue;
                lo[k % dim] = Math.min(lo[k % dim], positions[k]);
                hi[k % dim] = Math.max(hi[k % dim], positions[k]);
            }
        }
        this.#chart.fit({ lo, hi });
    }
    #end() {
        this.#halt();
        this.#age++;
        this.#follower?.end();
        this.#follower = this.#motion = this.#shown = this.#events = null;
        this.#busy = this.#late = false;
        this.#parts.list.replaceChildren();
        this.#parts.counts.replaceChildren();
        this.#paintTimeline();
        this.#chart.draw();
    }
    cancel() {
        this.#end();
        this.#parts.work.hidden = true;
        this.#host.say(h("span", {}, "Cancelled."), button("Read again", () => this.scenes.again()));
    }

    /* -- time --------------------------------------------------------------------------- */

    /** The time that is shown. The state has it as a share of the window. */
    get #now() {
        const { begin, end } = this.#motion;
        return begin + (end - begin) * Math.min(1, Math.max(0, this.#host.state.time));
    }
    #play() {
        if (this.#playing) return this.#halt();
        if (this.#host.state.time >= 1) this.#host.set({ time: 0 });
        this.#parts.play.textContent = "Pause";
        let before = performance.now();
        const tick = (now) => {
            const time = Math.min(1, this.#host.state.time + (now - before) / 1000 / ROUND * this.#host.state.pace);
            before = now;
            this.#playing = requestAnimationFrame(tick);
            this.#host.set({ time });
            if (time >= 1) this.#halt();
        };
        this.#playing = requestAnimationFrame(tick);
        return undefined;
    }
    #halt() {
        cancelAnimationFrame(this.#playing);
        this.#playing = 0;
        this.#parts.play.textContent = "Play";
    }
    /* The share of the window at a time, or what is next above it and is not before that time. */
    #shareOf(time) {
        const { begin, end } = this.#motion;
        let share = (time - begin) / (end - begin);
        while (begin + (end - begin) * share < time) share *= 1 + 2 ** -52;
        return share;
    }
    #toEvent(way) {
        if (!this.#events || !this.#motion) return;
        this.#halt();
        const { times } = this.#events, now = this.#now;
        let at = after(times, now);
        if (way < 0) {
            at -= 1;
            while (at >= 0 && times[at] >= now) at--;
        }
        if (at >= 0 && at < times.length) this.#host.set({ time: this.#shareOf(times[at]) });
    }
    #key(event) {
        const way = { "[": -1, "]": 1 }[event.key];
        if (way) this.#toEvent(way);
        return way !== undefined;
    }
    async #show() {
        if (!this.#motion) return;
        if (this.#busy) {
            this.#late = true;
            return;
        }
        this.#busy = true;
        const age = this.#age, time = this.#now;
        try {
            const shown = await this.#follower.at(time, this.#host.state.cells && this.#motion.dim === 2);
            if (age === this.#age) this.#shown = { ...shown, time };
        } catch (error) {
            if (age === this.#age && !isCancelled(error)) this.#host.fail(error);
        } finally {
            if (age === this.#age) {
                this.#busy = false;
                this.#chart.draw();
                if (this.#late) {
                    this.#late = false;
                    this.#show();
                }
            }
        }
    }

    /* -- what is told --------------------------------------------------------------------- */

    #nameOf(i) { return this.#events.kinds ? WORDS[EVENTS[this.#events.kinds[i]]] : "two triangles meet"; }
    #tell() {
        const p = this.#parts;
        p.time.value = this.#host.state.time;
        if (!this.#motion) return;
        const now = this.#now;
        p.time.setAttribute("aria-valuetext", `time ${now.toPrecision(6)}`);
        p.cells.hidden = this.#motion.dim === 3;
        const { times, kinds } = this.#events ?? {};
        this.#host.say(...[`Time ${now.toPrecision(6)}`, counted(this.#motion.births.length, "object"),
            times ? `${count(after(times, now))} of ${count(times.length)} ${kinds ? "events" : "contacts"} so far` : "listing what happens …"].map((text) => h("span", {}, text)));
        if (!this.#events) return;
        const { objects, per } = this.#events, first = Math.max(0, after(times, now) - 1 - (AROUND >> 1)), lines = [];
        for (let i = first; i < Math.min(times.length, first + AROUND); i++) {
            const about = [...objects.subarray(per * i, per * i + per)].filter((id) => id !== 0xffffffff);
            lines.push(h("li", { "aria-current": i === after(times, now) - 1 ? "true" : null },
                h("button", { type: "button", onclick: () => this.#host.set({ time: this.#shareOf(times[i]) }) },
                    h("strong", {}, times[i].toPrecision(7)), ` ${this.#nameOf(i)}`, h("span", { class: "soft" }, ` ${about.join(", ")}`))));
        }
        p.list.replaceChildren(...lines);
    }
    #tellAll() {
        const { kinds, times } = this.#events, tally = new Map();
        if (kinds) for (const kind of kinds) tally.set(kind, (tally.get(kind) ?? 0) + 1);
        const facts = kinds ? [...tally].sort((a, b) => b[1] - a[1]).map(([kind, n]) => [WORDS[EVENTS[kind]], count(n)]) : [["contacts", count(times.length)]];
        this.#parts.counts.replaceChildren(...factsOf(facts));
    }

    /* -- pictures ------------------------------------------------------------------------- */

    #paint(context) {
        if (!this.#shown) return;
        const look = colours(), { positions, cells, time } = this.#shown, { dim, vertices, corners, births, deaths } = this.#motion;
        if (cells) {
            const at = this.#chart.project(cells.coords);
            for (let i = 0; i < cells.nodes.length; i++) {
                trace(context, at, cells.starts[cells.faces[i]], cells.starts[cells.faces[i + 1]]);
                context.fillStyle = cellColour(i);
                context.fill();
                context.strokeStyle = look.line;
                context.lineWidth = 0.75;
                context.stroke();
            }
        }
        const points = this.#chart.project(positions), happening = this.#happening();
        for (const now of [false, true]) {
            context.beginPath();
            for (let i = 0; i < births.length; i++) {
                if (happening.has(i) !== now || time < births[i] || time > deaths[i]) continue;
                for (let c = 0; c < corners; c++) {
                    const v = vertices[corners * i + c];
                    context[c ? "lineTo" : "moveTo"](points[2 * v], points[2 * v + 1]);
                }
                if (dim === 3) context.closePath();
                const [a, b] = [2 * vertices[corners * i], 2 * vertices[corners * i + 1]];
                if (points[a] === points[b] && points[a + 1] === points[b + 1]) { // a line to itself would not be there
                    context.moveTo(points[a] + 2, points[a + 1]);
                    context.arc(points[a], points[a + 1], 2, 0, 7);
                }
            }
            context.strokeStyle = now ? look.hit : look.ink;
            context.lineWidth = now ? 4 : dim === 3 ? 0.8 : 2;
            context.lineCap = context.lineJoin = "round";
            context.stroke();
        }
    }
    /* Objects of the events at the time that is shown. */
    #happening() {
        const found = new Set();
        if (!this.#events) return found;
        const { times, objects, per } = this.#events, now = this.#shown.time, near = (this.#motion.end - this.#motion.begin) / 1000;
        for (let i = after(times, now) - 1; i >= 0 && now - times[i] <= near; i--)
            for (const id of objects.subarray(per * i, per * i + per)) found.add(id);
        return found;
    }
    #paintTimeline() {
        const canvas = this.#parts.density, { clientWidth: width, clientHeight: height } = canvas, dots = devicePixelRatio || 1;
        if (!width) return;
        Object.assign(canvas, { width: width * dots, height: height * dots });
        if (!this.#events) return;
        const bins = new Float64Array(BINS), { begin, end } = this.#motion, context = canvas.getContext("2d");
        for (const time of this.#events.times) bins[Math.min(BINS - 1, Math.floor((time - begin) / (end - begin) * BINS))]++;
        const most = Math.max(...bins, 1);
        context.scale(dots, dots);
        context.fillStyle = colours().mark;
        bins.forEach((n, i) => { if (n) context.fillRect(i * width / BINS, height * (1 - Math.sqrt(n / most)), Math.max(1, width / BINS - 1), height); });
    }

    /* -- what the state says ---------------------------------------------------------------- */

    change(changed) {
        this.#controls.update();
        if (changed.includes("scene")) return this.scenes.load();
        if (changed.includes("time") || changed.includes("cells")) {
            this.#show();
            this.#tell();
        }
        this.#chart.draw();
        return undefined;
    }
    leave() {
        this.#end();
        this.#dark.removeEventListener("change", this.#redraw);
        this.#resized.disconnect();
        this.#chart.close();
    }
}

/* The source of a file of moving objects. */
async function readMotion([file]) {
    if (file.size > LARGEST) throw new Error(`${file.name} has ${Math.round(file.size / 1e6)} MB, and the page reads motions of at most ${LARGEST / 1e6} MB`);
    if (!file.size) throw new Error(`${file.name} is empty.`);
    return { name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) };
}

/* How many times are at most `now`; times are sorted. */
function after(times, now) {
    let [low, high] = [0, times.length];
    while (low < high) {
        const middle = (low + high) >> 1;
        if (times[middle] <= now) low = middle + 1;
        else high = middle;
    }
    return low;
}
