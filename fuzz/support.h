/* support.h: what fuzzers share: bytes as a stream of decisions, and bytes as a file. */
#ifndef FROE_FUZZ_SUPPORT_H
#define FROE_FUZZ_SUPPORT_H
#include <froe/froe.h>
#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/** Input still to be used. At its end there are zeros. */
typedef struct fuzz_bytes {
    const uint8_t *data;
    size_t size;
} fuzz_bytes;

static inline uint8_t fuzz_byte(fuzz_bytes *bytes) {
    if (bytes->size == 0) return 0;
    bytes->size--;
    return *bytes->data++;
}
/** Mostly small whole numbers, so that things meet; now and then any double at all. */
double fuzz_double(fuzz_bytes *bytes);

/** Adds a batch of objects of one kind. Refusals are fine. */
void fuzz_add_batch(froe_scene *scene, fuzz_bytes *bytes);

/** Says what is wrong, and ends the program so that fuzzers notice. */
_Noreturn void fuzz_complain(const char *what, const froe_diagnostic *why);

/** Writes a prefix and then the data into a new file under the folder TMPDIR, whose name
 * goes into path; ends the program when that is not possible. Remove it after use. */
void fuzz_file(const char *prefix, const char *suffix, const uint8_t *data, size_t size, char *path, size_t capacity);
#endif
