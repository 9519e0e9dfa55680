/* triangles.js: meshes of three.js as one array of triangles with groups */

/** meshes: { geometry, matrix, name, material, colour (0xRRGGBBAA; 0: none) }. */
export function triangles(file, up, meshes) {
    const corners = (geometry) => geometry.index?.count ?? geometry.attributes.position?.count ?? 0;
    if (meshes.some(({ geometry }) => corners(geometry) % 3)) throw new Error(`${file} has a triangle without three corners`);
    const total = meshes.reduce((sum, { geometry }) => sum + Math.floor(corners(geometry) / 3), 0);
    if (!total) throw new Error(`${file} has no triangles`);
    const coords = new Float64Array(9 * total), groupOf = new Uint32Array(total), groups = [];
    let at = 0;
    for (const { geometry, matrix, ...group } of meshes) {
        const position = geometry.attributes.position, index = geometry.index, end = at + Math.floor(corners(geometry) / 3);
        const e = matrix?.elements;
        groupOf.fill(groups.push(group) - 1, at, end);
        for (let c = 0, to = 9 * at; to < 9 * end; c++, to += 3) {
            const i = index ? index.getX(c) : c, x = position.getX(i), y = position.getY(i), z = position.getZ(i);
            for (let k = 0; k < 3; k++)
                coords[to + k] = e ? e[k] * x + e[4 + k] * y + e[8 + k] * z + e[12 + k] : [x, y, z][k];
        }
        at = end;
    }
    return { name: file, up, groups, coords, groupOf };
}
