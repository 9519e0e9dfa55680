/* range.c: froe range, the objects that meet boxes, balls and other convex ranges. */
#include "command.h"
#include "exit.h"
#include "queries/queries.h"
#include "support/fail.h"
#include <stdlib.h>
#include <string.h>

typedef struct range_args {
    cli_common common;
    cli_tree_args tree;
    cli_query_args query;
    int shape, walk, relation;
    double eps;
    bool groups;
} range_args;

static const char *const shapes[] = {[FROE_SHAPE_BOX] = "box",
                                     [FROE_SHAPE_BALL] = "ball",
                                     [FROE_SHAPE_SIMPLEX] = "simplex",
                                     [FROE_SHAPE_CAPSULE] = "capsule",
                                     [FROE_SHAPE_HALFSPACES] = "halfspaces",
                                     [FROE_SHAPE_HULL] = "hull",
                                     [FROE_SHAPE_SEGMENT] = "segment",
                                     [FROE_SHAPE_RAY] = "ray",
                                     NULL};

static const char *const walks[] = {[FROE_WALK_AUTO] = "auto", [FROE_WALK_PLAIN] = "plain",     [FROE_WALK_BOX] = "box",
                                    [FROE_WALK_LCA] = "lca",   [FROE_WALK_CLASSES] = "classes", NULL};

static const char *const relations[] = {
    [FROE_MEETS] = "meets", [FROE_WITHIN] = "within", [FROE_COVERS] = "covers", NULL};

/* The columns of each shape, in the order of froe_range's points. */
static const cli_column columns[FROE_SHAPE_COUNT][4] = {
    [FROE_SHAPE_BOX] = {{"lo_", true}, {"hi_", true}},
    [FROE_SHAPE_BALL] = {{"", true}, {"r", false}},
    [FROE_SHAPE_SIMPLEX] = {{"query", false}, {"", true}},
    [FROE_SHAPE_CAPSULE] = {{"a", true}, {"b", true}, {"r", false}},
    [FROE_SHAPE_HALFSPACES] = {{"query", false}, {"n", true}, {"c", false}},
    [FROE_SHAPE_HULL] = {{"query", false}, {"", true}},
    [FROE_SHAPE_SEGMENT] = {{"a", true}, {"b", true}},
    [FROE_SHAPE_RAY] = {{"o", true}, {"d", true}},
};

static const cli_option options[] = {
    {"queries", 0, CLI_TEXT, offsetof(range_args, query.input), "CSV", .file = CLI_READ,
     .help = "the ranges; - for standard input", .required = true},
    {"shape", 0, CLI_CHOICE, offsetof(range_args, shape), "SHAPE",
     .help = "box (default), ball, simplex, capsule, halfspaces, hull, segment or ray", .choices = shapes},
    {"groups", 0, CLI_FLAG, offsetof(range_args, groups),
     .help = "groups with their names, and no objects (plane): areas of maps count as a whole"},
    {"relation", 0, CLI_CHOICE, offsetof(range_args, relation), "HOW",
     .help = "of --groups: meets (default), within (the group lies in the range) or covers (the range in the group)",
     .choices = relations},
    {"eps", 0, CLI_REAL, offsetof(range_args, eps), "E",
     .help = "also allow objects within E times the diameter of the range; faster (default 0: exactly)"},
    {"walk", 0, CLI_CHOICE, offsetof(range_args, walk), "HOW",
     .help = "how to search: plain, box, lca, classes or auto (default); answers are the same", .choices = walks},
    {0},
};

static const cli_part parts[] = {CLI_TREE_PART(range_args),          {"Range", options, 0},
                                 CLI_QUERY_PARTS(range_args),        CLI_TREE_BUILD_PARTS(range_args),
                                 {"Options", cli_common_options, 0}, {0}};

/* Makes froe_ranges of a block. Returns how many can be asked about: the one behind them has not as many rows as it
 * must. normals, offsets: room for the halfspaces of all rows. */
static size_t lay_ranges(const range_args *args, size_t dim, const cli_block *block, double *normals, double *offsets,
                         froe_range *ranges) {
    for (size_t i = 0; i < block->count; i++) {
        const size_t first = block->starts[i], end = block->starts[i + 1];
        const double *row = block->numbers + first * block->width;
        froe_range *r = &ranges[i];
        *r = froe_range_defaults();
        r->shape = (froe_range_shape)args->shape;
        r->points = row;
        r->count = end - first;
        r->eps = args->eps;
        r->walk = (froe_walk)args->walk;
        if (r->shape == FROE_SHAPE_BALL || r->shape == FROE_SHAPE_CAPSULE) r->radius = row[block->width - 1];
        if (r->shape == FROE_SHAPE_HALFSPACES) {
            r->points = normals + first * dim;
            r->offsets = offsets + first;
            for (size_t j = first; j < end; j++, row += block->width) {
                memcpy(normals + j * dim, row, dim * sizeof *row);
                offsets[j] = row[dim];
            }
        }
        if (r->shape == FROE_SHAPE_SIMPLEX && r->count != dim + 1) return i;
    }
    return block->count;
}

