/* race.c: froe and other programs answer the same questions in one process, in turns.
 *
 *     bench_race [--froe LIST] [--alone] [--clock] [--makings] [--peers FOLDER] KIND:SCENE:N...
 *
 * KIND is points, segments, trapezoids, triangles, boxes or areas; SCENE a kind of scene or a file (scene.c). LIST
 * holds ways of using froe, separated by commas (race.h); --alone leaves other programs out; --clock measures the time
 * that passes, for several threads, instead of processor time; --makings asks nothing.
 *
 * In each round all take turns, and each answers another share of the questions, so that nothing is warm of what was
 * asked before; in the end each has answered all. The clock runs from the caller's arrays to the answers in the
 * caller's arrays. Making counts all that a program does with the objects before it can answer; all pairs count making,
 * too. Memory that was freed is given back to the system before each making, as if the program had just been started.
 *
 * Prints lines of results (bench/README.md). Exits with 1 if answers differ. A program that computes in single
 * precision may differ in one of a thousand answers; the note says in how many it does. */
#include "race.h"
#include "bench.h"
#include "json.h"
#include <dirent.h>
#include <dlfcn.h>
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct run {
    peer_kind kind;
    const char *what; /* "segments" */
    race_scene scene;
    peer_data data;
    race_contestant contestants[RACE_MOST];
    size_t count;
    const race_task *tasks;
    bool differ;
} run;

static struct options {
    const char *froe, *folder;
    bool alone, clock, makings;
} options;

/* --------------------------------------------------------------------- tasks -- */

static const race_task plane_tasks[] = {
    {.name = "window of 10", .work = PEER_WINDOW, .share = 10000, .k = 1, .wanted = 10},
    {.name = "window of 1000", .work = PEER_WINDOW, .share = 400, .k = 1, .wanted = 1000},
    {.name = "window of 10000", .work = PEER_WINDOW, .share = 40, .k = 1, .wanted = 10000},
    {.name = "window of 100000", .work = PEER_WINDOW, .share = 4, .k = 1, .wanted = 100000},
    {.name = "segment above", .work = PEER_ABOVE, .share = 20000, .k = 1},
    {.name = "nearest", .work = PEER_NEAREST, .share = 4000, .k = 1},
    {.name = "10 nearest", .work = PEER_NEAREST_K, .share = 2000, .k = 10},
    {.name = "all pairs", .work = PEER_PAIRS, .share = 1, .k = 2},
    {.name = NULL}};
static const race_task trapezoid_tasks[] = {{.name = "segment above", .work = PEER_ABOVE, .share = 5000, .k = 1},
                                            {.name = NULL}};
static const race_task space_tasks[] = {
    {.name = "first hit", .work = PEER_FIRST_HIT, .share = 4000, .k = 1},
    {.name = "any hit", .work = PEER_ANY_HIT, .share = 4000, .k = 1},
    {.name = "nearest", .work = PEER_NEAREST, .share = 2000, .k = 1},
    {.name = "window of 10", .work = PEER_WINDOW, .share = 4000, .k = 1, .wanted = 10},
    {.name = "window of 1000", .work = PEER_WINDOW, .share = 200, .k = 1, .wanted = 1000},
    {.name = NULL}};
static const race_task point_tasks[] = {
    {.name = "nearest", .work = PEER_NEAREST, .share = 10000, .k = 1},
    {.name = "10 nearest", .work = PEER_NEAREST_K, .share = 4000, .k = 10},
    {.name = "ball of 10", .work = PEER_BALL, .share = 5000, .k = 1, .wanted = 10},
    {.name = "ball of 1000", .work = PEER_BALL, .share = 500, .k = 1, .wanted = 1000},
    {.name = "ball of 1000, within a tenth", .work = PEER_FUZZY, .share = 500, .k = 1, .wanted = 1000, .eps = 0.1},
    {.name = "ball of 1000, within its radius", .work = PEER_FUZZY, .share = 500, .k = 1, .wanted = 1000, .eps = 1},
    {.name = NULL}};
static const race_task box_tasks[] = {
    {.name = "window of 10", .work = PEER_WINDOW, .share = 4000, .k = 1, .wanted = 10},
    {.name = "window of 1000", .work = PEER_WINDOW, .share = 200, .k = 1, .wanted = 1000},
    {.name = NULL}};
static const race_task area_tasks[] = {{.name = "area of a point", .work = PEER_AREA, .share = 20000, .k = 1},
                                       {.name = NULL}};

