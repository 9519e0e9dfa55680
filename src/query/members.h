/* members.h: sets of numbers. One that changes, and many that are kept, equal ones once.
 *
 *     kept     numbers  | 3 7 | 3 | 3 8 9 | ...      set i: numbers[starts[i] .. starts[i+1]), ascending
 */
#ifndef FROE_QUERY_MEMBERS_H
#define FROE_QUERY_MEMBERS_H
#include "scene/table.h"
#include "support/array.h"

/** A set: ascending numbers. */
typedef ARRAY(uint32_t) query_members;

bool query_members_has(const query_members *set, uint32_t number);
/** Takes a number out if it is in, and in if not; or in for good. False without memory. */
bool query_members_flip(query_members *set, const froe_allocator *alloc, uint32_t number);
bool query_members_add(query_members *set, const froe_allocator *alloc, uint32_t number);

typedef struct query_sets {
    query_members numbers;
    ARRAY(uint32_t) starts;
    scene_table table; /**< which set has these members? Needed while sets are added */
} query_sets;

void query_sets_free(query_sets *sets, const froe_allocator *alloc);
/** The number of the set with these members, a new one unless it is there. False without memory. */
bool query_sets_keep(query_sets *sets, const froe_allocator *alloc, const query_members *set, uint32_t *out);
/** Makes a set that changes equal to a kept one. False without memory. */
bool query_sets_copy(const query_sets *sets, const froe_allocator *alloc, uint32_t kept, query_members *out);
#endif