static froe_status answer_range(const void *given, const cli_asked *asked, const cli_block *block, cli_table *out,
                                froe_diagnostic *diag) {
    const range_args *args = given;
    const size_t rows = block->starts[block->count];
    froe_range *ranges = calloc(block->count, sizeof *ranges);
    double *normals = calloc(rows * asked->dim, sizeof *normals), *offsets = calloc(rows, sizeof *offsets);
    froe_answers answers = {0};
    froe_finds finds = {0};
    froe_status status;
    if (ranges && normals && offsets) {
        const size_t count = lay_ranges(args, asked->dim, block, normals, offsets, ranges);
        if (asked->shards)
            status = args->groups ? froe_shards_groups_range(asked->shards, ranges, count,
                                                             (froe_relation)args->relation, &asked->batch, &finds, diag)
                                  : froe_shards_range(asked->shards, ranges, count, &asked->batch, &finds, diag);
        else
            status = args->groups ? froe_batch_groups_range(asked->query, ranges, count, (froe_relation)args->relation,
                                                            &asked->batch, &answers, diag)
                                  : froe_batch_range(asked->query, ranges, count, &asked->batch, &answers, diag);
        if (!status && count < block->count)
            status = support_fail_at(diag, FROE_E_INPUT, (uint32_t)count, FROE_NONE, FROE_NONE,
                                     "A simplex has one corner more than there are dimensions.");
    } else {
        status = support_fail_memory(diag);
    }
    if (status == FROE_E_UNSUPPORTED) status = diag->status = FROE_E_INPUT; /* of the query, which is to be named */
    if (!status && asked->shards)
        cli_table_put_finds(out, &finds, args->query.count);
    else if (!status && args->groups)
        cli_table_put_groups(out, &answers, args->query.count);
    else if (!status)
        cli_table_put_lists(out, &answers, args->query.count);
    froe_answers_free(&answers);
    froe_finds_free(&finds);
    free(ranges), free(normals), free(offsets);
    return status;
}

static int run_range(const void *given) {
    const range_args *args = given;
    if (args->eps < 0) return cli_fail(CLI_USE, NULL, "--eps: '%g' is not a number >= 0.", args->eps);
    if (args->relation && !args->groups) return cli_fail(CLI_USE, NULL, "--relation: It needs --groups.");
    const cli_answer_kind objects = {"query,object", "query,object,group,name,id", CLI_SHAPE_OBJECT},
                          groups = {"query,group,name", "query,group,name,id", CLI_SHAPE_NONE};
    const cli_queries queries = {.common = &args->common,
                                 .tree = &args->tree,
                                 .args = &args->query,
                                 .columns = columns[args->shape],
                                 .kind = args->query.count ? CLI_COUNTS(CLI_SHAPE_NONE)
                                         : args->groups    ? groups
                                                           : objects,
                                 .answer = answer_range,
                                 .given = args};
    return cli_queries_run(&queries);
}

const cli_command cli_command_range = {
    .name = "range",
    .summary = "find the objects that meet boxes, balls and other convex ranges",
    .about =
        "Prints one line query,object for each object that meets a range, in the order of the ranges, then of the "
        "objects. Ranges and objects are closed, and answers are exact. A query's number is that of its row, from 0, "
        "or, where several rows make a range, what its column query says.\n\n"
        "Columns of the CSV, where x,y is x,y,z in space: box lo_x,lo_y,hi_x,hi_y or xmin,ymin,xmax,ymax (inf and -inf "
        "are bounds, too); ball x,y,r; capsule ax,ay,bx,by,r; segment ax,ay,bx,by; ray ox,oy,dx,dy. Of simplex and "
        "hull, query,x,y, each row is a corner; of halfspaces, query,nx,ny,c, each row is a halfspace n . x <= c; rows "
        "of one query follow each other.\n\n"
        "With --groups, lines query,group,name: the groups that meet the range, or with --relation those that lie in "
        "it "
        "or cover it. A group of closed rings is an area, holes left out, and its border belongs to it.\n\n"
        "With --columns, each line has the columns that are named there. The command has query, object, group, name "
        "and id. " CLI_COLUMNS_ABOUT
        "With --json a summary takes the place of the answers: how many there are, and what was visited for them.",
    .examples = "froe range floor.geojson --queries windows.csv\n"
                "froe range floor.geojson --queries discs.csv --shape ball --count\n"
                "froe range countries.geojson --queries windows.csv --groups --relation covers\n",
    .parts = parts,
    .defaults = &(
        const range_args){.common = CLI_COMMON_DEFAULTS, .tree = CLI_TREE_DEFAULTS, .query.table = CLI_TABLE_DEFAULTS},
    .size = sizeof(range_args),
    .run = run_range,
};
