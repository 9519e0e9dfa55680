/* program.c: froe-mpi, folders of shards built and asked by several processes */
#include "ask.h"
#include "rows.h"
#include "support/fail.h"
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: mpirun -n RANKS froe-mpi build FILE.csv -o FOLDER [--shards N] [--memory BYTES[K|M|G|T]] [--threads N]\n"
    "                                      [--method NAME]\n"
    "       mpirun -n RANKS froe-mpi range  FOLDER --queries FILE.csv [--shape SHAPE] [OPTION]...\n"
    "       mpirun -n RANKS froe-mpi locate FOLDER --queries FILE.csv [--above | --below] [OPTION]...\n"
    "       mpirun -n RANKS froe-mpi near   FOLDER --queries FILE.csv [-k K] [--within D] [OPTION]...\n"
    "       mpirun -n RANKS froe-mpi ray    FOLDER --queries FILE.csv [--all] [--t-max T] [OPTION]...\n"
    "       OPTION: [-o ANSWERS.csv] [--count] [--threads N]\n"
    "\n"
    "build makes the folder of shards that one process makes, byte for byte, with any number of ranks: each\n"
    "reads a part of the file, sends objects to the ranks that own their shards, and builds its own shards.\n"
    "All ranks see the same files.\n"
    "\n"
    "range, locate, near and ray print what the commands of froe print that are called alike, byte for byte: each "
    "rank\n"
    "opens its own shards, reads a part of the questions, and sends them to the ranks whose shards they reach. SHAPE "
    "is\n"
    "box (default), ball, capsule, segment or ray. With -o all ranks write the file of answers, each its own part, "
    "which\n"
    "takes less time than standard output, where rank 0 writes all.\n"
    "\n"
    "Costs are printed on standard error: seconds of the slowest rank, by the clock and of processors, and those of "
    "the\n"
    "processors of all ranks together. A rank has one thread unless --threads says otherwise. When a rank fails or is\n"
    "killed, the folder that was there before stays.\n";

/* What options say; each command looks at its own. */
typedef struct job {
    const char *operand, *output, *queries;
    froe_shards_options shards;
    mpi_query query;
} job;

/* ------------------------------------------------------------------- build -- */

typedef struct build_job {
    froe_mpi_builder *builder;
    bool refused; /* objects that were read */
    froe_diagnostic *diag;
} build_job;

static bool add_rows(void *user, const froe_objects *batch, uint64_t first) {
    build_job *b = user;
    b->refused = froe_mpi_add(b->builder, batch, first, b->diag) != FROE_OK;
    return !b->refused;
}

/* Collective. What the first rank was doing that has failed while rows were read; where none has, what comes then. */
static cli_stage stage_of_rows(const mpi_ranks *ranks, bool failed, bool reading) {
    const int mine = failed ? 2 * ranks->rank + reading : 2 * ranks->count;
    int first;
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, ranks->comm);
    return first % 2 ? CLI_READING : CLI_WRITING;
}

static int build(const mpi_ranks *ranks, const job *j) {
    froe_diagnostic diag = {0};
    build_job b = {.diag = &diag};
    froe_shards_report report;
    froe_mpi_costs costs;
    int dim = 2;
    bool unwritten;
    froe_mpi_cost together = {0};
    const froe_mpi_cost began = mpi_now(ranks);
    froe_status status = mpi_rows_dim(ranks, j->operand, &dim, &unwritten, &diag);
    if (status) return mpi_fail(ranks, unwritten ? CLI_WRITING : CLI_READING, &diag);
    status = froe_mpi_begin(ranks->comm, j->output, dim, &j->shards, &b.builder, &diag);
    if (status) return mpi_fail(ranks, CLI_WRITING, &diag);
    status = mpi_rows_read(ranks, j->operand, froe_mpi_draft(b.builder), add_rows, &b, &unwritten, &diag);
    if (status) froe_mpi_fail(b.builder, &diag);
    const cli_stage stage = stage_of_rows(ranks, status != FROE_OK, !b.refused && !unwritten);
    status = froe_mpi_finish(b.builder, &report, &costs, &diag);
    if (status) return mpi_fail(ranks, stage, &diag);
    mpi_count(ranks, &together, began);
    together = mpi_slowest(ranks, together);
    if (ranks->rank) return 0;
    fprintf(stderr, "%llu objects, %llu copies in %u shards, the largest of %llu; %llu bytes; %llu sent\n",
            (unsigned long long)report.objects, (unsigned long long)report.copies, report.shards,
            (unsigned long long)report.most, (unsigned long long)report.bytes, (unsigned long long)costs.sent);
    mpi_print_cost("reading", costs.read), mpi_print_cost("exchange", costs.exchange);
    mpi_print_cost("building", costs.build), mpi_print_cost("waiting", costs.wait);
    mpi_print_cost("together", together);
    return 0;
}

/* ----------------------------------------------------------------- options -- */

/* A whole number of decimal digits, with one of the units behind it or none. */
static bool read_whole(const char *text, const char *units, uint64_t most, uint64_t *out) {
    char *end;
    errno = 0;
    const unsigned long long number = strtoull(text, &end, 10);
    const char *unit = *end ? strchr(units, *end) : NULL;
    const unsigned shift = unit ? 10 * (unsigned)(unit - units + 1) : 0;
    if (*text < '0' || *text > '9' || errno) return false; /* also a sign, or a blank */
    if ((*end && (!unit || end[1])) || number > most >> shift) return false;
    *out = (uint64_t)number << shift;
    return true;
}

/* A finite number that is not below 0. */
static bool read_real(const char *text, double *out) {
    char *end;
    *out = strtod(text, &end);
    return end != text && !*end && *out >= 0 && isfinite(*out);
}

