/* fuzz_space.c: bytes as what happens to a partition of moving triangles in space: they come, go, and get other plans.
 * Each moves within a layer of its own, so that none ever meet. After each change the partition passes its audit, and
 * after each while it is the one that is made of the triangles where they are. */
#include "kinetic/space.h"
#include "support.h"

enum { MOST_BYTES = 400, STEPS = 24, MOST = 12, KNOTS = 3, DEEP = 8, APART = 16 };

typedef struct space_program {
    fuzz_bytes bytes;
    froe_motion *motion;
    froe_kinetic *kinetic;
    bool gone[MOST];
} space_program;

typedef struct space_course {
    size_t count;
    double times[KNOTS], at[3 * KNOTS];
} space_course;

static int any(space_program *p, int most) {
    return fuzz_byte(&p->bytes) % (most + 1);
}

static void must(const char *what, froe_status status, const froe_diagnostic *why) {
    if (status) fuzz_complain(what, why);
}

/* From `begin` to the end of the window, within the layer of a triangle; vertex 0, 1 or 2 of it, in parts of the plane
 * that keep it from becoming a segment. */
static void draw(space_program *p, double begin, uint32_t layer, int vertex, space_course *c) {
    static const int corner[3][2] = {{0, 0}, {40, 3}, {7, 44}};
    c->count = 2 + (size_t)any(p, KNOTS - 2);
    for (size_t i = 0; i < c->count; i++) {
        c->times[i] = i + 1 == c->count ? SPACE_WINDOW : begin + (double)i * (SPACE_WINDOW - begin) / 4;
        for (int k = 0; k < 2; k++) c->at[3 * i + (size_t)k] = corner[vertex][k] + any(p, 15);
        c->at[3 * i + 2] = APART * (double)layer + any(p, DEEP);
    }
}

static void add(space_program *p, size_t count, double begin) {
    const uint32_t first = (uint32_t)froe_motion_object_count(p->motion);
    size_t starts[3 * MOST + 1] = {0};
    double times[3 * MOST * KNOTS], at[9 * MOST * KNOTS], births[MOST], deaths[MOST];
    for (size_t v = 0; v < 3 * count; v++) {
        space_course c;
        draw(p, begin, first + (uint32_t)(v / 3), (int)(v % 3), &c);
        memcpy(times + starts[v], c.times, c.count * sizeof *times);
        memcpy(at + 3 * starts[v], c.at, 3 * c.count * sizeof *at);
        starts[v + 1] = starts[v] + c.count;
    }
    for (size_t i = 0; i < count; i++) {
        births[i] = any(p, 3) ? begin : begin + any(p, 9);
        deaths[i] = any(p, 3) ? (double)INFINITY : births[i] + any(p, 20);
    }
    froe_moving b = froe_moving_defaults();
    froe_diagnostic why;
    b.vertex_count = 3 * count, b.count = count, b.starts = starts, b.times = times, b.coords = at;
    b.births = births, b.deaths = deaths;
    must("a triangle is refused", froe_motion_add(p->motion, &b, &why), &why);
}

static void replan(space_program *p, double now) {
    const uint32_t vertex = (uint32_t)any(p, (int)froe_motion_vertex_count(p->motion) - 1);
    space_course c;
    froe_diagnostic why;
    draw(p, now, vertex / 3, (int)(vertex % 3), &c);
    must("a plan is refused", froe_kinetic_replan(p->kinetic, vertex, c.count, c.times, c.at, NULL, NULL, &why), &why);
}

static void change(space_program *p) {
    const double now = froe_kinetic_time(p->kinetic);
    const int what = any(p, 9), count = (int)froe_motion_object_count(p->motion);
    froe_diagnostic why;
    if (what < 6) {
        replan(p, now);
    } else if (what < 8 && count < MOST) {
        add(p, 1, now);
        must("update", froe_kinetic_update(p->kinetic, &why), &why);
    } else {
        const int object = any(p, count - 1);
        p->gone[object] = true;
        must("remove", froe_kinetic_remove(p->kinetic, (uint32_t)object, &why), &why);
    }
}

static void check(space_program *p) {
    froe_diagnostic why = {.message = ""};
    must("audit", froe_kinetic_audit(p->kinetic, &why), &why);
    froe_kinetic_place place;
    const double at[3] = {any(p, 60), any(p, 60), any(p, APART * MOST)};
    must("locate", froe_kinetic_locate_in_space(p->kinetic, at, &place, &why), &why);
    const uint32_t told[3] = {place.on, place.above, place.below};
    for (int i = 0; i < 3; i++)
        if (told[i] != FROE_NONE && (told[i] >= froe_motion_object_count(p->motion) || p->gone[told[i]]))
            fuzz_complain("an object that is gone", &why);
}

