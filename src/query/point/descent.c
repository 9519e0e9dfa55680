/* descent.c: see descent.h. */
#include "query/point/descent.h"
#include "support/fail.h"
#include <math.h>

enum { CUTS_PER_GROUP = 8, LEAVES_PER_CELL = 16 };

static void free_descent(const froe_allocator *alloc, query_part *part) {
    query_descent *d = (query_descent *)part;
    support_free(alloc, d->cuts, d->cut_count * sizeof *d->cuts);
    support_free(alloc, d->nodes, d->cut_count * sizeof *d->nodes);
    support_free(alloc, d->table, (size_t)d->columns * d->rows * sizeof *d->table);
    support_free(alloc, d, sizeof *d);
}

/* ------------------------------------------------------------------- order -- */

typedef struct descent_plan {
    const froe_tree *tree;
    const froe_allocator *alloc;
    query_descent *d;
    uint32_t *weights; /* [node]: leaves below */
    uint32_t *numbers; /* [node]: of its cut */
    ARRAY(uint32_t) roots;
} descent_plan;

/* Numbers cuts in groups, the heaviest first in each; the roots of others below a group wait. */
static bool number_cuts(descent_plan *p) {
    const tree_node *nodes = p->tree->nodes;
    for (uint32_t v = p->tree->node_count; v-- > 0;) /* children come after their parents */
        p->weights[v] = tree_is_leaf(nodes + v) ? 1 : p->weights[nodes[v].child] + p->weights[nodes[v].child + 1];
    if (!array_push(p->alloc, &p->roots, 0)) return false;
    while (p->roots.count) {
        uint32_t open[CUTS_PER_GROUP + 1] = {p->roots.data[--p->roots.count]};
        size_t count = 1;
        for (int taken = 0; taken < CUTS_PER_GROUP && count; taken++) {
            size_t best = 0;
            for (size_t i = 1; i < count; i++)
                if (p->weights[open[i]] > p->weights[open[best]]) best = i;
            const uint32_t node = open[best], child = nodes[node].child;
            open[best] = open[--count];
            p->numbers[node] = p->d->cut_count;
            p->d->nodes[p->d->cut_count++] = node;
            for (uint32_t side = 0; side < 2; side++)
                if (!tree_is_leaf(nodes + child + side)) open[count++] = child + side;
        }
        if (!array_reserve(p->alloc, &p->roots, count)) return false;
        for (size_t i = 0; i < count; i++) p->roots.data[p->roots.count++] = open[i];
    }
    return true;
}

/* -------------------------------------------------------------------- cuts -- */

/* A line in floats; false: floats cannot hold it. */
static bool see_line(const query_descent *d, const geom_plane *h, int *major, double *slope, double *c) {
    if (h->form <= GEOM_AT_CROSSING) {
        *major = h->axis;
        *slope = 0;
        *c = (d->lo[h->axis] - h->c) * d->scale;
        return h->c_err * d->scale <= 0x1p-26 && fabs(*c) <= 2;
    }
    const double *o = h->p[0];
    *major = fabs(h->n[1]) > fabs(h->n[0]);
    const int other = !*major;
    const double n = h->n[*major], along = d->lo[*major] - (h->form == GEOM_POINTS ? o[*major] : 0),
                 across = d->lo[other] - (h->form == GEOM_POINTS ? o[other] : 0),
                 value = geom_is_vector(h) ? h->c / n : 0;
    *slope = h->n[other] / n;
    *c = (along + *slope * across - value) * d->scale;
    const double size = (fabs(along) + fabs(across) + fabs(value)) * d->scale;
    if (!(h->c_err <= fabs(h->c) * 0x1p-40)) return false;
    return h->n_err <= fabs(n) * 0x1p-40 && size <= 0x1p10 && fabs(*c) <= 2;
}

/* ------------------------------------------------------------------- table -- */

/* The first cut from here on that may meet a cell. */
static uint32_t settle_cut(const query_descent *d, uint32_t next, const float middle[2], float half) {
    while (!(next & DESCENT_LEAF)) {
        const descent_cut *cut = d->cuts + next;
        const float value = query_descent_value(cut, middle);
        if (!(fabsf(value) > half * (1 + fabsf(cut->slope)) + 2 * DESCENT_DOUBT)) break;
        next = query_descent_next(cut, value > 0);
    }
    return next;
}

