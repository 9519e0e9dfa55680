/* Groups against ranges and against groups of other trees, beside an oracle that shares nothing with the code: one
 * sample point of every face, edge piece and vertex of the arrangement of all segments, in fractions of whole numbers,
 * with sides by counting. Scenes lie on grids of few points, so that borders touch, cross and overlap all the time;
 * affine maps with whole numbers take them to coordinates at which doubles alone would be wrong. */
#include "query/exact_world.h"
#include "support/memory.h"
#include <unistd.h>

enum { GROUPS = 6, SEGMENTS = 192, SAMPLES_X = 1 << 15, DECISIONS = 100000 };

static uint64_t decisions, holding[FROE_RELATION_COUNT];

/* --------------------------------------------------------------- fractions -- */

typedef __int128 whole;
typedef struct fraction {
    whole num, den; /* den > 0, reduced */
} fraction;

static fraction fraction_of(whole num, whole den) {
    whole a = num < 0 ? -num : num, b = den < 0 ? -den : den;
    while (b) {
        const whole rest = a % b;
        a = b, b = rest;
    }
    if (den < 0) a = -a;
    return (fraction){num / a, den / a};
}
static int compare_fractions(const void *x, const void *y) {
    const fraction *a = x, *b = y;
    const whole left = a->num * b->den, right = b->num * a->den;
    return (left > right) - (left < right);
}
static fraction middle_of(fraction a, fraction b) {
    return fraction_of(a.num * b.den + b.num * a.den, 2 * a.den * b.den);
}
/* Sorts, keeps one of equal ones, and puts one between each two. */
static size_t refine(fraction *list, size_t count) {
    size_t distinct = 0;
    qsort(list, count, sizeof *list, compare_fractions);
    for (size_t i = 0; i < count; i++)
        if (!distinct || compare_fractions(list + distinct - 1, list + i)) list[distinct++] = list[i];
    for (size_t i = distinct; i-- > 1;) {
        const fraction high = list[i];
        list[2 * i] = high;
        list[2 * i - 1] = middle_of(list[i - 1], high);
    }
    return distinct ? 2 * distinct - 1 : 0;
}

/* ------------------------------------------------------------------ oracle -- */

/** A segment of a set, on the grid; a point if its ends are equal. */
typedef struct edge {
    int u[2], v[2], set;
    bool border;
} edge;
typedef struct picture {
    edge edges[SEGMENTS];
    size_t count;
} picture;

static void put_edge(picture *p, int set, const int *u, const int *v, bool border) {
    assert_true(p->count < SEGMENTS);
    p->edges[p->count++] = (edge){{u[0], u[1]}, {v[0], v[1]}, set, border};
}

/* Which sets is the point in, as bits? On a segment, or an odd number of borders above. */
static uint32_t sets_at(const picture *p, fraction x, fraction y) {
    uint32_t on = 0, odd = 0;
    for (size_t i = 0; i < p->count; i++) {
        const edge *e = p->edges + i;
        const bool swap = e->u[0] > e->v[0];
        const int *a = swap ? e->v : e->u, *b = swap ? e->u : e->v;
        const whole left = a[0] * x.den, right = b[0] * x.den;
        const whole dx = b[0] - a[0], dy = b[1] - a[1];
        /* height of the line over the point, times dx den(x) den(y) */
        const whole over = (a[1] * dx * x.den + dy * (x.num - left)) * y.den - y.num * dx * x.den;
        if (dx == 0) {
            const whole low = (a[1] < b[1] ? a[1] : b[1]) * y.den, high = (a[1] < b[1] ? b[1] : a[1]) * y.den;
            if (x.num == left && low <= y.num && y.num <= high) on |= 1u << e->set;
        } else if (left <= x.num && x.num <= right) {
            if (over == 0) on |= 1u << e->set;
            if (e->border && x.num < right && over > 0) odd ^= 1u << e->set;
        }
    }
    return on | odd;
}

