/* camera.js: a view (angles, zoom, shift) as a camera of froe.
 *
 * The eye looks from `turn` degrees around the model and `tilt` degrees above it. zoom 0: as much as fits on the
 * page. Otherwise lengths are zoom times as large as where the ball around the model fits, and x and y shift the
 * model on the page, in heights of the page. */

/** For each axis that may point up: the axis to the right and towards the front, with signs. */
const AXES = { 0: [[0, 1, 0], [0, 0, -1]], 1: [[1, 0, 0], [0, 0, 1]], 2: [[1, 0, 0], [0, -1, 0]] };

const degrees = Math.PI / 180;
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const sum = (...terms) => [0, 1, 2].map((k) => terms.reduce((s, [t, v]) => s + t * v[k], 0));
const short = (v) => v.map((x) => Number(x.toPrecision(9)));

/** The directions of the page in space: right, up, and back to the eye. */
export function axesOf({ turn, tilt }, upAxis) {
    const [side, front] = AXES[upAxis], top = [0, 1, 2].map((k) => (k === upAxis ? 1 : 0));
    const t = turn * degrees, e = tilt * degrees;
    const level = sum([Math.sin(t), side], [Math.cos(t), front]);
    return {
        right: sum([Math.cos(t), side], [-Math.sin(t), front]),
        up: sum([Math.cos(e), top], [-Math.sin(e), level]),
        back: sum([Math.cos(e), level], [Math.sin(e), top]),
    };
}

/** The options of a camera of froe: eye, target, up, fov or scale, and the page. `model` has lo, hi and points, three
 * numbers each; `page` width, height and margin. */
export function cameraOf(view, model, page) {
    const axes = axesOf(view, model.up), { width, height, margin } = page;
    const middle = sum([0.5, model.lo], [0.5, model.hi]);
    const radius = 0.5 * Math.hypot(...sum([1, model.hi], [-1, model.lo])) || 1;
    // Half of what is seen between the margins, over the distance.
    const tall = Math.tan(0.5 * view.fov * degrees), wide = tall * (width - 2 * margin) / (height - 2 * margin);
    const place = { up: [0, 1, 2].map((k) => (k === model.up ? 1 : 0)), fit: false, axes, width, height, margin, parallel: view.parallel, fov: view.fov };
    const from = (target, distance) => ({ ...place, eye: short(sum([1, target], [distance, axes.back])), target: short(target) });
    if (view.zoom) {
        const narrow = Math.min(tall, wide), distance = radius * Math.hypot(1, narrow) / narrow / view.zoom;
        const scale = view.scale || view.zoom * (Math.min(width, height) - 2 * margin) / (2 * radius);
        const unit = view.parallel ? height / scale : 2 * tall * distance * height / (height - 2 * margin);
        const target = sum([1, middle], [-view.x * unit, axes.right], [-view.y * unit, axes.up]);
        return view.parallel ? { ...from(target, 4 * radius), scale: Number(scale.toPrecision(9)) } : from(target, distance);
    }
    if (view.parallel) return fitParallel(axes, middle, radius, model.points, page, view.scale, from);
    return fitPerspective(axes, middle, radius, model.points, tall, wide, from);
}

/* Every point p must have |p.right - c.right| <= wide (c.back - p.back), for the eye c, and likewise upwards: four
 * bounds, each by one point. */
function fitPerspective(axes, middle, radius, points, tall, wide, from) {
    const most = [-Infinity, -Infinity, -Infinity, -Infinity];
    let near = -Infinity;
    for (let i = 0; i < points.length; i += 3) {
        const p = [points[i] - middle[0], points[i + 1] - middle[1], points[i + 2] - middle[2]];
        const x = dot(p, axes.right), y = dot(p, axes.up), z = dot(p, axes.back);
        if (wide * z + x > most[0]) most[0] = wide * z + x;
        if (wide * z - x > most[1]) most[1] = wide * z - x;
        if (tall * z + y > most[2]) most[2] = tall * z + y;
        if (tall * z - y > most[3]) most[3] = tall * z - y;
        if (z > near) near = z;
    }
    const away = Math.max((most[0] + most[1]) / (2 * wide), (most[2] + most[3]) / (2 * tall), near + 1e-3 * radius);
    const target = sum([1, middle], [(most[0] - most[1]) / 2, axes.right], [(most[2] - most[3]) / 2, axes.up]);
    return from(target, away);
}

function fitParallel(axes, middle, radius, points, page, wanted, from) {
    const lo = [Infinity, Infinity], hi = [-Infinity, -Infinity];
    for (let i = 0; i < points.length; i += 3) {
        const p = [points[i] - middle[0], points[i + 1] - middle[1], points[i + 2] - middle[2]];
        [axes.right, axes.up].forEach((axis, k) => {
            const at = dot(p, axis);
            if (at < lo[k]) lo[k] = at;
            if (at > hi[k]) hi[k] = at;
        });
    }
    const scale = Math.min((page.width - 2 * page.margin) / (hi[0] - lo[0] || 1e-9 * radius),
        (page.height - 2 * page.margin) / (hi[1] - lo[1] || 1e-9 * radius));
    const target = sum([1, middle], [(lo[0] + hi[0]) / 2, axes.right], [(lo[1] + hi[1]) / 2, axes.up]);
    return { ...from(target, 4 * radius), scale: Number((wanted || scale).toPrecision(9)) };
}

/** The zoom at which the picture is as large as where it fits: what a first zoom by hand begins with. */
export function zoomOf(camera, view, model, page) {
    const radius = 0.5 * Math.hypot(...sum([1, model.hi], [-1, model.lo])) || 1;
    if (view.parallel) return camera.scale * 2 * radius / (Math.min(page.width, page.height) - 2 * page.margin);
    const tall = Math.tan(0.5 * view.fov * degrees), wide = tall * (page.width - 2 * page.margin) / (page.height - 2 * page.margin);
    const narrow = Math.min(tall, wide), distance = Math.hypot(...sum([1, camera.eye], [-1, camera.target]));
    return radius * Math.hypot(1, narrow) / narrow / distance;
}
