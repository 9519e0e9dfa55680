/* preview.js: the model while it turns, by WebGL: the colours and the light that froe's pictures have, and lines where
 * froe draws some, but for silhouettes. Triangles hide each other by depth only. */
import {
    BufferAttribute, BufferGeometry, Color, DoubleSide, LineBasicMaterial, LineSegments, Mesh, OrthographicCamera,
    PerspectiveCamera, Plane, Scene, ShaderMaterial, Vector3, WebGLRenderer,
} from "three";
import { featureEdges } from "./edges.js";

/* The hues of materials without a colour, and the light: vector/shade.c. */
const HUES = [0xe9e4d8, 0xb8cbd6, 0xd9b48f, 0xb9c7a0, 0xc9b6cf, 0xe3cf8e, 0xc9a79c, 0xa8c4be];
const LINE = 0x1b2630;
const VERTEX = `
attribute vec4 paint;
varying vec4 colour; varying vec3 at; varying vec3 place;
void main() {
    colour = paint;
    vec4 seen = modelViewMatrix * vec4(position, 1.0);
    at = seen.xyz;
    place = position;
    gl_Position = projectionMatrix * seen;
}`;
const FRAGMENT = `
varying vec4 colour; varying vec3 at; varying vec3 place;
uniform float levels; uniform bool lit; uniform vec4 cut;
void main() {
    if (dot(place, cut.xyz) > cut.w) discard;
    vec3 normal = normalize(cross(dFdx(at), dFdy(at)));
    float light = min(1.0, abs(dot(normal, normalize(vec3(-0.45, 0.7, 0.55)))));
    if (levels > 0.0) light = (floor(light * 0.9999 * levels) + 0.5) / levels;
    gl_FragColor = vec4(lit ? colour.rgb * (0.45 + 0.55 * light) : colour.rgb, colour.a);
}`;

export class Preview {
    #renderer;
    #scene = new Scene();
    #parts = [];
    #faces = [];
    #lines = null;
    #origin = [0, 0, 0];
    #unit = 1;
    #painted = "";
    #uniforms = { levels: { value: 0 }, lit: { value: true }, cut: { value: [0, 0, 0, 1] } };

    constructor(canvas) {
        this.#renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
        this.#renderer.localClippingEnabled = true;
        this.canvas = canvas;
    }

