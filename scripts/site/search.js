// The search, also where the site is opened as a file: there browsers neither let a page read search_index.json nor start
// a worker from a file. So the index is loaded as a script, and a frame takes the place of the worker.
if (location.protocol === "file:") {
    const base = document.currentScript.src.replace(/search\.js$/, "");
    document.write(`<script src="${base}search/search_index.js"><\/script>`);
    window.Worker = class extends EventTarget {
        constructor(url) {
            super();
            const frame = document.createElement("iframe");
            frame.hidden = true;
            document.body.append(frame);
            this.loaded = new Promise(loaded => { frame.onload = loaded; });
            frame.srcdoc = `<script>postMessage = data => parent.postMessage(data, "*");<\/script>
                            <script src="${new URL(url, location.href)}"><\/script>`;
            this.frame = frame;
            addEventListener("message", event => {
                if (event.source === frame.contentWindow) this.dispatchEvent(new MessageEvent("message", {data: event.data}));
            });
        }
        postMessage(data) {
            this.loaded.then(() => this.frame.contentWindow.dispatchEvent(new MessageEvent("message", {data})));
        }
        terminate() { this.frame.remove(); }
    };
}
