/* peers.js: programs of npm that answer the like of froe's questions; loaded when they are asked for */

/** Builds a peer over objects. `shapes`: dim, starts, corners and coords of the scene. Gives { build, ask(questions) },
 * times in milliseconds, and what its answers are. */
export async function peer(name, shapes) { return (name === "flatbush" ? flatbush : meshes)(shapes); }

async function flatbush({ starts, corners, coords }) {
    await import("../peers/flatbush.js"); // which makes a global of itself
    const { Flatbush } = globalThis, count = starts.length - 1, began = performance.now();
    const index = new Flatbush(count);
    for (let i = 0; i < count; i++) {
        let [x0, y0, x1, y1] = [Infinity, Infinity, -Infinity, -Infinity];
        for (let c = starts[i]; c < starts[i + 1]; c++) {
            const x = coords[2 * corners[c]], y = coords[2 * corners[c] + 1];
            x0 = Math.min(x0, x), y0 = Math.min(y0, y), x1 = Math.max(x1, x), y1 = Math.max(y1, y);
        }
        index.add(x0, y0, x1, y1);
    }
    index.finish();
    const build = performance.now() - began;
    return {
        build, what: "boxes of objects, not the objects",
        ask(kind, { points }, { size, k }) {
            let found = 0;
            for (let i = 0; i < points.length; i += 2) {
                const x = points[i], y = points[i + 1], half = size / 2;
                found += kind === "near" ? index.neighbors(x, y, k).length : index.search(x - half, y - half, x + half, y + half).length;
            }
            return found;
        },
    };
}

async function meshes({ starts, corners, coords }) {
    const [{ MeshBVH }, three] = [await import("../peers/three-mesh-bvh.js"), await import("three")], began = performance.now();
    const geometry = new three.BufferGeometry(), index = [];
    geometry.setAttribute("position", new three.BufferAttribute(Float32Array.from(coords), 3));
    for (let i = 0; i + 1 < starts.length; i++)
        for (let c = starts[i] + 2; c < starts[i + 1]; c++) index.push(corners[starts[i]], corners[c - 1], corners[c]);
    geometry.setIndex(index);
    const tree = new MeshBVH(geometry), build = performance.now() - began;
    return {
        build, what: "in single precision",
        ask(kind, { points, directions }) {
            const ray = new three.Ray(), point = new three.Vector3(), target = {};
            let found = 0;
            for (let i = 0; i < points.length; i += 3) {
                if (kind === "near") found += tree.closestPointToPoint(point.fromArray(points, i), target) ? 1 : 0;
                else {
                    ray.origin.fromArray(points, i);
                    ray.direction.fromArray(directions, i).normalize();
                    found += tree.raycastFirst(ray, three.DoubleSide) ? 1 : 0;
                }
            }
            return found;
        },
    };
}
