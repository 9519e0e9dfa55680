/* settings.h: calls in every floating point that a program may have set, with what came out of them.
 *
 *     static void session(floats_run *r, ...) { ... ASK(r, froe_build(...)); floats_note_file(r, path); ... }
 *     floats_compare(session, user);      // in each of the settings: the same as usual, call by call
 *
 * ASK sets the floating point, makes the call, looks whether it is still set so, and sets the usual one again. The
 * callbacks below look whether theirs is the caller's. */
#ifndef FROE_TESTS_SUPPORT_SETTINGS_H
#define FROE_TESTS_SUPPORT_SETTINGS_H
#include <fenv.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <froe/froe.h>

/* ---------------------------------------------------------------- settings -- */

/* The control register; where the processor is another one, the rounding modes only. */
typedef struct floats_setting {
    const char *name;
    uint32_t mxcsr;
    uint32_t fpcr;
    int rounding;
} floats_setting;

static const floats_setting floats_settings[] = {
    {"as usual", 0x1f80, 0, FE_TONEAREST},
    {"denormals flushed", 0x9fc0, 1u << 24, FE_TONEAREST},
    {"upwards", 0x5f80, 1u << 22, FE_UPWARD},
    {"downwards", 0x3f80, 2u << 22, FE_DOWNWARD},
    {"towards zero", 0x7f80, 3u << 22, FE_TOWARDZERO},
    {"every exception a trap", 0x0000, 0x9f00, FE_TONEAREST},
    {"upwards, flushed, all traps", 0xc040, 0x1409f00, FE_UPWARD},
};
enum { FLOATS_SETTINGS = sizeof floats_settings / sizeof *floats_settings };

#if defined(__x86_64__)
static inline void floats_set(const floats_setting *s) {
    uint32_t word = s->mxcsr;
    __asm__ volatile("ldmxcsr %0" ::"m"(word) : "memory");
}
static inline bool floats_are(const floats_setting *s) {
    uint32_t now;
    __asm__ volatile("stmxcsr %0" : "=m"(now)::"memory");
    return (now & ~0x3fu) == s->mxcsr;
}
#elif defined(__aarch64__) /* traps that a processor does not have read as 0 */
static inline void floats_set(const floats_setting *s) {
    __asm__ volatile("msr fpcr, %0" ::"r"((uint64_t)s->fpcr) : "memory");
}
static inline bool floats_are(const floats_setting *s) {
    uint64_t now;
    __asm__ volatile("mrs %0, fpcr" : "=r"(now)::"memory");
    return (now & ~0x9f00u) == (s->fpcr & ~0x9f00u);
}
#else
static inline void floats_set(const floats_setting *s) {
    fesetround(s->rounding);
}
static inline bool floats_are(const floats_setting *s) {
    return fegetround() == s->rounding;
}
#endif

/* -------------------------------------------------------------------- a run -- */

enum { FLOATS_CALLS = 4096 };

typedef struct floats_run {
    const floats_setting *setting;
    size_t count; /* calls */
    const char *calls[FLOATS_CALLS];
    uint64_t answers[FLOATS_CALLS]; /* a hash of what came out */
    atomic_size_t callbacks, wrong; /* that ran; in another floating point than the caller's */
} floats_run;

static inline void floats_begin(floats_run *r, const char *call) {
    assert_true(r->count < FLOATS_CALLS);
    r->calls[r->count] = call;
    r->answers[r->count++] = 0xcbf29ce484222325u;
    floats_set(r->setting);
}
static inline void floats_end(const floats_run *r, const char *call) {
    const bool kept = floats_are(r->setting);
    floats_set(floats_settings);
    if (!kept) fail_msg("%s: another floating point after %s", r->setting->name, call);
}
/** FNV-1a of bytes, as part of what the last call gave. */
static inline void floats_note(floats_run *r, const void *bytes, size_t size) {
    uint64_t hash = r->answers[r->count - 1];
    for (size_t i = 0; i < size; i++) hash = (hash ^ ((const unsigned char *)bytes)[i]) * 0x100000001b3u;
    r->answers[r->count - 1] = hash;
}
static inline void floats_note_file(floats_run *r, const char *path) {
    char bytes[4096];
    size_t got;
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    while ((got = fread(bytes, 1, sizeof bytes, file))) floats_note(r, bytes, got);
    fclose(file);
}

/** A call without a status. */
#define TELL(r, call) (floats_begin((r), #call), (void)(call), floats_end((r), #call))
/** A call with one, which is part of what came out. */
#define ASK(r, call)                                                                                                   \
    __extension__({                                                                                                    \
        floats_begin((r), #call);                                                                                      \
        const froe_status floats_status = (call);                                                                      \
        floats_end((r), #call);                                                                                        \
        floats_note((r), &floats_status, sizeof floats_status);                                                        \
        floats_status;                                                                                                 \
    })
/** One that must succeed. */
#define MUST(r, call) assert_int_equal(ASK(r, call), FROE_OK)

/* --------------------------------------------------------------- callbacks -- */

static inline void floats_called(void *run) {
    floats_run *r = run;
    atomic_fetch_add(&r->callbacks, 1);
    if (!floats_are(r->setting)) atomic_fetch_add(&r->wrong, 1);
}
static inline bool floats_progress(void *run, double done) {
    (void)done;
    floats_called(run);
    return true;
}
static inline bool floats_bytes(void *run, const void *bytes, size_t count) {
    floats_called(run);
    floats_note(run, bytes, count);
    return true;
}
/* What is freed after the run, with objects that outlive a setting, is not looked at. */
static inline void *floats_memory(void *run, void *ptr, size_t old_size, size_t new_size) {
    floats_run *r = run;
    (void)old_size;
    if (new_size || !floats_are(floats_settings)) floats_called(r);
    if (new_size) return realloc(ptr, new_size);
    free(ptr);
    return NULL;
}

typedef void floats_session(floats_run *r, void *user);

static inline void floats_compare(floats_session *session, void *user) {
    static floats_run runs[FLOATS_SETTINGS];
    for (size_t s = 0; s < FLOATS_SETTINGS; s++) {
        floats_run *r = runs + s;
        memset(r, 0, sizeof *r);
        r->setting = floats_settings + s;
        session(r, user);
        assert_int_equal(r->wrong, 0);
        assert_int_equal(r->count, runs->count);
        for (size_t i = 0; i < r->count; i++)
            if (r->answers[i] != runs->answers[i])
                fail_msg("%s: another answer of call %zu, %s", r->setting->name, i, r->calls[i]);
    }
}
#endif
