// drawings.mjs TREE...: a model as SVG: froe beside SVGRenderer of three.js, which sorts triangles by their distance.
//
// Samples on the model are judged by froe's exact rays: a sample is right where the path on top is of a face whose plane
// the ray through the sample meets where it meets the model first. Samples within one unit of the border of a face, as
// four rays around each tell, are left out, since the paths of both are rounded there, and those of three.js overlap.
import { readFileSync } from 'node:fs'
import { basename } from 'node:path'
import { froe, inside, meshOf, peer, race, randoms, say } from './race.mjs'

const ROUNDS = 5, SIZE = 1000, FOV = 35, SAMPLES = 4000

/* SVGRenderer makes elements and sets their attributes; more of a browser it does not need. */
class Element {
  attributes = {}
  childNodes = []
  style = {}
  constructor (name) { this.name = name }
  setAttribute (name, value) { this.attributes[name] = value }
  appendChild (node) { this.childNodes.push(node) }
  removeChild (node) { this.childNodes.splice(this.childNodes.indexOf(node), 1) }
  toString () {
    const own = Object.entries(this.attributes).map(([name, value]) => ` ${name}="${value}"`).join('')
    return `<${this.name}${own}>${this.childNodes.join('')}</${this.name}>`
  }
}
globalThis.document = { createElementNS: (_, name) => new Element(name) }
const THREE = await peer('three', inside('three', 'build', 'three.module.js'))
const { SVGRenderer } = await peer('three', inside('three', 'examples', 'jsm', 'renderers', 'SVGRenderer.js'))
THREE.ColorManagement.enabled = false // colours that stand for faces stay as they are

const minus = (a, b) => a.map((x, k) => x - b[k])
const dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0)
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
const unit = (a) => a.map((x) => x / Math.hypot(...a))

/* The contours of a path in SVG, as arrays of x, y: M, L, H, V and Z, absolute and relative. */
const contoursOf = (d, scale) => {
  const contours = []
  let x = 0, y = 0, command = 'M', at = 0
  const tokens = d.match(/[a-z]|-?[0-9]*\.?[0-9]+(?:e-?[0-9]+)?/gi)
  while (at < tokens.length) {
    if (/[a-z]/i.test(tokens[at])) command = tokens[at++]
    if (/z/i.test(command)) { [x, y] = contours.at(-1); continue }
    const own = command === command.toUpperCase(), kind = command.toLowerCase()
    if (kind !== 'v') x = Number(tokens[at++]) + (own ? 0 : x)
    if (kind !== 'h') y = Number(tokens[at++]) + (own ? 0 : y)
    if (kind === 'm') { contours.push([]); command = own ? 'L' : 'l' }
    contours.at(-1).push(x, y)
  }
  return contours.map((contour) => contour.map((value) => value * scale))
}

/* Paths with what is under a point of the page: the face of the last that contains it, or null. */
const painting = (paths) => {
  const painted = paths.map(({ face, contours }) => {
    const xs = contours.flatMap((c) => c.filter((_, i) => i % 2 === 0)), ys = contours.flatMap((c) => c.filter((_, i) => i % 2))
    const most = (list, of) => list.reduce((a, b) => of(a, b))
    return { face, contours, box: [most(xs, Math.min), most(ys, Math.min), most(xs, Math.max), most(ys, Math.max)] }
  }).reverse()
  const inside = (contours, x, y) => {
    let turns = 0
    for (const c of contours)
      for (let i = 0, j = c.length - 2; i < c.length; j = i, i += 2) {
        if (c[j + 1] <= y === c[i + 1] <= y) continue
        const side = (c[i] - c[j]) * (y - c[j + 1]) - (c[i + 1] - c[j + 1]) * (x - c[j])
        if (c[j + 1] <= y ? side > 0 : side < 0) turns += c[j + 1] <= y ? 1 : -1
      }
    return turns !== 0
  }
  return (x, y) => painted.find(({ box, contours }) => x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3] && inside(contours, x, y))?.face ?? null
}

