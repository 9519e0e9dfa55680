/* test_queue.c: the queue of what fails next, against a table of ticks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "kinetic/certificate/queue.h"
#include "support/fuzz.h"
#include "support/memory.h"

enum { IDS = 300 };

typedef struct table {
    bool is_in[IDS];
    int64_t tick[IDS];
} table;

static void check_queue(const froe_allocator *alloc, queue_heap *queue, const table *t, int64_t tick) {
    size_t count = 0, due = 0;
    int64_t first = INT64_MAX;
    bool seen[IDS] = {false};
    for (int id = 0; id < IDS; id++) {
        count += t->is_in[id];
        due += t->is_in[id] && t->tick[id] <= tick;
        if (t->is_in[id] && t->tick[id] < first) first = t->tick[id];
    }
    assert_int_equal(queue->entries.count, count);
    if (count) assert_true(queue->entries.data[0].tick == first);
    assert_true(queue_find_due(alloc, queue, tick));
    assert_int_equal(queue->due.count, due);
    for (size_t i = 0; i < due; i++) {
        const uint32_t id = queue->due.data[i];
        assert_true(t->is_in[id] && t->tick[id] <= tick && !seen[id]);
        seen[id] = true;
    }
}

static void test_the_first_is_on_top_and_all_that_are_due_are_found(void **state) {
    (void)state;
    fuzz_source r = {7};
    test_memory memory;
    const froe_allocator alloc = test_memory_begin(&memory);
    static const int spans[] = {3, 40, 100000}; /* many ticks alike, some, hardly any */
    for (int s = 0; s < 3; s++) {
        queue_heap queue = {0};
        table t = {.tick = {0}};
        assert_true(queue_reserve(&alloc, &queue, IDS));
        for (int step = 0; step < 4000; step++) {
            const uint32_t id = (uint32_t)fuzz_int(&r, 0, IDS - 1);
            if (fuzz_int(&r, 0, 2)) {
                t.is_in[id] = true, t.tick[id] = fuzz_int(&r, 0, spans[s]);
                queue_set(&queue, id, t.tick[id]);
            } else { /* also of numbers that are not there */
                t.is_in[id] = false;
                queue_remove(&queue, id);
            }
            check_queue(&alloc, &queue, &t, fuzz_int(&r, -1, spans[s] / 2));
        }
        queue_free(&alloc, &queue);
    }
    test_memory_end(&memory);
}

static void test_ticks_come_in_order(void **state) {
    (void)state;
    fuzz_source r = {8};
    const froe_allocator alloc = support_allocator(NULL);
    queue_heap queue = {0};
    assert_true(queue_reserve(&alloc, &queue, IDS));
    for (uint32_t id = 0; id < IDS; id++) queue_set(&queue, id, fuzz_int(&r, 0, 99));
    for (int64_t last = 0; queue.entries.count;) {
        const queue_entry first = queue.entries.data[0];
        assert_true(first.tick >= last);
        last = first.tick;
        queue_remove(&queue, first.id);
    }
    queue_free(&alloc, &queue);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_first_is_on_top_and_all_that_are_due_are_found),
        cmocka_unit_test(test_ticks_come_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
