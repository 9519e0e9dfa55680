/* pencils.c: see pencils.h. */
#include "build/grain/pencils.h"
#include "base/random.h"
#include <math.h>
#include <string.h>

void split_pencils_begin(split_pencils *t) {
    t->count = 0;
    if (++t->cell) return;
    memset(t->of, 0, sizeof t->of);
    t->cell = 1;
}

split_pencil *split_pencil_at(split_pencils *t, split_axle axle) {
    const uint64_t key = base_mix((uint64_t)axle.low << 32 | axle.high) + axle.few;
    for (uint64_t at = key;; at++) {
        split_pencil *p = t->of + at % SPLIT_PENCILS;
        if (p->cell == t->cell) {
            if (p->axle.low == axle.low && p->axle.high == axle.high && p->axle.few == axle.few) return p;
            continue;
        }
        if (2 * t->count >= SPLIT_PENCILS) return NULL;
        t->count++;
        *p = (split_pencil){.axle = axle, .cell = t->cell, .limit = -INFINITY};
        return p;
    }
}
