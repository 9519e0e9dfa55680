/* animate_svg.c: a motion as an animated picture (SVG 1.1 with SMIL). Each object is a path whose ends move from key to
 * key: at the knots of both vertices, and within parabolas at a few instants more. Behind them lie the ways that they
 * take, with the axes; below runs a time line with the contacts. Where nothing moves, as in print or where the reader
 * wants less motion, it is the picture of the beginning. */
#include "formats/motion/animate.h"
#include "support/decimal/decimal.h"
#include "support/nice.h"
#include <math.h>
#include <stdio.h>

enum { CHORDS = 8 }; /* of a parabola */
/* margins: numbers, edges, numbers below, the time line; how wide a digit is at most */
enum { LEFT = 64, RIM = 14, AXIS = 40, LINE = 36, DIGIT = 7 };

typedef struct layout {
    formats_writer *w;
    const formats_animation *a;
    double width, height; /* of the picture above the time line */
    double left;          /* margin: LEFT, or more where numbers are long */
    double scale, x0, y0; /* x0 + scale x, y0 - scale y */
} layout;

typedef struct keys {
    const layout *s;
    froe_moving_object object;
    bool timing; /* writing key times, else places */
} keys;

static void put_format(formats_writer *w, const char *format, double x, double y) {
    char text[96];
    snprintf(text, sizeof text, format, x, y);
    formats_put(w, text);
}

static double share_of(const formats_animation *a, double time) {
    return (time - a->begin) / (a->end - a->begin);
}

/* Lines of the grid across one axis. */
typedef struct grid_lines {
    double origin, each; /* the place of x is origin + each x */
    double first, last;  /* multiples of the step */
    double step;
} grid_lines;

static grid_lines find_grid(const layout *s, int axis) {
    grid_lines g = {axis ? s->y0 : s->x0, axis ? -s->scale : s->scale, 1, 0, 1};
    const double first = axis ? s->height - AXIS : s->left, last = axis ? RIM : s->width - RIM;
    const double from = (first - g.origin) / g.each, to = (last - g.origin) / g.each;
    const double step = support_nice_above((to - from) * (axis ? 60 : 90) / (fabs(last - first) + 1));
    if (!(step > 0) || !isfinite(to) || !isfinite(from)) return g;
    if (to / step > 0x1p52 || from / step < -0x1p52) return g; /* where numbers have no next one */
    g.first = ceil(from / step), g.step = step, g.last = g.first;
    while ((g.last + 1) * step <= to) g.last++;
    if (g.first * step > to) g.last = g.first - 1;
    return g;
}

/* A multiple of the step has as many digits as its number, and one more. Returns the length. */
static size_t format_tick(char text[SUPPORT_DECIMAL_ROOM], const grid_lines *g, double i) {
    return support_decimal_format(text, i == 0 ? 0 : i * g->step, fabs(i) < 1e14 ? 15 : 17);
}

static layout lay_out_beside(formats_writer *w, const formats_animation *a, double left) {
    layout s = {.w = w, .a = a, .width = a->options.width, .left = left, .scale = 1};
    const double room = 0.5 * (s.width - left - RIM),
                 most = 0.6 * s.width; /* halves: whole extents may be no doubles */
    const double across = 0.5 * a->hi[0] - 0.5 * a->lo[0], up = 0.5 * a->hi[1] - 0.5 * a->lo[1];
    const double scale = fmin(across > 0 ? room / across : HUGE_VAL, up > 0 ? most / up : HUGE_VAL);
    if (isfinite(scale)) s.scale = scale; /* else no extent, or hardly any */
    s.height = ceil(2 * fmin(fmax(up * s.scale, 20), most)) + RIM + AXIS;
    s.x0 = left + room - s.scale * (0.5 * a->lo[0] + 0.5 * a->hi[0]);
    s.y0 = RIM + 0.5 * (s.height - RIM - AXIS) + s.scale * (0.5 * a->lo[1] + 0.5 * a->hi[1]);
    return s;
}

