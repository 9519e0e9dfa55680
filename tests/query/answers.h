/* answers.h: all that can be asked of one tree, held against brute force in whole numbers and rationals on the scene
 * that the tree holds.
 *
 *     char why[200];
 *     if (!answers_right(tree, seed, rounds, why, sizeof why)) ...      // the first wrong one, as a sentence
 *     answers_ask(tree, seed, rounds);                                  // only that every call comes back
 */
#ifndef FROE_TESTS_QUERY_ANSWERS_H
#define FROE_TESTS_QUERY_ANSWERS_H
#include "oracle/segment.h"
#include "query/context.h"
#include "query/exact_ranges.h"

typedef struct answers {
    world w;
    froe_query *q;
    bool judge, wrong;
    bool huge; /* coordinates so large that ranges made of them overflow */
    int shift; /* that makes the scene whole */
    exact_body *bodies;
    uint64_t judged; /* objects of a question, by brute force */
    char *why;
    size_t room;
} answers;

/* An object that a question is about, with where it stands in the order of answers. */
typedef struct answers_item {
    uint32_t object;
    exact_value at;
} answers_item;

static inline void answers_complain(answers *a, const char *asked, const double *x, uint32_t object) {
    if (a->wrong || !a->judge) return;
    a->wrong = true;
    snprintf(a->why, a->room, "%s: object %u; at %a %a %a", asked, object, x[0], x[1], a->w.dim > 2 ? x[2] : 0.0);
}

/* Notes a status that is not FROE_OK; should it be judged? */
static inline bool answers_came(answers *a, const char *asked, froe_status status) {
    if (!status) return a->judge;
    if (a->judge && !a->wrong) snprintf(a->why, a->room, "%s: %s", asked, froe_status_name(status)), a->wrong = true;
    return false;
}

static inline bool answers_finite(const double *x, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!isfinite(x[i])) return false;
    return true;
}

/* ------------------------------------------------------------------ ranges -- */

static inline void answers_judge_list(answers *a, const char *asked, const double *x, const froe_list *got,
                                      const bool *expected) {
    bool *found = calloc(a->w.count + 1, sizeof *found);
    for (size_t i = 0; i < got->count; i++) {
        if (got->ids[i] >= a->w.count || found[got->ids[i]] || !expected[got->ids[i]]) {
            answers_complain(a, asked, x, got->ids[i]);
            break;
        }
        found[got->ids[i]] = true;
    }
    for (uint32_t i = 0; i < a->w.count; i++)
        if (expected[i] && !found[i]) answers_complain(a, asked, x, i);
    free(found);
}

static inline void answers_range(answers *a, world_dice *d, froe_range_shape shape, froe_walk walk) {
    question q;
    froe_list got;
    uint64_t count = 0, all = 0;
    uint32_t any;
    make(&a->w, d, shape, &q);
    q.range.walk = walk;
    range_truth *const meets = a->w.extreme ? exact_range_meets : truth;
    const bool usable = shape == FROE_SHAPE_BOX ? !isnan(q.points[0]) : answers_finite(q.points, MOST_POINTS * 3);
    if (usable && isfinite(q.range.radius) && answers_finite(q.offsets, MOST_POINTS)) {
        bool *expected = calloc(a->w.count + 1, sizeof *expected);
        for (uint32_t i = 0; a->judge && i < a->w.count; i++) all += expected[i] = meets(&a->w, &q, i), a->judged++;
        if (answers_came(a, "range", froe_query_range(a->q, &q.range, &got, NULL)))
            answers_judge_list(a, froe_range_shape_name(shape), q.points, &got, expected);
        if (answers_came(a, "count", froe_query_count(a->q, &q.range, &count, NULL)) && count != all)
            answers_complain(a, "count", q.points, (uint32_t)count);
        if (answers_came(a, "any", froe_query_any(a->q, &q.range, &any, NULL)) &&
            (any == FROE_NONE ? all > 0 : any >= a->w.count || !expected[any]))
            answers_complain(a, "any", q.points, any);
        free(expected);
    }
    if (a->w.dim <= 3) oracle_set_free(&q.set);
}

