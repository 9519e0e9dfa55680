// mesh.mjs: what the peers in JavaScript share: reading OFF, shuffling, running and reporting in the table's columns.
import { readFileSync } from 'node:fs'
import { basename } from 'node:path'

/** Triangles as arrays of 3 points, in the file's own scale: these libraries have fixed epsilons of 1e-5. */
export const readOff = (path) => {
  const tokens = readFileSync(path, 'utf8').split(/\s+/)
  const vertices = Number(tokens[1]), faces = Number(tokens[2])
  const points = [], triangles = []
  let at = 4
  for (let i = 0; i < vertices; i++, at += 3) points.push(tokens.slice(at, at + 3).map(Number))
  for (let i = 0; i < faces; i++, at += 4) triangles.push(tokens.slice(at + 1, at + 4).map((t) => points[Number(t)]))
  return triangles
}

/** Fisher and Yates, with a linear congruential generator (Knuth's MMIX): the same order everywhere. */
const shuffle = (list, seed) => {
  let state = BigInt(seed)
  for (let i = list.length - 1; i > 0; i--) {
    state = BigInt.asUintN(64, state * 6364136223846793005n + 1442695040888963407n)
    const j = Number((state >> 33n) % BigInt(i + 1))
    const kept = list[i]
    list[i] = list[j]
    list[j] = kept
  }
}

const twoAreas = ([a, b, c]) => {
  const u = [0, 1, 2].map((k) => b[k] - a[k]), v = [0, 1, 2].map((k) => c[k] - a[k])
  return Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
}

/** Nodes on the longest path and pieces in all nodes; pieces(node) tells those of one. */
const census = (root, pieces) => {
  const stack = [[root, 1]]
  let total = 0, height = 0
  while (stack.length) {
    const [node, depth] = stack.pop()
    total += pieces(node)
    height = Math.max(height, depth)
    if (node.front) stack.push([node.front, depth + 1])
    if (node.back) stack.push([node.back, depth + 1])
  }
  return [total, height]
}

/** node SCRIPT MESH.off [shuffle]: builds, counts, prints lines of results. Polygons without a plane have no cut, and
 * are left out. */
export const run = (name, build, pieces) => {
  const [, , path, order] = process.argv
  const triangles = readOff(path).filter((t) => twoAreas(t) > 0)
  if (order) shuffle(triangles, 1)
  const start = process.cpuUsage()
  const root = build(triangles)
  const took = process.cpuUsage(start)
  const [total, height] = census(root, pieces)
  const scene = basename(path).replace(/\..*/, ''), program = order ? name + ', shuffled' : name
  for (const [measure, value] of [['pieces', total], ['height', height], ['seconds', (took.user + took.system) / 1e6]])
    console.log(JSON.stringify({ work: 'pieces', scene, objects: triangles.length, program, measure, values: [value] }))
}
