// The worker of the package: the same calls from afar, arrays that move, refusals, and an end at once.
import assert from "node:assert/strict";
import { join } from "node:path";
import { after, test } from "node:test";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { pathToFileURL } from "node:url";

const { FroeWorker, moved } = await import(pathToFileURL(join(process.env.FROE_PACKAGE, "worker.js")).href);
setFlagsFromString("--expose-gc");
const collect = runInNewContext("gc"), shares = [];
const worker = await FroeWorker.start({ progress: (share) => shares.push(share) });
after(() => worker.end());

test("a tree is built, asked and drawn from afar", async () => {
    const tree = await (await worker.froe.segments([0, 0, 1, 1, 0, 1, 1, 0, 5, 5, 6, 6])).build({ purpose: "query" });
    assert.equal((await tree.report()).objects, 3);
    const answers = await tree.query([0, 0, 2, 2, 5, 5, 7, 7]);
    assert.deepEqual([...answers].map((ids) => [...ids].sort()), [[0, 1], [2]]);
    const hills = await (await worker.froe.generate("terrain", 3000)).build({ purpose: "pieces" });
    assert.match((await hills.render({ title: "Hills" })).text, /^<svg[^>]*>\s*<title>Hills/);
    assert.ok(shares.length > 0 && shares.every((share) => share >= 0 && share <= 1));
});

test("arrays are copied, or moved where that is said", async () => {
    const copied = Float64Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0), gone = moved(copied.slice());
    assert.equal(await (await worker.froe.triangles(copied)).objectCount(), 1);
    assert.equal(await (await worker.froe.triangles(gone)).objectCount(), 1);
    assert.deepEqual([copied.length, gone.length], [9, 0]);
});

test("what cannot be done is told as froe tells it", async () => {
    const scene = await worker.froe.segments([0, 0, 1, 1]);
    await assert.rejects(scene.build({ method: "nothing" }), { name: "FroeError", status: "FROE_E_OPTIONS", message: /nothing/ });
    await assert.rejects(scene.nothing(), { name: "TypeError", message: /no nothing in a Scene/ });
    await assert.rejects(worker.froe.segments([0, 0, 1]), TypeError);
    await scene.free();
    await assert.rejects(scene.objectCount(), { status: "FROE_E_ARG" });
});

test("what cannot be sent is refused at once, and the worker goes on", async () => {
    const gone = moved(new Float64Array(4)), shared = moved(new Float64Array(new SharedArrayBuffer(32)));
    await worker.froe.segments(gone);
    await assert.rejects(worker.froe.segments(gone), { name: "TypeError", message: /moved to somewhere else/ });
    await assert.rejects(worker.froe.progress(() => true), { name: "TypeError", message: "A worker cannot be given a function." });
    await assert.rejects(worker.froe.scene(9), { name: "RangeError", message: /2 to 8 dimensions/ });
    const scene = await worker.froe.segments(shared);
    assert.equal(await scene.objectCount(), 1);
    assert.equal(JSON.stringify({ scene }), '{"scene":{}}'); // which calls no method
    await scene.free();
    await scene.free();
    await assert.rejects(FroeWorker.start({ progress: 5 }), { name: "TypeError", message: "progress is not a function, but 5." });
    await assert.rejects(FroeWorker.start({ plian: true }), { name: "TypeError", message: "There is no option plian." });
});

test("a scene lives as long as one of its remotes", async () => {
    const scene = await worker.froe.scene(2);
    for (let i = 0; i < 20; i++) {
        await scene.add({ kind: "segment", coords: [i, 0, i, 1] }); // the remote that add() gives is dropped
        collect();
        await new Promise((resume) => setTimeout(resume, 5));
    }
    assert.equal(await scene.objectCount(), 20);
});

test("an end refuses what was asked, and what is asked later", async () => {
    const other = await FroeWorker.start(), scene = await other.froe.generate("segments", 200000), tree = scene.build({ purpose: "pieces" });
    other.end();
    await assert.rejects(tree, { status: "FROE_E_CANCELLED" });
    await assert.rejects(scene.objectCount(), { status: "FROE_E_CANCELLED" });
    assert.ok(other.ended);
});
