// Trees and motions as arrays: nodes, pieces, cells, cuts, objects and places that fit one another.
import assert from "node:assert/strict";
import { test } from "node:test";
import { froe as module } from "./support.mjs";

const { CUTS, EVENTS, KINDS, NONE, load } = module;
const froe = await load();
const scenes = { "plane": froe.generate("rooms", 60), "space": froe.generate("rooms-3d", 60) };

for (const [place, scene] of Object.entries(scenes))
    for (const { name: method } of scene.methods())
        test(`nodes, pieces, cells and cuts fit one another: ${method} in the ${place}`, () => {
            const tree = scene.build({ method }), { report, dim } = tree, nodes = tree.nodes(), pieces = tree.pieces();
            const cells = tree.cells(), cuts = tree.cuts(), count = report.nodes;
            assert.equal(nodes.cuts.length, count);
            assert.equal(nodes.pieceCounts.reduce((sum, n) => sum + n, 0), report.fragments);
            assert.equal(nodes.cuts.filter((cut) => CUTS[cut] === "none").length, report.leaves);
            assert.equal(Math.max(...nodes.depths), report.height);
            const inCuts = nodes.pieceCounts.reduce((sum, n, i) => sum + (nodes.cuts[i] ? n - nodes.coverCounts[i] : 0), 0);
            assert.equal(inCuts, report.inCut);
            for (let i = 0; i < count; i++) {
                assert.equal(nodes.cuts[i] === 0, nodes.children[2 * i] === 0);
                for (const child of nodes.children.subarray(2 * i, 2 * i + 2)) if (child) assert.equal(nodes.parents[child - 1], i + 1);
                for (let p = nodes.firstPieces[i]; p < nodes.firstPieces[i] + nodes.pieceCounts[i]; p++)
                    assert.equal(pieces.nodes[p], i + 1);
            }
            assert.equal(pieces.coords.length, dim * pieces.starts.at(-1));
            assert.equal(cells.coords.length, dim * cells.starts[cells.faces.at(-1)]);
            cells.nodes.forEach((node, i) => {
                assert.equal(nodes.children[2 * (node - 1)], 0);
                assert.equal(nodes.depths[node - 1], cells.depths[i]);
            });
            assert.equal(cuts.starts.length, cuts.nodes.length + 1);
            assert.equal(cuts.coords.length, dim * cuts.starts.at(-1));
            cuts.nodes.forEach((node, i) => {
                assert.equal(nodes.depths[node - 1], cuts.depths[i]);
                assert.ok(dim === 3 || cuts.starts[i + 1] - cuts.starts[i] === 2);
                if (CUTS[nodes.cuts[node - 1]] !== "axis") return;
                for (let c = cuts.starts[i]; c < cuts.starts[i + 1]; c++)
                    assert.equal(cuts.coords[dim * c + nodes.axes[node - 1]], nodes.values[node - 1]);
            });
        });

test("every promise of the method is kept and told", () => {
    const { promises } = scenes.plane.build({ method: "density" }).report;
    assert.ok(promises.length > 0);
    for (const { name, promised, measured } of promises) assert.ok(name && measured <= promised);
});

test("what questions cost is told once", () => {
    const tree = scenes.plane.build({ method: "kd" });
    tree.query([0, 0, 1, 1, 0, 0, 2, 2]);
    const { queries, nodes, leaves } = tree.statistics();
    assert.equal(queries, 2);
    assert.ok(nodes >= leaves && leaves >= 2);
    assert.equal(tree.statistics().nodes, 0);
});

test("a scene gives back what it was given, and groups", () => {
    const scene = froe.scene(3), walls = scene.addGroup({ name: "wände", material: "brick", left: "inside", colour: 0x80ff00ff });
    scene.add({ kind: "polygon", coords: [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], starts: [0, 4], group: walls, tags: [7n] });
    scene.add({ kind: "ball", coords: [5, 5, 5], radii: [2], tags: [2n ** 63n] });
    const { coords, kinds, starts, corners, radii, tags, groups } = scene.arrays();
    assert.deepEqual(Array.from(kinds, (kind) => KINDS[kind]), ["polygon", "ball"]);
    assert.deepEqual([...starts], [0, 4, 5]);
    assert.deepEqual([...corners.subarray(0, 4)].flatMap((v) => [...coords.subarray(3 * v, 3 * v + 2)]), [0, 0, 1, 0, 1, 1, 0, 1]);
    assert.deepEqual([[...radii], [...tags], [...groups]], [[0, 2], [7n, 2n ** 63n], [0, NONE]]);
    assert.deepEqual(scene.group(walls), { name: "wände", material: "brick", left: "inside", right: "", colour: 0x80ff00ff });
    assert.deepEqual(scene.bounds(), { lo: Float64Array.of(0, 0, 0), hi: Float64Array.of(7, 7, 7) });
    scene.up = 1;
    assert.equal(scene.up, 1);
});

