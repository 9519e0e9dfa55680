/* index.d.ts: the types of froe, for TypeScript 5.2 or later */
/// <reference lib="esnext.disposable" />

/** Numbers, as any array of them. Arrays of the type that froe takes are not copied twice. */
export type Numbers = readonly number[] | NumberArray;
type NumberArray = Int8Array | Uint8Array | Uint8ClampedArray | Int16Array | Uint16Array | Int32Array | Uint32Array
    | Float32Array | Float64Array;
/** Names of the caller's own, of 64 bits. */
export type Tags = BigUint64Array | readonly (number | bigint)[];
/** The bytes of files, by their names. */
export type Files = Readonly<Record<string, Uint8Array>>;

export type Kind = "point" | "segment" | "polygon" | "box" | "ball" | "hull";
export type Status = "FROE_E_ARG" | "FROE_E_OPTIONS" | "FROE_E_MEMORY" | "FROE_E_INPUT" | "FROE_E_LIMIT" | "FROE_E_BUDGET"
    | "FROE_E_CANCELLED" | "FROE_E_UNSUPPORTED" | "FROE_E_IO" | "FROE_E_FORMAT" | "FROE_E_FROZEN" | "FROE_E_AUDIT";

/** What a call could not do, in a sentence. */
export class FroeError extends Error {
    constructor(status: Status, message: string, object?: number | null, corner?: number | null, axis?: number | null);
    readonly status: Status;
    /** What it was about: the number of an object or of a question, of its corner, of an axis; or null. */
    readonly object: number | null;
    readonly corner: number | null;
    readonly axis: number | null;
}

/** "No object", "no group" in arrays of numbers. */
export const NONE: 0xffffffff;
/** Names of the numbers in `kinds` and `forms` of Scene.arrays(). */
export const KINDS: readonly Kind[];
/** Names of the numbers in `cuts` of Tree.nodes(): where the cut of a node comes from. */
export const CUTS: readonly ("none" | "axis" | "object" | "vertices" | "edge" | "plane" | "vertex" | "crossing" | "fine")[];
/** Names of the numbers in `kinds` of events. */
export const EVENTS: readonly EventKind[];
export type EventKind = "vertices" | "vertex-crossing" | "crossings" | "contact" | "triple" | "turn" | "batch" | "plan"
    | "appear" | "disappear" | "flop" | "touch";

/** Told the share done, 0 to 1, now and then while a call runs. If it returns false, the call ends with
 * FROE_E_CANCELLED; if it throws, with what it has thrown. It cannot use froe itself. */
export type Progress = (done: number) => unknown;

export interface LoadOptions {
    /** Without the vector instructions of WebAssembly, as is done by itself where there are none. */
    plain?: boolean;
    progress?: Progress | null;
}
/** Loads froe. */
export function load(options?: LoadOptions): Promise<Froe>;

/** What has memory that is not freed by JavaScript at once. */
declare class Resource {
    protected constructor();
    /** Frees the memory now; otherwise it is freed some time after the last use. */
    free(): void;
    [Symbol.dispose](): void;
}

/** What a loaded module makes. */
export class Froe {
    private constructor();
    readonly version: string;
    /** Bytes that froe has of the memory of the page, at most 4 GB. It never gives any back, and uses again what was
     * freed. */
    readonly memory: number;
    progress: Progress | null;

    /** An empty scene of 2 to 8 dimensions. */
    scene(dim: number): Scene;
    /** Segments of the plane, 4 numbers each, or of `dim` dimensions. */
    segments(coords: Numbers, more?: Shared & { dim?: number }): Scene;
    /** Triangles in space: vertices, 3 numbers each, and 3 indices for each triangle; without these 9 numbers each. */
    triangles(coords: Numbers, indices?: Numbers | null, more?: Shared & { starts?: Numbers }): Scene;
    points(coords: Numbers, more?: Shared & { dim?: number }): Scene;
    /** Boxes: of each its lower corner, then its upper. */
    boxes(coords: Numbers, more?: Shared & { dim?: number }): Scene;

