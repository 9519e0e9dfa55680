/* topological.c: Kahn's order (1962), style by style.
 *
 * Nodes that are ready wait in a stack per style, and styles with waiting nodes in a heap by how many wait. The heap's
 * entries are made when a count grows; an entry whose count is not that of the style is old and skipped. */
#include "view/picture/graph.h"

typedef struct heap_entry {
    uint32_t waiting, style;
} heap_entry;

typedef struct style_sorter {
    const froe_allocator *alloc;
    const uint32_t *styles;  /* NULL: all 0 */
    uint32_t *missing;       /* per node: arcs from nodes not painted yet */
    uint32_t *below;         /* per node: the one below it in its stack */
    uint32_t *top, *waiting; /* per style */
    ARRAY(heap_entry) heap;
} style_sorter;

/* More waiting first, then the lower style. */
static bool before(heap_entry a, heap_entry b) {
    return a.waiting != b.waiting ? a.waiting > b.waiting : a.style < b.style;
}

static bool push_style(style_sorter *s, uint32_t style) {
    if (!array_push(s->alloc, &s->heap, (heap_entry){s->waiting[style], style})) return false;
    heap_entry *h = s->heap.data;
    for (size_t i = s->heap.count - 1; i && before(h[i], h[(i - 1) / 2]); i = (i - 1) / 2) {
        const heap_entry swap = h[i];
        h[i] = h[(i - 1) / 2];
        h[(i - 1) / 2] = swap;
    }
    return true;
}

static bool make_ready(style_sorter *s, uint32_t v) {
    const uint32_t style = s->styles ? s->styles[v] : 0;
    s->below[v] = s->top[style];
    s->top[style] = v;
    s->waiting[style]++;
    return push_style(s, style);
}

/* The style to go on with: `now` while anything of it waits, then that of the first entry that is not old. */
static uint32_t next_style(style_sorter *s, uint32_t now) {
    if (now != UINT32_MAX && s->waiting[now]) return now;
    for (;;) {
        heap_entry *h = s->heap.data;
        const heap_entry first = h[0], last = h[--s->heap.count];
        size_t i = 0;
        for (size_t child; (child = 2 * i + 1) < s->heap.count; i = child) {
            if (child + 1 < s->heap.count && before(h[child + 1], h[child])) child++;
            if (!before(h[child], last)) break;
            h[i] = h[child];
        }
        h[i] = last;
        if (s->waiting[first.style] == first.waiting && first.waiting) return first.style;
        if (s->waiting[first.style] && !push_style(s, first.style))
            return UINT32_MAX; /* cannot fail: one was just popped */
    }
}

froe_status view_graph_sort(const froe_allocator *alloc, const view_graph *graph, const uint32_t *styles,
                            uint32_t style_count, uint32_t *order) {
    const size_t n = (size_t)graph->count + 1, m = (size_t)style_count + 1;
    style_sorter s = {.alloc = alloc, .styles = styles};
    s.missing = support_calloc(alloc, n, sizeof *s.missing);
    s.below = support_calloc(alloc, n, sizeof *s.below);
    s.top = support_calloc(alloc, m, sizeof *s.top);
    s.waiting = support_calloc(alloc, m, sizeof *s.waiting);
    bool ok = s.missing && s.below && s.top && s.waiting;
    for (uint32_t v = 0; ok && v < graph->count; v++)
        for (uint32_t i = graph->out_starts[v]; !graph->late[v] && i < graph->out_starts[v + 1]; i++)
            s.missing[graph->outs[i]]++;
    for (uint32_t v = graph->count; ok && v-- > 0;) /* the lowest comes to lie on top */
        if (!s.missing[v]) ok = make_ready(&s, v);
    uint32_t style = UINT32_MAX;
    for (uint32_t k = 0; ok && k < graph->count; k++) {
        style = next_style(&s, style);
        const uint32_t v = order[k] = s.top[style];
        s.top[style] = s.below[v];
        s.waiting[style]--;
        for (uint32_t i = graph->out_starts[v + 1]; ok && !graph->late[v] && i-- > graph->out_starts[v];)
            if (--s.missing[graph->outs[i]] == 0) ok = make_ready(&s, graph->outs[i]);
    }
    support_free(alloc, s.missing, n * sizeof *s.missing);
    support_free(alloc, s.below, n * sizeof *s.below);
    support_free(alloc, s.top, m * sizeof *s.top);
    support_free(alloc, s.waiting, m * sizeof *s.waiting);
    array_free(alloc, &s.heap);
    return ok ? FROE_OK : FROE_E_MEMORY;
}
