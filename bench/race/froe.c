/* froe.c: froe as one of the programs that are compared: it gets the same arrays and the same questions.
 *
 * Everything from the arrays on is its cost: the scene, the tree, and what the first question prepares. */
#include "bench.h"
#include "query/packed/packed.h"
#include "query/packed/space.h"
#include "race.h"
#include <froe/query.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct settings { /* peer.own */
    char name[64], what[96], method[32], kernels[16];
    uint32_t leaf;
    unsigned threads;
} settings;

typedef struct index {
    const settings *s;
    froe_scene *scene;
    froe_tree *tree;
    froe_query *query;
    peer_kind kind;
    double seconds[2];
    void *scratch; /* for what the interface wants in arrays of its own types */
    size_t scratch_bytes;
} index;

/* ------------------------------------------------------------------- making -- */

static froe_scene *take_in(const peer_data *d, unsigned threads) {
    static const froe_kind kinds[PEER_KINDS] = {FROE_POINT,   FROE_SEGMENT, FROE_SEGMENT,
                                                FROE_POLYGON, FROE_BOX,     FROE_SEGMENT};
    froe_diagnostic why = {0};
    froe_objects o = froe_objects_defaults();
    froe_scene *scene = NULL;
    o.kind = kinds[d->kind], o.count = d->count, o.coords = d->coords, o.groups = d->groups, o.faces = d->faces;
    o.threads = threads;
    bench_must(froe_scene_new(d->dim, NULL, &scene), NULL);
    for (size_t i = 0; i < d->areas; i++) {
        uint32_t id;
        bench_must(froe_scene_add_group(scene, &(froe_group){.name = "area"}, &id), NULL);
    }
    bench_must(froe_scene_add(scene, &o, &why), &why);
    return scene;
}

static void take_kernels(const settings *s, froe_query *query) {
    for (size_t i = 0; s->kernels[0] && packed_kernels_at(i); i++) {
        if (strcmp(packed_kernels_at(i)->name, s->kernels) != 0) continue;
        if (query->packed) query->packed->kernels = packed_kernels_at(i);
        if (query->space) query->space->kernels = space_kernels_at(i);
        return;
    }
    bench_must(s->kernels[0] ? FROE_E_UNSUPPORTED : FROE_OK, NULL);
}

static void *make(const peer_data *d, const peer *self) {
    index *x = bench_take(1, sizeof *x);
    const double start = bench_cpu();
    x->s = self->own, x->kind = d->kind;
    x->scene = take_in(d, x->s->threads);
    x->seconds[0] = bench_cpu() - start;
    x->tree = bench_build(x->scene, x->s->method, NULL, x->s->leaf, x->s->threads, NULL);
    bench_must(froe_query_new(x->tree, &x->query, NULL), NULL);
    if (d->kind == PEER_AREAS ||
        d->kind == PEER_TRAPEZOIDS) { /* the first question prepares borders, or the way down */
        froe_list list;
        uint32_t above;
        if (d->kind == PEER_AREAS)
            bench_must(froe_query_groups(x->query, d->coords, &list, NULL), NULL);
        else
            bench_must(froe_query_vertical(x->query, d->coords, 1, &above, NULL), NULL);
    }
    take_kernels(x->s, x->query);
    x->seconds[1] = bench_cpu() - start - x->seconds[0];
    return x;
}

static void drop(void *it) {
    index *x = it;
    froe_query_free(x->query);
    froe_tree_free(x->tree);
    froe_scene_free(x->scene);
    free(x->scratch);
    free(x);
}

static void *scratch(index *x, size_t count, size_t size) {
    if (x->scratch_bytes < count * size) {
        free(x->scratch);
        x->scratch = bench_take(count, size);
        x->scratch_bytes = count * size;
    }
    return x->scratch;
}

static void steps(void *it, double seconds[2]) {
    memcpy(seconds, ((index *)it)->seconds, sizeof(double[2]));
}

static size_t tree_bytes(void *it) {
    return (size_t)froe_tree_report(((index *)it)->tree).bytes;
}

/* ------------------------------------------------------------------- answers -- */

