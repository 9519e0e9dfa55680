/* ask.c: questions for a scene. Places are anywhere in its bounds, or near corners of its objects; windows and balls
 * have the one size at which they find as many objects as wanted, on average over a sample. */
#include "bench.h"
#include "race.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HALVINGS = 40 };

static size_t dim_of(const race_scene *scene) {
    return (size_t)scene->data.dim;
}

static void place(const race_scene *scene, uint64_t *state, double *x) {
    const size_t dim = dim_of(scene), corners = scene->data.count * race_corners(scene->data.kind);
    const double *corner = scene->coords + dim * (bench_draw(state) % corners);
    const double spacing = scene->size / pow((double)scene->data.count, 1 / (double)dim);
    for (size_t k = 0; k < dim; k++)
        x[k] = scene->near ? corner[k] + (bench_unit(state) - 0.5) * spacing
                           : scene->lo[k] + bench_unit(state) * (scene->hi[k] - scene->lo[k]);
}

/* A window around a place, in whole numbers where the scene's are, or a ball. */
static void resize(const race_task *t, const race_scene *scene, const double *centre, double reach, double *out) {
    const size_t dim = dim_of(scene);
    const bool whole = scene->data.kind == PEER_SEGMENTS;
    for (size_t k = 0; k < dim; k++) {
        out[k] = t->work == PEER_WINDOW ? centre[k] - reach : centre[k];
        if (t->work == PEER_WINDOW) out[dim + k] = centre[k] + reach;
        if (whole) out[k] = floor(out[k]), out[dim + k] = floor(out[dim + k]);
    }
    if (t->work != PEER_WINDOW) out[dim] = reach, out[dim + 1] = reach * t->eps;
}

static double found_on_average(const race_task *t, const race_contestant *first, const double *numbers, size_t count,
                               peer_answers *room) {
    const peer_questions q = {.work = t->work == PEER_FUZZY ? PEER_BALL : t->work,
                              .count = count,
                              .width = t->width,
                              .numbers = numbers,
                              .k = 1};
    room->used = 0;
    first->peer->answer(first->index, &q, room);
    peer_let_go(room);
    return (double)room->used / (double)count;
}

static void make_ranges(race_task *t, const race_scene *scene, const race_contestant *first, peer_answers *room,
                        uint64_t *state) {
    const size_t dim = dim_of(scene), count = t->share * 2 * RACE_ROUNDS,
                 sample = count < RACE_SAMPLE ? count : RACE_SAMPLE;
    const double wanted = fmin(t->wanted, 0.1 * (double)scene->data.count);
    double *centres = bench_take(count * dim, sizeof *centres), low = 0, high = scene->size;
    for (size_t i = 0; i < count; i++) place(scene, state, centres + i * dim);
    for (int step = 0; step < HALVINGS; step++) {
        const double reach = step < HALVINGS / 2 && low == 0 ? high / 4 : 0.5 * (low + high);
        for (size_t i = 0; i < sample; i++) resize(t, scene, centres + i * dim, reach, t->numbers + i * t->width);
        *(found_on_average(t, first, t->numbers, sample, room) > wanted ? &high : &low) = reach;
    }
    for (size_t i = 0; i < count; i++) resize(t, scene, centres + i * dim, high, t->numbers + i * t->width);
    free(centres);
}

/* x at half-integers: never in line with a corner, so that libraries which compute in doubles have it easy, too. */
static void below_segments(const race_scene *scene, uint64_t *state, double *x) {
    place(scene, state, x);
    for (int k = 0; k < 2; k++) x[k] = floor(fmin(fmax(x[k], scene->lo[k]), scene->hi[k] - 1)) + 0.5;
}

/* Rays begin anywhere, and the nearest segments and triangles are asked for anywhere. */
static void anywhere(const race_scene *scene, uint64_t *state, double *x) {
    for (size_t k = 0; k < dim_of(scene); k++) x[k] = scene->lo[k] + bench_unit(state) * (scene->hi[k] - scene->lo[k]);
}

void race_ask(race_task *t, const race_scene *scene, const race_contestant *first, peer_answers *room) {
    const bool range = t->work == PEER_WINDOW || t->work == PEER_BALL || t->work == PEER_FUZZY;
    const bool rays = t->work == PEER_FIRST_HIT || t->work == PEER_ANY_HIT;
    const size_t dim = dim_of(scene), count = t->share * 2 * RACE_ROUNDS;
    uint64_t state =
        bench_state((uint64_t)(2 + t->work) << 40 | (uint64_t)t->wanted); /* other questions in each task */
    t->width = t->work == PEER_WINDOW ? 2 * dim : range ? dim + 2 : dim;
    t->numbers = bench_take(count * t->width, sizeof *t->numbers);
    if (rays) t->directions = bench_take(count * t->width, sizeof *t->directions);
    if (range) make_ranges(t, scene, first, room, &state);
    for (size_t i = 0; i < count && !range; i++) {
        double *x = t->numbers + i * t->width;
        if (t->work == PEER_ABOVE)
            below_segments(scene, &state, x);
        else if (scene->data.kind == PEER_POINTS)
            place(scene, &state, x);
        else
            anywhere(scene, &state, x);
        if (rays) race_direction(&state, t->directions + i * t->width);
    }
}
