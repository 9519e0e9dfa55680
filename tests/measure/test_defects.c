/* The defect report against rational arithmetic, straight from the definitions: what two
 * objects share is constructed, in exact fractions, and looked at. */
#include "support/memory.h"

#include "base/random.h"
#include "measure/sheet.h"
#include "measure/survey.h"
#include "scene/scene.h"
#include "support/rational.h"
#include <froe/measure.h>

enum { APART, CROSSING, T_JUNCTION, OVERLAP };

/* ----------------------------------------------------------- small algebra -- */

typedef struct vector {
    mpq_t x[3];
} vector;

/** Vectors for one pair; begin() takes them all back. */
static vector pool[4096];
static size_t taken, made;

static vector *fresh(void) {
    assert_true(taken < sizeof pool / sizeof *pool);
    for (int k = 0; made <= taken && k < 3; k++) mpq_init(pool[made].x[k]);
    if (made <= taken) made++;
    return &pool[taken++];
}

static vector *point(const double *x, int dim) {
    vector *v = fresh();
    for (int k = 0; k < 3; k++) mpq_set_d(v->x[k], k < dim ? x[k] : 0);
    return v;
}

static vector *minus(const vector *a, const vector *b) {
    vector *v = fresh();
    for (int k = 0; k < 3; k++) mpq_sub(v->x[k], a->x[k], b->x[k]);
    return v;
}

static vector *cross(vector *a, vector *b) {
    vector *v = fresh();
    rational_cross(v->x, a->x, b->x);
    return v;
}

static int dot_sign(vector *a, vector *b) {
    vector *v = fresh();
    rational_dot(v->x[0], a->x, b->x);
    return mpq_sgn(v->x[0]);
}

static bool is_zero(const vector *a) {
    return !mpq_sgn(a->x[0]) && !mpq_sgn(a->x[1]) && !mpq_sgn(a->x[2]);
}

/** a + (b - a) * s / (s - t): where a function that is s at a and t at b vanishes. */
static vector *vanish(vector *a, vector *b, mpq_t s, mpq_t t) {
    vector *d = minus(b, a), *v = fresh(), *f = fresh();
    mpq_sub(f->x[0], s, t);
    mpq_div(f->x[0], s, f->x[0]);
    for (int k = 0; k < 3; k++) {
        mpq_mul(v->x[k], d->x[k], f->x[0]);
        mpq_add(v->x[k], v->x[k], a->x[k]);
    }
    return v;
}

/** n . (x - o) */
static mpq_t *height(vector *n, vector *o, vector *x) {
    vector *v = fresh();
    rational_dot(v->x[0], n->x, minus(x, o)->x);
    return &v->x[0];
}

/* ----------------------------------------------------------------- oracles -- */

/** 2D: solve p + t (q - p) = r + u (s - r). */
static int segments_by_definition(const froe_scene *s, uint32_t a, uint32_t b) {
    vector *p = point(scene_point(s, a, 0), 2), *q = point(scene_point(s, a, 1), 2);
    vector *r = point(scene_point(s, b, 0), 2), *e = point(scene_point(s, b, 1), 2);
    vector *d = minus(q, p), *f = minus(e, r), *g = minus(r, p), *divisor = cross(d, f), *t = fresh();
    if (!is_zero(divisor)) {
        mpq_div(t->x[0], cross(g, f)->x[2], divisor->x[2]);
        mpq_div(t->x[1], cross(g, d)->x[2], divisor->x[2]);
        int inside[2], end[2];
        for (int i = 0; i < 2; i++) {
            inside[i] = mpq_sgn(t->x[i]) > 0 && mpq_cmp_ui(t->x[i], 1, 1) < 0;
            end[i] = mpq_sgn(t->x[i]) == 0 || mpq_cmp_ui(t->x[i], 1, 1) == 0;
        }
        if (inside[0] && inside[1]) return CROSSING;
        return (inside[0] && end[1]) || (end[0] && inside[1]) ? T_JUNCTION : APART;
    }
    if (!is_zero(cross(g, d))) return APART;
    rational_dot(t->x[2], d->x, d->x);
    rational_dot(t->x[0], g->x, d->x);
    rational_dot(t->x[1], minus(e, p)->x, d->x); /* b from x[0] to x[1] where a is from 0 to x[2] */
    if (mpq_cmp(t->x[0], t->x[1]) > 0) mpq_swap(t->x[0], t->x[1]);
    return mpq_sgn(t->x[1]) > 0 && mpq_cmp(t->x[0], t->x[2]) < 0 ? OVERLAP : APART;
}

typedef struct figure {
    vector *corners[32], *normal;
    int count;
} figure;

