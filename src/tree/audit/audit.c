/* audit.c: is this tree right? Every invariant, checked without trusting the builder.
 *
 *   1  Structure: all that tree/validate.c checks of indices, and the scene beneath is valid.
 *   2  Report: the counts are those of the arrays.
 *   3  Guard stage: flagged nodes have axis-parallel cuts and form a connected top part of the tree.
 *   4  Lists: every object is carried from the root by tree/audit/trace.h. Each list holds exactly the
 *      objects that have a point in the open cell, or whose part in the region lies in the cut, once,
 *      with exactly that part as ring. Hence every object is the union of its pieces, and what an in-cut
 *      list holds lies in the cut. Rings are canonical (they name the cuts that made the part), so
 *      equal means the same names from any first corner. Balls, hulls and boxes beside oblique cuts:
 *      nothing that certainly is there is missing, nothing that certainly is not there is listed.
 *      A box that contains the region of a node may be listed there as a cover, and then nowhere below.
 *   5  Leaves: at most `leaf` pieces besides covers, none when that is 0, except where nothing separates them
 *      (inseparable.h), where solids crowd (crowd.h), or, in packed trees, where the builder says that more cuts would
 *      not pay.
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
#include "tree/gate.h"
#include "tree/packed/packed_audit.h"
#include "tree/packed/space.h"
#include "tree/validate.h"
#include "tree/walk.h"
#include <string.h>

enum { JOB_OBJECTS = 256 };

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
    tree_trace *traces;        /* per worker */
    finding *findings;         /* per worker */
} audit;

void froe_audit_defaults_into(froe_audit_options *out, size_t size) {
    const froe_audit_options all = {.size = size};
    support_defaults(out, size, &all, sizeof all);
}

static froe_status bad_node(const audit *a, uint32_t node, const char *what) {
    return support_fail(a->diag, FROE_E_AUDIT, "node %u: The audit finds %s.", node, what);
}

/* ---------------------------------------------------------------- structure -- */

/* Counts once more, level by level instead of along paths: children come after their parents. */
static froe_status check_report(const audit *a) {
    const froe_report *r = &a->tree->report;
    const froe_tree *t = a->tree;
    uint32_t *depth = support_calloc(&a->alloc, t->node_count, sizeof *depth);
    froe_report again = {.dim = t->scene->dim};
    double depths = 0;
    if (!depth) return support_fail_memory(a->diag);
    for (uint32_t i = 0; i < t->node_count; i++) {
        const tree_node *n = t->nodes + i;
        const uint32_t count = tree_list(t, i).count, covers = tree_covers(t, n);
        again.fragments += count;
        again.covers += covers;
        depths += (double)count * depth[i];
        if (tree_is_leaf(n)) {
            again.leaves++;
            if (depth[i] > again.height) again.height = depth[i];
            if (count > again.max_leaf) again.max_leaf = count;
            again.inseparable += (n->flags & TREE_INSEPARABLE) != 0;
            again.crowded += (n->flags & TREE_CROWDED) != 0;
        } else {
            again.in_cut += count - covers;
            depth[n->child] = depth[n->child + 1] = depth[i] + 1;
        }
    }
    again.mean_depth = again.fragments ? depths / (double)again.fragments : 0;
    support_free(&a->alloc, depth, t->node_count * sizeof *depth);
    bool same = r->dim == again.dim && r->leaf == t->meta.leaf && r->seed == t->meta.seed &&
                r->objects == t->scene->object_count && r->nodes == t->node_count && r->leaves == again.leaves &&
                r->fragments == again.fragments && r->in_cut == again.in_cut && r->covers == again.covers &&
                r->size == r->nodes + again.fragments && r->height == again.height &&
                r->mean_depth == again.mean_depth && r->max_leaf == again.max_leaf &&
                r->inseparable == again.inseparable && r->crowded == again.crowded;
    return same ? FROE_OK : support_fail(a->diag, FROE_E_AUDIT, "The report does not tell what is in the tree.");
}

static froe_status check_stages(const audit *a) {
    const froe_tree *t = a->tree;
    for (uint32_t i = 0; i < t->node_count; i++) {
        const tree_node *n = t->nodes + i;
        if (tree_is_leaf(n)) continue;
        for (uint32_t c = n->child; c < n->child + 2; c++) {
            const uint8_t begun = t->nodes[c].flags & ~n->flags;
            if (begun & TREE_GUARD) return bad_node(a, c, "a node of the guard stage whose parent is not");
            if (begun & TREE_CHARGED) return bad_node(a, c, "a charged node whose parent is not");
        }
        const froe_cut_kind kind = tree_cut_at(t, i).kind;
        if (n->flags & TREE_GUARD && kind != FROE_CUT_AXIS && kind != FROE_CUT_PLANE)
            return bad_node(a, i, "a node of the guard stage whose cut depends on the objects");
    }
    return FROE_OK;
}

