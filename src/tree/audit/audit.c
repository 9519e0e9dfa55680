/* audit.c: is this tree right? Every invariant, checked without trusting the builder.
 *
 *   1  Structure: all that tree/validate.c says of indices, and the scene beneath is valid.
 *   2  Report: the counts are those of the arrays.
 *   3  Guard stage: flagged nodes have axis-parallel cuts and form a connected top part of the tree.
 *   4  Lists: every object is carried from the root by tree/audit/trace.h. Each list holds exactly the
 *      objects that have a point in the open cell, or whose part in the region lies in the cut, once,
 *      with exactly that part as ring. Hence every object is the union of its pieces, and what an in-cut
 *      list holds lies in the cut. Rings are canonical (they name the cuts that made the part), so
 *      equal means the same names from any first corner. Balls, hulls and boxes beside oblique cuts:
 *      nothing that certainly is there is missing, nothing that certainly is not there is listed.
 *   5  Leaves: at most `leaf` pieces, none when that is 0, except where nothing separates them (inseparable.h), where
 *      solids crowd (crowd.h), or, in packed trees, where the builder says that more cuts would not pay.
 *   6  Promises: each holds, by the measured value and, where its name is known, measured again.
 *
 *   7  Packed trees: the root box is that of the scene and every cut divides its cell; flags, units, and that no corner
 *      lies in a cut (packed_audit.h); in space, where objects may be listed beside the cells they are in, units and
 *      boxes, which must hold the object and, where they say all of it, be no larger (space_audit.c).
 *
 * The lists are checked object by object on threads; the violation reported is that of the lowest
 * object, whatever the number of threads. O(pieces x height). */
#include "base/floats.h"
#include "base/task.h"
#include "support/fail.h"
#include "tree/audit/inseparable.h"
#include "tree/audit/trace.h"
#include "tree/packed/packed_audit.h"
#include "tree/packed/space.h"
#include "tree/validate.h"
#include "tree/walk.h"
#include <string.h>

enum { CHUNK = 256 }; /* objects a job */

typedef struct finding {
    size_t job;
    froe_diagnostic diag;
} finding;

typedef struct audit {
    const froe_tree *tree;
    froe_allocator alloc;
    base_task *task;
    froe_diagnostic *diag;
    bool exact_only;
    uint32_t *starts, *pieces; /* object o has the pieces pieces[starts[o] .. starts[o+1]), ascending */
    trace *traces;             /* per worker */
    finding *findings;         /* per worker */
} audit;

froe_audit_options froe_audit_defaults(void) {
    return (froe_audit_options){.size = sizeof(froe_audit_options)};
}

static froe_status bad_node(const audit *a, uint32_t node, const char *what) {
    return support_fail(a->diag, FROE_E_AUDIT, "node %u: %s", node, what);
}

/* ---------------------------------------------------------------- structure -- */

static froe_status check_structure(audit *a) {
    froe_status status = scene_validate(a->tree->scene, &a->alloc, a->diag);
    if (!status) status = tree_validate(a->tree, a->diag);
    if (status == FROE_E_FORMAT) {
        status = FROE_E_AUDIT;
        if (a->diag) a->diag->status = status;
    }
    return status;
}

/* Counts once more, level by level instead of along paths: children come after their parents. */
static froe_status count_again(const audit *a, froe_report *r) {
    const froe_tree *t = a->tree;
    uint32_t *depth = support_calloc(&a->alloc, t->node_count, sizeof *depth);
    double depths = 0;
    if (!depth) return support_fail_memory(a->diag);
    for (uint32_t i = 0; i < t->node_count; i++) {
        const tree_node *n = t->nodes + i;
        uint32_t count = tree_list(t, i).count;
        r->fragments += count;
        depths += (double)count * depth[i];
        if (tree_is_leaf(n)) {
            r->leaves++;
            if (depth[i] > r->height) r->height = depth[i];
            if (count > r->max_leaf) r->max_leaf = count;
            r->inseparable += (n->flags & TREE_INSEPARABLE) != 0;
            r->crowded += (n->flags & TREE_CROWDED) != 0;
        } else {
            r->in_cut += count;
            depth[n->child] = depth[n->child + 1] = depth[i] + 1;
        }
    }
    r->mean_depth = r->fragments ? depths / (double)r->fragments : 0;
    support_free(&a->alloc, depth, t->node_count * sizeof *depth);
    return FROE_OK;
}

