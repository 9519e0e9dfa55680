/* context.c: making, sharing and freeing query contexts and their parts. */
#include "query/context.h"
#include "base/floats.h"
#include "geom/selftest.h"
#include "query/packed/packed.h"
#include "query/packed/space.h"
#include "support/fail.h"

static froe_status take_context(const froe_tree *tree, const tree_ready *ready, query_shared *shared,
                                froe_query **out) {
    froe_query *q = support_calloc(&tree->alloc, 1, sizeof *q);
    if (!q) return FROE_E_MEMORY;
    q->tree = tree;
    q->alloc = tree->alloc;
    if (geom_context_new(&tree->alloc, &q->numbers)) {
        support_free(&tree->alloc, q, sizeof *q);
        return FROE_E_MEMORY;
    }
    q->shared = shared;
    q->ready = ready;
    froe_status status = tree_is_space(tree)    ? space_work_new(tree, &q->space)
                         : tree_is_packed(tree) ? packed_work_new(tree, &q->packed)
                                                : FROE_OK;
    if (status) {
        num_context_free(&q->numbers);
        support_free(&tree->alloc, q, sizeof *q);
        return FROE_E_MEMORY;
    }
    query_marks_clear(&q->marks);
    *out = q;
    return FROE_OK;
}

froe_status froe_query_new(const froe_tree *tree, froe_query **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!tree || !out) return support_fail_null(diag, __func__);
    const tree_ready *ready;
    const froe_status status = tree_make_ready(tree, &ready, diag);
    if (status) return status;
    query_shared *shared = support_calloc(&tree->alloc, 1, sizeof *shared);
    if (!shared) return support_fail_memory(diag);
    if (take_context(ready ? &ready->tree : tree, ready, shared, out)) {
        support_free(&tree->alloc, shared, sizeof *shared);
        return support_fail_memory(diag);
    }
    atomic_init(&shared->holds, 1);
    return FROE_OK;
}

froe_status froe_query_fork(const froe_query *query, froe_query **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!query || !out) return support_fail_null(diag, __func__);
    if (take_context(query->tree, query->ready, query->shared, out)) return support_fail_memory(diag);
    (*out)->numbers.first = query->numbers.first;
    if (query->packed) (*out)->packed->kernels = query->packed->kernels;
    if (query->space) (*out)->space->kernels = query->space->kernels;
    atomic_fetch_add(&query->shared->holds, 1);
    return FROE_OK;
}

void froe_query_free(froe_query *query) {
    BASE_FLOATS_OWN;
    if (!query) return;
    froe_allocator alloc = query->alloc;
    query_shared *shared = query->shared;
    if (atomic_fetch_sub(&shared->holds, 1) == 1) { /* the last context that shares the parts */
        for (int i = 0; i < QUERY_PARTS; i++) {
            query_part *part = atomic_load(&shared->parts[i]);
            if (part) part->free(&alloc, part);
        }
        support_free(&alloc, shared, sizeof *shared);
    }
    num_context_free(&query->numbers);
    query_marks_free(&query->marks, &alloc);
    query_ray_free(&query->ray, &alloc);
    query_near_free(&query->near, &alloc);
    query_range_free(&query->range, &alloc);
    packed_work_free(query->packed, &alloc);
    array_free(&alloc, &query->groups.inside);
    array_free(&alloc, &query->groups.touched);
    query_groups_work_free(&query->work, &alloc);
    space_work_free(query->space, &alloc);
    array_free(&alloc, &query->found);
    support_free(&alloc, query, sizeof *query);
}

froe_query_stats froe_query_statistics(froe_query *query) {
    froe_query_stats stats = query->stats;
    query->stats = (froe_query_stats){0};
    return stats;
}

froe_status query_prepare(froe_query *query, query_part_id id, query_make_fn *make, const query_part **out,
                          froe_diagnostic *diag) {
    query_part *part = atomic_load_explicit(&query->shared->parts[id], memory_order_acquire), *there = NULL;
    if (!part) { /* it reads all of the tree */
        froe_status status = tree_settle(query->tree, diag);
        if (!status) status = make(query, &part, diag);
        if (status) {
            if (part) part->free(&query->alloc, part);
            return status;
        }
        if (!atomic_compare_exchange_strong(&query->shared->parts[id], &there, part)) {
            part->free(&query->alloc, part);
            part = there;
        }
    }
    *out = part;
    return FROE_OK;
}

/* ------------------------------------------------------------- opened trees -- */

bool query_check_leaf(froe_query *q, uint32_t block) {
    if (tree_check_leaf(q->ready, &q->numbers, block, NULL) == FROE_OK) return true;
    q->bad.found = true;
    q->bad.owners = false;
    q->bad.block = block;
    return false;
}

bool query_owners_are_good(froe_query *q, uint32_t block, uint32_t end) {
    if (tree_check_owners(q->ready, block, end, NULL) == FROE_OK) return true;
    q->bad.found = q->bad.owners = true;
    q->bad.block = block;
    q->bad.end = end;
    return false;
}

froe_status query_failed(froe_query *q, froe_diagnostic *diag) {
    if (!q->bad.found) return support_fail_memory(diag);
    q->bad.found = false;
    return q->bad.owners ? tree_check_owners(q->ready, q->bad.block, q->bad.end, diag)
                         : tree_check_leaf(q->ready, &q->numbers, q->bad.block, diag);
}
