/* controls.js: what the settings of a room are made of: each shows a member of the state and sets it */
import { h } from "./dom.js";

let made = 0;

/** Controls that are bound to the state of a room; update() shows the state as it is now. */
export class Controls {
    #host;
    #shows = [];

    constructor(host) { this.#host = host; }

    update() { for (const show of this.#shows) show(this.#host.state); }

    #bind(show) {
        this.#shows.push(show);
        show(this.#host.state);
    }
    #set(name, value) { this.#host.set({ [name]: value }); }

    /** One of several, in a list: options are [value, text]. `also` is set with it. */
    choice(name, label, options, also = {}) {
        const list = h("select", { onchange: () => this.#host.set({ [name]: list.value, ...also }) },
            options.map(([value, text]) => h("option", { value }, text)));
        this.#bind((state) => { list.value = state[name]; });
        return h("label", { class: "field" }, h("span", {}, label), list);
    }
    /** One of a few, side by side. */
    switch(name, label, options) {
        const group = `switch-${++made}`;
        const buttons = options.map(([value, text]) => [value, text, h("input", { type: "radio", name: group, value,
            onchange: () => this.#set(name, value) })]);
        this.#bind((state) => { for (const [value, , input] of buttons) input.checked = state[name] === value; });
        return h("fieldset", { class: "switch" }, h("legend", {}, label),
            h("div", {}, buttons.map(([, text, input]) => h("label", {}, input, h("span", {}, text)))));
    }
    /** A number between two. `show` turns it into text. */
    slider(name, label, { min, max, step = 1, show = String }) {
        const shown = h("output", {});
        const input = h("input", { type: "range", min, max, step,
            oninput: () => this.#set(name, Number(input.value)) });
        this.#bind((state) => {
            input.value = state[name];
            shown.value = show(state[name]);
            input.setAttribute("aria-valuetext", shown.value);
        });
        return h("label", { class: "field" }, h("span", {}, label, shown), input);
    }
    /** Yes or no. */
    toggle(name, label) {
        const input = h("input", { type: "checkbox", onchange: () => this.#set(name, input.checked) });
        this.#bind((state) => { input.checked = state[name]; });
        return h("label", { class: "toggle" }, input, h("span", {}, label));
    }
}

/** A part of the settings, with a heading. */
export const group = (title, ...content) => h("section", { class: "group" }, h("h2", {}, title), ...content);

export const button = (label, onclick, more = {}) => h("button", { type: "button", onclick, ...more }, label);

/** What is being done, how much of it, and a button that ends it; hidden until something is: { box, what, bar }. */
export function workOf(what, cancel) {
    const bar = h("progress", { max: 1, value: 0, "aria-label": "Progress" }), text = h("span", {}, what);
    return { box: h("div", { class: "work", hidden: true }, text, bar, button("Cancel", cancel)), what: text, bar };
}

/** A button that asks for files. */
export function opener(label, accept, take) {
    const input = h("input", { type: "file", multiple: true, accept, class: "unseen", onchange: () => {
        if (input.files.length) take([...input.files]);
        input.value = "";
    } });
    return h("label", { class: "button" }, input, h("span", {}, label));
}
