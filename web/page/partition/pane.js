/* pane.js: a partition as a picture: its cells after a number of cuts, its pieces, and the one under the pointer.
 *
 * The cuts come in the order of their depth. After `step` of them the cells are the nodes whose parent has been cut and
 * which themselves have not: the front. */
import { cellColour, Chart, colours, nearness, trace } from "../chart.js";
import { count } from "../dom.js";
import { isCancelled, startFroe } from "../link.js";
import { groupsOf, NAMED, sceneFrom } from "../open.js";
import { outlines } from "../outlines.js";

const NEAR = 8; // pixels from a line within which it is under the pointer

export class Pane {
    #tell;
    #worker = null;
    #shown = null;   // what is drawn: the arrays of a tree
    #hovered = -1;   // a piece
    #step = 0;
    #age = 0;

    /** `tell` hears of progress(pane, share), built(pane), hover(pane, piece), failed(pane, error). */
    constructor(canvas, { state, change, ...tell }) {
        this.canvas = canvas;
        this.#tell = tell;
        this.chart = new Chart(canvas, {
            view: state, change, paint: (context) => this.#paint(context),
            point: (_, at) => this.hover(this.#pieceAt(at)), leave: () => this.hover(-1), key: (event) => tell.key(event),
        });
    }
    close() {
        this.cancel();
        this.chart.close();
    }
    /** Ends what is being built. What is shown stays. */
    cancel() {
        this.#age++;
        this.#worker?.end();
        this.#worker = null;
    }

    /** Ends what is being built, and shows nothing any more. */
    clear() {
        this.cancel();
        this.#shown = null;
        this.#hovered = -1;
        this.chart.draw();
    }

    get report() { return this.#shown?.report ?? null; }
    /** How many cuts there are. */
    get cutCount() { return this.#shown?.order.length ?? 0; }
    get pieceCount() { return this.#shown?.pieces.objects.length ?? 0; }

    /** Builds the partition of a source, and shows it. `most`: of how many objects at most. */
    async build(source, { method, leaf }, most) {
        this.cancel();
        const age = this.#age;
        try {
            const worker = await startFroe((share) => this.#tell.progress(this, share));
            if (age !== this.#age) return worker.end();
            this.#worker = worker;
            const scene = await sceneFrom(worker.froe, source), objects = await scene.objectCount(), bounds = await scene.bounds();
            if (!bounds) throw new Error("There are no objects in this scene");
            if (objects > most)
                throw new Error(`This scene has ${count(objects)} objects, and the page shows partitions of at most ${count(most)}: froe draw does so of any number`);
            const tree = await scene.build({ method, ...(leaf ? { leaf } : {}) });
            const [report, nodes, pieces, cells, cuts, up, groups, { dim, forms, radii }] = await Promise.all([tree.report(), tree.nodes(),
                tree.pieces(), tree.cells({ inner: true }), tree.cuts(), upOf(scene), groupNames(scene), scene.arrays()]);
            if (age !== this.#age) return undefined;
            const { starts, coords } = outlines({ ...pieces, dim, forms: pieces.objects.map((id) => forms[id]), radii: Float64Array.from(pieces.objects, (id) => radii[id]) });
            Object.assign(pieces, { starts, coords });
            this.#show({ report, nodes, pieces, cells, cuts, groups, bounds, up });
            this.#tell.built(this);
        } catch (error) {
            if (age === this.#age && !isCancelled(error)) this.#tell.failed(this, error);
        } finally {
            if (age === this.#age) {
                this.#worker?.end(); // everything that is shown has come over
                this.#worker = null;
            }
        }
        return undefined;
    }
    #show(shown) {
        const { nodes, cuts, cells } = shown, total = nodes.parents.length;
        const inner = Array.from({ length: total }, (_, i) => i).filter((i) => nodes.children[2 * i]);
        shown.order = inner.sort((a, b) => nodes.depths[a] - nodes.depths[b] || a - b);
        shown.rank = new Uint32Array(total).fill(inner.length);
        shown.order.forEach((node, i) => { shown.rank[node] = i; });
        shown.cellOf = new Int32Array(total).fill(-1);
        cells.nodes.forEach((node, i) => { shown.cellOf[node - 1] = i; });
        shown.cutOf = new Int32Array(total).fill(-1);
        cuts.nodes.forEach((node, i) => { shown.cutOf[node - 1] = i; });
        this.#shown = shown;
        this.#hovered = -1;
        this.chart.fit(shown.bounds, shown.up);
    }

    /** Shows as many cuts; -1: all. */
    set step(step) {
        this.#step = step;
        this.chart.draw();
    }
    get #steps() { return this.#step < 0 ? this.cutCount : Math.min(this.#step, this.cutCount); }
    /** The depth of the last cut that is shown, from 1; 0 without any. */
    get depth() { return this.#steps ? this.#shown.nodes.depths[this.#shown.order[this.#steps - 1]] + 1 : 0; }
    /** How many cuts there are down to a depth. */
    stepsTo(depth) {
        const { order, nodes } = this.#shown;
        let steps = 0;
        while (steps < order.length && nodes.depths[order[steps]] < depth) steps++;
        return steps;
    }

    /* -- under the pointer ------------------------------------------------------- */

    /** Looks at a piece; -1: at none. */
    hover(piece) {
        if (piece === this.#hovered || piece >= this.pieceCount) return;
        this.#hovered = piece;
        this.chart.draw();
        this.#tell.hover(this, piece);
    }
    /** What is told of a piece: its object, the cut in whose list it is, or its cell, and that list. */
    about(piece) {
        const { pieces, nodes, groups } = this.#shown, node = pieces.nodes[piece] - 1, object = pieces.objects[piece];
        return {
            piece, object, name: groups.nameOf(object), whole: pieces.whole[piece] === 1, siblings: pieces.objects.filter((it) => it === object).length,
            node: node + 1, depth: nodes.depths[node], inCut: nodes.children[2 * node] !== 0, cut: this.#shown.rank[node] + 1, list: nodes.pieceCounts[node],
        };
    }
    #pieceAt([px, py]) {
        if (!this.#shown) return -1;
        const { pieces } = this.#shown, depths = this.chart.dim === 3 ? new Float64Array(pieces.coords.length / 3) : null;
        const at = this.chart.project(pieces.coords, depths);
        let best = -1, least = depths ? -Infinity : NEAR;
        for (let i = 0; i < pieces.objects.length; i++) {
            const from = pieces.starts[i], to = pieces.starts[i + 1];
            if (depths && to - from > 2) {
                if (!inside(at, from, to, px, py)) continue;
                const depth = depths[from];
                if (depth > least) [best, least] = [i, depth];
            } else if (!depths) {
                for (let c = from; c < Math.max(from + 1, to - (to - from > 2 ? 0 : 1)); c++) {
                    const d = distance(at, c, c + 1 < to ? c + 1 : from, px, py);
                    if (d < least) [best, least] = [i, d];
                }
            }
        }
        return best;
    }

    /* -- picture ------------------------------------------------------------------- */

    #paint(context) {
        if (!this.#shown) return;
        const look = colours(), points = this.chart.still(context, [this.#step, look.ink], (layer) => this.#paintPartition(layer, look));
        if (this.#hovered >= 0) this.#paintHovered(context, look, points);
    }
    /* All but what the pointer is over. Returns the pixels of the pieces' corners. */
    #paintPartition(context, look) {
        const { nodes, rank, order } = this.#shown, steps = this.#steps;
        const front = [];
        for (let i = 0; i < nodes.parents.length; i++) {
            const parent = nodes.parents[i];
            if (rank[i] >= steps && (parent === 0 || rank[parent - 1] < steps)) front.push(i);
        }
        const last = steps ? order[steps - 1] : -1;
        if (this.chart.dim === 2) return this.#paintPlane(context, look, front, last, steps);
        return this.#paintSpace(context, look, front, last);
    }
    /* The piece under the pointer and the others of its list lie over all others. */
    #paintHovered(context, look, points) {
        const { pieces, nodes } = this.#shown, node = pieces.nodes[this.#hovered] - 1, from = nodes.firstPieces[node];
        const list = Array.from({ length: nodes.pieceCounts[node] }, (_, i) => from + i).filter((i) => i !== this.#hovered);
        if (this.chart.dim === 2) {
            this.#strokePieces(context, points, list, look.mark, 3);
            this.#strokePieces(context, points, [this.#hovered], look.hit, 4);
        } else for (const i of [...list, this.#hovered])
            this.#fillPiece(context, points, i, i === this.#hovered ? look.hit : look.mark, look.ink);
    }
    #paintPlane(context, look, front, last, steps) {
        const { cells, cellOf, cuts, cutOf, order, pieces, nodes } = this.#shown;
        const at = this.chart.project(cells.coords);
        for (const node of front) {
            const cell = cellOf[node];
            if (cell < 0) continue;
            trace(context, at, cells.starts[cells.faces[cell]], cells.starts[cells.faces[cell] + 1]);
            context.fillStyle = cellColour(node);
            context.fill();
        }
        const lines = this.chart.project(cuts.coords);
        for (let i = 0; i < steps; i++) {
            const cut = cutOf[order[i]];
            if (cut < 0) continue;
            context.strokeStyle = look.soft;
            context.globalAlpha = 0.35;
            context.lineWidth = Math.max(0.5, 3 - nodes.depths[order[i]] * 0.3);
            trace(context, lines, cuts.starts[cut], cuts.starts[cut + 1]);
            context.stroke();
        }
        context.globalAlpha = 1;
        const points = this.chart.project(pieces.coords);
        this.#strokePieces(context, points, pieces.objects.keys(), look.ink, 1.2);
        if (last >= 0 && this.#step >= 0 && cutOf[last] >= 0) this.#stroke(context, lines, cuts.starts[cutOf[last]], cuts.starts[cutOf[last] + 1], look.hit, 2.5);
        return points;
    }
    #strokePieces(context, points, which, colour, width) {
        const { pieces } = this.#shown;
        context.strokeStyle = context.fillStyle = colour;
        context.lineWidth = width;
        context.lineCap = "round";
        context.beginPath();
        for (const i of which) {
            const from = pieces.starts[i], to = pieces.starts[i + 1];
            if (to - from === 1) context.fillRect(points[2 * from] - width, points[2 * from + 1] - width, 2 * width, 2 * width);
            for (let c = from; c < to; c++) context[c === from ? "moveTo" : "lineTo"](points[2 * c], points[2 * c + 1]);
            if (to - from > 2) context.closePath();
        }
        context.stroke();
    }
    #paintSpace(context, look, front, last) {
        const { pieces, nodes, cells, cellOf, cuts, cutOf } = this.#shown;
        const owner = new Int32Array(nodes.parents.length).fill(-1);
        for (const node of front) owner[node] = node;
        const depths = new Float64Array(pieces.coords.length / 3), points = this.chart.project(pieces.coords, depths);
        const near = nearness(depths, pieces.starts), order = Uint32Array.from(near, (_, i) => i).sort((a, b) => near[a] - near[b]);
        for (const i of order) {
            const cell = this.#cellOfNode(owner, pieces.nodes[i] - 1);
            this.#fillPiece(context, points, i, cell < 0 ? look.card : cellColour(cell), look.ink);
        }
        if (last < 0 || this.#step < 0) return points;
        const box = this.chart.project(cells.coords), cell = cellOf[last];
        for (let f = cells.faces[cell]; f < cells.faces[cell + 1]; f++) this.#stroke(context, box, cells.starts[f], cells.starts[f + 1], look.soft, 1);
        if (cutOf[last] < 0) return points;
        const cut = this.chart.project(cuts.coords);
        trace(context, cut, cuts.starts[cutOf[last]], cuts.starts[cutOf[last] + 1]);
        context.fillStyle = look.hit;
        context.globalAlpha = 0.25;
        context.fill();
        context.globalAlpha = 1;
        this.#stroke(context, cut, cuts.starts[cutOf[last]], cuts.starts[cutOf[last] + 1], look.hit, 2);
        return points;
    }
    #fillPiece(context, points, i, fill, edge) {
        const { starts } = this.#shown.pieces;
        trace(context, points, starts[i], starts[i + 1]);
        context.fillStyle = fill;
        context.fill();
        context.strokeStyle = edge;
        context.globalAlpha = 0.55;
        context.lineWidth = 0.5;
        context.lineJoin = "round";
        context.stroke();
        context.globalAlpha = 1;
    }
    /* The node of the front above a node; -2: the cut has been made, and the piece lies in it. */
    #cellOfNode(owner, node) {
        const { parents } = this.#shown.nodes, way = [];
        while (owner[node] === -1 && parents[node]) {
            way.push(node);
            node = parents[node] - 1;
        }
        const found = owner[node] === -1 ? -2 : owner[node];
        for (const passed of way) owner[passed] = found;
        return found;
    }
    #stroke(context, points, from, to, colour, width) {
        trace(context, points, from, to);
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.stroke();
    }
}

/* The axis that points up, of a scene in space. */
async function upOf(scene) { return await scene.dim() === 3 ? scene.up() : 2; }

async function groupNames(scene) {
    const [arrays, groups] = await Promise.all([scene.arrays(), groupsOf(scene, NAMED)]);
    return { nameOf: (object) => groups[arrays.groups[object]]?.name ?? "" };
}

function inside(at, from, to, x, y) {
    let odd = false;
    for (let i = from, j = to - 1; i < to; j = i++) {
        const yi = at[2 * i + 1], yj = at[2 * j + 1];
        if (yi > y !== yj > y && x < (at[2 * j] - at[2 * i]) * (y - yi) / (yj - yi) + at[2 * i]) odd = !odd;
    }
    return odd;
}
function distance(at, i, j, x, y) {
    const ax = at[2 * i], ay = at[2 * i + 1], dx = at[2 * j] - ax, dy = at[2 * j + 1] - ay, square = dx * dx + dy * dy;
    const t = square ? Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / square)) : 0;
    return Math.hypot(x - ax - t * dx, y - ay - t * dy);
}