/* By what is made of what; the first way of using froe is the ordinary one. */
static const struct {
    const char *name, *froe;
    const race_task *tasks;
} kinds[PEER_KINDS] = {{"points", "index,bar/32", point_tasks},        {"segments", "index", plane_tasks},
                       {"trapezoids", "cylindrical", trapezoid_tasks}, {"triangles", "index", space_tasks},
                       {"boxes", "index,directional", box_tasks},      {"areas", "index", area_tasks}};

/* -------------------------------------------------------------------- output -- */

static double now(void) {
    return options.clock ? bench_now() : bench_cpu();
}

static void put(const run *r, const char *work, const char *program, const char *measure, const double *values,
                size_t count, const char *note) {
    char full[96];
    snprintf(full, sizeof full, "%s: %s", r->what, work);
    json_line(&(json_result){full, r->scene.name, r->data.count, program, measure, values, count, note});
}

/* ---------------------------------------------------------------------- making -- */

/* A number of the kernel for this process, in kilobytes: VmRSS, what is in memory now; VmHWM, the most there was. */
static double resident(const char *name) {
    char line[256];
    double kilobytes = 0;
    FILE *f = fopen("/proc/self/status", "r");
    while (f && fgets(line, sizeof line, f))
        if (!strncmp(line, name, strlen(name))) kilobytes = strtod(line + strlen(name) + 1, NULL);
    if (f) fclose(f);
    return kilobytes;
}

static void forget_most(void) {
    FILE *f = fopen("/proc/self/clear_refs", "w");
    if (f) fputs("5", f), fclose(f);
}

typedef struct making {
    double seconds[RACE_MAKES], steps[2][RACE_MAKES], bytes[RACE_MAKES], peak[RACE_MAKES];
} making;

static void make_one(run *r, race_contestant *c, making *m, int round) {
    const double each = 1024 / (double)r->data.count;
    if (c->index) c->peer->free(c->index);
    malloc_trim(0);
    forget_most();
    const double before = resident("VmRSS"), start = now();
    c->index = c->peer->make(&r->data, c->peer);
    m->seconds[round] = now() - start;
    m->peak[round] = each * (resident("VmHWM") - before);
    malloc_trim(0);
    m->bytes[round] = each * (resident("VmRSS") - before);
    double steps[2] = {0, 0};
    if (c->peer->steps) c->peer->steps(c->index, steps);
    for (int k = 0; k < 2; k++) m->steps[k][round] = steps[k];
}

/* What finds pairs and nothing else makes no index that is worth a row. */
static bool makes_index(const run *r, const peer *p) {
    for (const race_task *t = r->tasks; t->name; t++)
        if (t->work != PEER_PAIRS && p->serves(&r->data, t->work)) return true;
    return false;
}

static void race_makings(run *r) {
    making *all = bench_take(r->count, sizeof *all);
    for (int round = 0; round < RACE_MAKES; round++)
        for (size_t i = 0; i < r->count; i++) {
            const size_t at = (i + (size_t)round) % r->count;
            if (makes_index(r, r->contestants[at].peer)) make_one(r, r->contestants + at, all + at, round);
        }
    for (size_t i = 0; i < r->count; i++) {
        const peer *p = r->contestants[i].peer;
        if (!makes_index(r, p)) continue;
        const double own = p->bytes ? (double)p->bytes(r->contestants[i].index) / (double)r->data.count : 0;
        const double bytes = p->bytes && !p->steps ? own : bench_median(all[i].bytes, RACE_MAKES);
        const double peak = fmax(bytes, bench_median(all[i].peak, RACE_MAKES));
        put(r, "make", p->name, options.clock ? "seconds of the clock" : "seconds", all[i].seconds, RACE_MAKES,
            p->what);
        put(r, "make", p->name, "bytes", &bytes, 1, NULL);
        put(r, "make", p->name, "bytes at peak", &peak, 1, NULL);
        if (!p->steps) continue;
        put(r, "make", p->name, "bytes of the tree", &own, 1, NULL);
        put(r, "make", p->name, "seconds of the scene", all[i].steps[0], RACE_MAKES, NULL);
        put(r, "make", p->name, "seconds of the tree", all[i].steps[1], RACE_MAKES, NULL);
    }
    free(all);
}

/* ------------------------------------------------------------------- questions -- */

/* A contestant in a task. The first, froe, is there twice: with single questions, and with a whole share in a call.
 * Both come after another program, as far as there are any, so that the tree is warm for neither. */
typedef struct runner {
    const peer *peer;
    void *index;
    bool together;
    double rate[RACE_ROUNDS], *digest;
    peer_answers room; /* its own: a shared one would be in the caches when another has just written to it */
} runner;

