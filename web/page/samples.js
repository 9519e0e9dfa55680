/* samples.js: scenes that come with the page; each is loaded when it is chosen */
import { openFiles } from "./open.js";

/** Models: by `file`, or made by froe itself: [kind, number of objects]; `up`: the axis that points up, where the file
 * does not say it. */
export const MODELS = {
    house: { title: "House", file: "fzk-haus.glb", credit: "FZK-Haus, KIT/IAI" },
    teapot: { title: "Utah teapot", file: "utah-teapot.obj", up: 1, credit: "Martin Newell, 1975" },
    bracket: { title: "Bracket", file: "bracket.off", credit: "made for froe" },
    hills: { title: "Hills", made: ["terrain", 4000], credit: "made up by froe" },
    city: { title: "City", made: ["city", 3000], credit: "made up by froe" },
};

/** Maps. */
export const MAPS = {
    plan: { title: "Floor plan", file: "freedoom-e1m1.geojson", credit: "Freedoom, level E1M1" },
    rooms: { title: "Rooms", made: ["rooms", 600], credit: "made up by froe" },
    streets: { title: "Town plan", made: ["blocks", 1500], credit: "made up by froe" },
};

async function fetchSample(sample) {
    const answer = await fetch(`samples/${sample.file}`);
    if (!answer.ok) throw new Error(`${sample.title} could not be loaded, since the page is offline or incomplete.`);
    return answer;
}

/** The source of a sample: see open.js. */
export async function sampleSource(sample) {
    if (sample.made) return { name: sample.title, made: sample.made };
    const blob = await (await fetchSample(sample)).blob();
    return { up: sample.up, ...await openFiles([new File([blob], sample.file)]) };
}

/** Motions. */
export const MOTIONS = {
    flight: { title: "Flights", made: ["moving", 40], credit: "made up by froe: short segments, straight from place to place" },
    spin: { title: "Turning segments", made: ["moving-spin", 60], credit: "made up by froe" },
    shapes: { title: "Polygons", made: ["moving-polygons", 60], credit: "made up by froe" },
    cars: { title: "Cars in Bologna", file: "cars-bologna.mfjson", credit: "SUMO, the scenario of Bologna" },
    boxes: { title: "Boxes that fall", made: ["moving-boxes", 60], credit: "made up by froe: contacts in space" },
};

/** The source of a motion: see move/follower.js. */
export async function motionSource(sample) {
    if (sample.made) return { name: sample.title, made: sample.made };
    return { name: sample.file, bytes: new Uint8Array(await (await fetchSample(sample)).arrayBuffer()) };
}