/* -------------------------------------------------------------------- lists -- */

/* One object being compared with its stored pieces. */
typedef struct comparison {
    const froe_tree *tree;
    tree_trace *trace;
    num_context *context;       /* of the tree_trace */
    const uint32_t *next, *end; /* its pieces not met yet */
    uint32_t object;
    froe_diagnostic *diag;
    bool failed, no_memory;
} comparison;

/* Notes the violation; false, to stop the trace. */
static bool differs(comparison *c, uint32_t node, const char *what) {
    support_fail_at(c->diag, FROE_E_AUDIT, c->object, FROE_NONE, FROE_NONE, "object %u, node %u: The audit finds %s.",
                    c->object, node, what);
    c->failed = true;
    return false;
}

/* The next piece is in no place of the object; the node that lists it is found by looking through all lists. */
static bool stray(comparison *c) {
    uint32_t node = 0, piece = *c->next;
    for (; node + 1 < c->tree->node_count; node++) { /* some list has it */
        tree_objects list = tree_list(c->tree, node);
        if (piece >= list.first && piece - list.first < list.count) break;
    }
    return differs(c, node, "a piece where the object is not");
}

/* Is the stored ring that of the place? Rings of polygons may begin at any corner; entries are unique within a ring. */
static bool shape_right(const comparison *c, const tree_piece *piece, const trace_place *place) {
    const bool cyclic = scene_form(c->tree->scene, c->object) == FROE_POLYGON;
    uint32_t own = 0, shift = 0, n = place->count;
    if (!place->ring) return !piece->ring;
    while (own < n && place->ring[own] == own) own++;
    bool whole = n == scene_corners(c->tree->scene, c->object) && own == n;
    if (whole || !piece->ring) return whole && !piece->ring;
    const uint32_t *stored = c->tree->bounds + piece->ring;
    if (stored[0] != n) return false;
    while (cyclic && shift < n && place->ring[shift] != stored[1]) shift++;
    if (shift == n) return false;
    for (uint32_t i = 0; i < n; i++)
        if (stored[1 + i] != place->ring[i + shift < n ? i + shift : i + shift - n]) return false;
    return true;
}

/* A point has one corner, which is both ends. The ring that packed_ring() computes must be the true one, too. */
static const char *packed_wrong(const comparison *c, const trace_place *place, uint32_t i) {
    uint32_t ring[2] = {place->ring[0], place->ring[place->count - 1]}, found[2];
    if (place->count == 2) {
        packed_ring(c->tree, c->context, place->node, c->object, found);
        /* one way: packed_ring() is right, which is not relied on here */
        if (found[0] != ring[0] || found[1] != ring[1]) return "a piece of the wrong shape";
    }
    return packed_refuted(c->context, c->tree, place->node, i, ring);
}

/* The next piece is right: on to the one after it, which must be in another list. */
static bool take_piece(comparison *c, uint32_t node, const tree_objects *list) {
    c->next++;
    const bool twice = c->next < c->end && *c->next - list->first < list->count;
    if (twice) return differs(c, node, "two pieces of the object");
    return true;
}

/* Places and pieces come in the same order. In packed trees of space objects may also be listed beside the cells they
 * are in: check_chunk() looks at those pieces, and a place needs only to be listed. */
static bool compare_place(void *user, const trace_place *place) {
    comparison *c = user;
    tree_objects list = tree_list(c->tree, place->node);
    const bool space = tree_is_space(c->tree);
    while (space && c->next < c->end && *c->next < list.first) c->next++;
    if (c->next < c->end && *c->next < list.first) return stray(c);
    if (c->next == c->end || *c->next - list.first >= list.count) { /* no piece: right unless there must be one */
        bool must = place->must;
        c->no_memory = place->unsure && trace_cell_meets(c->trace, place->node, &must) != FROE_OK;
        if (c->no_memory) return false;
        if (must) return differs(c, place->node, "no piece where the object is");
        return true;
    }
    if (space) return true;
    const char *why = tree_is_packed(c->tree) ? packed_wrong(c, place, *c->next - list.first)
                      : shape_right(c, c->tree->pieces + *c->next, place) ? NULL
                                                                          : "a piece of the wrong shape";
    if (why) return differs(c, place->node, why);
    return take_piece(c, place->node, &list);
}

