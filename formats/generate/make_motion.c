/* make_motion.c: made-up motions: segments, polygons and boxes that move during a minute. */
#include "formats/generate/maker.h"
#include "support/floats.h"
#include <math.h>
#include <string.h>

enum { SECONDS = 60, KNOTS = 5, MOST_CORNERS = 6 };

typedef struct motion_maker {
    formats_maker random; /* no sink is opened */
    froe_motion *motion;
    size_t made;
    double side; /* the length of a segment: about that of the square it has for itself */
} motion_maker;

/* A chain of corners, closed from three on, at the same instants each. */
typedef struct flight_chain {
    size_t corners, knots;
    double times[KNOTS], xy[MOST_CORNERS][KNOTS][2], controls[MOST_CORNERS][KNOTS][2];
    double seconds[MOST_CORNERS][KNOTS][2];
} flight_chain;

static flight_chain chain_of(size_t corners, size_t knots) {
    flight_chain b = {.corners = corners, .knots = knots};
    for (size_t k = 0; k < knots; k++) b.times[k] = SECONDS * (double)k / (double)(knots - 1);
    for (size_t c = 0; c < corners; c++)
        for (size_t k = 0; k < knots; k++)
            for (int i = 0; i < 2; i++) b.controls[c][k][i] = b.seconds[c][k][i] = NAN;
    return b;
}

static void add_chain(motion_maker *m, const flight_chain *b) {
    size_t starts[MOST_CORNERS + 1] = {0};
    double times[MOST_CORNERS * KNOTS], xy[2 * MOST_CORNERS * KNOTS], controls[2 * MOST_CORNERS * KNOTS];
    double seconds[2 * MOST_CORNERS * KNOTS];
    uint32_t ends[2 * MOST_CORNERS];
    for (size_t c = 0; c < b->corners; c++) {
        starts[c + 1] = starts[c] + b->knots;
        memcpy(times + starts[c], b->times, b->knots * sizeof *times);
        memcpy(xy + 2 * starts[c], b->xy[c], 2 * b->knots * sizeof *xy);
        memcpy(controls + 2 * starts[c], b->controls[c], 2 * b->knots * sizeof *controls);
        memcpy(seconds + 2 * starts[c], b->seconds[c], 2 * b->knots * sizeof *seconds);
        ends[2 * c] = (uint32_t)c;
        ends[2 * c + 1] = (uint32_t)((c + 1) % b->corners);
    }
    froe_moving batch = froe_moving_defaults();
    batch.vertex_count = b->corners;
    batch.starts = starts;
    batch.times = times;
    batch.coords = xy;
    batch.controls = controls;
    batch.second_controls = seconds;
    batch.count = b->corners > 2 ? b->corners : 1;
    batch.vertices = ends;
    m->random.status = froe_motion_add_group(m->motion, &(froe_group){.name = ""}, &batch.group);
    if (!m->random.status) m->random.status = froe_motion_add(m->motion, &batch, m->random.sink.diag);
    m->made += batch.count;
}

static bool more(const motion_maker *m) {
    return !m->random.status && m->made < m->random.n;
}

static void place_in_square(motion_maker *m, double to[2]) {
    formats_place(&m->random, 2, to);
}

/* ----------------------------------------------------------------------- kinds -- */

/* Both ends go straight from place to place, near one another. */
static void make_linear(motion_maker *m) {
    while (more(m)) {
        flight_chain b = chain_of(2, KNOTS);
        for (size_t k = 0; k < KNOTS; k++) {
            double d[2];
            place_in_square(m, b.xy[0][k]);
            formats_direction(&m->random, 2, d);
            for (int i = 0; i < 2; i++) b.xy[1][k][i] = b.xy[0][k][i] + m->side * d[i];
        }
        add_chain(m, &b);
    }
}

/* The same on parabolas. */
static void make_quadratic(motion_maker *m) {
    while (more(m)) {
        flight_chain b = chain_of(2, 3);
        for (size_t k = 0; k < b.knots; k++) {
            double d[2];
            place_in_square(m, b.xy[0][k]);
            place_in_square(m, b.controls[0][k]);
            formats_direction(&m->random, 2, d);
            for (int i = 0; i < 2; i++) {
                b.xy[1][k][i] = b.xy[0][k][i] + m->side * d[i];
                b.controls[1][k][i] = b.controls[0][k][i] + m->side * d[i];
            }
        }
        add_chain(m, &b);
    }
}

/* On cubics with one velocity where they meet: each control point before a place is as far behind it as the one after
 * is ahead. */