static froe_status check_report(const audit *a) {
    const froe_report *r = &a->tree->report;
    froe_report again = {.dim = a->tree->scene->dim};
    froe_status status = count_again(a, &again);
    if (status) return status;
    bool same = r->dim == again.dim && r->leaf == a->tree->meta.leaf && r->seed == a->tree->meta.seed &&
                r->objects == a->tree->scene->object_count && r->nodes == a->tree->node_count &&
                r->leaves == again.leaves && r->fragments == again.fragments && r->in_cut == again.in_cut &&
                r->size == r->nodes + again.fragments && r->height == again.height &&
                r->mean_depth == again.mean_depth && r->max_leaf == again.max_leaf &&
                r->inseparable == again.inseparable && r->crowded == again.crowded;
    return same ? FROE_OK : support_fail(a->diag, FROE_E_AUDIT, "the report does not tell what is in the tree");
}

static froe_status check_guard_stage(const audit *a) {
    const froe_tree *t = a->tree;
    for (uint32_t i = 0; i < t->node_count; i++) {
        const tree_node *n = t->nodes + i;
        if (tree_is_leaf(n)) continue;
        if (!(n->flags & TREE_GUARD)) {
            for (uint32_t c = n->child; c < n->child + 2; c++)
                if (t->nodes[c].flags & TREE_GUARD) return bad_node(a, c, "in the guard stage, but not its parent");
        } else if (tree_cut_at(t, i).kind != FROE_CUT_AXIS && tree_cut_at(t, i).kind != FROE_CUT_PLANE) {
            return bad_node(a, i, "in the guard stage, but its cut depends on the objects");
        }
    }
    return FROE_OK;
}

/* Of packed trees. */
static froe_status check_frame(const audit *a) {
    uint32_t node;
    const char *why;
    if (packed_frame_refuted(a->tree, &node, &why)) return support_fail_memory(a->diag);
    return why ? bad_node(a, node, why) : FROE_OK;
}

/* -------------------------------------------------------------------- lists -- */

/* In the order of the pieces, which is that of a walk. */
static froe_status place_pieces(audit *a) {
    tree_walk walk = {.tree = a->tree};
    while (tree_walk_next(&walk)) {
        tree_objects list = tree_list(a->tree, walk.node);
        for (uint32_t i = 0; i < list.count; i++) a->pieces[a->starts[tree_object(&list, i) + 1]++] = list.first + i;
    }
    return tree_walk_end(&walk) ? support_fail_memory(a->diag) : FROE_OK;
}

/* Sorts the pieces by object (counting). */
static froe_status sort_pieces(audit *a) {
    const froe_tree *t = a->tree;
    size_t objects = t->scene->object_count;
    a->starts = support_calloc(&a->alloc, objects + 2, sizeof *a->starts);
    a->pieces = support_calloc(&a->alloc, t->piece_count, sizeof *a->pieces);
    if (!a->starts || !a->pieces) return support_fail_memory(a->diag);
    for (uint32_t node = 0; node < t->node_count; node++) {
        tree_objects list = tree_list(t, node);
        for (uint32_t i = 0; i < list.count; i++) a->starts[tree_object(&list, i) + 2]++;
    }
    for (size_t i = 2; i < objects + 2; i++) a->starts[i] += a->starts[i - 1];
    return place_pieces(a);
}

