/* graph.c: arcs in both directions, and the breaking of cycles. */
#include "view/picture/graph.h"
#include "base/radix.h"
#include <string.h>

/* ------------------------------------------------------------------------- arcs -- */

/* Lists one end of the arcs by the other; stable, so that lists ascend. */
static void list(const graph_arc *arcs, size_t count, uint32_t nodes, bool by_from, uint32_t *starts, uint32_t *ends) {
    for (size_t i = 0; i < count; i++) starts[(by_from ? arcs[i].from : arcs[i].to) + 1]++;
    for (uint32_t v = 0; v < nodes; v++) starts[v + 1] += starts[v];
    for (size_t i = count; i-- > 0;) {
        const uint32_t key = by_from ? arcs[i].from : arcs[i].to;
        ends[--starts[key + 1]] = by_from ? arcs[i].to : arcs[i].from;
    }
    for (uint32_t v = 0; v < nodes; v++) starts[v] = starts[v + 1]; /* ends were lowered to the starts */
    starts[nodes] = (uint32_t)count;
}

/* Copies arcs in the order of one end, stably. `starts`: nodes + 1 zeros, which it leaves changed. */
static void deal_arcs(const graph_arc *arcs, size_t count, uint32_t nodes, bool by_from, uint32_t *starts,
                      graph_arc *out) {
    for (size_t i = 0; i < count; i++) starts[by_from ? arcs[i].from : arcs[i].to]++;
    for (uint32_t v = 0; v < nodes; v++) starts[v + 1] += starts[v]; /* ends, which filling lowers */
    for (size_t i = count; i-- > 0;) out[--starts[by_from ? arcs[i].from : arcs[i].to]] = arcs[i];
}

/* Sorts arcs by where they come from, then by where they lead. */
static bool sort_arcs(const froe_allocator *alloc, graph_arc *arcs, size_t count, uint32_t nodes) {
    const size_t room = (size_t)nodes + 1;
    graph_arc *spare = support_calloc(alloc, count + 1, sizeof *spare);
    uint32_t *starts = support_calloc(alloc, 2 * room, sizeof *starts);
    const bool ok = spare && starts;
    if (ok) {
        deal_arcs(arcs, count, nodes, false, starts, spare);
        deal_arcs(spare, count, nodes, true, starts + room, arcs);
    }
    support_free(alloc, spare, (count + 1) * sizeof *spare);
    support_free(alloc, starts, 2 * room * sizeof *starts);
    return ok;
}

froe_status view_graph_new(const froe_allocator *alloc, uint32_t nodes, graph_arc *arcs, size_t arc_count,
                           view_graph *out) {
    *out = (view_graph){.count = nodes};
    if (arc_count > INT32_MAX) return FROE_E_LIMIT;
    size_t kept = 0; /* arcs sorted by (from, to), without repetitions */
    if (!sort_arcs(alloc, arcs, arc_count, nodes)) return FROE_E_MEMORY;
    for (size_t i = 0; i < arc_count; i++)
        if (i == 0 || arcs[i].from != arcs[i - 1].from || arcs[i].to != arcs[i - 1].to) arcs[kept++] = arcs[i];
    out->arc_count = (uint32_t)kept;
    out->out_starts = support_calloc(alloc, (size_t)nodes + 2, sizeof *out->out_starts);
    out->in_starts = support_calloc(alloc, (size_t)nodes + 2, sizeof *out->in_starts);
    out->outs = support_calloc(alloc, kept + 1, sizeof *out->outs);
    out->ins = support_calloc(alloc, kept + 1, sizeof *out->ins);
    out->late = support_calloc(alloc, (size_t)nodes + 1, 1);
    if (!out->out_starts || !out->in_starts || !out->outs || !out->ins || !out->late) return FROE_E_MEMORY;
    list(arcs, kept, nodes, true, out->out_starts, out->outs);
    list(arcs, kept, nodes, false, out->in_starts, out->ins);
    return FROE_OK;
}