static figure figure_of(const froe_scene *s, uint32_t object) {
    figure f = {.count = (int)scene_corners(s, object)};
    for (int i = 0; i < f.count; i++) f.corners[i] = point(scene_point(s, object, (uint32_t)i), 3);
    f.normal = cross(minus(f.corners[1], f.corners[0]), minus(f.corners[2], f.corners[0]));
    return f;
}

/** Inward normal of edge i in the plane. */
static vector *inward(const figure *f, int i) {
    return cross(f->normal, minus(f->corners[(i + 1) % f->count], f->corners[i]));
}

static bool contains(const figure *f, vector *x) {
    if (dot_sign(f->normal, minus(x, f->corners[0])) != 0) return false;
    for (int i = 0; i < f->count; i++)
        if (dot_sign(inward(f, i), minus(x, f->corners[i])) < 0) return false;
    return true;
}

static bool junction(const figure *f, const figure *g) {
    for (int i = 0; i < g->count; i++) {
        bool common = false;
        for (int j = 0; j < f->count; j++) common = common || is_zero(minus(f->corners[j], g->corners[i]));
        if (!common && contains(f, g->corners[i])) return true;
    }
    return false;
}

/** The part of g (coplanar) inside f, by cutting along each edge of f (Sutherland, Hodgman): has it area? */
static bool share_area(const figure *f, figure g) {
    for (int e = 0; e < f->count; e++) {
        figure cut = {.count = 0};
        vector *n = inward(f, e), *o = f->corners[e];
        for (int i = 0; i < g.count; i++) {
            vector *a = g.corners[i], *b = g.corners[(i + 1) % g.count];
            mpq_t *s = height(n, o, a), *t = height(n, o, b);
            if (mpq_sgn(*s) >= 0) cut.corners[cut.count++] = a;
            if (mpq_sgn(*s) * mpq_sgn(*t) < 0) cut.corners[cut.count++] = vanish(a, b, *s, *t);
        }
        g = cut;
    }
    for (int i = 2; i < g.count; i++)
        if (!is_zero(cross(minus(g.corners[i - 1], g.corners[0]), minus(g.corners[i], g.corners[0])))) return true;
    return false;
}

/** The part of f on the plane of g, as heights along d. */
typedef struct interval {
    vector *lo, *hi;
    bool any, straddles; /**< has f corners strictly on both sides? */
} interval;

static interval interval_of(const figure *f, const figure *g, vector *d) {
    interval v = {.lo = fresh(), .hi = fresh()};
    bool front = false, behind = false;
    for (int i = 0; i < f->count; i++) {
        vector *a = f->corners[i], *b = f->corners[(i + 1) % f->count], *x = NULL, *h = fresh();
        mpq_t *s = height(g->normal, g->corners[0], a), *t = height(g->normal, g->corners[0], b);
        front |= mpq_sgn(*s) > 0;
        behind |= mpq_sgn(*s) < 0;
        if (mpq_sgn(*s) == 0) x = a;
        if (mpq_sgn(*s) * mpq_sgn(*t) < 0) x = vanish(a, b, *s, *t);
        if (!x) continue;
        rational_dot(h->x[0], d->x, x->x);
        if (!v.any || mpq_cmp(h->x[0], v.lo->x[0]) < 0) mpq_set(v.lo->x[0], h->x[0]);
        if (!v.any || mpq_cmp(h->x[0], v.hi->x[0]) > 0) mpq_set(v.hi->x[0], h->x[0]);
        v.any = true;
    }
    v.straddles = front && behind;
    return v;
}

/** The corner of f on the plane of g at this height along d; -1: there is none. */
static int corner_at(const figure *f, const figure *g, vector *d, mpq_t h) {
    for (int i = 0; i < f->count; i++) {
        vector *v = fresh();
        rational_dot(v->x[0], d->x, f->corners[i]->x);
        bool on = dot_sign(g->normal, minus(f->corners[i], g->corners[0])) == 0;
        if (on && mpq_equal(v->x[0], h)) return i;
    }
    return -1;
}

static bool common_corner(const figure *f, const figure *g, vector *d, mpq_t h) {
    return corner_at(f, g, d, h) >= 0 && corner_at(g, f, d, h) >= 0;
}