    /** Reads the bytes of a file of a format that needs no library: CSV, GeoJSON, OBJ, OFF, PLY. */
    read(name: string, bytes: Uint8Array, options?: ReadOptions): Scene;
    /** Opens the bytes of a saved tree. */
    open(bytes: Uint8Array): Tree;

    /** Kinds of made-up scenes. */
    generators(): Generator[];
    /** A made-up scene of about n objects. */
    generate(kind: string, n: number, seed?: number | bigint): Scene;

    /** Nothing that moves yet. */
    motion(options: { begin: number; end: number; dim?: 2 | 3; tick?: number }): Motion;
    motionGenerators(): Omit<Generator, "kind">[];
    /** About n moving objects, from time 0 to 60. */
    generateMotion(kind: string, n: number, seed?: number | bigint): Motion;
    /** Reads the bytes of a file of OGC Moving Features JSON. */
    readMotion(name: string, bytes: Uint8Array): Motion;
}

export interface Generator {
    name: string;
    dim: number;
    kind: Kind;
    summary: string;
    /** What users ask for; the others are for tests. */
    usual: boolean;
}
export interface ReadOptions {
    /** Other files that it names, such as { "house.mtl": bytes }. */
    files?: Files;
    /** Whether polygons that are planar, convex and simple stay whole; "triangles" by default. */
    faces?: "triangles" | "polygons";
    /** The bounding box of each feature instead of its shape. */
    boxes?: boolean;
    /** Cut borders of maps that cross the antimeridian there. */
    wrap?: boolean;
}
/** How a file was read. */
export interface Source {
    format: string;
    precision: string;
    features: number;
    groups: number;
    linearised: number;
    flattened: number;
    triangulated: number;
    skipped: number;
    noGeometry: number;
    wrapped: number;
    textures: number;
    unread: number;
    /** A file that it names and that was not there, or "". */
    unreadName: string;
}

/** What a batch of objects may have besides coordinates, one for each object. */
export interface Shared {
    tags?: Tags;
    /** The polygon that each object is a part of. */
    faces?: Numbers;
    groups?: Numbers;
    /** One group for all. */
    group?: number;
}
export interface Batch extends Shared {
    kind: Kind;
    coords: Numbers;
    count?: number;
    indices?: Numbers | null;
    starts?: Numbers;
    radii?: Numbers;
}
/** What objects may share; colour is 0xRRGGBBAA, 0: unknown. */
export interface Group {
    name: string;
    material: string;
    left: string;
    right: string;
    colour: number;
}
export interface Box {
    lo: Float64Array;
    hi: Float64Array;
}
export interface BoxInput {
    lo: Numbers;
    hi: Numbers;
}

export interface SceneArrays {
    dim: number;
    /** Of the vertices, `dim` numbers each. */
    coords: Float64Array;
    kinds: Uint8Array;
    forms: Uint8Array;
    /** Object i has the corners starts[i] .. starts[i + 1]. */
    starts: Uint32Array;
    /** Numbers of vertices. */
    corners: Uint32Array;
    radii: Float64Array;
    tags: BigUint64Array;
    faces: Uint32Array;
    groups: Uint32Array;
}
export interface Defects {
    zeroLength: number;
    zeroArea: number;
    duplicates: number;
    crossings: number;
    tJunctions: number;
    overlaps: number;
    firstCrossing: [number, number] | null;
    firstTJunction: [number, number] | null;
    firstOverlap: [number, number] | null;
}
export interface Method {
    name: string;
    summary: string;
    source: string;
    guarantee: string;
    options: { name: string; summary: string; standard: number; least: number; most: number; choices: string[] | null; whole: boolean }[];
}
export type Purpose = "pieces" | "query" | "draw";
export interface BuildOptions {
    /** "auto" (default) or the name of one of Scene.methods(). */
    method?: string;
    /** What "auto" chooses for; "pieces" by default. */
    purpose?: Purpose;
    /** Options of the method: "name=value name=value". */
    settings?: string;
    /** Most objects in a leaf; 0: everything ends in cuts. */
    leaf?: number;
    seed?: number | bigint;
    /** Every object once, the first to cut first. */
    order?: Numbers;
    /** Budget for pieces; 0: none. */
    maxFragments?: number;
}

