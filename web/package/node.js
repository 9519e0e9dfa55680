/* node.js: what comes from Node, by names that bundlers for browsers do not try to find */
export const fromNode = (name) => import(/* webpackIgnore: true */ /* @vite-ignore */ `node:${name}`);