static size_t sample_columns(const picture *p, fraction *xs) {
    size_t count = 0;
    for (size_t i = 0; i < p->count; i++) {
        const edge *e = p->edges + i;
        xs[count++] = fraction_of(e->u[0], 1), xs[count++] = fraction_of(e->v[0], 1);
        for (size_t j = 0; j < i; j++) {
            const edge *f = p->edges + j;
            const int d[2] = {e->v[0] - e->u[0], e->v[1] - e->u[1]}, g[2] = {f->v[0] - f->u[0], f->v[1] - f->u[1]};
            const int cross = d[0] * g[1] - d[1] * g[0], to[2] = {f->u[0] - e->u[0], f->u[1] - e->u[1]};
            const int t = to[0] * g[1] - to[1] * g[0], s = to[0] * d[1] - to[1] * d[0];
            if (!cross || t * cross < 0 || s * cross < 0 || abs(t) > abs(cross) || abs(s) > abs(cross)) continue;
            xs[count++] = fraction_of(e->u[0] * (whole)cross + d[0] * (whole)t, cross);
        }
    }
    assert_true(2 * count < SAMPLES_X);
    return refine(xs, count);
}

/* For every pair of sets: has[a][b], is there a point in both? lacks[a][b], is there one in a and not in b? */
typedef struct verdict {
    bool has[32][32], lacks[32][32];
    uint32_t present;
} verdict;

static void judge(const picture *p, verdict *out) {
    static fraction xs[SAMPLES_X], ys[6 * SEGMENTS];
    const size_t columns = sample_columns(p, xs);
    memset(out, 0, sizeof *out);
    for (size_t c = 0; c < columns; c++) {
        const fraction x = xs[c];
        size_t rows = 0;
        for (size_t i = 0; i < p->count; i++) {
            const edge *e = p->edges + i;
            const whole dx = e->v[0] - e->u[0], dy = e->v[1] - e->u[1];
            if (dx == 0) {
                if (e->u[0] * x.den != x.num) continue;
                ys[rows++] = fraction_of(e->u[1], 1), ys[rows++] = fraction_of(e->v[1], 1);
            } else {
                ys[rows++] = fraction_of(e->u[1] * dx * x.den + dy * (x.num - e->u[0] * x.den), dx * x.den);
            }
        }
        rows = refine(ys, rows);
        for (size_t r = 0; r < rows; r++) {
            const uint32_t in = sets_at(p, x, ys[r]);
            out->present |= in;
            for (uint32_t a = 0; a < 32; a++)
                for (uint32_t b = 0; in >> a & 1 && b < 32; b++) {
                    out->has[a][b] |= in >> b & 1;
                    out->lacks[a][b] |= !(in >> b & 1);
                }
        }
    }
}

/* Has group g the relation to set q? */
static bool is_related(const verdict *v, froe_relation relation, uint32_t g, uint32_t q) {
    if (!(v->present >> g & 1) || !(v->present >> q & 1)) return false;
    return relation == FROE_MEETS ? v->has[g][q] : relation == FROE_WITHIN ? !v->lacks[g][q] : !v->lacks[q][g];
}

/* ------------------------------------------------------------------- scenes -- */

/** From the grid to coordinates: whole numbers, and a power of two. */
typedef struct map {
    double m[2][2], to[2];
    int power;
} map;
static const map maps[] = {
    {{{1, 0}, {0, 1}}, {0, 0}, 0},
    {{{3, 0}, {0, -5}}, {-7, 2}, 0},
    {{{1, 0}, {0, 1}}, {0, 0}, 1000},
    {{{1, 0}, {0, 1}}, {-3, 2}, -1074},
    {{{268435399, 134217689}, {134217757, 67108859}}, {0, 0}, 0}, /* thin; determinants of 2^56 and more */
    {{{268435399, 268435397}, {268435397, 268435395}}, {4503599627370449, 3}, -900},
    {{{1, 0}, {0, 1}}, {4503599627370449, -4503599627370401}, -40}, /* far away */
};
enum { MAPS = sizeof maps / sizeof *maps };

static void map_point(const map *m, const int *x, double *out) {
    for (int k = 0; k < 2; k++) out[k] = ldexp(m->m[k][0] * x[0] + m->m[k][1] * x[1] + m->to[k], m->power);
}

/** A scene of groups, and the same on the grid: group g is set first + g. */
typedef struct drawing {
    froe_scene *scene;
    picture *p;
    const map *m;
    world_dice *d;
    int grid;
} drawing;

