/* orders.c: the public calls for depth orders. Many eyes at once share the work on each cut:
 * first all sides of up to 32 eyes, two bits each in a word per node, then one walk per eye. */
#include "base/floats.h"
#include "base/task.h"
#include "geom/selftest.h"
#include "support/fail.h"
#include "tree/gate.h"
#include "view/visibility/order.h"

enum { EYES_PER_WORD = 32, NODES_PER_TASK = 4096 };

void froe_order_defaults_into(froe_order_options *out, size_t size) {
    const froe_order_options all = {.size = size};
    support_defaults(out, size, &all, sizeof all);
}

static froe_status check_orders(const froe_tree *tree, const froe_order_options **options,
                                const froe_order_options *standard, froe_diagnostic *diag) {
    if (!tree) return support_fail_null(diag, "a depth order");
    if (!*options) *options = standard;
    if ((*options)->size != sizeof **options) return support_fail_defaults(diag, "froe_order_defaults");
    if (tree->scene->dim > 3)
        return support_fail(diag, FROE_E_UNSUPPORTED, "Depth orders exist in 2 and 3 dimensions, not in %d.",
                            tree->scene->dim);
    return tree_settle(tree, diag);
}

froe_status froe_tree_order(const froe_tree *tree, const froe_eye *eye, const froe_order_options *options,
                            froe_order_fn *fn, void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    const froe_order_options standard = froe_order_defaults();
    geom_eye from;
    view_order order;
    uint32_t piece;
    if (!eye || !fn) return support_fail_null(diag, __func__);
    froe_status status = check_orders(tree, &options, &standard, diag);
    if (!status) status = view_order_check(tree, false, diag);
    if (!status) status = view_eye_of(tree, eye, &from, diag);
    if (status) return status;
    status = view_order_begin(&order, tree, &from, options->front_to_back, options->ranks);
    while (!status && view_order_next(&order, &piece) && base_callback(fn(user, piece))) {
    }
    status = view_order_end(&order) ? FROE_E_MEMORY : status;
    return status ? support_fail_memory(diag) : FROE_OK;
}

typedef struct order_frame {
    uint32_t node;
    froe_order_stage stage;
} order_frame;

froe_status froe_tree_order_nodes(const froe_tree *tree, const froe_eye *eye, const froe_order_options *options,
                                  froe_order_node_fn *fn, void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    const froe_order_options standard = froe_order_defaults();
    geom_eye from;
    num_context context;
    ARRAY(order_frame) frames = {0};
    if (!eye || !fn) return support_fail_null(diag, __func__);
    froe_status status = check_orders(tree, &options, &standard, diag);
    if (!status) status = view_eye_of(tree, eye, &from, diag);
    if (status) return status;
    if (geom_context_new(&tree->alloc, &context)) return support_fail_memory(diag);
    bool room = array_push(&tree->alloc, &frames, (order_frame){0, FROE_ORDER_BEGIN});
    while (room && frames.count) {
        const order_frame top = frames.data[--frames.count];
        const tree_node *n = tree->nodes + top.node;
        if (!base_callback(fn(user, (froe_node){top.node + 1}, top.stage))) break;
        if (top.stage != FROE_ORDER_BEGIN) continue;
        room = array_reserve(&tree->alloc, &frames, 4);
        if (!room) break;
        frames.data[frames.count++] = (order_frame){top.node, FROE_ORDER_END};
        const bool leaf = tree_is_leaf(n);
        const uint32_t near = leaf ? 0 : n->child + (view_side_of_eye(&context, tree, top.node, &from) >= 0),
                       far = leaf ? 0 : 2 * n->child + 1 - near;
        if (!leaf) frames.data[frames.count++] = (order_frame){options->front_to_back ? far : near, FROE_ORDER_BEGIN};
        frames.data[frames.count++] = (order_frame){top.node, FROE_ORDER_LIST};
        if (!leaf) frames.data[frames.count++] = (order_frame){options->front_to_back ? near : far, FROE_ORDER_BEGIN};
    }
    array_free(&tree->alloc, &frames);
    num_context_free(&context);
    return room ? FROE_OK : support_fail_memory(diag);
}