/* ------------------------------------------------------------------ points -- */

static inline bool answers_holds(const answers *a, const double *x, uint32_t object) {
    const size_t mark = exact_mark();
    const exact_value distance = exact_distance(x, &a->bodies[object]), zero = exact_value_of(0, 0);
    const bool holds = !exact_compare(&distance, &zero);
    (void)exact_keep(mark, &zero);
    return holds;
}

static inline void answers_locate(answers *a, const double *x) {
    froe_list got;
    froe_answers all;
    froe_batch_options o = froe_batch_defaults();
    bool *expected = calloc(a->w.count + 1, sizeof *expected);
    o.threads = 1;
    for (uint32_t i = 0; a->judge && i < a->w.count; i++) expected[i] = answers_holds(a, x, i);
    if (answers_came(a, "locate", froe_query_locate(a->q, x, &got, NULL)))
        answers_judge_list(a, "locate", x, &got, expected);
    const froe_status status = froe_batch_locate(a->q, x, 1, &o, &all, NULL);
    if (answers_came(a, "batch of points", status))
        answers_judge_list(a, "batch of points", x, &(froe_list){all.ids, all.starts[1]}, expected);
    if (!status) froe_answers_free(&all);
    free(expected);
}

static inline void answers_put(answers_item *sorted, size_t *count, answers_item x) {
    size_t at = (*count)++;
    for (; at && exact_compare(&x.at, &sorted[at - 1].at) < 0; at--) sorted[at] = sorted[at - 1];
    sorted[at] = x;
}

static inline void answers_near(answers *a, world_dice *d, const double *x, int power) {
    answers_item *sorted = calloc(a->w.count + 1, sizeof *sorted);
    froe_neighbours got;
    size_t count = 0;
    const size_t k = 1 + world_below(d, 3);
    for (uint32_t i = 0; a->judge && i < a->w.count; i++, a->judged++) {
        const size_t mark = exact_mark();
        const exact_value distance = exact_distance(x, &a->bodies[i]);
        answers_put(sorted, &count, (answers_item){i, exact_keep(mark, &distance)});
    }
    if (answers_came(a, "near", froe_query_near(a->q, x, k, INFINITY, &got, NULL))) {
        if (got.count != (k < count ? k : count)) answers_complain(a, "near, count", x, (uint32_t)got.count);
        for (size_t i = 0; i < got.count && !a->wrong; i++)
            if (got.items[i].object != sorted[i].object ||
                !exact_rounds_to(&sorted[i].at, got.items[i].distance, power))
                answers_complain(a, "near", x, got.items[i].object);
    }
    free(sorted);
}

/* -------------------------------------------------------------------- rays -- */

static inline void answers_judge_first(answers *a, const char *asked, const double *x, const froe_hit *hit,
                                       const answers_item *sorted, size_t count) {
    if (hit->object != (count ? sorted->object : FROE_NONE) || (count && !exact_rounds_to(&sorted->at, hit->t, 0)))
        answers_complain(a, asked, x, hit->object);
}

static inline void answers_judge_any(answers *a, const char *asked, const double *x, uint32_t any,
                                     const answers_item *sorted, size_t count) {
    bool found = !count && any == FROE_NONE;
    for (size_t i = 0; i < count; i++) found |= sorted[i].object == any;
    if (!found) answers_complain(a, asked, x, any);
}

