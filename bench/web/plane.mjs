// plane.mjs: segments of the plane: froe beside flatbush and rbush, which know bounding boxes alone.
//
// Exactly what meets a window they answer together with a test of each candidate, in doubles, as a caller would write it
// (Cohen and Sutherland's cases, then the side of two corners). On a lattice of tenths that test goes wrong: its answers
// are counted against froe's.
import { froe, peer, race, randoms, say } from './race.mjs'

const { default: Flatbush } = await peer('flatbush')
const { default: RBush } = await peer('rbush')
const ROUNDS = 5
const sizes = (process.env.SIZES ?? '100000 1000000').split(' ').map(Number).filter((n) => n <= 1000000)

const boundsOf = (s) => Float64Array.from(s, (x, i) => (i % 4 < 2 ? Math.min(x, s[i + 2]) : Math.max(x, s[i - 2])))

/* Does segment i meet the window, in doubles? */
const meets = (s, i, lx, ly, hx, hy) => {
  const ax = s[4 * i], ay = s[4 * i + 1], bx = s[4 * i + 2], by = s[4 * i + 3]
  if (Math.max(ax, bx) < lx || Math.min(ax, bx) > hx || Math.max(ay, by) < ly || Math.min(ay, by) > hy) return false
  const dx = bx - ax, dy = by - ay, up = dx * dy <= 0
  const one = dx * ((up ? ly : hy) - ay) - dy * (lx - ax), other = dx * ((up ? hy : ly) - ay) - dy * (hx - ax)
  return one * other <= 0
}

const programs = (s) => {
  const bounds = boundsOf(s), n = s.length / 4
  const fill = (index) => { for (let i = 0; i < n; i++) index.add(...bounds.subarray(4 * i, 4 * i + 4)); index.finish(); return index }
  const items = () => Array.from({ length: n }, (_, i) => ({ minX: bounds[4 * i], minY: bounds[4 * i + 1], maxX: bounds[4 * i + 2], maxY: bounds[4 * i + 3], i }))
  const flat = { make: () => fill(new Flatbush(n)), ask: (t, w) => t.search(...w), near: (t, x, y) => t.neighbors(x, y, 1) }
  const r = {
    make: () => new RBush().load(items()),
    ask: (t, [minX, minY, maxX, maxY]) => t.search({ minX, minY, maxX, maxY }).map(({ i }) => i)
  }
  return { flatbush: flat, rbush: r }
}

const windowsOf = (next, count, side) => {
  const windows = new Float64Array(4 * count)
  for (let i = 0; i < count; i++) {
    const x = next(), y = next()
    windows.set([x, y, x + side, y + side], 4 * i)
  }
  return windows
}
const listed = (windows) => Array.from({ length: windows.length / 4 }, (_, i) => windows.subarray(4 * i, 4 * i + 4))

const speed = (n) => {
  const next = randoms(1), short = 1 / Math.sqrt(n), s = new Float64Array(4 * n)
  for (let i = 0; i < n; i++) {
    const x = next(), y = next()
    s.set([x, y, x + short * (next() - 0.5), y + short * (next() - 0.5)], 4 * i)
  }
  const bounds = boundsOf(s), peers = programs(s), about = (work) => ({ work: `web: ${work}`, scene: 'short', objects: n })
  race(about('make'), n > 100000 ? 3 : ROUNDS, {
    froe: () => froe.segments(s).build({ purpose: 'query' }).free(),
    'froe, boxes only': () => froe.boxes(bounds).build({ purpose: 'query' }).free(),
    ...Object.fromEntries(Object.entries(peers).map(([name, { make }]) => [name, () => { make() }]))
  })
  const tree = froe.segments(s).build({ purpose: 'query' }), boxes = froe.boxes(bounds).build({ purpose: 'query' })
  const indexes = Object.entries(peers).map(([name, { make, ask, near }]) => [name, make(), ask, near])
  for (const answers of [1, 10, 1000]) {
    const count = answers > 100 ? 200 : 20000, side = Math.sqrt(answers / n)
    const questions = Array.from({ length: ROUNDS + 1 }, (_, round) => windowsOf(randoms(round + 2), count, side))
    const found = {}
    const sum = (name, ids) => { found[name] = (found[name] ?? 0) + ids.length; return ids }
    race(about(`window of ${answers}`), ROUNDS, {
      froe: (round) => { sum('froe', tree.query(questions[round]).ids); return count },
      ...Object.fromEntries(indexes.map(([name, index, ask]) => [name, (round) => {
        for (const w of listed(questions[round])) sum(name, ask(index, w).filter((i) => meets(s, i, ...w)))
        return count
      }]))
    })
    race(about(`window of ${answers}, boxes only`), ROUNDS, {
      'froe, boxes only': (round) => { boxes.query(questions[round]); return count },
      ...Object.fromEntries(indexes.map(([name, index, ask]) => [name, (round) => { for (const w of listed(questions[round])) ask(index, w); return count }]))
    })
    for (const name of Object.keys(peers))
      if (Math.abs(found[name] - found.froe) > 1e-6 * found.froe) throw new Error(`${name} finds ${found[name]}, froe ${found.froe}`)
  }
  const points = Array.from({ length: ROUNDS + 1 }, (_, round) => { const at = randoms(round + 20); return Float64Array.from({ length: 20000 }, at) })
  race(about('nearest'), ROUNDS, {
    froe: (round) => { tree.nearest(points[round]); return points[round].length / 2 },
    'froe, boxes only': (round) => { boxes.nearest(points[round]); return points[round].length / 2 },
    flatbush: (round) => {
      const p = points[round]
      for (let i = 0; i < p.length; i += 2) indexes[0][3](indexes[0][1], p[i], p[i + 1])
      return p.length / 2
    }
  })
}

/* Segments and windows on a lattice of tenths, where touching is common and doubles are not tenths. */
const exactness = () => {
  const n = 20000, next = randoms(5), tenth = (most) => 0.1 * Math.floor(next() * most), s = Float64Array.from({ length: 4 * n }, () => 0)
  for (let i = 0; i < n; i++) {
    const x = Math.floor(next() * 300), y = Math.floor(next() * 300)
    s.set([0.1 * x, 0.1 * y, 0.1 * (x + Math.floor(next() * 9) - 4), 0.1 * (y + Math.floor(next() * 9) - 4)], 4 * i)
  }
  const windows = Float64Array.from({ length: 4 * 20000 })
  for (let i = 0; i < 20000; i++) {
    const x = tenth(300), y = tenth(300)
    windows.set([x, y, x + 0.3, y + 0.2], 4 * i)
  }
  const right = [...froe.segments(s).build({ purpose: 'query' }).query(windows)].map((ids) => new Set(ids))
  const answers = right.reduce((sum, ids) => sum + ids.size, 0)
  for (const [name, { make, ask }] of Object.entries(programs(s))) {
    const index = make(), wrong = { '': 0, ', boxes only': 0 }
    listed(windows).forEach((w, k) => {
      const candidates = ask(index, w)
      for (const [how, ids] of [[', boxes only', candidates], ['', candidates.filter((i) => meets(s, i, ...w))]]) {
        const hit = ids.filter((i) => right[k].has(i)).length
        wrong[how] += ids.length - hit + right[k].size - hit
      }
    })
    for (const [how, count] of Object.entries(wrong))
      say({ work: 'web: exactness', scene: 'lattice', objects: n, program: name + how, measure: 'percent wrong', values: [100 * count / answers] })
  }
  say({ work: 'web: exactness', scene: 'lattice', objects: n, program: 'froe', measure: 'percent wrong', values: [0] })
}

for (const n of sizes) speed(n)
exactness()
