/* test_questions.c: folders of 1, 2, 7 and 64 shards answer every question as a single tree does, also where cuts go
 * through corners of objects and of questions. With a number as argument: so many objects of every kind, in all of
 * these folders, and a row of Markdown for each folder that says what was compared. A pattern of names as a second
 * argument: these tests alone ("*space"). A kind as a third: its objects alone ("ball"), or "all" kinds mixed. A
 * fourth: one folder alone, of so many shards by medians ("7"), or on the lattice ("-64"). */
#include "shards/folders.h"
#include "shards/plan.h"
#include <froe/shard_parts.h>
#include <math.h>

enum { USUAL = 240, QUESTIONS = 100, EDGES = 6, CLOSE = 10000 };
static size_t object_count = USUAL;
static bool thorough;
static const char *only; /* a kind, or NULL: all of them */
static int only_shards;  /* as in compare_everything(); 0: all of them */

/* ------------------------------------------------------------------- worlds -- */

/* The same objects as a single tree, in the order of their tags, and as a folder. */
typedef struct world {
    int dim, most; /* coordinates are 0 to `most`, about */
    bool areas;    /* every EDGES segments are two triangles of a group */
    froe_scene *scene;
    froe_tree *tree;
    froe_query *query;
    froe_shards *shards;
    uint64_t state;                     /* of random numbers */
    uint64_t questions, answers, pairs; /* compared so far */
} world;

/* 24 for 400 objects, and as dense with more of them; with many, less. */
static int lattice_of(int dim) {
    return (int)((object_count > CLOSE ? 72 : 24) * pow((double)object_count / USUAL, 1.0 / dim));
}

/* Groups of two triangles, which lie beside each other, one in the other, or cross. Tags ascend. */
static one_object *lattice_areas(int most, uint64_t seed) {
    one_object *list = calloc(object_count, sizeof *list);
    assert_non_null(list);
    uint64_t state = seed;
    for (size_t i = 0; i < object_count; i += EDGES) {
        double from[2], corner[3][2];
        for (int a = 0; a < 2; a++) from[a] = on_lattice(&state, most);
        for (size_t e = 0; e < EDGES; e++) {
            for (int a = 0; a < 2 && e % 3 == 0; a++) {
                corner[0][a] = from[a] + on_lattice(&state, 3);
                corner[1][a] = corner[0][a] + on_lattice(&state, 4) + !a;
                corner[2][a] = corner[0][a] + on_lattice(&state, 4) + a;
            }
            list[i + e] = (one_object){.kind = FROE_SEGMENT, .corners = 2, .tag = 3 * (i + e) + 5};
            memcpy(list[i + e].at, corner[e % 3], sizeof *corner);
            memcpy(list[i + e].at + 2, corner[(e + 1) % 3], sizeof *corner);
        }
    }
    return list;
}

/* Object i as a batch. */
static froe_objects batch_in(bool areas, const one_object *list, size_t i, size_t starts[2], uint32_t *face) {
    froe_objects batch = batch_of(list + i, starts);
    *face = (uint32_t)(i / 3 * 3);
    if (areas) batch.group = (uint32_t)(i / EDGES), batch.faces = face;
    return batch;
}

/* Cuts at whole numbers, where corners of lattice objects lie: axis after axis, each cell halved. */
static froe_shard_plan *plan_on_lattice(int dim, int most, uint32_t shards) {
    const froe_allocator alloc = support_allocator(NULL);
    froe_shard_plan *plan = shards_plan_make(dim, &alloc);
    struct part {
        uint32_t shards;
        int axis;
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    } stack[64], part = {.shards = shards};
    int depth = 0;
    for (int a = 0; a < dim; a++) part.hi[a] = most;
    stack[depth++] = part;
    while (depth) {
        part = stack[--depth];
        const int axis = part.shards > 1 ? part.axis : -1;
        const double value = axis < 0 ? 0 : floor((part.lo[axis] + part.hi[axis]) / 2);
        assert_true(array_push(&alloc, &plan->nodes, (shards_node){.axis = axis, .value = value}));
        if (axis < 0) continue;
        struct part lower = part, upper = part;
        lower.axis = upper.axis = (axis + 1) % dim;
        lower.shards = part.shards / 2;
        upper.shards = part.shards - lower.shards;
        lower.hi[axis] = upper.lo[axis] = value;
        stack[depth++] = upper;
        stack[depth++] = lower;
    }
    assert_int_equal(shards_plan_join(plan), FROE_OK);
    return plan;
}