/* From coarse cells to fine ones, the first of each four last as it takes the place of their parent. */
static void fill_table(query_descent *d) {
    d->table[0] = 0;
    for (uint32_t step = 1u << ilogbf(d->grid); step; step /= 2)
        for (uint32_t i = (d->columns - 1) / step + 1; i-- > 0;)
            for (uint32_t j = (d->rows - 1) / step + 1; j-- > 0;) {
                const size_t parent = (size_t)(i & ~1u) * step * d->rows + (size_t)(j & ~1u) * step;
                const float half = 0.5f * (float)step / d->grid,
                            middle[2] = {(2 * (float)i + 1) * half, (2 * (float)j + 1) * half};
                d->table[(size_t)i * step * d->rows + (size_t)j * step] = settle_cut(d, d->table[parent], middle, half);
            }
}

/* ------------------------------------------------------------------ making -- */

/* Units of the scene, in which its longer side is a little less than 1; false: there are none. */
static bool take_units(query_descent *d, const froe_tree *t) {
    const froe_scene *s = t->scene;
    double side[2];
    /* one way: so many nodes take 16 GB */
    if (s->dim != 2 || tree_is_packed(t) || !s->object_count || t->node_count > DESCENT_NODE) return false;
    for (int k = 0; k < 2; k++) d->lo[k] = s->lo[k], side[k] = s->hi[k] - s->lo[k];
    const double most = fmax(side[0], side[1]);
    if (!(most >= 0x1p-900 && most <= 0x1p900) || tree_is_leaf(t->nodes)) return false;
    d->scale = (1 - 0x1p-10) / most;
    const double cells = (double)t->node_count / (2 * LEAVES_PER_CELL), area = side[0] * d->scale * side[1] * d->scale;
    d->grid = exp2f(fminf(fmaxf(roundf(0.5f * log2f((float)(cells / fmax(area, 0x1p-10)))), 0), 13));
    d->columns = (uint32_t)(side[0] * d->scale * (double)d->grid) + 1;
    d->rows = (uint32_t)(side[1] * d->scale * (double)d->grid) + 1;
    return true;
}

static froe_status make_descent(froe_query *q, query_part **out, froe_diagnostic *diag) {
    const froe_allocator *alloc = &q->alloc;
    const froe_tree *t = q->tree;
    query_descent *d = support_calloc(alloc, 1, sizeof *d);
    if (!d) return support_fail_memory(diag);
    d->part.free = free_descent;
    *out = &d->part;
    d->there = q->numbers.first == NUM_FILTER && take_units(d, t);
    if (!d->there) return FROE_OK;
    descent_plan p = {.tree = t, .alloc = alloc, .d = d};
    const uint32_t cuts = t->node_count / 2;
    bool ok = false;
    d->cuts = support_calloc(alloc, cuts, sizeof *d->cuts);
    d->nodes = support_calloc(alloc, cuts, sizeof *d->nodes);
    d->table = support_calloc(alloc, (size_t)d->columns * d->rows, sizeof *d->table);
    p.weights = support_calloc(alloc, t->node_count, sizeof *p.weights);
    p.numbers = support_calloc(alloc, t->node_count, sizeof *p.numbers);
    if (d->cuts && d->nodes && d->table && p.weights && p.numbers) {
        ok = number_cuts(&p);
        for (uint32_t i = 0; ok && i < cuts; i++) {
            const uint32_t node = d->nodes[i], child = t->nodes[node].child;
            const geom_plane h = tree_plane_at(t, node);
            int major;
            double slope, c;
            const bool seen = see_line(d, &h, &major, &slope, &c), back = seen && h.n[major] < 0;
            descent_cut *cut = d->cuts + i;
            *cut = (descent_cut){.slope = seen ? (float)slope : 0, .c = seen ? (float)c : NAN};
            for (uint32_t side = 0; side < 2; side++) {
                const tree_node *n = t->nodes + child + side;
                const uint32_t leaf = (child + side) | DESCENT_LEAF | (n->u.list.count ? 0 : DESCENT_EMPTY);
                cut->next[side ^ back] = tree_is_leaf(n) ? leaf : p.numbers[child + side];
            }
            if (seen && major) cut->next[0] |= DESCENT_STEEP;
            if (back) d->nodes[i] |= DESCENT_BACK;
        }
        if (ok) fill_table(d);
    }
    d->cut_count = cuts;
    support_free(alloc, p.weights, t->node_count * sizeof *p.weights);
    support_free(alloc, p.numbers, t->node_count * sizeof *p.numbers);
    array_free(alloc, &p.roots);
    return ok ? FROE_OK : support_fail_memory(diag);
}

froe_status query_descent_of(froe_query *query, const query_descent **out, froe_diagnostic *diag) {
    const query_part *part;
    const froe_status status = query_prepare(query, QUERY_DESCENT, make_descent, &part, diag);
    if (status == FROE_OK) *out = (const query_descent *)part;
    return status;
}