/** A set of objects. Coordinates are kept exactly; objects have the ids 0, 1, ... in the order in which they are added. */
export class Scene extends Resource {
    /** How it was read, if it is from a file. */
    readonly source: Source | null;
    readonly dim: number;
    readonly objectCount: number;
    readonly vertexCount: number;
    readonly groupCount: number;
    /** The axis of a scene in space that points up in pictures: 0, 1 or 2. */
    up: number;

    /** Adds objects of one kind: all of them, or none. Object i has the corners starts[i] .. starts[i + 1], or as many as
     * its kind has (polygons: 3); with `indices` corner c is the point indices[c]. */
    add(batch: Batch): this;
    /** Adds what objects may share; returns its number. */
    addGroup(group: Partial<Group>): number;
    group(i: number): Group;
    /** Null where there are no objects. */
    bounds(): Box | null;
    arrays(): SceneArrays;
    /** What is odd about the scene, and stops nothing. */
    defects(): Defects;
    /** Methods that can build a tree of this scene. */
    methods(): Method[];
    /** The method that "auto" stands for; null: there is no such purpose. */
    autoMethod(purpose?: Purpose): string | null;
    /** Builds a tree. The scene cannot grow any more while it has one. */
    build(options?: BuildOptions): Tree;
    /** The bytes of a file that read() takes; a name ends in .geojson, .json, .csv, .off or .obj. */
    write(name: string): Uint8Array;
}

/** Answers of a batch: those of question i are ids[starts[i] .. starts[i + 1]), with values beside them where there are
 * any (distances, parameters). */
export class Answers implements Iterable<Uint32Array> {
    constructor(starts: Uint32Array, ids: Uint32Array, values?: Float64Array | null);
    readonly starts: Uint32Array;
    readonly ids: Uint32Array;
    readonly values: Float64Array | null;
    readonly length: number;
    /** The list of question i, and the values beside it. A RangeError where there is no such question. */
    at(i: number): Uint32Array;
    valuesAt(i: number): Float64Array | null;
    [Symbol.iterator](): IterableIterator<Uint32Array>;
}

export type Shape = "box" | "ball" | "simplex" | "capsule" | "halfspaces" | "hull" | "segment" | "ray";
export interface Range {
    /** "box" by default. */
    shape?: Shape;
    /** Of a box lo, hi; of a ball its centre; of a capsule and a segment two ends; of a ray origin and direction; of
     * halfspaces their normals. */
    points: Numbers;
    /** Of halfspaces. */
    offsets?: Numbers;
    /** Of a ball and a capsule. */
    radius?: number;
    /** More than what meets the range: what meets it grown by eps times its diameter may be there, too. */
    eps?: number;
    walk?: "auto" | "plain" | "box" | "lca" | "classes";
}
export type Relation = "meets" | "within" | "covers";
/** What questions have cost. */
export interface Statistics {
    queries: number;
    /** Visited. */
    nodes: number;
    leaves: number;
    /** Objects tested against a question. */
    tests: number;
    /** Decisions by exact numbers; an object or a cut may take several. */
    exact: number;
    slices: number;
    steps: number;
}
export interface Pairs {
    a: Uint32Array;
    b: Uint32Array;
    kinds: ("cross" | "touch" | "overlap")[];
}

