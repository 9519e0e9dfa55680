/* animate_page.c: a motion as a page that plays it: the plans as they are, and a program that draws them. Nothing is
 * fetched from anywhere. */
#include "formats/motion/animate.h"
#include <math.h>

static const char head[] =
    "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>froe simulate</title>\n"
    "<meta name='viewport' content='width=device-width'>\n<style>\n"
    "body { margin: 0; font: 14px/1.4 system-ui, sans-serif; color: #222; background: #f4f4f2 }\n"
    "main { display: flex; flex-wrap: wrap; gap: 16px; padding: 16px; justify-content: center }\n"
    "canvas { background: #fff; border: 1px solid #ccc; max-width: 100%; display: block }\n"
    "#bar { display: flex; gap: 8px; align-items: center; margin-top: 8px } #time { flex: 1 }\n"
    "#now { font-variant-numeric: tabular-nums; min-width: 9em; text-align: right }\n"
    "aside { width: 25em; max-height: 90vh; overflow: auto } table { border-collapse: collapse; width: 100% }\n"
    "td, th { padding: 2px 6px; text-align: left; font-variant-numeric: tabular-nums } tr.hit { color: #d62839 }\n"
    "tbody tr { cursor: pointer } tbody tr:hover { background: #e4e8ec }\n"
    "</style></head><body><main><div><canvas id='picture'></canvas><div id='bar'>\n"
    "<button id='play'>Pause</button><input id='time' type='range' min='0' max='1' step='any' value='0' "
    "aria-label='time'>\n"
    "<select id='speed' aria-label='speed'><option value='.1'>1/10</option><option value='.3'>1/3</option>"
    "<option value='1' selected>1 x</option><option value='3'>3 x</option></select>\n"
    "<span id='now'></span></div></div>\n"
    "<aside><h3 id='title'></h3><table><thead><tr><th>from</th><th>to</th><th>objects</th></tr></thead>"
    "<tbody id='list'></tbody></table></aside></main>\n<script>\n";

static const char program[] =
    "const $ = id => document.getElementById(id), picture = $('picture'), pen = picture.getContext('2d');\n"
    "const dense = window.devicePixelRatio || 1, length = motion.end - motion.begin, shown = 1000;\n"
    "picture.width = motion.width * dense; picture.height = motion.height * dense;\n"
    "picture.style.width = motion.width + 'px';\n"
    "let now = motion.begin, playing = true, before = null, chosen = -1;\n"
    "/* a knot: time, x, y, control x, control y (null: straight) */\n"
    "function place(plan, t) {\n"
    "  let low = 0, high = plan.length - 1;\n"
    "  while (high - low > 1) { const m = low + high >> 1; if (plan[m][0] <= t) low = m; else high = m }\n"
    "  const p = plan[low], q = plan[Math.min(low + 1, plan.length - 1)];\n"
    "  const s = p === q ? 0 : Math.min(1, Math.max(0, (t - p[0]) / (q[0] - p[0]))), r = 1 - s;\n"
    "  const at = k => p[3] === null ? r * p[k] + s * q[k] : r * r * p[k] + 2 * r * s * p[k + 2] + s * s * q[k];\n"
    "  return [motion.margin + (at(1) - motion.lo[0]) * motion.scale, "
    "motion.margin + (motion.hi[1] - at(2)) * motion.scale];\n}\n"
    "function draw() {\n"
    "  const touching = new Set(), slack = length * 0.004;\n"
    "  motion.contacts.forEach(c => { if (c[2] <= now && now <= Math.max(c[3], c[2] + slack)) "
    "touching.add(c[0]).add(c[1]) });\n"
    "  pen.setTransform(dense, 0, 0, dense, 0, 0); pen.clearRect(0, 0, motion.width, motion.height);\n"
    "  pen.lineCap = 'round';\n"
    "  motion.objects.forEach((o, i) => {\n"
    "    if (now < o[2] || now > o[3]) return;\n"
    "    const p = place(motion.vertices[o[0]], now), q = place(motion.vertices[o[1]], now), red = touching.has(i);\n"
    "    pen.lineWidth = red ? 3.5 : 2; pen.strokeStyle = red ? '#d62839' : '#26547c';\n"
    "    pen.beginPath(); pen.moveTo(...p); pen.lineTo(...q); pen.stroke();\n"
    "    if (red) { pen.globalAlpha = 0.2; pen.lineWidth = 18; pen.stroke(); pen.globalAlpha = 1 }\n"
    "    if (chosen >= 0 && motion.contacts[chosen].slice(0, 2).includes(i)) {\n"
    "      pen.lineWidth = 1; pen.strokeStyle = '#f4a259'; pen.beginPath();\n"
    "      pen.arc((p[0] + q[0]) / 2, (p[1] + q[1]) / 2, 18, 0, 7); pen.stroke() }\n"
    "  });\n"
    "  $('time').value = (now - motion.begin) / length; $('now').textContent = now.toFixed(motion.digits);\n"
    "  document.querySelectorAll('#list tr').forEach((row, i) => { const c = motion.contacts[i];\n"
    "    row.className = c[2] <= now && now <= Math.max(c[3], c[2] + slack) ? 'hit' : '' });\n}\n"
    "function name(i) { return motion.objects[i][4] || i }\n"
    "$('title').textContent = motion.contacts.length + ' contacts of ' + motion.objects.length + ' objects' +\n"
    "  (motion.contacts.length > shown ? ', the first ' + shown + ':' : '');\n"
    "motion.contacts.slice(0, shown).forEach((c, i) => {\n"
    "  const row = $('list').insertRow();\n"
    "  [c[2].toFixed(motion.digits), c[4] ? 'instant' : c[3].toFixed(motion.digits), name(c[0]) + ' · ' + name(c[1])]\n"
    "    .forEach(text => row.insertCell().textContent = text);\n"
    "  row.onclick = () => { chosen = i; now = c[2]; stop(); draw() };\n});\n"
    "function stop() { playing = false; $('play').textContent = 'Play' }\n"
    "function step(clock) {\n"
    "  if (before !== null) now += (clock - before) / 1000 / motion.seconds * length * $('speed').value;\n"
    "  before = clock; if (now > motion.end) now = motion.begin;\n"
    "  draw(); if (playing) requestAnimationFrame(step) }\n"
    "function play() { playing = true; before = null; $('play').textContent = 'Pause'; requestAnimationFrame(step) }\n"
    "$('play').onclick = () => playing ? stop() : play();\n"
    "$('time').oninput = e => { stop(); now = motion.begin + e.target.value * length; draw() };\n"
    "const share = parseFloat(location.hash.slice(1)); /* page.html#0.5 stands still in the middle */\n"
    "if (share >= 0) { now = motion.begin + share * length; stop(); draw() } else play();\n"
    "</script></body></html>\n";

