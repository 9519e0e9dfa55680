// jscad.mjs: @jscad/modeling: the middle polygon's plane cuts, an explicit stack; planes equal within an epsilon are one.
import { createRequire } from 'node:module'
import { run } from './mesh.mjs'

const require = createRequire(process.env.NPM_FOLDER + '/')
const { geometries } = require('@jscad/modeling')
const { Tree } = require('@jscad/modeling/src/operations/booleans/trees')
run('@jscad/modeling', (triangles) => new Tree(triangles.map((t) => geometries.poly3.create(t))).rootnode,
  (node) => node.polygontreenodes.length)