static void add_segments(const drawing *w, uint32_t group, uint32_t face, const int (*at)[2], uint32_t count,
                         bool closed, bool border, int set) {
    double ends[4 * 16];
    uint32_t faces[16], n = closed ? count : count - 1;
    froe_objects o = froe_objects_defaults();
    for (uint32_t i = 0; i < n; i++) {
        map_point(w->m, at[i], ends + 4 * i), map_point(w->m, at[(i + 1) % count], ends + 4 * i + 2);
        faces[i] = face;
        put_edge(w->p, set, at[i], at[(i + 1) % count], border);
    }
    o.kind = FROE_SEGMENT, o.count = n, o.coords = ends, o.group = group, o.faces = border ? faces : NULL;
    if (n) assert_int_equal(froe_scene_add(w->scene, &o, NULL), FROE_OK);
}

static void draw_corners(const drawing *w, int (*at)[2], uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) at[i][k] = (int)world_below(w->d, (uint32_t)w->grid);
}

static void draw_rectangle(const drawing *w, int (*at)[2]) {
    int c[2][2];
    draw_corners(w, c, 2);
    for (int i = 0; i < 4; i++) at[i][0] = c[i == 1 || i == 2][0], at[i][1] = c[i >= 2][1];
}

/* A frame around nearly all of the grid, with a small hole, and perhaps an island in it or another hole. */
static void draw_frame(const drawing *w, uint32_t group, int set) {
    const int last = w->grid - 1, low = (int)world_below(w->d, 2);
    const int frame[4][2] = {{low, 0}, {last, 0}, {last, last}, {low, last}};
    int at[4][2];
    add_segments(w, group, 100 + group, frame, 4, true, true, set);
    for (uint32_t holes = 1 + world_below(w->d, 2); holes > 0; holes--) {
        const int x = (int)world_below(w->d, (uint32_t)last), y = (int)world_below(w->d, (uint32_t)last);
        for (int i = 0; i < 4; i++) at[i][0] = x + (i == 1 || i == 2), at[i][1] = y + (i >= 2);
        add_segments(w, group, 100 + group, (const int(*)[2])at, 3 + world_below(w->d, 2), true, true, set);
    }
}

/* Rings that cross, repeat and nest; paths without area; points. Sets from `first` on. */
static void draw_groups(const drawing *w, uint32_t groups, int first) {
    for (uint32_t g = 0; g < groups; g++) {
        uint32_t group;
        int at[8][2];
        assert_int_equal(froe_scene_add_group(w->scene, &(froe_group){.name = "area"}, &group), FROE_OK);
        const uint32_t style = world_below(w->d, 9), rings = style < 6 ? 1 + world_below(w->d, 3) : 0;
        for (uint32_t r = 0; r < rings; r++) {
            const bool box = world_below(w->d, 2);
            const uint32_t count = box ? 4 : 3 + world_below(w->d, 3);
            box ? draw_rectangle(w, at) : draw_corners(w, at, count);
            add_segments(w, group, 100 + group, (const int(*)[2])at, count, true, true, first + (int)g);
        }
        if (style == 5 || style == 6) { /* beside rings, or alone: two pieces at odd ends */
            draw_corners(w, at, 3);
            if (memcmp(at[0], at[2], sizeof at[0]) == 0) at[2][0]++;
            add_segments(w, group, FROE_NONE, (const int(*)[2])at, 3, false, false, first + (int)g);
        }
        if (style == 8) draw_frame(w, group, first + (int)g);
        if (style == 7) {
            double x[2];
            froe_objects o = froe_objects_defaults();
            draw_corners(w, at, 1);
            map_point(w->m, at[0], x);
            put_edge(w->p, first + (int)g, at[0], at[0], false);
            o.kind = FROE_POINT, o.count = 1, o.coords = x, o.group = group;
            assert_int_equal(froe_scene_add(w->scene, &o, NULL), FROE_OK);
        }
    }
}

static froe_scene *new_scene(void) {
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    return scene;
}

/* ----------------------------------------------------------------- checking -- */

static void check_list(const char *what, const verdict *v, froe_relation relation, uint32_t groups, uint32_t question,
                       const uint32_t *ids, size_t count) {
    bool found[32] = {false};
    for (size_t i = 0; i < count; i++) {
        assert_true(ids[i] < groups && (!i || ids[i] > ids[i - 1]));
        found[ids[i]] = true;
    }
    for (uint32_t g = 0; g < groups; g++) {
        const bool want = is_related(v, relation, g, question);
        if (found[g] != want)
            fail_msg("%s: group %u %s question %u, said froe: %s", what, g, froe_relation_name(relation), question,
                     found[g] ? "yes" : "no");
        holding[relation] += want;
    }
    decisions += groups;
}

