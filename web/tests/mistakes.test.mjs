// Mistakes: what is given in a wrong way is refused in words that name it, and nothing is guessed, lost or broken.
import assert from "node:assert/strict";
import { test } from "node:test";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import { FroeError, fresh, froe as module } from "./support.mjs";

const froe = await fresh(), bytes = (text) => new TextEncoder().encode(text);
const cross = () => froe.segments([0, 0, 1, 1, 0, 1, 1, 0]).build();
const model = () => froe.generate("terrain", 30).build({ purpose: "draw" });
/** An array whose memory is somewhere else. */
function moved(array) {
    structuredClone(array.buffer, { transfer: [array.buffer] });
    return array;
}

test("there are no answers to questions that were not asked", () => {
    const answers = cross().nearest([0, 0, 5, 5]);
    for (const i of [2, -1, 0.5, NaN, undefined, "0"]) {
        assert.throws(() => answers.at(i), { name: "RangeError", message: /^There is no question .* among 2\.$/ }, String(i));
        assert.throws(() => answers.valuesAt(i), RangeError, String(i));
    }
    assert.deepEqual([answers.at(1).length, answers.valuesAt(1).length], [1, 1]);
});

test("an array that was moved away is not an empty one", () => {
    const gone = (name) => ({ name: "TypeError", message: `The memory of ${name} has been moved to somewhere else, or has shrunk.` });
    assert.throws(() => froe.segments(moved(new Float64Array(4))), gone("coords"));
    assert.throws(() => froe.segments(moved(new Float32Array(4))), gone("coords"));
    assert.throws(() => cross().query(moved(new Float64Array(4))), gone("boxes"));
    assert.throws(() => froe.open(moved(cross().save())), gone("bytes"));
    assert.throws(() => froe.read("a.csv", moved(bytes("x,y\n1,2\n"))), gone("the file 'a.csv'"));
    assert.equal(froe.segments(new Float64Array(new SharedArrayBuffer(32))).objectCount, 1);
    assert.equal(froe.segments(new Float64Array(0)).objectCount, 0);
    const buffer = new ArrayBuffer(64, { maxByteLength: 64 }), behind = new Float64Array(buffer, 32, 4), all = new Float64Array(buffer);
    buffer.resize(32);
    assert.throws(() => froe.segments(behind), gone("coords"));
    assert.equal(froe.segments(all).objectCount, 1);
    const memory = new WebAssembly.Memory({ initial: 1 }), old = new Float64Array(memory.buffer, 0, 4);
    memory.grow(1);
    assert.throws(() => froe.segments(old), gone("coords"));
});

test("a progress function cannot use the module in the midst of a call", async () => {
    const froe = await fresh(), scene = froe.generate("segments", 3000), tree = scene.build(), right = scene.build().save();
    const refused = [];
    const tries = [() => scene.free(), () => tree.query([0, 0, 1, 1]), () => tree.free(), () => froe.segments([0, 0, 1, 1]),
        () => froe.read("a.csv", bytes("x,y\n1,2\n")), () => scene.objectCount, () => froe.version];
    froe.progress = () => {
        for (const call of tries)
            try {
                call();
                refused.push("not refused");
            } catch (error) {
                refused.push(error instanceof FroeError && /progress function/.test(error.message) ? "refused" : error.message);
            }
    };
    const built = scene.build();
    froe.progress = null;
    assert.ok(refused.length >= tries.length);
    assert.deepEqual([...new Set(refused)], ["refused"]);
    assert.deepEqual(built.save(), right);
    assert.equal(tree.query([0, 0, 1, 1]).length, 1);
    scene.free();
});

test("what a progress function throws at the very end of a call loses no memory", async () => {
    setFlagsFromString("--expose-gc");
    const collect = runInNewContext("gc"), froe = await fresh(), scene = froe.generate("segments", 20000);
    const round = async () => {
        let told = 0;
        froe.progress = (share) => { if (share === 1 && ++told) throw new Error("mine"); };
        assert.throws(() => scene.build({ purpose: "query" }), /^Error: mine$/);
        assert.ok(told > 0);
        froe.progress = null;
        for (let turns = 0; turns < 20; turns++) {
            collect();
            await new Promise((done) => setTimeout(done, 5)); // finalizers run between two
        }
    };
    for (let i = 0; i < 4; i++) await round();
    const before = froe.memory;
    for (let i = 0; i < 40; i++) await round();
    assert.equal(froe.memory, before);
    assert.equal(scene.build().report.objects, 20000);
});

test("numbers are not rounded, and neither true nor -1 nor NaN stands for something else", () => {
    const scene = () => froe.segments([0, 0, 1, 1]), options = (pattern) => ({ name: "FroeError", status: "FROE_E_OPTIONS", message: pattern });
    assert.throws(() => scene().build({ seed: 2n ** 53n + 1n }), options(/^The option seed is 9007199254740992, not a whole number from 0 to 9007199254740991\.$/));
    assert.throws(() => scene().build({ seed: true }), options(/^The option seed does not take true\.$/));
    assert.throws(() => scene().build({ leaf: -1 }), options(/^The option leaf is -1, not a whole number from 0 to/));
    assert.throws(() => model().render({ background: -1 }), options(/background is -1/));
    assert.throws(() => model().render({ width: true }), options(/width does not take true/));
    assert.throws(() => model().render({ decimals: 0.5 }), options(/^The option decimals is 0\.5, not a whole number\.$/));
    assert.throws(() => model().render({ lineStyles: [{ visible: ["border"], width: NaN }] }), options(/^The option width is nan, not a number\.$/));
    assert.throws(() => froe.generateMotion("moving", 4).contacts({ from: NaN }), options(/^The option from is nan, not a number\.$/));
    assert.equal(scene().build({ seed: 2n ** 53n - 1n }).report.seed, 2 ** 53 - 1);
    assert.ok(model().render({ section: -1 }).bytes.length > 0);
    for (const [sectionPlane, told] of [[[0, 0, 0, 1], /length 0/], [[0, 0, NaN, 1], /Number 2 .* nan/], [[1, 0, 0, Infinity], /Number 3 .* inf/]])
        assert.throws(() => model().render({ sectionPlane }), { status: "FROE_E_ARG", message: told });
});

