/* chart.js: a canvas that shows coordinates of the plane or of space, moved by pointer, wheel and keys.
 *
 * The view is part of the state of a room: zoom (1: all fits), x and y (how far it is shifted, in heights of the canvas),
 * and, in space, turn and tilt in degrees. Space is shown without perspective. */

import { between } from "./address.js";

export const VIEW = { turn: 31, tilt: 24, zoom: 1, x: 0, y: 0 };
const MARGIN = 24, NEAREST = 4000, FARTHEST = 0.2;
/** What its members may be: see address.js. */
export const VIEWS = { turn: between(-180, 180), tilt: between(-90, 90), zoom: between(FARTHEST, NEAREST), x: between(-NEAREST, NEAREST), y: between(-NEAREST, NEAREST) };
/** The view that a new scene begins with; how it is turned stays. */
export const WHOLE = { zoom: VIEW.zoom, x: VIEW.x, y: VIEW.y };

export class Chart {
    #canvas;
    #view;
    #paint;
    #frame = 0;
    #stop = new AbortController();
    #box = { dim: 2, lo: [0, 0], hi: [1, 1], up: 2 };
    #resized;
    #still = null; // { key, canvas, made }

    /** `view()` is the state; `change(patch)` sets it; `paint(context, chart)` draws; `more` has listeners: point(event,
     * [x, y]), drag(event, from, to) which returns true if it took it, leave(), key(event). */
    constructor(canvas, { view, change, paint, ...more }) {
        this.#canvas = canvas;
        this.#view = view;
        this.#paint = paint;
        this.#listen(change, more);
        this.#resized = new ResizeObserver(() => this.draw());
        this.#resized.observe(canvas);
    }
    close() {
        this.#stop.abort();
        this.#resized.disconnect();
        cancelAnimationFrame(this.#frame);
    }

    /** What is shown when zoom is 1: a box of 2 or 3 dimensions, and the axis that points up. */
    fit({ lo, hi }, up = 2) {
        this.#box = { dim: lo.length, lo: [...lo], hi: [...hi], up };
        this.#still = null;
        this.draw();
    }
    get dim() { return this.#box.dim; }
    get width() { return this.#canvas.clientWidth; }
    get height() { return this.#canvas.clientHeight; }

    /** Draws with the next frame. */
    draw() {
        this.#frame ||= requestAnimationFrame(() => {
            this.#frame = 0;
            const { width, height } = this, dots = devicePixelRatio || 1, canvas = this.#canvas;
            if (!width || !height) return;
            if (canvas.width !== Math.round(width * dots) || canvas.height !== Math.round(height * dots))
                Object.assign(canvas, { width: Math.round(width * dots), height: Math.round(height * dots) });
            const context = canvas.getContext("2d");
            context.setTransform(dots, 0, 0, dots, 0, 0);
            context.clearRect(0, 0, width, height);
            this.#paint(context, this);
        });
    }

    /** Paints what stays as it is until the view, fit() or the text `of` changes: `paint(context)` draws it once, and copies
     * are drawn from then on. Returns what `paint` returned. */
    still(context, of, paint) {
        const { turn, tilt, zoom, x, y } = this.#view(), { width, height } = this.#canvas, dots = devicePixelRatio || 1;
        const key = [turn, tilt, zoom, x, y, width, height, dots, of].join();
        if (this.#still?.key !== key) {
            const canvas = new OffscreenCanvas(width, height), layer = canvas.getContext("2d");
            layer.scale(dots, dots);
            this.#still = { key, canvas, made: paint(layer) };
        }
        context.drawImage(this.#still.canvas, 0, 0, width / dots, height / dots);
        return this.#still.made;
    }

    /* The middle of the box. Coordinates are taken from it, so that pixels of what is far from the origin have their
     * digits. */
    get #middle() { return this.#box.lo.map((low, i) => low / 2 + this.#box.hi[i] / 2); }
    /** The map from coordinates, less the middle, to pixels: rows of [per axis ..., constant] for x and y, and in space
     * for the depth. */
    #matrix() {
        const { dim, lo, hi, up } = this.#box, { turn, tilt, zoom, x, y } = this.#view(), { width, height } = this;
        const half = lo.map((low, i) => hi[i] / 2 - low / 2); // finite, where the whole may not be
        let rows;
        if (dim === 2) rows = [[1, 0], [0, 1]];
        else {
            const a = turn * Math.PI / 180, b = tilt * Math.PI / 180, first = (up + 1) % 3, second = (up + 2) % 3, row = (p, q, r) => {
                const out = [0, 0, 0];
                [out[first], out[second], out[up]] = [p, q, r];
                return out;
            };
            rows = [row(Math.cos(a), Math.sin(a), 0), row(-Math.sin(a) * Math.sin(b), Math.cos(a) * Math.sin(b), Math.cos(b)),
                row(Math.sin(a) * Math.cos(b), -Math.cos(a) * Math.cos(b), Math.sin(b))];
        }
        const extent = (row) => row.reduce((sum, factor, i) => sum + Math.abs(factor) * half[i], 0) || 1e-300;
        const room = (pixels) => Math.max(1, pixels - 2 * MARGIN) / 2;
        const scale = zoom * (dim === 2 ? Math.min(room(width) / extent(rows[0]), room(height) / extent(rows[1]))
            : Math.min(room(width), room(height)) / Math.hypot(...half));
        const at = [width / 2 + x * height, height / 2 - y * height];
        return rows.map((row, i) => {
            const factor = i === 1 ? -scale : scale;
            return [...row.map((r) => r * factor), at[i] ?? 0];
        });
    }
    /** Pixels of coordinates, two for each point; in space `depths` are filled, larger is nearer. */
    project(coords, depths = null) {
        const { dim } = this, rows = this.#matrix(), [mx, my, mz = 0] = this.#middle, count = coords.length / dim, out = new Float64Array(2 * count);
        const [[a, b, c, d], [e, f, g, h], depth] = dim === 2 ? rows.map(([p, q, r]) => [p, q, 0, r]) : rows;
        for (let i = 0; i < count; i++) {
            const x = coords[dim * i] - mx, y = coords[dim * i + 1] - my, z = dim === 3 ? coords[dim * i + 2] - mz : 0;
            out[2 * i] = a * x + b * y + c * z + d;
            out[2 * i + 1] = e * x + f * y + g * z + h;
            if (depths) depths[i] = depth[0] * x + depth[1] * y + depth[2] * z;
        }
        return out;
    }
    /** The point of the plane under a pixel. */
    unproject([px, py]) {
        const [[a, , c], [, e, f]] = this.#matrix(), [mx, my] = this.#middle;
        return [mx + (px - c) / a, my + (py - f) / e];
    }
    /** In space: the ray into the picture under a pixel: { origin, direction }. */
    rayAt([px, py]) {
        const [right, down, depth] = this.#matrix(), scale = Math.hypot(...right.slice(0, 3)), { lo, hi } = this.#box;
        const u = (px - right[3]) / scale / scale, v = (py - down[3]) / scale / scale, far = Math.hypot(...lo.map((low, i) => hi[i] - low)) * 2;
        const toward = depth.slice(0, 3).map((x) => x / scale);
        return { origin: this.#middle.map((x, i) => x + (right[i] * u + down[i] * v + toward[i] * far)), direction: toward.map((t) => -t) };
    }

    #listen(change, { point, drag, leave, key }) {
        const element = this.#canvas, fingers = new Map(), signal = this.#stop.signal;
        const on = (type, listen, options = {}) => element.addEventListener(type, listen, { signal, ...options });
        const at = (event) => {
            const frame = element.getBoundingClientRect();
            return [event.clientX - frame.left, event.clientY - frame.top];
        };
        const shift = (right, down) => {
            const { x, y } = this.#view(), { height } = this;
            change({ x: round(x + right / height), y: round(y - down / height) });
        };
        const turn = (right, down) => {
            const { turn, tilt } = this.#view();
            change({ turn: round((turn - right + 540) % 360 - 180), tilt: round(Math.min(90, Math.max(-90, tilt + down))) });
        };
        const zoomAt = (factor, [px, py]) => {
            const { zoom, x, y } = this.#view(), now = Math.min(NEAREST, Math.max(FARTHEST, zoom * factor)), by = now / zoom - 1, { width, height } = this;
            change({ zoom: round(now), x: round(x + by * (x - (px - width / 2) / height)), y: round(y + by * (y + (py - height / 2) / height)) });
        };
        const spread = () => {
            const [a, b] = [...fingers.values()];
            return b ? { middle: [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2], apart: Math.hypot(a[0] - b[0], a[1] - b[1]) } : { middle: a, apart: 0 };
        };
        let began = null, taken = false;
        on("pointerdown", (event) => {
            element.setPointerCapture(event.pointerId);
            fingers.set(event.pointerId, at(event));
            began = at(event);
            taken = fingers.size === 1 && event.button === 0 && (drag?.(event, began, began) ?? false);
        });
        on("pointermove", (event) => {
            const now = at(event);
            if (!fingers.has(event.pointerId)) return point?.(event, now);
            if (taken) return drag(event, began, now);
            const before = spread();
            fingers.set(event.pointerId, now);
            const after = spread(), right = after.middle[0] - before.middle[0], down = after.middle[1] - before.middle[1];
            if (fingers.size > 1 && before.apart) zoomAt(after.apart / before.apart, after.middle);
            if (this.dim === 3 && fingers.size === 1 && !event.shiftKey && event.buttons !== 2) turn(180 * right / this.height, 180 * down / this.height);
            else shift(right, down);
            return undefined;
        });
        for (const type of ["pointerup", "pointercancel"]) on(type, (event) => {
            if (taken && type === "pointerup") drag(event, began, at(event));
            fingers.delete(event.pointerId);
            taken = false;
        });
        on("pointerleave", () => { if (!fingers.size) leave?.(); });
        on("contextmenu", (event) => event.preventDefault());
        on("wheel", (event) => {
            if (document.activeElement !== element && !event.ctrlKey) return; // the page scrolls
            event.preventDefault();
            zoomAt(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), at(event));
        }, { passive: false });
        on("keydown", (event) => {
            if (event.ctrlKey || event.altKey || event.metaKey) return;
            const { width, height } = this, middle = [width / 2, height / 2], arrow = ARROWS[event.key];
            if (key?.(event)) event.preventDefault();
            else if (arrow) (this.dim === 3 && !event.shiftKey ? turn(5 * arrow[0], 5 * arrow[1]) : shift(-20 * arrow[0], -20 * arrow[1])), event.preventDefault();
            else if ("+=".includes(event.key)) zoomAt(1.2, middle);
            else if (event.key === "-") zoomAt(1 / 1.2, middle);
            else if (event.key === "0") change(WHOLE);
        });
    }
}

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const round = (x) => Number(x.toPrecision(6));

/** The colours of the page, as the theme has them now. */
export function colours() {
    const style = getComputedStyle(document.documentElement);
    return Object.fromEntries(["paper", "card", "ink", "soft", "line", "faint", "mark", "hit"].map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
}
/** Is the theme dark? */
export const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;
/** The fill of cell n: neighbours by number differ. */
export const cellColour = (n) => `oklch(${isDark() ? "0.33 0.045" : "0.92 0.045"} ${(n * 137.508 + 190) % 360})`;

/** How near each of several parts is to the eye, by the middle of its corners: part i has the depths starts[i] ..
 * starts[i + 1], or those that `corners` numbers there. */
export function nearness(depths, starts, corners = null) {
    const near = new Float64Array(starts.length - 1);
    for (let i = 0; i < near.length; i++) {
        for (let c = starts[i]; c < starts[i + 1]; c++) near[i] += depths[corners ? corners[c] : c];
        near[i] /= starts[i + 1] - starts[i];
    }
    return near;
}

/** Begins a path along points from .. to; one of more than two is closed. */
export function trace(context, points, from, to) {
    context.beginPath();
    for (let i = from; i < to; i++) context[i === from ? "moveTo" : "lineTo"](points[2 * i], points[2 * i + 1]);
    if (to - from > 2) context.closePath();
}
