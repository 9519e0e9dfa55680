/* playing.h: what an SVG that plays shows at a time, read from its bytes, and what rays meet then. */
#ifndef FROE_TESTS_VECTOR_PLAYING_H
#define FROE_TESTS_VECTOR_PLAYING_H
#include "support/memory.h"
#include <froe/formats.h>
#include <froe/render.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PATHS = 40000, POINTS = 800000, EDGES = 80000 };

static uint64_t playing_dice;

static inline double playing_chance(void) {
    playing_dice = playing_dice * 6364136223846793005u + 1442695040888963407u;
    return (double)(playing_dice >> 11) * 0x1p-53;
}

/* ------------------------------------------------------------------------ the file -- */

typedef struct playing_path {
    double from, to;
    char group[32];
    size_t first, count; /* rings, in `rings` */
} playing_path;

typedef struct playing_film {
    char *text;
    playing_path paths[PATHS];
    size_t path_count;
    double points[2 * POINTS];
    size_t point_count;
    size_t rings[2 * EDGES]; /* first point and count of each */
    size_t ring_count;
    double instants[PATHS]; /* at which something begins or ends */
    size_t instant_count;
} playing_film;

static playing_film playing_file;

/* The rings of a path, relative and in hundredths of a pixel, as they are written here. */
static inline void playing_read_outline(const char *d) {
    double x = 0, y = 0, begin[2] = {0, 0};
    char command = 0;
    while (*d && *d != '"') {
        char *end;
        if ((*d >= 'a' && *d <= 'z')) {
            command = *d++;
            if (command == 'z') x = begin[0], y = begin[1];
            if (command != 'm') continue;
            playing_file.rings[2 * playing_file.ring_count] = playing_file.point_count,
                                   playing_file.rings[2 * playing_file.ring_count + 1] = 0;
            playing_file.ring_count++;
            continue;
        }
        if (*d == ' ') d++;
        const double a = strtod(d, &end);
        assert_true(end != d);
        d = end;
        if (command == 'v') {
            y += a;
        } else {
            x += a;
            if (command != 'h') y += strtod(d, &end), d = end;
        }
        if (command == 'm') begin[0] = x, begin[1] = y, command = 'l';
        assert_true(playing_file.point_count < POINTS && playing_file.ring_count < EDGES);
        playing_file.points[2 * playing_file.point_count] = x / 100,
                                playing_file.points[2 * playing_file.point_count + 1] = y / 100;
        playing_file.point_count++;
        playing_file.rings[2 * playing_file.ring_count - 1]++;
    }
}

static inline void playing_read_span(const char *line, double *from, double *to) {
    const char *values = strstr(line, "values=\"") + 8, *times = strstr(line, "keyTimes=\"0;") + 12;
    *from = strncmp(values, "none", 4) ? 0 : strtod(times, (char **)&times);
    *to = strstr(values, ";inline\"") ? 1 : strtod(times + (*times == ';'), NULL);
    playing_file.instants[playing_file.instant_count++] = *from;
    if (*to < 1) playing_file.instants[playing_file.instant_count++] = *to;
}

static inline void playing_read(const char *path) {
    static char text[1 << 24];
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    const size_t size = fread(text, 1, sizeof text - 1, in);
    fclose(in);
    assert_true(size < sizeof text - 1);
    text[size] = '\0';
    double from = 0, to = 1;
    playing_file.path_count = playing_file.point_count = playing_file.ring_count = playing_file.instant_count = 0;
    playing_file.instants[playing_file.instant_count++] = 0;
    for (char *line = strtok(text, "\n"); line && strncmp(line, "<g fill=\"none\"", 14) != 0;
         line = strtok(NULL, "\n")) {
        if (!strncmp(line, "<animate", 8)) playing_read_span(line, &from, &to);
        if (!strcmp(line, "</g>")) from = 0, to = 1;
        if (strncmp(line, "<path", 5) != 0) continue;
        assert_true(playing_file.path_count < PATHS - 2);
        playing_path *p = playing_file.paths + playing_file.path_count++;
        *p = (playing_path){.from = from, .to = to, .first = playing_file.ring_count};
        const char *name = strstr(line, "data-group=\"") + 12;
        snprintf(p->group, sizeof p->group, "%.*s", (int)strcspn(name, "\""), name);
        playing_read_outline(strstr(line, " d=\"") + 4);
        p->count = playing_file.ring_count - p->first;
    }
    assert_true(playing_file.path_count > 0);
}

