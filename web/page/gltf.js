/* gltf.js: glTF and GLB, by three.js */
import { LoadingManager, SRGBColorSpace } from "three";
import { GLTFLoader } from "three/loaders/GLTFLoader.js";
import { triangles } from "./triangles.js";

/** The triangles of a file; `others` are the files that it names. Colours are those of materials; pictures on them are
 * left out. */
export async function readScene(name, bytes, others) {
    const manager = new LoadingManager(), urls = new Map();
    const beside = new Map(others.map((file) => [file.name, file]));
    let missing = null;
    manager.setURLModifier((url) => {
        if (/^(data|blob):/.test(url)) return url;
        const path = decodeURIComponent(url), file = beside.get(path.replace(/.*[/\\]/, ""));
        if (!file) {
            missing ??= path;
            return "data:,";
        }
        if (!urls.has(file)) urls.set(file, URL.createObjectURL(file));
        return urls.get(file);
    });
    try {
        const { scene } = await new GLTFLoader(manager).parseAsync(bytes, "");
        return triangles(name, 1, meshesOf(scene));
    } catch (error) {
        if (missing) throw new Error(`it needs ${missing}, which has to be dropped together with it`);
        if (/DRACO|KTX2|Meshopt/i.test(error.message)) throw new Error("it is compressed, and this page reads glTF without compression");
        throw error;
    } finally {
        for (const url of urls.values()) URL.revokeObjectURL(url);
    }
}

function meshesOf(scene) {
    const meshes = [];
    scene.updateMatrixWorld(true);
    scene.traverse((mesh) => {
        if (!mesh.isMesh) return;
        const material = Array.isArray(mesh.material) ? mesh.material[0] : mesh.material;
        meshes.push({ geometry: mesh.geometry, matrix: mesh.matrixWorld, name: mesh.name || mesh.parent?.name || "",
            material: material?.name ?? "", colour: colourOf(material) });
    });
    return meshes;
}
function colourOf(material) {
    if (!material?.color) return 0;
    const alpha = material.transparent ? Math.round(255 * material.opacity) : 255;
    return ((material.color.getHex(SRGBColorSpace) << 8) | alpha) >>> 0;
}
