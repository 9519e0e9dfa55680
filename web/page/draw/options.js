/* options.js: the state of the room as options of a picture, and as a command line of the program that draws the same */
import { cameraOf } from "./camera.js";
import { pageOf } from "./papers.js";

const LINES = { all: null, outlines: ["border", "silhouette", "object", "section"],
    mesh: ["border", "silhouette", "object", "material", "crease", "mesh", "crossing", "section"], none: [] };
const PAPER_LINE = 0.25; // millimetres of a line that has 1 pixel on the screen

/** The axis that points up: that of the file, or the one that was chosen. */
export const upOf = (state, model) => ("xyz".includes(state.up) ? "xyz".indexOf(state.up) : model.up);

/** What the section leaves: a x + b y + c z <= d, as [a, b, c, d], or null. */
export function planeOf({ section, at, flip }, { lo, hi }) {
    const axis = "xyz".indexOf(section), sign = flip ? -1 : 1;
    if (axis < 0) return null;
    const d = Number((lo[axis] + at * (hi[axis] - lo[axis])).toPrecision(6));
    return [...[0, 1, 2].map((k) => (k === axis ? sign : 0)), sign * d];
}

export function cameraOfState(state, model) {
    const page = pageOf(state.paper), toScale = page.millimetres && state.parallel && Number(state.scale);
    const view = { ...state, scale: toScale ? 1000 * state.unit / toScale : 0 };
    return cameraOf(view, { ...model, up: upOf(state, model) }, page);
}

/** Options of render() of the package, and `plane`. */
export function optionsOf(state, model) {
    const page = pageOf(state.paper), unit = page.millimetres ? PAPER_LINE : 1, kinds = LINES[state.lines];
    const { up, eye, target, fit, width, height, margin, parallel, fov, scale } = cameraOfState(state, model);
    return {
        eye, target, up, fit, width, height, margin, parallel, ...(parallel ? { scale } : { fov }),
        millimetres: page.millimetres, decimals: page.millimetres ? 3 : 2,
        shading: state.shading, ownColours: state.colours === "own",
        ...(kinds ? { lines: kinds } : {}),
        lineWidth: round(state.width * unit), seamWidth: unit, hidden: state.hidden, crease: state.crease,
        title: model.title, plane: planeOf(state, model),
    };
}
const round = (x) => Number(x.toPrecision(6));

/** The line that draws the same from the saved tree, which is called `file`.froe. */
export function commandOf(options, state, model, file) {
    const axis = "xyz"[upOf(state, model)], kinds = LINES[state.lines], page = `${options.width}x${options.height}`;
    const lined = !kinds || kinds.length, creased = !kinds || kinds.includes("crease"); // the program refuses what changes nothing
    return ["froe render", quote(`${file}.froe`), "-o", quote(`${file}.svg`), `--up ${axis}`, `--eye=${options.eye}`, `--target=${options.target}`,
        options.parallel ? `--parallel --scale ${options.scale}` : `--fov ${options.fov}`,
        `--size ${page}${options.millimetres ? "mm" : ""}`, `--margin ${options.margin}`,
        `--style ${options.shading}`, options.ownColours ? "--colours own" : "", kinds ? `--line-kinds ${kinds.join() || "none"}` : "",
        lined ? `--line-width ${options.lineWidth}` : "", `--seam-width ${options.seamWidth} --decimals ${options.decimals}`,
        lined && options.hidden ? "--hidden dashed" : "", creased ? `--crease ${options.crease}` : "",
        options.plane ? `--section=${options.plane}` : "",
        `--title ${quote(options.title)}`].filter(Boolean).join(" ");
}
const quote = (text) => (/^[\w./-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`);