static void put_list(peer_answers *out, size_t i, const uint32_t *ids, size_t count) {
    peer_room(out, count);
    memcpy(out->ids + out->used, ids, count * sizeof *ids);
    out->used += count;
    out->ends[i] = out->used;
}

static double parameter(const froe_hit *hit) {
    return hit->object == FROE_NONE ? (double)INFINITY : hit->t;
}

static double id_or_none(uint32_t id) {
    return id == FROE_NONE ? -1 : (double)id;
}

/* -1: none; less: several, where areas overlap. */
static double area(const uint32_t *ids, size_t count) {
    return count == 1 ? (double)ids[0] : count ? -1 - (double)count : -1;
}

static bool pair(void *values, const froe_pair *p) {
    peer_pair(values, p->a, p->b);
    return true;
}

static froe_range range_of(const peer_questions *q, const double *x) {
    froe_range r = froe_range_defaults();
    r.points = x;
    if (q->work == PEER_WINDOW) return r;
    r.shape = FROE_SHAPE_BALL, r.radius = x[q->width - 2];
    if (q->work == PEER_FUZZY) r.eps = x[q->width - 1] / (2 * r.radius); /* diam(Q) is twice the radius */
    return r;
}

static void answer_one(index *x, const peer_questions *q, size_t i, peer_answers *out) {
    const double *at = q->numbers + i * q->width;
    froe_list list;
    froe_neighbours near;
    froe_hit hit;
    uint32_t id;
    switch (q->work) {
    case PEER_NEAREST:
    case PEER_NEAREST_K:
        bench_must(froe_query_near(x->query, at, q->k, INFINITY, &near, NULL), NULL);
        for (size_t j = 0; j < q->k && j < near.count; j++) out->values[i * q->k + j] = near.items[j].distance;
        break;
    case PEER_FIRST_HIT:
        bench_must(froe_query_ray(x->query, at, q->directions + i * q->width, INFINITY, &hit, NULL), NULL);
        out->values[i] = parameter(&hit);
        break;
    case PEER_ANY_HIT:
        bench_must(froe_query_ray_any(x->query, at, q->directions + i * q->width, INFINITY, &id, NULL), NULL);
        out->values[i] = id != FROE_NONE;
        break;
    case PEER_ABOVE:
        bench_must(froe_query_vertical(x->query, at, 1, &id, NULL), NULL);
        out->values[i] = id_or_none(id);
        break;
    case PEER_AREA:
        bench_must(froe_query_groups(x->query, at, &list, NULL), NULL);
        out->values[i] = area(list.ids, list.count);
        break;
    default: {
        const froe_range range = range_of(q, at);
        bench_must(froe_query_range(x->query, &range, &list, NULL), NULL);
        put_list(out, i, list.ids, list.count);
    }
    }
}

static void let_go(void *answers) {
    froe_answers_free(answers);
    free(answers);
}

static void ranges_together(index *x, const peer_questions *q, const froe_batch_options *o, peer_answers *out) {
    froe_answers *all = bench_take(1, sizeof *all);
    if (q->work == PEER_WINDOW) {
        bench_must(froe_batch_boxes(x->query, q->numbers, q->count, o, all, NULL), NULL);
    } else {
        froe_range *ranges = scratch(x, q->count, sizeof *ranges);
        for (size_t i = 0; i < q->count; i++) ranges[i] = range_of(q, q->numbers + i * q->width);
        bench_must(froe_batch_range(x->query, ranges, q->count, o, all, NULL), NULL);
    }
    for (size_t i = 0; i < q->count; i++) out->ends[i] = all->starts[i + 1];
    out->used = all->starts[q->count];
    out->given = all->ids, out->owner = all, out->let_go = let_go;
}

static void rays_together(index *x, const peer_questions *q, const froe_batch_options *o, peer_answers *out) {
    froe_hit *hits = scratch(x, q->count, sizeof *hits);
    uint32_t *ids = (uint32_t *)hits;
    const bool first = q->work == PEER_FIRST_HIT;
    bench_must(first ? froe_batch_ray(x->query, q->numbers, q->directions, q->count, INFINITY, o, hits, NULL)
                     : froe_batch_ray_any(x->query, q->numbers, q->directions, q->count, INFINITY, o, ids, NULL),
               NULL);
    for (size_t i = 0; i < q->count; i++) out->values[i] = first ? parameter(hits + i) : ids[i] != FROE_NONE;
}

