/* compare.c: do two programs give the same answers? Lists must have the same objects. Numbers may differ by what
 * rounding explains. */
#include "bench.h"
#include "peers/segment.h"
#include "race.h"
#include <math.h>
#include <stdlib.h>

/* A sum over the objects of a list: the order does not matter. */
static double sum_of(const uint32_t *ids, size_t count) {
    double sum = (double)count;
    for (size_t i = 0; i < count; i++) sum += (double)(ids[i] * 2654435761u >> 12);
    return sum;
}

/* Of an approximate answer: the sum over what lies within the radius, or -1 if something lies beyond the margin. */
static double sum_within(const race_scene *scene, const double *x, const uint32_t *ids, size_t count) {
    const size_t dim = (size_t)scene->data.dim;
    const double radius = x[dim], most = (radius + x[dim + 1]) * (1 + 1e-12);
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        double square = 0;
        for (size_t k = 0; k < dim; k++) square += pow(scene->coords[ids[i] * dim + k] - x[k], 2);
        if (square > most * most) return -1;
        if (square <= radius * radius) sum += (double)(ids[i] * 2654435761u >> 12);
    }
    return sum;
}

/* Segments that lie on each other are equally far above a point: heights are compared, not names. */
static double height(const race_scene *scene, double x, double id) {
    const peer_segment *s = (const peer_segment *)scene->coords + (size_t)fmax(id, 0);
    return id < 0 ? -1 : s->bx > s->ax ? s->ay + (s->by - s->ay) * ((x - s->ax) / (s->bx - s->ax)) : fmin(s->ay, s->by);
}

void race_digest(const race_scene *scene, const peer_questions *q, const peer_answers *found, double *out) {
    const bool list = q->work == PEER_WINDOW || q->work == PEER_BALL;
    for (size_t i = 0, first = 0; i < q->count; i++) {
        const double *x = q->numbers + i * q->width;
        if (list || q->work == PEER_FUZZY) {
            const uint32_t *ids = (found->given ? found->given : found->ids) + first;
            const size_t count = found->ends[i] - first;
            out[i] = list ? sum_of(ids, count) : sum_within(scene, x, ids, count);
            first = found->ends[i];
        } else {
            for (size_t j = i * q->k; j < (i + 1) * q->k; j++)
                out[j] = q->work == PEER_ABOVE ? height(scene, x[0], found->values[j]) : found->values[j];
        }
    }
}

static int by_name(const void *a, const void *b) {
    const double *s = a, *t = b;
    return s[0] != t[0] ? (s[0] > t[0]) - (s[0] < t[0]) : (s[1] > t[1]) - (s[1] < t[1]);
}

/* Is one area always the same in the other's names? What lies on a border, -1, is left out. */
static size_t renamed(const double *froe, const double *its, size_t count) {
    double(*both)[2] = bench_take(count, sizeof *both);
    size_t wrong = 0;
    for (size_t i = 0; i < count; i++) both[i][0] = its[i], both[i][1] = froe[i];
    qsort(both, count, sizeof *both, by_name);
    for (size_t i = 1; i < count; i++)
        wrong += both[i][0] >= 0 && both[i][1] >= 0 && both[i][0] == both[i - 1][0] && both[i][1] != both[i - 1][1];
    free(both);
    return wrong;
}

size_t race_differ(const race_scene *scene, const race_task *task, const peer *other, const double *froe,
                   const double *its, size_t count) {
    const bool exact = task->work == PEER_WINDOW || task->work == PEER_BALL || task->work == PEER_FUZZY ||
                       task->work == PEER_PAIRS || task->work == PEER_AREA || task->work == PEER_ANY_HIT;
    const double most = exact ? 0 : (other->tolerance > 0 ? other->tolerance : 1e-9) * scene->size;
    size_t wrong = 0;
    if (task->work == PEER_AREA && other->own_names) return renamed(froe, its, count);
    for (size_t i = 0; i < count; i++) /* an area below -1: several, where areas overlap */
        wrong += froe[i] != its[i] && !(fabs(froe[i] - its[i]) <= most) && !(task->work == PEER_AREA && froe[i] < -1);
    return wrong;
}