export interface Report {
    method: string;
    settings: string;
    promises: { name: string; promised: number; measured: number }[];
    dim: number;
    leaf: number;
    seed: number;
    objects: number;
    nodes: number;
    leaves: number;
    /** Pieces in all lists; of these in cuts, and those that contain the region of their node. */
    fragments: number;
    inCut: number;
    covers: number;
    size: number;
    height: number;
    meanDepth: number;
    maxLeaf: number;
    inseparable: number;
    crowded: number;
    bytes: number;
    exact: number;
}
/** Node n of other arrays is at n - 1 here. */
export interface Nodes {
    /** Two numbers of nodes each; 0 in leaves. */
    children: Uint32Array;
    /** Numbers of nodes; 0 of the root. */
    parents: Uint32Array;
    depths: Uint32Array;
    /** The list of a node: pieces from firstPieces to firstPieces + pieceCounts - 1, of which the first coverCounts contain
     * its region. */
    firstPieces: Uint32Array;
    pieceCounts: Uint32Array;
    coverCounts: Uint32Array;
    /** Kinds of cuts, see CUTS; their axes, values, and three numbers of objects or vertices each. */
    cuts: Uint8Array;
    axes: Uint32Array;
    values: Float64Array;
    ids: Uint32Array;
}
export interface Pieces {
    objects: Uint32Array;
    nodes: Uint32Array;
    /** 1: nothing of the object was cut off. */
    whole: Uint8Array;
    /** Piece i has the corners starts[i] .. starts[i + 1]. */
    starts: Uint32Array;
    coords: Float64Array;
    /** Of the edge that leaves each corner, the node whose cut made it, or 0. */
    made: Uint32Array;
}
export interface Cells {
    nodes: Uint32Array;
    depths: Uint32Array;
    /** Cell i has the faces faces[i] .. faces[i + 1], and face f the corners starts[f] .. starts[f + 1]. */
    faces: Uint32Array;
    starts: Uint32Array;
    coords: Float64Array;
}
export interface Cuts {
    nodes: Uint32Array;
    depths: Uint32Array;
    /** Cut i has the corners starts[i] .. starts[i + 1], two in the plane. */
    starts: Uint32Array;
    coords: Float64Array;
}

export type Line = "border" | "silhouette" | "object" | "material" | "crease" | "mesh" | "crossing" | "section" | "wire" | "point";
export interface LineStyle {
    /** The visible and the hidden lines that it is about. */
    visible?: readonly Line[];
    hidden?: readonly Line[];
    width?: number;
    /** 0xRRGGBB. */
    colour?: number;
    dash?: number;
    gap?: number;
}
/** Lengths are in units of the page; colours without opacity are 0xRRGGBB. */
export interface PictureOptions {
    parallel?: boolean;
    /** The whole scene just fits the page (default). */
    fit?: boolean;
    eye?: Numbers;
    target?: Numbers;
    up?: Numbers;
    /** Degrees between the lower and the upper margin; 35 by default. */
    fov?: number;
    /** Of parallel projections: page units for each unit of the scene; 0: as fits. */
    scale?: number;
    /** The page; 1000, 1000 and 20 by default. */
    width?: number;
    height?: number;
    margin?: number;
    /** A unit of the page is a millimetre, and not a pixel (SVG) or point (PDF, EPS). */
    millimetres?: boolean;
    shading?: "flat" | "cel" | "plain" | "white" | "none";
    celLevels?: number;
    paint?: "whole" | "regions" | "fragments";
    seams?: "underlap" | "none" | "twice" | "stroke";
    seamWidth?: number;
    /** Of a tree of section(): -1 or 1 shows one side of its plane alone. */
    section?: -1 | 0 | 1;
    /** That plane, where what is on its negative side is to fit the page: four numbers. */
    sectionPlane?: Numbers;
    /** All but mesh by default. */
    lines?: readonly Line[];
    lineStyles?: readonly LineStyle[];
    /** Degrees; 30 by default. */
    crease?: number;
    lineWidth?: number;
    pointWidth?: number;
    interleaved?: boolean;
    /** Hidden lines, dashed. */
    hidden?: boolean;
    halo?: number;
    ownColours?: boolean;
    /** For each group: 0 to 1, or NaN. */
    opacity?: Numbers;
    priorities?: Numbers;
    cullBack?: boolean;
    background?: number;
    /** Digits after the point in SVG; 2 by default. */
    decimals?: number;
    /** What SVG tells of the origin of shapes and lines: data-object, data-group. */
    ids?: "none" | "object" | "face";
    layers?: "none" | "object" | "kind";
    minArea?: number;
    title?: string;
    description?: string;
}
export interface Picture {
    /** Of the file. */
    bytes: Uint8Array;
    /** The same as text. */
    readonly text: string;
    shapes: number;
    lines: number;
    dots: number;
    paths: number;
    /** Visible ones. */
    patches: number;
    /** What it is made of, which is not what was asked for if that would take too long. */
    paint: "whole" | "regions" | "fragments";
}

