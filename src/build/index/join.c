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

static froe_status build_apart(void *user, unsigned worker, size_t part) {
    tree_join *j = user;
    join_part *p = j->parts.data + part;
    froe_status status = packer_new(&j->job->alloc, p->room.nodes, p->room.blocks, p->room.owners, &p->packer);
    return status ? status : j->fn(j->user, worker, part, &p->packer, 0);
}

static froe_status copy_part(void *user, unsigned worker, size_t part) {
    tree_join *j = user;
    join_part *p = j->parts.data + part;
    (void)worker;
    packer_put(&j->tree, &p->packer, &p->place);
    packer_free(&p->packer);
    return FROE_OK;
}

/* Takes exactly the room that all parts need, and gives each its place. */
static froe_status place_parts(tree_join *j) {
    const uint64_t most = j->job->max_fragments;
    uint64_t nodes = j->steps.count, blocks = 0, owners = 0;
    for (size_t i = 0; i < j->parts.count; i++) {
        const tree_packer *part = &j->parts.data[i].packer;
        nodes += part->nodes.count, blocks += part->block_count, owners += part->owners.count;
    }
    froe_status status = packer_new(&j->job->alloc, nodes, blocks, owners, &j->tree);
    for (size_t i = 0; i < j->parts.count && !status; i++) {
        join_part *p = j->parts.data + i;
        uint32_t node = 0;
        status = walk_to(j, p->step, &node);
        if (!status) status = packer_place_for(&j->tree, node, &p->packer, &p->place);
        if (!status && most && j->tree.piece_count > most) status = FROE_E_BUDGET;
    }
    return status;
}

froe_status join_run(tree_join *j, double span) {
    base_task *task = j->job->task;
    if (task->threads == 1 || j->parts.count == 1) {
        join_room all = {.nodes = j->steps.count};
        for (size_t i = 0; i < j->parts.count; i++) {
            const join_room *room = &j->parts.data[i].room;
            all.nodes += room->nodes, all.blocks += room->blocks, all.owners += room->owners;
        }
        froe_status status = packer_new(&j->job->alloc, all.nodes, all.blocks, all.owners, &j->tree);
        return status ? status : base_run(task, span, j->parts.count, build_directly, j);
    }
    froe_status status = base_run(task, 0.9 * span, j->parts.count, build_apart, j);
    if (!status) status = place_parts(j);
    return status ? status : base_run(task, 0.1 * span, j->parts.count, copy_part, j);
}

void join_free(tree_join *j) {
    for (size_t i = 0; i < j->parts.count; i++) packer_free(&j->parts.data[i].packer);
    array_free(&j->job->alloc, &j->steps);
    array_free(&j->job->alloc, &j->parts);
    array_free(&j->job->alloc, &j->open);
    packer_free(&j->tree);
}
