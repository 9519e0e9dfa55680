/* marks.c: a new query number, and the move from the table to the numbers. */
#include "query/marks.h"
#include <string.h>

void query_marks_clear(query_marks *marks) {
    marks->count = 0;
    marks->many = false;
    if (++marks->query) return;
    memset(marks->few, 0, sizeof marks->few); /* after 2^32 queries */
    if (marks->numbers) memset(marks->numbers, 0, marks->size * sizeof *marks->numbers);
    marks->query = 1;
}

void query_marks_free(query_marks *marks, const froe_allocator *alloc) {
    support_free(alloc, marks->numbers, marks->size * sizeof *marks->numbers);
}

bool query_marks_spread(query_marks *marks, const froe_allocator *alloc, size_t objects) {
    if (!marks->numbers) {
        marks->numbers = support_calloc(alloc, objects, sizeof *marks->numbers);
        if (!marks->numbers) return false;
        marks->size = objects;
    }
    for (size_t i = 0; i < QUERY_FEW; i++)
        if (marks->few[i].query == marks->query) marks->numbers[marks->few[i].object] = marks->query;
    marks->many = true;
    return true;
}