/* How often the rings of a path go around a point; *near: it is closer to an edge than 0.1 px. */
static inline int playing_winding(const playing_path *p, double x, double y, bool *near) {
    int turns = 0;
    for (size_t r = p->first; r < p->first + p->count; r++)
        for (size_t i = 0, n = playing_file.rings[2 * r + 1]; i < n; i++) {
            const double *a = playing_file.points + 2 * (playing_file.rings[2 * r] + i);
            const double *b = playing_file.points + 2 * (playing_file.rings[2 * r] + (i + 1) % n);
            const double dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
            const double t = square > 0 ? fmin(fmax(((x - a[0]) * dx + (y - a[1]) * dy) / square, 0), 1) : 0;
            *near |= hypot(x - a[0] - t * dx, y - a[1] - t * dy) < 0.1;
            const double side = dx * (y - a[1]) - dy * (x - a[0]);
            if (a[1] <= y && b[1] > y && side > 0) turns++;
            if (b[1] <= y && a[1] > y && side < 0) turns--;
        }
    return turns;
}

/* The group that is seen at a place of the page at a share of the time; "": none; NULL: too close to an edge. */
static inline const char *playing_seen(double share, double x, double y) {
    const char *seen = "";
    bool near = false;
    for (size_t i = 0; i < playing_file.path_count; i++) {
        const playing_path *p = playing_file.paths + i;
        if (p->from <= share && share < p->to && playing_winding(p, x, y, &near)) seen = p->group;
    }
    return near ? NULL : seen;
}

/* ------------------------------------------------------------------------- the truth -- */

/* The group of the triangle that a ray from the eye through a point meets first; NULL: none is plainly the first. */
static inline const char *playing_ray(const froe_motion *motion, double time, const froe_eye *eye,
                                      const double *through) {
    double best = INFINITY, second = INFINITY;
    const double end = froe_motion_window(motion).end;
    const char *found = "";
    for (uint32_t i = 0; i < froe_motion_object_count(motion); i++) {
        const froe_moving_object o = froe_motion_object(motion, i);
        double v[3][3], d[3], e[3], f[3], p[3], q[3], s[3];
        if (!(o.birth <= time && (time < o.death || o.death == end))) continue;
        for (int c = 0; c < 3; c++) assert_true(froe_motion_position(motion, o.vertices[c], time, v[c]));
        for (int k = 0; k < 3; k++) {
            const double from = eye->parallel ? through[k] + 100 * eye->at[k] : eye->at[k];
            d[k] = through[k] - from, e[k] = v[1][k] - v[0][k], f[k] = v[2][k] - v[0][k], s[k] = from - v[0][k];
        }
        for (int k = 0; k < 3; k++) { /* Moeller and Trumbore */
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            p[k] = d[a] * f[b] - d[b] * f[a], q[k] = s[a] * e[b] - s[b] * e[a];
        }
        const double det = e[0] * p[0] + e[1] * p[1] + e[2] * p[2];
        const double u = (s[0] * p[0] + s[1] * p[1] + s[2] * p[2]) / det;
        const double w = (d[0] * q[0] + d[1] * q[1] + d[2] * q[2]) / det;
        const double t = (f[0] * q[0] + f[1] * q[1] + f[2] * q[2]) / det;
        if (!(t > 0) || !(u > -1e-6 && w > -1e-6 && u + w < 1 + 1e-6)) continue;
        if (t < best)
            second = best, best = t, found = froe_motion_group(motion, o.group).name;
        else
            second = fmin(second, t);
    }
    return second - best < 1e-5 * best ? NULL : found;
}