static peer_answers new_room(size_t numbers) {
    return (peer_answers){.values = bench_take(numbers + 2, sizeof(double)),
                          .ends = bench_take(numbers + 1, sizeof(size_t))};
}

static void free_room(peer_answers *room) {
    free(room->values), free(room->ids), free(room->ends);
}

static double answer(const run *r, const race_task *t, runner *who, const peer_questions *q) {
    peer_answers *out = &who->room;
    void *index = who->index;
    double start = now();
    out->used = 0;
    if (t->work == PEER_PAIRS) {
        malloc_trim(0);
        start = now();
        index = who->peer->make(&r->data, who->peer);
    }
    who->peer->answer(index, q, out);
    const double seconds = now() - start;
    if (t->work == PEER_PAIRS) who->peer->free(index);
    return seconds;
}

static size_t rounds_of(const race_task *t) {
    return t->work == PEER_PAIRS ? RACE_MAKES : RACE_ROUNDS;
}

/* Answers a share, and keeps what the answers are compared by. Seconds. */
static double answer_share(run *r, const race_task *t, runner *who, size_t share) {
    const size_t first = t->work == PEER_PAIRS ? 0 : share * t->share * t->width;
    const peer_questions q = {.work = t->work,
                              .count = t->share,
                              .width = t->width,
                              .k = t->k,
                              .together = who->together,
                              .numbers = t->numbers + first,
                              .directions = t->directions ? t->directions + first : NULL};
    const double seconds = answer(r, t, who, &q);
    race_digest(&r->scene, &q, &who->room, who->digest + share * t->share * t->k);
    peer_let_go(&who->room);
    return seconds;
}

/* Questions in one call come from further shares: their answers would be warm for single ones, in the same tree. When
 * all is measured, these are answered one by one, too. */
static void run_rounds(run *r, const race_task *t, runner *runners, size_t count) {
    const size_t rounds = rounds_of(t);
    for (size_t round = 0; round < rounds; round++)
        for (size_t i = 0; i < count; i++) {
            const size_t share = (round + i) % rounds + (runners[i].together ? rounds : 0);
            const double seconds = answer_share(r, t, runners + i, share);
            runners[i].rate[round] = t->work == PEER_PAIRS ? seconds : (double)t->share / seconds;
        }
    for (size_t share = rounds; share < 2 * rounds; share++) answer_share(r, t, runners, share);
}

static void report(run *r, const race_task *t, runner *runners, size_t count) {
    const size_t rounds = rounds_of(t), answers = t->share * t->k * rounds;
    const char *measure = t->work == PEER_PAIRS ? options.clock ? "seconds of the clock" : "seconds" : "per second";
    for (size_t i = 0; i < count; i++) {
        const peer *p = runners[i].peer;
        char name[80];
        snprintf(name, sizeof name, "%s%s", p->name, runners[i].together ? ", in batches" : "");
        const size_t first = runners[i].together ? answers : 0;
        const size_t wrong =
            race_differ(&r->scene, t, p, runners[0].digest + first, runners[i].digest + first, answers);
        char note[128];
        snprintf(note, sizeof note, "%zu of %zu answers of %s differ.", wrong, answers, name);
        put(r, t->name, name, measure, runners[i].rate, rounds, wrong ? note : NULL);
        if ((double)wrong <= (p->tolerance > 0 ? 1e-3 * (double)answers : 0)) continue;
        fprintf(stderr, "bench_race: %s, %s: %s\n", r->scene.name, t->name, note);
        r->differ = true;
    }
}

static void race_questions(run *r, const race_task *pattern) {
    race_task t = *pattern;
    runner runners[RACE_MOST + 1];
    size_t count = 0;
    const size_t room = t.share * t.k > RACE_SAMPLE ? t.share * t.k : RACE_SAMPLE; /* questions of race_ask() */
    peer_answers first = new_room(room);
    if (t.work != PEER_PAIRS) race_ask(&t, &r->scene, r->contestants, &first);
    free_room(&first);
    for (size_t i = 0; i < r->count; i++) {
        const race_contestant *c = r->contestants + i;
        if (c->peer->serves(&r->data, t.work)) runners[count++] = (runner){.peer = c->peer, .index = c->index};
    }
    const size_t middle = (count + 1) / 2;
    memmove(runners + middle + 1, runners + middle, (count - middle) * sizeof *runners);
    runners[middle] = (runner){.peer = r->contestants[0].peer, .index = r->contestants[0].index, .together = true};
    count++;
    for (size_t i = 0; i < count; i++) {
        runners[i].digest = bench_take(t.share * t.k * 2 * RACE_ROUNDS, sizeof(double));
        runners[i].room = new_room(room);
    }
    run_rounds(r, &t, runners, count);
    report(r, &t, runners, count);
    for (size_t i = 0; i < count; i++) free(runners[i].digest), free_room(&runners[i].room);
    free(t.numbers), free(t.directions);
}

