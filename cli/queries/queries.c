/* queries.c: blocks of queries, and the treatment of bad ones. */
#include "queries/queries.h"
#include "exit.h"
#include "progress.h"
#include "report/report.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

const cli_option cli_query_options[] = {
    {"keep-going", 0, CLI_FLAG, offsetof(cli_query_args, keep_going),
     .help = "pass over malformed rows and bad queries, after naming them"},
    {"count", 0, CLI_FLAG, offsetof(cli_query_args, count), .help = "say only how many answers each query has"},
    {0},
};

/* Numbers with open addressing, each with 1 added; at most half of the places are used. */
typedef struct seen_ids {
    uint64_t *places;
    size_t used, room; /* a power of 2, or 0 */
} seen_ids;

/* A run in progress. Rows of the query being gathered lie behind those of the `count` whole ones. */
typedef struct query_run {
    const cli_queries *q;
    const cli_asked *asked;
    cli_rows rows;
    bool grouped, ended;
    bool open, spoilt; /* is a query being gathered? was a row of it bad? */
    bool refused;      /* was anything bad? */
    int code;          /* why the run ends early */
    size_t count, gathered, width;
    size_t starts[CLI_BLOCK + 1];
    uint64_t ids[CLI_BLOCK + 1], lines[CLI_BLOCK + 1];
    double *numbers;
    size_t room; /* for rows */
    uint64_t answered;
    size_t *own; /* [columns shown] of each query: where the text begins in `texts` */
    char *texts;
    size_t text_length, text_room;
    cli_table table;
    bool bounded;     /* do points have nothing to find beyond 180 degrees? */
    uint64_t outside; /* points there */
    seen_ids seen;    /* of the queries that began, where rows name them */
} query_run;

/* -------------------------------------------------------------------- bad -- */

static void refuse(query_run *r, uint64_t line, const char *sentence) {
    r->refused = true;
    cli_fail(CLI_INPUT, r->rows.path, "line %llu: %s", (unsigned long long)line, sentence);
    if (!r->q->args->keep_going) r->code = CLI_INPUT;
}

/* ------------------------------------------------------------ numbers seen -- */

/* The place of a number, or the free one where it belongs. */
static uint64_t *place_of_id(const seen_ids *seen, uint64_t id) {
    size_t at = (size_t)((id * UINT64_C(0x9E3779B97F4A7C15)) >> 20) & (seen->room - 1);
    while (seen->places[at] && seen->places[at] != id + 1) at = (at + 1) & (seen->room - 1);
    return seen->places + at;
}

static bool is_seen(const seen_ids *seen, uint64_t id) {
    return seen->room && *place_of_id(seen, id);
}

/* False: there is no memory. */
static bool see_id(seen_ids *seen, uint64_t id) {
    if (2 * (seen->used + 1) > seen->room) {
        seen_ids more = {.used = seen->used, .room = seen->room ? 2 * seen->room : CLI_BLOCK};
        more.places = calloc(more.room, sizeof *more.places);
        if (!more.places) return false;
        for (size_t i = 0; i < seen->room; i++)
            if (seen->places[i]) *place_of_id(&more, seen->places[i] - 1) = seen->places[i];
        free(seen->places);
        *seen = more;
    }
    *place_of_id(seen, id) = id + 1;
    seen->used++;
    return true;
}

/* ---------------------------------------------------------------- degrees -- */

static const double half_turn = 180;

/* Does a map in degrees end at 180, so that points beyond have nothing to find? Some maps run from 0 to 360. */
static bool is_bounded(const query_run *r) {
    const cli_column *columns = r->q->columns;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    const bool points = columns[0].axes && !*columns[0].name && !columns[1].name;
    return points && froe_scene_crs(r->asked->scene).kind == FROE_CRS_GEOGRAPHIC &&
           froe_scene_bounds(r->asked->scene, lo, hi) && lo[0] >= -half_turn && hi[0] <= half_turn;
}

static void warn_outside(const query_run *r) {
    if (!r->outside || r->q->common->quiet) return;
    (void)cli_fail(0, r->rows.path,
                   "warning: Points beyond the longitudes -180 and 180, where this map has nothing: %llu.",
                   (unsigned long long)r->outside);
}

