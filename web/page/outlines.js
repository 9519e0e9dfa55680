/* outlines.js: boxes, balls and hulls of the plane as the polygons around them */

const BOX = 3, BALL = 4; // in KINDS of the package; hulls follow
const AROUND = 48;       // corners around a ball

/** What is drawn of objects: object i is of the form forms[i] and has the corners starts[i] .. starts[i + 1], which are the
 * vertices corners[c], or c; `coords` are those of the vertices. Solids in space are refused. */
export function outlines({ dim, starts, coords, forms, radii, corners = null }) {
    if (!forms.some((form) => form >= BOX)) return { starts, coords, corners };
    if (dim > 2) throw new Error("Boxes, balls and hulls in space are not shown here: the program froe takes them");
    const lists = Array.from(forms, (form, i) => {
        const points = Array.from({ length: starts[i + 1] - starts[i] }, (_, c) => {
            const v = 2 * (corners ? corners[starts[i] + c] : starts[i] + c);
            return [coords[v], coords[v + 1]];
        });
        const [[x, y], [u, v] = []] = points;
        if (form === BOX) return [[x, y], [u, y], [u, v], [x, v]];
        if (form === BALL) return Array.from({ length: AROUND }, (_, k) => [Math.cos, Math.sin].map((f, axis) => [x, y][axis] + radii[i] * f(2 * Math.PI * k / AROUND)));
        return form > BALL ? hull(points) : points;
    });
    const ends = [0];
    for (const list of lists) ends.push(ends.at(-1) + list.length);
    return { starts: Uint32Array.from(ends), coords: Float64Array.from(lists.flat(2)), corners: corners && Uint32Array.from({ length: ends.at(-1) }, (_, c) => c) };
}

/* The corners of the hull of points, around it (Andrew 1979). */
function hull(points) {
    const sorted = points.sort((a, b) => a[0] - b[0] || a[1] - b[1]);
    const half = (list) => {
        const chain = [];
        for (const p of list) {
            while (chain.length > 1 && turn(chain.at(-2), chain.at(-1), p) <= 0) chain.pop();
            chain.push(p);
        }
        return chain.slice(0, -1);
    };
    return [...half(sorted), ...half(sorted.reverse())];
}
const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
