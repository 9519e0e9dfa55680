/* check.c: does a folder hold what its manifest says, and each shard all objects of its cell?
 *
 * Every object is counted twice: in each shard that has it, and by the first of them for each cell that it has to be
 * in. Both counts of a shard are equal, or an object is missing or in a wrong place. Only a shard whose objects meet no
 * other cell can be taken away with its file and its line, because what is left is a folder of fewer objects. */
#include "folder.h"
#include "record.h"
#include "shard.h"
#include "support/fail.h"
#include "support/floats.h"
#include <stdio.h>
#include <unistd.h>

typedef struct counts {
    uint64_t *wanted; /* of each shard, less what it has; 0 in the end */
    uint32_t *cells;  /* room for all of them */
} counts;

static froe_status fail_cell(froe_diagnostic *diag) {
    return support_fail(diag, FROE_E_FORMAT, "Its objects are not those of its cell.");
}

/* Does what the manifest says of a shard hold of its tree? */
static froe_status check_entry(const froe_shards *s, uint32_t shard, const counts *c, froe_diagnostic *diag) {
    const froe_shard_entry *e = shards_entry(s, shard);
    const froe_scene *scene = froe_tree_scene(s->slots[shard].tree);
    const froe_shard_plan *plan = s->manifest.plan;
    froe_shard_entry found = {0}; /* bounds alone */
    uint64_t own = 0, last = 0;
    bool right = true, any = false;
    for (uint32_t i = 0; i < e->objects && right; i++) {
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        const uint64_t tag = froe_scene_object(scene, i).tag;
        shards_scene_box(scene, i, lo, hi);
        const bool here = shards_boxes_meet(lo, hi, shards_cell_lo(plan, shard), shards_cell_hi(plan, shard), s->dim);
        right = tag >= last && (here || plan->areas);
        last = tag;
        if (here) {
            c->wanted[shard]--;
            shards_entry_bound(&found, plan, shard, lo, hi, !any);
            any = true;
        }
        if (shards_plan_first(plan, lo) != shard) continue;
        own++;
        const uint32_t met = shards_plan_cells(plan, lo, hi, c->cells);
        for (uint32_t j = 0; j < met; j++) c->wanted[c->cells[j]]++;
    }
    for (int a = 0; a < s->dim && right; a++) right = found.lo[a] == e->lo[a] && found.hi[a] == e->hi[a];
    return right && own == e->own ? FROE_OK : fail_cell(diag);
}

/* A shard without objects has no file. */
static froe_status check_empty(const froe_shards *s, uint32_t shard, froe_diagnostic *diag) {
    const size_t size = strlen(s->path) + SHARDS_NAME;
    char *path = support_realloc(&s->alloc, NULL, 0, size);
    if (!path) return support_fail_memory(diag);
    shards_file_name(path, size, s->path, shard);
    const froe_status status =
        access(path, F_OK) ? FROE_OK
                           : support_fail(diag, FROE_E_FORMAT, "%s: The manifest says that this shard has no objects.",
                                          support_short(path));
    support_free(&s->alloc, path, size);
    return status;
}

static froe_status check_shard(froe_shards *s, uint32_t shard, const counts *c, froe_diagnostic *diag) {
    const froe_tree *tree;
    froe_status status = froe_shards_tree(s, shard, &tree, diag);
    if (!status && !tree) return check_empty(s, shard, diag);
    if (!status) status = froe_tree_check(tree, diag);
    return status ? status : check_entry(s, shard, c, diag);
}

static froe_status check_shards(froe_shards *s, const counts *c, const froe_batch_options *options,
                                froe_diagnostic *diag) {
    for (uint32_t i = 0; i < s->count; i++) {
        froe_diagnostic why;
        const froe_status status = check_shard(s, i, c, &why);
        if (status && diag) *diag = why;
        if (status) return shards_name_file(s, i, status, diag);
        const volatile double done = (double)(i + 1) / s->count;
        if (options && options->progress && !support_callback(options->progress(options->user, done)))
            return support_fail_cancelled(diag);
    }
    for (uint32_t i = 0; i < s->count; i++)
        if (c->wanted[i]) return shards_name_file(s, i, fail_cell(diag), diag);
    return FROE_OK;
}

froe_status froe_shards_check(froe_shards *s, const froe_batch_options *options, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!s) return support_fail_null(diag, __func__);
    if (options && options->size != sizeof *options) return support_fail_defaults(diag, "froe_batch_defaults");
    const counts c = {support_calloc(&s->alloc, s->count, sizeof *c.wanted),
                      support_calloc(&s->alloc, s->count, sizeof *c.cells)};
    const froe_status status = c.wanted && c.cells ? check_shards(s, &c, options, diag) : support_fail_memory(diag);
    if (c.wanted) support_free(&s->alloc, c.wanted, s->count * sizeof *c.wanted);
    if (c.cells) support_free(&s->alloc, c.cells, s->count * sizeof *c.cells);
    return status;
}