static void make_cubic(motion_maker *m) {
    while (more(m)) {
        flight_chain b = chain_of(2, KNOTS);
        for (size_t k = 0; k < KNOTS; k++) {
            double d[2], way[2];
            place_in_square(m, b.xy[0][k]);
            formats_direction(&m->random, 2, d);
            for (int i = 0; i < 2; i++) b.xy[1][k][i] = b.xy[0][k][i] + m->side * d[i];
            for (size_t c = 0; c < 2; c++) {
                formats_direction(&m->random, 2, way);
                for (int i = 0; i < 2; i++) {
                    const double ahead = (c ? m->side : 0.25) * way[i] + (c ? b.controls[0][k][i] - b.xy[0][k][i] : 0);
                    if (k) b.seconds[c][k - 1][i] = b.xy[c][k][i] - ahead;
                    b.controls[c][k][i] = b.xy[c][k][i] + ahead;
                }
            }
        }
        add_chain(m, &b);
    }
}

/* Whole coordinates at whole times: much happens at once, and exactly. */
static void make_lattice(motion_maker *m) {
    uint32_t width = (uint32_t)formats_root(m->random.n, 2) + 2;
    while (more(m)) {
        flight_chain b = chain_of(2, KNOTS);
        for (size_t k = 0; k < KNOTS; k++) {
            for (int i = 0; i < 2; i++) b.xy[0][k][i] = formats_below(&m->random, width);
            for (int i = 0; i < 2; i++) b.xy[1][k][i] = b.xy[0][k][i] + formats_below(&m->random, 5) - 2.0;
        }
        add_chain(m, &b);
    }
}

/* A field of segments in one common translation, half of them against it. */
static void make_rigid(motion_maker *m) {
    while (more(m)) {
        flight_chain b = chain_of(2, 2);
        double p[2], d[2], way[2] = {0.25, 0.125}, sign = m->made % 2 ? 1 : -1;
        place_in_square(m, p);
        formats_direction(&m->random, 2, d);
        for (size_t k = 0; k < 2; k++)
            for (int i = 0; i < 2; i++) {
                b.xy[0][k][i] = p[i] + (double)k * sign * way[i];
                b.xy[1][k][i] = b.xy[0][k][i] + m->side * d[i];
            }
        add_chain(m, &b);
    }
}

/* Segments that turn around their middles by quarters of a turn, each on a parabola, and drift. */
static void make_spin(motion_maker *m) {
    while (more(m)) {
        flight_chain b = chain_of(2, KNOTS);
        double p[2], d[2], drift[2];
        place_in_square(m, p);
        formats_direction(&m->random, 2, d);
        formats_direction(&m->random, 2, drift);
        for (size_t k = 0; k < KNOTS; k++) {
            double next[2] = {-d[1], d[0]};
            for (int i = 0; i < 2; i++) {
                double now = p[i] + 0.05 * drift[i] * (double)k, then = now + 0.025 * drift[i];
                for (size_t c = 0; c < 2; c++) {
                    double arm = (c ? -0.5 : 0.5) * m->side;
                    b.xy[c][k][i] = now + arm * d[i];
                    b.controls[c][k][i] = then + arm * (d[i] + next[i]);
                }
            }
            memcpy(d, next, sizeof d);
        }
        add_chain(m, &b);
    }
}

/* Polygons of three to six corners that go straight and change their shape a little. */
static void make_polygons(motion_maker *m) {
    while (more(m)) {
        flight_chain b = chain_of(3 + formats_below(&m->random, MOST_CORNERS - 2), KNOTS);
        for (size_t k = 0; k < KNOTS; k++) {
            double p[2], corner[2];
            place_in_square(m, p);
            for (size_t c = 0; c < b.corners; c++) {
                double radius = m->side * formats_between(&m->random, 0.4, 0.8);
                formats_circle(c, b.corners, corner);
                for (int i = 0; i < 2; i++) b.xy[c][k][i] = p[i] + radius * corner[i];
            }
        }
        add_chain(m, &b);
    }
}

/* A cube of twelve triangles that a body carries. */
static void add_cube(motion_maker *m, uint32_t body, double half) {
    enum { CORNERS = 8, TRIANGLES = 12 };
    static const uint32_t sides[3 * TRIANGLES] = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                                                  2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    static const double times[CORNERS];
    size_t starts[CORNERS + 1] = {0};
    double at[3 * CORNERS];
    uint32_t bodies[CORNERS];
    for (size_t c = 0; c < CORNERS; c++) {
        starts[c + 1] = c + 1;
        bodies[c] = body;
        for (size_t k = 0; k < 3; k++) at[3 * c + k] = c >> k & 1 ? half : -half;
    }
    froe_moving batch = froe_moving_defaults();
    batch.vertex_count = CORNERS, batch.count = TRIANGLES, batch.starts = starts, batch.times = times;
    batch.coords = at, batch.bodies = bodies, batch.vertices = sides;
    if (!m->random.status) m->random.status = froe_motion_add_group(m->motion, &(froe_group){.name = ""}, &batch.group);
    if (!m->random.status) m->random.status = froe_motion_add(m->motion, &batch, m->random.sink.diag);
    m->made += TRIANGLES;
}