void view_graph_drop(const froe_allocator *alloc, view_graph *g) {
    const size_t nodes = g->count, arcs = g->arc_count;
    support_free(alloc, g->out_starts, (nodes + 2) * sizeof *g->out_starts);
    support_free(alloc, g->in_starts, (nodes + 2) * sizeof *g->in_starts);
    support_free(alloc, g->outs, (arcs + 1) * sizeof *g->outs);
    support_free(alloc, g->ins, (arcs + 1) * sizeof *g->ins);
    g->out_starts = g->in_starts = g->outs = g->ins = NULL;
}

void view_graph_free(const froe_allocator *alloc, view_graph *g) {
    view_graph_drop(alloc, g);
    support_free(alloc, g->late, (size_t)g->count + 1);
    *g = (view_graph){0};
}

/* --------------------------------------------------------------------- circles -- */

/* Sets of nodes yet to be searched lie on a stack, one after the other; `set` holds for each node its set, so
 * that a search stays in its own. Every component of more than one node loses some nodes and is a new set. */
typedef struct breaker {
    const froe_allocator *alloc;
    view_graph *g;
    const uint8_t *fixed;
    ARRAY(uint32_t) nodes;  /* of all sets */
    ARRAY(uint32_t) sets;   /* where each begins in nodes */
    ARRAY(base_pair) calls; /* Tarjan's recursion: node, and the arc it is at */
    ARRAY(uint32_t) stack;  /* Tarjan's stack */
    ARRAY(uint32_t) found;  /* components of more than one node, one after the other */
    ARRAY(uint32_t) found_starts;
    uint32_t *set, *index, *low; /* per node; index 0: not met yet */
    uint8_t *on_stack;
    uint32_t set_number, counter;
    bool first_round;
} breaker;

static bool enter_vertex(breaker *b, uint32_t v) {
    b->index[v] = b->low[v] = ++b->counter;
    b->on_stack[v] = 1;
    return array_push(b->alloc, &b->stack, v) && array_push(b->alloc, &b->calls, (base_pair){b->g->out_starts[v], v});
}

/* All components that the root reaches within its set; those of several nodes are kept. */
static bool search_components(breaker *b, uint32_t root) {
    if (!enter_vertex(b, root)) return false;
    while (b->calls.count) {
        base_pair *top = b->calls.data + b->calls.count - 1;
        const uint32_t v = top->value;
        if (top->key < b->g->out_starts[v + 1]) {
            const uint32_t w = b->g->outs[top->key++];
            if (b->set[w] != b->set_number) continue;
            if (!b->index[w]) {
                if (!enter_vertex(b, w)) return false;
            } else if (b->on_stack[w] && b->index[w] < b->low[v]) {
                b->low[v] = b->index[w];
            }
            continue;
        }
        b->calls.count--;
        if (b->calls.count) {
            const uint32_t u = b->calls.data[b->calls.count - 1].value;
            if (b->low[v] < b->low[u]) b->low[u] = b->low[v];
        }
        if (b->low[v] != b->index[v]) continue;
        size_t first = b->stack.count; /* the component of v is on top of the stack */
        do b->on_stack[b->stack.data[--first]] = 0;
        while (b->stack.data[first] != v);
        const size_t size = b->stack.count - first;
        if (size > 1 && (!array_push(b->alloc, &b->found_starts, (uint32_t)b->found.count) ||
                         !array_reserve(b->alloc, &b->found, size)))
            return false;
        for (size_t i = first; size > 1 && i < b->stack.count; i++) b->found.data[b->found.count++] = b->stack.data[i];
        b->stack.count = first;
    }
    return true;
}

static uint64_t degree(const breaker *b, const uint32_t *starts, const uint32_t *ends, uint32_t v) {
    uint64_t count = 0;
    for (uint32_t i = starts[v]; i < starts[v + 1]; i++) count += b->set[ends[i]] == b->set_number;
    return count;
}