/* Columns that are named for degrees ask a map in metres, or the other way around. */
static void warn_axes(const query_run *r) {
    enum { DEGREES = 1, LENGTHS = 2 };
    const froe_crs crs = froe_scene_crs(r->asked->scene);
    const bool mixed = (crs.kind == FROE_CRS_PROJECTED && r->rows.family == DEGREES) ||
                       (crs.kind == FROE_CRS_GEOGRAPHIC && r->rows.family == LENGTHS);
    if (!mixed || r->q->common->quiet) return;
    (void)cli_fail(0, r->rows.path,
                   "warning: The header names %s, and the coordinate system of the map, '%.60s', has %s in units of "
                   "'%.30s'.",
                   r->rows.family == DEGREES ? "lon and lat" : "easting and northing", crs.name,
                   r->rows.family == DEGREES ? "lengths" : "longitudes and latitudes", crs.unit);
}

/* ---------------------------------------------------------------- reading -- */

static size_t rows_held(const query_run *r) {
    return r->starts[r->count] + r->gathered;
}

/* The query being gathered is whole. */
static void close_query(query_run *r) {
    if (r->gathered && !r->spoilt) {
        r->starts[r->count + 1] = rows_held(r);
        r->count++;
    }
    r->gathered = 0;
    r->open = r->spoilt = false;
}

/* Where several rows make a query: does a row name one that ended before the one being gathered? */
static bool is_late(const query_run *r, uint64_t id) {
    return !(r->open && r->ids[r->count] == id) && is_seen(&r->seen, id);
}

/* The query that a row belongs to is the one being gathered, or a new one. */
static void open_query(query_run *r, uint64_t id) {
    if (r->open && r->ids[r->count] == id) return;
    close_query(r);
    if (r->grouped && !see_id(&r->seen, id)) {
        r->code = cli_fail_memory();
        return;
    }
    r->open = true;
    r->ids[r->count] = id;
    r->lines[r->count] = r->rows.line;
}

static bool is_id(double x) {
    return x >= 0 && x < 0x1p53 && x == floor(x);
}

/* Keeps the text of the columns of the file that are shown, each behind a mark. */
static bool keep_own(query_run *r) {
    const cli_columns *columns = &r->table.columns;
    for (size_t k = 0; k < columns->own_count; k++) {
        const support_csv_field *field = &r->rows.fields[columns->own[k]];
        const size_t length = strlen(field->text) + 2;
        if (r->text_room - r->text_length < length) {
            const size_t room = 2 * r->text_room + length + CLI_BLOCK;
            char *texts = realloc(r->texts, room);
            if (!texts) return false;
            r->texts = texts;
            r->text_room = room;
        }
        r->own[r->count * columns->own_count + k] = r->text_length;
        r->texts[r->text_length] = r->rows.place[columns->own[k]] >= 0 ? CLI_OWN_NUMBER
                                   : field->quoted                     ? CLI_OWN_QUOTED
                                                                       : CLI_OWN_TEXT;
        memcpy(r->texts + r->text_length + 1, field->text, length - 1);
        r->text_length += length;
    }
    return true;
}

/* The text of the query being gathered, if there is one, moves to the front. */
static void move_own(query_run *r) {
    const size_t each = r->table.columns.own_count;
    if (!each || !r->gathered) {
        r->text_length = 0;
        return;
    }
    const size_t first = r->own[r->count * each];
    r->text_length -= first;
    memmove(r->texts, r->texts + first, r->text_length);
    for (size_t k = 0; k < each; k++) r->own[k] = r->own[r->count * each + k] - first;
}

static void add_row(query_run *r, const double *values) {
    const size_t skip = r->grouped;
    if (r->grouped && !is_id(values[0])) {
        refuse(r, r->rows.line, "The column query holds no whole number.");
        r->spoilt = true;
        return;
    }
    if (r->grouped && is_late(r, (uint64_t)values[0])) {
        char sentence[120];
        snprintf(sentence, sizeof sentence, "Rows of one query follow each other, and those of query %.0f ended above.",
                 values[0]);
        return refuse(r, r->rows.line, sentence);
    }
    open_query(r, r->grouped ? (uint64_t)values[0] : r->rows.row);
    if (r->code) return;
    if (rows_held(r) == r->room) {
        const size_t room = 2 * r->room + CLI_BLOCK;
        double *numbers = realloc(r->numbers, room * r->width * sizeof *numbers);
        if (!numbers) {
            r->code = cli_fail_memory();
            return;
        }
        r->numbers = numbers;
        r->room = room;
    }
    if (!r->gathered && !keep_own(r)) {
        r->code = cli_fail_memory();
        return;
    }
    r->outside += r->bounded && fabs(values[skip]) > half_turn;
    memcpy(r->numbers + rows_held(r) * r->width, values + skip, r->width * sizeof *values);
    r->gathered++;
    if (!r->grouped) close_query(r);
}

