/* ask.c: see ask.h. The file is cut into parts, and the ranks take them in turns:
 *
 *     part       0        1        2     |    3        4        5     |   ...
 *     rank       0        1        2     |    0        1        2     |
 *                reads, asks with the others, and prints; then all write, or rank 0 does, in the order of the ranks
 *
 * So answers come out in the order of the questions, and each rank holds those of one part. A bad question or row ends
 * the run: what stands in front of it is answered. */
#include "ask.h"
#include "output.h"
#include "rows.h"
#include "support/array.h"
#include "support/fail.h"
#include <stdlib.h>
#include <string.h>

enum { PART = 1 << 20 }; /* bytes of questions that a rank takes at once */

/* Questions of a part. */
typedef ARRAY(double) number_array;
typedef ARRAY(uint64_t) line_array;

typedef struct step {
    const mpi_ranks *ranks; /* which count waiting */
    const mpi_asking *asking;
    froe_mpi_folder *folder;
    froe_allocator alloc;
    int dim;
    uint64_t row, line; /* before this step: rows, and lines with the header */
    number_array numbers;
    line_array lines; /* of each question, within the part */
    size_t width;
    bool bad;          /* is there a bad row, or question, behind those above? */
    uint64_t bad_line; /* within the part */
    char sentence[sizeof((froe_diagnostic *)0)->message];
    uint64_t rows_read, lines_read;
    mpi_answers answers;
    mpi_output output;
    cli_stage stage; /* of what may fail now */
    char *text;      /* of the answers */
    size_t text_length;
    froe_mpi_cost reading, answering, writing, wait, together;
} step;

/* ------------------------------------------------------------------ reading -- */

static froe_status take_rows(step *s, cli_rows *rows, froe_diagnostic *diag) {
    double values[CLI_ROW_NUMBERS];
    s->width = rows->numbers;
    for (cli_row got; (got = cli_rows_next(rows, values)) != CLI_ROWS_END;) {
        if (got == CLI_ROWS_FAILED) return support_fail_memory(diag);
        if (got == CLI_ROW_BAD) {
            s->bad = true, s->bad_line = rows->line;
            snprintf(s->sentence, sizeof s->sentence, "%s", rows->sentence);
            break;
        }
        if (!array_append(&s->alloc, &s->numbers, values, s->width) || !array_push(&s->alloc, &s->lines, rows->line))
            return support_fail_memory(diag);
    }
    s->rows_read = rows->rows, s->lines_read = rows->lines - 1;
    return FROE_OK;
}

/* Reads this rank's part, which may have no rows. */
static froe_status read_part(step *s, uint64_t part, uint64_t parts, froe_diagnostic *diag) {
    char *text = NULL;
    size_t count;
    s->numbers.count = s->lines.count = 0;
    s->bad = false;
    s->rows_read = s->lines_read = 0;
    froe_status status = mpi_rows_text(s->asking->input, part, parts, &text, &count, diag);
    FILE *file = status ? NULL : fmemopen(text, count, "r");
    if (!status && !file) status = support_fail_memory(diag);
    if (!status) {
        cli_rows rows;
        if (cli_rows_begin(file, s->asking->input, mpi_query_columns(&s->asking->query), s->dim, &rows))
            status = support_fail(diag, FROE_E_IO, "The header has changed meanwhile.");
        if (!status) status = take_rows(s, &rows, diag);
        if (!status) cli_rows_close(&rows);
    }
    free(text);
    return status;
}

/* ---------------------------------------------------------------- answering -- */

/* The first rank that has something bad; the number of ranks: none. Those behind it ask nothing. */
static int first_bad(step *s) {
    const int mine = s->bad ? s->ranks->rank : s->ranks->count;
    int first = mine;
    mpi_wait(s->ranks);
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, s->ranks->comm);
    if (first < s->ranks->rank) s->lines.count = 0, s->bad = false;
    return first;
}