/* Makes the best nodes of a component late: one, and of large components some more, since each round costs a search. */
static bool choose_late(breaker *b, const uint32_t *nodes, size_t count) {
    const view_graph *g = b->g;
    const size_t wanted = 1 + count / 512;
    base_pair *best = support_calloc(b->alloc, 2 * count, sizeof *best);
    if (!best) return false;
    b->set_number++;
    for (size_t i = 0; i < count; i++) b->set[nodes[i]] = b->set_number;
    for (size_t i = 0; i < count; i++) {
        const uint64_t ways = degree(b, g->out_starts, g->outs, nodes[i]) * degree(b, g->in_starts, g->ins, nodes[i]);
        const bool fixed = b->fixed && b->fixed[nodes[i]];
        best[i] = (base_pair){fixed ? UINT64_MAX : UINT64_MAX - ways, nodes[i]};
    }
    for (size_t i = 1; i < count && wanted == 1; i++) /* the least key, then the least number, comes first */
        if (best[i].key < best[0].key || (best[i].key == best[0].key && best[i].value < best[0].value)) {
            const base_pair swap = best[0];
            best[0] = best[i];
            best[i] = swap;
        }
    if (wanted > 1) base_radix_sort(best, best + count, count);
    for (size_t i = 0; i < wanted && (i == 0 || best[i].key < UINT64_MAX); i++) {
        b->g->late[best[i].value] = 1;
        b->g->late_count++;
        b->set[best[i].value] = 0;
    }
    support_free(b->alloc, best, 2 * count * sizeof *best);
    return true;
}

/* Takes the topmost set: finds its components, and leaves those of several nodes, less the late ones, to be searched.
 */
static bool break_set(breaker *b) {
    const size_t first = b->sets.data[--b->sets.count], end = b->nodes.count;
    b->set_number++;
    b->found.count = b->found_starts.count = 0;
    for (size_t i = first; i < end; i++) {
        b->set[b->nodes.data[i]] = b->set_number;
        b->index[b->nodes.data[i]] = 0;
    }
    for (size_t i = first; i < end; i++)
        if (!b->index[b->nodes.data[i]] && !search_components(b, b->nodes.data[i])) return false;
    b->nodes.count = first;
    if (b->first_round) b->g->cyclic = (uint32_t)b->found.count;
    b->first_round = false;
    if (!array_push(b->alloc, &b->found_starts, (uint32_t)b->found.count)) return false;
    for (size_t c = 0; c + 1 < b->found_starts.count; c++) {
        const uint32_t *nodes = b->found.data + b->found_starts.data[c];
        const size_t count = b->found_starts.data[c + 1] - b->found_starts.data[c];
        if (!choose_late(b, nodes, count) || !array_push(b->alloc, &b->sets, (uint32_t)b->nodes.count) ||
            !array_reserve(b->alloc, &b->nodes, count))
            return false;
        for (size_t i = 0; i < count; i++) /* the rest of the component becomes a set to be searched */
            if (!b->g->late[nodes[i]]) b->nodes.data[b->nodes.count++] = nodes[i];
    }
    return true;
}

froe_status view_graph_break(const froe_allocator *alloc, view_graph *graph, const uint8_t *fixed) {
    const size_t n = (size_t)graph->count + 1;
    breaker b = {.alloc = alloc, .g = graph, .fixed = fixed, .first_round = true};
    b.set = support_calloc(alloc, n, sizeof *b.set);
    b.index = support_calloc(alloc, n, sizeof *b.index);
    b.low = support_calloc(alloc, n, sizeof *b.low);
    b.on_stack = support_calloc(alloc, n, 1);
    bool ok = b.set && b.index && b.low && b.on_stack && array_push(alloc, &b.sets, 0) &&
              array_reserve(alloc, &b.nodes, graph->count);
    for (uint32_t v = 0; ok && v < graph->count; v++) b.nodes.data[b.nodes.count++] = v;
    while (ok && b.sets.count) ok = break_set(&b);
    support_free(alloc, b.set, n * sizeof *b.set);
    support_free(alloc, b.index, n * sizeof *b.index);
    support_free(alloc, b.low, n * sizeof *b.low);
    support_free(alloc, b.on_stack, n);
    array_free(alloc, &b.nodes);
    array_free(alloc, &b.sets);
    array_free(alloc, &b.calls);
    array_free(alloc, &b.stack);
    array_free(alloc, &b.found);
    array_free(alloc, &b.found_starts);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
