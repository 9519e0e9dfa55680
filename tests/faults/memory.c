/* memory.c: what gives memory, and what tells of progress, in a program whose calls of them are led here (--wrap). The
 * parts of the C library that take memory by themselves, and then say ENOMEM, count as well, and so does jansson. What
 * GDAL, assimp and Cairo take does not: they end as docs/reference/errors.md says. */
#define _GNU_SOURCE 1 /* mmap() of memory alone */
#include "faults.h"
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <jansson.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>
#include <unwind.h>

typedef struct counted {
    unsigned at; /* the number of the call with a fault; 0: none */
    int kind;
    atomic_uint calls; /* so far */
} counted;
static counted memory, steps;
static int log_to = -1, places_to = -1;

static atomic_int json_blocks; /* that were given and not taken back */

static void tell(void) {
    if (log_to >= 0)
        dprintf(log_to, "memory %u steps %u reads %u json %d\n", memory.calls, steps.calls, fault_reads.calls,
                json_blocks);
}

/* ------------------------------------------------------------------ places -- */

extern const char __executable_start, etext; /* of the linker: where the code of the program is */

/* Who asks: the innermost functions of the program, those of this file left out. Libraries between them, such as
 * jansson, do not count. */
typedef struct place {
    int functions; /* those of this file count from -3 */
    uint64_t hash;
} place;

static _Unwind_Reason_Code add_function(struct _Unwind_Context *context, void *user) {
    enum { FUNCTIONS = 4 };
    place *p = user;
    const uintptr_t at = (uintptr_t)_Unwind_GetIP(context), begin = (uintptr_t)&__executable_start;
    if (at < begin || at >= (uintptr_t)&etext) return _URC_NO_REASON;
    if (p->functions >= 0) p->hash = (p->hash ^ (at - begin)) * 0x9E3779B97F4A7C15u;
    p->hash ^= p->hash >> 29;
    return ++p->functions < FUNCTIONS ? _URC_NO_REASON : _URC_NORMAL_STOP;
}

static __attribute__((noinline)) void tell_place(unsigned number) {
    place p = {.functions = -3}; /* this one, meets() and that which stands for malloc() */
    _Unwind_Backtrace(add_function, &p);
    dprintf(places_to, "%u %" PRIx64 "\n", number, p.hash);
}

/* Counts a call; true when it shall fail. */
static __attribute__((noinline)) bool meets(counted *c) {
    const unsigned number = atomic_fetch_add(&c->calls, 1) + 1;
    if (c == &memory && places_to >= 0) tell_place(number);
    if (!c->at || number < c->at || (number > c->at && c->kind != FAULT_FOREVER)) return false;
    if (c->kind >= FAULT_INTERRUPT && c->kind <= FAULT_LATE) {
        static const int signals[] = {SIGINT, SIGTERM, SIGALRM};
        raise(signals[c->kind - FAULT_INTERRUPT]);
        return false;
    }
    errno = ENOMEM;
    return true;
}

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
    return meets(&memory) ? NULL : __real_malloc(size);
}

void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size) {
    return meets(&memory) ? NULL : __real_calloc(count, size);
}

void *__real_realloc(void *block, size_t size);
void *__wrap_realloc(void *block, size_t size);
void *__wrap_realloc(void *block, size_t size) {
    return meets(&memory) ? NULL : __real_realloc(block, size);
}

char *__real_strdup(const char *text);
char *__wrap_strdup(const char *text);
char *__wrap_strdup(const char *text) {
    return meets(&memory) ? NULL : __real_strdup(text);
}

char *__real_strndup(const char *text, size_t most);
char *__wrap_strndup(const char *text, size_t most);
char *__wrap_strndup(const char *text, size_t most) {
    return meets(&memory) ? NULL : __real_strndup(text, most);
}