/* Covers come in the order of the other places, too. */
static bool compare_cover(void *user, uint32_t node, bool contains, bool *stop) {
    comparison *c = user;
    const tree_objects list = tree_list(c->tree, node);
    if (c->next == c->end || *c->next < list.first ||
        *c->next - list.first >= tree_covers(c->tree, c->tree->nodes + node))
        return false;
    *stop = !(contains ? take_piece(c, node, &list)
                       : differs(c, node, "a cover that does not contain the region of the node"));
    return true;
}

/* Objects of one job, each compared with its pieces, up to the first violation. */
static froe_status check_chunk(void *user, unsigned worker, size_t job) {
    audit *a = user;
    tree_trace *t = a->traces + worker;
    const bool space = tree_is_space(a->tree);
    uint64_t begin = (uint64_t)job * JOB_OBJECTS, end = begin + JOB_OBJECTS, objects = a->tree->scene->object_count;
    froe_diagnostic diag;
    froe_status status = FROE_OK;
    for (uint64_t i = begin; i < end && i < objects && !status; i++) {
        comparison c = {.tree = a->tree, .trace = t, .context = &t->context, .object = (uint32_t)i, .diag = &diag};
        c.next = a->pieces + a->starts[i];
        c.end = a->pieces + a->starts[i + 1];
        uint32_t last = FROE_NONE;
        for (const uint32_t *piece = c.next; space && piece < c.end && !c.failed; piece++) {
            uint32_t leaf = packed_leaf(a->tree, *piece); /* every piece right in its leaf, and no two in one */
            const char *why = leaf == last ? "listed twice" : space_refuted(c.context, a->tree, *piece);
            if (why) differs(&c, leaf, why);
            last = leaf;
        }
        if (!c.failed && trace_object(t, (uint32_t)i, compare_place, compare_cover, &c)) c.no_memory = true;
        if (!c.failed && !c.no_memory && !space && c.next < c.end) stray(&c);
        status = c.no_memory ? support_fail_memory(&diag) : c.failed ? FROE_E_AUDIT : FROE_OK;
    }
    if (status) a->findings[worker] = (finding){job, diag};
    return status;
}

/* Sorts the pieces by object (counting), and checks all objects on threads. The finding reported is that of the lowest
 * job. */
static froe_status check_lists(audit *a) {
    const froe_tree *t = a->tree;
    const size_t objects = t->scene->object_count, threads = a->task->threads;
    a->starts = support_calloc(&a->alloc, objects + 2, sizeof *a->starts);
    a->pieces = support_calloc(&a->alloc, t->piece_count, sizeof *a->pieces);
    a->traces = support_calloc(&a->alloc, threads, sizeof *a->traces);
    a->findings = support_calloc(&a->alloc, threads, sizeof *a->findings);
    if (!a->starts || !a->pieces || !a->traces || !a->findings) return support_fail_memory(a->diag);
    for (uint32_t node = 0; node < t->node_count; node++) {
        tree_objects list = tree_list(t, node);
        for (uint32_t i = 0; i < list.count; i++) a->starts[tree_object(&list, i) + 2]++;
    }
    for (size_t i = 2; i < objects + 2; i++) a->starts[i] += a->starts[i - 1];
    tree_walk walk = {.tree = t}; /* goes in the order of the pieces */
    while (tree_walk_next(&walk)) {
        tree_objects list = tree_list(t, walk.node);
        for (uint32_t i = 0; i < list.count; i++) a->pieces[a->starts[tree_object(&list, i) + 1]++] = list.first + i;
    }
    if (tree_walk_end(&walk)) return support_fail_memory(a->diag);
    for (unsigned i = 0; i < threads; i++) {
        a->findings[i].job = SIZE_MAX;
        if (trace_new(a->tree, a->exact_only, a->traces + i)) return support_fail_memory(a->diag);
    }
    froe_status status = base_run(a->task, 0.8, (objects + JOB_OBJECTS - 1) / JOB_OBJECTS, check_chunk, a);
    if (status == FROE_E_CANCELLED) return support_fail_cancelled(a->diag);
    const finding *first = a->findings;
    for (unsigned i = 1; i < threads; i++)
        if (a->findings[i].job < first->job) first = a->findings + i;
    if (status && a->diag) *a->diag = first->diag;
    return status;
}

/* ------------------------------------------------------------------- leaves -- */

