/* ranks.c: the order of objects within one plane, and the places of all pieces. */
#include "view/visibility/order.h"
#include "view/visibility/visibility.h"

/* Patches in the order of priority, then of their numbers: the place of each. */
froe_status view_rank_objects(const froe_allocator *alloc, const froe_surface *s, const int32_t *priorities,
                              uint32_t **out) {
    const size_t n = s->patch_count, objects = s->scene->object_count;
    base_pair *pairs = support_calloc(alloc, 2 * n + 1, sizeof *pairs);
    uint32_t *ranks = *out = support_calloc(alloc, objects + 1, sizeof *ranks);
    const bool ok = pairs && ranks;
    for (uint32_t p = 0; ok && p < n; p++)
        pairs[p] = (base_pair){(uint64_t)((priorities ? (int64_t)priorities[p] : 0) - INT32_MIN), p};
    if (ok) base_radix_sort(pairs, pairs + n, n);
    for (uint32_t i = 0; ok && i < n; i++) {
        const uint32_t p = pairs[i].value;
        for (uint32_t m = s->patch_starts[p]; m < s->patch_starts[p + 1]; m++) ranks[s->members[m]] = i;
    }
    support_free(alloc, pairs, (2 * n + 1) * sizeof *pairs);
    return ok ? FROE_OK : FROE_E_MEMORY;
}

froe_status view_find_places(const froe_visibility *v, const int32_t *priorities, uint32_t *places) {
    view_order order;
    uint32_t piece, place = 0, *ranks = NULL;
    froe_status status = view_rank_objects(&v->alloc, v->surface, priorities, &ranks);
    if (!status) {
        status = view_order_begin(&order, v->tree, &v->sights.eye, true, ranks);
        order.section = v->section;
        while (!status && view_order_next(&order, &piece)) places[piece] = place++;
        status = view_order_end(&order) ? FROE_E_MEMORY : status;
    }
    support_free(&v->alloc, ranks, ((size_t)v->surface->scene->object_count + 1) * sizeof *ranks);
    return status;
}
