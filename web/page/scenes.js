/* scenes.js: what a room shows, a sample or files of one's own, and the part of its settings that chooses it */
import { group, opener } from "./controls.js";
import { h } from "./dom.js";
import { mainFirst } from "./open.js";

export class Scenes {
    #host;
    #samples;
    #usual;
    #sourceOf;
    #show;
    #fresh;
    #files = null;   // those that were opened last
    #shown = null;   // the name of what is shown
    #controls = null;
    #credit = h("p", { class: "soft" });
    #opener = null;

    /** `samples` are those of samples.js, `usual` is the name of one; `sampleSource(sample)` and `openFiles(files)` give
     * promises of sources. `show(read)` shows what read() gives. A new scene begins with the state `fresh`. */
    constructor(host, { samples, usual, sampleSource, openFiles, show, fresh }) {
        this.#host = host;
        this.#samples = samples;
        this.#usual = usual;
        this.#sourceOf = { sample: sampleSource, files: openFiles };
        this.#show = show;
        this.#fresh = fresh;
    }

    /** The settings. */
    group(controls, title, label, accept) {
        this.#controls = controls;
        this.#opener = opener("Open a file …", accept, (files) => this.#host.take(files));
        const titles = Object.entries(this.#samples).map(([id, sample]) => [id, sample.title]);
        return group(title, controls.choice("scene", label, [...titles, ["file", "Own file"]], this.#fresh), this.#opener, this.#credit);
    }

    /** Shows the scene that the state names, unless it is shown. Without files of one's own it asks for some, and stays
     * where it is. */
    load() {
        const { scene } = this.#host.state;
        if (scene === this.#shown) return;
        if (scene === "file" && !this.#files) this.#ask();
        else this.again();
    }
    #ask() {
        this.#host.set({ scene: this.#shown ?? this.#usual });
        this.#controls.update();
        if (this.#shown) this.#opener.querySelector("input").click();
        else this.again(); // an address of a file of somewhere else
    }
    /** Shows the scene that the state names, from its beginning. */
    again() {
        const { scene } = this.#host.state, own = scene === "file", files = this.#files, sample = this.#samples[scene];
        this.#shown = scene;
        this.#credit.textContent = own ? `${files[0].name} stays in this browser; nothing is sent.` : `${sample.title}: ${sample.credit}.`;
        this.#show(() => (own ? this.#sourceOf.files(files) : this.#sourceOf.sample(sample)));
    }
    /** Shows files. */
    take(files) {
        this.#files = mainFirst(files);
        this.#shown = null;
        this.#host.set({ ...this.#fresh, scene: "file" });
        this.load();
    }
}