static froe_status check_leaves(audit *a) {
    const froe_tree *t = a->tree;
    const uint32_t most = t->meta.leaf;
    for (uint32_t i = 0; i < t->node_count; i++) {
        if (i % 65536 == 0) base_progress(a->task, a->task->done);
        if (base_cancelled(a->task)) return support_fail_cancelled(a->diag);
        if (!tree_is_leaf(t->nodes + i)) continue;
        const tree_objects list = tree_own_list(t, i);
        bool crowded = t->nodes[i].flags & TREE_CROWDED, flagged = t->nodes[i].flags & TREE_INSEPARABLE;
        const char *name = crowded ? "crowded" : "inseparable", *why = NULL;
        if (list.count <= most && (crowded || flagged))
            return support_fail(a->diag, FROE_E_AUDIT, "node %u: It is called %s, but is not over capacity.", i, name);
        if (list.count <= most || (crowded && tree_is_packed(t))) continue;
        if (!crowded && !flagged)
            return support_fail(a->diag, FROE_E_AUDIT, "node %u: The leaf has %u pieces, and room for %u.", i,
                                list.count, most);
        froe_status status =
            (crowded ? crowded_refuted : inseparable_refuted)(&a->traces[0].context, a->task, t, &list, &why);
        if (status) return support_fail_memory(a->diag);
        if (why) return support_fail(a->diag, FROE_E_AUDIT, "node %u: It is called %s, but %s.", i, name, why);
    }
    return base_cancelled(a->task) ? support_fail_cancelled(a->diag) : FROE_OK;
}

/* -------------------------------------------------------------------- whole -- */

static froe_status check_all(audit *a) {
    const froe_tree *t = a->tree;
    uint32_t node;
    const char *why = NULL;
    if (!base_progress(a->task, 0)) return support_fail_cancelled(a->diag);
    froe_status status = scene_validate(t->scene, &a->alloc, a->diag);
    if (!status) status = tree_validate(t, a->diag);
    if (status == FROE_E_FORMAT) {
        status = FROE_E_AUDIT;
        if (a->diag) a->diag->status = status;
    }
    if (!status) status = check_report(a);
    if (!status) status = check_stages(a);
    if (status) return status;
    if (tree_is_packed(t) && packed_frame_refuted(t, &node, &why)) return support_fail_memory(a->diag);
    if (why) return bad_node(a, node, why);
    if (!base_progress(a->task, 0.1)) return support_fail_cancelled(a->diag);
    status = check_lists(a);
    if (!status) status = check_leaves(a);
    for (uint32_t i = 0; i < t->meta.promise_count && !status; i++) {
        const tree_promise *p = t->meta.promises + i;
        double again = p->measured;
        if (tree_measure(t, p->name, &again) == FROE_E_MEMORY) return support_fail_memory(a->diag);
        if (!(p->measured <= p->promised))
            return support_fail(a->diag, FROE_E_AUDIT, "promise '%s': It is %.17g at most, but measured %.17g.",
                                p->name, p->promised, p->measured);
        if (!(again <= p->measured))
            return support_fail(a->diag, FROE_E_AUDIT,
                                "promise '%s': It is said to be measured as %.17g, but is %.17g.", p->name, p->measured,
                                again);
    }
    if (!status && !base_progress(a->task, 1)) return support_fail_cancelled(a->diag);
    return status;
}

froe_status froe_tree_audit(const froe_tree *tree, const froe_audit_options *options, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    froe_audit_options o = options ? *options : froe_audit_defaults();
    base_task task;
    if (!tree) return support_fail_null(diag, __func__);
    if (o.size != sizeof o) return support_fail_defaults(diag, "froe_audit_defaults");
    const froe_status settled = tree_settle(tree, diag);
    if (settled) return settled;
    base_task_init(&task, o.threads, o.progress, o.user);
    audit a = {.tree = tree, .alloc = tree->alloc, .task = &task, .diag = diag, .exact_only = o.exact_only};
    froe_status status = check_all(&a);
    size_t objects = tree->scene->object_count, pieces = tree->piece_count;
    for (unsigned i = 0; a.traces && i < task.threads; i++) trace_free(a.traces + i);
    support_free(&a.alloc, a.traces, task.threads * sizeof *a.traces);
    support_free(&a.alloc, a.findings, task.threads * sizeof *a.findings);
    support_free(&a.alloc, a.starts, (objects + 2) * sizeof *a.starts);
    support_free(&a.alloc, a.pieces, pieces ? pieces * sizeof *a.pieces : 1);
    return status;
}