/* A place along x, n / d, in units of UNIT. */
typedef struct space_place {
    __int128 n, d;
} space_place;

/* Whether both are one place; not where the products are too large, which chance makes no zeros of. */
static bool is_one_place(space_place a, space_place b) {
    __int128 left, right;
    return !__builtin_mul_overflow(a.n, b.d, &left) && !__builtin_mul_overflow(b.n, a.d, &right) && left == right;
}

/* Twice the area of a, b, c as seen from above. */
static __int128 area(const int64_t *a, const int64_t *b, const int64_t *c) {
    return (__int128)(b[0] - a[0]) * (c[1] - a[1]) - (__int128)(b[1] - a[1]) * (c[0] - a[0]);
}

/* Do two vertices or crossings lie at one x, or a vertex on an edge, as seen from above? The partition stands just
 * after the tick and the tree of the snapshot at it, so then they may differ although no coordinate was rounded. */
static bool something_coincides(const space_program *p) {
    enum { VERTICES = 3 * MOST, PLACES = VERTICES + VERTICES * VERTICES / 2 };
    static const double UNIT = 0x1p-24;
    static space_place places[PLACES];
    int64_t at[VERTICES][2];
    const double now = froe_kinetic_time(p->kinetic);
    size_t vertices = 0, count = 0;
    for (uint32_t o = 0; o < froe_motion_object_count(p->motion); o++) {
        const froe_moving_object object = froe_motion_object(p->motion, o);
        if (p->gone[o] || object.birth > now || object.death < now) continue;
        for (int i = 0; i < 3; i++, vertices++) {
            double place[3];
            froe_motion_position(p->motion, object.vertices[i], now, place);
            for (int k = 0; k < 2; k++) at[vertices][k] = (int64_t)(place[k] / UNIT);
            places[count++] = (space_place){at[vertices][0], 1};
        }
    }
    for (size_t i = 0; i < vertices; i++) /* the edge from i, and those of other triangles */
        for (size_t j = 0; j < vertices; j++) {
            if (i / 3 == j / 3) continue;
            const int64_t *a = at[i], *b = at[i / 3 * 3 + (i + 1) % 3], *c = at[j], *d = at[j / 3 * 3 + (j + 1) % 3];
            const __int128 from = area(a, b, c), to = area(a, b, d);
            if (from == 0) return true;
            if (i < j && (from < 0) != (to < 0) && (area(c, d, a) < 0) != (area(c, d, b) < 0))
                places[count++] = (space_place){from * d[0] - to * c[0], from - to};
        }
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < i; j++)
            if (is_one_place(places[i], places[j])) return true;
    return false;
}

static void step(space_program *p, space_counts *counts) {
    froe_diagnostic why;
    for (int changes = any(p, 2); changes; changes--) {
        change(p);
        check(p);
    }
    const double now = froe_kinetic_time(p->kinetic), next = froe_kinetic_next(p->kinetic);
    double to = any(p, 3) && next <= SPACE_WINDOW ? next : now + 0.25 * any(p, 20);
    if (to > SPACE_WINDOW) to = SPACE_WINDOW;
    if (to <= now) return;
    must("advance", froe_kinetic_advance(p->kinetic, to, NULL, NULL, &why), &why);
    check(p);
    if (!space_is_alike(p->kinetic, counts, &why) && !something_coincides(p)) fuzz_complain("another tree", &why);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    space_program p = {.bytes = {data, size < MOST_BYTES ? size : MOST_BYTES}};
    froe_motion_options w = froe_motion_defaults();
    froe_kinetic_options o = froe_kinetic_defaults();
    space_counts counts = {.blurs = true}; /* of any times, so that what coincides lies between doubles */
    froe_diagnostic why;
    w.dim = 3, w.begin = 0, w.end = SPACE_WINDOW, w.tick = any(&p, 1) ? 0x1p-16 : 0x1p-4;
    o.seed = fuzz_byte(&p.bytes);
    if (froe_motion_new(&w, NULL, &p.motion, NULL)) abort();
    add(&p, 1 + (size_t)any(&p, 4), 0);
    must("a partition", froe_kinetic_new(p.motion, &o, NULL, &p.kinetic, &why), &why);
    for (int i = 0; i < STEPS && p.bytes.size; i++) step(&p, &counts);
    froe_kinetic_free(p.kinetic);
    froe_motion_free(p.motion);
    return 0;
}
