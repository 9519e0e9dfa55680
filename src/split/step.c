/* step.c: what a method says of a cell is done: it becomes a leaf, or is cut. */
#include "split/step.h"
#include "split/charge/thin.h"
#include <string.h>

static froe_status failure_of(split_verdict verdict) {
    switch (verdict) {
    case SPLIT_REFUSE:
        return FROE_E_INPUT;
    case SPLIT_GIVE_UP:
        return FROE_E_BUDGET;
    case SPLIT_CANCELLED:
        return FROE_E_CANCELLED;
    default:
        return FROE_E_MEMORY;
    }
}

static uint8_t leaf_flags(split_verdict verdict) {
    return verdict == SPLIT_INSEPARABLE ? TREE_INSEPARABLE : verdict == SPLIT_CROWDED ? TREE_CROWDED : 0;
}

bool step_fit_rooms(const split_method *method, split_work *work) {
    const size_t bytes = method->room * (work->cells.count + 1), more = bytes - work->rooms.count;
    if (bytes > work->rooms.count && !array_reserve(&work->set.alloc, &work->rooms, more)) return false;
    work->rooms.count = bytes;
    return true;
}

froe_status step_empty_rooms(const split_method *method, split_work *work, size_t first) {
    if (!method->room || work->cells.count == first) return FROE_OK;
    if (!step_fit_rooms(method, work)) return FROE_E_MEMORY;
    memset(work->rooms.data + method->room * (first + 1), 0, method->room * (work->cells.count - first));
    return FROE_OK;
}

froe_status step_divide(const split_method *method, split_work *work, const split_cell *cell, const froe_cut *cut,
                        uint8_t flags, cell_limits *limits) {
    froe_status status = cell_cut(work, cell, cut, flags, limits);
    if (status || !method->divided || (limits && !limits->kept)) return status;
    if (!step_fit_rooms(method, work)) return FROE_E_MEMORY;
    unsigned char *negative = work->rooms.data + method->room * work->cells.count, *positive = negative - method->room;
    memcpy(positive, work->rooms.data, method->room);
    memcpy(negative, work->rooms.data, method->room);
    method->divided(method->config, work, cell, cut, flags & TREE_GUARD, positive, negative);
    return FROE_OK;
}

static split_verdict choose_cut(const split_method *method, split_work *work, const split_cell *cell, froe_cut *cut) {
    const split_choice *chosen = work->chosen;
    work->chosen = NULL; /* if that separates nothing, the method is asked again */
    if (!chosen) return method->choose(method->config, work, cell, cut);
    *cut = chosen->cut;
    return chosen->verdict;
}

froe_status split_step(const split_method *method, split_work *work, split_cell *cell) {
    froe_cut cut = {.kind = FROE_CUT_NONE};
    froe_status status = FROE_OK;
    while (!status) {
        bool peeled = method->peels_first && cover_peel(&work->set, cell, &cut);
        split_verdict verdict = peeled ? SPLIT_CUT_ANYWAY : choose_cut(method, work, cell, &cut);
        if (verdict > SPLIT_CUT_GUARD) return failure_of(verdict);
        if (verdict < SPLIT_CUT && verdict != SPLIT_LEAF && !method->shaped && !method->peels_first)
            peeled = cover_peel(&work->set, cell, &cut);
        if (peeled) verdict = SPLIT_CUT_ANYWAY, cell->peels++;
        if (verdict < SPLIT_CUT) return cell_leaf(work, cell, leaf_flags(verdict));
        const uint8_t guard = verdict == SPLIT_CUT_GUARD ? TREE_GUARD : 0;
        if (verdict > SPLIT_CUT) return step_divide(method, work, cell, &cut, guard, NULL);
        cell_limits limits = {.thin = &method->thin};
        const uint8_t charged = thin_charges(&method->thin, cell) ? TREE_CHARGED : 0;
        status = step_divide(method, work, cell, &cut, charged, &limits);
        if (status || limits.kept) return status;
        if (limits.useless) {
            cell->attempt++;
            continue;
        }
        bool begun = false;
        status = thin_begin(&method->thin, work, cell, &begun);
        if (begun) return status;
        cell->growth = 0; /* cluttered: charged no more, and asked again */
    }
    return status;
}
