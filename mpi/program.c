/* program.c: froe-mpi, folders of shards built by several processes */
#include "rows.h"
#include "support/fail.h"
#include <froe/arrays.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: mpirun -n RANKS froe-mpi build FILE.csv -o FOLDER [--shards N] [--memory BYTES[K|M|G]] [--threads N]\n"
    "                                      [--method NAME]\n"
    "\n"
    "build makes the folder of shards that one process makes, byte for byte, with any number of ranks: each\n"
    "reads a part of the file, sends objects to the ranks that own their shards, and builds its own shards.\n"
    "All ranks see the same files.\n"
    "\n"
    "Costs are printed on standard error: seconds of the slowest rank, by the clock and of processors. A rank has one\n"
    "thread unless --threads says otherwise. When a rank fails or is killed, the folder that was there before stays.\n";

typedef struct job {
    const char *input, *output;
    froe_shards_options shards;
} job;

enum { USE = 2, INPUT = 3, RESOURCES = 4 };

/* Collective: rank 0 says why. */
static int fail(const mpi_ranks *ranks, const froe_diagnostic *why) {
    if (!ranks->rank) fprintf(stderr, "froe-mpi: %s\n", why->message);
    switch (why->status) {
    case FROE_E_ARG:
    case FROE_E_OPTIONS:
        return USE;
    case FROE_E_MEMORY:
    case FROE_E_LIMIT:
    case FROE_E_BUDGET:
        return RESOURCES;
    default:
        return INPUT;
    }
}

static void print_cost(const char *what, froe_mpi_cost cost) {
    fprintf(stderr, "%-9s %9.3f s %9.3f s of processors\n", what, cost.wall, cost.processor);
}

/* ------------------------------------------------------------------- build -- */

typedef struct build_job {
    froe_mpi_builder *builder;
    froe_diagnostic *diag;
} build_job;

/* The objects of one kind of a scene, which a CSV has, as a batch. */
static bool add_rows(void *user, const froe_scene *scene, uint64_t first, bool tagged) {
    build_job *b = user;
    froe_scene_arrays a;
    if (froe_scene_group_count(scene)) {
        support_fail(b->diag, FROE_E_UNSUPPORTED, "Rows with names are not built by several processes.");
        return false;
    }
    if (froe_arrays_of_scene(scene, NULL, &a, b->diag)) return false;
    froe_objects batch = froe_objects_defaults();
    batch.kind = a.object_count ? (froe_kind)a.kinds[0] : FROE_POINT;
    batch.count = a.object_count, batch.point_count = a.vertex_count;
    batch.coords = a.coords, batch.indices = a.corners;
    batch.starts = batch.kind == FROE_HULL ? a.starts : NULL;
    batch.radii = batch.kind == FROE_BALL ? a.radii : NULL;
    batch.tags = tagged ? a.tags : NULL;
    const froe_status status = froe_mpi_add(b->builder, &batch, first, b->diag);
    froe_scene_arrays_free(&a);
    return !status;
}

static int build(const mpi_ranks *ranks, const job *j) {
    froe_diagnostic diag = {0};
    build_job b = {.diag = &diag};
    froe_shards_report report;
    froe_mpi_costs costs;
    int dim = 2;
    froe_status status = mpi_agree(ranks, mpi_rows_dim(j->input, &dim, &diag), &diag);
    if (!status) status = froe_mpi_begin(ranks->comm, j->output, dim, &j->shards, &b.builder, &diag);
    if (status) return fail(ranks, &diag);
    if (mpi_rows_read(ranks, j->input, add_rows, &b, &diag)) froe_mpi_fail(b.builder, &diag);
    status = froe_mpi_finish(b.builder, &report, &costs, &diag);
    if (status) return fail(ranks, &diag);
    if (ranks->rank) return 0;
    fprintf(stderr, "%llu objects, %llu copies in %u shards, the largest of %llu; %llu bytes; %llu sent\n",
            (unsigned long long)report.objects, (unsigned long long)report.copies, report.shards,
            (unsigned long long)report.most, (unsigned long long)report.bytes, (unsigned long long)costs.sent);
    print_cost("reading", costs.read), print_cost("exchange", costs.exchange), print_cost("building", costs.build);
    return 0;
}

/* ----------------------------------------------------------------- options -- */

static bool read_size(const char *text, uint64_t most, uint64_t *out) {
    char *end;
    const unsigned long long number = strtoull(text, &end, 10);
    static const char units[] = "KMG";
    const char *unit = *end ? strchr(units, *end) : NULL;
    const unsigned shift = unit ? 10 * (unsigned)(unit - units + 1) : 0;
    if (end == text || *text == '-' || (*end && (!unit || end[1])) || number > most >> shift) return false;
    *out = (uint64_t)number << shift;
    return true;
}

static bool read_options(int argc, char **argv, job *j) {
    static const struct option options[] = {{"shards", required_argument, NULL, 's'},
                                            {"memory", required_argument, NULL, 'm'},
                                            {"threads", required_argument, NULL, 't'},
                                            {"method", required_argument, NULL, 'M'},
                                            {NULL, 0, NULL, 0}};
    uint64_t number = 0;
    bool good = true;
    for (int c; (c = getopt_long(argc, argv, "o:", options, NULL)) != -1 && good;) {
        if (c == 'o')
            j->output = optarg;
        else if (c == 'M')
            j->shards.method = optarg;
        else if (c == 's')
            good = read_size(optarg, FROE_SHARDS_MOST, &number), j->shards.shards = (uint32_t)number;
        else if (c == 'm')
            good = read_size(optarg, UINT64_MAX, &j->shards.memory);
        else if (c == 't')
            good = read_size(optarg, 1024, &number), j->shards.threads = (unsigned)number;
        else
            good = false;
    }
    if (optind + 1 != argc) return false;
    j->input = argv[optind];
    return good;
}

static int run(const mpi_ranks *ranks, int argc, char **argv) {
    job j = {.shards = froe_shards_defaults()};
    j.shards.threads = 1;
    opterr = !ranks->rank;
    if (argc == 2 && !strcmp(argv[1], "--version")) {
        if (!ranks->rank) printf("froe-mpi %s\n", froe_version());
        return 0;
    }
    const bool asked = argc == 2 && !strcmp(argv[1], "--help");
    const char *command = argc > 1 ? argv[1] : "";
    const bool good = argc > 1 && !asked && read_options(argc - 1, argv + 1, &j);
    if (good && !strcmp(command, "build") && j.output) return build(ranks, &j);
    if (!ranks->rank) fputs(help, asked ? stdout : stderr);
    return asked ? 0 : USE;
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    const mpi_ranks ranks = mpi_ranks_of(MPI_COMM_WORLD);
    const int code = run(&ranks, argc, argv);
    MPI_Finalize();
    return code;
}