/* Cubes that are thrown from place to place, each on parabolas, and tumble. */
static void make_boxes(motion_maker *m) {
    const double size = 1 / formats_cube_root((double)m->random.n / 12 + 1);
    while (more(m)) {
        double times[KNOTS], at[3 * KNOTS], controls[3 * KNOTS], turns[4 * KNOTS], square = 0;
        for (size_t k = 0; k < KNOTS; k++, square = 0) {
            times[k] = SECONDS * (double)k / (KNOTS - 1);
            formats_place(&m->random, 3, at + 3 * k);
            for (size_t i = 0; i < 3 && k; i++)
                controls[3 * k - 3 + i] = 0.5 * (at[3 * k - 3 + i] + at[3 * k + i]) + (i == 2 ? 0.5 : 0);
            for (size_t i = 0; i < 4; i++) { /* no two are as much as half a turn apart */
                turns[4 * k + i] = formats_between(&m->random, -0.5, 0.5) + (k ? turns[4 * k - 4 + i] : i == 3);
                square += turns[4 * k + i] * turns[4 * k + i];
            }
            for (size_t i = 0; i < 4; i++) turns[4 * k + i] /= sqrt(square);
        }
        froe_body body = froe_body_defaults();
        uint32_t id = 0;
        body.count = KNOTS, body.times = times, body.coords = at, body.controls = controls, body.turns = turns;
        m->random.status = froe_motion_add_body(m->motion, &body, &id, m->random.sink.diag);
        add_cube(m, id, 0.2 * size);
    }
}

typedef struct generator {
    froe_motion_generator_info info;
    void (*make)(motion_maker *m);
} generator;

static const generator generators[] = {
    {{"moving", 2, "short segments in the unit square, straight from place to place", false}, make_linear},
    {{"moving-quadratic", 2, "the same on parabolas", false}, make_quadratic},
    {{"moving-cubic", 2, "the same on cubics that go on smoothly", false}, make_cubic},
    {{"moving-lattice", 2, "whole coordinates at whole times: much happens at once", false}, make_lattice},
    {{"moving-rigid", 2, "two fields of segments that pass through one another", false}, make_rigid},
    {{"moving-spin", 2, "segments that turn and drift, on parabolas", false}, make_spin},
    {{"moving-polygons", 2, "polygons that go straight and change their shape", true}, make_polygons},
    {{"moving-boxes", 3, "boxes in space that are thrown and tumble", true}, make_boxes},
};
enum { GENERATORS = sizeof generators / sizeof *generators };

const froe_motion_generator_info *froe_motion_generator_at(size_t i) {
    return i < GENERATORS ? &generators[i].info : NULL;
}

froe_status froe_generate_motion(const char *kind, size_t n, uint64_t seed, const froe_allocator *alloc,
                                 froe_motion **out, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!kind || !out) return support_fail_null(diag, __func__);
    size_t i = 0;
    while (i < GENERATORS && strcmp(generators[i].info.name, kind) != 0) i++;
    if (i == GENERATORS) return support_fail(diag, FROE_E_OPTIONS, "There is no kind of motion '%.60s'.", kind);
    if (!n) return support_fail(diag, FROE_E_ARG, "A motion of 0 objects cannot be generated.");
    if (n >= (1u << 31) - 2) return support_fail(diag, FROE_E_LIMIT, "There are more than 2^31 - 3 objects.");
    motion_maker m = {.random = {.sink = {.diag = diag}, .n = n, .seed = seed}, .side = 0.5 / sqrt((double)n)};
    froe_motion_options w = froe_motion_defaults();
    w.dim = (unsigned)generators[i].info.dim;
    w.begin = 0;
    w.end = SECONDS;
    froe_status status = froe_motion_new(&w, alloc, &m.motion, diag);
    if (status) return status;
    generators[i].make(&m);
    if (m.random.status) {
        froe_motion_free(m.motion);
        return m.random.status == FROE_E_MEMORY ? support_fail_memory(diag) : m.random.status;
    }
    *out = m.motion;
    return FROE_OK;
}
