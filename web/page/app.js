/* app.js: enters the room that the address names, keeps its state there, and hands it the files that are dropped */
import { readAddress, readState, writeState } from "./address.js";
import { h } from "./dom.js";

const ROOMS = {
    draw: () => import("./rooms/draw.js"),
    partition: () => import("./rooms/partition.js"),
    ask: () => import("./rooms/ask.js"),
    move: () => import("./rooms/move.js"),
};
const SETTLED = 300; // milliseconds without a change, after which the address takes the state

const main = document.getElementById("room");
let here = null;      // the room that is open: name, state, and what room.enter() gave
let entering = 0;

/** What a room is given. `stage`, `foot` (a line below the picture) and `panel` are its elements; set() changes the
 * state, and with it the address. */
function host(name, module) {
    const stage = h("section", { class: "stage", "aria-label": `${module.title}: picture` });
    const panel = h("section", { class: "panel", "aria-label": `${module.title}: settings` });
    const status = h("output", { class: "status" }), foot = h("div", { class: "foot" }, status);
    stage.append(foot);
    main.replaceChildren(h("h1", { class: "unseen" }, `${module.title}: ${module.lead}`), stage, panel);
    let timer = 0;
    const it = {
        stage, foot, panel, state: null, files: [],
        /** Changes the state, tells the room, and writes the address once it rests. */
        set(patch) {
            const changed = Object.keys(patch).filter((key) => it.state[key] !== patch[key]);
            if (!changed.length) return;
            Object.assign(it.state, patch);
            clearTimeout(timer);
            timer = setTimeout(() => it.write(), SETTLED);
            here?.room?.change(changed);
        },
        write() {
            clearTimeout(timer);
            const hash = writeState(name, it.state, module.defaults);
            if (hash !== location.hash) history.replaceState(null, "", hash);
        },
        /** Says a sentence below the picture, or puts elements there. */
        say(...content) {
            status.classList.remove("wrong");
            status.replaceChildren(...content);
        },
        /** Says what could not be done. */
        fail(error) {
            console.warn(error);
            status.classList.add("wrong");
            status.replaceChildren(sentence(error, it.files));
        },
        /** Hands the room files that were dropped or chosen. */
        take(files) {
            it.files = files;
            here?.room?.files(files);
        },
        leave() { clearTimeout(timer); },
    };
    return it;
}

/** The message of an error as a sentence. It may begin with the name of a file, which stays as it is. */
function sentence(error, files) {
    const text = String(error?.message ?? error).trim();
    const begun = files.some(({ name }) => text.startsWith(name)) ? text : text.replace(/^[a-z]+(?= )/, (word) => word[0].toUpperCase() + word.slice(1));
    return begun + (/[.!?]$/.test(text) ? "" : ".");
}

async function enter() {
    const { room: named, query } = readAddress();
    const name = Object.hasOwn(ROOMS, named) ? named : "draw";
    if (here?.name === name && here.room) {
        const state = readState(query, here.module.defaults, here.module.allowed);
        const changed = Object.keys(state).filter((key) => state[key] !== here.host.state[key]);
        Object.assign(here.host.state, state);
        if (changed.length) here.room.change(changed);
        return;
    }
    const turn = ++entering;
    if (here) {
        here.host.leave();
        here.room?.leave();
        here = null;
    }
    for (const link of document.querySelectorAll("nav a"))
        if (link.hash === `#${name}`) link.setAttribute("aria-current", "page");
        else link.removeAttribute("aria-current");
    const module = await ROOMS[name]();
    if (turn !== entering) return;
    document.title = `${module.title} · froe`;
    here = { name, module, host: host(name, module) };
    here.host.state = readState(query, module.defaults, module.allowed);
    const room = await module.enter(here.host);
    if (turn === entering) here.room = room;
    else room.leave();
}

addEventListener("hashchange", enter); // by a link or by the history; replaceState() makes none
document.querySelector(".skip").addEventListener("click", (event) => {
    event.preventDefault(); // #room is no address of a room
    main.focus();
});
enter();

/* -- files ------------------------------------------------------------------- */

const carries = (event) => [...event.dataTransfer?.types ?? []].includes("Files");
let over = 0;
addEventListener("dragenter", (event) => { if (carries(event)) document.body.classList.toggle("over", ++over > 0); });
addEventListener("dragleave", (event) => { if (carries(event)) document.body.classList.toggle("over", --over > 0); });
addEventListener("dragover", (event) => { if (carries(event)) event.preventDefault(); });
addEventListener("drop", (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    over = 0;
    document.body.classList.remove("over");
    here?.host.take([...event.dataTransfer.files]);
});

/* -- offline ----------------------------------------------------------------- */

if ("serviceWorker" in navigator && location.protocol !== "file:") navigator.serviceWorker.register("offline.js");