/* ----------------------------------------------------------------- contestants -- */

static bool serves_any(const run *r, const peer *p) {
    for (const race_task *t = r->tasks; t->name; t++)
        if (p->serves(&r->data, t->work)) return true;
    return false;
}

static void enter(run *r, const peer *p) {
    if (r->count < RACE_MOST && serves_any(r, p)) r->contestants[r->count++] = (race_contestant){p, NULL};
}

/* The method that is the first of its kind needs no name. */
static void enter_froe(run *r, const char *list) {
    const char *first = kinds[r->kind].froe;
    char spec[64];
    while (*list) {
        const size_t length = strcspn(list, ","), method = strcspn(list, ",/@+");
        snprintf(spec, sizeof spec, "%.*s", (int)length, list);
        enter(r, race_froe(spec, method == strcspn(first, ",/@+") && !strncmp(list, first, method)));
        list += length + (list[length] == ',');
    }
}

static int ends_in_so(const struct dirent *entry) {
    const size_t length = strlen(entry->d_name);
    return length > 3 && !strcmp(entry->d_name + length - 3, ".so");
}

/* Those of all shared objects in the folder, by name. They stay open. */
static void enter_peers(run *r, const char *folder) {
    struct dirent **files;
    const int count = scandir(folder, &files, ends_in_so, alphasort);
    for (int i = 0; i < count; free(files[i++])) {
        char path[4096];
        snprintf(path, sizeof path, "%s/%s", folder, files[i]->d_name);
        void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
        peer_list *list = NULL;
        if (library) *(void **)&list = dlsym(library, "peer_at");
        if (!list) fprintf(stderr, "bench_race: %s\n", dlerror()), exit(1);
        for (size_t k = 0; list(k); k++) enter(r, list(k));
    }
    if (count >= 0) free(files);
}

/* ----------------------------------------------------------------------- whole -- */

static bool race(peer_kind kind, const char *name, size_t n) {
    run r = {.kind = kind, .what = kinds[kind].name, .tasks = kinds[kind].tasks};
    r.scene = race_scene_make(kind, name, n);
    r.data = race_data(&r.scene);
    enter_froe(&r, options.froe ? options.froe : kinds[kind].froe);
    const size_t ours = r.count;
    if (!options.alone) enter_peers(&r, options.folder);
    race_makings(&r);
    for (const race_task *t = r.tasks; t->name && !options.makings; t++)
        if (t->wanted * 10 <= (double)r.data.count) race_questions(&r, t);
    for (size_t i = 0; i < r.count; i++)
        if (r.contestants[i].index) r.contestants[i].peer->free(r.contestants[i].index);
    for (size_t i = 0; i < ours; i++) race_froe_free((peer *)(uintptr_t)r.contestants[i].peer);
    race_scene_free(&r.scene);
    return !r.differ;
}

/* KIND:SCENE:N, or KIND:FILE */
static bool race_argument(char *argument) {
    char *name = strchr(argument, ':'), *n = name ? strchr(name + 1, ':') : NULL;
    if (name) *name++ = 0;
    if (n) *n++ = 0;
    for (int k = 0; name && k < PEER_KINDS; k++)
        if (!strcmp(kinds[k].name, argument)) return race((peer_kind)k, name, n ? strtoull(n, NULL, 10) : 0);
    fprintf(stderr, "bench_race: KIND:SCENE:N is expected, not %s\n", argument);
    return false;
}

int main(int argc, char **argv) {
    bool good = true;
    options.folder = BENCH_PEERS;
    for (int i = 1; i < argc; i++) {
        if (!strcmp(argv[i], "--froe") && i + 1 < argc)
            options.froe = argv[++i];
        else if (!strcmp(argv[i], "--peers") && i + 1 < argc)
            options.folder = argv[++i];
        else if (!strcmp(argv[i], "--alone"))
            options.alone = true;
        else if (!strcmp(argv[i], "--makings"))
            options.makings = true;
        else if (!strcmp(argv[i], "--clock"))
            options.clock = true;
        else
            good = race_argument(argv[i]) && good;
    }
    return !good;
}