test("defects are counted, with an example", () => {
    const { crossings, tJunctions, duplicates, zeroLength, firstCrossing, firstTJunction, firstOverlap } =
        froe.segments([0, 0, 2, 2, 0, 2, 2, 0, 0, 0, 2, 2, 1, 1, 1, 1, 5, 5, 6, 6, 5.5, 5.5, 5.5, 9]).defects();
    assert.deepEqual([crossings > 0, tJunctions, duplicates, zeroLength], [true, 1, 1, 1]);
    assert.deepEqual([firstCrossing, firstTJunction, firstOverlap], [[0, 1], [4, 5], null]);
});

test("a ray's place, the nearest point, and relations of areas", () => {
    const tree = froe.triangles([0, 0, 1, 4, 0, 1, 0, 4, 1], [0, 1, 2]).build({ purpose: "query" });
    assert.deepEqual(tree.hitPlace(0, [1, 1, 5], [0, 0, -2]),
        { point: Float64Array.of(1, 1, 1), normal: Float64Array.of(0, 0, 1), distance: 4 });
    assert.deepEqual([...tree.nearestPoint(0, [1, 1, 9])], [1, 1, 1]);
    assert.deepEqual([...tree.rayAny([1, 1, 5, 9, 9, 5], [0, 0, -2, 0, 0, -1])], [0, NONE]);
    assert.deepEqual([...tree.rayAll([1, 1, 5], [0, 0, -2]).valuesAt(0)], [2]);
    const square = froe.scene(2), group = square.addGroup({ name: "square" });
    const areas = square.add({ kind: "segment", coords: [0, 0, 4, 0, 4, 0, 4, 4, 4, 4, 0, 4, 0, 4, 0, 0], group }).build();
    assert.deepEqual([...areas.groupsOf({ points: [1, 1, 2, 2] })], [0]);
    assert.deepEqual([...areas.groupsOf({ points: [1, 1, 2, 2] }, "covers")], [0]);
    assert.deepEqual([...areas.groupsOf({ points: [1, 1, 2, 2] }, "within")], []);
    assert.deepEqual([...areas.groupsOf({ points: [-1, -1, 5, 5] }, "within")], [0]);
});

test("objects that move, their places, and a partition that is asked and changed", () => {
    const motion = froe.motion({ begin: 0, end: 8, tick: 0.25 }), group = motion.addGroup({ name: "right" });
    motion.add({ starts: [0, 2, 4], times: [0, 8, 0, 8], coords: [0, 0, 8, 0, 0, 1, 8, 1], group, tags: [9n] });
    motion.add({ starts: [0, 1, 2], times: [0, 0], coords: [3, 3, 5, 3], births: [1], deaths: [7] });
    assert.deepEqual(motion.window, { dim: 2, begin: 0, end: 8, tick: 0.25 });
    assert.deepEqual([motion.objectCount, motion.vertexCount, motion.groupCount, motion.group(0).name], [2, 4, 1, "right"]);
    assert.deepEqual(motion.objects(), { vertices: Uint32Array.of(0, 1, 2, 3), births: Float64Array.of(0, 1),
        deaths: Float64Array.of(8, 7), groups: Uint32Array.of(0, NONE), tags: BigUint64Array.of(9n, 1n) });
    assert.deepEqual([...motion.positions(2)], [2, 0, 2, 1, 3, 3, 5, 3]);
    assert.ok(motion.positions(9).subarray(0, 4).every(Number.isNaN));

    const partition = motion.partition();
    partition.advance(3.5);
    assert.deepEqual(partition.locate([4, 2]), { on: null, above: 1, below: null });
    assert.equal(partition.ray([0, 0.5], [9, 0.5]), 0);
    assert.equal(partition.ray([0, 9], [9, 9]), null);
    assert.deepEqual([...partition.order([0, 0.5]).objects].sort().at(0), 0);
    partition.remove(1);
    assert.deepEqual(partition.locate([4, 2]).above, null);
    motion.add({ starts: [0, 1, 2], times: [0, 0], coords: [3, 4, 5, 4] });
    partition.update();
    assert.deepEqual(partition.locate([4, 2]).above, 2);
    partition.audit();

    const space = froe.motion({ dim: 3, begin: 0, end: 2 });
    const body = space.addBody({ times: [0, 2], coords: [0, 0, 0, 2, 0, 0], turns: [0, 0, 0, 1, 0, 0, 1, 0].map((x, i) => (i > 3 ? [0, 0, 0.6, 0.8][i - 4] : x)) });
    space.add({ starts: [0, 1, 2, 3], times: [0, 0, 0], coords: [0, 0, 0, 1, 0, 0, 0, 1, 0], bodies: [body, body, body] });
    assert.deepEqual([...space.positions(0)], [0, 0, 0, 1, 0, 0, 0, 1, 0]);
    assert.equal(space.positions(1)[0], 1);
    assert.throws(() => space.partition(), (error) => error.status === "FROE_E_UNSUPPORTED");
    const { motion: curved, reached } = space.withoutBodies(0.01);
    assert.ok(reached > 0 && reached <= 0.01);
    assert.deepEqual([curved.bodyCount, curved.vertexCount, curved.objectCount], [0, 3, 1]);
    const away = curved.positions(1.3).map((x, i) => Math.abs(x - space.positions(1.3)[i]));
    assert.ok(Math.max(...away) <= reached);
    assert.ok(curved.partition().advance(2).kinds.length > 0);
    assert.throws(() => space.withoutBodies(0), (error) => error.status === "FROE_E_ARG");
    assert.equal(froe.motion({ begin: 0, end: 1 }).withoutBodies(1).motion.bodyCount, 0);

    const plane = froe.motion({ begin: 0, end: 4 }), hand = plane.addBody({ times: [0, 4], coords: [0, 0, 0, 0], turns: [0, 1, Math.SQRT1_2, Math.SQRT1_2] });
    plane.add({ starts: [0, 1, 2], times: [0, 0], coords: [1, 0, 5, 0], bodies: [hand, hand] });
    plane.add({ starts: [0, 1, 2], times: [0, 0], coords: [3, 4, 9, 4] });
    assert.equal(plane.contacts().a.length, 1);
    assert.ok(plane.partition().advance(4).kinds.length > 0);
    assert.throws(() => plane.addBody({ times: [0], coords: [0] }), TypeError);
});

