/* odd_pairs.c: boxes first; then sheets, what is left of them, and what meets across their borders. */
#include "measure/odd_pairs.h"
#include "base/apart.h"
#include "base/radix.h"
#include "measure/hierarchy.h"
#include "measure/sheet.h"
#include <math.h>
#include <string.h>

enum {
    ENOUGH = 32,       /* pairs of boxes for each object: more are worth a sweep */
    COUNTED = 1 << 10, /* pairs that a worker finds between two updates of the common count */
    LEAST = 64,        /* objects of a sheet */
    VISITORS = 64      /* objects of a job */
};

/* Pairs that a worker has found, in a line of the cache of their own. */
typedef struct pair_counter {
    uint32_t pairs;
    base_apart apart;
} pair_counter;

/* Objects that lie side by side: a run of `order`, and a search tree of its boxes. */
typedef struct sheet {
    uint32_t first, end;
    measure_hierarchy boxes;
} sheet;

typedef struct sheet_search {
    const measure_candidates *of;
    const froe_allocator *alloc;
    base_task *task;
    num_context *context;
    geom_pair_fn *fn;
    void *user;
    /* before there are sheets */
    atomic_size_t found;
    pair_counter *counters; /* of each worker */
    /* then */
    base_pair *pairs; /* places in the list, by source polygon; and as many more */
    uint32_t *order;  /* places in the list: the sheets, one after the other, then the loose objects */
    double *lo, *hi;  /* the bounds of these */
    ARRAY(sheet) sheets;
    double *sheet_lo, *sheet_hi;
    measure_hierarchy bounds; /* of the sheets */
    uint32_t straight;        /* the loose objects begin here in `order` */
    ARRAY(measure_touch) touches;
    bool *crooked;
} sheet_search;

/* -------------------------------------------------------------------- boxes -- */

static bool count_pair(void *user, unsigned worker, uint32_t a, uint32_t b) {
    sheet_search *s = user;
    (void)a, (void)b;
    if (++s->counters[worker].pairs < COUNTED) return true;
    s->counters[worker].pairs = 0;
    return atomic_fetch_add(&s->found, COUNTED) < ENOUGH * (size_t)s->of->count;
}

/* ------------------------------------------------------------------- sheets -- */

/* The axis along which polygons look largest, by the sum of their areas in doubles: any would be right. */
static int widest_axis(const froe_scene *scene, const uint32_t *objects, uint32_t count) {
    double areas[3] = {0, 0, 0};
    for (uint32_t i = 0; i < count; i++) {
        const double *a = scene_point(scene, objects[i], 0), *b = scene_point(scene, objects[i], 1);
        const double *c = scene_point(scene, objects[i], 2);
        for (int k = 0; k < 3; k++) {
            int u = (k + 1) % 3, v = (k + 2) % 3;
            areas[k] += fabs((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]));
        }
    }
    const int axis = areas[1] > areas[0] ? 1 : 0;
    return areas[2] > areas[axis] ? 2 : axis;
}

/* Sweeps over the objects of each source polygon, which come next to each other in s->pairs; straight objects come into
 * the order. */