/* A convex range on the grid: its edges become set GROUPS. */
static bool draw_range(const drawing *w, double *points, froe_range *range) {
    int at[4][2];
    const bool upright = w->m->m[0][1] == 0;
    const uint32_t style = world_below(w->d, upright ? 4 : 3);
    const uint32_t count = style == 3 ? 4 : 1 + (uint32_t)style;
    *range = froe_range_defaults();
    if (style == 3) {
        draw_rectangle(w, at);
        double a[2], b[2];
        map_point(w->m, at[0], a), map_point(w->m, at[2], b);
        for (int k = 0; k < 2; k++) points[k] = fmin(a[k], b[k]), points[2 + k] = fmax(a[k], b[k]);
    } else {
        draw_corners(w, at, count);
        for (uint32_t i = 0; i < count; i++) map_point(w->m, at[i], points + 2 * i);
    }
    range->shape = style == 3   ? FROE_SHAPE_BOX
                   : style == 2 ? FROE_SHAPE_SIMPLEX
                   : style == 1 ? FROE_SHAPE_SEGMENT
                                : FROE_SHAPE_HULL;
    if (style == 2 && world_below(w->d, 2)) range->shape = FROE_SHAPE_HULL;
    range->points = points, range->count = count;
    for (uint32_t i = 0; i < count; i++) put_edge(w->p, GROUPS, at[i], at[(i + 1) % count], count > 2);
    return true;
}

static void check_ranges(uint64_t seed, const map *m, int grid, int questions) {
    world_dice d = {seed, 0};
    picture p = {.count = 0};
    verdict v;
    const drawing w = {new_scene(), &p, m, &d, grid};
    char what[80];
    draw_groups(&w, GROUPS, 0);
    world trees = world_begin("relations", w.scene);
    const size_t own = p.count;
    for (int i = 0; i < questions; i++) {
        double points[8];
        froe_range range;
        p.count = own;
        draw_range(&w, points, &range);
        judge(&p, &v);
        for (size_t t = 0; t < trees.tree_count; t++)
            for (froe_relation r = 0; r < FROE_RELATION_COUNT; r++) {
                froe_list got;
                froe_diagnostic why;
                snprintf(what, sizeof what, "seed %d, map %d, %s, %s %d", (int)seed, (int)(m - maps),
                         froe_tree_report(trees.trees[t]).method, froe_range_shape_name(range.shape), i);
                if (froe_query_groups_range(trees.queries[t], &range, r, &got, &why))
                    fail_msg("%s: %s", what, why.message);
                check_list(what, &v, r, GROUPS, GROUPS, got.ids, got.count);
            }
    }
    world_end(&trees);
}

static void check_join(uint64_t seed, const map *m, int grid) {
    world_dice d = {seed, 0};
    picture p = {.count = 0};
    verdict v;
    const drawing a = {new_scene(), &p, m, &d, grid}, b = {new_scene(), &p, m, &d, grid};
    char what[80];
    draw_groups(&a, GROUPS, 0);
    draw_groups(&b, GROUPS, GROUPS);
    judge(&p, &v);
    world trees = world_begin("groups", a.scene), questions = world_begin("questions", b.scene);
    for (size_t t = 0; t < trees.tree_count; t++)
        for (froe_relation r = 0; r < FROE_RELATION_COUNT; r++) {
            const size_t other = (t + seed) % questions.tree_count;
            froe_answers got;
            froe_diagnostic why;
            froe_batch_options o = froe_batch_defaults();
            o.threads = 1;
            snprintf(what, sizeof what, "join, seed %d, map %d, %s", (int)seed, (int)(m - maps),
                     froe_tree_report(trees.trees[t]).method);
            if (froe_batch_groups_join(trees.queries[t], questions.queries[other], r, &o, &got, &why))
                fail_msg("%s: %s", what, why.message);
            assert_int_equal(got.queries, GROUPS);
            for (uint32_t i = 0; i < GROUPS; i++)
                check_list(what, &v, r, GROUPS, GROUPS + i, got.ids + got.starts[i], got.starts[i + 1] - got.starts[i]);
            froe_answers_free(&got);
        }
    world_end(&trees), world_end(&questions);
}

/* -------------------------------------------------------------------- cases -- */

