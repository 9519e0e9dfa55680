/* hits.c: every polygon is held before every sample of its box on the page. */
#include "oracle/hits.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void *grow(void *old, size_t size) {
    void *p = realloc(old, size ? size : 1);
    if (!p) {
        fprintf(stderr, "oracle: no memory for %zu bytes\n", size);
        exit(1);
    }
    return p;
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *out) {
    for (int k = 0; k < 3; k++) out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* --------------------------------------------------------------------- triangles -- */

/* A vertex as a vector of the camera: (right, up, depth), or for parallel eyes (right, up, 1). */
static void before_camera(const froe_projection *view, const double *vertex, double out[3], double *depth) {
    double w[3];
    for (int k = 0; k < 3; k++) w[k] = vertex[k] - view->origin[k];
    *depth = -dot(w, view->back);
    out[0] = dot(w, view->right), out[1] = dot(w, view->up);
    out[2] = view->eye.parallel ? 1 : *depth;
}

/* Where on the page; what reaches behind the eye may be anywhere, what lies there is nowhere. */
static void find_box(oracle_triangle *t, const froe_projection *view, double corner[3][3]) {
    for (int k = 0; k < 2; k++) t->lo[k] = INFINITY, t->hi[k] = -INFINITY;
    for (int c = 0; c < 3; c++) {
        const bool before = corner[c][2] > 0;
        for (int k = 0; k < 2; k++) {
            const double way = k ? -view->scale : view->scale, at = view->centre[k] + way * corner[c][k] / corner[c][2];
            t->lo[k] = before ? fmin(t->lo[k], at) : -INFINITY;
            t->hi[k] = before ? fmax(t->hi[k], at) : INFINITY;
        }
    }
    const int behind = (corner[0][2] <= 0) + (corner[1][2] <= 0) + (corner[2][2] <= 0);
    for (int k = 0; k < 2 && behind; k++)
        t->lo[k] = behind < 3 ? -INFINITY : INFINITY, t->hi[k] = behind < 3 ? INFINITY : -INFINITY;
}

static oracle_triangle triangle_of(const froe_projection *view, const double *const vertex[3]) {
    oracle_triangle t = {.object = 0};
    double corner[3][3];
    for (int c = 0; c < 3; c++) before_camera(view, vertex[c], corner[c], &t.depth[c]);
    for (int c = 0; c < 3; c++) cross(corner[(c + 1) % 3], corner[(c + 2) % 3], t.normal[c]);
    t.volume = dot(corner[0], t.normal[0]);
    const double size = dot(corner[0], corner[0]) * dot(corner[1], corner[1]) * dot(corner[2], corner[2]);
    t.edge_on = !view->eye.parallel && fabs(t.volume) <= 1e-12 * sqrt(size);
    find_box(&t, view, corner);
    return t;
}

/* Do the corners turn left as the eye sees them? */
static bool is_front(const oracle_triangle *t, bool parallel) {
    return parallel ? t->normal[0][2] + t->normal[1][2] + t->normal[2][2] > 0 : t->volume > 0;
}

/* Depths from as far before everything as it reaches: so that differences can be compared with depths. */
static void step_back(oracle_triangles *all) {
    double near = INFINITY, far = -INFINITY;
    for (size_t i = 0; i < 3 * all->count; i++) {
        near = fmin(near, all->at[i / 3].depth[i % 3]);
        far = fmax(far, all->at[i / 3].depth[i % 3]);
    }
    all->back = far > near ? far - 2 * near : 1 - near;
    for (size_t i = 0; i < 3 * all->count; i++) all->at[i / 3].depth[i % 3] += all->back;
}

oracle_triangles oracle_triangles_new(const froe_scene *scene, const froe_surface *surface, const froe_projection *view,
                                      bool cull_back) {
    oracle_triangles all = {.view = view};
    size_t room = 0;
    for (uint32_t i = 0; i < froe_scene_object_count(scene); i++) {
        const froe_object o = froe_scene_object(scene, i);
        const uint32_t patch = froe_surface_patch_of(surface, i);
        for (uint32_t c = 2; c < o.corners && patch != FROE_NONE; c++) {
            const uint32_t ids[3] = {0, c - 1, c};
            const double *vertex[3];
            for (int k = 0; k < 3; k++) vertex[k] = froe_scene_vertex(scene, froe_scene_corner(scene, i, ids[k]));
            if (all.count == room) all.at = grow(all.at, (room = 2 * room + 64) * sizeof *all.at);
            oracle_triangle *t = all.at + all.count;
            *t = triangle_of(view, vertex);
            t->object = i, t->patch = patch;
            all.count += !t->edge_on && (!cull_back || is_front(t, view->eye.parallel));
        }
    }
    if (view->eye.parallel) step_back(&all);
    return all;
}

void oracle_triangles_free(oracle_triangles *triangles) {
    free(triangles->at);
    triangles->at = NULL;
}

static void ray_at(const froe_projection *view, const double page[2], double ray[3]) {
    ray[0] = (page[0] - view->centre[0]) / view->scale;
    ray[1] = (view->centre[1] - page[1]) / view->scale;
    ray[2] = 1;
}

/* Where the weights have a sign (1 or -1); not positive where they do not, or behind the eye. */
static double depth_of(const oracle_triangle *t, bool parallel, const double ray[3], int sign) {
    const double a = sign * dot(t->normal[0], ray), b = sign * dot(t->normal[1], ray),
                 c = sign * dot(t->normal[2], ray);
    if (!(a > 0 && b > 0 && c > 0)) return 0;
    if (parallel) return (a * t->depth[0] + b * t->depth[1] + c * t->depth[2]) / (a + b + c);
    return sign * t->volume / (a + b + c);
}

double oracle_depth(const oracle_triangles *triangles, size_t i, const double page[2], bool *doubt) {
    const oracle_triangle *t = triangles->at + i;
    double ray[3];
    int left = 0, right = 0; /* sides of which the ray is there for sure */
    ray_at(triangles->view, page, ray);
    for (int c = 0; c < 3; c++) {
        const double *n = t->normal[c], at = dot(n, ray);
        /* Amid the page ray[0] and ray[1] are differences of nearly equal numbers: their errors are relative to 1. */
        const double unsure = 1e-9 * (fabs(n[0]) * (fabs(ray[0]) + 1) + fabs(n[1]) * (fabs(ray[1]) + 1) + fabs(n[2]));
        left += at > unsure;
        right += at < -unsure;
    }
    *doubt = left < 3 && right < 3 && !(left && right);
    const bool parallel = triangles->view->eye.parallel;
    return fmax(depth_of(t, parallel, ray, 1), depth_of(t, parallel, ray, -1));
}

/* -------------------------------------------------------------------------- hits -- */

void oracle_place(const oracle_grid *grid, const froe_projection *view, size_t sample, double page[2]) {
    page[0] = ((double)(sample % grid->wide) + 0.5 + grid->shift[0]) * view->width / grid->wide;
    page[1] = ((double)(sample / grid->wide) + 0.5 + grid->shift[1]) * view->height / grid->high;
}

/* The samples between two places along an axis: first .. *end - 1, perhaps one too many on either side. */
static uint32_t range(double lo, double hi, double size, uint32_t cells, uint32_t *end) {
    const double from = floor(lo / size * cells) - 1, to = floor(hi / size * cells) + 2;
    *end = to <= 0 ? 0 : to < cells ? (uint32_t)to : cells;
    return from <= 0 ? 0 : from < cells ? (uint32_t)from : cells;
}

/* Narrows lo .. hi, places on one row of the page, to where the weights of a triangle may have one sign. */
static void narrow(const oracle_triangle *t, const froe_projection *view, double v, int sign, double *lo, double *hi) {
    for (int c = 0; c < 3; c++) {
        const double slope = sign * t->normal[c][0], rest = sign * (t->normal[c][1] * v + t->normal[c][2]);
        const double at = view->centre[0] - view->scale * rest / slope;
        if (slope > 0)
            *lo = fmax(*lo, at);
        else if (slope < 0)
            *hi = fmin(*hi, at);
    }
}

typedef void meet_fn(void *user, size_t sample, double depth, uint32_t patch);

/* All samples whose rays meet a triangle. */
static void meet(const oracle_triangles *triangles, const oracle_grid *grid, size_t i, meet_fn *fn, void *user) {
    const oracle_triangle *t = triangles->at + i;
    const froe_projection *view = triangles->view;
    uint32_t y1, x1, y0 = range(t->lo[1], t->hi[1], view->height, grid->high, &y1);
    for (uint32_t y = y0; y < y1; y++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double page[2], ray[3], lo = t->lo[0], hi = t->hi[0];
            oracle_place(grid, view, (size_t)y * grid->wide, page);
            ray_at(view, page, ray);
            narrow(t, view, ray[1], sign, &lo, &hi);
            if (!(lo <= hi)) continue;
            for (uint32_t x = range(lo, hi, view->width, grid->wide, &x1); x < x1; x++) {
                const size_t sample = (size_t)y * grid->wide + x;
                oracle_place(grid, view, sample, page);
                ray_at(view, page, ray);
                const double depth = depth_of(t, view->eye.parallel, ray, sign);
                if (depth > 0) fn(user, sample, depth, t->patch);
            }
        }
}

typedef struct collector {
    oracle_hit *hits;
    size_t count, room;
} collector;

static void collect(void *user, size_t sample, double depth, uint32_t patch) {
    collector *c = user;
    if (c->count == c->room) c->hits = grow(c->hits, (c->room = 2 * c->room + 1024) * sizeof *c->hits);
    c->hits[c->count++] = (oracle_hit){depth, (uint32_t)sample, patch};
}

static int by_sample(const void *a, const void *b) {
    const oracle_hit *p = a, *q = b;
    if (p->sample != q->sample) return p->sample < q->sample ? -1 : 1;
    return p->depth < q->depth ? -1 : p->depth > q->depth;
}

static bool tied(const oracle_hit *a, const oracle_hit *b) {
    return fabs(b->depth - a->depth) <= ORACLE_TIE * fmax(fabs(a->depth), fabs(b->depth));
}

/* Of neighbours in a tie the higher patch comes first. */
static void rank(oracle_hit *hits, size_t count) {
    for (size_t i = 1; i < count; i++)
        for (size_t k = i; k && tied(hits + k - 1, hits + k) && hits[k - 1].patch < hits[k].patch; k--) {
            const oracle_hit swap = hits[k];
            hits[k] = hits[k - 1];
            hits[k - 1] = swap;
        }
}

oracle_hits oracle_hits_new(const oracle_triangles *triangles, oracle_grid grid) {
    const size_t samples = (size_t)grid.wide * grid.high;
    collector c = {.hits = NULL};
    for (size_t i = 0; i < triangles->count; i++) meet(triangles, &grid, i, collect, &c);
    oracle_hits h = {grid, grow(c.hits, c.count * sizeof *c.hits), grow(NULL, (samples + 1) * sizeof *h.starts)};
    qsort(h.hits, c.count, sizeof *h.hits, by_sample);
    for (size_t i = 0, at = 0; i < samples; i++) {
        h.starts[i] = at;
        while (at < c.count && h.hits[at].sample == i) at++;
        rank(h.hits + h.starts[i], at - h.starts[i]);
    }
    h.starts[samples] = c.count;
    return h;
}

void oracle_hits_free(oracle_hits *hits) {
    free(hits->hits);
    free(hits->starts);
}

/* ----------------------------------------------------------------------- nearest -- */

static void keep_nearest(void *user, size_t sample, double depth, uint32_t patch) {
    oracle_nearest *n = user;
    if (depth < n->depth[sample]) n->depth[sample] = depth, n->patch[sample] = patch;
}

static void note_tie(void *user, size_t sample, double depth, uint32_t patch) {
    oracle_nearest *n = user;
    if (patch != n->patch[sample] && depth <= n->depth[sample] * (1 + ORACLE_TIE)) n->tie[sample] = 1;
}

oracle_nearest oracle_nearest_new(const oracle_triangles *triangles, oracle_grid grid) {
    const size_t samples = (size_t)grid.wide * grid.high;
    oracle_nearest n = {grid, grow(NULL, samples * sizeof *n.depth), grow(NULL, samples * sizeof *n.patch),
                        grow(NULL, samples)};
    for (size_t i = 0; i < samples; i++) n.depth[i] = INFINITY, n.patch[i] = FROE_NONE, n.tie[i] = 0;
    for (size_t i = 0; i < triangles->count; i++) meet(triangles, &grid, i, keep_nearest, &n);
    for (size_t i = 0; i < triangles->count; i++) meet(triangles, &grid, i, note_tie, &n);
    return n;
}

void oracle_nearest_free(oracle_nearest *n) {
    free(n->depth);
    free(n->patch);
    free(n->tie);
}

/* ------------------------------------------------------------------------- stacks -- */

size_t oracle_stack(const oracle_hits *h, size_t sample, const uint8_t *clear, bool *tie) {
    const oracle_hit *hits = h->hits + h->starts[sample];
    const size_t count = h->starts[sample + 1] - h->starts[sample];
    size_t seen = 0;
    *tie = false;
    while (seen < count) {
        seen++;
        *tie = *tie || (seen < count && tied(hits + seen - 1, hits + seen) && hits[seen - 1].patch != hits[seen].patch);
        if (!clear || !clear[hits[seen - 1].patch]) break;
    }
    return seen;
}
