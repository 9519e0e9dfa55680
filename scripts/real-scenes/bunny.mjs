// bunny.mjs FOLDER: the mesh of the npm package "bunny", unpacked there, as OFF.
import { createRequire } from 'node:module';
const { positions, cells } = createRequire(import.meta.url)(process.argv[2]);
console.log(`OFF\n${positions.length} ${cells.length} 0`);
for (const p of positions) console.log(p.join(' '));
for (const c of cells) console.log(`3 ${c.join(' ')}`);
