/* bar_cut.c: candidates by direction, and breadth first through sequences of them. */
#include "build/bar/bar_cut.h"
#include "base/select.h"
#include <math.h>
#include <string.h>

enum {
    CUTS = 3,       /* of a sequence, at most */
    LOOK = 1 << 14, /* points read beyond the first cut, at most: a sample */
    MOVES = 2       /* steps by which a rounded end of an interval is moved inwards */
};

#define FLOOR 0x1p-40

typedef struct key_counts {
    uint32_t below, above;
} key_counts;

static const double *rows(const bar_search *s, const bar_step *step) {
    return s->keys.data + step->row;
}

static bool key_is_above(const bar_rule *rule, double key, double value) {
    return key > value || (!rule->through && key == value);
}

static key_counts count_sides(const bar_rule *rule, const bar_search *s, const bar_step *step, int direction,
                              double value) {
    const double *key = rows(s, step) + direction;
    key_counts n = {0, 0};
    for (uint32_t i = 0; i < step->count; i++, key += rule->directions.count) {
        n.below += *key < value;
        n.above += key_is_above(rule, *key, value);
    }
    return n;
}

/* ---------------------------------------------------------------- the median -- */

double bar_between(const double *column, uint32_t count, double median) {
    uint32_t less = 0, more = 0;
    double before = -INFINITY, after = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        const double key = column[i];
        less += key < median;
        more += key > median;
        if (key < median && key > before) before = key;
        if (key > median && key < after) after = key;
    }
    if (!less && !more) return nextafter(median, INFINITY);
    const bool up = !less || (more && less < more); /* the larger part is what the median is in, without this end */
    const double a = up ? median : before, b = up ? after : median, middle = 0.5 * a + 0.5 * b;
    return middle > a ? middle : b;
}

/* --------------------------------------------------------------- candidates -- */

static bool fits_aspect(const bar_rule *rule, const bar_search *s, bar_candidate *c) {
    const double at = bar_shape_local(&s->shape, c->direction, c->value);
    if (!(at > s->shape.lo[c->direction] && at < s->shape.hi[c->direction])) return false;
    bar_shape_halves(&s->shape, c->direction, at, c->aspect);
    return c->aspect[0] <= rule->aspect && c->aspect[1] <= rule->aspect;
}

static bar_candidate candidate(const bar_rule *rule, bar_search *s, const bar_step *step, int direction) {
    const double *key = rows(s, step) + direction;
    for (uint32_t i = 0; i < step->count; i++, key += rule->directions.count) s->column.data[i] = *key;
    const double median = base_select(s->column.data, step->count, step->count / 2);
    bar_candidate c = {.direction = direction, .value = median};
    if (!rule->through) c.value = bar_between(s->column.data, step->count, median);
    if (!fits_aspect(rule, s, &c)) {
        /* moves the value to the nearest one that leaves both parts fat */
        double lo, hi, at = bar_shape_local(&s->shape, direction, c.value);
        if (!bar_shape_interval(&s->shape, direction, rule->aspect, &lo, &hi)) return (bar_candidate){.direction = -1};
        const bool up = at < 0.5 * lo + 0.5 * hi;
        int moves = 0;
        c.value = bar_shape_global(&s->shape, direction, up ? lo : hi);
        for (; moves <= MOVES && !fits_aspect(rule, s, &c); moves++)
            c.value = nextafter(c.value, up ? INFINITY : -INFINITY);
        if (moves > MOVES) return (bar_candidate){.direction = -1};
    }
    const key_counts n = count_sides(rule, s, step, direction, c.value);
    c.larger = (n.below > n.above ? n.below : n.above) * step->weight;
    return c;
}

static double fatness(const bar_candidate *c) {
    return c->aspect[0] > c->aspect[1] ? c->aspect[0] : c->aspect[1];
}

/** Evener parts are better, and of equally even ones the fatter. */
static bool is_better(const bar_candidate *c, const bar_candidate *than) {
    if (c->direction < 0 || than->direction < 0) return c->direction >= 0;
    return c->larger < than->larger || (c->larger == than->larger && fatness(c) < fatness(than));
}

/* ---------------------------------------------------------------- sequences -- */

/** Adds the part of a step that has most of its points, or a sample of them. */
static bool push_bar_step(const bar_rule *rule, const froe_allocator *alloc, bar_search *s, size_t at,
                          const bar_candidate *c) {
    bar_step from = s->steps.data[at], to = from;
    const size_t g = (size_t)rule->directions.count;
    const key_counts n = count_sides(rule, s, &from, c->direction, c->value);
    const bool above = n.above > n.below;
    const uint32_t stride = 1 + (above ? n.above : n.below) / LOOK;
    (above ? to.region.lo : to.region.hi)[c->direction] = c->value;
    to.row = s->keys.count;
    to.count = 0;
    to.cuts++;
    to.weight *= stride;
    if (from.cuts == 0) to.first = c->direction;
    if (!array_reserve(alloc, &s->keys, (size_t)(above ? n.above : n.below) * g)) return false;
    for (uint32_t i = 0, seen = 0; i < from.count; i++) {
        const double *row = rows(s, &from) + i * g;
        if (!(above ? key_is_above(rule, row[c->direction], c->value) : row[c->direction] < c->value)) continue;
        if (seen++ % stride) continue;
        memcpy(s->keys.data + s->keys.count, row, g * sizeof *row);
        s->keys.count += g;
        to.count++;
    }
    return !to.count || array_push(alloc, &s->steps, to);
}

bar_found bar_search_cut(const bar_rule *rule, const froe_allocator *alloc, bar_search *s, const bar_region *region,
                         uint32_t count, double target, bar_candidate *out) {
    bar_candidate all[DIRECTIONS_MOST], first[DIRECTIONS_MOST];
    bar_step whole = {.region = *region, .count = count, .weight = 1};
    s->keys.count = (size_t)count * (size_t)rule->directions.count;
    s->steps.count = s->column.count = 0;
    if (!array_reserve(alloc, &s->column, count) || !array_push(alloc, &s->steps, whole)) return BAR_MEMORY;
    out->direction = -1;
    for (size_t at = 0; at < s->steps.count; at++) {
        bar_step step = s->steps.data[at];
        if (!bar_shape_of(&rule->directions, &step.region, &s->shape)) continue;
        const double width = s->shape.width;
        if (width < rule->floor || width < FLOOR * bar_shape_reach(&s->shape)) continue; /* no cut between doubles */
        /* All candidates of the step. Where one along an axis is good enough the others are left out (direction -1):
         * their cuts cost more to store and to ask. */
        bar_candidate best = {.direction = -1};
        for (int i = 0; i < rule->directions.count; i++) {
            const bool enough = i >= rule->directions.dim && best.direction >= 0 && best.larger <= target;
            all[i] = enough ? (bar_candidate){.direction = -1} : candidate(rule, s, &step, i);
            if (is_better(all + i, &best)) best = all[i];
        }
        if (best.direction >= 0 && best.larger <= target) {
            *out = at ? first[step.first] : best;
            return BAR_CUT;
        }
        if (!at) memcpy(first, all, sizeof all), *out = best;
        for (int i = 0; i < rule->directions.count && step.cuts + 1 < CUTS; i++)
            if (all[i].direction >= 0 && !push_bar_step(rule, alloc, s, at, all + i)) return BAR_MEMORY;
    }
    return out->direction < 0 ? BAR_NONE : BAR_UNBALANCED;
}

void bar_search_free(const froe_allocator *alloc, bar_search *s) {
    array_free(alloc, &s->keys);
    array_free(alloc, &s->column);
    array_free(alloc, &s->steps);
}
