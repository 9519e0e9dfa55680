/* film_instants.c: see film_instants.h. */
#include "film_instants.h"
#include "support/axes.h"
#include "support/fail.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_film_instants(const void *a, const void *b) {
    const film_instant *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return (p->high > q->high) - (p->high < q->high);
}

static bool stands_still(const froe_motion *motion, uint32_t object) {
    const froe_moving_object o = froe_motion_object(motion, object);
    bool all = true;
    for (int k = 0; k < 3 && all; k++)
        all = froe_motion_knot_count(motion, o.vertices[k]) == 1 &&
              froe_motion_vertex_body(motion, o.vertices[k]) == FROE_NONE;
    return all;
}

static bool keep_touch(void *user, const froe_contact *c) {
    film_instants *x = user;
    const uint32_t pair[2] = {c->a, c->b};
    if (stands_still(x->motion, c->a) && stands_still(x->motion, c->b)) {
        x->full = !array_append(&x->alloc, &x->pairs, pair, 2);
        return !x->full;
    }
    x->full = !array_push(&x->alloc, &x->touches, ((film_instant){c->begin[0], c->begin[1]})) ||
              !array_push(&x->alloc, &x->touches, ((film_instant){c->end[0], c->end[1]}));
    return !x->full;
}

static bool keep_sight(void *user, double low, double high) {
    film_instants *x = user;
    x->full = !array_push(&x->alloc, &x->list, ((film_instant){low, high}));
    return !x->full;
}

froe_status film_instants_begin(film_instants *x, const froe_motion *motion, const froe_camera *camera,
                                const froe_scene *scene, const froe_render_options *options, froe_diagnostic *diag) {
    froe_contact_options contacts = froe_contact_defaults();
    *x = (film_instants){.motion = motion, .alloc = support_allocator(options->alloc)};
    x->all = options->cull_back || options->min_area > 0 || options->shading == FROE_SHADE_NONE;
    x->seen = support_calloc(&x->alloc, froe_motion_object_count(motion), 1);
    if (!x->seen) return support_fail_memory(diag);
    froe_status status = froe_camera_place(camera, scene, &x->view, diag);
    contacts.neighbours = true, contacts.threads = 1;
    if (!status) status = froe_motion_contacts(motion, &contacts, keep_touch, x, diag);
    return x->full ? support_fail_memory(diag) : status;
}

void film_instants_end(film_instants *x) {
    if (!x->motion) return;
    array_free(&x->alloc, &x->touches), array_free(&x->alloc, &x->pairs), array_free(&x->alloc, &x->list);
    support_free(&x->alloc, x->seen, froe_motion_object_count(x->motion));
}

/* May the eye be in the plane of a triangle at a time? */
static bool may_be_edge_on(const film_instants *x, uint32_t object, double time) {
    const froe_moving_object o = froe_motion_object(x->motion, object);
    const froe_camera camera = x->turn ? film_turn_at(x->turn, time) : froe_camera_defaults();
    const bool parallel = x->view.eye.parallel;
    double at[3][3], way[3], size = 0, far = 0, most = 0;
    for (int i = 0; i < 3; i++)
        if (!froe_motion_position(x->motion, o.vertices[i], time, at[i])) return false;
    for (int k = 0; k < 3; k++) {
        way[k] = x->turn ? camera.eye[k] - (parallel ? camera.target[k] : 0) : x->view.eye.at[k];
        if (!parallel) most = fmax(most, fabs(way[k])), way[k] -= at[0][k];
        far = fmax(far, fabs(way[k]));
        for (int i = 0; i < 3; i++) most = fmax(most, fabs(at[i][k])), size = fmax(size, fabs(at[i][k] - at[0][k]));
    }
    double a[3], b[3], normal[3];
    for (int k = 0; k < 3; k++) a[k] = at[1][k] - at[0][k], b[k] = at[2][k] - at[0][k];
    support_cross(a, b, normal);
    return !(fabs(support_dot(normal, way)) > size * (1e-9 * size * far + 1e-12 * most * (size + far))); /* NaN, too */
}

/* A picture has no face of what turns its edge to the eye at the very time, and may turn a side to it from then on. */
static void add_edge_on(film_instants *x, double time) {
    const bool rests = !x->turn;
    for (uint32_t i = 0; i < froe_motion_object_count(x->motion); i++) {
        const froe_moving_object o = froe_motion_object(x->motion, i);
        if (x->seen[i] || time < o.birth || time > o.death || (rests && stands_still(x->motion, i))) continue;
        x->seen[i] = may_be_edge_on(x, i, time);
    }
}

froe_status film_instants_find(film_instants *x, const uint64_t *tags, size_t count, double from, double to,
                               froe_diagnostic *diag) {
    memset(x->seen, 0, froe_motion_object_count(x->motion));
    for (size_t i = 0; i < count; i++) x->seen[tags[i]] = 1;
    if (!x->all) add_edge_on(x, from);
    x->list.count = 0;
    froe_sight_options o = froe_sight_defaults();
    memcpy(o.at, x->turn ? x->turn->at : x->view.eye.at, sizeof o.at);
    o.parallel = x->view.eye.parallel, o.window = x->turn ? x->turn->window : x->view.window;
    o.body = x->turn ? &x->turn->body : NULL;
    o.pairs = x->pairs.data, o.pair_count = x->pairs.count / 2;
    o.seen = x->all ? NULL : x->seen, o.from = from, o.to = to;
    const froe_status status = froe_motion_sights(x->motion, &o, keep_sight, x, diag);
    for (size_t i = 0; i < x->touches.count && !x->full; i++)
        if (x->touches.data[i].high >= from && x->touches.data[i].low <= to)
            x->full = !array_push(&x->alloc, &x->list, x->touches.data[i]);
    if (x->full) return support_fail_memory(diag);
    if (x->list.count) qsort(x->list.data, x->list.count, sizeof *x->list.data, compare_film_instants);
    return status;
}

bool film_instants_next(const film_instants *x, double after, double before, film_instant *out, double *next) {
    size_t i = 0;
    while (i < x->list.count && x->list.data[i].low <= after) i++;
    if (i == x->list.count) return false;
    *out = x->list.data[i];
    for (i++; i < x->list.count && x->list.data[i].low <= out->high; i++)
        if (x->list.data[i].high > out->high) out->high = x->list.data[i].high;
    *next = i < x->list.count && x->list.data[i].low < before ? x->list.data[i].low : before;
    return out->high < before;
}
