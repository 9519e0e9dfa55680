// The sources of the package as bundlers need them: what they look for is spelled out, and what they cannot find is not.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { package_ } from "./support.mjs";

const sources = readdirSync(package_).filter((name) => name.endsWith(".js"))
    .map((name) => ({ name, text: readFileSync(join(package_, name), "utf8").replace(/\/\*[^]*?\*\//g, "") }));
const found = (pattern) => sources.flatMap(({ name, text }) => [...text.matchAll(pattern)].map(([what]) => `${name}: ${what}`));

test("no module of Node is named where a bundler for browsers would look for it", () => {
    assert.deepEqual(found(/(import|from)\s*\(?\s*["']node:[^"']*["']/g), []);
});

test("the worker of browsers is spelled out in the place that bundlers know, and nowhere else", () => {
    const there = 'new Worker(new URL("./served.js", import.meta.url), { type: "module" })';
    assert.deepEqual(found(/[^\n]*served\.js", import\.meta\.url[^\n]*/g).map((line) => line.includes(there)), [true]);
});

test("no module waits while it is loaded, which bundlers for older browsers refuse", () => {
    assert.deepEqual(found(/^(?!export async |async )[^\s\n/][^\n]*\bawait\b[^\n]*/gm), []);
});
