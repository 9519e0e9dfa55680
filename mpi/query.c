/* query.c: see query.h. */
#include "query.h"
#include "support/fail.h"
#include <stdlib.h>
#include <string.h>

mpi_command mpi_command_named(const char *name) {
    static const char *const names[] = {"range", "locate", "near", "ray"};
    int i = 0;
    while (i < MPI_NO_COMMAND && strcmp(names[i], name) != 0) i++;
    return (mpi_command)i;
}

bool mpi_shape_named(const char *name, froe_range_shape *out) {
    for (int s = 0; s < FROE_SHAPE_COUNT; s++) {
        if (s == FROE_SHAPE_SIMPLEX || s == FROE_SHAPE_HALFSPACES || s == FROE_SHAPE_HULL) continue;
        *out = (froe_range_shape)s;
        if (!strcmp(name, froe_range_shape_name(*out))) return true;
    }
    return false;
}

const cli_column *mpi_query_columns(const mpi_query *q) {
    static const cli_column ranges[FROE_SHAPE_COUNT][4] = {
        [FROE_SHAPE_BOX] = {{"lo_", true}, {"hi_", true}},
        [FROE_SHAPE_BALL] = {{"", true}, {"r", false}},
        [FROE_SHAPE_CAPSULE] = {{"a", true}, {"b", true}, {"r", false}},
        [FROE_SHAPE_SEGMENT] = {{"a", true}, {"b", true}},
        [FROE_SHAPE_RAY] = {{"o", true}, {"d", true}},
    };
    static const cli_column points[] = {{"", true}, {0}};
    return q->command == MPI_RANGE ? ranges[q->shape] : q->command == MPI_RAY ? ranges[FROE_SHAPE_RAY] : points;
}

const char *const *mpi_query_names(const mpi_query *q, size_t *count) {
    static const char *const counts[] = {"query", "count"}, *const objects[] = {"query", "object"},
                             *const groups[] = {"query", "object", "group"},
                             *const near[] = {"query", "object", "distance"}, *const ray[] = {"query", "object", "t"};
    const bool plain = q->command == MPI_RANGE || q->above || q->below;
    *count = q->count || plain ? 2 : 3;
    return q->count ? counts : plain ? objects : q->command == MPI_NEAR ? near : q->command == MPI_RAY ? ray : groups;
}

/* ------------------------------------------------------------------- asking -- */

/* Questions as the calls of froe/shards.h take them. */
typedef struct arguments {
    froe_range *ranges;
    double *origins, *directions;
} arguments;

static bool is_first(const mpi_query *q) {
    return q->above || q->below || (q->command == MPI_RAY && !q->all);
}

/* Does the library count? Whether a ray meets something is told by what it meets. */
static bool is_counted(const mpi_query *q) {
    return q->count && (q->command != MPI_RAY || q->all);
}

/* Boxes are rows of their corners as they are. */
static bool takes_rows(const mpi_query *q) {
    return q->command == MPI_RANGE && q->shape == FROE_SHAPE_BOX && !q->count;
}

/* False: no memory. */
static bool lay_arguments(const mpi_query *q, const double *rows, size_t width, size_t count, arguments *a) {
    const size_t dim = width / 2, room = count + 1;
    if (q->command == MPI_RANGE && !takes_rows(q) && !(a->ranges = calloc(room, sizeof *a->ranges))) return false;
    if (q->command == MPI_RAY && !((a->origins = calloc(room * dim, sizeof *a->origins)) &&
                                   (a->directions = calloc(room * dim, sizeof *a->directions))))
        return false;
    for (size_t i = 0; i < count && a->ranges; i++) {
        a->ranges[i] = froe_range_defaults();
        a->ranges[i].shape = q->shape;
        a->ranges[i].points = rows + i * width;
        if (q->shape == FROE_SHAPE_BALL || q->shape == FROE_SHAPE_CAPSULE)
            a->ranges[i].radius = rows[(i + 1) * width - 1];
    }
    for (size_t i = 0; i < count && a->origins; i++) {
        memcpy(a->origins + i * dim, rows + i * width, dim * sizeof *rows);
        memcpy(a->directions + i * dim, rows + i * width + dim, dim * sizeof *rows);
    }
    return true;
}