static inline void answers_ray(answers *a, const double *x, const double *direction) {
    answers_item *sorted = calloc(a->w.count + 1, sizeof *sorted);
    size_t count = 0;
    froe_hit first;
    froe_hits all;
    uint32_t any;
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    for (uint32_t i = 0; a->judge && i < a->w.count; i++, a->judged++) {
        const size_t mark = exact_mark();
        exact_value t;
        if (exact_ray(x, direction, &a->bodies[i], &t))
            answers_put(sorted, &count, (answers_item){i, exact_keep(mark, &t)});
    }
    if (answers_came(a, "ray", froe_query_ray(a->q, x, direction, INFINITY, &first, NULL)))
        answers_judge_first(a, "ray", x, &first, sorted, count);
    if (answers_came(a, "ray any", froe_query_ray_any(a->q, x, direction, INFINITY, &any, NULL)))
        answers_judge_any(a, "ray any", x, any, sorted, count);
    if (answers_came(a, "batch of rays", froe_batch_ray(a->q, x, direction, 1, INFINITY, &o, &first, NULL)))
        answers_judge_first(a, "batch of rays", x, &first, sorted, count);
    if (answers_came(a, "ray all", froe_query_ray_all(a->q, x, direction, INFINITY, &all, NULL))) {
        if (all.count != count) answers_complain(a, "ray all, count", x, (uint32_t)all.count);
        for (size_t i = 0; i < count && !a->wrong; i++)
            if (all.hits[i].object != sorted[i].object || !exact_rounds_to(&sorted[i].at, all.hits[i].t, 0))
                answers_complain(a, "ray all", x, all.hits[i].object);
    }
    free(sorted);
}

static inline void answers_vertical(answers *a, const double *x, int direction) {
    const double ray[2] = {0, direction};
    answers_item *sorted = calloc(a->w.count + 1, sizeof *sorted);
    size_t count = 0;
    uint32_t object;
    for (uint32_t i = 0; a->judge && i < a->w.count; i++, a->judged++) {
        const size_t mark = exact_mark();
        exact_value t;
        if (froe_scene_object(a->w.scene, i).kind == FROE_SEGMENT && exact_ray(x, ray, &a->bodies[i], &t))
            answers_put(sorted, &count, (answers_item){i, exact_keep(mark, &t)});
    }
    if (answers_came(a, "vertical", froe_query_vertical(a->q, x, direction, &object, NULL)) &&
        object != (count ? sorted->object : FROE_NONE))
        answers_complain(a, "vertical", x, object);
    free(sorted);
}

/* ------------------------------------------------------------------- pairs -- */

typedef struct answers_pairs {
    answers *a;
    bool shared;
    uint32_t next[2];
} answers_pairs;

/* Goes on to the next pair that should be told of; false: there is none. */
static inline bool answers_next_pair(answers_pairs *p, froe_meeting *kind) {
    static const froe_meeting kinds[] = {[1] = FROE_MEET_CROSS, [2] = FROE_MEET_TOUCH, [3] = FROE_MEET_OVERLAP};
    const answers *a = p->a;
    for (; p->next[0] < a->w.count; p->next[0]++, p->next[1] = p->next[0]) {
        while (++p->next[1] < a->w.count) {
            const size_t mark = exact_mark();
            bool corner = false;
            const int met = exact_contact(&a->bodies[p->next[0]], &a->bodies[p->next[1]], &corner);
            const exact_value zero = exact_value_of(0, 0);
            (void)exact_keep(mark, &zero);
            if (met && (p->shared || !corner)) return *kind = kinds[met], true;
        }
    }
    return false;
}

static inline bool answers_see_pair(void *user, const froe_pair *pair) {
    answers_pairs *p = user;
    const double none[3] = {0};
    froe_meeting kind;
    if (!p->a->judge) return true;
    if (!answers_next_pair(p, &kind) || pair->a != p->next[0] || pair->b != p->next[1] || pair->kind != kind)
        answers_complain(p->a, "pairs", none, pair->a);
    return !p->a->wrong;
}

