/* plan.c: see plan.h. */
#include "plan.h"
#include "sample.h"
#include "select.h"
#include "support/fail.h"
#include "support/floats.h"
#include <math.h>

/* -------------------------------------------------------------------- plans -- */

froe_shard_plan *shards_plan_make(int dim, const froe_allocator *alloc) {
    froe_shard_plan *p = support_calloc(alloc, 1, sizeof *p);
    if (p) *p = (froe_shard_plan){.dim = dim, .alloc = *alloc};
    return p;
}

void froe_shard_plan_free(froe_shard_plan *p) {
    if (!p) return;
    const froe_allocator alloc = p->alloc;
    if (p->cells) support_free(&alloc, p->cells, 2 * (size_t)p->dim * p->count * sizeof *p->cells);
    array_free(&alloc, &p->nodes);
    support_free(&alloc, p, sizeof *p);
}

uint32_t froe_shard_plan_count(const froe_shard_plan *p) {
    return p ? p->count : 0;
}

froe_status shards_plan_join(froe_shard_plan *p) {
    typedef struct open_cut {
        uint32_t node;
        double hi; /* of the cell on its axis */
    } open_cut;
    open_cut above[SHARDS_DEEPEST];
    int depth = 0;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    const size_t dim = (size_t)p->dim, nodes = p->nodes.count;
    for (size_t a = 0; a < dim; a++) lo[a] = -INFINITY, hi[a] = INFINITY;
    for (size_t i = 0; i < nodes; i++) p->count += p->nodes.data[i].axis < 0;
    p->cells = support_calloc(&p->alloc, p->count, 2 * dim * sizeof *p->cells);
    if (!p->cells) return FROE_E_MEMORY;
    uint32_t shard = 0;
    for (size_t i = 0; i < nodes; i++) {
        shards_node *node = &p->nodes.data[i];
        if (node->axis >= 0) {
            if (depth == SHARDS_DEEPEST || node->axis >= p->dim ||
                !(node->value >= lo[node->axis] && node->value <= hi[node->axis]))
                return FROE_E_FORMAT;
            above[depth++] = (open_cut){(uint32_t)i, hi[node->axis]};
            node->upper = 0;
            hi[node->axis] = node->value;
            continue;
        }
        memcpy(p->cells + 2 * dim * shard, lo, dim * sizeof *lo);
        memcpy(p->cells + (2 * (size_t)shard + 1) * dim, hi, dim * sizeof *hi);
        node->upper = shard++;
        /* Cuts whose upper side ends here give back what they took; that of the next one begins. */
        for (; depth; depth--) {
            shards_node *cut = &p->nodes.data[above[depth - 1].node];
            if (!cut->upper) {
                cut->upper = (uint32_t)i + 1;
                hi[cut->axis] = above[depth - 1].hi;
                above[depth - 1].hi = lo[cut->axis]; /* kept here from now on */
                lo[cut->axis] = cut->value;
                break;
            }
            lo[cut->axis] = above[depth - 1].hi;
        }
        if (!depth) return i + 1 == nodes ? FROE_OK : FROE_E_FORMAT;
    }
    return FROE_E_FORMAT;
}

uint32_t froe_shard_plan_cells(const froe_shard_plan *p, const double *lo, const double *hi, uint32_t *cells) {
    SUPPORT_FLOATS_OWN;
    return shards_plan_cells(p, lo, hi, cells);
}

uint32_t shards_plan_cells(const froe_shard_plan *p, const double *lo, const double *hi, uint32_t *cells) {
    uint32_t stack[SHARDS_DEEPEST + 1], count = 0;
    int depth = 0;
    stack[depth++] = 0;
    while (depth) {
        const uint32_t at = stack[--depth];
        const shards_node node = p->nodes.data[at];
        if (node.axis < 0) {
            cells[count++] = node.upper;
            continue;
        }
        if (hi[node.axis] >= node.value) stack[depth++] = node.upper;
        if (lo[node.axis] <= node.value) stack[depth++] = at + 1;
    }
    return count;
}

uint32_t shards_plan_first(const froe_shard_plan *p, const double *lo) {
    uint32_t at = 0;
    while (p->nodes.data[at].axis >= 0) {
        const shards_node *node = &p->nodes.data[at];
        at = lo[node->axis] <= node->value ? at + 1 : node->upper;
    }
    return p->nodes.data[at].upper;
}

/* ------------------------------------------------------------------ medians -- */

/* Places of the sample, one after the other, dim doubles each. */
typedef struct places {
    double *at;
    size_t dim;
} places;

#define BY_AXIS(A)                                                                                                     \
    static int by_axis_##A(const void *x, const void *y) {                                                             \
        const double a = ((const double *)x)[A], b = ((const double *)y)[A];                                           \
        return (a > b) - (a < b);                                                                                      \
    }
BY_AXIS(0)
BY_AXIS(1)
BY_AXIS(2)
BY_AXIS(3)
BY_AXIS(4)
BY_AXIS(5)
BY_AXIS(6)
BY_AXIS(7)
static shards_compare_fn *const by_axis[] = {by_axis_0, by_axis_1, by_axis_2, by_axis_3,
                                             by_axis_4, by_axis_5, by_axis_6, by_axis_7};

