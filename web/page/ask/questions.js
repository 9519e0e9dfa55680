/* questions.js: the kinds of questions of the room Ask, and others of the same kind to measure by */

/** By name: what is said of them, of one answer and of several, and which programs of npm answer the like, in the plane and in space. */
export const KINDS = {
    window: { title: "Window", meets: ["meets the window", "meet the window"], peers: { 2: "flatbush" } },
    ball: { title: "Ball", meets: ["meets the ball", "meet the ball"], peers: {} },
    ray: { title: "Ray", meets: ["lies on the ray", "lie on the ray"], peers: { 3: "three-mesh-bvh" } },
    near: { title: "Nearest", meets: ["is nearest", "are nearest"], peers: { 2: "flatbush", 3: "three-mesh-bvh" } },
};

/** What a tree answers to a question { kind, at, size, k, origin, direction }: ids, values beside them or null. */
export async function answer(tree, { kind, at, size, k, origin, direction }) {
    if (kind === "window") return { ids: (await tree.range({ shape: "box", points: box(at, size) })).sort(), values: null };
    if (kind === "ball") return { ids: (await tree.range({ shape: "ball", points: at, radius: size / 2 })).sort(), values: null };
    const answers = kind === "ray" ? await tree.rayAll(origin, direction) : await tree.nearest(at, { k });
    return { ids: answers.at(0), values: answers.valuesAt(0) };
}
export const box = (at, size) => [...at.map((x) => x - size / 2), ...at.map((x) => x + size / 2)];

/** `count` questions of a kind, at random places of a box, the same ones each time: { points, directions }. */
export function many({ lo, hi }, count) {
    let state = 12345;
    const random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32, dim = lo.length;
    const points = new Float64Array(dim * count), directions = new Float64Array(dim * count);
    for (let i = 0; i < points.length; i++) {
        points[i] = lo[i % dim] + random() * (hi[i % dim] - lo[i % dim]);
        directions[i] = random() - 0.5;
    }
    return { points, directions };
}
/** Answers a tree gives to many questions: how many there are in all. */
export async function answerAll(tree, kind, { points, directions }, { size, k, dim }) {
    if (kind === "ray") return (await tree.ray(points, directions)).objects.reduce((sum, id) => sum + (id !== 0xffffffff), 0);
    if (kind === "near") return (await tree.nearest(points, { k })).ids.length;
    const boxes = new Float64Array(2 * points.length);
    for (let i = 0; i < points.length; i += dim)
        boxes.set(box([...points.subarray(i, i + dim)], size), 2 * i);
    return (await tree.query(boxes)).ids.length;
}