/** Questions to a tree. Objects and ranges are closed, and every answer is the exact one for the numbers given. */
declare class Questions extends Resource {
    readonly dim: number;
    /** Objects that meet boxes: for each its lower corner, then its upper. */
    query(boxes: Numbers): Answers;
    /** Objects that meet a range. */
    range(range: Range): Uint32Array;
    /** Groups of the plane that meet a range, lie within it, or cover it. */
    groupsOf(range: Range, relation?: Relation): Uint32Array;
    /** The objects that contain each point. */
    locate(points: Numbers): Answers;
    /** The groups (areas) that each point of the plane lies in. */
    groups(points: Numbers): Answers;
    /** The k objects nearest to each point, with distances as values. */
    nearest(points: Numbers, options?: { k?: number; bound?: number }): Answers;
    /** The point of an object that is nearest to a point. */
    nearestPoint(object: number, point: Numbers): Float64Array;
    /** The first segment of the plane above each point (below: direction -1); NONE where there is none. */
    above(points: Numbers, direction?: 1 | -1): Uint32Array;
    /** The first object that each ray meets, and t; NONE and Infinity where there is none. */
    ray(origins: Numbers, directions: Numbers, options?: { tMax?: number }): { objects: Uint32Array; t: Float64Array };
    /** Every object that each ray meets, by t, with t as values. */
    rayAll(origins: Numbers, directions: Numbers, options?: { tMax?: number }): Answers;
    /** Any object that each ray meets; NONE where there is none. */
    rayAny(origins: Numbers, directions: Numbers, options?: { tMax?: number }): Uint32Array;
    /** What lies where a ray meets an object first. */
    hitPlace(object: number, origin: Numbers, direction: Numbers): { point: Float64Array; normal: Float64Array | null; distance: number };
    /** All pairs of objects that meet; `shared` false leaves out pairs that touch in nothing but one corner of both. */
    pairs(options?: { shared?: boolean }): Pairs;
    /** What the questions since the last call have cost. */
    statistics(): Statistics;
}

/** A binary space partition with its scene. Immutable. */
export class Tree extends Questions {
    /** The scene that it was built of, which cannot grow any more. */
    readonly scene: Scene;
    readonly report: Report;
    bounds(): Box | null;
    nodes(): Nodes;
    /** The parts into which objects are cut. */
    pieces(): Pieces;
    /** Regions of the leaves, with `inner` of all nodes, within a box: by default that of the scene and a bit more. */
    cells(options?: { box?: BoxInput | null; inner?: boolean }): Cells;
    /** Cuts within their regions, parents first. */
    cuts(options?: { box?: BoxInput | null }): Cuts;

    /** A picture with hidden surfaces removed, exactly. */
    render(options?: PictureOptions & { format?: "svg" | "pdf" | "eps" | "csv" | "geojson" }): Picture;
    /** One SVG that turns: `count` pictures of a turntable in `seconds` a round. */
    renderTurning(options?: PictureOptions & { count?: number; seconds?: number }): Picture;
    /** A tree of the same scene whose first cut is plane[0] x + plane[1] y + plane[2] z = plane[3]. */
    section(plane: Numbers): Tree;

    /** The bytes of a saved tree, as `froe build` writes it. */
    save(): Uint8Array;
    /** The bytes of a file for other programs: .geojson, .obj or .csv. */
    export(name: string, what?: "fragments" | "cells" | "cuts"): Uint8Array;
    /** Proves that the tree is right, or throws an error that says what is not. */
    audit(options?: { exactOnly?: boolean }): void;
}