static froe_status sweep_all(sheet_search *s) {
    const froe_scene *scene = s->of->scene;
    uint32_t count = s->of->count, *objects = support_calloc(s->alloc, count, sizeof *objects);
    froe_status status = objects ? FROE_OK : FROE_E_MEMORY;
    for (uint32_t i = 0; i < count; i++) { /* all segments of the plane have one source polygon */
        const uint32_t object = s->of->objects[i];
        s->pairs[i] = (base_pair){scene->dim == 2 ? 0 : scene->faces ? scene->faces[object] : object, i};
    }
    base_radix_sort(s->pairs, s->pairs + count, count);
    memset(s->crooked, true, count);
    for (uint32_t first = 0, end; first < count && !status; first = end) {
        const base_pair *run = s->pairs + first;
        for (end = first + 1; end < count && s->pairs[end].key == run->key;) end++;
        const uint32_t length = end - first;
        if (length < LEAST) continue;
        for (uint32_t i = 0; i < length; i++) objects[i] = s->of->objects[run[i].value];
        measure_sheet made = {.crooked = s->crooked + first};
        status =
            measure_sheet_sweep(s->context, s->task, scene, scene->dim == 3 ? widest_axis(scene, objects, length) : -1,
                                objects, length, &made);
        for (size_t i = 0; i < made.touches.count && !status; i++) {
            const measure_touch t = made.touches.data[i];
            if (made.crooked[t.a] || made.crooked[t.b]) continue;
            const uint32_t a = run[t.a].value, b = run[t.b].value;
            const measure_touch both = {a < b ? a : b, a < b ? b : a};
            if (!array_push(s->alloc, &s->touches, both)) status = FROE_E_MEMORY;
        }
        array_free(s->alloc, &made.touches);
        sheet new = {.first = s->straight};
        for (uint32_t i = 0; i < length && !status; i++)
            if (!made.crooked[i]) s->order[s->straight++] = run[i].value;
        new.end = s->straight;
        if (!status && new.end > new.first && !array_push(s->alloc, &s->sheets, new)) status = FROE_E_MEMORY;
    }
    for (uint32_t i = 0, at = s->straight; i < count && !status; i++)
        if (s->crooked[i]) s->order[at++] = s->pairs[i].value;
    support_free(s->alloc, objects, count * sizeof *objects);
    return status;
}

/* ---------------------------------------------------------------- searching -- */

static froe_status make_trees(sheet_search *s) {
    int dim = s->of->scene->dim;
    size_t width = (size_t)dim, count = s->sheets.count;
    for (size_t i = 0; i < s->of->count; i++) {
        memcpy(s->lo + i * width, s->of->lo + s->order[i] * width, width * sizeof *s->lo);
        memcpy(s->hi + i * width, s->of->hi + s->order[i] * width, width * sizeof *s->hi);
    }
    s->sheet_lo = support_calloc(s->alloc, count * width, sizeof *s->sheet_lo);
    s->sheet_hi = support_calloc(s->alloc, count * width, sizeof *s->sheet_hi);
    if (!s->sheet_lo || !s->sheet_hi) return FROE_E_MEMORY;
    for (size_t i = 0; i < count; i++) {
        sheet *t = s->sheets.data + i;
        froe_status status = measure_hierarchy_new(s->alloc, dim, t->end - t->first, s->lo + t->first * width,
                                                   s->hi + t->first * width, NULL, &t->boxes);
        if (status) return status;
        size_t all = (size_t)(t->boxes.entries - 1) * width;
        memcpy(s->sheet_lo + i * width, t->boxes.lo + all, width * sizeof *s->lo);
        memcpy(s->sheet_hi + i * width, t->boxes.hi + all, width * sizeof *s->hi);
    }
    return measure_hierarchy_new(s->alloc, dim, (uint32_t)count, s->sheet_lo, s->sheet_hi, NULL, &s->bounds);
}

/* A loose object visits all sheets, an object of a sheet visits the sheets before it. */
static froe_status visit_sheets(void *user, unsigned worker, size_t job) {
    const sheet_search *s = user;
    const size_t dim = (size_t)s->of->scene->dim, end = (job + 1) * VISITORS;
    for (size_t i = job * VISITORS; i < end && i < s->of->count; i++) {
        const double *lo = s->lo + i * dim, *hi = s->hi + i * dim;
        measure_search sheets = measure_search_begin(&s->bounds, lo, hi, 0);
        for (uint32_t t; (t = measure_search_next(&sheets)) != FROE_NONE;) {
            const sheet *visited = s->sheets.data + t;
            measure_search in = measure_search_begin(&visited->boxes, lo, hi, 0);
            for (uint32_t k; i >= visited->end && (k = measure_search_next(&in)) != FROE_NONE;)
                if (base_cancelled(s->task) || !s->fn(s->user, worker, s->order[i], s->order[visited->first + k]))
                    return FROE_E_CANCELLED;
        }
    }
    return FROE_OK;
}

static bool loose_pair(void *user, unsigned worker, uint32_t a, uint32_t b) {
    const sheet_search *s = user;
    return s->fn(s->user, worker, s->order[s->straight + a], s->order[s->straight + b]);
}

/* -------------------------------------------------------------------- pairs -- */