/* With room for the longest number beside the picture. */
static layout lay_out(formats_writer *w, const formats_animation *a) {
    const layout s = lay_out_beside(w, a, LEFT);
    const grid_lines g = find_grid(&s, 1);
    char text[SUPPORT_DECIMAL_ROOM];
    size_t longest = 0;
    for (double i = g.first; i <= g.last; i++) {
        const size_t length = format_tick(text, &g, i);
        if (length > longest) longest = length;
    }
    return lay_out_beside(w, a, fmax(LEFT, (double)(8 + DIGIT * longest)));
}

static void put_spot(const layout *s, const char *format, const double *at) {
    put_format(s->w, format, s->x0 + at[0] * s->scale, s->y0 - at[1] * s->scale);
}

static void put_place(const keys *k, double time) {
    for (int i = 0; i < 2; i++) {
        double at[2] = {0, 0};
        froe_motion_position(k->s->a->motion, k->object.vertices[i], time, at);
        put_spot(k->s, i ? "L%.1f %.1f" : "M%.1f %.1f", at);
    }
}

static void put_key(keys *k, double time, double share) {
    if (share > 0) formats_put(k->s->w, ";");
    if (k->timing)
        put_format(k->s->w, "%.6f", share, 0);
    else
        put_place(k, time);
}

