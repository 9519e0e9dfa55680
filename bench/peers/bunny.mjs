// bunny.mjs: the mesh of npm bunny as OFF.
import { createRequire } from 'node:module'

const { positions, cells } = createRequire(process.env.NPM_FOLDER + '/')('bunny')
const lines = ['OFF', `${positions.length} ${cells.length} 0`]
for (const p of positions) lines.push(p.join(' '))
for (const c of cells) lines.push(`3 ${c.join(' ')}`)
console.log(lines.join('\n'))
