/* papers.js: sizes of pages */

/** In pixels, or in millimetres. */
export const PAPERS = {
    wide: { title: "Screen, 1600 × 1000", width: 1600, height: 1000 },
    square: { title: "Square, 1000 × 1000", width: 1000, height: 1000 },
    a4: { title: "A4, landscape", width: 297, height: 210, millimetres: true },
    a4tall: { title: "A4, portrait", width: 210, height: 297, millimetres: true },
    a3: { title: "A3, landscape", width: 420, height: 297, millimetres: true },
    letter: { title: "Letter, landscape", width: 279.4, height: 215.9, millimetres: true },
};
/** Scales to which a parallel drawing on paper may be true: a metre is 1000 / scale millimetres. */
export const SCALES = [1, 2, 5, 10, 20, 50, 100, 200, 500];
/** Metres of a unit of the model. */
export const UNITS = [[1, "m"], [0.01, "cm"], [0.001, "mm"], [0.0254, "inches"]];

export function pageOf(name) {
    const paper = PAPERS[name] ?? PAPERS.wide;
    return { width: paper.width, height: paper.height, margin: paper.width / 50, millimetres: !!paper.millimetres };
}