static void ranges_on_small_grids(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 18 / EXACT_SHARE; seed++)
        check_ranges(seed, maps + seed % MAPS, 3 + (int)(seed % 5), 12);
}

static void groups_of_two_trees(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 14 / EXACT_SHARE; seed++) check_join(seed, maps + seed % MAPS, 3 + (int)(seed % 5));
}

/* ------------------------------------------------------------ other ranges -- */

/* Twice the square of a point's distance from a segment is compared with that of a radius, in whole numbers. */
static bool is_near(const edge *e, const int *c, int radius) {
    const long d[2] = {e->v[0] - e->u[0], e->v[1] - e->u[1]}, to[2] = {c[0] - e->u[0], c[1] - e->u[1]};
    const long length = d[0] * d[0] + d[1] * d[1], along = to[0] * d[0] + to[1] * d[1];
    const long cross = d[0] * to[1] - d[1] * to[0], square = (long)radius * radius;
    const long back[2] = {c[0] - e->v[0], c[1] - e->v[1]};
    if (along <= 0) return to[0] * to[0] + to[1] * to[1] <= square;
    if (along >= length) return back[0] * back[0] + back[1] * back[1] <= square;
    return cross * cross <= square * length;
}

/* A disc meets a group whose segments come near its centre, or that has its centre, and has one whose corners do. */
static void discs_and_boxes_without_bounds(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 20 / EXACT_SHARE; seed++) {
        world_dice d = {seed, 0};
        picture p = {.count = 0};
        const drawing w = {new_scene(), &p, maps, &d, 6};
        draw_groups(&w, GROUPS, 0);
        world trees = world_begin("discs", w.scene);
        for (int i = 0; i < 20; i++) {
            int at[1][2];
            draw_corners(&w, at, 1);
            const int radius = (int)world_below(&d, 5), low = (int)world_below(&d, 6);
            const double x[4] = {at[0][0], at[0][1], at[0][0], at[0][1]},
                         half[4] = {low, -INFINITY, INFINITY, INFINITY};
            const uint32_t on = sets_at(&p, fraction_of(at[0][0], 1), fraction_of(at[0][1], 1));
            bool meets[GROUPS] = {0}, in[GROUPS], right[GROUPS], touched[GROUPS] = {0}, there[GROUPS] = {0};
            for (int g = 0; g < GROUPS; g++) in[g] = right[g] = true, meets[g] = on >> g & 1;
            for (size_t e = 0; e < p.count; e++) {
                const edge *s = p.edges + e, u = {{s->u[0], s->u[1]}, {s->u[0], s->u[1]}, 0, 0},
                           v = {{s->v[0], s->v[1]}, {s->v[0], s->v[1]}, 0, 0};
                there[s->set] = true;
                meets[s->set] |= is_near(s, at[0], radius);
                in[s->set] &= is_near(&u, at[0], radius) && is_near(&v, at[0], radius);
                right[s->set] &= s->u[0] >= low && s->v[0] >= low;
                touched[s->set] |= s->u[0] >= low || s->v[0] >= low;
            }
            for (size_t t = 0; t < trees.tree_count; t++)
                for (int kind = 0; kind < 5; kind++) { /* two relations of a disc, three of a half plane */
                    froe_range range = froe_range_defaults();
                    froe_list got;
                    range.shape = kind >= 2 ? FROE_SHAPE_BOX : i % 2 ? FROE_SHAPE_BALL : FROE_SHAPE_CAPSULE;
                    range.points = kind >= 2 ? half : x, range.radius = radius;
                    const froe_relation r = kind >= 2 ? kind - 2 : kind;
                    const bool *want = kind == 0 ? meets : kind == 1 ? in : kind == 2 ? touched : right;
                    bool found[GROUPS] = {0};
                    assert_int_equal(froe_query_groups_range(trees.queries[t], &range, r, &got, NULL), FROE_OK);
                    for (size_t n = 0; n < got.count; n++) found[got.ids[n]] = true;
                    for (int g = 0; g < GROUPS; g++)
                        if (found[g] != (kind < 4 && there[g] && want[g]))
                            fail_msg("seed %d, question %d, kind %d, group %d", (int)seed, i, kind, g);
                }
        }
        world_end(&trees);
    }
}

