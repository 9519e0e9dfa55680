// Memory: it grows where it must and no further, what is freed is used again, and a page that has no more is told so.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { FroeError, fresh, lists, root } from "./support.mjs";

const froe = await fresh();
const model = readFileSync(join(root, "data/bracket.off"));

test("arrays of many megabytes: a tree of half a million segments answers as one of each tenth of them", () => {
    const coords = new Float64Array(4 * 500000);
    for (let i = 0, state = 1; i < coords.length; i += 4) {
        const next = () => (state = (state * 48271) % 2147483647) / 2147483647;
        const x = next(), y = next();
        coords.set([x, y, x + 0.001 * next(), y + 0.001 * next()], i);
    }
    const boxes = Array.from({ length: 50 }, (_, i) => [i / 50, 0.3, i / 50 + 0.002, 0.31]).flat(), found = boxes.map(() => []).slice(0, 50);
    const tree = froe.segments(coords).build({ purpose: "query" });
    for (let part = 0; part < 10; part++)
        lists(froe.segments(coords.subarray(200000 * part, 200000 * (part + 1))).build({ purpose: "query" }).query(boxes))
            .forEach((ids, i) => found[i].push(...ids.map((id) => id + 50000 * part)));
    assert.ok(found.flat().length > 200);
    assert.deepEqual(lists(tree.query(boxes)), found);
    assert.ok(froe.memory > 64 << 20);
    assert.equal(froe.generate("segments", 200000).objectCount, 200000);
});

test("a hundred files read, built, asked, drawn and moved take no more memory than ten", async () => {
    const froe = await fresh();
    const once = () => {
        const scene = froe.read("bracket.off", model), tree = scene.build({ purpose: "draw" });
        tree.ray([0, 0, 0], [1, 1, 1]);
        tree.render({ format: "pdf" });
        tree.nodes(), tree.cells(), tree.cuts(), tree.pieces();
        const again = froe.open(tree.save()), motion = froe.generateMotion("moving", 20), partition = motion.partition();
        partition.advance(5);
        partition.snapshot().tree.free();
        assert.throws(() => froe.read("wrong.off", model.subarray(0, 500)), FroeError);
        assert.throws(() => tree.render({ title: "", width: -1 }), FroeError);
        for (const it of [scene, tree, again, motion, partition]) it.free();
    };
    for (let i = 0; i < 10; i++) once();
    const before = froe.memory;
    for (let i = 0; i < 90; i++) once();
    assert.equal(froe.memory, before);
});

test("what is forgotten is freed, in any order", async () => {
    setFlagsFromString("--expose-gc");
    const collect = runInNewContext("gc"), froe = await fresh();
    let forgotten = 0;
    const registry = new FinalizationRegistry(() => forgotten++);
    const once = () => {
        const partition = froe.generateMotion("moving", 300).partition(), tree = froe.generate("segments", 20000).build();
        tree.query([0, 0, 1, 1]);
        for (const it of [partition, tree]) registry.register(it);
        return [partition.time, tree.scene.objectCount];
    };
    const turn = () => new Promise((done) => setTimeout(done, 5)); // finalizers run between two
    const round = async () => {
        for (let i = 0; i < 4; i++) once();
        forgotten = 0;
        for (let tries = 0; forgotten < 8 && tries < 400; tries++) {
            collect();
            await turn();
        }
        assert.equal(forgotten, 8);
        for (let more = 0; more < 10; more++) await turn(); // finalizers of other registries may be some turns later
    };
    for (let i = 0; i < 3; i++) await round();
    const before = froe.memory;
    for (let i = 0; i < 8; i++) await round();
    assert.equal(froe.memory, before);
});

test("what was made of something stays in use when that is freed", async () => {
    const froe = await fresh(), scene = froe.segments([0, 0, 2, 2, 0, 2, 2, 0]), tree = scene.build(), motion = froe.generateMotion("moving", 20);
    const partition = motion.partition(), own = tree.scene;
    scene.free();
    motion.free();
    tree.query([0, 0, 1, 1]);
    tree.free();
    assert.equal(own.objectCount, 2);
    partition.advance(1);
    partition.audit();
    for (const [gone, what] of [[() => scene.dim, "scene"], [() => motion.window, "motion"], [() => tree.report, "tree"]])
        assert.throws(gone, (error) => error.status === "FROE_E_ARG" && error.message === `The ${what} has been freed.`);
    partition.free();
    partition[Symbol.dispose]();
    assert.throws(() => partition.time, /freed/);
});

test("a page without memory throws, wherever that is, and goes on when there is some", async () => {
    let step = "";
    const work = (froe, n) => {
        const kept = [], sums = [];
        const keep = (name, make) => { step = name; kept.push(make()); return kept.at(-1); };
        const sum = (name, count) => { step = name; sums.push(count()); };
        try {
            const tree = keep("build", () => keep("scene", () => froe.generate("segments", n)).build({ purpose: "query" }));
            sum("query", () => tree.query([0, 0, 1, 1]).ids.length);
            sum("pieces", () => tree.pieces().coords.length);
            sum("cells", () => tree.cells().nodes.length);
            const saved = tree.save();
            keep("open", () => froe.open(saved));
            sum("pairs", () => tree.pairs().a.length);
            const partition = keep("partition", () => keep("motion", () => froe.generateMotion("moving", n / 30)).partition());
            sum("snapshot", () => keep("snapshot", () => partition.snapshot().tree).report.nodes);
            return sums;
        } finally {
            for (const it of kept) it.free();
        }
    };
    const { grow } = WebAssembly.Memory.prototype, steps = new Set(), froe = await fresh(), right = work(froe, 3000);
    const without = (body) => {
        WebAssembly.Memory.prototype.grow = () => { throw new RangeError("no memory"); };
        try {
            body();
            return true;
        } catch (error) {
            assert.ok(error instanceof FroeError && error.status === "FROE_E_MEMORY" && /memory.*\.$/.test(error.message), error.stack);
            return false;
        } finally {
            WebAssembly.Memory.prototype.grow = grow;
        }
    };
    // What is full is emptied bit by bit, until the work can be done.
    const ballast = [], places = Float64Array.from({ length: 2000 }, (_, i) => i);
    while (without(() => ballast.push(froe.points(places.map((x) => x + 2000 * ballast.length)))));
    assert.ok(ballast.length > 50);
    while (!without(() => assert.deepEqual(work(froe, 3000), right))) {
        steps.add(step);
        for (const scene of ballast.splice(-3)) scene.free();
    }
    assert.ok(steps.size >= 3, [...steps].join());
    for (const scene of ballast) scene.free();
    assert.deepEqual(work(froe, 3000), right);
});
