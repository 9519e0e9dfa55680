// race.mjs: what the races of this folder share: peers by name, turns, lines of results (README.md of bench/).
import { createRequire } from 'node:module'
import { join } from 'node:path'
import { pathToFileURL } from 'node:url'

export const froe = await (await import(pathToFileURL(join(process.env.WEB_PACKAGE, 'index.js')).href)).load()
const folder = join(process.env.NPM_FOLDER, 'node_modules')
/** A package of the folder of peers; `file` is one of its own. */
export const peer = (name, file = createRequire(join(folder, 'x.js')).resolve(name)) => import(pathToFileURL(file).href)
export const inside = (...path) => join(folder, ...path)

/** Numbers in [0, 1), the same in every run: Park and Miller, with the multiplier 48271. */
export const randoms = (seed) => {
  let state = seed
  return () => (state = (state * 48271) % 2147483647) / 2147483647
}

export const say = (line) => console.log(JSON.stringify(line))

/** Processor seconds of a call, and what it returned. */
export const timed = (call) => {
  const before = process.cpuUsage(), value = call(), { user, system } = process.cpuUsage(before)
  return [(user + system) / 1e6, value]
}

/** One kind of work: programs take turns, `rounds` times after one that does not count. `programs[name](round)` does the
 * work once and returns how many questions that were, or nothing; `about` has work, scene and objects. */
export const race = (about, rounds, programs) => {
  const seconds = Object.fromEntries(Object.keys(programs).map((name) => [name, []])), counts = {}
  for (let round = 0; round <= rounds; round++)
    for (const [name, work] of Object.entries(programs)) {
      const [spent, count] = timed(() => work(round))
      if (round) seconds[name].push(spent)
      counts[name] = count
    }
  for (const [program, values] of Object.entries(seconds))
    say(counts[program] === undefined ? { ...about, program, measure: 'seconds', values }
      : { ...about, program, measure: 'per second', values: values.map((spent) => counts[program] / spent) })
}

/** The triangles of a saved tree: vertices as 32-bit floats hold them, and three indices each. */
export const meshOf = (bytes) => {
  const { coords, starts, corners } = froe.open(bytes).scene.arrays(), indices = []
  for (let i = 0; i + 1 < starts.length; i++)
    for (let c = starts[i] + 1; c + 1 < starts[i + 1]; c++) indices.push(corners[starts[i]], corners[c], corners[c + 1])
  return { coords: Float64Array.from(coords, Math.fround), indices: Uint32Array.from(indices) }
}