/* One object being compared with its stored pieces. */
typedef struct comparison {
    const froe_tree *tree;
    trace *trace;
    num_context *context;       /* of the trace */
    const uint32_t *next, *end; /* its pieces not met yet */
    uint32_t object;
    froe_diagnostic *diag;
    bool failed, no_memory;
} comparison;

/* Notes the violation; false, to stop the trace. */
static bool differs(comparison *c, uint32_t node, const char *what) {
    support_fail_at(c->diag, FROE_E_AUDIT, c->object, FROE_NONE, FROE_NONE, "object %u, node %u: %s", c->object, node,
                    what);
    c->failed = true;
    return false;
}

static uint32_t node_of_piece(const froe_tree *t, uint32_t piece) {
    for (uint32_t i = 0; i < t->node_count; i++) {
        tree_objects list = tree_list(t, i);
        if (piece >= list.first && piece - list.first < list.count) return i;
    }
    return FROE_NONE;
}

static bool stray(comparison *c) {
    return differs(c, node_of_piece(c->tree, *c->next), "a piece where the object is not");
}

/* The same ring from any first corner; entries are unique within a ring. */
static bool rings_equal(const uint32_t *stored, const trace_place *place, bool cyclic) {
    uint32_t n = place->count, shift = 0;
    if (stored[0] != n) return false;
    while (cyclic && shift < n && place->ring[shift] != stored[1]) shift++;
    if (shift == n) return false;
    for (uint32_t i = 0; i < n; i++)
        if (stored[1 + i] != place->ring[i + shift < n ? i + shift : i + shift - n]) return false;
    return true;
}

static bool shape_right(const comparison *c, const tree_piece *piece, const trace_place *place) {
    uint32_t own = 0;
    if (!place->ring) return !piece->ring;
    while (own < place->count && place->ring[own] == own) own++;
    bool whole = own == place->count && own == scene_corners(c->tree->scene, c->object);
    if (whole || !piece->ring) return whole && !piece->ring;
    return rings_equal(c->tree->bounds + piece->ring, place, scene_form(c->tree->scene, c->object) == FROE_POLYGON);
}

/* A point has one corner, which is both ends. The ring that others are told must be the true one, too. */
static const char *packed_wrong(const comparison *c, const trace_place *place, uint32_t i) {
    uint32_t ring[2] = {place->ring[0], place->ring[place->count - 1]}, told[2];
    if (place->count == 2) {
        packed_ring(c->tree, c->context, place->node, c->object, told);
        if (told[0] != ring[0] || told[1] != ring[1]) return "a piece of the wrong shape";
    }
    return packed_refuted(c->context, c->tree, place->node, i, ring);
}

/* Of a place without a piece; false stops the trace. */
static bool may_be_left_out(comparison *c, const trace_place *place) {
    bool must = place->must;
    c->no_memory = place->unsure && trace_cell_meets(c->trace, place->node, &must) != FROE_OK;
    if (c->no_memory) return false;
    return !must || differs(c, place->node, "a piece is missing");
}

/* In packed trees of space objects may be listed beside the cells they are in; space_refuted() sees to those. */
static bool find_place(comparison *c, const trace_place *place) {
    tree_objects list = tree_list(c->tree, place->node);
    while (c->next < c->end && *c->next < list.first) c->next++;
    bool listed = c->next < c->end && *c->next - list.first < list.count;
    return listed || may_be_left_out(c, place);
}

/* All pieces of an object: each right in its leaf, no two in one. */
static bool space_pieces_right(comparison *c) {
    uint32_t last = FROE_NONE;
    for (const uint32_t *piece = c->next; piece < c->end; piece++) {
        uint32_t leaf = packed_leaf(c->tree, *piece);
        const char *why = leaf == last ? "listed twice" : space_refuted(c->context, c->tree, *piece);
        if (why) return differs(c, leaf, why);
        last = leaf;
    }
    return true;
}