/* Asks until no question is bad. *stop: the rank at whose bad row or question the run ends, or the number of ranks. */
static froe_status ask_part(step *s, int *stop, froe_diagnostic *diag) {
    const mpi_query *q = &s->asking->query;
    for (bool again = true; again;) {
        froe_diagnostic why = {0};
        *stop = first_bad(s);
        froe_status status = mpi_query_ask(s->ranks, q, froe_mpi_shards(s->folder), s->numbers.data, s->width,
                                           s->lines.count, &s->answers, &why);
        const bool refused = (status == FROE_E_INPUT || status == FROE_E_UNSUPPORTED) && why.object < s->lines.count;
        if (refused) {
            s->bad = true, s->bad_line = s->lines.data[why.object];
            s->lines.count = why.object;
            snprintf(s->sentence, sizeof s->sentence, "%s", why.message);
            status = FROE_OK;
        }
        if (status) *diag = why;
        if ((status = mpi_agree(s->ranks, status, diag))) return status;
        again = mpi_sum(s->ranks, refused) > 0;
        if (again) mpi_answers_free(&s->answers);
    }
    return FROE_OK;
}

/* Answers as text; of the first part with the names of the columns. */
static froe_status print_part(step *s, bool header, uint64_t first, froe_diagnostic *diag) {
    cli_answers *out = malloc(sizeof *out);
    FILE *file = out ? open_memstream(&s->text, &s->text_length) : NULL;
    size_t columns;
    const char *const *names = mpi_query_names(&s->asking->query, &columns);
    if (file) {
        cli_answers_open(out, CLI_CSV, false, names, columns);
        out->file = file;
        if (!header) out->length = 0;
        mpi_query_put(&s->asking->query, &s->answers, s->lines.count, first, out);
        cli_answers_close(out);
    }
    const bool whole = file && !ferror(file);
    const bool closed = file && !fclose(file);
    free(out);
    return whole && closed ? FROE_OK : support_fail_memory(diag);
}

/* -------------------------------------------------------------------- steps -- */

/* Rank `stop` says what is bad, if there is something. */
static int refuse(const step *s, int stop, uint64_t line) {
    if (stop == s->ranks->count) return CLI_YES;
    if (stop == s->ranks->rank)
        cli_fail(CLI_INPUT, s->asking->input, "line %llu: %s", (unsigned long long)line + s->bad_line, s->sentence);
    return CLI_INPUT;
}

/* One part for each rank. *code: why the run ends, or 0. */
static froe_status go_step(step *s, uint64_t part, uint64_t parts, int *code, froe_diagnostic *diag) {
    froe_mpi_cost then = mpi_now(s->ranks);
    int stop;
    froe_status status = read_part(s, part, parts, diag);
    mpi_count(s->ranks, &s->reading, then);
    if ((status = mpi_agree(s->ranks, status, diag))) return status;
    const uint64_t first = s->row + mpi_sum_before(s->ranks, s->rows_read);
    const uint64_t line = s->line + mpi_sum_before(s->ranks, s->lines_read);
    s->row += mpi_sum(s->ranks, s->rows_read), s->line += mpi_sum(s->ranks, s->lines_read);
    then = mpi_now(s->ranks);
    const froe_mpi_spent before = froe_mpi_spent_on(s->folder);
    status = ask_part(s, &stop, diag);
    const froe_mpi_spent after = froe_mpi_spent_on(s->folder);
    mpi_count(s->ranks, &s->answering, then);
    s->answering.wall -= after.exchange.wall + after.wait.wall - before.exchange.wall - before.wait.wall;
    s->answering.processor -=
        after.exchange.processor + after.wait.processor - before.exchange.processor - before.wait.processor;
    then = mpi_now(s->ranks);
    if (!status) status = mpi_agree(s->ranks, print_part(s, !part, first, diag), diag);
    if (!status) s->stage = CLI_WRITING, status = mpi_output_put(&s->output, s->text, s->text_length, diag);
    if (!status) s->stage = CLI_WORKING;
    mpi_count(s->ranks, &s->writing, then);
    mpi_answers_free(&s->answers);
    free(s->text);
    s->text = NULL, s->text_length = 0;
    if (!status) *code = refuse(s, stop, line);
    return status;
}

static void print_costs(const step *s) {
    const froe_mpi_spent spent = froe_mpi_spent_on(s->folder);
    const struct {
        const char *what;
        froe_mpi_cost cost;
    } costs[] = {{"reading", s->reading},
                 {"opening", spent.open},
                 {"exchange", spent.exchange},
                 {"answering", s->answering},
                 {"writing", s->writing},
                 {"waiting", {spent.wait.wall + s->wait.wall, spent.wait.processor + s->wait.processor, 0}},
                 {"together", s->together}};
    for (size_t i = 0; i < sizeof costs / sizeof *costs; i++) {
        const froe_mpi_cost most = mpi_slowest(s->ranks, costs[i].cost);
        if (!s->ranks->rank) mpi_print_cost(costs[i].what, most);
    }
}