static froe_status ask(const mpi_query *q, froe_shards *shards, const double *rows, const arguments *a, size_t count,
                       mpi_answers *out, froe_diagnostic *diag) {
    const froe_batch_options *o = &q->batch;
    switch (q->command) {
    case MPI_RANGE:
        if (takes_rows(q)) return froe_shards_boxes(shards, rows, count, o, &out->lists, diag);
        return froe_shards_range(shards, a->ranges, count, o, &out->lists, diag);
    case MPI_RAY:
        if (q->all)
            return froe_shards_ray_all(shards, a->origins, a->directions, count, q->t_max, o, &out->lists, diag);
        return (q->count ? froe_shards_ray_any : froe_shards_ray)(shards, a->origins, a->directions, count, q->t_max, o,
                                                                  out->firsts, diag);
    case MPI_NEAR:
        return froe_shards_near(shards, rows, count, q->k, q->within, o, &out->lists, diag);
    default:
        return is_first(q) ? froe_shards_vertical(shards, rows, count, q->above ? 1 : -1, o, out->firsts, diag)
                           : froe_shards_locate(shards, rows, count, o, &out->lists, diag);
    }
}

static froe_status ask_counts(const mpi_query *q, froe_shards *shards, const double *rows, const arguments *a,
                              size_t count, uint64_t *counts, froe_diagnostic *diag) {
    const froe_batch_options *o = &q->batch;
    switch (q->command) {
    case MPI_RANGE:
        return froe_shards_count(shards, a->ranges, count, o, counts, diag);
    case MPI_RAY:
        return froe_shards_ray_count(shards, a->origins, a->directions, count, q->t_max, o, counts, diag);
    case MPI_NEAR:
        return froe_shards_near_count(shards, rows, count, q->k, q->within, o, counts, diag);
    default:
        return is_first(q) ? froe_shards_vertical_count(shards, rows, count, q->above ? 1 : -1, o, counts, diag)
                           : froe_shards_locate_count(shards, rows, count, o, counts, diag);
    }
}

froe_status mpi_query_ask(const mpi_ranks *ranks, const mpi_query *q, froe_shards *shards, const double *rows,
                          size_t width, size_t count, mpi_answers *out, froe_diagnostic *diag) {
    arguments a = {0};
    *out = (mpi_answers){0};
    bool room = lay_arguments(q, rows, width, count, &a);
    if (is_counted(q))
        room = (out->counts = calloc(count + 1, sizeof *out->counts)) && room;
    else if (is_first(q))
        room = (out->firsts = calloc(count + 1, sizeof *out->firsts)) && room;
    froe_status status = mpi_agree(ranks, room ? FROE_OK : support_fail_memory(diag), diag);
    if (!status)
        status = out->counts ? ask_counts(q, shards, rows, &a, count, out->counts, diag)
                             : ask(q, shards, rows, &a, count, out, diag);
    free(a.ranges), free(a.origins), free(a.directions);
    return status;
}

void mpi_answers_free(mpi_answers *a) {
    free(a->counts), free(a->firsts);
    froe_finds_free(&a->lists);
    *a = (mpi_answers){0};
}

/* ------------------------------------------------------------------ answers -- */

static void put_find(const mpi_query *q, uint64_t query, const froe_find *find, cli_answers *out) {
    cli_answers_begin(out);
    cli_answers_whole(out, query);
    cli_answers_whole(out, find->tag);
    if (q->command == MPI_NEAR || q->command == MPI_RAY) cli_answers_real(out, find->value);
    if (q->command == MPI_LOCATE && !q->above && !q->below) cli_answers_none(out);
    cli_answers_end(out);
}

static void put_count(uint64_t query, uint64_t count, cli_answers *out) {
    cli_answers_begin(out);
    cli_answers_whole(out, query);
    cli_answers_whole(out, count);
    cli_answers_end(out);
}

void mpi_query_put(const mpi_query *q, const mpi_answers *a, size_t count, uint64_t first, cli_answers *out) {
    for (size_t i = 0; i < count && a->counts; i++) put_count(first + i, a->counts[i], out);
    for (size_t i = 0; i < count && !a->counts; i++) {
        const bool found = a->firsts && a->firsts[i].object != FROE_NONE;
        const size_t begin = a->firsts ? 0 : a->lists.starts[i], end = a->firsts ? found : a->lists.starts[i + 1];
        const froe_find *finds = a->firsts ? a->firsts + i : a->lists.items;
        if (q->count) put_count(first + i, end - begin, out);
        for (size_t j = begin; j < end && !q->count; j++) put_find(q, first + i, finds + j, out);
    }
}
