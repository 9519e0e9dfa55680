/* plain.d.ts: as index.d.ts; load() takes the module without vector instructions */
export * from "./index.js";