/* Places and pieces come in the same order. */
static bool compare_place(void *user, const trace_place *place) {
    comparison *c = user;
    tree_objects list = tree_list(c->tree, place->node);
    if (tree_is_space(c->tree)) return find_place(c, place);
    if (c->next < c->end && *c->next < list.first) return stray(c);
    if (c->next == c->end || *c->next - list.first >= list.count) return may_be_left_out(c, place);
    const char *why = tree_is_packed(c->tree) ? packed_wrong(c, place, *c->next - list.first)
                      : shape_right(c, c->tree->pieces + *c->next, place) ? NULL
                                                                          : "a piece of the wrong shape";
    if (why) return differs(c, place->node, why);
    c->next++;
    if (c->next < c->end && *c->next - list.first < list.count) return differs(c, place->node, "listed twice");
    return true;
}

static froe_status check_object(audit *a, unsigned worker, uint32_t object, froe_diagnostic *diag) {
    trace *t = a->traces + worker;
    comparison c = {.tree = a->tree, .trace = t, .context = &t->context, .object = object, .diag = diag};
    c.next = a->pieces + a->starts[object];
    c.end = a->pieces + a->starts[object + 1];
    bool space = tree_is_space(a->tree);
    if (space && !space_pieces_right(&c)) return FROE_E_AUDIT;
    froe_status status = trace_object(t, object, compare_place, &c);
    if (status || c.no_memory) return support_fail_memory(diag);
    if (!c.failed && !space && c.next < c.end) stray(&c);
    return c.failed ? FROE_E_AUDIT : FROE_OK;
}

static froe_status check_chunk(void *user, unsigned worker, size_t job) {
    audit *a = user;
    uint64_t begin = (uint64_t)job * CHUNK, end = begin + CHUNK, objects = a->tree->scene->object_count;
    froe_diagnostic diag;
    for (uint64_t i = begin; i < end && i < objects; i++) {
        froe_status status = check_object(a, worker, (uint32_t)i, &diag);
        if (!status) continue;
        if (job < a->findings[worker].job) a->findings[worker] = (finding){job, diag};
        return status;
    }
    return FROE_OK;
}

static froe_status start_workers(audit *a) {
    unsigned threads = a->task->threads;
    froe_status status = FROE_OK;
    a->traces = support_calloc(&a->alloc, threads, sizeof *a->traces);
    a->findings = support_calloc(&a->alloc, threads, sizeof *a->findings);
    if (!a->traces || !a->findings) return support_fail_memory(a->diag);
    for (unsigned i = 0; i < threads && !status; i++) {
        a->findings[i].job = SIZE_MAX;
        status = trace_new(a->tree, a->exact_only, a->traces + i);
    }
    return status ? support_fail_memory(a->diag) : FROE_OK;
}

static froe_status tell_audit(const audit *a, froe_status status) {
    const finding *first = a->findings;
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(a->diag);
    for (unsigned i = 1; i < a->task->threads; i++)
        if (a->findings[i].job < first->job) first = a->findings + i;
    if (status && a->diag) *a->diag = first->diag;
    return status;
}

static froe_status check_lists(audit *a) {
    froe_status status = sort_pieces(a);
    if (!status) status = start_workers(a);
    if (status) return status;
    size_t jobs = ((size_t)a->tree->scene->object_count + CHUNK - 1) / CHUNK;
    return tell_audit(a, base_run(a->task, 0.8, jobs, check_chunk, a));
}

/* ------------------------------------------------------------------- leaves -- */

