/* open.js: files become scenes.
 *
 * froe reads OBJ, OFF, PLY, GeoJSON and CSV itself, with all digits; three.js reads glTF and STL. What comes out is a
 * source, from which a scene can be made in any worker, several times:
 *
 *     { name, made: [kind, n] }                      froe makes it up
 *     { name, bytes, files }                         froe reads it
 *     { name, groups, coords, groupOf }          triangles: 9 numbers each, and the number of a group each
 *
 * Each may have `up`, the axis that points up. */

const LARGEST = 600e6; // bytes of a file; it is in memory several times while it is read
const OWN = ["obj", "off", "ply", "geojson", "json", "csv"];
/** For inputs of files. */
export const MODEL_FILES = ".glb,.gltf,.obj,.stl,.ply,.off,.mtl,.bin";
export const MAP_FILES = ".geojson,.json,.csv";

const ending = (name) => name.slice(name.lastIndexOf(".") + 1).toLowerCase();

const isScene = (file) => Object.hasOwn(READERS, ending(file.name));
/** Files, the scene before what it names. */
export const mainFirst = (files) => [...files].sort((a, b) => isScene(b) - isScene(a));

/** The source that files are: one of them is the scene, the others are what it names. */
export async function openFiles(files) {
    const [main, ...others] = mainFirst(files), second = others.find(isScene);
    if (!isScene(main)) throw new Error(`${main.name} is not of a format that is read here: glTF, OBJ, STL, PLY, OFF, GeoJSON or CSV.`);
    if (second) throw new Error(`${main.name} and ${second.name} are two scenes, which are opened one by one.`);
    for (const file of files) {
        if (file.size > LARGEST)
            throw new Error(`${file.name} has ${Math.round(file.size / 1e6)} MB, and a page can read ${LARGEST / 1e6} MB at most: ` +
                "the program froe has no such limit");
        if (!file.size) throw new Error(`${file.name} is empty.`);
    }
    return READERS[ending(main.name)](main, others);
}

const bytesOf = async (file) => new Uint8Array(await file.arrayBuffer());

async function readOwn(file, others) {
    const beside = {};
    for (const other of others) beside[other.name] = await bytesOf(other);
    return { name: file.name, bytes: await bytesOf(file), files: beside };
}

async function readStl(file) {
    const [{ STLLoader }, { triangles }] = [await import("three/loaders/STLLoader.js"), await import("./triangles.js")];
    const bytes = await file.arrayBuffer();
    const geometry = named(file, "STL", () => new STLLoader().parse(bytes));
    return triangles(file.name, 2, [{ geometry, name: "", material: "", colour: 0 }]);
}

async function readGltf(file, others) {
    const { readScene } = await import("./gltf.js");
    const bytes = await file.arrayBuffer();
    return named(file, "glTF", () => readScene(file.name, bytes, others));
}

/* What a library cannot read, with the name of the file. */
function named(file, format, read) {
    const tell = (error) => {
        const why = error instanceof TypeError || error instanceof RangeError ? "it is damaged or not complete" : error?.message ?? error;
        throw new Error(`${file.name} could not be read as ${format}: ${String(why).replace(/^THREE\.\w+: /, "")}`);
    };
    try {
        const result = read();
        return result instanceof Promise ? result.catch(tell) : result;
    } catch (error) {
        return tell(error);
    }
}

const READERS = { glb: readGltf, gltf: readGltf, stl: readStl, ...Object.fromEntries(OWN.map((format) => [format, readOwn])) };

/** How many groups are asked for their names. */
export const NAMED = 5000;
/** The groups of a scene in a worker, `most` of them at most. */
export async function groupsOf(scene, most = Infinity) {
    const count = await scene.groupCount();
    return Promise.all(Array.from({ length: Math.min(count, most) }, (_, i) => scene.group(i)));
}

/** The scene of a source, in a worker. */
export async function sceneFrom(froe, source) {
    const scene = await bareScene(froe, source);
    if (source.up !== undefined) await scene.up(source.up);
    return scene;
}
async function bareScene(froe, source) {
    if (source.made) return froe.generate(...source.made);
    if (source.bytes) return froe.read(source.name, source.bytes, { files: source.files });
    const scene = await froe.scene(3);
    // All at once: if the worker ends, each of these is refused, and none may be left without a handler.
    await Promise.all([...source.groups.map((group) => scene.addGroup(group)),
        scene.add({ kind: "polygon", coords: source.coords, groups: source.groupOf })]).catch((error) => {
        error.message = `${source.name}: ${error.message}`;
        throw error;
    });
    return scene;
}