static void numbers_together(index *x, const peer_questions *q, const froe_batch_options *o, peer_answers *out) {
    if (q->work == PEER_ABOVE) {
        uint32_t *ids = scratch(x, q->count, sizeof *ids);
        bench_must(froe_batch_vertical(x->query, q->numbers, q->count, 1, o, ids, NULL), NULL);
        for (size_t i = 0; i < q->count; i++) out->values[i] = id_or_none(ids[i]);
        return;
    }
    froe_answers all;
    if (q->work == PEER_AREA)
        bench_must(froe_batch_groups(x->query, q->numbers, q->count, o, &all, NULL), NULL);
    else
        bench_must(froe_batch_near(x->query, q->numbers, q->count, q->k, INFINITY, o, &all, NULL), NULL);
    for (size_t i = 0; i < q->count; i++) {
        const size_t first = all.starts[i], count = all.starts[i + 1] - first;
        if (q->work == PEER_AREA)
            out->values[i] = area(all.ids + first, count);
        else
            memcpy(out->values + i * q->k, all.values + first, count * sizeof *out->values);
    }
    froe_answers_free(&all);
}

static void answer(void *it, const peer_questions *q, peer_answers *out) {
    index *x = it;
    froe_batch_options o = froe_batch_defaults();
    o.threads = x->s->threads;
    if (q->work == PEER_PAIRS) {
        out->values[0] = out->values[1] = 0;
        if (q->together)
            bench_must(froe_batch_pairs(x->query, true, &o, pair, out->values, NULL), NULL);
        else
            bench_must(froe_query_pairs(x->query, true, pair, out->values, NULL), NULL);
    } else if (!q->together) {
        for (size_t i = 0; i < q->count; i++) answer_one(x, q, i, out);
    } else if (q->work == PEER_WINDOW || q->work == PEER_BALL || q->work == PEER_FUZZY) {
        ranges_together(x, q, &o, out);
    } else if (q->work == PEER_FIRST_HIT || q->work == PEER_ANY_HIT) {
        rays_together(x, q, &o, out);
    } else {
        numbers_together(x, q, &o, out);
    }
}

/* ----------------------------------------------------------------- contestants -- */

static bool serves(const peer_data *d, peer_work work) {
    (void)d, (void)work;
    return true;
}

/* The name says what sets this way of using froe apart from the ordinary one. */
static void name_it(settings *s, bool plain) {
    size_t used = (size_t)snprintf(s->name, sizeof s->name, "froe");
    const char *const more[] = {plain ? NULL : s->method, s->kernels[0] ? s->kernels : NULL};
    for (int i = 0; i < 2; i++)
        if (more[i]) used += (size_t)snprintf(s->name + used, sizeof s->name - used, ", %s", more[i]);
    if (s->threads > 1) snprintf(s->name + used, sizeof s->name - used, ", %u threads", s->threads);
}

peer *race_froe(const char *spec, bool plain) {
    peer *p = bench_take(1, sizeof *p);
    settings *s = bench_take(1, sizeof *s);
    const size_t length = strcspn(spec, "/@+");
    *s = (settings){.leaf = FROE_LEAF_OWN, .threads = 1};
    snprintf(s->method, sizeof s->method, "%.*s", (int)length, spec);
    for (const char *at = spec + length; *at; at += 1 + strcspn(at + 1, "/@+")) {
        if (*at == '/') s->leaf = (uint32_t)strtoul(at + 1, NULL, 10);
        if (*at == '@') s->threads = (unsigned)strtoul(at + 1, NULL, 10);
        if (*at == '+') snprintf(s->kernels, sizeof s->kernels, "%.*s", (int)strcspn(at + 1, "/@+"), at + 1);
    }
    name_it(s, plain);
    snprintf(s->what, sizeof s->what, "method %s, instructions %s", s->method,
             s->kernels[0] ? s->kernels : packed_kernels_at(0)->name);
    *p = (peer){s->name, s->what, 0, false, serves, make, drop, answer, tree_bytes, steps, s};
    return p;
}

void race_froe_free(peer *p) {
    free((void *)(uintptr_t)p->own);
    free(p);
}