static inline void answers_all_pairs(answers *a) {
    const double none[3] = {0};
    froe_batch_options o = froe_batch_defaults();
    froe_meeting kind;
    o.threads = 1;
    for (int shared = 0; shared < 2; shared++)
        for (int batch = 0; batch < 2; batch++) {
            answers_pairs p = {a, shared, {0, 0}};
            const froe_status status = batch ? froe_batch_pairs(a->q, shared, &o, answers_see_pair, &p, NULL)
                                             : froe_query_pairs(a->q, shared, answers_see_pair, &p, NULL);
            if (answers_came(a, "pairs", status) && !a->wrong && answers_next_pair(&p, &kind))
                answers_complain(a, "pairs, missing", none, p.next[0]);
        }
}

/* ------------------------------------------------------------------ groups -- */

/* Is segment i one of its group's that share a face with another one? */
static inline bool answers_faced(const answers *a, uint32_t i) {
    const froe_object o = froe_scene_object(a->w.scene, i);
    for (uint32_t j = 0; j < a->w.count; j++) {
        const froe_object other = froe_scene_object(a->w.scene, j);
        if (j != i && other.form == FROE_SEGMENT && other.group == o.group && other.face == o.face) return true;
    }
    return false;
}

/* Ends of the borders of a group at a vertex. */
static inline uint32_t answers_degree(const answers *a, uint32_t group, const bool *border, uint32_t vertex) {
    uint32_t degree = 0;
    for (uint32_t i = 0; i < a->w.count; i++)
        for (uint32_t c = 0; border[i] && froe_scene_object(a->w.scene, i).group == group && c < 2; c++)
            degree += froe_scene_corner(a->w.scene, i, c) == vertex;
    return degree;
}

static inline bool answers_closed(const answers *a, uint32_t group, const bool *border) {
    for (uint32_t v = 0; v < froe_scene_vertex_count(a->w.scene); v++)
        if (answers_degree(a, group, border, v) % 2) return false;
    return true;
}

/* Which segments bound an area; false: froe refuses the scene, for rings that do not close. */
static inline bool answers_borders(const answers *a, bool *border) {
    for (uint32_t g = 0; g < froe_scene_group_count(a->w.scene); g++) {
        bool faced = false;
        for (uint32_t i = 0; i < a->w.count; i++) {
            const froe_object o = froe_scene_object(a->w.scene, i);
            if (o.group == g && o.form == FROE_SEGMENT) faced |= border[i] = answers_faced(a, i);
        }
        for (uint32_t i = 0; i < a->w.count && !faced; i++) {
            const froe_object o = froe_scene_object(a->w.scene, i);
            if (o.group == g) border[i] = o.form == FROE_SEGMENT;
        }
        if (answers_closed(a, g, border)) continue;
        if (faced) return false;
        for (uint32_t i = 0; i < a->w.count; i++)
            if (froe_scene_object(a->w.scene, i).group == g) border[i] = false;
    }
    return true;
}

/* Does the ray from x upwards cross the segment, whose left end belongs to it and whose right end does not? */
static inline bool answers_is_below(const double *u, const double *v, const double *x) {
    if ((u[0] <= x[0]) == (v[0] <= x[0])) return false;
    return oracle_turn(u[0] < v[0] ? u : v, u[0] < v[0] ? v : u, x) < 0;
}

static inline bool answers_in_group(const answers *a, uint32_t group, const bool *border, const double *x) {
    bool odd = false;
    for (uint32_t i = 0; i < a->w.count; i++) {
        if (froe_scene_object(a->w.scene, i).group != group) continue;
        if (answers_holds(a, x, i)) return true;
        if (border[i])
            odd ^= answers_is_below(froe_scene_vertex(a->w.scene, froe_scene_corner(a->w.scene, i, 0)),
                                    froe_scene_vertex(a->w.scene, froe_scene_corner(a->w.scene, i, 1)), x);
    }
    return odd;
}