static int polygons_by_definition(const froe_scene *s, uint32_t a, uint32_t b) {
    figure f = figure_of(s, a), g = figure_of(s, b);
    vector *d = cross(f.normal, g.normal);
    bool coplanar = is_zero(d) && dot_sign(f.normal, minus(g.corners[0], f.corners[0])) == 0;
    if (is_zero(d) && !coplanar) return APART;
    if (coplanar && share_area(&f, g)) return OVERLAP;
    if (coplanar) return junction(&f, &g) || junction(&g, &f) ? T_JUNCTION : APART;
    interval v = interval_of(&f, &g, d), w = interval_of(&g, &f, d);
    if (!v.any || !w.any) return APART;
    mpq_t *lo = mpq_cmp(v.lo->x[0], w.lo->x[0]) > 0 ? &v.lo->x[0] : &w.lo->x[0];
    mpq_t *hi = mpq_cmp(v.hi->x[0], w.hi->x[0]) < 0 ? &v.hi->x[0] : &w.hi->x[0];
    if (v.straddles && w.straddles && mpq_cmp(*lo, *hi) < 0) return CROSSING;
    if (junction(&f, &g) || junction(&g, &f)) return T_JUNCTION;
    if (mpq_cmp(*lo, *hi) > 0) return APART;
    bool on_edges = mpq_equal(*lo, *hi) || (!v.straddles && !w.straddles);
    return on_edges && common_corner(&f, &g, d, *lo) && common_corner(&f, &g, d, *hi) ? APART : CROSSING;
}

/* ------------------------------------------------------------------ checks -- */

static bool full(const froe_scene *s, uint32_t object) {
    return scene_form(s, object) == (s->dim == 2 ? FROE_SEGMENT : FROE_POLYGON);
}

static froe_defects brute_force(const froe_scene *s) {
    froe_defects d = {.size = sizeof d,
                      .first_crossing = {FROE_NONE, FROE_NONE},
                      .first_t_junction = {FROE_NONE, FROE_NONE},
                      .first_overlap = {FROE_NONE, FROE_NONE}};
    uint64_t *counts[] = {NULL, &d.crossings, &d.t_junctions, &d.overlaps};
    uint32_t *firsts[] = {NULL, d.first_crossing, d.first_t_junction, d.first_overlap};
    bool *duplicate = calloc(s->object_count, sizeof *duplicate);
    assert_non_null(duplicate);
    for (uint32_t i = 0; i < s->object_count; i++) {
        for (uint32_t j = 0; j < i && !duplicate[i]; j++) duplicate[i] = scene_equal(s, i, j);
        d.duplicates += duplicate[i];
        d.zero_length += scene_kind(s, i) == FROE_SEGMENT && scene_form(s, i) == FROE_POINT;
        d.zero_area += scene_kind(s, i) == FROE_POLYGON && scene_form(s, i) != FROE_POLYGON;
    }
    for (uint32_t a = 0; a < s->object_count; a++)
        for (uint32_t b = a + 1; b < s->object_count; b++) {
            if (duplicate[a] || duplicate[b] || !full(s, a) || !full(s, b)) continue;
            taken = 0;
            int contact = s->dim == 2 ? segments_by_definition(s, a, b) : polygons_by_definition(s, a, b);
            if (contact == APART) continue;
            if (!(*counts[contact])++) firsts[contact][0] = a, firsts[contact][1] = b;
        }
    free(duplicate);
    return d;
}

static froe_defects report(const froe_scene *s, unsigned threads) {
    froe_defects d = {.size = sizeof d};
    assert_int_equal(froe_scene_defects(s, threads, NULL, NULL, &d, NULL), FROE_OK);
    return d;
}

static uint64_t totals[6];

static void check(froe_scene *s, unsigned threads) {
    froe_defects expected = brute_force(s), got = report(s, threads);
    assert_memory_equal(&expected, &got, sizeof got);
    totals[0] += got.crossings;
    totals[1] += got.t_junctions;
    totals[2] += got.overlaps;
    totals[3] += got.duplicates;
    totals[4] += got.zero_length + got.zero_area;
    totals[5]++;
    froe_scene_free(s);
}

static froe_scene *scene_with(int dim, froe_kind kind, size_t count, const double *coords, const size_t *starts) {
    froe_scene *s;
    froe_diagnostic diag;
    froe_objects b = froe_objects_defaults();
    b.kind = kind;
    b.count = count;
    b.coords = coords;
    b.starts = starts;
    assert_int_equal(froe_scene_new(dim, NULL, &s), FROE_OK);
    if (froe_scene_add(s, &b, &diag)) fail_msg("%s", diag.message);
    return s;
}

static void segments_of_lattices_at_every_scale(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p1000, 0x1p-1074, 0.1};
    memset(totals, 0, sizeof totals);
    for (uint32_t round = 0; round < 60; round++) {
        double xy[4 * 60];
        for (uint32_t i = 0; i < 240; i++)
            xy[i] = base_below(base_hash(11, round, i), 2 + round % 30) * scales[round % 4];
        check(scene_with(2, FROE_SEGMENT, 60, xy, NULL), 1 + round % 2);
    }
    for (int i = 0; i < 5; i++) assert_true(totals[i] > 50);
}