int __wrap_open(const char *path, int flags, ...);
FILE *__real_fopen(const char *path, const char *mode);
FILE *__wrap_fopen(const char *path, const char *mode);
FILE *__wrap_fopen(const char *path, const char *mode) {
    if (meets(&memory)) return NULL;
    return *mode == 'r' ? fault_stream(__wrap_open(path, O_RDONLY | O_CLOEXEC)) : __real_fopen(path, mode);
}

FILE *__real_open_memstream(char **text, size_t *size);
FILE *__wrap_open_memstream(char **text, size_t *size);
FILE *__wrap_open_memstream(char **text, size_t *size) {
    return meets(&memory) ? NULL : __real_open_memstream(text, size);
}

ssize_t __real_getline(char **line, size_t *size, FILE *file);
ssize_t __wrap_getline(char **line, size_t *size, FILE *file);
ssize_t __wrap_getline(char **line, size_t *size, FILE *file) {
    return meets(&memory) ? -1 : __real_getline(line, size, file);
}

void *__real_mmap(void *at, size_t size, int rights, int flags, int file, off_t offset);
void *__wrap_mmap(void *at, size_t size, int rights, int flags, int file, off_t offset);
void *__wrap_mmap(void *at, size_t size, int rights, int flags, int file, off_t offset) {
    if (meets(&memory) || (file >= 0 && fault_reading_fails("mmap"))) return MAP_FAILED;
    return __real_mmap(at, size, rights, flags, file, offset);
}

int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *user);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *user);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *user) {
    return meets(&memory) ? EAGAIN : __real_pthread_create(thread, attributes, run, user);
}

bool __real_cli_progress_step(void *progress, double done);
bool __wrap_cli_progress_step(void *progress, double done);
bool __wrap_cli_progress_step(void *progress, double done) {
    (void)meets(&steps);
    return __real_cli_progress_step(progress, done);
}

static json_malloc_t json_give;
static json_free_t json_take;

static void *give(size_t size) {
    void *block = json_give(size);
    if (block) atomic_fetch_add(&json_blocks, 1);
    return block;
}

static void take(void *block) {
    if (block) atomic_fetch_sub(&json_blocks, 1);
    json_take(block);
}

/* What the program sets is called by what counts. */
void __real_json_set_alloc_funcs(json_malloc_t malloc_fn, json_free_t free_fn);
void __wrap_json_set_alloc_funcs(json_malloc_t malloc_fn, json_free_t free_fn);
void __wrap_json_set_alloc_funcs(json_malloc_t malloc_fn, json_free_t free_fn) {
    json_give = malloc_fn, json_take = free_fn;
    __real_json_set_alloc_funcs(give, take);
}

static void read_plan(const char *name, counted *c) {
    const char *plan = getenv(name);
    if (plan && sscanf(plan, "%u %d", &c->at, &c->kind) != 2) c->at = 0;
}

/* Only what main() calls is counted and fails. What runs before and after it belongs to compilers, such as what counts
 * branches for scripts/coverage. */
static void begin(void) {
    const char *log = getenv("FROE_FAULT_COUNTS"), *places = getenv("FROE_FAULT_PLACES");
    memory.calls = 0;
    fault_reads.calls = 0;
    fault_plan_read(&fault_reads, "FROE_FAULT_READS");
    read_plan("FROE_FAULT_MEMORY", &memory);
    read_plan("FROE_FAULT_STEPS", &steps);
    if (log) log_to = atoi(log);
    if (places) places_to = atoi(places);
    stdin = fault_stream(STDIN_FILENO);
    __wrap_json_set_alloc_funcs(__wrap_malloc, free);
}

static void end(void) {
    tell();
    memory.at = steps.at = faults.at = fault_reads.at = 0;
    faults.log = places_to = -1;
}

int __real_main(int argc, char **argv);
int __wrap_main(int argc, char **argv);
int __wrap_main(int argc, char **argv) {
    begin();
    atexit(end);
    return __real_main(argc, argv);
}
