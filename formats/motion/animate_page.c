/* animate_page.c: a motion as a page that plays it: the plans as they are, and a program that draws them (player.js).
 * Nothing is fetched from anywhere. */
#include "formats/motion/animate.h"
#include "formats/motion/embedded.h"
#include <math.h>

static const char beginning[] = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                                "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
                                "<title>Moving objects and their contacts</title>\n<style>\n";

static const char body[] =
    "</style>\n</head>\n<body>\n<header>\n<h1>Moving objects and their contacts</h1>\n</header>\n"
    "<main class=\"player\">\n<div>\n";

static const char canvas[] =
    "<canvas id=\"picture\" role=\"img\" aria-label=\"Moving segments. Those in contact are orange, and a glass shows "
    "them larger.\"></canvas>\n";

static const char film[] = "<div id=\"picture\">\n";

static const char controls[] =
    "<canvas id=\"marks\" aria-hidden=\"true\"></canvas>\n"
    "<input id=\"time\" type=\"range\" min=\"0\" max=\"1\" step=\"any\" value=\"0\" aria-label=\"Time\">\n"
    "<div class=\"ends\"><small id=\"first\"></small><small id=\"final\"></small></div>\n"
    "<div class=\"controls\">\n"
    "<button id=\"back\" type=\"button\" aria-label=\"Previous contact\" title=\"Previous contact (Shift and left "
    "arrow)\">&#9664;</button>\n"
    "<button id=\"play\" type=\"button\" title=\"Play or pause (space)\">Play</button>\n"
    "<button id=\"next\" type=\"button\" aria-label=\"Next contact\" title=\"Next contact (Shift and right "
    "arrow)\">&#9654;</button>\n"
    "<select id=\"speed\" aria-label=\"Speed\"><option value=\".1\">1/10 speed</option>"
    "<option value=\".3\">1/3 speed</option><option value=\"1\" selected>full speed</option>"
    "<option value=\"3\">3 times</option></select>\n"
    "<label><input id=\"halt\" type=\"checkbox\"> pause at contacts</label>\n"
    "<output id=\"now\" for=\"time\" aria-live=\"off\"></output>\n</div>\n"
    "<p class=\"soft\">Space plays and pauses, arrows move in time, and with Shift from contact to contact.</p>\n"
    "<div id=\"say\" class=\"unseen\" aria-live=\"polite\"></div>\n"
    "<noscript><p>The player needs JavaScript, which this browser does not run.</p></noscript>\n</div>\n"
    "<aside aria-labelledby=\"title\">\n<h2 id=\"title\"></h2>\n<p class=\"soft\" id=\"among\"></p>\n"
    "<div id=\"box\"><ol id=\"list\"></ol></div>\n</aside>\n</main>\n<script>\n";

static void put_file(formats_writer *w, const char *name) {
    const support_embedded *file = support_embedded_named(formats_embedded_files, name);
    if (file) support_writer_put(&w->out, file->bytes, file->size);
}

static void put_member(formats_writer *w, const char *name, double value) {
    formats_put(w, name);
    formats_put_number(w, value);
}

static void put_plans(formats_writer *w, const formats_animation *a) {
    for (uint32_t v = 0; v < froe_motion_vertex_count(a->motion); v++) {
        size_t first, end;
        formats_animation_knots(a, v, &first, &end);
        formats_put(w, v ? ",\n[" : "\n[");
        for (size_t i = first; i < end; i++) {
            froe_moving_knot k = froe_motion_knot(a->motion, v, i);
            put_member(w, i > first ? ",[" : "[", k.time);
            for (int axis = 0; axis < 2; axis++) put_member(w, ",", k.at[axis]);
            if (isnan(k.control[0])) formats_put(w, ",null");
            for (int axis = 0; axis < 2 && !isnan(k.control[0]); axis++) put_member(w, ",", k.control[axis]);
            for (int axis = 0; axis < 2 && !isnan(k.second[0]); axis++) put_member(w, ",", k.second[axis]);
            formats_put(w, "]");
        }
        formats_put(w, "]");
    }
}

static void put_objects(formats_writer *w, const froe_motion *motion) {
    for (uint32_t i = 0; i < froe_motion_object_count(motion); i++) {
        const froe_moving_object o = froe_motion_object(motion, i);
        formats_put(w, i ? ",\n[" : "\n[");
        formats_put_whole(w, o.vertices[0]);
        put_member(w, ",", o.vertices[1]);
        put_member(w, ",", o.birth);
        put_member(w, ",", o.death);
        formats_put(w, ",");
        formats_put_json(w, o.group == FROE_NONE ? "" : froe_motion_group(motion, o.group).name);
        formats_put(w, "]");
    }
}

static void put_contacts(formats_writer *w, const formats_animation *a) {
    for (size_t i = 0; i < a->count; i++) {
        const froe_contact *c = a->contacts + i;
        formats_put(w, i ? ",\n[" : "\n[");
        formats_put_whole(w, c->a);
        put_member(w, ",", c->b);
        put_member(w, ",", c->begin[0]);
        put_member(w, ",", c->end[1]);
        formats_put(w, c->instant ? ",1]" : ",0]");
    }
}

froe_status formats_animate_page(formats_writer *w, const formats_animation *a, froe_diagnostic *diag) {
    const bool solid = froe_motion_window(a->motion).dim == 3;
    froe_status status = FROE_OK;
    int digits = 0; /* behind the point, that tell instants of the window apart */
    for (double step = (a->end - a->begin) / 1000; step < 1 && digits < 12; step *= 10) digits++;
    formats_put(w, beginning);
    put_file(w, "page.css");
    put_file(w, "player.css");
    formats_put(w, body);
    formats_put(w, solid ? film : canvas);
    if (solid) status = formats_animate_film(w, a, diag);
    if (status) return status;
    if (solid) formats_put(w, "</div>\n");
    formats_put(w, controls);
    put_member(w, solid ? "const motion = {solid: true, begin: " : "const motion = {begin: ", a->begin);
    put_member(w, ", end: ", a->end);
    formats_put(w, a->clock ? ", clock: true" : ", clock: false");
    put_member(w, ", width: ", a->options.width);
    put_member(w, ", seconds: ", a->options.seconds);
    put_member(w, ", digits: ", digits);
    put_member(w, ", lo: [", a->lo[0]);
    put_member(w, ", ", a->lo[1]);
    put_member(w, "], hi: [", a->hi[0]);
    put_member(w, ", ", a->hi[1]);
    formats_put(w, "],\nvertices: [");
    if (!solid) put_plans(w, a);
    formats_put(w, "],\nobjects: [");
    put_objects(w, a->motion);
    formats_put(w, "],\ncontacts: [");
    put_contacts(w, a);
    formats_put(w, "]};\n");
    put_file(w, "player.js");
    formats_put(w, "</script>\n</body>\n</html>\n");
    return FROE_OK;
}
