// Types: what is there is typed, what is typed is there, and an example of everything passes `tsc --strict`.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { copyFileSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { froe, installed, package_, root, run, scratch } from "./support.mjs";

const ts = createRequire(join(process.env.FROE_MODULES, "of-the-tests.js"))("typescript");
const api = await froe.load();

/** Names that exports of a module have in its declarations: of values, and for classes those of members. */
function declared(file) {
    const compiled = ts.createProgram([file], { strict: true, module: ts.ModuleKind.NodeNext, target: ts.ScriptTarget.ESNext });
    const checker = compiled.getTypeChecker(), module = checker.getSymbolAtLocation(compiled.getSourceFile(file));
    const values = new Map();
    for (const symbol of checker.getExportsOfModule(module)) {
        const own = symbol.flags & ts.SymbolFlags.Alias ? checker.getAliasedSymbol(symbol) : symbol;
        if (!(own.flags & ts.SymbolFlags.Value)) continue;
        const members = own.flags & ts.SymbolFlags.Class ? checker.getDeclaredTypeOfSymbol(own).getProperties() : [];
        values.set(symbol.name, members.map((member) => member.name).filter((name) => !name.startsWith("__@")));
    }
    return values;
}
/** Names of the members of an object: its own, and those of its classes. */
function members(object) {
    const names = new Set();
    for (let at = object; ![undefined, null, Object.prototype, Error.prototype].includes(at); at = Object.getPrototypeOf(at))
        for (const name of Object.getOwnPropertyNames(at)) names.add(name);
    names.delete("constructor");
    return names;
}

test("every export and every member is typed, and all that is typed is there", () => {
    const scene = api.segments([0, 0, 1, 1]), tree = scene.build();
    const motion = api.generateMotion("moving", 5);
    const instances = { Froe: api, Scene: scene, Tree: tree, Answers: tree.query([0, 0, 1, 1]), Motion: motion,
        Kinetic: motion.partition(), FroeError: new froe.FroeError("FROE_E_ARG", "No.") };
    const types = declared(join(package_, "index.d.ts"));
    assert.deepEqual([...types.keys()].sort(), Object.keys(froe).sort());
    for (const [name, typed] of types) {
        if (typeof froe[name] !== "function" || name === "load") continue;
        assert.ok(instances[name] instanceof froe[name], `no instance of ${name} is tried`);
        assert.deepEqual([...members(instances[name])].sort(), typed.filter((member) => member !== "cause" || "cause" in instances[name]).sort(), name);
    }
});

test("every way into the package is typed, and the worker as it is", async () => {
    const { exports } = JSON.parse(readFileSync(join(package_, "package.json"), "utf8"));
    for (const [way, files] of Object.entries(exports)) if (way !== "./package.json") assert.ok(declared(join(package_, files.types)).size > 0, way);
    const module = await import(join(package_, "worker.js")), types = declared(join(package_, "worker.d.ts"));
    assert.deepEqual([...types.keys()].sort(), Object.keys(module).sort());
    const worker = await module.FroeWorker.start();
    assert.deepEqual([...members(worker)].sort(), types.get("FroeWorker").sort());
    const scene = await worker.froe.generate("segments", 100), tree = await scene.build();
    assert.deepEqual([await scene.objectCount(), (await tree.report()).objects], [100, 100]);
    worker.end();
});

test("the plain module has the same exports", async () => {
    const plain = await import(join(package_, "plain.js"));
    assert.deepEqual(Object.keys(plain).sort(), Object.keys(froe).sort());
    assert.deepEqual([...declared(join(package_, "plain.d.ts")).keys()].sort(), Object.keys(froe).sort());
});

test("names of the numbers in arrays are those of the library", () => {
    const source = readFileSync(join(root, "include/froe/froe.h"), "utf8"), kinetic = readFileSync(join(root, "include/froe/kinetic.h"), "utf8");
    const names = (text, prefix) => [...text.matchAll(new RegExp(`^ +FROE_${prefix}_([A-Z_]+)\\b`, "gm"))].map(([, name]) => name.toLowerCase().replaceAll("_", "-"));
    assert.deepEqual([...froe.CUTS], names(source, "CUT").filter((name) => name !== "kind-count"));
    assert.deepEqual([...froe.EVENTS], names(kinetic, "EVENT").filter((name) => name !== "kinds"));
    assert.deepEqual([...froe.KINDS], ["point", "segment", "polygon", "box", "ball", "hull"]);
});

test("an example of everything passes tsc --strict, as a stranger calls it, and wrong types do not", () => {
    installed();
    copyFileSync(join(root, "web/tests/example.ts"), scratch("example.ts"));
    const tsc = join(process.env.FROE_MODULES, "typescript/bin/tsc");
    const compile = (...more) => run(process.execPath, [tsc, "--strict", "--noEmit", "--target", "es2022", "--lib", "es2022,dom", ...more, "example.ts"]);
    for (const resolution of [["--module", "nodenext"], ["--module", "esnext", "--moduleResolution", "bundler"]]) compile(...resolution);
});