/** Triangles and parallelograms, some with corners in the middle of edges, on a small lattice. */
static froe_scene *lattice_polygons(uint64_t seed, uint32_t count, uint32_t range, double scale) {
    double xyz[3 * 8 * 40], *out = xyz;
    size_t starts[41] = {0};
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t j = i % 8 == 7 ? i - 7 : i; /* some twice */
        int64_t o[3], u[3], v[3];
        uint32_t flat = base_below(base_hash(seed, j, 99), 5); /* many lie in coordinate planes */
        for (uint32_t k = 0; k < 3; k++) {
            o[k] = base_below(base_hash(seed, j, k), range);
            u[k] = flat == k ? 0 : (int64_t)base_below(base_hash(seed, j, 10 + k), 5) - 2;
            v[k] = flat == k ? 0 : (int64_t)base_below(base_hash(seed, j, 20 + k), 5) - 2;
        }
        /* in twos: halves of edges stay on the lattice */
        const int shapes[3][6][2] = {{{0, 0}, {2, 0}, {0, 2}},
                                     {{0, 0}, {2, 0}, {2, 2}, {0, 2}},
                                     {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {0, 2}}};
        uint32_t shape = base_below(base_hash(seed, j, 30), 3);
        for (int c = 0; c < (int)(shape == 2 ? 6 : 3 + shape); c++)
            for (int k = 0; k < 3; k++)
                *out++ = (double)(2 * o[k] + shapes[shape][c][0] * u[k] + shapes[shape][c][1] * v[k]) * scale;
        starts[i + 1] = (size_t)(out - xyz) / 3;
    }
    return scene_with(3, FROE_POLYGON, count, xyz, starts);
}

static void polygons_of_lattices_at_every_scale(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p1000, 0x1p-1074};
    memset(totals, 0, sizeof totals);
    for (uint32_t round = 0; round < 30; round++)
        check(lattice_polygons(round, 40, 1 + round % 5, scales[round % 3]), 1 + round % 2);
    for (int i = 0; i < 5; i++) assert_true(totals[i] > 25);
}

static void polygons_in_general_position(void **state) {
    (void)state;
    memset(totals, 0, sizeof totals);
    for (uint32_t round = 0; round < 4; round++) {
        double xyz[9 * 60];
        for (uint32_t i = 0; i < 540; i++) xyz[i] = (double)base_hash(7, round, i) * 0x1p-64;
        check(scene_with(3, FROE_POLYGON, 60, xyz, NULL), 2);
    }
    assert_true(totals[0] > 400 && totals[1] + totals[2] + totals[3] == 0);
}

/** A fan of triangles around an axis, a wall on a floor, stacked walls: named cases. */
static void known_cases_in_space(void **state) {
    (void)state;
    const size_t quads[] = {0, 4, 8};
    const struct {
        double wall[12];
        uint64_t crossings, t_junctions, overlaps;
    } cases[] = {
        {{1, 1, -1, 2, 1, -1, 2, 1, 1, 1, 1, 1}, 1, 0, 0},     /* through the floor */
        {{1, 1, 0, 2, 1, 0, 2, 1, 1, 1, 1, 1}, 0, 1, 0},       /* stands on it */
        {{-1, 1, 0, 9, 1, 0, 9, 1, 1, -1, 1, 1}, 1, 0, 0},     /* stands across it, corners outside */
        {{0, 0, 0, 4, 0, 0, 4, 0, 4, 0, 0, 4}, 0, 0, 0},       /* stands on its edge */
        {{1, 0, 0, 3, 0, 0, 3, 0, 4, 1, 0, 4}, 0, 1, 0},       /* stands on part of its edge */
        {{1, -1, -1, 2, -1, -1, 2, -1, 1, 1, -1, 1}, 0, 0, 0}, /* beside it */
        {{1, 1, 0, 2, 1, 0, 2, 2, 0, 1, 2, 0}, 0, 0, 1},       /* lies in it */
        {{4, 0, 0, 8, 0, 0, 8, 4, 0, 4, 4, 0}, 0, 0, 0},       /* continues it */
        {{4, 1, 0, 8, 1, 0, 8, 3, 0, 4, 3, 0}, 0, 1, 0},       /* continues part of it */
        {{0, 0, -1, 4, 4, -1, 4, 4, 1, 0, 0, 1}, 1, 0, 0},     /* through its diagonal */
        {{0, 0, 0, 4, 4, 0, 4, 4, 1, 0, 0, 1}, 1, 0, 0},       /* stands on its diagonal */
        {{5, 1, -2, 7, 1, 0, 9, 1, 2, 7, 1, 4}, 0, 0, 0},      /* passes it */
        {{4, 1, -1, 8, 1, -1, 8, 1, 3, 4, 1, 3}, 1, 0, 0},     /* their edges cross in a point */
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double xyz[24] = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0};
        memcpy(xyz + 12, cases[i].wall, sizeof cases[i].wall);
        froe_scene *s = scene_with(3, FROE_POLYGON, 2, xyz, quads);
        froe_defects d = report(s, 1);
        assert_int_equal(d.crossings, cases[i].crossings);
        assert_int_equal(d.t_junctions, cases[i].t_junctions);
        assert_int_equal(d.overlaps, cases[i].overlaps);
        check(s, 1);
    }
}