static froe_status gather(void *user, const void *records, size_t count) {
    return froe_shard_records_append(user, records, count, NULL);
}

/* The box of an object, or of its group. */
static void box_of_all(const one_object *list, bool areas, size_t i, double *lo, double *hi, int dim) {
    for (size_t j = areas ? i / EDGES * EDGES : i, end = areas ? j + EDGES : i + 1, first = j; j < end; j++) {
        froe_shard_records one = {0};
        size_t starts[2];
        double a[FROE_MAX_DIM], b[FROE_MAX_DIM];
        const froe_objects batch = batch_of(list + j, starts);
        assert_int_equal(froe_shard_records_add(&one, dim, &batch, 0, NULL), FROE_OK);
        froe_shard_record_box(one.bytes, a, b);
        for (int k = 0; k < dim; k++) {
            lo[k] = j == first || a[k] < lo[k] ? a[k] : lo[k];
            hi[k] = j == first || b[k] > hi[k] ? b[k] : hi[k];
        }
        froe_shard_records_free(&one);
    }
}

/* Builds a folder with a plan of the test's own; `areas`: the scene whose groups the objects have, or NULL. */
static void build_by_plan(const char *path, froe_shard_plan *plan, const one_object *list, const froe_scene *areas) {
    froe_shard_draft *draft;
    froe_shard_buckets *buckets;
    froe_shard_entry entries[64];
    const froe_shards_options o = froe_shards_defaults();
    plan->areas = areas != NULL;
    assert_int_equal(froe_shard_draft_begin(path, NULL, &draft, NULL), FROE_OK);
    assert_int_equal(froe_shard_buckets_new(froe_shard_draft_folder(draft), plan->count, NULL, &buckets, NULL),
                     FROE_OK);
    for (size_t i = 0; i < object_count; i++) {
        froe_shard_records one = {0};
        size_t starts[2];
        double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
        uint32_t cells[64], face;
        const froe_objects batch = batch_in(areas, list, i, starts, &face);
        assert_int_equal(froe_shard_records_add(&one, plan->dim, &batch, 0, NULL), FROE_OK);
        box_of_all(list, areas, i, lo, hi, plan->dim);
        const uint32_t count = froe_shard_plan_cells(plan, lo, hi, cells);
        for (uint32_t c = 0; c < count; c++)
            assert_int_equal(froe_shard_buckets_add(buckets, cells[c], one.bytes, one.count, NULL), FROE_OK);
        froe_shard_records_free(&one);
    }
    for (uint32_t s = 0; s < plan->count; s++) {
        froe_shard_records records = {0};
        assert_int_equal(froe_shard_buckets_take(buckets, s, gather, &records, NULL), FROE_OK);
        assert_int_equal(
            froe_shard_build(&records, plan, s, areas, &o, froe_shard_draft_folder(draft), &entries[s], NULL), FROE_OK);
        froe_shard_records_free(&records);
    }
    assert_int_equal(froe_shard_manifest_write(plan, entries, froe_shard_draft_folder(draft), NULL, NULL), FROE_OK);
    froe_shard_buckets_free(buckets);
    assert_int_equal(froe_shard_draft_end(draft, FROE_OK, NULL), FROE_OK);
    froe_shard_plan_free(plan);
}

static void build_from_scene(const char *path, const froe_scene *scene, const froe_shards_options *o) {
    froe_shards_builder *builder;
    assert_int_equal(froe_shards_begin(path, froe_scene_dim(scene), o, &builder, NULL), FROE_OK);
    assert_int_equal(froe_shards_add_scene(builder, scene, NULL), FROE_OK);
    assert_int_equal(froe_shards_finish(builder, NULL, NULL), FROE_OK);
}

