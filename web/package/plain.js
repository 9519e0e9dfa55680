/* plain.js: froe without the vector instructions of WebAssembly */
import * as froe from "./index.js";

export * from "./index.js";
export const load = (options = {}) => froe.load({ ...options, plain: true });