static void boxes_balls_and_hulls_of_groups(void **state) {
    (void)state;
    froe_scene *scene = new_scene();
    uint32_t house, disc;
    froe_diagnostic why;
    froe_list got;
    const double box[] = {0, 0, 4, 4}, centre[] = {10, 2}, radius = 2;
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "house"}, &house), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "disc"}, &disc), FROE_OK);
    froe_objects o = froe_objects_defaults();
    o.kind = FROE_BOX, o.count = 1, o.coords = box, o.group = house;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    o.kind = FROE_BALL, o.coords = centre, o.radii = &radius, o.group = disc;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    world w = world_begin("solids", scene);
    const struct {
        double window[4];
        froe_relation relation;
        size_t count;
    } cases[] = {{{1, 1, 2, 2}, FROE_MEETS, 1},   {{4, 4, 8, 8}, FROE_MEETS, 1},  {{5, 1, 7, 2}, FROE_MEETS, 0},
                 {{0, 0, 4, 4}, FROE_WITHIN, 1},  {{0, 0, 4, 3}, FROE_WITHIN, 0}, {{-1, 0, 12, 4}, FROE_WITHIN, 2},
                 {{-1, 0, 11, 4}, FROE_WITHIN, 1}};
    for (size_t t = 0; t < w.tree_count; t++) {
        froe_range range = froe_range_defaults();
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            range.points = cases[i].window;
            assert_int_equal(froe_query_groups_range(w.queries[t], &range, cases[i].relation, &got, NULL), FROE_OK);
            assert_int_equal(got.count, cases[i].count);
        }
        range.points = cases[0].window;
        assert_int_equal(froe_query_groups_range(w.queries[t], &range, FROE_COVERS, &got, &why), FROE_E_UNSUPPORTED);
        assert_string_equal(why.message, "group 0 (house): What it covers or lies in is told of segments and points "
                                         "only, and object 0 is neither.");
        assert_int_equal(why.object, 0);
        range.shape = FROE_SHAPE_BALL, range.points = centre, range.radius = 3;
        assert_int_equal(froe_query_groups_range(w.queries[t], &range, FROE_WITHIN, &got, &why), FROE_E_UNSUPPORTED);
        assert_string_equal(why.message,
                            "group 1 (disc): Whether it lies in a ball is not told, because object 1 is a ball.");
    }
    world_end(&w);
}

/* ---------------------------------------------------------------- refusals -- */

static world random_world(uint64_t seed, int grid) {
    static picture p;
    world_dice d = {seed, 0};
    const drawing w = {new_scene(), &p, maps, &d, grid};
    p.count = 0;
    draw_groups(&w, GROUPS, 0);
    return world_begin("random", w.scene);
}