/* ------------------------------------------------------------------ many eyes -- */

typedef struct eye_batch {
    const froe_tree *tree;
    const froe_order_options *options;
    const geom_eye *eyes;
    size_t count; /* at most EYES_PER_WORD */
    uint64_t *sides;
    uint32_t *pieces;
    num_context *contexts; /* one a worker */
} eye_batch;

static froe_status sides_of_nodes(void *user, unsigned worker, size_t job) {
    eye_batch *b = user;
    uint32_t end = (uint32_t)(job + 1) * NODES_PER_TASK < b->tree->node_count ? (uint32_t)(job + 1) * NODES_PER_TASK
                                                                              : b->tree->node_count;
    for (uint32_t node = (uint32_t)job * NODES_PER_TASK; node < end; node++) {
        b->sides[node] = 0;
        if (tree_is_leaf(b->tree->nodes + node)) continue;
        for (size_t e = 0; e < b->count; e++)
            b->sides[node] |= (uint64_t)(view_side_of_eye(b->contexts + worker, b->tree, node, b->eyes + e) + 1)
                              << 2 * e;
    }
    return FROE_OK;
}

static froe_status order_of_eye(void *user, unsigned worker, size_t job) {
    eye_batch *b = user;
    view_order order;
    uint32_t *out = b->pieces + job * b->tree->piece_count;
    (void)worker;
    froe_status status = view_order_begin(&order, b->tree, b->eyes + job, b->options->front_to_back, b->options->ranks);
    order.sides = b->sides;
    order.shift = 2 * (unsigned)job;
    while (!status && view_order_next(&order, out)) out++;
    return view_order_end(&order) ? FROE_E_MEMORY : status;
}

froe_status froe_tree_orders(const froe_tree *tree, const froe_eye *eyes, size_t count,
                             const froe_order_options *options, uint32_t *pieces, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    const froe_order_options standard = froe_order_defaults();
    if (count && (!eyes || !pieces)) return support_fail_null(diag, __func__);
    froe_status status = check_orders(tree, &options, &standard, diag);
    if (!status) status = view_order_check(tree, false, diag);
    if (status) return status;
    froe_status bad = FROE_OK; /* of an eye */
    base_task task;
    base_task_init(&task, options->threads, options->progress, options->user);
    eye_batch b = {.tree = tree, .options = options, .pieces = pieces};
    b.sides = support_calloc(&tree->alloc, tree->node_count, sizeof *b.sides);
    b.contexts = support_calloc(&tree->alloc, task.threads, sizeof *b.contexts);
    for (unsigned i = 0; b.contexts && i < task.threads && !status; i++)
        status = geom_context_new(&tree->alloc, b.contexts + i);
    if (!b.sides || !b.contexts) status = FROE_E_MEMORY;
    geom_eye from[EYES_PER_WORD];
    b.eyes = from;
    for (size_t i = 0; i < count && !status && !bad; i += EYES_PER_WORD) {
        b.count = count - i < EYES_PER_WORD ? count - i : EYES_PER_WORD;
        for (size_t e = 0; e < b.count && !bad; e++) bad = view_eye_of(tree, eyes + i + e, from + e, diag);
        if (bad) break;
        const double share = (double)b.count / (double)count;
        status =
            base_run(&task, 0.3 * share, (tree->node_count + NODES_PER_TASK - 1) / NODES_PER_TASK, sides_of_nodes, &b);
        if (!status) status = base_run(&task, 0.7 * share, b.count, order_of_eye, &b);
        b.pieces += b.count * tree->piece_count;
    }
    if (status) status == FROE_E_MEMORY ? support_fail_memory(diag) : support_fail_cancelled(diag);
    for (unsigned i = 0; b.contexts && i < task.threads; i++) num_context_free(b.contexts + i);
    support_free(&tree->alloc, b.contexts, task.threads * sizeof *b.contexts);
    support_free(&tree->alloc, b.sides, tree->node_count * sizeof *b.sides);
    return bad ? bad : status;
}
