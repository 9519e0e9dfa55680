/* marks.h: which objects has this query looked at already?
 *
 *     few      a table of 256 entries of (query, object) that stays in the first-level cache
 *     many     the number of the query that looked at it last, for every object of the scene
 *
 * A query begins with the table and moves to the numbers, which are taken when first needed, when it
 * fills. Entries of older queries are free, so a new query number clears the table. */
#ifndef FROE_QUERY_MARKS_H
#define FROE_QUERY_MARKS_H
#include "support/alloc.h"

enum { QUERY_FEW = 256, QUERY_FEW_MOST = 128 };

typedef struct query_marks {
    uint32_t query; /**< > 0 */
    uint32_t count; /**< entries of the table that belong to it */
    bool many;      /**< has it moved to the numbers? */
    size_t size;    /**< of numbers */
    uint32_t *numbers;
    struct {
        uint32_t query, object;
    } few[QUERY_FEW];
} query_marks;

/** Forgets all objects. */
void query_marks_clear(query_marks *marks);
void query_marks_free(query_marks *marks, const froe_allocator *alloc);
/** Moves to the numbers. False without memory. */
bool query_marks_spread(query_marks *marks, const froe_allocator *alloc, size_t objects);

/** Room for `count` more objects. False without memory. */
static inline bool query_marks_reserve(query_marks *marks, const froe_allocator *alloc, size_t objects, size_t count) {
    return marks->many || marks->count + count <= QUERY_FEW_MOST || query_marks_spread(marks, alloc, objects);
}

/** Where the table has an object, unless others are there (Fibonacci hashing, Knuth 6.4). */
static inline uint32_t query_mark_place(uint32_t object) {
    return (object * 0x9e3779b9u) >> 24;
}

/** Marks an object: is it the first time? REQUIRES: room. */
static inline bool query_mark(query_marks *marks, uint32_t object) {
    if (marks->many) {
        bool first = marks->numbers[object] != marks->query;
        marks->numbers[object] = marks->query;
        return first;
    }
    uint32_t at = query_mark_place(object);
    while (marks->few[at].query == marks->query) {
        if (marks->few[at].object == object) return false;
        at = (at + 1) % QUERY_FEW;
    }
    marks->few[at].query = marks->query;
    marks->few[at].object = object;
    marks->count++;
    return true;
}

/** Marks the objects of an array, every stride-th number of it, and copies those that were not marked; how many. There
 * is room for all in `out`. REQUIRES: room. */
static inline size_t query_mark_all(query_marks *marks, const uint32_t *objects, size_t stride, size_t count,
                                    uint32_t *out) {
    size_t fresh = 0;
    const uint32_t query = marks->query;
    if (!marks->many) {
        for (size_t i = 0; i < count;
             i++) { /* which are marked is unpredictable, so branch-free but for others there */
            const uint32_t object = objects[i * stride], at = query_mark_place(object);
            const bool first = marks->few[at].query != query;
            out[fresh] = object;
            if (!first && marks->few[at].object != object) {
                fresh += query_mark(marks, object);
                continue;
            }
            marks->few[at].query = query;
            marks->few[at].object = object;
            marks->count += first;
            fresh += first;
        }
        return fresh;
    }
    uint32_t *numbers = marks->numbers;
    for (size_t i = 0; i < count; i++) {
        const uint32_t object = objects[i * stride];
        out[fresh] = object;
        fresh += numbers[object] != query;
        numbers[object] = query;
    }
    return fresh;
}
#endif