export interface MovingBatch {
    /** Vertex v passes the points from starts[v] to starts[v + 1] - 1. */
    starts: Numbers;
    times: Numbers;
    coords: Numbers;
    /** Control points of parabolas; NaN: straight. */
    controls?: Numbers;
    /** With `controls`, the second control points of cubics; NaN: none. */
    secondControls?: Numbers;
    /** Two for each segment of the plane, three for each triangle in space. */
    vertices?: Numbers;
    vertexCount?: number;
    count?: number;
    bodies?: Numbers;
    births?: Numbers;
    deaths?: Numbers;
    tags?: Tags;
    groups?: Numbers;
    group?: number;
}
/** The true times lie between the two numbers of each of `begins` and `ends`. */
export interface Contacts {
    a: Uint32Array;
    b: Uint32Array;
    begins: Float64Array;
    ends: Float64Array;
    instant: Uint8Array;
    sinceStart: Uint8Array;
    toStop: Uint8Array;
}

/** Moving objects in a window of time: segments of the plane, or triangles in space. */
export class Motion extends Resource {
    readonly dim: 2 | 3;
    readonly objectCount: number;
    readonly vertexCount: number;
    readonly bodyCount: number;
    readonly groupCount: number;
    readonly window: { dim: 2 | 3; begin: number; end: number; tick: number };
    add(batch: MovingBatch): this;
    /** Adds a rigid body; returns its number. */
    addBody(body: { times: Numbers; coords: Numbers; controls?: Numbers; turns?: Numbers }): number;
    addGroup(group: Partial<Group>): number;
    group(i: number): Group;
    objects(): { vertices: Uint32Array; births: Float64Array; deaths: Float64Array; groups: Uint32Array; tags: BigUint64Array };
    /** Where all vertices are at a time; NaN where the plan of one does not cover it. */
    positions(time: number): Float64Array;
    /** All contacts, in the order of their beginnings. None is missed. */
    contacts(options?: { from?: number; to?: number; first?: boolean; apart?: boolean }): Contacts;
    /** The same motion, whose bodies are vertices on parabolas, at most `reached` <= `deviation` from where bodies
     * have them. */
    withoutBodies(deviation: number): { motion: Motion; reached: number };
    /** A partition that follows the motion, at the beginning of the window. */
    partition(options?: { seed?: number | bigint; order?: Numbers; epoch?: number; swap?: number; augmented?: boolean }): Kinetic;
    /** The bytes of a file of OGC Moving Features JSON. */
    write(): Uint8Array;
}

/** Event i is of the kind EVENTS[kinds[i]], about the objects 4 i .. 4 i + 3, and happened between early and late. */
export interface Events {
    kinds: Uint8Array;
    objects: Uint32Array;
    counts: Uint32Array;
    /** In space, as seen from above: edge 3 o + c goes on from corner c of object o. */
    edges: Uint32Array;
    edgeCounts: Uint32Array;
    ticks: Float64Array;
    early: Float64Array;
    late: Float64Array;
}
export interface KineticStatistics {
    events: Record<EventKind, number>;
    surgeries: number;
    batches: number;
    crowds: number;
    restarts: number;
    nodesTouched: number;
    certificatesMade: number;
    nodes: number;
    certificates: number;
}

/** A partition of moving objects, exact at every instant that it stands at. */
export class Kinetic extends Resource {
    readonly motion: Motion;
    /** The time that it has reached. */
    readonly time: number;
    /** The time of the next event at the earliest, or Infinity. */
    readonly next: number;
    /** Lets time go on, and returns what happened; with `instants` each more closely. */
    advance(time: number, options?: { instants?: boolean }): Events;
    /** Lets time go on to the next event, at most to a time: the events of that tick. */
    step(until?: number): Events;
    /** Objects that were added to the motion meanwhile take part from now on. */
    update(): void;
    /** Takes an object out, for good. */
    remove(object: number): void;
    /** Compares the partition with one made from scratch, or throws an error that says what is wrong. */
    audit(): void;
    /** The present as a tree, for all questions. */
    snapshot(options?: { refuse?: boolean }): { tree: Tree; rounded: number; alike: boolean };
    locate(point: Numbers): { on: number | null; above: number | null; below: number | null };
    /** The first segment met on the way from one point to another, or null. */
    ray(from: Numbers, to: Numbers): number | null;
    /** The pieces between the walls, those behind first, seen from an eye. */
    order(eye: Numbers): { objects: Uint32Array; coords: Float64Array };
    statistics(): KineticStatistics;
}

export {}; // nothing else is
