/* table.c: see table.h. */
#include "queries/table.h"
#include "exit.h"
#include "queries/geometry.h"
#include "report/report.h"
#include "support/text/geojson.h"
#include <stdlib.h>
#include <string.h>

static const char *const formats[] = {[CLI_CSV] = "csv", [CLI_JSONL] = "jsonl", [CLI_GEOJSON] = "geojson", NULL};

const cli_option cli_table_options[] = {
    {"columns", 0, CLI_TEXT, offsetof(cli_table_args, columns), "LIST",
     .help = "what each answer shows: names of columns between commas"},
    {"format", 0, CLI_CHOICE, offsetof(cli_table_args, format), "FORMAT",
     .help = "of the answers: csv (default), jsonl (an object a line) or geojson", .choices = formats,
     .sentence = "--input-format is the option for the format of SCENE."},
    {0},
};

int cli_table_open(const cli_common *common, const cli_table_args *args, const cli_answer_kind *kind,
                   const cli_rows *rows, const froe_scene *scene, froe_query *query, cli_table *out) {
    const cli_format format = args->format < 0 ? CLI_CSV : (cli_format)args->format;
    const int dim = froe_scene_dim(scene);
    out->shape = format == CLI_GEOJSON ? kind->shape : CLI_SHAPE_NONE;
    out->scene = scene;
    out->query = query;
    if (common->json && (args->columns || args->format >= 0))
        return cli_fail(CLI_USE, NULL, "--json: It excludes --%s, because a summary takes the place of the answers.",
                        args->columns ? "columns" : "format");
    if (format == CLI_GEOJSON && dim > 3)
        return cli_fail(CLI_USE, NULL, "--format: GeoJSON has at most 3 dimensions, and the scene has %d.", dim);
    const froe_crs crs = froe_scene_crs(scene);
    if (format == CLI_GEOJSON && !support_geojson_names(&crs))
        return cli_fail(CLI_USE, NULL,
                        "--format: GeoJSON cannot name the coordinate system '%s', because it has no code.", crs.name);
    const int code = cli_columns_open(args->columns, kind->standard, kind->known, rows, dim, &out->columns);
    if (code) return code;
    const bool point = cli_columns_show(&out->columns, CLI_FIELD_POINT);
    const bool ray = kind->shape == CLI_SHAPE_HIT;
    out->nearest = out->shape == CLI_SHAPE_NEAREST || (point && !ray);
    out->hit = out->shape == CLI_SHAPE_HIT || (point && ray) || cli_columns_show(&out->columns, CLI_FIELD_NORMAL) ||
               (cli_columns_show(&out->columns, CLI_FIELD_DISTANCE) && ray);
    cli_answers_open(&out->out, format, common->json, out->columns.names, out->columns.count);
    if (format == CLI_GEOJSON) cli_answers_put(&out->out, support_geojson_begin(&crs).text);
    return 0;
}

int cli_table_close(cli_table *table, bool failed) {
    if (failed && !table->out.rows) table->out.mute = true;
    cli_answers_close(&table->out);
    cli_columns_free(&table->columns);
    free(table->group_ids);
    table->group_ids = NULL;
    return cli_flush();
}

/* ------------------------------------------------------------------- cells -- */

/* The id of the feature that a group is. */
static void put_group_id(cli_table *t, uint32_t group) {
    const uint32_t objects = (uint32_t)froe_scene_object_count(t->scene);
    if (t->group_scene != t->scene) {
        free(t->group_ids);
        t->group_scene = t->scene;
        t->group_ids = calloc(froe_scene_group_count(t->scene) + 1, sizeof *t->group_ids);
        for (uint32_t i = objects; t->group_ids && i-- > 0;) {
            const froe_object object = froe_scene_object(t->scene, i);
            if (object.group != FROE_NONE) t->group_ids[object.group] = object.tag;
        }
    }
    if (t->group_ids)
        cli_answers_whole(&t->out, t->group_ids[group]);
    else
        t->status = FROE_E_MEMORY;
}

static void put_number_or_none(cli_answers *out, uint32_t id) {
    if (id == FROE_NONE)
        cli_answers_none(out);
    else
        cli_answers_whole(out, id);
}

/* What belongs to an object, or to a group where there is none. */
static void put_of_object(cli_table *t, cli_field field, uint32_t object, uint32_t group) {
    cli_answers *out = &t->out;
    if (field == CLI_FIELD_OBJECT && (!t->shards || object == FROE_NONE)) return put_number_or_none(out, object);
    const froe_object o = froe_scene_object(t->scene, object);
    if (field == CLI_FIELD_OBJECT) return cli_answers_whole(out, o.tag); /* folders call objects by their tags */
    if (object != FROE_NONE) group = o.group;
    if (field == CLI_FIELD_GROUP) return put_number_or_none(out, group);
    if (field == CLI_FIELD_ID && object != FROE_NONE) return cli_answers_whole(out, o.tag);
    if (group == FROE_NONE) return cli_answers_none(out);
    if (field == CLI_FIELD_ID) return put_group_id(t, group);
    cli_answers_text(out, froe_scene_group(t->scene, group).name);
}