/* The objects in the order of their tags. */
static froe_scene *scene_of(int dim, bool areas, one_object *list) {
    froe_scene *scene;
    uint32_t id;
    qsort(list, object_count, sizeof *list, by_tag_of_object);
    assert_int_equal(froe_scene_new(dim, NULL, &scene), FROE_OK);
    for (size_t i = 0; i < object_count && areas; i += EDGES)
        assert_int_equal(froe_scene_add_group(scene, &(froe_group){.name = "area"}, &id), FROE_OK);
    for (size_t i = 0; i < object_count; i++) {
        size_t starts[2];
        uint32_t face;
        const froe_objects batch = batch_in(areas, list, i, starts, &face);
        assert_int_equal(froe_scene_add(scene, &batch, NULL), FROE_OK);
    }
    return scene;
}

static froe_tree *tree_of(froe_scene *scene) {
    froe_tree *tree;
    froe_build_options b = froe_build_defaults();
    b.purpose = "query";
    assert_int_equal(froe_build(scene, &b, &tree, NULL), FROE_OK);
    return tree;
}

/* shards > 0: cut at medians; < 0: so many, cut at whole numbers. */
static world make_world(int dim, froe_kind kind, bool areas, int shards, uint64_t seed) {
    world w = {.dim = dim, .most = lattice_of(dim), .areas = areas, .state = seed};
    one_object *list = areas ? lattice_areas(w.most, seed) : lattice_objects(dim, kind, object_count, w.most, seed);
    froe_shards_options o = froe_shards_defaults();
    o.shards = (uint32_t)abs(shards);
    if (areas) w.scene = scene_of(dim, areas, list);
    if (shards < 0)
        build_by_plan("asked.froes", plan_on_lattice(dim, w.most, o.shards), list, w.scene);
    else if (areas)
        build_from_scene("asked.froes", w.scene, &o);
    else
        assert_int_equal(build_folder("asked.froes", dim, list, object_count, &o, NULL, NULL), FROE_OK);
    assert_int_equal(froe_shards_open("asked.froes", NULL, &w.shards, NULL), FROE_OK);
    if (!areas) w.scene = scene_of(dim, areas, list);
    w.tree = tree_of(w.scene);
    assert_int_equal(froe_query_new(w.tree, &w.query, NULL), FROE_OK);
    free(list);
    return w;
}

static void free_world(world *w) {
    froe_query_free(w->query);
    froe_tree_free(w->tree);
    froe_scene_free(w->scene);
    froe_shards_close(w->shards);
}

/* ---------------------------------------------------------------- comparing -- */

static uint64_t tag_of(const world *w, uint32_t object) {
    return froe_scene_object(w->scene, object).tag;
}

