/* radix.c: least-significant-digit radix sort, one byte a pass (Knuth, TAOCP 3, 5.2.5). */
#include "base/radix.h"
#include <string.h>

enum { DIGITS = 8, BUCKETS = 256 };

static unsigned digit(uint64_t key, int d) {
    return (unsigned)(key >> (8 * d)) & (BUCKETS - 1);
}

/* Moves the pairs to `to`, ordered by digit d, stably. */
static void scatter(const base_pair *from, base_pair *to, size_t count, int d) {
    size_t place[BUCKETS] = {0}, sum = 0;
    for (size_t i = 0; i < count; i++) place[digit(from[i].key, d)]++;
    for (int b = 0; b < BUCKETS; b++) {
        size_t here = place[b];
        place[b] = sum;
        sum += here;
    }
    for (size_t i = 0; i < count; i++) to[place[digit(from[i].key, d)]++] = from[i];
}

void base_radix_sort(base_pair *pairs, base_pair *spare, size_t count) {
    uint64_t varying = 0;
    for (size_t i = 1; i < count; i++) varying |= pairs[i].key ^ pairs[0].key;
    base_pair *from = pairs, *to = spare;
    for (int d = 0; d < DIGITS; d++) {
        if (!digit(varying, d)) continue;
        scatter(from, to, count, d);
        base_pair *sorted = to;
        to = from;
        from = sorted;
    }
    if (from != pairs) memcpy(pairs, from, count * sizeof *pairs);
}

uint64_t base_double_key(double x) {
    uint64_t bits, sign = (uint64_t)1 << 63;
    x += 0.0; /* -0 becomes +0 */
    memcpy(&bits, &x, sizeof bits);
    return bits & sign ? ~bits : bits | sign;
}