/* The axis on which places lie furthest apart; -1: they are one place. */
static int widest_axis(const places *p, size_t first, size_t end) {
    int widest = -1;
    double most = 0;
    for (size_t a = 0; a < p->dim && first < end; a++) {
        double lo = p->at[first * p->dim + a], hi = lo;
        for (size_t i = first; i < end; i++) {
            const double x = p->at[i * p->dim + a];
            lo = x < lo ? x : lo;
            hi = x > hi ? x : hi;
        }
        if (lo < hi && (widest < 0 || 0.5 * hi - 0.5 * lo > most)) {
            widest = (int)a;
            most = 0.5 * hi - 0.5 * lo;
        }
    }
    return widest;
}

/* Divides places along an axis, so that so many of them come first, and returns whether the last of these is below the
 * next. */
static bool part_places(const places *p, double *at, size_t count, size_t axis, size_t below) {
    if (!below || below >= count) return false;
    const size_t size = p->dim * sizeof *at;
    shards_select(at, count, size, below, by_axis[axis]);
    shards_select(at, below, size, below - 1, by_axis[axis]);
    return at[(below - 1) * p->dim + axis] < at[below * p->dim + axis];
}

/* Divides places along an axis, and returns how many are to lie below a cut: about `wanted`, but with different numbers
 * on both sides of it, which there are: in front of the run of equal numbers there, or behind it. */
static size_t divide(const places *p, size_t first, size_t end, int axis, size_t wanted) {
    double *at = p->at + first * p->dim;
    const size_t count = end - first, a = (size_t)axis;
    if (part_places(p, at, count, a, wanted)) return wanted;
    const size_t middle = wanted < count ? wanted : count - 1;
    shards_select(at, count, p->dim * sizeof *at, middle, by_axis[a]);
    const double x = at[middle * p->dim + a];
    size_t lower = 0, upper = 0;
    for (size_t i = 0; i < count; i++) lower += at[i * p->dim + a] < x, upper += at[i * p->dim + a] <= x;
    const bool down = lower > 0 && (upper == count || wanted - lower <= upper - wanted);
    const size_t below = down ? lower : upper;
    part_places(p, at, count, a, below);
    return below;
}

/* Appends the cuts that divide the places among so many shards, in the order of the manifest. */
static bool cut_places(froe_shard_plan *plan, const places *p, size_t count, uint32_t shards) {
    struct part {
        size_t first, end;
        uint32_t shards;
    } stack[SHARDS_DEEPEST];
    int depth = 0;
    stack[depth++] = (struct part){0, count, shards};
    while (depth) {
        const struct part part = stack[--depth];
        const int axis = part.shards > 1 ? widest_axis(p, part.first, part.end) : -1;
        if (!array_push(&plan->alloc, &plan->nodes, (shards_node){.axis = axis})) return false;
        if (axis < 0) continue;
        const size_t all = part.end - part.first, dim = p->dim;
        const uint32_t lower = part.shards / 2;
        const size_t below = divide(p, part.first, part.end, axis, all / part.shards * lower);
        const double *at = p->at + (part.first + below) * dim + (size_t)axis;
        plan->nodes.data[plan->nodes.count - 1].value = 0.5 * at[-(ptrdiff_t)dim] + 0.5 * at[0];
        stack[depth++] = (struct part){part.first + below, part.end, part.shards - lower};
        stack[depth++] = (struct part){part.first, part.first + below, lower};
    }
    return true;
}

/* How many shards objects of this weight are to have for the memory; 0: too many. Samples err by some percent, so a
 * quarter of the memory is left, or less, where a folder has not so many shards. */
static uint64_t shards_for(uint64_t weight, uint64_t memory) {
    const uint64_t each = memory / 4 * 3, wanted = each ? weight / each + 1 : UINT64_MAX;
    if (wanted <= FROE_SHARDS_MOST) return wanted;
    return weight / memory < FROE_SHARDS_MOST ? FROE_SHARDS_MOST : 0;
}

static froe_status fail_little_memory(uint64_t weight, uint64_t memory, froe_diagnostic *diag) {
    const uint64_t least = (weight / FROE_SHARDS_MOST >> 20) + 1;
    return support_fail(diag, FROE_E_LIMIT,
                        "A folder has at most %d shards, and building one of so many takes up to %llu MiB of memory. "
                        "%.4g MiB were given.",
                        FROE_SHARDS_MOST, (unsigned long long)least, (double)memory / (1 << 20));
}

froe_status froe_shard_plan_new(froe_shard_sample *s, uint32_t shards, uint64_t memory, froe_shard_plan **out,
                                froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!s || !out) return support_fail_null(diag, __func__);
    if (shards > FROE_SHARDS_MOST)
        return support_fail(diag, FROE_E_ARG, "A folder has at most %d shards.", FROE_SHARDS_MOST);
    if (!memory) memory = UINT64_C(1) << 32;
    const uint64_t wanted = shards ? shards : shards_for(s->weight, memory);
    if (!wanted) return fail_little_memory(s->weight, memory, diag);
    const uint64_t *items = shards_sample_settle(s);
    const size_t dim = (size_t)s->dim, size = s->count * dim * sizeof(double);
    const places p = {.at = support_calloc(&s->alloc, s->count, dim * sizeof(double)), .dim = dim};
    froe_shard_plan *plan = shards_plan_make(s->dim, &s->alloc);
    for (size_t i = 0; i < s->count && p.at; i++)
        memcpy(p.at + i * dim, items + i * s->width + 1, dim * sizeof(double));
    const bool made = p.at && plan && cut_places(plan, &p, s->count, (uint32_t)wanted) && !shards_plan_join(plan);
    support_free(&s->alloc, p.at, size);
    if (!made) {
        froe_shard_plan_free(plan);
        return support_fail_memory(diag);
    }
    *out = plan;
    return FROE_OK;
}
