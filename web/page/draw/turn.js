/* turn.js: a view under the pointer and the keys.
 *
 * Drag: turn. With shift, the right button or two fingers: shift. Wheel and pinch: nearer and farther. Arrows turn, with
 * shift they shift; + and - zoom; 0 fits. */

/** Listens on an element. `view()` is the view as it is; `change(patch)` is told what becomes different; `fitted()` gives
 * the zoom that a fitted view has. Returns what stops it. */
export function turnable(element, view, change, fitted) {
    const fingers = new Map();
    const stop = new AbortController(), on = (type, listen, more = {}) => element.addEventListener(type, listen, { signal: stop.signal, ...more });
    const turn = (right, down) => {
        const { turn, tilt } = view();
        change({ turn: round((turn - right + 540) % 360 - 180), tilt: round(Math.min(90, Math.max(-90, tilt + down))) });
    };
    const shift = (right, down) => {
        const { x, y, zoom } = view();
        change({ ...(zoom ? {} : { zoom: fitted() }), x: round(x + right, 1e4), y: round(y - down, 1e4) });
    };
    const zoom = (factor) => {
        const { zoom, x, y } = view(), now = Math.min(200, Math.max(0.1, (zoom || fitted()) * factor)), by = now / (zoom || fitted());
        change({ zoom: round(now, 1e4), x: round(x * by, 1e4), y: round(y * by, 1e4) });
    };
    const middle = () => {
        const at = [...fingers.values()], n = at.length;
        const x = at.reduce((s, p) => s + p.x, 0) / n, y = at.reduce((s, p) => s + p.y, 0) / n;
        return { x, y, apart: n > 1 ? Math.hypot(at[0].x - at[1].x, at[0].y - at[1].y) : 0 };
    };

    on("pointerdown", (event) => {
        element.setPointerCapture(event.pointerId);
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    });
    on("pointermove", (event) => {
        if (!fingers.has(event.pointerId)) return;
        const before = middle(), height = element.clientHeight;
        fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        const after = middle(), right = after.x - before.x, down = after.y - before.y;
        if (fingers.size > 1 && before.apart) zoom(after.apart / before.apart);
        if (fingers.size > 1 || event.shiftKey || event.buttons === 2) shift(right / height, down / height);
        else turn(180 * right / height, 180 * down / height);
    });
    for (const type of ["pointerup", "pointercancel"]) on(type, (event) => fingers.delete(event.pointerId));
    on("contextmenu", (event) => event.preventDefault());
    on("wheel", (event) => {
        if (document.activeElement !== element && !event.ctrlKey) return; // the page scrolls
        event.preventDefault();
        zoom(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)));
    }, { passive: false });
    on("keydown", (event) => {
        const act = KEYS[event.key];
        if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
        event.preventDefault();
        act({ turn, shift, zoom, change }, event.shiftKey);
    });
    return () => stop.abort();
}

const arrow = (right, down) => ({ turn, shift }, shifted) => (shifted ? shift(0.02 * right, 0.02 * down) : turn(5 * right, 5 * down));
const KEYS = {
    ArrowLeft: arrow(-1, 0), ArrowRight: arrow(1, 0), ArrowUp: arrow(0, -1), ArrowDown: arrow(0, 1),
    "+": ({ zoom }) => zoom(1.1), "=": ({ zoom }) => zoom(1.1), "-": ({ zoom }) => zoom(1 / 1.1),
    0: ({ change }) => change({ zoom: 0, x: 0, y: 0 }),
};
const round = (x, steps = 10) => Math.round(x * steps) / steps;