static void put_shown(cli_table *t, const cli_shown *shown, const cli_answer *a) {
    cli_answers *out = &t->out;
    switch (shown->field) { /* one way: each field has a case */
    case CLI_FIELD_QUERY:
        return cli_answers_whole(out, t->block->ids[a->at]);
    case CLI_FIELD_OBJECT:
    case CLI_FIELD_GROUP:
    case CLI_FIELD_NAME:
    case CLI_FIELD_ID:
        return put_of_object(t, shown->field, shown->second ? a->other : a->object, a->group);
    case CLI_FIELD_T:
        return cli_answers_real(out, a->value);
    case CLI_FIELD_DISTANCE:
        return cli_answers_real(out, t->hit ? t->place.distance : a->value);
    case CLI_FIELD_POINT:
        return cli_answers_real(out, t->place.point[shown->at]);
    case CLI_FIELD_NORMAL: {
        bool faced = false;
        for (int k = 0; k < FROE_MAX_DIM; k++) faced = faced || t->place.normal[k] != 0;
        return faced ? cli_answers_real(out, t->place.normal[shown->at]) : cli_answers_none(out);
    }
    case CLI_FIELD_COUNT:
        return cli_answers_whole(out, a->count);
    case CLI_FIELD_KIND:
        return cli_answers_text(out, a->kind);
    case CLI_FIELD_OWN: {
        const char *text = t->block->texts + t->block->own[a->at * t->columns.own_count + shown->own];
        return cli_answers_own(out, text + 1, (cli_own)*text);
    }
    }
}

/* -------------------------------------------------------------------- rows -- */

/* Asks where on the object the answer is. */
static void find_place(cli_table *t, const cli_answer *a) {
    const size_t dim = (size_t)froe_scene_dim(t->scene);
    const double *numbers = t->block->numbers + t->block->starts[a->at] * t->block->width;
    const froe_status status = t->hit
                                   ? froe_query_hit_place(t->query, a->object, numbers, numbers + dim, &t->place, NULL)
                                   : froe_query_nearest_point(t->query, a->object, numbers, t->place.point, NULL);
    if (status) t->status = status;
}

/* What is asked for about an answer of a folder is asked of its shard. */
static bool enter_shard(cli_table *t, uint32_t shard) {
    const froe_tree *tree = NULL;
    froe_status status = froe_shards_tree(t->shards, shard, &tree, NULL);
    if (!status) status = froe_shards_query(t->shards, shard, &t->query, NULL);
    if (!status) t->scene = froe_tree_scene(tree);
    if (status) t->status = status;
    return !status;
}

void cli_table_put(cli_table *table, const cli_answer *answer) {
    if (answer->find && answer->find->shard != FROE_NONE && !enter_shard(table, answer->find->shard)) return;
    if (table->nearest || table->hit) find_place(table, answer);
    cli_answers_begin(&table->out);
    if (table->out.format == CLI_GEOJSON) {
        cli_put_geometry(table, answer);
        cli_answers_put(&table->out, ",\"properties\":{");
    }
    for (size_t i = 0; i < table->columns.count; i++) put_shown(table, table->columns.shown + i, answer);
    cli_answers_end(&table->out);
}

static int by_number(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Few numbers, each inserted among those before it. */
static void sort_few(uint32_t *ids, size_t count) {
    for (size_t i = 1; i < count; i++) {
        const uint32_t id = ids[i];
        size_t at = i;
        for (; at && ids[at - 1] > id; at--) ids[at] = ids[at - 1];
        ids[at] = id;
    }
}

void cli_sort_answers(froe_answers *answers) {
    enum { FEW = 24 };
    for (size_t i = 0; i < answers->queries; i++) {
        uint32_t *ids = answers->ids + answers->starts[i];
        const size_t count = answers->starts[i + 1] - answers->starts[i];
        if (count > FEW)
            qsort(ids, count, sizeof *ids, by_number);
        else
            sort_few(ids, count);
    }
}

/* Answers i are ids of objects, or of groups. */
static void put_lists(cli_table *table, const froe_answers *answers, bool groups, bool count) {
    for (size_t i = 0; i < answers->queries; i++) {
        const size_t first = answers->starts[i], end = answers->starts[i + 1];
        cli_answer a = {.at = i, .object = FROE_NONE, .group = FROE_NONE, .count = end - first};
        if (count) cli_table_put(table, &a);
        for (size_t j = first; j < end && !count; j++) {
            *(groups ? &a.group : &a.object) = answers->ids[j];
            cli_table_put(table, &a);
        }
    }
}

void cli_table_put_lists(cli_table *table, froe_answers *answers, bool count) {
    if (!count) cli_sort_answers(answers);
    put_lists(table, answers, false, count);
}

void cli_table_put_finds(cli_table *table, const froe_finds *finds, bool count) {
    for (size_t i = 0; i < finds->questions; i++) {
        const size_t first = finds->starts[i], end = finds->starts[i + 1];
        if (count)
            cli_table_put(table, &(cli_answer){.at = i, .object = FROE_NONE, .group = FROE_NONE, .count = end - first});
        for (size_t j = first; j < end && !count; j++) {
            const froe_find *find = finds->items + j;
            const bool group = find->object == FROE_NONE;
            cli_table_put(table, &(cli_answer){.at = i,
                                               .object = find->object,
                                               .group = group ? (uint32_t)find->tag : FROE_NONE,
                                               .value = find->value,
                                               .find = find});
        }
    }
}

void cli_table_put_firsts(cli_table *table, const froe_find *finds, size_t queries, bool count) {
    for (size_t i = 0; i < queries; i++) {
        const bool found = finds[i].object != FROE_NONE;
        if (found || count)
            cli_table_put(table, &(cli_answer){.at = i,
                                               .object = finds[i].object,
                                               .group = FROE_NONE,
                                               .value = finds[i].value,
                                               .count = found,
                                               .find = &finds[i]});
    }
}

void cli_table_put_groups(cli_table *table, const froe_answers *answers, bool count) {
    put_lists(table, answers, true, count);
}