test("vertices fly straight, along parabolas and along cubics", () => {
    const meets = (more) => { // -1 + 8 t, -1 + 8 t^2 or -1 + 8 t^3 is 0
        const motion = froe.motion({ begin: 0, end: 1 });
        motion.add({ starts: [0, 2, 4], times: [0, 1, 0, 1], coords: [0, -1, 0, 7, 0, -1, 0, 7], ...more });
        motion.add({ starts: [0, 2, 4], times: [0, 1, 0, 1], coords: [-1, 0, -1, 0, 1, 0, 1, 0] });
        const again = froe.readMotion("again.json", motion.write()).contacts().begins;
        assert.deepEqual(motion.contacts().begins, again);
        return again;
    };
    const low = [0, -1, 0, -1, 0, -1, 0, -1], none = new Array(8).fill(NaN);
    assert.deepEqual([...meets({})], [0.125, 0.125]);
    const [before, after] = meets({ controls: low });
    assert.ok(before <= Math.SQRT1_2 / 2 && Math.SQRT1_2 / 2 <= after && after - before < 1e-15);
    assert.deepEqual([...meets({ controls: low, secondControls: none })], [before, after]);
    assert.deepEqual([...meets({ controls: low, secondControls: low })], [0.5, 0.5]);
    assert.throws(() => meets({ secondControls: low }), (error) => error.status === "FROE_E_INPUT");
    assert.throws(() => meets({ controls: low, secondControls: [1] }), TypeError);
});

test("events in space are about edges of triangles, as seen from above", () => {
    const motion = froe.motion({ dim: 3, begin: 0, end: 8 });
    motion.add({ starts: [0, 1, 2, 3], times: [0, 0, 0], coords: [0, 0, 0, 4, 0, 0, 0, 4, 0] });
    motion.add({ starts: [0, 2, 4, 6], times: [0, 8, 0, 8, 0, 8], coords: [-9, 0.5, 2, 7, 0.5, 2, -8, 0.5, 2, 8, 0.5, 2, -9, 1.5, 3, 7, 1.5, 3] });
    const partition = motion.partition(), events = partition.advance(8);
    assert.ok(events.kinds.length > 3);
    assert.equal(events.edges.length, 4 * events.kinds.length);
    const of = (list, counts, i) => [...list.subarray(4 * i, 4 * i + Math.min(4, counts[i]))];
    let about = 0;
    for (let i = 0; i < events.kinds.length; i++) {
        const objects = of(events.objects, events.counts, i), edges = of(events.edges, events.edgeCounts, i);
        assert.ok(objects.every((object) => object < 2) && edges.every((edge) => objects.includes(Math.floor(edge / 3))), EVENTS[events.kinds[i]]);
        assert.ok(events.early[i] < events.late[i] && (i === 0 || events.late[i - 1] <= events.late[i]));
        about += edges.length;
    }
    assert.ok(about > 0);
    assert.equal(Object.values(partition.statistics().events).reduce((sum, count) => sum + count), events.kinds.length);
    const steps = motion.partition();
    let count = 0;
    for (let told; (told = steps.step()).kinds.length;) count += told.kinds.length;
    assert.equal(count, events.kinds.length);
});
