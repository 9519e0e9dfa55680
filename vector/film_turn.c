/* film_turn.c: see film_turn.h. */
#include "film_turn.h"
#include "support/alloc.h"
#include "support/fail.h"
#include <math.h>
#include <string.h>

enum { EACH = 8, LEAST = 72 };

size_t film_turn_places(uint32_t frames) {
    const size_t parts = (LEAST + (size_t)frames - 1) / frames;
    return frames * parts;
}

static double time_of(const film_turn *t, size_t i) {
    const double share = (double)i / (double)t->count;
    return i < t->count ? t->begin * (1 - share) + t->end * share : t->end;
}

froe_status film_turn_begin(film_turn *t, const froe_camera *first, const froe_projection *view, size_t places,
                            double begin, double end, const froe_allocator *alloc, froe_diagnostic *diag) {
    *t = (film_turn){.alloc = *alloc, .first = *first, .begin = begin, .end = end, .count = places};
    if (view->up_axis >= 0)
        return support_fail(diag, FROE_E_OPTIONS, "An exact film does not go around its own line of view.");
    t->numbers = support_calloc(alloc, EACH * (places + 1), sizeof *t->numbers);
    if (!t->numbers) return support_fail_memory(diag);
    double *times = t->numbers, *centres = times + places + 1, *turns = centres + 3 * (places + 1);
    for (size_t i = 0; i <= places; i++) {
        times[i] = time_of(t, i);
        memcpy(centres + 3 * i, first->target, sizeof first->target);
    }
    t->body = froe_body_defaults();
    t->body.count = places + 1, t->body.times = times, t->body.coords = centres, t->body.turns = turns;
    for (int k = 0; k < 3; k++) t->at[k] = view->eye.at[k] - (view->eye.parallel ? 0 : first->target[k]);
    for (int k = 0; k < 12; k++) t->window[k] = view->window[k] - first->target[k % 3];
    return froe_camera_turns(first, places, turns, diag);
}

void film_turn_end(film_turn *t) {
    if (t->numbers) support_free(&t->alloc, t->numbers, EACH * (t->count + 1) * sizeof *t->numbers);
}

froe_camera film_turn_at(const film_turn *t, double time) {
    const double *times = t->body.times;
    froe_camera camera = t->first;
    size_t low = 0, high = t->count; /* times[low] <= time < times[high], or the last piece */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (times[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    const double u = (time - times[low]) / (times[high] - times[low]), *p = t->body.turns + 4 * low, *q = p + 4;
    double turn[4], way[3], across[3], square = 0, product = 0;
    for (int i = 0; i < 4; i++) product += p[i] * q[i];
    for (int i = 0; i < 4; i++) {
        turn[i] = (1 - u) * p[i] + u * (product < 0 ? -q[i] : q[i]);
        square += turn[i] * turn[i];
    }
    for (int k = 0; k < 3; k++) way[k] = t->first.eye[k] - t->first.target[k];
    for (int k = 0; k < 3; k++) { /* v + 2 (w v + n x v) ... = v + 2 n x (n x v + w v), by the length squared */
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        across[k] = turn[i] * way[j] - turn[j] * way[i] + turn[3] * way[k];
    }
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        camera.eye[k] += 2 * (turn[i] * across[j] - turn[j] * across[i]) / square;
    }
    return camera;
}