/* A bad row spoils its query, which is the one being gathered if the row names none. */
static void spoil_query(query_run *r, double id) {
    const bool named = r->grouped && is_id(id);
    if (named && is_late(r, (uint64_t)id)) return;
    if (named) open_query(r, (uint64_t)id);
    r->spoilt = r->open;
}

/* Reads until the block is full or the file ends. */
static void read_block(query_run *r) {
    double values[CLI_ROW_NUMBERS];
    while (!r->code && !r->ended && r->count < CLI_BLOCK) {
        values[0] = NAN;
        switch (cli_rows_next(&r->rows, values)) { /* one way: each outcome has a case */
        case CLI_ROW_READ:
            add_row(r, values);
            break;
        case CLI_ROW_BAD:
            spoil_query(r, values[0]);
            if (!r->code) refuse(r, r->rows.line, r->rows.sentence);
            break;
        case CLI_ROWS_END:
            r->ended = true;
            break;
        case CLI_ROWS_FAILED:
            r->code = r->rows.code;
            break;
        }
    }
    if (r->ended) close_query(r);
}

/* -------------------------------------------------------------- answering -- */

/* The queries first .. first + count of the block. */
static froe_status answer_rows(query_run *r, size_t first, size_t count, froe_diagnostic *diag) {
    const cli_block block = {.count = count,
                             .width = r->width,
                             .starts = r->starts + first,
                             .numbers = r->numbers,
                             .ids = r->ids + first,
                             .own = r->own ? r->own + first * r->table.columns.own_count : NULL,
                             .texts = r->texts};
    if (!count) return FROE_OK;
    r->table.block = &block;
    froe_status status = r->q->answer(r->q->given, r->asked, &block, &r->table, diag);
    if (!status) status = r->table.status;
    if (!status) r->answered += count;
    return status;
}

static void answer_block(query_run *r, size_t count) {
    size_t first = 0;
    while (first < count) {
        froe_diagnostic diag = {0};
        froe_status status = answer_rows(r, first, count - first, &diag);
        if (!status) return;
        size_t bad = diag.object;
        if (status == FROE_E_INPUT && bad < count - first) {
            status = answer_rows(r, first, bad, &diag);
            if (!status) refuse(r, r->lines[first + bad], diag.message);
            first += bad + 1;
        }
        diag.object = FROE_NONE; /* it was that of the question */
        if (status) r->code = cli_fail_status(CLI_WORKING, r->q->tree->scene.path, status, &diag);
        if (r->code) return;
    }
}

static void work(query_run *r) {
    while (!r->ended && !r->code) {
        read_block(r);
        const int code = r->code; /* what was read before a bad row is answered all the same */
        const size_t count = r->count, width = r->width;
        r->code = 0;
        answer_block(r, count);
        if (!r->code) r->code = code;
        if (r->gathered) /* the query being gathered moves to the front */
            memmove(r->numbers, r->numbers + r->starts[count] * width, r->gathered * width * sizeof *r->numbers);
        move_own(r);
        r->ids[0] = r->ids[count];
        r->lines[0] = r->lines[count];
        r->count = 0;
        if (!r->code && cli_interrupted()) r->code = cli_fail_cancelled(NULL);
    }
}

/* ---------------------------------------------------------------- summary -- */

json_t *cli_statistics_json(froe_query *query) {
    const froe_query_stats s = query ? froe_query_statistics(query) : (froe_query_stats){0};
    return json_pack("{s:I, s:I, s:I, s:I, s:I, s:I}", "nodes", (json_int_t)s.nodes, "leaves", (json_int_t)s.leaves,
                     "tests", (json_int_t)s.tests, "exact", (json_int_t)s.exact, "slices", (json_int_t)s.slices,
                     "steps", (json_int_t)s.steps);
}

