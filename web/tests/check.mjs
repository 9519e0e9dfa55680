// Runs web/tests/check.c as it is compiled: check.mjs FOLDER CASES SEED. FOLDER has check.js and check.wasm.
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, cases, seed] = process.argv.slice(2);
const { default: start } = await import(pathToFileURL(resolve(folder, "check.js")).href);
const module = await start({ wasmBinary: readFileSync(join(folder, "check.wasm")), print: (line) => console.log(line) });
process.exitCode = module._check(Number(cases), Number(seed));
