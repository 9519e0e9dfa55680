// example.ts: the whole package in types. Lines after @ts-expect-error must not compile.
import { load, Answers, CUTS, EVENTS, FroeError, KINDS, NONE, type BuildOptions, type Picture, type Progress, type Tree } from "froe";
import { load as loadPlain } from "froe/plain";
import { FroeWorker, moved } from "froe/worker";

const progress: Progress = (done) => done < 0.5;
const froe = await load({ progress });
const plain = await loadPlain();
plain.progress = null;

const options: BuildOptions = { method: "density", seed: 3n, leaf: 4, settings: "k=16" };
const scene = froe.segments(new Float64Array([0, 0, 1, 1]), { groups: [0], tags: [1, 2n] });
scene.addGroup({ name: "walls", colour: 0xff0000ff });
scene.add({ kind: "point", coords: [1, 2] }).up;
const tree: Tree = scene.build(options);
const answers: Answers = tree.query([0, 0, 1, 1]);
for (const ids of answers) for (const id of ids) id.toFixed();
const { objects, t } = tree.ray([0, 0], [1, 1], { tMax: 5 });
if (objects[0] !== NONE) t[0].toFixed();
const relation: Uint32Array = tree.groupsOf({ shape: "ball", points: [0, 0], radius: 1 }, "within");
const cut: string = CUTS[tree.nodes().cuts[0]] + KINDS[scene.arrays().kinds[0]];
const place = tree.hitPlace(0, [0, 0], [1, 1]).normal?.[0];

const picture: Picture = froe.triangles([0, 0, 0, 1, 0, 0, 0, 1, 0], [0, 1, 2]).build({ purpose: "draw" }).render({
    format: "svg", shading: "cel", lines: ["silhouette", "crease"], eye: [1, 2, 3], lineStyles: [{ visible: ["border"], width: 2 }],
});
const text: string = picture.text;

{
    using motion = froe.generateMotion("moving", 10);
    using partition = motion.partition({ seed: 2 });
    const events = partition.step();
    const kind: string = EVENTS[events.kinds[0]];
    const { tree: present, alike } = partition.snapshot();
    present.audit();
    motion.contacts({ from: 0, to: 1 }).begins[0].toFixed();
    using curved = froe.generateMotion("moving-boxes", 1).withoutBodies(0.1).motion;
    curved.partition().advance(1).kinds[0]?.toFixed();
    void [kind, alike];
}
try {
    tree.audit();
} catch (error) {
    if (error instanceof FroeError && error.status === "FROE_E_AUDIT") error.object?.toFixed();
}
void [relation, cut, place, text];

const worker = await FroeWorker.start({ progress: (done) => done.toFixed() });
const afar = await worker.froe.triangles(moved(new Float64Array(9)));
const far = await afar.build({ purpose: "draw" });
const count: number = await afar.objectCount() + (await far.report()).nodes + (await far.render()).text.length + (await far.query([0, 0, 0, 1, 1, 1])).at(0)[0];
const moving = await worker.froe.generateMotion("moving", 10);
const { tree: instant } = await (await moving.partition()).snapshot();
void [count, await instant.cells()];
worker.end();

// @ts-expect-error: what is afar is not there at once
far.report.nodes.toFixed();
// @ts-expect-error: there is no such kind
scene.add({ kind: "circle", coords: [1, 2] });
// @ts-expect-error: there is no such option
scene.build({ colour: 1 });
// @ts-expect-error: there is no such line
tree.render({ lines: ["outline"] });
// @ts-expect-error: there is no such status
if (new FroeError("FROE_E_ARG", "").status === "E_ARG") void 0;
// @ts-expect-error: trees are built
new (await import("froe")).Tree();
