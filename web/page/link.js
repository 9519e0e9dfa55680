/* link.js: a worker with froe, for the rooms */
import { FroeWorker } from "froe/worker.js";

/* The smallest module with a vector instruction: type () -> v128, body i32.const 0, i8x16.splat. */
const VECTOR = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 15, 11);

/** Starts a worker, with vector instructions where the browser has them. */
export const startFroe = (progress) => FroeWorker.start({ plain: !WebAssembly.validate(VECTOR), progress });

/** Is it what end() leaves behind? */
export const isCancelled = (error) => error?.status === "FROE_E_CANCELLED";
