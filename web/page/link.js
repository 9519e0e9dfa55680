/* link.js: a worker with froe, for the rooms */
import { FroeWorker } from "froe/worker.js";

/** Starts a worker; `progress` is told the share done of what it does. */
export const startFroe = (progress) => FroeWorker.start({ progress });

/** Is it what end() leaves behind? */
export const isCancelled = (error) => error?.status === "FROE_E_CANCELLED";
