// support.mjs: what the tests of the package share. FROE_PACKAGE: its folder; FROE_PROGRAM: the program froe;
// FROE_MODULES: the node_modules of web/package-lock.json; FROE_CHECK: the folder of check.js.
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

export const root = resolve(import.meta.dirname ?? new URL(".", import.meta.url).pathname, "../..");
export const package_ = process.env.FROE_PACKAGE;
export const froe = await import(pathToFileURL(join(package_, "index.js")).href);

export const { FroeError, NONE } = froe;
/** Another module, with memory of its own. */
export const fresh = (options) => froe.load(options);
/** Answers as arrays, each ascending. */
export const lists = (answers) => [...answers].map((ids) => [...ids].sort((a, b) => a - b));

const folder = mkdtempSync(join(tmpdir(), "froe-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
/** A path in a folder that is empty at first. */
export const scratch = (...path) => join(folder, ...path);
/** The program, in that folder; what it prints. */
export const program = (...args) => execFileSync(process.env.FROE_PROGRAM, [...args, "--quiet"], { cwd: folder });
export const run = (command, args, options = {}) => execFileSync(command, args, { cwd: folder, encoding: "utf8", ...options });

/** The package as npm packs and installs it, in the scratch folder: the folder that it is in. Nothing is asked of the
 * network. */
export function installed() {
    const npm = (...args) => run("npm", [...args, "--silent", "--offline", "--no-audit", "--no-fund"]);
    writeFileSync(scratch("package.json"), '{ "private": true, "type": "module" }\n');
    const [{ filename }] = JSON.parse(npm("pack", resolve(package_), "--json"));
    npm("install", `./${filename}`);
    mkdirSync(scratch("examples"));
    symlinkSync(join(root, "data"), scratch("data"));
    return scratch("node_modules", "froe");
}

/** The blocks of a document that begin with ```js or ```ts, each with what the block ```text after it says, or null. */
export function examples(document) {
    const text = readFileSync(join(root, document), "utf8");
    const blocks = [...text.matchAll(/^```(\S*)([^\n]*)\n([^]*?)^```$/gm)];
    return blocks.flatMap(([, language, marks, body], i) => {
        if (!["js", "ts"].includes(language) || marks.includes("no-test")) return [];
        const next = blocks[i + 1]?.[1] === "text" ? blocks[i + 1][3] : null;
        return [{ language, body, shown: next }];
    });
}