static bool is_method(const char *name) {
    bool found = !strcmp(name, "auto");
    for (size_t i = 0; !found && froe_method_at(i); i++) found = !strcmp(name, froe_method_at(i)->name);
    return found;
}

/* One letter for each option; those of `build` are in capitals, but for -o. Its letter must be among those that the
 * command knows. */
static const struct option options[] = {
    {"shards", required_argument, NULL, 'S'},  {"memory", required_argument, NULL, 'M'},
    {"method", required_argument, NULL, 'W'},  {"threads", required_argument, NULL, 't'},
    {"queries", required_argument, NULL, 'q'}, {"shape", required_argument, NULL, 's'},
    {"count", no_argument, NULL, 'c'},         {"above", no_argument, NULL, 'a'},
    {"below", no_argument, NULL, 'b'},         {"neighbours", required_argument, NULL, 'k'},
    {"within", required_argument, NULL, 'w'},  {"all", no_argument, NULL, 'A'},
    {"t-max", required_argument, NULL, 'T'},   {NULL, 0, NULL, 0}};
static const char *const known[] = {[MPI_RANGE] = "toqcs",
                                    [MPI_LOCATE] = "toqcab",
                                    [MPI_NEAR] = "toqckw",
                                    [MPI_RAY] = "toqcAT",
                                    [MPI_NO_COMMAND] = "toSMW"};

static bool read_option(int letter, job *j) {
    uint64_t number = 0;
    bool good = true;
    mpi_query *q = &j->query;
    switch (letter) {
    case 'o':
        j->output = optarg;
        return true;
    case 'W':
        j->shards.method = optarg;
        return is_method(optarg);
    case 'q':
        j->queries = optarg;
        return true;
    case 'S':
        good = read_whole(optarg, "", FROE_SHARDS_MOST, &number) && number, j->shards.shards = (uint32_t)number;
        return good;
    case 'M':
        return read_whole(optarg, "KMGT", UINT64_MAX, &j->shards.memory) && j->shards.memory;
    case 't':
        good = read_whole(optarg, "", 1024, &number), j->shards.threads = q->batch.threads = (unsigned)number;
        return good;
    case 'k':
        good = read_whole(optarg, "", 2147483646, &number), q->k = number;
        return good;
    case 's':
        return mpi_shape_named(optarg, &q->shape);
    case 'w':
        return read_real(optarg, &q->within);
    case 'T':
        return read_real(optarg, &q->t_max);
    default:
        q->count = q->count || letter == 'c', q->all = q->all || letter == 'A';
        q->above = q->above || letter == 'a', q->below = q->below || letter == 'b';
        return true;
    }
}

static const char *name_of(int letter) {
    const struct option *o = options;
    while (o->name && o->val != letter) o++;
    return o->name;
}

/* What the value of an option has to be. */
static const char *expected(int letter) {
    switch (letter) {
    case 'S':
        return "a number from 1 to 4096";
    case 'M':
        return "a size, as 500M or 4G";
    case 'W':
        return "auto or a method that 'froe methods' lists";
    case 't':
        return "a number from 0 to 1024";
    case 's':
        return "box, ball, capsule, segment or ray";
    case 'k':
        return "a number from 0 to 2147483646";
    default:
        return "a finite number from 0 on";
    }
}

static bool read_options(int argc, char **argv, job *j) {
    bool good = true;
    for (int c; good && (c = getopt_long(argc, argv, "o:k:", options, NULL)) != -1;) {
        good = strchr(known[j->query.command], c);
        if (!good || read_option(c, j)) continue;
        good = false;
        if (opterr) fprintf(stderr, "froe-mpi: --%s: '%s' is not %s.\n", name_of(c), optarg, expected(c));
    }
    if (!good || optind + 1 != argc || (j->query.above && j->query.below)) return false;
    j->operand = argv[optind];
    return j->query.command == MPI_NO_COMMAND ? j->output != NULL : j->queries != NULL;
}

static int run(const mpi_ranks *ranks, int argc, char **argv) {
    job j = {.shards = froe_shards_defaults(),
             .query = {.k = 1, .within = INFINITY, .t_max = INFINITY, .batch = froe_batch_defaults()}};
    j.shards.threads = j.query.batch.threads = 1;
    opterr = !ranks->rank;
    if (argc == 2 && !strcmp(argv[1], "--version")) {
        if (!ranks->rank) printf("froe-mpi %s\n", froe_version());
        return 0;
    }
    const bool asked = argc == 2 && !strcmp(argv[1], "--help");
    const char *command = argc > 1 ? argv[1] : "";
    j.query.command = mpi_command_named(command);
    const bool builds = !strcmp(command, "build");
    char name[] = "froe-mpi"; /* by which getopt_long() begins its messages */
    if (argc > 1) argv[1] = name;
    const bool good = (builds || j.query.command != MPI_NO_COMMAND) && read_options(argc - 1, argv + 1, &j);
    if (good && builds) return build(ranks, &j);
    const mpi_asking asking = {.folder = j.operand, .input = j.queries, .output = j.output, .query = j.query};
    if (good) return mpi_ask(ranks, &asking);
    if (!ranks->rank) fputs(help, asked ? stdout : stderr);
    return asked ? 0 : CLI_USE;
}

/* What the sources of cli/ ask of the command line of froe: there is no --limit-time here, and MPI has the signals. */
bool cli_late(void);
bool cli_interrupted(void);
bool cli_late(void) {
    return false;
}

bool cli_interrupted(void) {
    return false;
}

int main(int argc, char **argv) {
    MPI_Init(&argc, &argv);
    const mpi_ranks ranks = mpi_ranks_of(MPI_COMM_WORLD);
    const int code = run(&ranks, argc, argv);
    MPI_Finalize();
    return code;
}