static froe_status check_leaf(audit *a, uint32_t node) {
    const froe_tree *t = a->tree;
    uint32_t most = t->meta.leaf;
    tree_objects list = tree_list(t, node);
    bool crowded = t->nodes[node].flags & TREE_CROWDED, flagged = t->nodes[node].flags & TREE_INSEPARABLE;
    const char *name = crowded ? "crowded" : "inseparable", *why = NULL;
    if (list.count <= most && (crowded || flagged))
        return support_fail(a->diag, FROE_E_AUDIT, "node %u: called %s, but not over capacity", node, name);
    if (list.count <= most || (crowded && tree_is_packed(t))) return FROE_OK;
    if (!crowded && !flagged)
        return support_fail(a->diag, FROE_E_AUDIT, "node %u: %u pieces in a leaf for at most %u", node, list.count,
                            most);
    froe_status status =
        (crowded ? crowded_refuted : inseparable_refuted)(&a->traces[0].context, a->task, t, &list, &why);
    if (status) return support_fail_memory(a->diag);
    return why ? support_fail(a->diag, FROE_E_AUDIT, "node %u: called %s, but %s", node, name, why) : FROE_OK;
}

static froe_status check_leaves(audit *a) {
    const froe_tree *t = a->tree;
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < t->node_count && !status; i++) {
        if (i % 65536 == 0) base_progress(a->task, a->task->done);
        if (base_cancelled(a->task)) return support_fail_cancelled(a->diag);
        if (tree_is_leaf(t->nodes + i)) status = check_leaf(a, i);
    }
    return status || !base_cancelled(a->task) ? status : support_fail_cancelled(a->diag);
}

/* ----------------------------------------------------------------- promises -- */

static froe_status check_promise(const audit *a, const tree_promise *p) {
    double again = p->measured;
    froe_status status = tree_measure(a->tree, p->name, &again);
    if (status == FROE_E_MEMORY) return support_fail_memory(a->diag);
    if (!(p->measured <= p->promised))
        return support_fail(a->diag, FROE_E_AUDIT, "promise '%s': %.17g at most, measured %.17g", p->name, p->promised,
                            p->measured);
    if (!(again <= p->measured))
        return support_fail(a->diag, FROE_E_AUDIT, "promise '%s': said to be measured as %.17g, but is %.17g", p->name,
                            p->measured, again);
    return FROE_OK;
}

static froe_status check_promises(const audit *a) {
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < a->tree->meta.promise_count && !status; i++)
        status = check_promise(a, a->tree->meta.promises + i);
    return status;
}

/* -------------------------------------------------------------------- whole -- */

static void clean_up(audit *a) {
    unsigned threads = a->task->threads;
    size_t objects = a->tree->scene->object_count, pieces = a->tree->piece_count;
    for (unsigned i = 0; a->traces && i < threads; i++) trace_free(a->traces + i);
    support_free(&a->alloc, a->traces, threads * sizeof *a->traces);
    support_free(&a->alloc, a->findings, threads * sizeof *a->findings);
    support_free(&a->alloc, a->starts, (objects + 2) * sizeof *a->starts);
    support_free(&a->alloc, a->pieces, pieces ? pieces * sizeof *a->pieces : 1);
}

static froe_status check_all(audit *a) {
    if (!base_progress(a->task, 0)) return support_fail_cancelled(a->diag);
    froe_status status = check_structure(a);
    if (!status) status = check_report(a);
    if (!status) status = check_guard_stage(a);
    if (!status && tree_is_packed(a->tree)) status = check_frame(a);
    if (!status && !base_progress(a->task, 0.1)) return support_fail_cancelled(a->diag);
    if (!status) status = check_lists(a);
    if (!status) status = check_leaves(a);
    if (!status) status = check_promises(a);
    if (!status) base_progress(a->task, 1);
    return status;
}

froe_status froe_tree_audit(const froe_tree *tree, const froe_audit_options *options, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_audit_options o = options ? *options : froe_audit_defaults();
    base_task task;
    if (!tree) return support_fail(diag, FROE_E_ARG, "tree must not be NULL");
    if (o.size != sizeof o) return support_fail(diag, FROE_E_OPTIONS, "options do not come from froe_audit_defaults()");
    base_task_init(&task, o.threads, o.progress, o.user);
    audit a = {.tree = tree, .alloc = tree->alloc, .task = &task, .diag = diag, .exact_only = o.exact_only};
    froe_status status = check_all(&a);
    clean_up(&a);
    return status;
}