static inline void answers_groups(answers *a, const double *x) {
    froe_list got;
    bool *border = calloc(a->w.count + 1, sizeof *border);
    const bool closed = !a->judge || answers_borders(a, border);
    const froe_status status = froe_query_groups(a->q, x, &got, NULL);
    if (!closed && status == FROE_E_UNSUPPORTED) {
        free(border);
        return;
    }
    if (answers_came(a, "groups", status))
        for (uint32_t g = 0, i = 0; g < froe_scene_group_count(a->w.scene); g++) {
            const bool found = i < got.count && got.ids[i] == g;
            if (!closed || found != answers_in_group(a, g, border, x)) answers_complain(a, "groups", x, g);
            i += found;
        }
    free(border);
}

/* ------------------------------------------------------------------- whole -- */

/* Shapes of ranges for a dimension, by turns. The oracle takes minutes for some boxes, halfspaces and hulls of
 * space. */
static inline froe_range_shape answers_shape(const world *w, int round) {
    const int dim = w->dim;
    static const froe_range_shape exact[] = {FROE_SHAPE_BOX, FROE_SHAPE_BALL,    FROE_SHAPE_SEGMENT,
                                             FROE_SHAPE_RAY, FROE_SHAPE_SIMPLEX, FROE_SHAPE_HULL};
    static const froe_range_shape space[] = {FROE_SHAPE_BOX,     FROE_SHAPE_BALL,    FROE_SHAPE_SEGMENT,
                                             FROE_SHAPE_CAPSULE, FROE_SHAPE_SIMPLEX, FROE_SHAPE_RAY};
    if (w->extreme) return exact[round % (dim <= 3 ? 6 : 2)]; /* of which the oracle needs no rationals */
    if (dim == 2) return (froe_range_shape)(round % FROE_SHAPE_COUNT);
    return space[round % (dim == 3 ? 6 : 2)];
}

static inline void answers_round(answers *a, world_dice *d, int round) {
    const int shape_round = a->w.extreme ? (int)world_below(d, 6) : round;
    double x[FROE_MAX_DIM], to[FROE_MAX_DIM], direction[FROE_MAX_DIM];
    const int dim = a->w.dim;
    const froe_range_shape shape = answers_shape(&a->w, shape_round);
    if (!a->huge || a->w.extreme) {
        answers_range(a, d, shape, FROE_WALK_AUTO);
        answers_range(a, d, shape, (froe_walk)(round % FROE_WALK_COUNT));
        answers_range(a, d, FROE_SHAPE_BOX, FROE_WALK_AUTO);
    }
    world_point(&a->w, d, x);
    world_point(&a->w, d, to);
    bool some = false;
    for (int k = 0; k < dim; k++) {
        direction[k] = round % 3 ? to[k] - x[k] : k == round % dim ? 1 : 0;
        some |= direction[k] != 0;
    }
    if (a->w.extreme) make_vector(&a->w, d, direction), some = true;
    if (!answers_finite(x, (size_t)dim) || !answers_finite(direction, (size_t)dim)) return;
    const int power = exact_shift(exact_shift(a->shift, x, (size_t)dim), direction, (size_t)dim);
    if (a->judge) exact_world_begin(&a->w, power, a->bodies);
    answers_locate(a, x);
    answers_near(a, d, x, power);
    if (some) answers_ray(a, x, direction);
    if (dim == 2) answers_vertical(a, x, round % 2 ? 1 : -1);
    if (dim == 2) answers_groups(a, x);
    if (round == 0 && !a->w.extreme) answers_all_pairs(a);
}

typedef enum answers_mode { ANSWERS_JUDGE = 1, ANSWERS_EXTREME = 2 } answers_mode;