static int report_batch(const query_run *r, double start) {
    const cli_queries *q = r->q;
    return cli_report(q->common, NULL,
                      json_pack("{s:o, s:o, s:I, s:I, s:f, s:o}", "tree", cli_name_json(q->tree->scene.path), "queries",
                                cli_name_json(r->rows.path), "answered", (json_int_t)r->answered, "rows",
                                (json_int_t)r->table.out.rows, "seconds", cli_seconds() - start, "visited",
                                cli_statistics_json(r->asked->query)));
}

/* Reads and answers all queries, once the file of queries is open. */
static int ask_rows(query_run *r, double start) {
    const cli_queries *q = r->q;
    int code =
        cli_table_open(q->common, &q->args->table, &q->kind, &r->rows, r->asked->scene, r->asked->query, &r->table);
    if (code) return code;
    r->table.shards = r->asked->shards;
    r->width = r->rows.numbers - r->grouped;
    r->bounded = is_bounded(r);
    warn_axes(r);
    const size_t each = r->table.columns.own_count;
    for (size_t k = 0; k < each; k++) r->rows.kept[r->table.columns.own[k]] = true;
    if (each) r->own = calloc((CLI_BLOCK + 1) * each, sizeof *r->own);
    if (each && !r->own)
        code = cli_fail_memory();
    else
        work(r);
    if (!code) code = r->code ? r->code : r->refused ? CLI_INPUT : 0;
    const int closed = cli_table_close(&r->table, r->code != 0);
    warn_outside(r);
    const int reported = q->common->json && !r->code ? report_batch(r, start) : 0;
    return closed ? closed : reported ? reported : code;
}

static int ask_batch(const cli_queries *queries, const cli_asked *asked) {
    query_run *r = calloc(1, sizeof *r);
    if (!r) return cli_fail_memory();
    r->q = queries;
    r->asked = asked;
    r->grouped = !strcmp(queries->columns[0].name, "query");
    const double start = cli_seconds();
    int code = cli_rows_open(queries->args->input, queries->columns, (int)asked->dim, &r->rows);
    if (!code) {
        code = ask_rows(r, start);
        cli_rows_close(&r->rows);
    }
    free(r->numbers);
    free(r->own);
    free(r->texts);
    free(r->seen.places);
    free(r);
    return code;
}

int cli_scene_of_shards(const char *path, froe_shards *shards, const froe_scene **scene) {
    froe_diagnostic diag;
    const froe_tree *tree = NULL;
    const uint32_t count = froe_shards_about(shards).shards;
    froe_status status = FROE_OK;
    for (uint32_t i = 0; i < count && !tree && !status; i++) status = froe_shards_tree(shards, i, &tree, &diag);
    if (status) return cli_fail_status(CLI_READING, path, status, &diag);
    *scene = froe_tree_scene(tree);
    return 0;
}

static int ask_folder(const cli_queries *queries) {
    cli_asked asked = {.batch = froe_batch_defaults()};
    const char *path = queries->tree->scene.path;
    int code = cli_open_shards(queries->tree, &asked.shards);
    if (code) return code;
    code = cli_scene_of_shards(path, asked.shards, &asked.scene);
    asked.dim = (size_t)froe_shards_about(asked.shards).dim;
    asked.batch.threads = (unsigned)queries->common->threads;
    if (!code) code = ask_batch(queries, &asked);
    froe_shards_close(asked.shards);
    return code;
}

int cli_queries_run(const cli_queries *queries) {
    froe_tree *tree;
    froe_diagnostic diag;
    if (froe_is_shards(queries->tree->scene.path)) return ask_folder(queries);
    if (!strcmp(queries->tree->scene.path, "-") && !strcmp(queries->args->input, "-"))
        return cli_fail(CLI_USE, NULL, "Standard input is named twice: as the scene and as the file of queries.");
    int code = cli_open_tree(queries->common, queries->tree, "query", &tree);
    if (code) return code;
    cli_asked asked = {.scene = froe_tree_scene(tree), .batch = froe_batch_defaults()};
    asked.dim = (size_t)froe_scene_dim(asked.scene);
    asked.batch.threads = (unsigned)queries->common->threads;
    const froe_status status = froe_query_new(tree, &asked.query, &diag);
    code = status ? cli_fail_status(CLI_WORKING, queries->tree->scene.path, status, &diag) : ask_batch(queries, &asked);
    froe_query_free(asked.query);
    froe_tree_free(tree);
    return code;
}
