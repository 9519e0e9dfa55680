// csg.mjs: csg.js (npm csg): the first polygon's plane cuts, whatever lies in it stays in the node.
import { createRequire } from 'node:module'
import { run } from './mesh.mjs'

const CSG = createRequire(process.env.NPM_FOLDER + '/')('csg')
const polygon = (t) => new CSG.Polygon(t.map((p) => new CSG.Vertex(p, [0, 0, 1])))
run('csg.js', (triangles) => new CSG.Node(triangles.map(polygon)), (node) => node.polygons.length)