for (const file of process.argv.slice(2)) {
  const { coords, indices } = meshOf(readFileSync(file)), objects = indices.length / 3, scene = basename(file, '.froe')
  const corner = (i) => [...coords.subarray(3 * indices[i], 3 * indices[i] + 3)]
  const about = (work) => ({ work: `web: ${work}`, scene, objects })
  const tree = froe.triangles(coords, indices).build({ purpose: 'draw' }), { lo, hi } = tree.bounds()
  const middle = [...lo].map((x, k) => (x + hi[k]) / 2), size = Math.hypot(...minus([...hi], [...lo])), up = [0, 1, 0]
  const eyes = Array.from({ length: ROUNDS + 1 }, (_, i) => {
    const turn = 0.5 + i
    return middle.map((x, k) => x + 1.6 * size * [Math.cos(turn), 0.45, Math.sin(turn)][k])
  })
  const view = (eye) => ({ eye, target: middle, up, fov: FOV, fit: false, width: SIZE, height: SIZE, margin: 0, lines: [] })

  // three.js: a triangle mesh with a light, and the same with a colour for each triangle.
  const geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.BufferAttribute(
    Float32Array.from({ length: 9 * objects }, (_, i) => coords[3 * indices[Math.floor(i / 3)] + i % 3]), 3))
  geometry.computeVertexNormals()
  geometry.setAttribute('color', new THREE.BufferAttribute(Float32Array.from({ length: 9 * objects }, (_, i) =>
    (Math.floor(i / 9) + 1 >> [16, 8, 0][i % 3] & 255) / 255), 3))
  const renderer = new SVGRenderer()
  renderer.setSize(SIZE, SIZE)
  renderer.setPrecision(2)
  const worldOf = (material) => new THREE.Scene().add(new THREE.Mesh(geometry, material), new THREE.DirectionalLight(), new THREE.AmbientLight(0x404040))
  const lit = worldOf(new THREE.MeshLambertMaterial({ color: 0xd8d0c0, side: THREE.DoubleSide }))
  const named = worldOf(new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide }))
  const draw = (world, eye) => {
    const camera = new THREE.PerspectiveCamera(FOV, 1, size / 1000, size * 10)
    camera.position.set(...eye)
    camera.up.set(...up)
    camera.lookAt(...middle)
    renderer.render(world, camera)
    return renderer.domElement
  }

  race(about('first drawing'), 3, {
    froe: (round) => { froe.triangles(coords, indices).build({ purpose: 'draw' }).render(view(eyes[round])) },
    'three.js SVGRenderer': (round) => { String(draw(worldOf(lit.children[0].material), eyes[round])) }
  })
  race(about('another view'), ROUNDS, {
    froe: (round) => { tree.render(view(eyes[round])) },
    'three.js SVGRenderer': (round) => { String(draw(lit, eyes[round])) }
  })
  const eye = eyes[1], count = (program, measure, value) => say({ ...about('another view'), program, measure, values: [value] })
  const own = tree.render(view(eye)), other = draw(lit, eye)
  count('froe', 'bytes', own.bytes.length)
  count('froe', 'shapes', own.paths)
  count('three.js SVGRenderer', 'bytes', String(other).length)
  count('three.js SVGRenderer', 'shapes', other.childNodes.length)

  // What each shows at the samples.
  const text = tree.render({ ...view(eye), ids: 'face' }).text, scale = Number(/scale\(([0-9.]+)\)/.exec(text)[1])
  const paintings = {
    froe: painting([...text.matchAll(/<path [^>]*data-object="([0-9]+)"[^>]* d="([^"]+)"/g)].map(([, face, d]) => ({ face: Number(face), contours: contoursOf(d, scale) }))),
    'three.js SVGRenderer': painting(draw(named, eye).childNodes.map(({ attributes: { d, style } }) => {
      const [r, g, b] = /rgb\((\d+),\s*(\d+),\s*(\d+)\)/.exec(style).slice(1).map(Number)
      return { face: (r << 16 | g << 8 | b) - 1, contours: contoursOf(d, 1).map((c) => c.map((x) => x + SIZE / 2)) }
    }))
  }
  const back = unit(minus(eye, middle)), right = unit(cross(up, back)), above = cross(back, right), reach = Math.tan(FOV * Math.PI / 360)
  const towards = (x, y) => right.map((r, k) => r * reach * (2 * x / SIZE - 1) + above[k] * reach * (1 - 2 * y / SIZE) - back[k])
  const along = (face, way) => {
    const a = corner(3 * face), normal = cross(minus(corner(3 * face + 1), a), minus(corner(3 * face + 2), a))
    return dot(normal, minus(a, eye)) / dot(normal, way)
  }
  const next = randoms(7), wrong = { froe: 0, 'three.js SVGRenderer': 0 }
  let judged = 0
  while (judged < SAMPLES) {
    const x = SIZE * next(), y = SIZE * next(), ways = [[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]].map(([dx, dy]) => towards(x + dx, y + dy))
    const { objects: hits, t } = tree.ray(ways.flatMap(() => eye), ways.flat()), none = hits.includes(0xffffffff)
    if (none || ![...hits].every((_, i) => Math.abs(along(hits[0], ways[i]) - t[i]) <= 1e-5 * t[i])) continue
    judged++
    for (const [name, at] of Object.entries(paintings)) {
      const face = at(x, y)
      wrong[name] += face === null || !(Math.abs(along(face, ways[0]) - t[0]) <= 1e-4 * t[0])
    }
  }
  for (const [name, number] of Object.entries(wrong)) count(name, 'percent wrong', 100 * number / judged)
}
