/* classes.c: a tree of enlarged boxes for the objects of each class. */
#include "query/range/classes.h"
#include "base/radix.h"
#include "support/fail.h"
#include <float.h>

/* Overlapping boxes do not make its trees large, as they do those of `directional`. A leaf holds about those boxes that
 * overlap there. */
static const char METHOD[] = "kd";
enum { BOXES_PER_LEAF = 2 }; /* times 2^dim */

static void free_classes(const froe_allocator *alloc, query_part *part) {
    query_classes *p = (query_classes *)part;
    for (uint32_t i = 0; p->classes && i < p->count; i++) {
        query_class *c = p->classes + i;
        froe_query_free(c->query);
        froe_tree_free(c->tree);
        support_free(alloc, c->ids, c->count * sizeof *c->ids);
    }
    support_free(alloc, p->classes, p->count * sizeof *p->classes);
    support_free(alloc, p, sizeof *p);
}

/* ----------------------------------------------------------------- classes -- */

/* Half the greatest extent of an object; those below the normal numbers count as none. */
static double size_of_object(const froe_scene *s, uint32_t object) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], most = 0;
    scene_object_bounds(s, object, lo, hi);
    for (int k = 0; k < s->dim; k++) most = fmax(most, 0.5 * hi[k] - 0.5 * lo[k]);
    return most < DBL_MIN ? 0 : most;
}

/* The greatest power of two that is no greater. */
static double step_of_size(double size) {
    int exponent;
    if (size == 0) return 0;
    frexp(size, &exponent);
    return ldexp(1, exponent - 1);
}

/* Beyond x by a step and a little more, but finite. */
static double number_beyond(double x, double step, double direction) {
    const double far = nextafter(x + direction * step, direction * INFINITY);
    return fmin(fmax(far, -DBL_MAX), DBL_MAX);
}

/* A class of the objects first .. first + count, and the tree of their boxes. */
static froe_status fill_class(query_class *c, const froe_tree *t, const base_pair *sorted, uint32_t count, double step,
                              froe_diagnostic *diag) {
    froe_scene *boxes = NULL;
    froe_build_options o = froe_build_defaults();
    *c = (query_class){.step = step, .count = count};
    c->ids = support_calloc(&t->alloc, count, sizeof *c->ids);
    if (!c->ids) return support_fail_memory(diag);
    for (uint32_t i = 0; i < count; i++) c->ids[i] = sorted[i].value;
    o.method = METHOD;
    o.leaf = (uint32_t)BOXES_PER_LEAF << t->scene->dim;
    o.threads = 1;
    froe_status status = froe_scene_new(t->scene->dim, &t->alloc, &boxes);
    if (status) return support_fail_memory(diag);
    double ends[2 * FROE_MAX_DIM], *lo = ends, *hi = ends + t->scene->dim;
    froe_objects box = froe_objects_defaults();
    box.kind = FROE_BOX;
    box.count = 1;
    box.coords = ends;
    for (uint32_t i = 0; i < count && !status; i++) {
        scene_object_bounds(t->scene, c->ids[i], lo, hi);
        for (int k = 0; k < t->scene->dim && step > 0; k++) {
            lo[k] = number_beyond(lo[k], step, -1);
            hi[k] = number_beyond(hi[k], step, 1);
        }
        status = froe_scene_add(boxes, &box, diag);
    }
    if (!status) status = froe_build(boxes, &o, &c->tree, diag);
    if (!status) status = froe_query_new(c->tree, &c->query, diag);
    froe_scene_free(boxes);
    return status;
}

static froe_status make_classes(froe_query *q, query_part **out, froe_diagnostic *diag) {
    const froe_tree *t = q->tree;
    const uint32_t objects = t->scene->object_count;
    query_classes *p = support_calloc(&q->alloc, 1, sizeof *p);
    if (!p) return support_fail_memory(diag);
    p->part.free = free_classes;
    *out = &p->part;
    base_pair *sorted = support_calloc(&q->alloc, 2 * (size_t)objects, sizeof *sorted);
    if (!sorted) return support_fail_memory(diag);
    for (uint32_t i = 0; i < objects; i++)
        sorted[i] = (base_pair){base_double_key(step_of_size(size_of_object(t->scene, i))), i};
    base_radix_sort(sorted, sorted + objects, objects);
    uint32_t count = 0, next = 0, made = 0;
    for (uint32_t i = 0; i < objects; i++) count += !i || sorted[i].key != sorted[i - 1].key;
    p->classes = support_calloc(&t->alloc, count, sizeof *p->classes);
    froe_status status = p->classes ? FROE_OK : support_fail_memory(diag);
    if (p->classes) p->count = count;
    for (uint32_t first = 0; first < objects && !status; first = next) {
        const double step = step_of_size(size_of_object(t->scene, sorted[first].value));
        for (next = first; next < objects && sorted[next].key == sorted[first].key;) next++;
        status = fill_class(p->classes + made++, t, sorted + first, next - first, step, diag);
    }
    support_free(&q->alloc, sorted, (objects ? 2 * (size_t)objects * sizeof *sorted : 1));
    return status;
}

froe_status query_classes_of(froe_query *query, const query_classes **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_CLASSES, make_classes, &part, diag);
    if (status == FROE_OK) *out = (const query_classes *)part;
    return status;
}