static void put_member(formats_writer *w, const char *name, double value) {
    formats_put(w, name);
    formats_put_number(w, value);
}

static void put_plans(formats_writer *w, const froe_motion *m) {
    for (uint32_t v = 0; v < froe_motion_vertex_count(m); v++) {
        formats_put(w, v ? ",\n[" : "\n[");
        for (size_t i = 0; i < froe_motion_knot_count(m, v); i++) {
            froe_moving_knot k = froe_motion_knot(m, v, i);
            put_member(w, i ? ",[" : "[", k.time);
            for (int axis = 0; axis < 2; axis++) put_member(w, ",", k.at[axis]);
            if (isnan(k.control[0])) formats_put(w, ",null");
            for (int axis = 0; axis < 2 && !isnan(k.control[0]); axis++) put_member(w, ",", k.control[axis]);
            formats_put(w, "]");
        }
        formats_put(w, "]");
    }
}

void formats_animate_page(formats_writer *w, const formats_animation *a) {
    int digits = 0; /* behind the point, that tell instants of the window apart */
    for (double step = (a->end - a->begin) / 1000; step < 1 && digits < 12; step *= 10) digits++;
    formats_put(w, head);
    put_member(w, "const motion = {begin: ", a->begin);
    put_member(w, ", end: ", a->end);
    put_member(w, ", width: ", a->options.width);
    put_member(w, ", height: ", a->height);
    put_member(w, ", margin: ", FORMATS_ANIMATION_MARGIN);
    put_member(w, ", scale: ", a->scale);
    put_member(w, ", seconds: ", a->options.seconds);
    put_member(w, ", digits: ", digits);
    put_member(w, ", lo: [", a->lo[0]);
    put_member(w, ", ", a->lo[1]);
    put_member(w, "], hi: [", a->hi[0]);
    put_member(w, ", ", a->hi[1]);
    formats_put(w, "],\nvertices: [");
    put_plans(w, a->motion);
    formats_put(w, "],\nobjects: [");
    for (uint32_t i = 0; i < froe_motion_object_count(a->motion); i++) {
        froe_moving_object o = froe_motion_object(a->motion, i);
        formats_put(w, i ? ",\n[" : "\n[");
        formats_put_whole(w, o.vertices[0]);
        put_member(w, ",", o.vertices[1]);
        put_member(w, ",", o.birth);
        put_member(w, ",", o.death);
        formats_put(w, ",");
        const char *name = o.group == FROE_NONE ? "" : froe_motion_group(a->motion, o.group).name;
        char safe[64] = ""; /* in a script no text may end it */
        for (size_t k = 0; name[k] && k + 1 < sizeof safe; k++) safe[k] = name[k] == '<' ? '(' : name[k];
        formats_put_json(w, safe);
        formats_put(w, "]");
    }
    formats_put(w, "],\ncontacts: [");
    for (size_t i = 0; i < a->count; i++) {
        const froe_contact *c = a->contacts + i;
        formats_put(w, i ? ",\n[" : "\n[");
        formats_put_whole(w, c->a);
        put_member(w, ",", c->b);
        put_member(w, ",", c->begin[0]);
        put_member(w, ",", c->end[1]);
        formats_put(w, c->instant ? ",1]" : ",0]");
    }
    formats_put(w, "]};\n");
    formats_put(w, program);
}