test("the scene of a tree tells how it was read", () => {
    const scene = froe.read("a.obj", bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")), tree = scene.build({ purpose: "draw" });
    assert.equal(scene.source.format, "OBJ");
    for (const one of [tree, tree.section([1, 0, 0, 0.5])]) assert.deepEqual(one.scene.source, scene.source);
    for (const one of [model(), froe.open(tree.save())]) assert.equal(one.scene.source, null);
});

test("a list of names is a list, and one name alone does not pass for one", () => {
    const tree = model(), names = (lines) => tree.render({ lines }).text;
    assert.throws(() => names("mesh"), { status: "FROE_E_OPTIONS", message: "The option lines does not take the text 'mesh'." });
    assert.throws(() => names(5), { status: "FROE_E_OPTIONS", message: /lines is no number/ });
    assert.throws(() => names(["nothing"]), { status: "FROE_E_OPTIONS", message: /lines does not have the value 'nothing'/ });
    assert.throws(() => tree.render({ title: ["a"] }), { status: "FROE_E_OPTIONS", message: /title is no list of names/ });
    assert.throws(() => tree.render({ lineStyles: [{ visible: "border", width: 5 }] }), { status: "FROE_E_OPTIONS", message: /visible does not take/ });
    assert.notEqual(names(["mesh"]), names([]));
    assert.equal(names(["border", "mesh"]), names(["mesh", "border", "mesh"]));
});

test("a range has the members of its shape, and no others", () => {
    const range = (options) => cross().range(options);
    assert.throws(() => range({ shape: "ball", points: [0, 0] }), { name: "TypeError", message: "A range of the shape ball needs the option radius." });
    assert.throws(() => range({ points: [0, 0, 1, 1], radius: 1 }), { name: "TypeError", message: "A range of the shape box takes no option radius." });
    assert.throws(() => range({ shape: "halfspaces", points: [1, 0] }), { name: "TypeError", message: /needs the option offsets\.$/ });
    assert.throws(() => range({ shape: "halfspaces", points: [1, 0], offsets: [1, 2] }), { name: "TypeError", message: "1 normal cannot have 2 offsets." });
    assert.throws(() => range({ shape: "hull", points: [1, 0], offsets: [1] }), { name: "TypeError", message: /takes no option offsets\.$/ });
    assert.deepEqual([...range({ shape: "capsule", points: [3, 0, 3, 1], radius: 2 })].sort(), [0, 1]);
    assert.deepEqual([...range({ shape: "halfspaces", points: [-1, 0], offsets: [-2] })], []);
});

test("messages show what was given, shortly, and count in words that fit", () => {
    const long = "x,y\n1,2\n".repeat(1000);
    assert.throws(() => froe.read("a.csv", long), (error) => error instanceof TypeError && error.message.length < 150 && /'a\.csv'/.test(error.message));
    assert.throws(() => froe.scene("3"), { message: "A scene has 2 to 8 dimensions, and not '3'." });
    assert.throws(() => cross().cells({ box: [0, 0, 1, 1] }), { message: "Options are an object with their names, and not an array." });
    assert.throws(() => cross().nearest([0, 0], new Map([["k", 2]])), { message: "Options are an object with their names, and not an object." });
    assert.throws(() => froe.segments([0, 0, 1, 1]).group(0), { name: "RangeError", message: "There is no group 0 among 0." });
    assert.throws(() => froe.segments([0, 0, 1, 1], { groups: [] }), { message: "groups has 0 numbers, and 1 is needed." });
    assert.throws(() => froe.segments([1]), { message: "coords has 1 number, which are no whole segments." });
    assert.throws(() => froe.motion({ begin: 0, end: 1 }).add({ starts: [0, 1], times: [0], coords: [0, 0] }), /^TypeError: 0\.5 segments cannot be made of 1 vertex\.$/);
});

test("load() refuses what is no option of it", async () => {
    await assert.rejects(module.load({ plian: true }), { name: "TypeError", message: "There is no option plian." });
    await assert.rejects(module.load({ progress: 5 }), { name: "TypeError", message: "progress is not a function, but 5." });
    assert.ok((await module.load(null)).version);
});

test("files are read whatever they are called", () => {
    const count = (name) => froe.read(name, bytes("x,y\n1,2\n")).objectCount;
    for (const name of ["..", ".", "", "a/..", "\ud800.csv", "ü \ud83d\ude42.csv", "a\nb.csv", "x".repeat(300)]) assert.equal(count(name), 1, JSON.stringify(name));
    assert.throws(() => count("a\0b.csv"), { name: "TypeError", message: /code 0/ });
    assert.throws(() => froe.segments([0, 0, 1, 1]).build({ method: "kd\0nothing" }), { name: "TypeError", message: /code 0/ });
});

test("cells and cuts of a scene that is as large as numbers are", () => {
    const most = Number.MAX_VALUE, tree = froe.segments([-most, -most, most, most, 0, 1, 1, 0]).build({ method: "kd" });
    const { coords } = tree.cells();
    assert.ok(coords.length > 0 && coords.every((x) => Math.abs(x) <= most));
    assert.ok(tree.cuts().coords.every((x) => Math.abs(x) <= most));
});
