/* animate_svg.c: a motion as an animated picture (SVG 1.1 with SMIL). Each object is a path whose ends move from key to
 * key: at the knots of both vertices, and within parabolas at a few instants more. Where nothing moves, as in print, it
 * is the picture of the beginning. */
#include "formats/motion/animate.h"
#include <math.h>
#include <stdio.h>

enum { CHORDS = 8 }; /* of a parabola */

typedef struct keys {
    formats_writer *w;
    const formats_animation *a;
    froe_moving_object object;
    bool timing; /* writing key times, else places */
    double last;
} keys;

static void put_format(formats_writer *w, const char *format, double x, double y) {
    char text[64];
    snprintf(text, sizeof text, format, x, y);
    formats_put(w, text);
}

static double share_of(const formats_animation *a, double time) {
    return (time - a->begin) / (a->end - a->begin);
}

static void put_place(const keys *k, double time) {
    const formats_animation *a = k->a;
    for (int i = 0; i < 2; i++) {
        double at[2] = {0, 0};
        froe_motion_position(a->motion, k->object.vertices[i], time, at);
        put_format(k->w, i ? "L%.2f %.2f" : "M%.2f %.2f", FORMATS_ANIMATION_MARGIN + (at[0] - a->lo[0]) * a->scale,
                   FORMATS_ANIMATION_MARGIN + (a->hi[1] - at[1]) * a->scale);
    }
}

static void put_key(keys *k, double time, double share) {
    if (share > 0) formats_put(k->w, ";");
    if (k->timing)
        put_format(k->w, "%.6f", share, 0);
    else
        put_place(k, time);
}

/* The next instant, after `time`, at which either vertex changes its piece, or a parabola its chord. */
static double next_key(const keys *k, double time) {
    double next = k->object.death;
    for (int i = 0; i < 2; i++) {
        uint32_t v = k->object.vertices[i];
        size_t count = froe_motion_knot_count(k->a->motion, v);
        for (size_t j = 0; j + 1 < count; j++) {
            froe_moving_knot from = froe_motion_knot(k->a->motion, v, j), to = froe_motion_knot(k->a->motion, v, j + 1);
            if (to.time <= time) continue;
            if (from.time >= next) break;
            int chords = isnan(from.control[0]) ? 1 : CHORDS;
            for (int c = 1; c <= chords; c++) {
                double t = c == chords ? to.time : from.time + (to.time - from.time) * c / chords;
                if (t > time && t < next) next = t;
            }
        }
    }
    return next;
}

/* Keys from the window's begin to its end; before its birth and after its death the object is invisible. */
static void put_keys(keys *k) {
    double birth = k->object.birth, death = k->object.death, share = share_of(k->a, birth);
    put_key(k, birth, 0);
    if (share > 0) put_key(k, birth, share);
    for (double t = birth; t < death;) {
        t = next_key(k, t);
        share = share_of(k->a, t);
        if (share > 0) put_key(k, t, share);
    }
    if (share < 1) put_key(k, death, 1);
}

static void put_loop(formats_writer *w, const formats_animation *a) {
    put_format(w, "\" dur=\"%gs\" repeatCount=\"indefinite\"/>", a->options.seconds, 0);
}

/* How the object moves, and when it is there. */
static void put_life(formats_writer *w, const formats_animation *a, const froe_moving_object *o) {
    keys k = {w, a, *o, false, 0};
    double birth = share_of(a, o->birth), death = share_of(a, o->death);
    formats_put(w, birth > 0 ? "<path visibility=\"hidden\" d=\"" : "<path d=\"");
    put_place(&k, o->birth);
    formats_put(w, "\"><animate attributeName=\"d\" values=\"");
    put_keys(&k);
    k.timing = true;
    formats_put(w, "\" keyTimes=\"");
    put_keys(&k);
    put_loop(w, a);
    if (birth <= 0 && death >= 1) return;
    formats_put(
        w, "<animate attributeName=\"visibility\" calcMode=\"discrete\" values=\"hidden;visible;hidden\" keyTimes=\"");
    put_format(w, "0;%.6f;%.6f", birth, death);
    put_loop(w, a);
}

/* Red from the begin of a contact to its end, and a little longer, so that short ones are visible. */
static void put_contacts(formats_writer *w, const formats_animation *a, uint32_t object) {
    size_t first = a->starts[object], end = a->starts[object + 1];
    if (first == end) return;
    for (int timing = 0; timing < 2; timing++) {
        double until = 0;
        formats_put(w, timing ? "\" keyTimes=\"0"
                              : "<animate attributeName=\"stroke\" calcMode=\"discrete\" values=\"#26547c");
        for (size_t i = first; i < end;) {
            double from = share_of(a, a->contacts[a->touched[i]].begin[0]);
            for (until = from; i < end && share_of(a, a->contacts[a->touched[i]].begin[0]) <= until; i++)
                until = fmax(until, share_of(a, a->contacts[a->touched[i]].end[1]) + 0.3 / a->options.seconds);
            if (timing)
                put_format(w, until < 1 ? ";%.6f;%.6f" : ";%.6f", from, until);
            else
                formats_put(w, until < 1 ? ";#d62839;#26547c" : ";#d62839");
        }
    }
    put_loop(w, a);
}

void formats_animate_svg(formats_writer *w, const formats_animation *a) {
    double width = a->options.width, height = a->height + 8;
    formats_put(w, "<svg xmlns=\"http://www.w3.org/2000/svg\" ");
    put_format(w, "width=\"%.0f\" height=\"%.0f\" ", width, height);
    put_format(w, "viewBox=\"0 0 %.0f %.0f\">\n", width, height);
    formats_put(w, "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
    put_format(w, "<rect y=\"%.0f\" width=\"0\" height=\"4\" fill=\"#26547c\">", height - 4, 0);
    put_format(w, "<animate attributeName=\"width\" values=\"0;%.0f", width, 0);
    put_loop(w, a);
    formats_put(w, "</rect>\n<g fill=\"none\" stroke=\"#26547c\" stroke-width=\"2\" stroke-linecap=\"round\">\n");
    for (uint32_t o = 0; o < froe_motion_object_count(a->motion); o++) {
        froe_moving_object object = froe_motion_object(a->motion, o);
        if (object.birth > object.death) continue;
        put_life(w, a, &object);
        put_contacts(w, a, o);
        formats_put(w, "</path>\n");
    }
    formats_put(w, "</g>\n</svg>\n");
}
