/* dom.js: elements */

/** An element: h("button", { class: "go", onclick }, "Draw"). What begins with "on" listens; false and null are left
 * out, true is an empty attribute. */
export function h(tag, given = {}, ...content) {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(given)) {
        if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
        else if (value !== false && value !== null && value !== undefined)
            element.setAttribute(name, value === true ? "" : value);
    }
    element.append(...content.flat().filter((part) => part !== null && part !== undefined && part !== false));
    return element;
}

/** The contents of a list of facts: [term, what is told of it], ... */
export const factsOf = (facts) => facts.flatMap(([term, told]) => [h("dt", {}, term), h("dd", {}, told)]);

/** Gives a file to whoever looks at the page. */
export function save(name, bytes, type) {
    const url = URL.createObjectURL(new Blob([bytes], { type }));
    h("a", { href: url, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 60000);
}

/** 1234567 as 1,234,567. */
export const count = (n) => n.toLocaleString("en");
/** 1 piece, 2 pieces. */
export const counted = (n, one, several = `${one}s`) => `${count(n)} ${n === 1 ? one : several}`;
/** Bytes as 12 kB or 3.4 MB. */
export const size = (bytes) => (bytes < 1e6 ? `${Math.ceil(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB`);