/* The next instant, after `time`, at which either vertex changes its piece, or a curve its chord. */
static double next_key(const keys *k, double time) {
    double next = k->object.death;
    for (int i = 0; i < 2; i++) {
        uint32_t v = k->object.vertices[i];
        size_t count = froe_motion_knot_count(k->s->a->motion, v);
        for (size_t j = 0; j + 1 < count; j++) {
            froe_moving_knot from = froe_motion_knot(k->s->a->motion, v, j),
                             to = froe_motion_knot(k->s->a->motion, v, j + 1);
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
    double birth = k->object.birth, death = k->object.death, share = share_of(k->s->a, birth);
    put_key(k, birth, 0);
    if (share > 0) put_key(k, birth, share);
    for (double t = birth; t < death;) {
        t = next_key(k, t);
        share = share_of(k->s->a, t);
        if (share > 0) put_key(k, t, share);
    }
    if (share < 1) put_key(k, death, 1);
}

static void put_loop(formats_writer *w, const formats_animation *a) {
    put_format(w, "\" dur=\"%gs\" repeatCount=\"indefinite\"/>", a->options.seconds, 0);
}

/* How the object moves, and when it is there. */
static void put_life(const layout *s, const froe_moving_object *o) {
    formats_writer *w = s->w;
    keys k = {s, *o, false};
    const double birth = share_of(s->a, o->birth), death = share_of(s->a, o->death);
    formats_put(w, birth > 0 ? "<path visibility=\"hidden\" d=\"" : "<path d=\"");
    put_place(&k, o->birth);
    formats_put(w, "\"><animate attributeName=\"d\" values=\"");
    put_keys(&k);
    k.timing = true;
    formats_put(w, "\" keyTimes=\"");
    put_keys(&k);
    put_loop(w, s->a);
    if (birth <= 0 && death >= 1) return;
    formats_put(
        w, "<animate attributeName=\"visibility\" calcMode=\"discrete\" values=\"hidden;visible;hidden\" keyTimes=\"");
    put_format(w, "0;%.6f;%.6f", birth, death);
    put_loop(w, s->a);
}

/* Of class "hit" from the begin of a contact to its end, and a little longer, so that short ones are visible. */
static void put_contacts(formats_writer *w, const formats_animation *a, uint32_t object) {
    size_t first = a->starts[object], end = a->starts[object + 1];
    if (first == end) return;
    for (int timing = 0; timing < 2; timing++) {
        double until = 0;
        formats_put(w, timing ? "\" keyTimes=\"0"
                              : "<animate attributeName=\"class\" calcMode=\"discrete\" values=\"free");
        for (size_t i = first; i < end;) {
            double from = share_of(a, a->contacts[a->touched[i]].begin[0]);
            for (until = from; i < end && share_of(a, a->contacts[a->touched[i]].begin[0]) <= until; i++)
                until = fmax(until, share_of(a, a->contacts[a->touched[i]].end[1]) + 0.3 / a->options.seconds);
            if (timing)
                put_format(w, until < 1 ? ";%.6f;%.6f" : ";%.6f", from, until);
            else
                formats_put(w, until < 1 ? ";hit;free" : ";hit");
        }
    }
    put_loop(w, a);
}

/* ------------------------------------------------------------------ around -- */

static void put_style(formats_writer *w) {
    formats_put(w,
                "<style>\n"
                ".sheet { fill: #fff } .way, .grid { fill: none; stroke: #d6d0c2 } .grid { stroke: #efece3 }\n"
                ".move, .still { fill: none; stroke: #1f6580; stroke-width: 4; stroke-linecap: round }\n"
                ".hit { stroke: #c0421f; stroke-width: 7 } .mark { fill: #c0421f } .now { fill: #1b2630 }\n"
                "text { font: 12px system-ui, sans-serif; fill: #59646d } .still { display: none }\n"
                "@media (prefers-color-scheme: dark) { .sheet { fill: #1c2328 } .way { stroke: #3b464d }\n"
                ".grid { stroke: #2a3339 } .move, .still { stroke: #7cc1da } .hit { stroke: #ff8a5e }\n"
                ".mark { fill: #ff8a5e } .now { fill: #e8e7e1 } text { fill: #a3adb4 } }\n"
                "@media (prefers-reduced-motion: reduce) { .move, .now { display: none } .still { display: inline } }\n"
                "</style>\n");
}

static void put_label(formats_writer *w, double x, double y, const char *anchor) {
    put_format(w, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"", x, y);
    formats_put(w, anchor);
    formats_put(w, "\">");
}

/* Lines of the grid across one axis, with their numbers. One at the right end stands left of it where it is long. */
static void put_axis(const layout *s, int axis) {
    const grid_lines g = find_grid(s, axis);
    char text[SUPPORT_DECIMAL_ROOM];
    for (double i = g.first; i <= g.last; i++) {
        const double at = g.origin + g.each * i * g.step, half = 0.5 * DIGIT * (double)format_tick(text, &g, i);
        if (axis) {
            put_format(s->w, "<path class=\"grid\" d=\"M%.0f %.1f", s->left, at);
            put_format(s->w, "H%.0f\"/>", s->width - RIM, 0);
            put_label(s->w, s->left - 6, at + 4, "end");
        } else {
            put_format(s->w, "<path class=\"grid\" d=\"M%.1f %.0f", at, RIM);
            put_format(s->w, "V%.0f\"/>", s->height - AXIS, 0);
            put_label(s->w, fmin(at, s->width - half), s->height - AXIS + 16, "middle");
        }
        formats_put(s->w, text);
        formats_put(s->w, "</text>\n");
    }
}

/* The ways of all ends that some object has, within the window. */
static void put_ways(const layout *s) {
    formats_put(s->w, "<path class=\"way\" d=\"");
    for (uint32_t o = 0; o < froe_motion_object_count(s->a->motion); o++) {
        const froe_moving_object object = froe_motion_object(s->a->motion, o);
        size_t first, end;
        formats_animation_knots(s->a, object.vertices[0], &first, &end);
        bool curved = false;
        for (size_t i = first; i < end && end - first > 1 && object.birth <= object.death; i++) {
            const froe_moving_knot knot = froe_motion_knot(s->a->motion, object.vertices[0], i);
            put_spot(s, i == first ? "M%.1f %.1f" : curved ? " %.1f %.1f" : "L%.1f %.1f", knot.at);
            curved = i + 1 < end && !isnan(knot.control[0]);
            const bool cubic = curved && !isnan(knot.second[0]);
            if (curved) put_spot(s, cubic ? "C%.1f %.1f" : "Q%.1f %.1f", knot.control);
            if (cubic) put_spot(s, " %.1f %.1f", knot.second);
        }
    }
    formats_put(s->w, "\"/>\n");
}

static void put_time(const layout *s, double time) {
    if (!s->a->clock) {
        formats_put_number(s->w, time);
        return;
    }
    const long long day = 86400000, since = (long long)floor(time + 0.5), of_day = (since % day + day) % day;
    char text[64];
    int used =
        snprintf(text, sizeof text, "%02lld:%02lld:%02lld", of_day / 3600000, of_day / 60000 % 60, of_day / 1000 % 60);
    if (s->a->end - s->a->begin < 600000) snprintf(text + used, sizeof text - (size_t)used, ".%03lld", of_day % 1000);
    formats_put(s->w, text);
}

static void put_time_line(const layout *s) {
    const formats_animation *a = s->a;
    const double wide = s->width - s->left - RIM, top = s->height + 2;
    put_format(s->w, "<path class=\"grid\" stroke-width=\"12\" d=\"M%.0f %.0f", s->left, top + 6);
    put_format(s->w, "H%.0f\"/>\n", s->width - RIM, 0);
    for (size_t i = 0; i < a->count; i++) {
        const double from = share_of(a, a->contacts[i].begin[0]), to = share_of(a, a->contacts[i].end[1]);
        put_format(s->w, "<rect class=\"mark\" x=\"%.1f\" y=\"%.0f", s->left + from * wide - 1.5, top);
        put_format(s->w, "\" width=\"%.1f\" height=\"12\"/>\n", fmax((to - from) * wide, 3), 0);
    }
    put_format(s->w, "<rect class=\"now\" x=\"%.1f\" y=\"%.0f\" width=\"2\" height=\"16\">", s->left - 1, top - 2);
    put_format(s->w, "<animate attributeName=\"x\" values=\"%.1f;%.1f", s->left - 1, s->left + wide - 1);
    put_loop(s->w, a);
    formats_put(s->w, "</rect>\n");
    put_label(s->w, s->left, top + 26, "start");
    put_time(s, a->begin);
    formats_put(s->w, "</text>\n");
    put_label(s->w, s->width - RIM, top + 26, "end");
    put_time(s, a->end);
    formats_put(s->w, "</text>\n");
}

froe_status formats_animate_svg(formats_writer *w, const formats_animation *a, froe_diagnostic *diag) {
    (void)diag;
    const layout s = lay_out(w, a);
    formats_put(w, "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" ");
    put_format(w, "width=\"%.0f\" height=\"%.0f\" ", s.width, s.height + LINE);
    put_format(w, "viewBox=\"0 0 %.0f %.0f\">\n<title>", s.width, s.height + LINE);
    const size_t count = froe_motion_object_count(a->motion);
    formats_put_whole(w, count);
    formats_put(w,
                count == 1 ? " moving segment</title>\n" : " moving segments; those in contact are orange</title>\n");
    put_style(w);
    formats_put(w, "<rect class=\"sheet\" width=\"100%\" height=\"100%\"/>\n");
    put_axis(&s, 0);
    put_axis(&s, 1);
    put_label(w, s.width - RIM, s.height - 6, "end");
    formats_put(w, "x and y in units of the file</text>\n");
    put_ways(&s);
    formats_put(w, "<g class=\"move\">\n");
    for (uint32_t o = 0; o < froe_motion_object_count(a->motion); o++) {
        const froe_moving_object object = froe_motion_object(a->motion, o);
        if (object.birth > object.death) continue;
        put_life(&s, &object);
        put_contacts(w, a, o);
        formats_put(w, "</path>\n");
    }
    formats_put(w, "</g>\n<path class=\"still\" d=\"");
    for (uint32_t o = 0; o < froe_motion_object_count(a->motion); o++) {
        const froe_moving_object object = froe_motion_object(a->motion, o);
        if (object.birth <= a->begin && object.birth <= object.death) put_place(&(keys){&s, object, false}, a->begin);
    }
    formats_put(w, "\"/>\n");
    put_time_line(&s);
    formats_put(w, "</svg>\n");
    return FROE_OK;
}