    /** What froe made of the scene: arrays as scene.arrays() gives them, and the groups. */
    show(model) {
        this.#clear();
        // Coordinates are floats here; they are taken from the middle, so that models far from the origin do not shake, and
        // in halves of the longest side, so that floats hold those of every size.
        this.#origin = [0, 1, 2].map((k) => 0.5 * model.lo[k] + 0.5 * model.hi[k]);
        this.#unit = Math.max(...[0, 1, 2].map((k) => 0.5 * model.hi[k] - 0.5 * model.lo[k])) || 1;
        const coords = new Float32Array(model.arrays.coords.length);
        for (let i = 0; i < coords.length; i++) coords[i] = (model.arrays.coords[i] - this.#origin[i % 3]) / this.#unit;
        const { opaque, clear } = cornersOf(model);
        this.#addFaces(model, coords, opaque, false);
        if (clear.length) this.#addFaces(model, coords, clear, true);
        const edges = featureEdges(model.arrays, coords, Math.cos(30 * Math.PI / 180));
        const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(coords, 3)).setIndex(new BufferAttribute(edges, 1));
        const material = new LineBasicMaterial({ color: new Color().setHex(LINE, ""), clippingPlanes: [] });
        this.#lines = new LineSegments(geometry, material);
        this.#add(this.#lines);
    }
    #add(part) {
        part.frustumCulled = false;
        this.#parts.push(part);
        this.#scene.add(part);
    }
    /* corners: vertex and group of each corner, in turn. */
    #addFaces(model, coords, corners, clear) {
        const position = new Float32Array(corners.length / 2 * 3), groups = new Uint32Array(corners.length / 2);
        for (let i = 0; i < groups.length; i++) {
            const v = 3 * corners[2 * i];
            position[3 * i] = coords[v], position[3 * i + 1] = coords[v + 1], position[3 * i + 2] = coords[v + 2];
            groups[i] = corners[2 * i + 1];
        }
        const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(position, 3))
            .setAttribute("paint", new BufferAttribute(new Uint8Array(4 * groups.length), 4, true));
        const material = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms: this.#uniforms,
            side: DoubleSide, transparent: clear, depthWrite: !clear, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
        const faces = new Mesh(geometry, material);
        this.#faces.push({ faces, groups, model });
        this.#add(faces);
    }

    /** How faces look: shading and colours as froe calls them; lines; what the section leaves: a x + b y + c z <= d. */
    style({ shading, ownColours, lines, section }) {
        if (!this.#lines) return;
        const white = shading === "white" || shading === "none";
        this.#uniforms.lit.value = shading === "flat" || shading === "cel";
        this.#uniforms.levels.value = shading === "cel" ? 4 : 0;
        const [a, b, c, d] = section ?? [0, 0, 0, 1], [x, y, z] = this.#origin;
        const at = section ? (d - a * x - b * y - c * z) / this.#unit : d;
        this.#uniforms.cut.value = [a, b, c, at];
        this.#lines.material.clippingPlanes = section ? [new Plane(new Vector3(-a, -b, -c), at)] : [];
        this.#lines.visible = lines || white;
        const painted = white ? "white" : ownColours ? "own" : "file";
        if (painted === this.#painted) return;
        this.#painted = painted;
        for (const { faces, groups, model } of this.#faces) {
            const colours = model.groups.map(({ colour }, i) => (white ? 0xffffffff
                : colour && !ownColours ? colour : (HUES[model.materials[i] % HUES.length] << 8 | 255) >>> 0));
            const paint = faces.geometry.attributes.paint, bytes = new DataView(paint.array.buffer);
            for (let i = 0; i < groups.length; i++)
                bytes.setUint32(4 * i, colours[groups[i]] ?? (white ? 0xffffffff : 0xe9e4d8ff));
            paint.needsUpdate = true;
        }
    }

    /** Draws what a camera of camera.js sees, `width` x `height` pixels. */
    draw(camera, width, height, model) {
        const inside = (point) => point.map((x, k) => (x - this.#origin[k]) / this.#unit), eye = inside(camera.eye), target = inside(camera.target);
        const around = Math.hypot(...inside(model.hi)) || 1;
        const away = Math.hypot(...eye), far = away + 1.1 * around, near = Math.max(away - 1.1 * around, 1e-3 * around);
        const half = Math.tan(camera.fov * Math.PI / 360) * camera.height / (camera.height - 2 * camera.margin);
        const scale = camera.scale * this.#unit, tall = camera.height / 2 / scale, wide = camera.width / 2 / scale;
        const lens = camera.parallel ? new OrthographicCamera(-wide, wide, tall, -tall, away - 1.1 * around, far)
            : new PerspectiveCamera(2 * Math.atan(half) * 180 / Math.PI, camera.width / camera.height, near, far);
        lens.up.set(...camera.axes.up);
        lens.position.set(...eye);
        lens.lookAt(new Vector3(...target));
        this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        const size = this.#renderer.getSize({ set(x, y) { this.x = x; this.y = y; return this; } });
        if (size.x !== width || size.y !== height) this.#renderer.setSize(width, height, false);
        this.#renderer.render(this.#scene, lens);
    }

    #clear() {
        for (const part of this.#parts) {
            this.#scene.remove(part);
            part.geometry.dispose();
            part.material.dispose();
        }
        this.#parts = [];
        this.#faces = [];
        this.#lines = null;
        this.#painted = "";
    }
    /** Gives the memory of the graphics card back. */
    close() {
        this.#clear();
        this.#renderer.dispose();
        this.#renderer.forceContextLoss();
    }
}

/* The corners of triangles, vertex and group each: those that hide what is behind them, and those that do not. Convex
 * polygons become fans. */
function cornersOf({ arrays: { starts, corners, groups }, groups: all }) {
    const opaque = [], clear = [];
    for (let i = 0; i + 1 < starts.length; i++) {
        const group = groups[i], colour = all[group]?.colour ?? 0, list = colour && (colour & 255) < 255 ? clear : opaque;
        for (let c = starts[i] + 1; c + 1 < starts[i + 1]; c++)
            list.push(corners[starts[i]], group, corners[c], group, corners[c + 1], group);
    }
    return { opaque, clear };
}
