/* offline.js: the service worker: once the page was open, it works without a network.
 *
 * files.js lists what belongs to the page, with a version; a page of another version has a cache of its own, which is
 * used once no window shows the old one. Samples and other programs are kept when they are first used. */
importScripts("files.js");
const PREFIX = "froe-page-", NAME = PREFIX + FILES.version;

self.addEventListener("install", (event) => event.waitUntil((async () => {
    const cache = await caches.open(NAME);
    await cache.addAll(FILES.list.map((file) => new Request(file, { cache: "reload" })));
})()));

self.addEventListener("activate", (event) => event.waitUntil((async () => {
    for (const name of await caches.keys()) if (name.startsWith(PREFIX) && name !== NAME) await caches.delete(name);
    await self.clients.claim();
})()));

self.addEventListener("fetch", (event) => {
    const url = new URL(event.request.url);
    if (event.request.method !== "GET" || url.origin !== location.origin) return;
    event.respondWith((async () => {
        const cache = await caches.open(NAME), kept = await cache.match(event.request, { ignoreSearch: true });
        if (kept) return kept;
        const answer = await fetch(event.request);
        if (answer.ok && answer.status === 200) await cache.put(event.request, answer.clone());
        return answer;
    })());
});