/* *judged: grows by how many objects brute force was asked about. */
static inline bool answers_run(froe_query *q, unsigned mode, uint64_t seed, int rounds, uint64_t *judged, char *why,
                               size_t room) {
    answers a = {.q = q, .judge = mode & ANSWERS_JUDGE, .why = why, .room = room};
    world_dice d = {seed, 0};
    double lo[FROE_MAX_DIM] = {0}, hi[FROE_MAX_DIM] = {0};
    const froe_tree *tree = q->tree;
    const froe_scene *scene = froe_tree_scene(tree);
    froe_tree *trees[] = {(froe_tree *)(uintptr_t)tree};
    a.w = (world){.name = "tree", .dim = froe_scene_dim(scene), .count = froe_scene_object_count(scene)};
    a.w.scene = (froe_scene *)(uintptr_t)scene;
    a.w.trees = trees, a.w.tree_count = 1, a.w.scale = 1;
    a.w.extreme = mode & ANSWERS_EXTREME;
    if (froe_scene_bounds(scene, lo, hi))
        for (int k = 0; k < a.w.dim; k++) {
            a.w.origin[k] = lo[k], a.w.scale = fmax(hi[k] - lo[k], k ? a.w.scale : 0);
            a.huge |= fabs(lo[k]) > 0x1p1000 || fabs(hi[k]) > 0x1p1000;
        }
    for (uint32_t i = 0; i < tree->node_count; i++) { /* points are drawn from cuts, too */
        const froe_cut cut = tree_cut_at(tree, i);
        a.huge |= cut.kind == FROE_CUT_AXIS && fabs(cut.value) > 0x1p1000;
    }
    a.w.objects = calloc(a.w.count + 1, sizeof *a.w.objects);
    a.bodies = calloc(a.w.count + 1, sizeof *a.bodies);
    for (uint32_t i = 0; i < a.w.count && a.w.dim <= 3; i++) a.w.objects[i] = oracle_object(scene, i);
    if (a.judge) a.shift = exact_world_shift(&a.w);
    for (int round = 0; round < rounds && !a.wrong; round++) {
        a.w.lattice = a.w.scale >= 2 && round % 2;
        answers_round(&a, &d, round);
    }
    for (uint32_t i = 0; i < a.w.count && a.w.dim <= 3; i++) oracle_set_free(&a.w.objects[i]);
    free(a.bodies);
    free(a.w.objects);
    *judged += a.judged;
    return !a.wrong;
}

static inline bool answers_ask_tree(const froe_tree *tree, unsigned mode, uint64_t seed, int rounds, uint64_t *judged,
                                    char *why, size_t room) {
    froe_query *q;
    if (froe_query_new(tree, &q, NULL)) return snprintf(why, room, "no context"), false;
    const bool right = answers_run(q, mode, seed, rounds, judged, why, room);
    froe_query_free(q);
    return right;
}

/** Are the answers to `rounds` of questions of every kind right? If not, `why` says which is the first wrong one. */
static inline bool answers_right(const froe_tree *tree, uint64_t seed, int rounds, char *why, size_t room) {
    uint64_t judged = 0;
    return answers_ask_tree(tree, ANSWERS_JUDGE, seed, rounds, &judged, why, room);
}

/** The same, with places and lengths of every scale if the scene is such; counts what brute force decided. */
static inline bool answers_judge(const froe_tree *tree, bool extreme, uint64_t seed, int rounds, uint64_t *judged,
                                 char *why, size_t room) {
    return answers_ask_tree(tree, ANSWERS_JUDGE | (extreme ? ANSWERS_EXTREME : 0), seed, rounds, judged, why, room);
}

/** The same by a context, with places and lengths of every scale; without pairs, which take long there. */
static inline bool answers_right_at_every_scale(froe_query *q, uint64_t seed, int rounds, char *why, size_t room) {
    uint64_t judged = 0;
    return answers_run(q, ANSWERS_JUDGE | ANSWERS_EXTREME, seed, rounds, &judged, why, room);
}

/** Asks the same questions of a tree that may be wrong. */
static inline void answers_ask(const froe_tree *tree, uint64_t seed, int rounds) {
    char why[40];
    uint64_t judged = 0;
    (void)answers_ask_tree(tree, 0, seed, rounds, &judged, why, sizeof why);
}
#endif
