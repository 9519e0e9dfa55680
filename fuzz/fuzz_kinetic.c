/* fuzz_kinetic.c: bytes as what happens to a partition in motion: segments come, go, and get other plans, several at
 * one instant. After each change it is what the oracle of tests/oracle/present.h makes of the same segments, and so are
 * its answers. */
#include "kinetic/changing.h"
#include "support.h"

enum { MOST_BYTES = 600, STEPS = 60 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    changing c = {.data = data, .size = size < MOST_BYTES ? size : MOST_BYTES, .questions = 2};
    if (changing_run(&c, STEPS)) return 0;
    fprintf(stderr, "%s\n", c.all.why);
    abort();
}
