// The package beside the program: the same files, byte for byte, of trees, pictures, exports, contacts and events.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { froe as module, package_, program, root, scratch } from "./support.mjs";

const { EVENTS, NONE, load } = module;
const data = (name) => readFileSync(join(root, "data", name));
const text = (bytes) => new TextDecoder().decode(bytes);
/** Rows of a table that the program wrote, as objects. */
const rows = (name) => {
    const [head, ...lines] = readFileSync(scratch(name), "utf8").trimEnd().split("\n").map((line) => line.split(","));
    return lines.map((line) => Object.fromEntries(head.map((field, i) => [field, line[i]])));
};

for (const [kind, froe] of [["simd", await load()], ["plain", await load({ plain: true })]]) {
    const name = (what) => `${what} (${kind})`;
    const bracket = () => froe.read("bracket.off", data("bracket.off")).build({ purpose: "draw" });
    const same = (bytes, file) => assert.ok(readFileSync(scratch(file)).equals(Buffer.from(bytes)), file);

    test(name("a saved tree opens in the program, which draws the same with every option of lines, paper and section"), () => {
        const tree = bracket();
        writeFileSync(scratch("bracket.froe"), tree.save());
        const pictures = {
            "plain.svg": [{}, []],
            "technical.svg": [{ parallel: true, shading: "none", hidden: true }, ["--parallel", "--style", "none", "--hidden", "dashed"]],
            "paper.pdf": [{ format: "pdf", width: 160, height: 120, margin: 3.2, millimetres: true, shading: "cel", celLevels: 6,
                lineWidth: 0.2, seamWidth: 0.2, pointWidth: 3 * 0.2 },
                ["--size", "160x120mm", "--style", "cel:6"]],
            "styles.svg": [{ lines: ["silhouette", "border"], ids: "face", layers: "kind", decimals: 4, halo: 3,
                lineStyles: [{ visible: ["silhouette"], width: 2, colour: 0x884400, dash: 4, gap: 1 }, { visible: ["border"], width: 0.5 }] },
            ["--line-kinds", "silhouette,border", "--ids", "face", "--layers", "kind", "--decimals", "4", "--halo", "3",
                "--line-style", "silhouette=2:884400:4:1,border=0.5"]],
            "eye.eps": [{ format: "eps", eye: [9, -7, 5], fit: false, target: [0, 0, 0], fov: 50, paint: "regions", seams: "none" },
                ["--eye", "9,-7,5", "--target", "0,0,0", "--fov", "50", "--paint", "regions", "--seams", "none"]],
            "lines.geojson": [{ format: "geojson", ids: "object", lines: ["crease"], crease: 10 }, ["--line-kinds", "crease", "--crease", "10"]],
        };
        for (const [file, [options, args]] of Object.entries(pictures)) {
            program("render", "bracket.froe", "-o", file, ...args);
            same(tree.render(options).bytes, file);
        }
        const { lo, hi } = tree.bounds(), plane = [1, 0.5, 0.25, [1, 0.5, 0.25].reduce((sum, a, i) => sum + a * (lo[i] + hi[i]) / 2, 0)];
        program("render", "bracket.froe", "-o", "section.svg", `--section=${plane.join()}`);
        same(tree.section(plane).render({ section: -1, sectionPlane: plane }).bytes, "section.svg");
        program("render", "bracket.froe", "-o", "turning.svg", "--turntable", "5", "--animate", "--seconds", "2");
        same(tree.renderTurning({ count: 5, seconds: 2 }).bytes, "turning.svg");
    });

    test(name("a scene that is written, and parts of a tree that are exported, are the program's"), () => {
        const scene = froe.read("floor.geojson", data("freedoom-e1m1.geojson")), tree = scene.build({ method: "kd" });
        writeFileSync(scratch("floor.geojson"), scene.write("floor.geojson"));
        program("build", "floor.geojson", "--method", "kd", "-o", "floor.froe");
        for (const what of ["fragments", "cells", "cuts"]) {
            program("export", "floor.froe", "--what", what, "-o", "part.geojson");
            assert.equal(text(tree.export("part.geojson", what)), readFileSync(scratch("part.geojson"), "utf8"), what);
        }
        assert.deepEqual(froe.open(readFileSync(scratch("floor.froe"))).report.fragments, tree.report.fragments);
    });

    test(name("contacts and events of a motion are the program's, and so is the tree of an instant"), () => {
        const motion = froe.generateMotion("moving-quadratic", 40, 3), { begin, end } = motion.window;
        writeFileSync(scratch("moving.mfjson"), motion.write());
        program("simulate", "moving.mfjson", "--contacts", "contacts.csv", "--events", "events.csv", "--at", "20", "-o", "instant.froe");
        const found = motion.contacts(), told = rows("contacts.csv");
        assert.ok(told.length > 20);
        assert.deepEqual([...found.a], told.map((row) => Number(row.a)));
        assert.deepEqual([...found.b], told.map((row) => Number(row.b)));
        assert.deepEqual([...found.begins], told.flatMap((row) => [Number(row.begin_low), Number(row.begin_high)]));
        assert.deepEqual([...found.ends], told.flatMap((row) => [Number(row.end_low), Number(row.end_high)]));
        assert.deepEqual([...found.instant], told.map((row) => Number(row.instant)));

        const partition = motion.partition(), early = partition.advance(20, { instants: true }), { tree } = partition.snapshot();
        assert.deepEqual(Buffer.from(tree.save()), readFileSync(scratch("instant.froe")));
        const late = partition.advance(end, { instants: true }), happened = rows("events.csv");
        partition.audit();
        assert.deepEqual([...early.ticks, ...late.ticks], happened.map((row) => Number(row.tick)));
        assert.deepEqual([...early.kinds, ...late.kinds].map((event) => EVENTS[event]), happened.map((row) => row.kind));
        assert.deepEqual([...early.early, ...late.early], happened.map((row) => Number(row.early)));
        const objects = [...early.objects, ...late.objects];
        assert.deepEqual(objects, happened.flatMap((row) => [..."abcd"].map((place) => (row[place] === "" ? NONE : Number(row[place])))));
        const statistics = partition.statistics();
        assert.equal(Object.values(statistics.events).reduce((sum, count) => sum + count), happened.length);

        const again = froe.readMotion("again.json", motion.write()), steps = again.partition();
        let count = 0, time = begin;
        for (let events; (events = steps.step()).kinds.length; count += events.kinds.length, time = events.late[0]) {
            assert.ok(events.early[0] <= events.late[0] && events.early[0] >= time - again.window.tick);
            assert.ok(steps.time >= events.late[0]);
        }
        assert.equal(count, happened.length);
    });
}