/* All boxes of a cone meet, so its pairs have to be told apart quickly. */
static void triangles_of_a_cone_are_aside_at_first_sight(void **state) {
    (void)state;
    enum { N = 64 };
    double xyz[9 * N];
    measure_survey v;
    for (int i = 0; i < N; i++) {
        const int at[] = {i, (i + 1) % N};
        const double apex[] = {0, 0, 1};
        memcpy(xyz + 9 * i, apex, sizeof apex);
        for (int k = 0; k < 2; k++) { /* a rim on a parabola, and one that mirrors it */
            const double x = (double)(at[k] % (N / 2)) - N / 4.0, y = 1000 - x * x;
            const double rim[] = {at[k] < N / 2 ? x : -x, at[k] < N / 2 ? y : -y, 0};
            memcpy(xyz + 9 * i + 3 + 3 * k, rim, sizeof rim);
        }
    }
    froe_scene *s = scene_with(3, FROE_POLYGON, N, xyz, NULL);
    assert_int_equal(measure_survey_begin(s, 1, NULL, NULL, &v), FROE_OK);
    for (uint32_t a = 0; a < N; a++)
        for (uint32_t b = 0; b < N; b++) assert_int_equal(measure_survey_are_aside(&v, a, b), a != b);
    v.workers[0].context.first = NUM_EXACT;
    assert_false(measure_survey_are_aside(&v, 0, 1));
    measure_survey_end(&v);
    check(s, 1);
}

static void other_kinds_and_dimensions_count_duplicates_only(void **state) {
    (void)state;
    const double x[] = {0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1};
    froe_scene *s = scene_with(4, FROE_BOX, 2, x, NULL);
    froe_defects d = report(s, 1);
    assert_int_equal(d.duplicates, 1);
    assert_int_equal(d.crossings + d.t_junctions + d.overlaps, 0);
    assert_int_equal(d.first_overlap[0], FROE_NONE);
    froe_scene_free(s);
    s = scene_with(3, FROE_SEGMENT, 2, (const double[]){0, 0, 0, 2, 2, 0, 0, 2, 0, 2, 0, 0}, NULL);
    assert_int_equal(report(s, 1).crossings, 0);
    froe_scene_free(s);
}

static void an_empty_scene_has_no_defects(void **state) {
    (void)state;
    froe_scene *s;
    assert_int_equal(froe_scene_new(2, NULL, &s), FROE_OK);
    check(s, 4);
}

