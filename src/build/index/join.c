/* join.c: steps, then parts, then their places. */
#include "build/index/join.h"

bool join_cut(tree_join *j, int axis, double value) {
    return array_push(&j->job->alloc, &j->steps, (join_step){axis, value});
}

bool join_subtree(tree_join *j, const join_room *room) {
    const join_part part = {.step = j->steps.count, .room = *room};
    return array_push(&j->job->alloc, &j->parts, part) && array_push(&j->job->alloc, &j->steps, (join_step){-1, 0});
}

void join_clear(tree_join *j) {
    j->steps.count = j->parts.count = 0;
}

/* Cuts the nodes before a step, which is a subtree; the node that it has. */
static froe_status walk_to(tree_join *j, size_t step, uint32_t *node) {
    const froe_allocator *alloc = &j->job->alloc;
    if (!j->next && !array_push(alloc, &j->open, 0)) return FROE_E_MEMORY;
    for (; j->next <= step; j->next++) {
        const join_step *s = j->steps.data + j->next;
        *node = j->open.data[--j->open.count];
        if (s->axis < 0) continue;
        uint32_t child;
        froe_status status = packer_split(&j->tree, *node, s->axis, s->value, &child);
        if (status) return status;
        if (!array_push(alloc, &j->open, child + 1) || !array_push(alloc, &j->open, child)) return FROE_E_MEMORY;
    }
    return FROE_OK;
}

static froe_status build_directly(void *user, unsigned worker, size_t part) {
    tree_join *j = user;
    uint32_t node = 0;
    froe_status status = walk_to(j, j->parts.data[part].step, &node);
    return status ? status : j->fn(j->user, worker, part, &j->tree, node);
}

/* Room for all parts, or for a share of it. What is not touched of a large array costs nothing. */
static froe_status new_packer(const tree_join *j, double share, tree_packer *out) {
    join_room all = {.nodes = j->steps.count};
    for (size_t i = 0; i < j->parts.count; i++) {
        const join_room *room = &j->parts.data[i].room;
        all.nodes += room->nodes, all.blocks += room->blocks, all.owners += room->owners;
    }
    return packer_new(&j->job->alloc, (uint64_t)(share * (double)all.nodes), (uint64_t)(share * (double)all.blocks),
                      (uint64_t)(share * (double)all.owners), out);
}

static froe_status build_apart(void *user, unsigned worker, size_t part) {
    tree_join *j = user;
    join_part *p = j->parts.data + part;
    tree_packer *packer = &j->workers[worker].packer;
    p->worker = worker;
    froe_status status = packer->memory ? FROE_OK : new_packer(j, 1.25 / j->worker_count, packer);
    if (!status) status = packer_begin(packer, &p->subtree);
    if (!status) status = j->fn(j->user, worker, part, packer, p->subtree.at.first);
    packer_end(packer, &p->subtree);
    return status;
}

static froe_status copy_part(void *user, unsigned worker, size_t part) {
    const tree_join *j = user;
    const join_part *p = j->parts.data + part;
    (void)worker;
    packer_put(&j->tree, &p->place, &j->workers[p->worker].packer, &p->subtree);
    return FROE_OK;
}

/* Takes exactly the room that all parts need, and gives each its place. */
static froe_status place_parts(tree_join *j) {
    const uint64_t most = j->job->max_fragments;
    uint64_t nodes = j->steps.count, blocks = 0, owners = 0;
    for (size_t i = 0; i < j->parts.count; i++) {
        const packer_subtree *part = &j->parts.data[i].subtree;
        nodes += part->nodes + 1, blocks += part->blocks, owners += part->owners;
    }
    froe_status status = packer_new(&j->job->alloc, nodes, blocks, owners, &j->tree);
    for (size_t i = 0; i < j->parts.count && !status; i++) {
        join_part *p = j->parts.data + i;
        uint32_t node = 0;
        status = walk_to(j, p->step, &node);
        if (!status) status = packer_place_for(&j->tree, node, &p->subtree, &p->place);
        if (!status && most && j->tree.piece_count > most) status = FROE_E_BUDGET;
    }
    return status;
}

static void free_workers(tree_join *j) {
    for (unsigned i = 0; j->workers && i < j->worker_count; i++) packer_free(&j->workers[i].packer);
    support_free(&j->job->alloc, j->workers, j->worker_count * sizeof *j->workers);
}

froe_status join_run(tree_join *j, double span) {
    base_task *task = j->job->task;
    if (task->threads == 1 || j->parts.count == 1) {
        froe_status status = new_packer(j, 1, &j->tree);
        return status ? status : base_run(task, span, j->parts.count, build_directly, j);
    }
    j->worker_count = base_workers(task, j->parts.count);
    j->workers = support_calloc(&j->job->alloc, j->worker_count, sizeof *j->workers);
    froe_status status = j->workers ? base_run(task, 0.9 * span, j->parts.count, build_apart, j) : FROE_E_MEMORY;
    if (!status) status = place_parts(j);
    if (!status) status = base_run(task, 0.1 * span, j->parts.count, copy_part, j);
    free_workers(j);
    return status;
}

void join_free(tree_join *j) {
    array_free(&j->job->alloc, &j->steps);
    array_free(&j->job->alloc, &j->parts);
    array_free(&j->job->alloc, &j->open);
    packer_free(&j->tree);
}