/* Rank 0 reads the header, and says what is wrong with it. */
static int check_header(const step *s) {
    cli_rows rows;
    int code = 0;
    if (!s->ranks->rank) {
        code = cli_rows_open(s->asking->input, mpi_query_columns(&s->asking->query), s->dim, &rows);
        if (!code) cli_rows_close(&rows);
    }
    MPI_Bcast(&code, 1, MPI_INT, 0, s->ranks->comm);
    return code;
}

/* Objects of groups have answers of more than their tags, which the shards of other ranks know. */
static froe_status refuse_groups(const step *s, froe_diagnostic *diag) {
    froe_shards *shards = froe_mpi_shards(s->folder);
    const mpi_query *q = &s->asking->query;
    const uint32_t count = froe_shards_about(shards).shards;
    uint64_t groups = 0;
    for (uint32_t turn = 0, i; (i = mpi_own_shard(s->ranks, turn)) < count; turn++) {
        const froe_tree *tree = NULL;
        if (!froe_shards_tree(shards, i, &tree, NULL) && tree) groups += froe_scene_group_count(froe_tree_scene(tree));
    }
    groups = mpi_sum(s->ranks, groups);
    if (!groups || q->command != MPI_LOCATE || q->count || q->above || q->below) return FROE_OK;
    return support_fail(diag, FROE_E_UNSUPPORTED,
                        "%s: Its objects have groups, of which one process tells: froe locate.",
                        support_short(s->asking->folder));
}

int mpi_fail(const mpi_ranks *ranks, cli_stage stage, const froe_diagnostic *why) {
    int code = ranks->rank ? 0 : cli_fail_status(stage, NULL, why->status, why);
    MPI_Bcast(&code, 1, MPI_INT, 0, ranks->comm);
    return code;
}

/* Collective: reads, asks and writes all parts. *code: why a bad row or question ended that, or 0. */
static froe_status go_all(step *s, int *code, froe_diagnostic *diag) {
    const mpi_ranks *ranks = s->ranks;
    uint64_t parts = mpi_rows_parts(ranks, s->asking->input, PART);
    MPI_Bcast(&parts, 1, MPI_UINT64_T, 0, ranks->comm);
    s->stage = CLI_WRITING;
    froe_status status = mpi_output_open(ranks, s->asking->output, &s->output, diag);
    if (status) return status;
    s->stage = CLI_WORKING;
    for (uint64_t first = 0; first < parts && !status && !*code; first += (uint64_t)ranks->count)
        status = go_step(s, first + (uint64_t)ranks->rank, parts, code, diag);
    if (!status) s->stage = CLI_WRITING;
    const froe_mpi_cost then = mpi_now(ranks);
    const froe_status ended = *code ? FROE_E_INPUT : status;
    const froe_status closed = mpi_output_close(&s->output, ended, diag);
    mpi_count(ranks, &s->writing, then);
    return *code ? FROE_OK : closed;
}

int mpi_ask(const mpi_ranks *given, const mpi_asking *asking) {
    step s = {.asking = asking, .alloc = support_allocator(NULL), .line = 0, .stage = CLI_WORKING};
    mpi_ranks ranks = *given;
    froe_diagnostic diag = {0};
    const froe_mpi_cost began = mpi_now(given); /* which does not leave out waiting */
    ranks.waited = &s.wait;
    s.ranks = &ranks;
    froe_status status = froe_mpi_open(ranks.comm, asking->folder, &s.folder, &diag);
    if (status) return mpi_fail(&ranks, CLI_READING, &diag);
    s.dim = froe_shards_about(froe_mpi_shards(s.folder)).dim;
    status = refuse_groups(&s, &diag);
    int code = status ? 0 : check_header(&s);
    if (!status && !code) status = go_all(&s, &code, &diag);
    if (status) code = mpi_fail(&ranks, s.stage, &diag);
    mpi_count(given, &s.together, began);
    if (!code) print_costs(&s);
    array_free(&s.alloc, &s.numbers);
    array_free(&s.alloc, &s.lines);
    froe_mpi_close(s.folder);
    return code;
}