static froe_status search_sheets(sheet_search *s) {
    uint32_t count = s->of->count;
    size_t numbers = (size_t)count * (size_t)s->of->scene->dim;
    s->pairs = support_calloc(s->alloc, 2 * (size_t)count, sizeof *s->pairs);
    s->order = support_calloc(s->alloc, count, sizeof *s->order);
    s->lo = support_calloc(s->alloc, numbers, sizeof *s->lo);
    s->hi = support_calloc(s->alloc, numbers, sizeof *s->hi);
    s->crooked = support_calloc(s->alloc, count, sizeof *s->crooked);
    froe_status status = s->pairs && s->order && s->lo && s->hi && s->crooked ? sweep_all(s) : FROE_E_MEMORY;
    const size_t touches = s->touches.count;
    base_pair *pairs = support_calloc(s->alloc, 2 * touches + 1, sizeof *pairs); /* in order, to pass each touch once */
    if (!status && !pairs) status = FROE_E_MEMORY;
    for (size_t i = 0; i < touches && !status; i++)
        pairs[i].key = (uint64_t)s->touches.data[i].a << 32 | s->touches.data[i].b;
    if (!status) base_radix_sort(pairs, pairs + touches, touches);
    for (size_t i = 0; i < touches && !status; i++)
        if ((!i || pairs[i].key != pairs[i - 1].key) &&
            !s->fn(s->user, 0, (uint32_t)(pairs[i].key >> 32), (uint32_t)pairs[i].key))
            status = FROE_E_CANCELLED;
    support_free(s->alloc, pairs, (2 * touches + 1) * sizeof *pairs);
    if (!status) status = make_trees(s);
    size_t first = (size_t)s->straight * (size_t)s->of->scene->dim;
    if (!status)
        status = geom_box_pairs(s->alloc, s->task, 0.25, s->of->scene->dim, count - s->straight, s->lo + first,
                                s->hi + first, loose_pair, s);
    if (!status) status = base_run(s->task, 0.25, (count + (size_t)VISITORS - 1) / VISITORS, visit_sheets, s);
    support_free(s->alloc, s->pairs, 2 * (size_t)count * sizeof *s->pairs);
    support_free(s->alloc, s->order, count * sizeof *s->order);
    support_free(s->alloc, s->lo, numbers * sizeof *s->lo);
    support_free(s->alloc, s->hi, numbers * sizeof *s->hi);
    support_free(s->alloc, s->crooked, count * sizeof *s->crooked);
    size_t bounds = s->sheets.count * (size_t)s->of->scene->dim;
    for (size_t i = 0; i < s->sheets.count; i++)
        if (s->sheets.data[i].boxes.ids) measure_hierarchy_free(&s->sheets.data[i].boxes);
    if (s->bounds.ids) measure_hierarchy_free(&s->bounds);
    support_free(s->alloc, s->sheet_lo, bounds * sizeof *s->sheet_lo);
    support_free(s->alloc, s->sheet_hi, bounds * sizeof *s->sheet_hi);
    array_free(s->alloc, &s->sheets);
    array_free(s->alloc, &s->touches);
    return status;
}

froe_status measure_odd_pairs(base_task *task, num_context *context, const measure_candidates *of, geom_pair_fn *fn,
                              void *user) {
    const int dim = of->scene->dim;
    sheet_search s = {.of = of, .alloc = &of->scene->alloc, .task = task, .context = context, .fn = fn, .user = user};
    /* Are there more pairs of boxes than a sweep costs? Counting takes a small part of the time of testing. */
    s.counters = support_calloc(s.alloc, task->threads, sizeof *s.counters);
    if (!s.counters) return FROE_E_MEMORY;
    froe_status status = geom_box_pairs(s.alloc, task, 0.1, dim, of->count, of->lo, of->hi, count_pair, &s);
    support_free(s.alloc, s.counters, task->threads * sizeof *s.counters);
    if (status == FROE_E_CANCELLED && !base_cancelled(task))
        status = search_sheets(&s);
    else if (!status)
        status = geom_box_pairs(s.alloc, task, 0.9, dim, of->count, of->lo, of->hi, fn, user);
    if (!status && !base_progress(task, 1)) status = FROE_E_CANCELLED;
    return status;
}