static inline double playing_instant(double share) {
    double last = 0;
    for (size_t i = 0; i < playing_file.instant_count; i++)
        if (playing_file.instants[i] <= share) last = fmax(last, playing_file.instants[i]);
    return last;
}

/* A point of some triangle, if that is there. */
static inline void playing_inside(const froe_motion *motion, double time, double *point) {
    const uint32_t i = (uint32_t)(playing_chance() * (double)froe_motion_object_count(motion));
    const froe_moving_object o = froe_motion_object(motion, i);
    double share[3] = {playing_chance(), playing_chance(), playing_chance()}, sum = share[0] + share[1] + share[2];
    if (!(o.birth <= time && time < o.death)) return;
    for (int k = 0; k < 3; k++) point[k] = 0;
    for (int c = 0; c < 3; c++) {
        double at[3];
        assert_true(froe_motion_position(motion, o.vertices[c], time, at));
        for (int k = 0; k < 3; k++) point[k] += share[c] / sum * at[k];
    }
}

/* The time of the picture that is shown; births and deaths are exact, and shares of the film rounded. */
static inline double playing_time(const froe_motion *motion, double instant) {
    const froe_motion_options w = froe_motion_window(motion);
    const double exact = w.begin + (w.end - w.begin) * instant;
    double time = exact;
    for (uint32_t i = 0; i < froe_motion_object_count(motion); i++) {
        const froe_moving_object o = froe_motion_object(motion, i);
        if (fabs(o.birth - exact) < 4e-15 * (w.end - w.begin)) time = o.birth;
        if (fabs(o.death - exact) < 4e-15 * (w.end - w.begin)) time = o.death;
    }
    return time;
}

typedef struct playing_counts {
    size_t hits, empty, unclear;
} playing_counts;

static inline void playing_compare(const froe_motion *motion, const froe_render_options *o, bool turn, uint32_t frames,
                                   playing_counts *c) {
    static froe_camera cameras[4096];
    const size_t count = turn ? (size_t)frames << froe_film_defaults().halvings : 1;
    assert_int_equal(froe_film_cameras(motion, &o->camera, turn, count, cameras, NULL), FROE_OK);
    for (int round = 0; round < 200; round++) {
        const double share = playing_chance(), instant = playing_instant(share), time = playing_time(motion, instant);
        const size_t camera = (size_t)(instant * (double)count + 1e-4);
        froe_scene *scene = NULL;
        froe_projection view;
        assert_int_equal(froe_motion_scene(motion, time, NULL, &scene, NULL), FROE_OK);
        assert_int_equal(froe_camera_place(cameras + camera, scene, &view, NULL), FROE_OK);
        double lo[3], hi[3];
        froe_scene_bounds(scene, lo, hi);
        for (int k = 0; k < 3; k++) { /* beyond the scene, too, where nothing is met */
            const double more = 0.3 * (hi[k] - lo[k]) + 0.1;
            lo[k] -= more, hi[k] += more;
        }
        froe_scene_free(scene);
        for (int sample = 0; sample < 12; sample++) {
            double point[3], page[2];
            for (int k = 0; k < 3; k++) point[k] = lo[k] + (hi[k] - lo[k]) * playing_chance();
            if (sample % 2) playing_inside(motion, time, point);
            if (!froe_project(&view, point, page)) continue;
            const char *seen = playing_seen(share, page[0], page[1]);
            const char *truth = playing_ray(motion, time, &view.eye, point);
            if (!seen || !truth) {
                c->unclear++;
                continue;
            }
            if (strcmp(seen, truth) != 0)
                fail_msg("at %.9g of the time, (%g, %g): the file shows '%s', a ray meets '%s'", share, page[0],
                         page[1], seen, truth);
            c->hits += *truth != 0, c->empty += !*truth;
        }
    }
}
#endif
