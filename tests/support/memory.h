/* memory.h: an allocator that counts, checks the sizes it is told, and fails on demand.
 *
 *     test_memory m;  froe_allocator a = test_memory_begin(&m);
 *     ...  test_memory_end(&m);                          // nothing leaked
 *
 *     test_memory_each(call, user);                      // every allocation failing in turn
 *
 * Thread-safe. Blocks carry their size in front, so a wrong old_size is caught at once. */
#ifndef FROE_TESTS_SUPPORT_MEMORY_H
#define FROE_TESTS_SUPPORT_MEMORY_H
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>
#include <froe/froe.h>

typedef struct test_memory {
    atomic_size_t calls;  /**< blocks asked for so far, growing included */
    atomic_size_t blocks; /**< live */
    atomic_size_t bytes;  /**< live */
    atomic_size_t peak;   /**< most bytes ever live (approximately, with threads) */
    size_t fail_at;       /**< the call that fails, counted from 1; 0: none */
    bool fail_on;         /**< and all after it */
} test_memory;

static inline void *test_memory_fn(void *user, void *ptr, size_t old_size, size_t new_size) {
    test_memory *m = user;
    max_align_t *head = ptr ? (max_align_t *)ptr - 1 : NULL;
    assert_true(!head || *(size_t *)(void *)head == old_size);
    assert_true(head || old_size == 0);
    if (new_size) {
        size_t call = atomic_fetch_add(&m->calls, 1) + 1;
        if (m->fail_at && (call == m->fail_at || (m->fail_on && call > m->fail_at))) return NULL;
        head = realloc(head, sizeof *head + new_size);
        assert_non_null(head);
        *(size_t *)(void *)head = new_size;
        if (!ptr) atomic_fetch_add(&m->blocks, 1);
    } else if (head) {
        free(head);
        head = NULL;
        atomic_fetch_sub(&m->blocks, 1);
    }
    atomic_fetch_add(&m->bytes, new_size - old_size);
    if (m->bytes > m->peak) m->peak = m->bytes;
    return head ? head + 1 : NULL;
}

static inline froe_allocator test_memory_begin(test_memory *m) {
    *m = (test_memory){.fail_at = 0};
    return (froe_allocator){test_memory_fn, m};
}

static inline void test_memory_end(test_memory *m) {
    assert_int_equal(m->blocks, 0);
    assert_int_equal(m->bytes, 0);
}

/** A scenario: uses `alloc` for everything, frees all it made, returns the first failure. */
typedef froe_status test_memory_call(void *user, const froe_allocator *alloc);

/** Runs the call once undisturbed (it must succeed), then once with each of its allocations
 * failing alone, then with each and all later ones failing: the status must be FROE_E_MEMORY, or
 * FROE_OK where the call found another way, and nothing may leak. Returns the number of allocations. */
static inline size_t test_memory_each(test_memory_call *call, void *user) {
    test_memory m;
    froe_allocator alloc = test_memory_begin(&m);
    assert_int_equal(call(user, &alloc), FROE_OK);
    test_memory_end(&m);
    size_t calls = m.calls;
    for (size_t i = 0; i < 2 * calls; i++) {
        test_memory_begin(&m);
        m.fail_at = 1 + i / 2;
        m.fail_on = i % 2;
        froe_status status = call(user, &alloc);
        assert_true(status == FROE_OK || status == FROE_E_MEMORY);
        test_memory_end(&m);
    }
    return calls;
}
#endif
