// The npm package under Node: answers, errors, and the same trees and pictures as the program's.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { FroeError, NONE, fresh as load, lists, program, scratch } from "./support.mjs";

// Both are loaded before the first test: the runner takes a pause between two tests for the end.
const kinds = [["simd", await load()], ["plain", await load({ plain: true })]];
for (const [kind, froe] of kinds) {
    const name = (what) => `${what} (${kind})`;
    const cross = () => froe.segments([0, 0, 1, 1, 0, 1, 1, 0, 5, 5, 6, 6]).build({ purpose: "query" });

    test(name("questions about three segments"), () => {
        const tree = cross();
        assert.equal(tree.report.objects, 3);
        assert.deepEqual(lists(tree.query([0, 0, 2, 2, 5, 5, 7, 7, 8, 8, 9, 9])), [[0, 1], [2], []]);
        assert.deepEqual([...tree.range({ shape: "ball", points: [0, 0], radius: 1 })].sort(), [0, 1]);
        assert.deepEqual([...tree.range({ shape: "ball", points: [2, 2], radius: Math.SQRT2 * (1 - 1e-15) })], []);
        assert.deepEqual(tree.pairs(), { a: Uint32Array.of(0), b: Uint32Array.of(1), kinds: ["cross"] });
        assert.deepEqual(tree.ray([0.5, -1, 9, 9], [0, 1, 1, 0]), { objects: Uint32Array.of(0, NONE), t: Float64Array.of(1.5, Infinity) });
        assert.deepEqual([...tree.above([0.25, 0, 5.5, 0, 9, 9])], [0, 2, NONE]);
        const near = tree.nearest([3, 3], { k: 2 });
        assert.deepEqual([[...near.ids], [...near.values]], [[0, 2], [Math.sqrt(8), Math.sqrt(8)]]);
        tree.audit();
    });

    test(name("windows as by comparing every box, on axis-parallel segments"), () => {
        let state = 1;
        const next = () => (state = (state * 48271) % 2147483647) % 64;
        const coords = new Float64Array(4 * 500);
        for (let i = 0; i < 500; i++) {
            const x = next(), y = next(), length = next() % 9;
            coords.set(i % 2 ? [x, y, x + length, y] : [x, y, x, y + length], 4 * i);
        }
        const boxes = new Float64Array(4 * 300).map((_, i) => (i % 4 < 2 ? next() : 0));
        for (let i = 0; i < 300; i++) {
            boxes[4 * i + 2] = boxes[4 * i] + next() % 7;
            boxes[4 * i + 3] = boxes[4 * i + 1] + next() % 7;
        }
        const meets = (s, b) => coords[4 * s] <= boxes[4 * b + 2] && coords[4 * s + 2] >= boxes[4 * b] &&
            coords[4 * s + 1] <= boxes[4 * b + 3] && coords[4 * s + 3] >= boxes[4 * b + 1];
        const right = Array.from({ length: 300 }, (_, b) => [...Array(500).keys()].filter((s) => meets(s, b)));
        for (const method of ["index", "density", "cylindrical"]) {
            const tree = froe.segments(coords).build({ method });
            assert.deepEqual(lists(tree.query(boxes)), right, method);
            const again = froe.open(tree.save());
            assert.deepEqual(lists(again.query(boxes)), right, method);
        }
    });

    test(name("trees and pictures are those of the program, byte for byte"), () => {
        const scene = froe.generate("terrain", 1500), tree = scene.build({ method: "grain" });
        writeFileSync(scratch("page.froe"), tree.save());
        writeFileSync(scratch("own.svg"), tree.render({ shading: "cel", title: "Hills", hidden: true }).bytes);
        program("generate", "terrain", "-n", "1500", "-o", "terrain.obj");
        program("build", "terrain.obj", "--method", "grain", "-o", "program.froe");
        const pieces = (file) => JSON.parse(program("check", file, "--json")).tree ?? JSON.parse(program("info", file, "--json"));
        assert.deepEqual(pieces("page.froe").fragments, pieces("program.froe").fragments);
        program("render", "page.froe", "-o", "program.svg", "--style", "cel", "--title", "Hills", "--hidden", "dashed");
        assert.ok(readFileSync(scratch("own.svg")).equals(readFileSync(scratch("program.svg"))));
    });

    test(name("what is wrong is told, and nothing is lost"), () => {
        const told = (call, status, pattern) => assert.throws(call, (error) =>
            error instanceof FroeError && error.status === status && pattern.test(error.message));
        told(() => froe.segments([0, 0, 1, 1, 2, 2, NaN, 3]), "FROE_E_INPUT", /segment 1/);
        told(() => cross().query([1, 0, 0, 1]), "FROE_E_INPUT", /./);
        told(() => cross().render(), "FROE_E_UNSUPPORTED", /./);
        told(() => froe.generate("nothing", 5), "FROE_E_OPTIONS", /nothing/);
        told(() => froe.segments([0, 0, 1, 1]).build({ method: "nothing" }), "FROE_E_OPTIONS", /nothing/);
        told(() => froe.segments([0, 0, 1, 1]).build({ colour: 1 }), "FROE_E_OPTIONS", /colour/);
        told(() => froe.segments([0, 0, 1, 1]).build({ leaf: 0.5 }), "FROE_E_OPTIONS", /leaf/);
        told(() => froe.open(Uint8Array.of(1, 2, 3)), "FROE_E_FORMAT", /./);
        told(() => froe.read("a.obj", new TextEncoder().encode("v 0 0\nf 1 2 3\n")), "FROE_E_FORMAT", /a\.obj/);
        assert.throws(() => froe.segments([0, 0, 1]), /no whole segments/);
        assert.throws(() => cross().query([0, 0, 1]), /boxes has 3 numbers/);
        assert.throws(() => froe.scene(2).add({ kind: "hull", coords: [0, 0], starts: [0, 5] }), /only 1 is given/);
        assert.throws(() => froe.scene(2).add({ kind: "ball", coords: [0, 0] }), /radii/);
        // Numbers that an array of whole numbers would make others of.
        assert.throws(() => froe.triangles([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2 ** 32 + 2]), /Number 2 of indices is 4294967298/);
        assert.throws(() => froe.segments([0, 0, 1, 1], { groups: [-1] }), /Number 0 of groups is -1/);
        assert.throws(() => froe.segments([0, 0, 1, 1], { tags: [2n ** 64n] }), /Number 0 of tags/);
        assert.throws(() => froe.segments([0, 0, 1, "1"]), /Number 3 of coords is '1'/);
        assert.throws(() => cross().nearest([0, 0], { number: 2 }), /no option number/);
        const tree = cross();
        tree.free();
        tree.free();
        told(() => tree.query([0, 0, 1, 1]), "FROE_E_ARG", /freed/);
        assert.deepEqual(lists(cross().query([0, 0, 1, 1])), [[0, 1]]);
    });

    test(name("files of text, groups and areas"), () => {
        const ring = { type: "FeatureCollection", features: [{ type: "Feature", properties: { name: "square" },
            geometry: { type: "Polygon", coordinates: [[[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]], [[1, 1], [1, 2], [2, 2], [2, 1], [1, 1]]] } }] };
        const scene = froe.read("map.geojson", new TextEncoder().encode(JSON.stringify(ring)));
        assert.equal(scene.group(0).name, "square");
        const tree = scene.build({ purpose: "query" });
        assert.deepEqual(lists(tree.groups([3, 3, 1.5, 1.5, 1, 1, 9, 9])), [[0], [], [0], []]);
        assert.equal(tree.cells().nodes.length, tree.report.leaves);
        assert.equal(tree.pieces().objects.length, tree.report.fragments);
    });
}