static void bad_questions_are_refused(void **state) {
    (void)state;
    const double bad[] = {0, 0, 1, NAN, 2, 2, 1, 1}, good[] = {0, 0, 1, 1, 5, 5, 6, 6, 4, 4, 3, 3};
    froe_list got;
    froe_answers all;
    froe_diagnostic why;
    froe_range range = froe_range_defaults();
    world w = random_world(1, 4), space = world_begin("space", world_mixture(3, 2, 3, 0, 1, 1)),
          none = world_begin("none", world_mixture(2, 0, 0, 0, 1, 1));
    froe_query *q = w.queries[0];
    range.points = bad;
    assert_int_equal(froe_query_groups_range(q, &range, FROE_MEETS, &got, &why), FROE_E_INPUT);
    range.points = bad + 4;
    assert_int_equal(froe_query_groups_range(q, &range, FROE_COVERS, &got, &why), FROE_E_INPUT);
    range.points = good;
    assert_int_equal(froe_query_groups_range(q, &range, FROE_RELATION_COUNT, &got, &why), FROE_E_ARG);
    assert_string_equal(why.message, "There is no relation of number 3.");
    assert_int_equal(froe_query_groups_range(NULL, &range, FROE_MEETS, &got, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_groups_range(q, NULL, FROE_MEETS, &got, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_groups_range(q, &range, FROE_MEETS, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_query_groups_range(space.queries[0], &range, FROE_MEETS, &got, NULL), FROE_E_UNSUPPORTED);
    for (froe_relation r = 0; r < FROE_RELATION_COUNT; r++) {
        assert_int_equal(froe_query_groups_range(none.queries[0], &range, r, &got, NULL), FROE_OK);
        assert_int_equal(got.count, 0);
    }
    range.eps = 0.5;
    assert_int_equal(froe_query_groups_range(q, &range, FROE_MEETS, &got, &why), FROE_E_UNSUPPORTED);
    assert_string_equal(why.message, "Groups are related to exact ranges only, and eps is 0.5.");
    range.eps = 0, range.shape = FROE_SHAPE_RAY;
    assert_int_equal(froe_query_groups_range(q, &range, FROE_MEETS, &got, NULL), FROE_OK);
    assert_int_equal(froe_query_groups_range(q, &range, FROE_WITHIN, &got, &why), FROE_E_UNSUPPORTED);
    assert_string_equal(why.message, "The relation 'within' of groups is not told of a range of shape ray.");
    assert_int_equal(froe_batch_groups_boxes(q, good, 3, FROE_MEETS, NULL, &all, &why), FROE_E_INPUT);
    assert_int_equal(why.object, 2);
    assert_int_equal(froe_batch_groups_boxes(q, NULL, 3, FROE_MEETS, NULL, &all, NULL), FROE_E_ARG);
    assert_int_equal(froe_batch_groups_range(q, NULL, 1, FROE_MEETS, NULL, &all, NULL), FROE_E_ARG);
    assert_int_equal(froe_batch_groups_join(q, NULL, FROE_MEETS, NULL, &all, NULL), FROE_E_ARG);
    assert_int_equal(froe_batch_groups_join(q, space.queries[0], FROE_MEETS, NULL, &all, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_batch_groups_join(q, none.queries[0], FROE_WITHIN, NULL, &all, NULL), FROE_OK);
    assert_int_equal(all.queries, 0);
    froe_answers_free(&all);
    assert_null(froe_relation_name(FROE_RELATION_COUNT));
    world_end(&w), world_end(&space), world_end(&none);
}

/* -------------------------------------------------------------- other ways -- */

enum { MANY = 600 };

static void expect_same(const froe_answers *a, const froe_answers *b) {
    assert_int_equal(a->queries, b->queries);
    assert_memory_equal(a->starts, b->starts, (a->queries + 1) * sizeof *a->starts);
    if (a->starts[a->queries]) assert_memory_equal(a->ids, b->ids, a->starts[a->queries] * sizeof *a->ids);
}

/* Windows, four doubles each, large and small, some without area; and the same as groups of a scene. */
static froe_scene *draw_windows(double *boxes) {
    world_dice d = {5, 0};
    froe_scene *scene = new_scene();
    for (uint32_t i = 0; i < MANY; i++) {
        double *b = boxes + 4 * i, size = i % 3 == 0 ? 60 : 3;
        froe_objects o = froe_objects_defaults();
        for (int k = 0; k < 2; k++) {
            b[k] = floor((k ? 170 : 350) * (world_unit(&d) - 0.5));
            b[2 + k] = b[k] + (i % 5 ? 1 + floor(size * world_unit(&d)) : 0);
        }
        const double ends[] = {b[0], b[1], b[2], b[1], b[2], b[1], b[2], b[3],
                               b[2], b[3], b[0], b[3], b[0], b[3], b[0], b[1]};
        assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "window"}, &o.group), FROE_OK);
        o.kind = FROE_SEGMENT, o.count = 4, o.coords = ends;
        assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    }
    return scene;
}

static bool has_answer(const froe_answers *a, size_t query, uint32_t id) {
    bool found = false;
    for (size_t i = a->starts[query]; i < a->starts[query + 1]; i++) found |= a->ids[i] == id;
    return found;
}

/* Batches are the single answers, whatever the threads; windows as groups of another tree are windows. */
static froe_answers check_windows(froe_query *land, const froe_query *windows, const double *boxes, froe_relation r) {
    froe_answers one, many, join;
    froe_batch_options o = froe_batch_defaults();
    o.threads = 1;
    assert_int_equal(froe_batch_groups_boxes(land, boxes, MANY, r, &o, &one, NULL), FROE_OK);
    o.threads = 4;
    assert_int_equal(froe_batch_groups_boxes(land, boxes, MANY, r, &o, &many, NULL), FROE_OK);
    expect_same(&one, &many);
    assert_int_equal(froe_batch_groups_join(land, windows, r, &o, &join, NULL), FROE_OK);
    expect_same(&one, &join);
    assert_true(one.starts[MANY] > 20);
    for (uint32_t i = 0; i < MANY; i++) {
        froe_range range = froe_range_defaults();
        froe_list single;
        range.points = boxes + 4 * i;
        assert_int_equal(froe_query_groups_range(land, &range, r, &single, NULL), FROE_OK);
        assert_int_equal(single.count, one.starts[i + 1] - one.starts[i]);
        if (single.count) assert_memory_equal(single.ids, one.ids + one.starts[i], single.count * sizeof(uint32_t));
    }
    froe_answers_free(&many), froe_answers_free(&join);
    return one;
}

/* What lies in something is covered by it, and every country meets, covers and lies in itself. */
static void check_converse(froe_query *land, froe_query *windows, froe_relation r, const froe_answers *one) {
    const froe_relation other = r == FROE_MEETS ? r : r == FROE_WITHIN ? FROE_COVERS : FROE_WITHIN;
    froe_answers back, itself;
    assert_int_equal(froe_batch_groups_join(windows, land, other, NULL, &back, NULL), FROE_OK);
    assert_int_equal(froe_batch_groups_join(land, land, r, NULL, &itself, NULL), FROE_OK);
    assert_int_equal(back.starts[back.queries], one->starts[MANY]);
    for (uint32_t g = 0; g < back.queries; g++) {
        for (size_t n = back.starts[g]; n < back.starts[g + 1]; n++) assert_true(has_answer(one, back.ids[n], g));
        assert_true(has_answer(&itself, g, g));
    }
    froe_answers_free(&back), froe_answers_free(&itself);
}

static void countries_and_windows(void **state) {
    (void)state;
    static double boxes[4 * MANY];
    froe_scene *scenes[2] = {world_read("countries-110m.json"), draw_windows(boxes)};
    froe_build_options build = froe_build_defaults();
    froe_tree *trees[2];
    froe_query *q[2];
    build.purpose = "query";
    for (int i = 0; i < 2; i++) {
        assert_int_equal(froe_build(scenes[i], &build, &trees[i], NULL), FROE_OK);
        assert_int_equal(froe_query_new(trees[i], &q[i], NULL), FROE_OK);
    }
    for (froe_relation r = 0; r < FROE_RELATION_COUNT; r++) {
        froe_answers one = check_windows(q[0], q[1], boxes, r);
        check_converse(q[0], q[1], r, &one);
        froe_answers_free(&one);
    }
    for (int i = 0; i < 2; i++) froe_query_free(q[i]), froe_tree_free(trees[i]), froe_scene_free(scenes[i]);
}

static froe_status ask_without_memory(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    const double points[] = {0, 0, 3, 1, 1, 3};
    froe_query *q;
    froe_range range = froe_range_defaults();
    tree.alloc = *alloc;
    froe_status status = froe_query_new(&tree, &q, NULL);
    if (status) return status;
    range.shape = FROE_SHAPE_SIMPLEX, range.points = points;
    for (froe_relation r = 0; r < FROE_RELATION_COUNT && !status; r++) {
        froe_list got;
        froe_answers join;
        froe_batch_options o = froe_batch_defaults();
        o.threads = 1;
        status = froe_query_groups_range(q, &range, r, &got, NULL);
        if (!status) status = froe_batch_groups_join(q, q, r, &o, &join, NULL);
        if (!status) froe_answers_free(&join);
    }
    froe_query_free(q);
    return status;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    world w = random_world(3, 5);
    for (size_t t = 0; t < w.tree_count; t += SANITIZED_SHARE(3))
        assert_true(test_memory_each(ask_without_memory, w.trees[t]) > 20);
    world_end(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranges_on_small_grids),          cmocka_unit_test(groups_of_two_trees),
        cmocka_unit_test(discs_and_boxes_without_bounds), cmocka_unit_test(boxes_balls_and_hulls_of_groups),
        cmocka_unit_test(bad_questions_are_refused),      cmocka_unit_test(countries_and_windows),
        cmocka_unit_test(every_allocation_may_fail),
    };
    const int failed = cmocka_run_group_tests_name("query/relations", tests, NULL, NULL);
    print_message("%llu decisions; %llu meet, %llu lie within, %llu cover\n", (unsigned long long)decisions,
                  (unsigned long long)holding[0], (unsigned long long)holding[1], (unsigned long long)holding[2]);
    assert_true(failed || EXACT_SHARE > 1 || decisions > DECISIONS);
    return failed;
}
