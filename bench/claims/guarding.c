/* guarding.c: numbers of guard stages, and the same of cells that are not as de Berg and Sacks have them: octrees that
 * do not shrink, slabs in place of cubes. */
#include "guarding.h"
#include "base/sort.h"
#include "scene/scene.h"
#include "split/guard/guards.h"
#include "support/alloc.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double promise_of(const claims_tree *t, const char *name, bool measured) {
    for (const froe_promise *p = t->report.promises; p->name; p++)
        if (!strcmp(p->name, name)) return measured ? p->measured : p->promised;
    return NAN;
}

/* -------------------------------------------------- octrees that do not shrink -- */

typedef struct cube {
    double lo[FROE_MAX_DIM], side;
    size_t first, count; /* guards strictly inside */
} cube;

static split_guards guards_of(const froe_scene *scene) {
    const froe_allocator alloc = support_allocator(NULL);
    split_guards guards = {0};
    base_task task;
    base_task_init(&task, 1, NULL, NULL);
    bench_must(split_guards_of(&alloc, &task, 0, scene, NULL, scene->object_count, &guards), NULL);
    return guards;
}

/** Moves the guards strictly inside an orthant to the front, and returns how many there are. */
static size_t take_orthant(double *points, size_t count, int dim, const cube *c) {
    size_t in = 0;
    for (size_t i = 0; i < count; i++) {
        double *p = points + i * (size_t)dim, *to = points + in * (size_t)dim;
        bool inside = true;
        for (int k = 0; k < dim; k++) inside = inside && p[k] > c->lo[k] && p[k] < c->lo[k] + c->side;
        for (int k = 0; k < dim && inside; k++) {
            const double swap = p[k];
            p[k] = to[k], to[k] = swap;
        }
        in += inside;
    }
    return in;
}

/** Cells of the octree of all corners of bounding boxes that goes on until k are left in a cell. */
static double octree_leaves(const froe_scene *scene, size_t k) {
    enum { STACK = 1 << 16 };
    split_guards g = guards_of(scene);
    const int dim = scene->dim;
    cube *stack = bench_take(STACK, sizeof *stack), root = {.count = g.count};
    for (int i = 0; i < dim; i++) {
        root.lo[i] = scene->lo[i];
        root.side = fmax(root.side, scene->hi[i] - scene->lo[i]);
    }
    double leaves = 1;
    size_t top = 0;
    stack[top++] = root;
    while (top) {
        const cube c = stack[--top];
        if (c.count <= k || c.side < 0x1p-1000) continue;
        leaves += (double)(1 << dim) - 1;
        size_t used = 0;
        for (int orthant = 0; orthant < 1 << dim; orthant++) {
            cube child = {.side = 0.5 * c.side, .first = c.first + used};
            for (int i = 0; i < dim; i++) child.lo[i] = c.lo[i] + (orthant >> i & 1 ? child.side : 0);
            child.count = take_orthant(g.points + child.first * (size_t)dim, c.count - used, dim, &child);
            used += child.count;
            if (top == STACK) exit(1);
            stack[top++] = child;
        }
    }
    free(stack);
    const froe_allocator alloc = support_allocator(NULL);
    split_guards_free(&alloc, &g);
    return leaves;
}

/* k of a guard stage, from its settings. */
static size_t guards_left(const claims_tree *t) {
    const char *k = strstr(t->report.settings, "k=");
    return k ? strtoul(k + 2, NULL, 10) : 0;
}

double guarding_leaves(const claims_tree *t) {
    return t->way.bare ? octree_leaves(t->scene, guards_left(t)) : promise_of(t, "guard_leaves", true);
}

double guarding_leaves_over_bound(const claims_tree *t) {
    return guarding_leaves(t) / promise_of(t, "guard_leaves", false);
}

/* ------------------------------------------------------ slabs in place of cubes -- */

typedef struct end {
    double x;
    int change;
} end;

static int by_place(const void *a, const void *b) {
    const end *p = a, *q = b;
    return p->x != q->x ? (p->x > q->x) - (p->x < q->x) : p->change - q->change;
}

/** Most objects that one slab across x meets that has no corner of a box strictly inside. */
static double slab_load(const froe_scene *scene) {
    const uint32_t n = scene->object_count;
    end *ends = bench_take(2 * (size_t)n, sizeof *ends);
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], load = 0, most = 0;
    for (uint32_t i = 0; i < n; i++) {
        scene_object_bounds(scene, i, lo, hi);
        ends[2 * i] = (end){lo[0], 1}, ends[2 * i + 1] = (end){hi[0], -1};
    }
    qsort(ends, 2 * (size_t)n, sizeof *ends, by_place);
    for (size_t i = 0; i < 2 * (size_t)n; i++) most = fmax(most, load += ends[i].change);
    free(ends);
    return most;
}

static double factor_of(const froe_scene *scene) { /* ceil(sqrt d)^d */
    return pow(ceil(sqrt(scene->dim)), scene->dim);
}

double guarding_load_over_bound(const claims_tree *t) {
    const double c = factor_of(t->scene), k = promise_of(t, "guard_load", false) / (1 + c);
    const double load = t->way.bare ? slab_load(t->scene) : promise_of(t, "guard_load", true);
    return load / (k + c * claims_density(t->scene));
}

double guarding_clutter_over_density(const claims_tree *t) {
    froe_clutter c = {.lower = 0};
    bench_must(froe_measure_clutter(t->scene, NULL, &c, NULL), NULL);
    return (t->way.bare ? slab_load(t->scene) : c.lower) / (factor_of(t->scene) * claims_density(t->scene));
}

double guarding_doubled(const claims_tree *t) {
    const double c = factor_of(t->scene), twice = 2 * claims_density(t->scene);
    double lambda = 2;
    if (!t->way.bare) return promise_of(t, "guard_load", false) / (1 + c) / twice;
    /* slabs with so many corners meet at least as many objects as those without */
    while (slab_load(t->scene) > (1 + c) * lambda) lambda *= 2;
    return lambda / twice;
}

double guarding_leaves_by_k(const claims_way *way, const void *of) {
    claims_series s = {.count = 0};
    (void)of;
    for (int k = 1; k <= 64; k *= 2) {
        char settings[40];
        snprintf(settings, sizeof settings, "k=%d form=cross", k);
        claims_tree t = claims_build("nested", 4000, 0, &(claims_way){way->method, settings, way->bare}, 1 << 30);
        claims_add(&s, k, guarding_leaves(&t));
        claims_free(&t);
    }
    return claims_slope(&s);
}