static void wrong_arguments_are_refused(void **state) {
    (void)state;
    froe_scene *s;
    froe_defects d = {.size = 0};
    assert_int_equal(froe_scene_new(2, NULL, &s), FROE_OK);
    assert_int_equal(froe_scene_defects(s, 1, NULL, NULL, &d, NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_scene_defects(s, 1, NULL, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_scene_defects(NULL, 1, NULL, NULL, &d, NULL), FROE_E_ARG);
    froe_scene_free(s);
}

/** A grid of unit edges with diagonals crossing in every tenth cell. */
static void many_segments_are_quick(void **state) {
    (void)state;
    enum { SIDE = 400 };
    double *xy = malloc(sizeof *xy * 4 * (2 * SIDE * SIDE + 2 * SIDE * SIDE / 10 + 2)), *out = xy;
    assert_non_null(xy);
    uint64_t crossings = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double x = i % SIDE, y = i / SIDE;
        const double cell[] = {x, y, x + 1, y, x, y, x, y + 1, x, y, x + 1, y + 1, x + 1, y, x, y + 1};
        size_t numbers = i % 10 ? 8 : 16;
        memcpy(out, cell, numbers * sizeof *cell);
        out += numbers;
        crossings += i % 10 == 0;
    }
    froe_scene *s = scene_with(2, FROE_SEGMENT, (size_t)(out - xy) / 4, xy, NULL);
    froe_defects d = report(s, 2);
    assert_int_equal(d.crossings, crossings);
    assert_int_equal(d.t_junctions + d.overlaps + d.duplicates, 0);
    assert_int_equal(d.first_crossing[0], 2);
    froe_scene_free(s);
    free(xy);
}

static bool stop_soon(void *user, double done) {
    assert_true(done >= 0 && done <= 1);
    return ++*(int *)user < 3;
}

static void far_too_many_pairs_can_be_cancelled(void **state) {
    (void)state;
    enum { N = 200000 };
    double *xy = malloc(sizeof *xy * 4 * N);
    assert_non_null(xy);
    for (int i = 0; i < N; i++) {
        const double diagonal[] = {-i, -i - 1, i + 1, i};
        memcpy(xy + 4 * i, diagonal, sizeof diagonal);
    }
    froe_scene *s = scene_with(2, FROE_SEGMENT, N, xy, NULL);
    froe_defects d = {.size = sizeof d, .crossings = 77};
    froe_diagnostic diag;
    int calls = 0;
    assert_int_equal(froe_scene_defects(s, 2, stop_soon, &calls, &d, &diag), FROE_E_CANCELLED);
    assert_int_equal(d.crossings, 77);
    assert_int_equal(diag.status, FROE_E_CANCELLED);
    froe_scene_free(s);
    free(xy);
}

static double few[4 * 20];

static froe_status examine(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_scene *s;
    froe_defects d = {.size = sizeof d};
    froe_objects b = froe_objects_defaults();
    b.kind = FROE_SEGMENT;
    b.count = 20;
    b.coords = few;
    froe_status status = froe_scene_new(2, alloc, &s);
    if (status) return status;
    status = froe_scene_add(s, &b, NULL);
    if (!status) status = froe_scene_defects(s, 2, NULL, NULL, &d, NULL);
    froe_scene_free(s);
    return status;
}

static void every_failing_allocation_is_survived(void **state) {
    (void)state;
    for (uint32_t i = 0; i < 80; i++) few[i] = base_below(base_hash(1, i, 0), 9);
    assert_true(test_memory_each(examine, NULL) > 15);
}

/* ------------------------------------------------------------------ sheets -- */

enum { SLIVERS = 198, FACE = 66 };

/** Long thin triangles side by side, askew, whose boxes all meet; three source polygons, the second beside the first
 * and the third on top of both. `odd` of 16 are something else: half as long, so that others have T-junctions with
 * them, moved, or anywhere. */
static froe_scene *slivers(uint64_t seed, uint32_t odd, double scale) {
    double xyz[9 * SLIVERS], *out = xyz;
    uint32_t faces[SLIVERS];
    for (uint32_t i = 0; i < SLIVERS; i++) {
        const uint32_t face = i / FACE, at = (i % FACE) / 2 + (face == 1 ? FACE / 2 : 0);
        const double lift = face == 2 ? 3 : 0, low = 4 * at, far = 1600;
        double ends[4][2] = {{low, -low}, {low + 4, -low - 4}, {low + far, far - low}, {low + 4 + far, far - low - 4}};
        const uint64_t hash = base_hash(seed, i, 0);
        const bool is_odd = base_below(hash, 16) < odd;
        const int sort = (int)(hash % 4), which[3] = {i % 2 ? 1 : 0, i % 2 ? 3 : 2, i % 2 ? 2 : 1};
        for (int c = 0; c < 3; c++) {
            double *x = ends[which[c]];
            if (is_odd && sort == 0 && which[c] >= 2) x[0] -= far / 2, x[1] -= far / 2;
            if (is_odd && sort == 1) x[0] += 2;
            for (uint64_t k = 0; k < 2 && is_odd && sort >= 2; k++)
                x[k] += base_below(base_hash(seed, i, (uint64_t)c * 2 + k + 1), 9) - 4.0;
            *out++ = x[0] * scale, *out++ = x[1] * scale,
            *out++ = (x[0] - 2 * x[1] + lift + (is_odd && sort == 3 ? 9 * c - 9 : 0)) * scale;
        }
        faces[i] = face;
    }
    froe_scene *s;
    froe_objects b = froe_objects_defaults();
    b.count = SLIVERS, b.coords = xyz, b.faces = faces;
    assert_int_equal(froe_scene_new(3, NULL, &s), FROE_OK);
    assert_int_equal(froe_scene_add(s, &b, NULL), FROE_OK);
    return s;
}

static void long_thin_triangles_are_counted_without_looking_at_all_pairs(void **state) {
    (void)state;
    const double scales[] = {1, 0x1p900, 0x1p-1060};
    memset(totals, 0, sizeof totals);
    for (uint32_t round = 0; round < 3; round++) check(slivers(round, 2 * round, scales[round % 3]), 1 + round % 2);
    for (int i = 0; i < 3; i++) assert_true(totals[i] > 5);
}

static void long_segments_are_counted_without_looking_at_all_pairs(void **state) {
    (void)state;
    memset(totals, 0, sizeof totals);
    for (uint32_t round = 0; round < 4; round++) {
        double xy[4 * SLIVERS];
        for (uint32_t i = 0; i < SLIVERS; i++) { /* zigzag; some end on others, some cross */
            const double low = 2 * i, far = 1600;
            double ends[2][2] = {{low, -low}, {low + far + 2 * (i % 2), far - low - 2 * (i % 2)}};
            const uint64_t hash = base_hash(round, i, 0);
            if (base_below(hash, 16) < round) ends[hash % 2][0] -= (double)(hash / 2 % 8);
            if (base_below(hash, 16) < round && hash / 32 % 2) ends[1][0] -= far / 2, ends[1][1] -= far / 2;
            memcpy(xy + 4 * i, ends, sizeof ends);
            if (i && base_below(hash, 64) < round) /* along part of the one before */
                for (int k = 0; k < 2; k++)
                    xy[4 * i + k] = (xy[4 * i - 4 + k] + xy[4 * i - 2 + k]) / 2, xy[4 * i + 2 + k] = xy[4 * i - 2 + k];
        }
        check(scene_with(2, FROE_SEGMENT, SLIVERS, xy, NULL), 1 + round % 2);
    }
    for (int i = 0; i < 3; i++) assert_true(totals[i] > 5);
}

/** How many objects are straight; checks that pairs of them touch as the sheet says, or not at all. */
static uint32_t check_sheet(const froe_scene *s, int axis) {
    uint32_t objects[64], count = 0, straight = 0;
    bool crooked[64], touches[64][64] = {{false}};
    for (uint32_t i = 0; i < s->object_count; i++) {
        bool candidate = full(s, i);
        for (uint32_t j = 0; j < i && candidate; j++) candidate = !scene_equal(s, i, j);
        if (candidate) objects[count++] = i;
    }
    num_context context;
    base_task task;
    base_task_init(&task, 1, NULL, NULL);
    assert_int_equal(num_context_new(&s->alloc, &context), FROE_OK);
    measure_sheet sheet = {.crooked = crooked};
    assert_int_equal(measure_sheet_sweep(&context, &task, s, axis, objects, count, &sheet), FROE_OK);
    for (size_t i = 0; i < sheet.touches.count; i++) {
        const measure_touch t = sheet.touches.data[i];
        touches[t.a][t.b] = touches[t.b][t.a] = true;
    }
    for (uint32_t i = 0; i < count; i++) {
        straight += !crooked[i];
        for (uint32_t j = 0; j < i; j++) {
            if (crooked[i] || crooked[j]) continue;
            taken = 0;
            const int contact = s->dim == 2 ? segments_by_definition(s, objects[j], objects[i])
                                            : polygons_by_definition(s, objects[j], objects[i]);
            assert_true(contact == APART || (contact == T_JUNCTION && touches[i][j]));
        }
    }
    array_free(&s->alloc, &sheet.touches);
    num_context_free(&context);
    return straight;
}

static void what_is_straight_in_a_sheet_touches_where_it_says(void **state) {
    (void)state;
    uint32_t straight = 0;
    for (uint32_t round = 0; round < 200; round++) {
        froe_scene *s = lattice_polygons(round, 40, 3 + round % 9, round % 2 ? 1 : 0x1p-1074);
        straight += check_sheet(s, (int)(round % 3));
        froe_scene_free(s);
        double xy[4 * 60];
        for (uint32_t i = 0; i < 240; i++) xy[i] = base_below(base_hash(3, round, i), 4 + round % 60);
        s = scene_with(2, FROE_SEGMENT, 60, xy, NULL);
        straight += check_sheet(s, -1);
        froe_scene_free(s);
    }
    assert_true(straight > 400);
}

/** Quads of a lattice, askew, each in two triangles: all of them straight, and T-junctions where one is in four. */
static void triangles_side_by_side_are_straight(void **state) {
    (void)state;
    double xyz[9 * 64], *out = xyz;
    for (int q = 0; q < 25; q++)
        for (int half = 0; half < 2; half++)
            for (int c = 0; c < 3; c++) {
                const int shape[6][2] = {{0, 0}, {2, 0}, {2, 2}, {0, 0}, {2, 2}, {0, 2}};
                const double x = 2 * (q % 5) + shape[3 * half + c][0], y = 2 * (q / 5) + shape[3 * half + c][1];
                *out++ = 3 * x - y, *out++ = x + 2 * y, *out++ = x * x;
            }
    froe_scene *s = scene_with(3, FROE_POLYGON, 50, xyz, NULL);
    assert_int_equal(check_sheet(s, 2), 50);
    froe_scene_free(s);
    out -= 9; /* the last in three: one side of it has a corner within */
    const double middle[3][3] = {{0, 0, 0}, {2, 2, 0}, {1, 1, 0}}, far[3] = {0, 2, 0};
    for (int t = 0; t < 2; t++) {
        const double *ring[3] = {middle[t ? 2 : 0], middle[t ? 1 : 2], far};
        for (int c = 0; c < 3; c++) {
            const double x = 8 + ring[c][0], y = 8 + ring[c][1];
            *out++ = 3 * x - y, *out++ = x + 2 * y, *out++ = ring[c] == middle[2] ? 82 : x * x;
        }
    }
    s = scene_with(3, FROE_POLYGON, 51, xyz, NULL);
    assert_int_equal(check_sheet(s, 2), 49); /* the halves of a side lie along it: they are looked at one by one */
    froe_scene_free(s);
}

/* `user`: bool, each triangle is a face of its own, so that there is no sheet. */
static froe_status examine_slivers(void *user, const froe_allocator *alloc) {
    froe_scene *from = slivers(3, 2, 1), *s;
    double xyz[9 * SLIVERS];
    uint32_t faces[SLIVERS];
    froe_defects d = {.size = sizeof d};
    froe_objects b = froe_objects_defaults();
    b.count = SLIVERS, b.coords = xyz, b.faces = faces;
    for (uint32_t i = 0; i < 3 * SLIVERS; i++) memcpy(xyz + 3 * i, scene_point(from, i / 3, i % 3), 3 * sizeof *xyz);
    for (uint32_t i = 0; i < SLIVERS; i++) faces[i] = *(bool *)user ? i : from->faces[i];
    froe_scene_free(from);
    froe_status status = froe_scene_new(3, alloc, &s);
    if (status) return status;
    status = froe_scene_add(s, &b, NULL);
    if (!status) status = froe_scene_defects(s, 1, NULL, NULL, &d, NULL);
    if (!status) status = froe_measure_near(s, 0x1p-48, 1, NULL, NULL, &(froe_near){.within = 0}, NULL);
    froe_scene_free(s);
    return status;
}

static void every_failing_allocation_of_a_sheet_is_survived(void **state) {
    (void)state;
    for (int alone = 0; alone < 2; alone++) assert_true(test_memory_each(examine_slivers, &(bool){alone}) > 40);
}

/** Teeth of a comb, askew; every box meets hundreds of others. It would take minutes to look at all of these. */
static void combs_end(void **state) {
    (void)state;
    enum { N = 200000 };
    double *xy = malloc(4 * N * sizeof *xy);
    for (uint32_t i = 0; i < N; i++) {
        const double low = 3 * i, far = i % 2 ? 400000 : 400001;
        xy[4 * i] = low, xy[4 * i + 1] = -low;
        xy[4 * i + 2] = low + far, xy[4 * i + 3] = far - low + (i == 7);
    }
    froe_scene *s = scene_with(2, FROE_SEGMENT, N, xy, NULL);
    const froe_defects d = report(s, 2);
    assert_int_equal(d.crossings + d.overlaps + d.t_junctions, 0);
    froe_scene_free(s);
    free(xy);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_of_lattices_at_every_scale),
        cmocka_unit_test(polygons_of_lattices_at_every_scale),
        cmocka_unit_test(polygons_in_general_position),
        cmocka_unit_test(known_cases_in_space),
        cmocka_unit_test(triangles_of_a_cone_are_aside_at_first_sight),
        cmocka_unit_test(other_kinds_and_dimensions_count_duplicates_only),
        cmocka_unit_test(an_empty_scene_has_no_defects),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test(many_segments_are_quick),
        cmocka_unit_test(far_too_many_pairs_can_be_cancelled),
        cmocka_unit_test(every_failing_allocation_is_survived),
        cmocka_unit_test(long_thin_triangles_are_counted_without_looking_at_all_pairs),
        cmocka_unit_test(long_segments_are_counted_without_looking_at_all_pairs),
        cmocka_unit_test(what_is_straight_in_a_sheet_touches_where_it_says),
        cmocka_unit_test(triangles_side_by_side_are_straight),
        cmocka_unit_test(combs_end),
        cmocka_unit_test(every_failing_allocation_of_a_sheet_is_survived),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    for (size_t i = 0; i < made; i++)
        for (int k = 0; k < 3; k++) mpq_clear(pool[i].x[k]);
    return failed;
}