static int by_id(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Ids ascend with tags. */
static void compare_finds(world *w, froe_answers *tree, froe_finds *folder, bool ordered) {
    assert_int_equal(tree->queries, folder->questions);
    w->questions += tree->queries;
    w->answers += tree->starts[tree->queries];
    for (size_t i = 0; i < tree->queries; i++) {
        const size_t first = tree->starts[i], count = tree->starts[i + 1] - first;
        assert_int_equal(folder->starts[i + 1] - folder->starts[i], count);
        if (!ordered) qsort(tree->ids + first, count, sizeof *tree->ids, by_id);
        for (size_t j = 0; j < count; j++) {
            const froe_find *find = folder->items + folder->starts[i] + j;
            assert_int_equal(find->tag, tag_of(w, tree->ids[first + j]));
            assert_true(find->value == (tree->values ? tree->values[first + j] : 0));
            const froe_tree *shard;
            assert_int_equal(froe_shards_tree(w->shards, find->shard, &shard, NULL), FROE_OK);
            assert_int_equal(froe_scene_object(froe_tree_scene(shard), find->object).tag, find->tag);
        }
    }
    froe_answers_free(tree);
    froe_finds_free(folder);
}

static double halves(world *w) {
    return on_lattice(&w->state, 2 * w->most) / 2;
}

static double *random_points(world *w, size_t count) {
    double *points = calloc(count * (size_t)w->dim, sizeof *points);
    assert_non_null(points);
    for (size_t i = 0; i < count * (size_t)w->dim; i++) points[i] = halves(w);
    return points;
}

/* ---------------------------------------------------------------- questions -- */

enum { CORNERS = FROE_MAX_DIM + 1 }; /* of a range, at most */

/* Ranges of the shapes of a set, most of them small. Among many objects few are large, as halfspaces always are. */
static void random_ranges(world *w, unsigned shapes, froe_range *ranges, double *points, double *offsets) {
    const size_t dim = (size_t)w->dim, large = object_count > CLOSE ? 50 : 9;
    for (size_t i = 0; i < QUESTIONS; i++) {
        froe_range *r = ranges + i;
        double *p = points + i * CORNERS * dim;
        *r = froe_range_defaults();
        do r->shape = (froe_range_shape)(next_random(&w->state) % FROE_SHAPE_COUNT);
        while (!(shapes >> r->shape & 1) || (object_count > CLOSE && i % large && r->shape == FROE_SHAPE_HALFSPACES));
        r->points = p;
        r->count = r->shape == FROE_SHAPE_HULL || r->shape == FROE_SHAPE_HALFSPACES ? 3 : 0;
        r->radius = on_lattice(&w->state, 8) / 2;
        r->offsets = offsets + i;
        for (size_t c = 1; c < CORNERS && i % large; c++)
            for (size_t a = 0; a < dim; a++) p[c * dim + a] = p[a] + on_lattice(&w->state, 16) / 2 - 4;
        for (size_t a = 0; a < dim; a++) {
            const double wide = i % large ? on_lattice(&w->state, 6) / 2 : on_lattice(&w->state, 30);
            if (r->shape == FROE_SHAPE_BOX || r->shape == FROE_SHAPE_SEGMENT) p[dim + a] = p[a] + wide;
            if (r->shape == FROE_SHAPE_RAY || r->shape == FROE_SHAPE_HALFSPACES) p[dim + a] = wide - 2;
        }
        if (r->shape == FROE_SHAPE_RAY) p[dim] += p[dim] == 0;
        if (r->shape == FROE_SHAPE_BOX && i % (large - 2) == 0) p[dim] = INFINITY;
    }
}

static void compare_ranges(world *w) {
    const unsigned all = (1U << FROE_SHAPE_COUNT) - 1, shapes = w->dim > 3 ? all & ~(1U << FROE_SHAPE_RAY) : all;
    froe_range *ranges = calloc(QUESTIONS, sizeof *ranges);
    double *points = random_points(w, QUESTIONS * CORNERS), *offsets = random_points(w, QUESTIONS);
    uint64_t expected[QUESTIONS], counts[QUESTIONS];
    froe_find any[QUESTIONS];
    froe_answers answers;
    froe_finds finds;
    random_ranges(w, shapes, ranges, points, offsets);
    assert_int_equal(froe_batch_range(w->query, ranges, QUESTIONS, NULL, &answers, NULL), FROE_OK);
    assert_int_equal(froe_shards_range(w->shards, ranges, QUESTIONS, NULL, &finds, NULL), FROE_OK);
    compare_finds(w, &answers, &finds, false);
    assert_int_equal(froe_batch_count(w->query, ranges, QUESTIONS, NULL, expected, NULL), FROE_OK);
    assert_int_equal(froe_shards_count(w->shards, ranges, QUESTIONS, NULL, counts, NULL), FROE_OK);
    assert_memory_equal(expected, counts, sizeof counts);
    assert_int_equal(froe_shards_any(w->shards, ranges, QUESTIONS, NULL, any, NULL), FROE_OK);
    for (size_t i = 0; i < QUESTIONS; i++) {
        bool found = false;
        assert_int_equal(any[i].object != FROE_NONE, counts[i] > 0);
        froe_list list;
        assert_int_equal(froe_query_range(w->query, ranges + i, &list, NULL), FROE_OK);
        for (size_t j = 0; j < list.count; j++) found = found || tag_of(w, list.ids[j]) == any[i].tag;
        assert_true(found || !counts[i]);
    }
    free(ranges), free(points), free(offsets);
}

/* How many answers each question has. */
static void compare_counts(const froe_answers *tree, const uint64_t *counts) {
    for (size_t i = 0; i < tree->queries; i++) assert_int_equal(counts[i], tree->starts[i + 1] - tree->starts[i]);
}

static void compare_points(world *w) {
    double *points = random_points(w, QUESTIONS);
    uint64_t counts[QUESTIONS];
    static const size_t some[] = {1, 3, 20, 0};
    static const double bounds[] = {INFINITY, 4, 1, 0};
    froe_answers answers;
    froe_finds finds;
    assert_int_equal(froe_batch_locate(w->query, points, QUESTIONS, NULL, &answers, NULL), FROE_OK);
    assert_int_equal(froe_shards_locate(w->shards, points, QUESTIONS, NULL, &finds, NULL), FROE_OK);
    assert_int_equal(froe_shards_locate_count(w->shards, points, QUESTIONS, NULL, counts, NULL), FROE_OK);
    compare_counts(&answers, counts);
    compare_finds(w, &answers, &finds, false);
    for (size_t i = 0; i < 16; i++) {
        const size_t k = some[i % 4], n = QUESTIONS / 4;
        const double bound = bounds[i / 4];
        assert_int_equal(froe_batch_near(w->query, points, n, k, bound, NULL, &answers, NULL), FROE_OK);
        assert_int_equal(froe_shards_near(w->shards, points, n, k, bound, NULL, &finds, NULL), FROE_OK);
        assert_int_equal(froe_shards_near_count(w->shards, points, n, k, bound, NULL, counts, NULL), FROE_OK);
        compare_counts(&answers, counts);
        compare_finds(w, &answers, &finds, true);
    }
    for (int way = -1; way <= 1 && w->dim == 2; way += 2) {
        uint32_t objects[QUESTIONS];
        froe_find found[QUESTIONS];
        assert_int_equal(froe_batch_vertical(w->query, points, QUESTIONS, way, NULL, objects, NULL), FROE_OK);
        assert_int_equal(froe_shards_vertical(w->shards, points, QUESTIONS, way, NULL, found, NULL), FROE_OK);
        assert_int_equal(froe_shards_vertical_count(w->shards, points, QUESTIONS, way, NULL, counts, NULL), FROE_OK);
        for (size_t i = 0; i < QUESTIONS; i++) {
            assert_int_equal(found[i].object != FROE_NONE, objects[i] != FROE_NONE);
            assert_int_equal(counts[i], objects[i] != FROE_NONE);
            if (objects[i] != FROE_NONE) assert_int_equal(found[i].tag, tag_of(w, objects[i]));
        }
    }
    free(points);
}

static void compare_rays(world *w) {
    const size_t dim = (size_t)w->dim;
    double *origins = random_points(w, QUESTIONS), *directions = calloc(QUESTIONS * dim, sizeof *directions);
    static const double ends[] = {INFINITY, 2, 0.5};
    for (size_t i = 0; i < QUESTIONS; i++) {
        for (size_t a = 0; a < dim; a++) directions[i * dim + a] = on_lattice(&w->state, 6) - 3;
        if (i % 3 == 0) /* along an axis, where many objects are met at one point */
            for (size_t a = 0; a < dim; a++) directions[i * dim + a] = a == i / 3 % dim;
        directions[i * dim] += directions[i * dim] == 0;
    }
    for (int e = 0; e < 3; e++) {
        froe_hit hits[QUESTIONS];
        froe_find first[QUESTIONS], any[QUESTIONS];
        uint64_t counts[QUESTIONS];
        froe_answers answers;
        froe_finds finds;
        assert_int_equal(froe_batch_ray(w->query, origins, directions, QUESTIONS, ends[e], NULL, hits, NULL), FROE_OK);
        assert_int_equal(froe_shards_ray(w->shards, origins, directions, QUESTIONS, ends[e], NULL, first, NULL),
                         FROE_OK);
        assert_int_equal(froe_shards_ray_any(w->shards, origins, directions, QUESTIONS, ends[e], NULL, any, NULL),
                         FROE_OK);
        for (size_t i = 0; i < QUESTIONS; i++) {
            assert_int_equal(first[i].object != FROE_NONE, hits[i].object != FROE_NONE);
            assert_int_equal(any[i].object != FROE_NONE, hits[i].object != FROE_NONE);
            if (hits[i].object == FROE_NONE) continue;
            assert_int_equal(first[i].tag, tag_of(w, hits[i].object));
            assert_true(first[i].value == hits[i].t);
        }
        assert_int_equal(froe_batch_ray_all(w->query, origins, directions, QUESTIONS, ends[e], NULL, &answers, NULL),
                         FROE_OK);
        assert_int_equal(froe_shards_ray_all(w->shards, origins, directions, QUESTIONS, ends[e], NULL, &finds, NULL),
                         FROE_OK);
        assert_int_equal(froe_shards_ray_count(w->shards, origins, directions, QUESTIONS, ends[e], NULL, counts, NULL),
                         FROE_OK);
        compare_counts(&answers, counts);
        compare_finds(w, &answers, &finds, true);
    }
    free(origins), free(directions);
}

typedef struct pair_list {
    uint64_t (*pairs)[3];
    size_t count, room;
} pair_list;

static bool keep_pair(void *user, const froe_found_pair *pair) {
    pair_list *l = user;
    if (l->count < l->room) {
        l->pairs[l->count][0] = pair->a.tag;
        l->pairs[l->count][1] = pair->b.tag;
        l->pairs[l->count][2] = pair->kind;
    }
    l->count++;
    return true;
}

static int by_pair(const void *a, const void *b) {
    const uint64_t *x = a, *y = b;
    if (x[0] != y[0]) return x[0] < y[0] ? -1 : 1;
    return (x[1] > y[1]) - (x[1] < y[1]);
}

static void compare_pairs(world *w) {
    for (int shared = 0; shared < 2; shared++) {
        froe_pairs pairs;
        assert_int_equal(froe_batch_pair_array(w->query, shared, NULL, &pairs, NULL), FROE_OK);
        pair_list found = {.pairs = calloc(pairs.count + 1, sizeof *found.pairs), .room = pairs.count};
        assert_non_null(found.pairs);
        assert_int_equal(froe_shards_pairs(w->shards, shared, NULL, keep_pair, &found, NULL), FROE_OK);
        assert_int_equal(found.count, pairs.count);
        w->pairs += pairs.count;
        qsort(found.pairs, found.count, sizeof *found.pairs, by_pair);
        for (size_t i = 0; i < pairs.count; i++) {
            assert_int_equal(found.pairs[i][0], tag_of(w, pairs.pairs[i].a));
            assert_int_equal(found.pairs[i][1], tag_of(w, pairs.pairs[i].b));
            assert_int_equal(found.pairs[i][2], pairs.pairs[i].kind);
        }
        free(found.pairs);
        froe_pairs_free(&pairs);
    }
}

/* --------------------------------------------------------------------- areas -- */

/* Numbers of groups. */
static void compare_groups(world *w, froe_answers *tree, froe_finds *folder) {
    assert_int_equal(tree->queries, folder->questions);
    w->questions += tree->queries;
    w->answers += tree->starts[tree->queries];
    for (size_t i = 0; i <= tree->queries; i++) assert_int_equal(tree->starts[i], folder->starts[i]);
    for (size_t i = 0; i < tree->starts[tree->queries]; i++) {
        assert_int_equal(folder->items[i].tag, tree->ids[i]);
        assert_int_equal(folder->items[i].object, FROE_NONE);
    }
    froe_answers_free(tree);
    froe_finds_free(folder);
}

/* Which shapes a relation can be asked of. */
static const unsigned related[] = {[FROE_MEETS] = ~(1U << FROE_SHAPE_HALFSPACES),
                                   [FROE_WITHIN] = ~(1U << FROE_SHAPE_HALFSPACES | 1U << FROE_SHAPE_RAY),
                                   [FROE_COVERS] = 1U << FROE_SHAPE_BOX | 1U << FROE_SHAPE_SIMPLEX |
                                                   1U << FROE_SHAPE_HULL | 1U << FROE_SHAPE_SEGMENT};

static void compare_areas(world *w) {
    double *points = random_points(w, QUESTIONS);
    froe_answers answers;
    froe_finds finds;
    assert_int_equal(froe_batch_groups(w->query, points, QUESTIONS, NULL, &answers, NULL), FROE_OK);
    assert_int_equal(froe_shards_groups(w->shards, points, QUESTIONS, NULL, &finds, NULL), FROE_OK);
    compare_groups(w, &answers, &finds);
    for (froe_relation r = FROE_MEETS; r < FROE_RELATION_COUNT; r++) {
        double *corners = random_points(w, QUESTIONS * CORNERS);
        froe_range ranges[QUESTIONS];
        random_ranges(w, related[r], ranges, corners, corners);
        assert_int_equal(froe_batch_groups_range(w->query, ranges, QUESTIONS, r, NULL, &answers, NULL), FROE_OK);
        assert_int_equal(froe_shards_groups_range(w->shards, ranges, QUESTIONS, r, NULL, &finds, NULL), FROE_OK);
        compare_groups(w, &answers, &finds);
        free(corners);
    }
    free(points);
}

/* Groups as questions: of the tree itself, and of each shard, which has some of them, all whole. */
static void compare_joins(world *w) {
    for (froe_relation r = FROE_MEETS; r < FROE_RELATION_COUNT; r++) {
        froe_answers answers;
        froe_finds finds;
        assert_int_equal(froe_batch_groups_join(w->query, w->query, r, NULL, &answers, NULL), FROE_OK);
        assert_int_equal(froe_shards_groups_join(w->shards, w->tree, r, NULL, &finds, NULL), FROE_OK);
        compare_groups(w, &answers, &finds);
        for (uint32_t s = 0; s < froe_shards_about(w->shards).shards && r == FROE_MEETS; s += 3) {
            const froe_tree *questions;
            froe_query *asking;
            assert_int_equal(froe_shards_tree(w->shards, s, &questions, NULL), FROE_OK);
            if (!questions) continue;
            assert_int_equal(froe_query_new(questions, &asking, NULL), FROE_OK);
            assert_int_equal(froe_batch_groups_join(w->query, asking, r, NULL, &answers, NULL), FROE_OK);
            assert_int_equal(froe_shards_groups_join(w->shards, questions, r, NULL, &finds, NULL), FROE_OK);
            compare_groups(w, &answers, &finds);
            froe_query_free(asking);
        }
    }
}

/* ----------------------------------------------------------------- everything -- */

static void compare_in_folder(int dim, froe_kind kind, bool areas, int shards, uint64_t seed) {
    world w = make_world(dim, kind, areas, shards, seed);
    const froe_shards_info info = froe_shards_about(w.shards);
    assert_int_equal(info.objects, object_count);
    assert_int_equal(froe_shards_check(w.shards, NULL, NULL), FROE_OK);
    compare_ranges(&w);
    compare_points(&w);
    if (dim <= 3 || kind != FROE_POLYGON) compare_rays(&w);
    if (areas) compare_areas(&w);
    compare_pairs(&w);
    if (areas) compare_joins(&w);
    if (thorough) {
        printf("| %d | %s | %u, %s | %.4f | %llu | %llu | %llu |\n", dim,
               areas                     ? "areas"
               : kind == FROE_KIND_COUNT ? "all kinds"
                                         : froe_kind_name(kind),
               info.shards, shards < 0 ? "on the lattice" : "by medians", (double)info.copies / (double)info.objects,
               (unsigned long long)w.questions, (unsigned long long)w.answers, (unsigned long long)w.pairs);
        fflush(stdout);
    }
    free_world(&w);
}

static void compare_everything(int dim, froe_kind kind, bool areas) {
    static const int shards[] = {7, -7, -2, -64, 1};
    const size_t folders = thorough || areas || kind == FROE_KIND_COUNT ? 5 : 2;
    const size_t count = object_count;
    if (only && strcmp(only, kind == FROE_KIND_COUNT ? "all" : froe_kind_name(kind))) return;
    if (areas) object_count -= object_count % EDGES;
    for (size_t i = 0; i < folders; i++)
        if (!only_shards || shards[i] == only_shards)
            compare_in_folder(dim, kind, areas, shards[i], 1 + i + 10 * (uint64_t)kind);
    object_count = count;
}

static void of_objects_in_the_plane(void **state) {
    (void)state;
    for (int kind = 0; kind <= FROE_KIND_COUNT; kind++)
        if (kind != FROE_POLYGON) compare_everything(2, (froe_kind)kind, false);
}

static void of_areas(void **state) {
    (void)state;
    compare_everything(2, FROE_SEGMENT, true);
}

static void of_objects_in_space(void **state) {
    (void)state;
    for (int kind = 0; kind <= FROE_KIND_COUNT; kind++) compare_everything(3, (froe_kind)kind, false);
}

static void of_objects_above_space(void **state) {
    (void)state;
    compare_everything(4, FROE_BOX, false);
    compare_everything(5, FROE_POINT, false);
}

/* Distances and parameters of different exact values that round to one double: their exact order is the order, and it
 * tells which are the first k, in one shard as in several. From (1e17, 0) the points at 1, 2 and 3 are 1e17 away,
 * rounded. */
static void values_that_round_to_one_double(void **state) {
    (void)state;
    const double places[] = {1, 2, 3, 1e16}, from[] = {1e17, 0}, back[] = {-1, 0};
    const uint64_t tags[] = {4, 3, 2, 1};
    one_object list[4] = {0};
    for (int i = 0; i < 4; i++)
        list[i] = (one_object){.kind = FROE_POINT, .corners = 1, .at = {places[i], 0}, .tag = (uint64_t)i + 1};
    for (uint32_t count = 1; count <= 4; count++) {
        froe_shards_options o = froe_shards_defaults();
        froe_shards *shards;
        o.shards = count;
        assert_int_equal(build_folder("rounded.froes", 2, list, 4, &o, NULL, NULL), FROE_OK);
        assert_int_equal(froe_shards_open("rounded.froes", NULL, &shards, NULL), FROE_OK);
        for (size_t k = 1; k <= 5; k++) { /* 5: all that a ray meets */
            froe_finds found;
            const size_t most = k < 4 ? k : 4;
            const froe_status status = k < 5 ? froe_shards_near(shards, from, 1, k, INFINITY, NULL, &found, NULL)
                                             : froe_shards_ray_all(shards, from, back, 1, INFINITY, NULL, &found, NULL);
            assert_int_equal(status, FROE_OK);
            assert_int_equal(found.starts[1], most);
            for (size_t i = 0; i < most; i++) assert_int_equal(found.items[i].tag, tags[i]);
            froe_finds_free(&found);
        }
        froe_shards_close(shards);
    }
}

static void groups_in_space_are_no_areas(void **state) {
    (void)state;
    world w = make_world(3, FROE_SEGMENT, false, 2, 1);
    froe_finds finds;
    assert_int_equal(froe_shards_groups_join(w.shards, w.tree, FROE_MEETS, NULL, &finds, NULL), FROE_E_UNSUPPORTED);
    assert_int_equal(froe_shards_groups_join(w.shards, NULL, FROE_MEETS, NULL, &finds, NULL), FROE_E_ARG);
    assert_int_equal(froe_shards_groups(w.shards, NULL, 0, NULL, &finds, NULL), FROE_E_UNSUPPORTED);
    free_world(&w);
}

int main(int argc, char **argv) {
    thorough = argc > 1;
    if (thorough) object_count = (size_t)strtoull(argv[1], NULL, 10);
    if (argc > 2) cmocka_set_test_filter(argv[2]);
    if (argc > 3) only = argv[3];
    if (argc > 4) only_shards = (int)strtol(argv[4], NULL, 10);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(of_objects_in_the_plane),      cmocka_unit_test(of_areas),
        cmocka_unit_test(groups_in_space_are_no_areas), cmocka_unit_test(of_objects_in_space),
        cmocka_unit_test(of_objects_above_space),       cmocka_unit_test(values_that_round_to_one_double),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
