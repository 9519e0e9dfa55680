/* edges.js: the edges of a mesh that are lines: of one polygon only, between groups, and creases */

/** Pairs of vertices. arrays: of scene.arrays(); coords: of its vertices; flat: the cosine from which on two polygons
 * count as one plane. */
export function featureEdges({ starts, corners, groups }, coords, flat) {
    const vertices = coords.length / 3, sides = countSides(starts);
    const keys = new Float64Array(sides), faces = new Uint32Array(sides);
    for (let i = 0, at = 0; i + 1 < starts.length; i++) {
        const first = starts[i], end = starts[i + 1];
        for (let c = first; end - first > 2 && c < end; c++, at++) {
            const a = corners[c], b = corners[c + 1 < end ? c + 1 : first];
            keys[at] = Math.min(a, b) * vertices + Math.max(a, b);
            faces[at] = i;
        }
    }
    const order = new Uint32Array(sides).map((_, i) => i).sort((i, j) => keys[i] - keys[j]), lines = [];
    for (let from = 0, to; from < sides; from = to) {
        const key = keys[order[from]];
        for (to = from + 1; to < sides && keys[order[to]] === key; to++);
        const a = faces[order[from]], b = faces[order[to - 1]];
        if (to - from !== 2 || groups[a] !== groups[b] ||
            Math.abs(cosine(starts, corners, coords, a, b)) < flat)
            lines.push(Math.floor(key / vertices), key % vertices);
    }
    return Uint32Array.from(lines);
}

function countSides(starts) {
    let sides = 0;
    for (let i = 0; i + 1 < starts.length; i++) if (starts[i + 1] - starts[i] > 2) sides += starts[i + 1] - starts[i];
    return sides;
}

function cosine(starts, corners, coords, a, b) {
    const m = normal(corners, coords, starts[a]), n = normal(corners, coords, starts[b]);
    return (m[0] * n[0] + m[1] * n[1] + m[2] * n[2]) / Math.sqrt((m[0] ** 2 + m[1] ** 2 + m[2] ** 2) * (n[0] ** 2 + n[1] ** 2 + n[2] ** 2) || 1);
}
function normal(corners, coords, first) {
    const [p, q, r] = [0, 1, 2].map((k) => 3 * corners[first + k]);
    const u = [0, 1, 2].map((k) => coords[q + k] - coords[p + k]), v = [0, 1, 2].map((k) => coords[r + k] - coords[p + k]);
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
}
