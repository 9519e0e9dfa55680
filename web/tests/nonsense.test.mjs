// Nonsense: every method, with values of every wrong sort in every place, either answers or says in a sentence what is
// wrong; nothing breaks, and the right answers stay the same.
import assert from "node:assert/strict";
import { test } from "node:test";
import { FroeError, fresh } from "./support.mjs";

const VALUES = [undefined, null, true, -1, 0, 0.5, 3, 1e300, NaN, Infinity, 2n ** 70n, "", "nothing", Symbol("s"), [], [1], [1, 2, 3], [0, 0, 1, 1],
    ["a"], [null], {}, { length: 1e9 }, { lo: 1 }, () => 1, new Float64Array(4), new Float64Array(3).fill(NaN), new Uint8Array(2), new BigInt64Array(2),
    new ArrayBuffer(8), new DataView(new ArrayBuffer(8)), new Date(0), Object.create(null)];
/** Members of options, so that each is tried with each value, too. */
const OPTIONS = {
    add: ["kind", "coords", "count", "indices", "starts", "radii", "tags", "faces", "groups", "group", "times", "controls", "secondControls", "vertices",
        "bodies", "births", "deaths", "vertexCount", "pointCount", "nothing"],
    build: ["method", "purpose", "settings", "leaf", "seed", "order", "orderCount", "maxFragments"],
    range: ["shape", "points", "offsets", "radius", "eps", "walk", "count"],
    render: ["format", "eye", "fov", "scale", "width", "height", "margin", "shading", "section", "sectionPlane", "lines", "lineStyles",
        "lineStyleCount", "opacity", "priorities", "background", "decimals", "ids", "layers", "title", "paint", "seamWidth"],
    renderTurning: ["count", "seconds"],
    addGroup: ["name", "colour", "left"], addBody: ["times", "coords", "turns"], nearest: ["k", "bound"], ray: ["tMax"], cells: ["box", "inner"],
    cuts: ["box"], read: ["files", "faces", "boxes"], motion: ["begin", "end", "dim", "tick"], partition: ["seed", "order", "epoch"],
    contacts: ["from", "to", "first"], snapshot: ["refuse"], advance: ["instants"], audit: ["exactOnly"], pairs: ["shared"],
};
const GOOD = {
    add: [{ kind: "segment", coords: [0, 0, 1, 1], starts: [0, 2, 4], times: [0, 8, 0, 8] }], build: [{}], range: [{ shape: "ball", points: [0, 0], radius: 1 }],
    nearest: [[0, 0], {}], ray: [[0, 0], [1, 1], {}], read: ["a.csv", new TextEncoder().encode("x,y\n1,2\n"), {}],
    motion: [{ begin: 0, end: 8 }], addBody: [{ times: [0], coords: [0, 0] }], addGroup: [{}], advance: [1, {}],
};

function methods(object) {
    const names = new Set();
    for (let at = object; at !== Object.prototype; at = Object.getPrototypeOf(at))
        for (const [name, { value }] of Object.entries(Object.getOwnPropertyDescriptors(at)))
            if (typeof value === "function" && name !== "constructor" && name !== "free") names.add(name);
    return [...names];
}

test("no argument of any method breaks anything", async () => {
    const froe = await fresh(), plane = () => froe.segments([0, 0, 1, 1, 0, 1, 1, 0]), moving = () => froe.generateMotion("moving", 4);
    const kinds = {
        froe: () => froe, scene: plane, tree: () => plane().build(), model: () => froe.triangles([0, 0, 0, 1, 0, 0, 0, 1, 0]).build(),
        motion: moving, partition: () => moving().partition(),
    };
    const bad = [];
    let calls = 0;
    const tried = (where, call) => {
        calls++;
        try {
            call();
        } catch (error) {
            const own = error instanceof FroeError || error instanceof TypeError || error instanceof RangeError;
            const said = own && /^\S.{8,}\.$/s.test(error.message) && !/undefined \(|is not a function|not iterable|WebAssembly|Cannot convert|object null/.test(error.message);
            if (!said) bad.push(`${where}: ${error}`);
        }
    };
    const shown = (value) => { try { return typeof value === "symbol" ? "a symbol" : `${value?.constructor?.name} ${JSON.stringify(value, (_, v) => (typeof v === "bigint" ? `${v}n` : v))}`; } catch { return typeof value; } };
    for (const [kind, make] of Object.entries(kinds))
        for (const name of methods(make())) {
            const object = make(), good = GOOD[name] ?? [];
            for (const value of VALUES)
                for (let place = 0; place < 3; place++) {
                    const args = [...good];
                    args[place] = value;
                    tried(`${kind}.${name}(${place}: ${shown(value)})`, () => object[name](...args));
                }
            for (const option of OPTIONS[name] ?? [])
                for (const value of VALUES) {
                    const args = good.length ? [...good] : [{}], last = args.length - 1;
                    args[last] = { ...args[last], [option]: value };
                    tried(`${kind}.${name}({ ${option}: ${shown(value)} })`, () => object[name](...args));
                }
        }
    assert.ok(calls > 10000, `${calls} calls`);
    assert.deepEqual(bad.slice(0, 40), [], `${bad.length} of ${calls}`);
    assert.deepEqual([...plane().build().pairs().kinds], ["cross"]);
});
