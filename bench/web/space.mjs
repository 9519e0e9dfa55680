// space.mjs TREE...: rays and nearest points of models: froe beside three-mesh-bvh, whose coordinates are 32-bit floats.
//
// Half of the rays go anywhere, and half to a corner or to the middle of an edge of the model, where a ray must not slip
// between two triangles. What three-mesh-bvh meets elsewhere than froe, by more than a thousandth of the model's size, is
// counted as wrong, and as missing where its ray has passed what it meets first.
import { readFileSync } from 'node:fs'
import { basename } from 'node:path'
import { froe, inside, meshOf, peer, race, randoms, say } from './race.mjs'

const THREE = await peer('three', inside('three', 'build', 'three.module.js'))
const { MeshBVH } = await peer('three-mesh-bvh', inside('three-mesh-bvh', 'build', 'index.module.js'))
const ROUNDS = 5, RAYS = 20000, POINTS = 5000

for (const file of process.argv.slice(2)) {
  const { coords, indices } = meshOf(readFileSync(file)), objects = indices.length / 3
  const about = (work) => ({ work: `web: ${work}`, scene: basename(file, '.froe'), objects })
  const geometry = () => new THREE.BufferGeometry().setIndex(new THREE.BufferAttribute(indices.slice(), 1))
    .setAttribute('position', new THREE.BufferAttribute(Float32Array.from(coords), 3))
  race(about('make'), 3, {
    froe: () => froe.triangles(coords, indices).build({ purpose: 'query' }).free(),
    'three-mesh-bvh': () => { new MeshBVH(geometry()) }
  })
  const tree = froe.triangles(coords, indices).build({ purpose: 'query' }), bvh = new MeshBVH(geometry())
  const { lo, hi } = tree.bounds(), middle = lo.map((x, k) => (x + hi[k]) / 2), size = Math.hypot(...lo.map((x, k) => hi[k] - x))

  const raysOf = (seed) => {
    const next = randoms(seed), origins = new Float64Array(3 * RAYS), directions = new Float64Array(3 * RAYS)
    for (let i = 0; i < RAYS; i++) {
      const from = middle.map((x) => Math.fround(x + size * 2 * (next() - 0.5)))
      let to = middle.map((x, k) => lo[k] + (hi[k] - lo[k]) * next())
      if (i % 2) {
        const t = 3 * Math.floor(next() * objects), a = 3 * indices[t], b = 3 * indices[t + 1 + (i % 4 >> 1)]
        to = to.map((_, k) => (i % 4 === 1 ? coords[a + k] : (coords[a + k] + coords[b + k]) / 2))
      }
      origins.set(from, 3 * i)
      directions.set(to.map((x, k) => x - from[k]), 3 * i)
    }
    return { origins, directions }
  }
  const rays = Array.from({ length: ROUNDS + 1 }, (_, round) => raysOf(round + 1))
  const ray = new THREE.Ray()
  const first = ({ origins, directions }, i) => {
    ray.origin.fromArray(origins, 3 * i)
    ray.direction.fromArray(directions, 3 * i)
    const length = ray.direction.length()
    ray.direction.divideScalar(length)
    return (bvh.raycastFirst(ray, THREE.DoubleSide)?.distance ?? Infinity)
  }
  race(about('rays'), ROUNDS, {
    froe: (round) => { tree.ray(rays[round].origins, rays[round].directions); return RAYS },
    'three-mesh-bvh': (round) => { for (let i = 0; i < RAYS; i++) first(rays[round], i); return RAYS }
  })
  let wrong = 0, passed = 0
  for (const asked of rays) {
    const { objects: ids, t } = tree.ray(asked.origins, asked.directions)
    for (let i = 0; i < RAYS; i++) {
      const own = ids[i] === 0xffffffff ? Infinity : t[i] * Math.hypot(...asked.directions.subarray(3 * i, 3 * i + 3)), other = first(asked, i)
      if (own === other || Math.abs(own - other) <= size / 1000) continue
      wrong++
      passed += other > own
    }
  }
  const total = rays.length * RAYS
  say({ ...about('rays'), program: 'three-mesh-bvh', measure: 'percent wrong', values: [100 * wrong / total] })
  say({ ...about('rays'), program: 'three-mesh-bvh', measure: 'percent missing', values: [100 * passed / total] })

  const points = Array.from({ length: ROUNDS + 1 }, (_, round) => {
    const next = randoms(round + 9)
    return Float64Array.from({ length: 3 * POINTS }, (_, i) => lo[i % 3] + (hi[i % 3] - lo[i % 3]) * (1.4 * next() - 0.2))
  })
  const at = new THREE.Vector3()
  race(about('closest'), ROUNDS, {
    froe: (round) => { tree.nearest(points[round]); return POINTS },
    'three-mesh-bvh': (round) => {
      for (let i = 0; i < POINTS; i++) bvh.closestPointToPoint(at.fromArray(points[round], 3 * i))
      return POINTS
    }
  })
  const { values } = tree.nearest(points[0])
  let far = 0
  for (let i = 0; i < POINTS; i++) far += Math.abs(bvh.closestPointToPoint(at.fromArray(points[0], 3 * i)).distance - values[i]) > size / 1000
  say({ ...about('closest'), program: 'three-mesh-bvh', measure: 'percent wrong', values: [100 * far / POINTS] })
}
