/* test_floats.c: however the calling thread computes, every call gives the same bits, the thread computes so
 * afterwards, and so do the callbacks. (draw/test_floats.c has the pictures.) */
#include "support/settings.h"
#include <froe/arrays.h>
#include <froe/io.h>
#include <froe/kinetic.h>
#include <froe/measure.h>
#include <froe/query.h>
#include <froe/view.h>

#define FILE_NAME "floats.froe"

/* ------------------------------------------------------------------- trees -- */

/** Generates as many objects of a kind, in memory that looks at the floating point. */
static froe_scene *scene_of(floats_run *r, const char *kind, size_t n) {
    const froe_allocator memory = {floats_memory, r};
    froe_scene *scene;
    MUST(r, froe_generate(kind, n, 7, &memory, &scene, NULL));
    return scene;
}

static froe_tree *tree_of(floats_run *r, froe_scene *scene, const char *method, const char *purpose) {
    froe_build_options o = froe_build_defaults();
    froe_tree *tree;
    o.method = method;
    o.purpose = purpose;
    o.threads = 3;
    o.progress = floats_progress;
    o.user = r;
    return ASK(r, froe_build(scene, &o, &tree, NULL)) ? NULL : tree;
}

static bool note_cell(void *user, const froe_cell *cell) {
    floats_called(user);
    floats_note(user, cell->coords, cell->corners * 16);
    return true;
}

typedef struct saved_bytes {
    floats_run *run;
    uint8_t *bytes;
    size_t count;
} saved_bytes;

static bool note_bytes(void *user, const void *bytes, size_t count) {
    saved_bytes *to = user;
    floats_called(to->run);
    memcpy(to->bytes + to->count, bytes, count);
    to->count += count;
    return true;
}

/** Through memory, instead of through a file. */
static void send_tree(floats_run *r, const froe_tree *tree) {
    saved_bytes to = {r, malloc(froe_tree_saved_size(tree)), 0};
    froe_tree *again;
    assert_non_null(to.bytes);
    MUST(r, froe_tree_write(tree, note_bytes, &to, NULL));
    floats_note(r, to.bytes, to.count);
    MUST(r, froe_tree_open_memory(to.bytes, to.count, &(froe_allocator){floats_memory, r}, &again, NULL));
    TELL(r, froe_tree_free(again));
    free(to.bytes);
}

static void copy_tree(floats_run *r, const froe_tree *tree, const double *lo, const double *hi) {
    const froe_allocator alloc = {floats_memory, r};
    froe_scene_arrays s;
    froe_piece_arrays p;
    froe_cell_arrays c;
    MUST(r, froe_arrays_of_scene(froe_tree_scene(tree), &alloc, &s, NULL));
    floats_note(r, s.coords, s.vertex_count * (size_t)s.dim * sizeof *s.coords);
    MUST(r, froe_arrays_of_pieces(tree, &alloc, &p, NULL));
    floats_note(r, p.coords, p.corner_count * (size_t)p.dim * sizeof *p.coords);
    if (s.dim <= 3) {
        MUST(r, froe_arrays_of_cells(tree, lo, hi, false, &alloc, &c, NULL));
        floats_note(r, c.coords, c.corner_count * (size_t)c.dim * sizeof *c.coords);
        TELL(r, froe_cell_arrays_free(&c));
    }
    TELL(r, froe_piece_arrays_free(&p));
    TELL(r, froe_scene_arrays_free(&s));
}

/** Bits of the file, and of what is asked of a tree itself. */
static void ask_tree(floats_run *r, const froe_tree *tree) {
    const froe_scene *scene = froe_tree_scene(tree);
    froe_audit_options o = froe_audit_defaults();
    froe_diagnostic diag;
    froe_tree *again;
    double lo[8], hi[8], corners[3 * 64];
    TELL(r, froe_scene_bounds(scene, lo, hi));
    floats_note(r, lo, 8 * (size_t)froe_scene_dim(scene)), floats_note(r, hi, 8 * (size_t)froe_scene_dim(scene));
    MUST(r, froe_tree_save(tree, FILE_NAME, NULL));
    floats_note_file(r, FILE_NAME);
    MUST(r, froe_tree_open_copy(FILE_NAME, &(froe_allocator){floats_memory, r}, &again, NULL));
    TELL(r, froe_tree_free(again));
    MUST(r, froe_tree_open(FILE_NAME, &(froe_allocator){floats_memory, r}, &again, NULL));
    MUST(r, froe_scene_check(froe_tree_scene(again), NULL));
    MUST(r, froe_tree_check(again, NULL));
    if (froe_tree_node(again, froe_tree_root(again)).child[0].id1) {
        froe_node_info info;
        TELL(r, info = froe_tree_node(again, froe_tree_root(again)));
        floats_note(r, &info.cut.value, 8);
    }
    TELL(r, froe_tree_free(again));
    send_tree(r, tree);
    o.progress = floats_progress;
    o.user = r;
    if (ASK(r, froe_tree_audit(tree, &o, &diag))) fail_msg("%s", diag.message);
    for (size_t i = 0; i < froe_tree_piece_count(tree) && froe_scene_dim(scene) <= 3; i += 5) {
        size_t count;
        TELL(r, count = froe_tree_piece_corners(tree, i, corners, NULL, 64));
        floats_note(r, corners, count * 8 * (size_t)froe_scene_dim(scene));
    }
    if (froe_scene_dim(scene) <= 3) ASK(r, froe_tree_cells(tree, lo, hi, note_cell, r, NULL));
    copy_tree(r, tree, lo, hi);
}

static void builds(floats_run *r, void *user) {
    static const char *const kinds[] = {"denormal", "mixed", "denormal-3d", "boxes-3d", "balls"};
    const froe_method_info *method;
    (void)user;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (size_t m = 0; (method = froe_method_at(m)); m++) {
            froe_scene *scene = scene_of(r, kinds[k], 30);
            froe_tree *tree = tree_of(r, scene, method->name, NULL);
            if (tree) ask_tree(r, tree);
            froe_tree_free(tree);
            froe_scene_free(scene);
        }
}

static void every_method_builds_the_same_tree(void **state) {
    (void)state;
    floats_compare(builds, NULL);
}

static void additions(floats_run *r, void *user) {
    static const double x[] = {0, 0x1p-1074, 3, 1, 0x1.8p-1060, 2, 5, 5, 0x1p-1074, 0, 0.1, 0.3};
    const froe_allocator memory = {floats_memory, r};
    const double plane[] = {1, 0x1p-1074, 0x1p-1074, 0.1};
    froe_objects o = froe_objects_defaults();
    froe_defects defects = {.size = sizeof defects};
    froe_scene *scene, *space;
    froe_tree *section;
    uint32_t group;
    (void)user;
    MUST(r, froe_scene_new(2, &memory, &scene));
    MUST(r, froe_scene_add_group(scene, &(froe_group){.name = "a"}, &group));
    MUST(r, froe_scene_new(3, &memory, &space));
    MUST(r, froe_scene_set_up(space, 1));
    froe_scene_free(space);
    o.kind = FROE_SEGMENT;
    o.count = 3;
    o.coords = x;
    o.progress = floats_progress;
    o.user = r;
    MUST(r, froe_scene_add(scene, &o, NULL));
    MUST(r, froe_scene_defects(scene, 2, floats_progress, r, &defects, NULL));
    floats_note(r, &defects, sizeof defects);
    MUST(r, froe_scene_set_crs(scene, &(froe_crs){FROE_CRS_GEOGRAPHIC, "wkt", "name", "code", "degree"}));
    const size_t across = froe_scene_across(scene, NULL);
    floats_note(r, &across, sizeof across);
    froe_tree *tree = tree_of(r, scene, "autopartition", NULL);
    MUST(r, froe_tree_section(tree, plane, NULL, &section, NULL));
    ask_tree(r, section);
    froe_tree_free(section);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void scenes_and_sections_are_the_same(void **state) {
    (void)state;
    floats_compare(additions, NULL);
}

/* ----------------------------------------------------------------- queries -- */

static void note_answers(floats_run *r, froe_answers *a) {
    floats_note(r, a->starts, (a->queries + 1) * sizeof *a->starts);
    floats_note(r, a->ids, a->starts[a->queries] * sizeof *a->ids);
    if (a->values) floats_note(r, a->values, a->starts[a->queries] * sizeof *a->values);
    froe_answers_free(a);
}

static bool note_pair(void *user, const froe_pair *pair) {
    floats_called(user);
    floats_note(user, pair, sizeof *pair);
    return true;
}

/** Points, and boxes around them, between the bounds of the scene. */
enum { POINTS = 6 };
typedef struct places {
    double at[POINTS][3], boxes[POINTS][6], along[POINTS][3];
} places;

static places places_in(const froe_scene *scene) {
    const int dim = froe_scene_dim(scene);
    places p;
    double lo[3], hi[3];
    memset(&p, 0, sizeof p);
    froe_scene_bounds(scene, lo, hi);
    for (int i = 0; i < POINTS; i++) /* packed: points of dim doubles each */
        for (int k = 0; k < dim; k++) {
            const double size = hi[k] - lo[k], x = lo[k] + size * (0.15 * (i + 1) - 0.03 * k);
            (&p.at[0][0])[i * dim + k] = x;
            (&p.along[0][0])[i * dim + k] = i % 3 == k ? -size : size / 3;
            p.boxes[i][k] = x - size / 8;
            p.boxes[i][dim + k] = x + size / 7;
        }
    return p;
}

static void ask_ranges(floats_run *r, froe_query *q, const places *p) {
    for (int i = 0; i < POINTS; i++)
        for (int walk = 0; walk < FROE_WALK_COUNT; walk++) {
            froe_range range = froe_range_defaults();
            froe_list list;
            uint64_t count = 0;
            uint32_t any = 0;
            range.shape = i % 2 ? FROE_SHAPE_BOX : FROE_SHAPE_SEGMENT;
            range.points = p->boxes[i];
            range.walk = (froe_walk)walk;
            if (!ASK(r, froe_query_range(q, &range, &list, NULL))) floats_note(r, list.ids, 4 * list.count);
            ASK(r, froe_query_count(q, &range, &count, NULL));
            floats_note(r, &count, sizeof count);
            ASK(r, froe_query_any(q, &range, &any, NULL));
            floats_note(r, &any, sizeof any);
        }
}

static void ask_points(floats_run *r, froe_query *q, const places *p, int dim) {
    for (int i = 0; i < POINTS; i++) {
        const double *at = p->at[0] + i * dim, *along = p->along[0] + i * dim;
        froe_list list;
        froe_hit hit;
        froe_hits hits;
        froe_neighbours near;
        uint32_t object = 0;
        froe_hit_place place;
        double nearest[FROE_MAX_DIM];
        MUST(r, froe_query_locate(q, at, &list, NULL));
        floats_note(r, list.ids, 4 * list.count);
        if (!ASK(r, froe_query_groups(q, at, &list, NULL))) floats_note(r, list.ids, 4 * list.count);
        for (froe_relation relation = 0; relation < FROE_RELATION_COUNT; relation++) {
            froe_range box = froe_range_defaults();
            box.points = p->boxes[i];
            if (!ASK(r, froe_query_groups_range(q, &box, relation, &list, NULL)))
                floats_note(r, list.ids, 4 * list.count);
        }
        if (!ASK(r, froe_query_vertical(q, at, 1, &object, NULL))) floats_note(r, &object, 4);
        if (!ASK(r, froe_query_ray(q, at, along, 3, &hit, NULL)))
            floats_note(r, &hit.object, 4), floats_note(r, &hit.t, 8);
        if (hit.object != FROE_NONE && !ASK(r, froe_query_hit_place(q, hit.object, at, along, &place, NULL)))
            floats_note(r, &place, sizeof place);
        if (!ASK(r, froe_query_nearest_point(q, 0, at, nearest, NULL))) floats_note(r, nearest, 8 * (size_t)dim);
        if (!ASK(r, froe_query_ray_any(q, at, along, 3, &object, NULL))) floats_note(r, &object, 4);
        if (!ASK(r, froe_query_ray_all(q, at, along, 3, &hits, NULL)))
            for (size_t h = 0; h < hits.count; h++)
                floats_note(r, &hits.hits[h].object, 4), floats_note(r, &hits.hits[h].t, 8);
        if (!ASK(r, froe_query_near(q, at, 5, 1e300, &near, NULL)))
            for (size_t h = 0; h < near.count; h++)
                floats_note(r, &near.items[h].object, 4), floats_note(r, &near.items[h].distance, 8);
    }
}

static void ask_batches(floats_run *r, froe_query *q, const places *p, size_t dim) {
    froe_batch_options o = froe_batch_defaults();
    froe_range ranges[POINTS];
    froe_answers answers;
    froe_hit hits[POINTS];
    uint32_t objects[POINTS];
    uint64_t counts[POINTS];
    froe_pairs pairs;
    double boxes[POINTS * 6];
    const size_t numbers = 2 * dim;
    o.threads = 3;
    o.progress = floats_progress;
    o.user = r;
    for (int i = 0; i < POINTS; i++) {
        ranges[i] = froe_range_defaults();
        ranges[i].points = p->boxes[i];
        memcpy(boxes + (size_t)i * numbers, p->boxes[i], numbers * sizeof *boxes);
    }
    if (!ASK(r, froe_batch_range(q, ranges, POINTS, &o, &answers, NULL))) note_answers(r, &answers);
    if (!ASK(r, froe_batch_boxes(q, boxes, POINTS, &o, &answers, NULL))) note_answers(r, &answers);
    if (!ASK(r, froe_batch_count(q, ranges, POINTS, &o, counts, NULL))) floats_note(r, counts, sizeof counts);
    if (!ASK(r, froe_batch_any(q, ranges, POINTS, &o, objects, NULL))) floats_note(r, objects, sizeof objects);
    if (!ASK(r, froe_batch_locate(q, p->at[0], POINTS, &o, &answers, NULL))) note_answers(r, &answers);
    if (!ASK(r, froe_batch_groups(q, p->at[0], POINTS, &o, &answers, NULL))) note_answers(r, &answers);
    if (!ASK(r, froe_batch_groups_boxes(q, boxes, POINTS, FROE_COVERS, &o, &answers, NULL))) note_answers(r, &answers);
    if (!ASK(r, froe_batch_groups_range(q, ranges, POINTS, FROE_MEETS, &o, &answers, NULL))) note_answers(r, &answers);
    if (!ASK(r, froe_batch_groups_join(q, q, FROE_WITHIN, &o, &answers, NULL))) note_answers(r, &answers);
    if (!ASK(r, froe_batch_vertical(q, p->at[0], POINTS, -1, &o, objects, NULL)))
        floats_note(r, objects, sizeof objects);
    if (!ASK(r, froe_batch_ray(q, p->at[0], p->along[0], POINTS, 3, &o, hits, NULL)))
        for (int i = 0; i < POINTS; i++) floats_note(r, &hits[i].object, 4);
    if (!ASK(r, froe_batch_ray_any(q, p->at[0], p->along[0], POINTS, 3, &o, objects, NULL)))
        floats_note(r, objects, sizeof objects);
    if (!ASK(r, froe_batch_ray_all(q, p->at[0], p->along[0], POINTS, 3, &o, &answers, NULL))) note_answers(r, &answers);
    if (!ASK(r, froe_batch_near(q, p->at[0], POINTS, 4, 1e300, &o, &answers, NULL))) note_answers(r, &answers);
    MUST(r, froe_batch_pairs(q, true, &o, note_pair, r, NULL));
    MUST(r, froe_query_pairs(q, false, note_pair, r, NULL));
    MUST(r, froe_batch_pair_array(q, true, &o, &pairs, NULL));
    for (size_t i = 0; i < pairs.count; i++) floats_note(r, &pairs.pairs[i].a, 4), floats_note(r, &pairs.pairs[i].b, 4);
    TELL(r, froe_pairs_free(&pairs));
}

static void queries(floats_run *r, void *user) {
    static const char *const asked[][2] = {
        {"denormal", "index"},    {"denormal", "density"},    {"mixed", "autopartition"}, {"mixed", "index"},
        {"denormal-3d", "kd"},    {"denormal-3d", "grain"},   {"balls-3d", "kd"},         {"boxes-3d", "index"},
        {"disjoint-3d", "index"}, {"blocks", "autopartition"}};
    (void)user;
    for (size_t k = 0; k < sizeof asked / sizeof *asked; k++) {
        froe_scene *scene = scene_of(r, asked[k][0], 40);
        froe_tree *tree = tree_of(r, scene, asked[k][1], NULL);
        const places p = places_in(scene);
        froe_query *first, *q;
        MUST(r, froe_query_new(tree, &first, NULL));
        MUST(r, froe_query_fork(first, &q, NULL));
        ask_ranges(r, q, &p);
        ask_points(r, q, &p, froe_scene_dim(scene));
        ask_batches(r, q, &p, (size_t)froe_scene_dim(froe_tree_scene(tree)));
        TELL(r, froe_query_free(q));
        TELL(r, froe_query_free(first));
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

static void every_query_gives_the_same_answers(void **state) {
    (void)state;
    floats_compare(queries, NULL);
}

/* ---------------------------------------------------------------- measures -- */

static void note_spread(floats_run *r, const froe_spread *s) {
    floats_note(r, s, sizeof *s);
}

static void measures(floats_run *r, void *user) {
    static const char *const kinds[] = {"denormal", "denormal-3d", "mixed", "boxes-3d", "balls"};
    froe_measure_options o = froe_measure_defaults();
    (void)user;
    o.samples = 30;
    o.progress = floats_progress;
    o.user = r;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        froe_scene *scene = scene_of(r, kinds[k], 40);
        froe_fatness fatness;
        froe_density density;
        froe_clutter clutter;
        froe_directional directional;
        MUST(r, froe_measure_fatness(scene, &o, &fatness, NULL));
        note_spread(r, &fatness.full), note_spread(r, &fatness.flat), note_spread(r, &fatness.sliver);
        MUST(r, froe_measure_density(scene, FROE_SIZE_RADIUS, &o, &density, NULL));
        floats_note(r, &density.lower, 8), floats_note(r, &density.radius, 8), note_spread(r, &density.load);
        MUST(r, froe_measure_clutter(scene, &o, &clutter, NULL));
        floats_note(r, &clutter.lower, 4), note_spread(r, &clutter.load);
        MUST(r, froe_measure_directional(scene, 0.3, &o, &directional, NULL));
        note_spread(r, &directional.simple), note_spread(r, &directional.paired);
        froe_near near;
        MUST(r, froe_measure_near(scene, 0x1p-10, 1, floats_progress, r, &near, NULL));
        floats_note(r, &near.coplanar, 8), floats_note(r, &near.poking, 8), floats_note(r, &near.within, 8);
        froe_scene_free(scene);
    }
}

static void every_measure_is_the_same(void **state) {
    (void)state;
    floats_compare(measures, NULL);
}

/* -------------------------------------------------------------------- views -- */

static bool note_node(void *user, froe_node node, froe_order_stage stage) {
    const uint32_t at[2] = {node.id1, stage};
    floats_called(user);
    floats_note(user, at, sizeof at);
    return true;
}

static bool note_piece(void *user, size_t piece) {
    floats_called(user);
    floats_note(user, &piece, sizeof piece);
    return true;
}

static bool note_region(void *user, uint32_t patch, const double *coords, const size_t *starts, size_t rings) {
    floats_called(user);
    floats_note(user, &patch, sizeof patch);
    floats_note(user, coords, starts[rings] * 24);
    return true;
}

static void ask_visibility(floats_run *r, const froe_tree *tree, const froe_surface *surface, const froe_eye *eye) {
    const froe_allocator memory = {floats_memory, r};
    froe_visibility_options o = froe_visibility_defaults();
    froe_visibility *v;
    double corners[3 * 64];
    size_t count = 0;
    o.eye = *eye;
    o.crossings = true;
    o.alloc = &memory;
    o.progress = floats_progress;
    o.user = r;
    MUST(r, froe_visibility_new(tree, surface, &o, &v, NULL));
    for (size_t i = 0; i < froe_visibility_piece_count(v); i++) {
        TELL(r, count = froe_visibility_corners(v, i, corners, 64));
        floats_note(r, corners, 24 * count);
    }
    for (uint32_t e = 0; e < froe_surface_edge_count(surface); e++) {
        const froe_interval *seen = froe_visibility_of_edge(v, e, &count);
        floats_note(r, seen, count * sizeof *seen);
    }
    MUST(r, froe_visibility_regions(v, 0, (uint32_t)froe_surface_patch_count(surface), note_region, r, NULL));
    froe_visibility_free(v);
}

static void ask_picture(floats_run *r, const froe_tree *tree, const froe_surface *surface,
                        const froe_projection *view) {
    const froe_allocator memory = {floats_memory, r};
    froe_picture_options o = froe_picture_defaults();
    froe_picture *picture;
    size_t count;
    o.view = view;
    o.lines = 255;
    o.alloc = &memory;
    o.progress = floats_progress;
    o.user = r;
    if (ASK(r, froe_picture_new(tree, surface, &o, &picture, NULL))) return; /* no page is as narrow as denormals */
    for (size_t i = 0; i < froe_picture_shape_count(picture); i++) {
        const froe_shape shape = froe_picture_shape(picture, i);
        for (size_t k = 0; k < shape.ring_count; k++) {
            const double *ring = froe_picture_ring(picture, shape.first_ring + k, &count);
            floats_note(r, ring, 16 * count);
        }
    }
    for (size_t i = 0; i < froe_picture_stroke_count(picture); i++) {
        const froe_stroke stroke = froe_picture_stroke(picture, i);
        floats_note(r, stroke.points, 16 * stroke.count);
    }
    froe_picture_free(picture);
}

static void views(floats_run *r, void *user) {
    static const char *const kinds[] = {"denormal-3d", "triangles"};
    static const froe_eye eyes[] = {
        {{0.3, -5, 0.7}, false}, {{0x1p-1070, 0x1p-1060, 0x1p-1065}, false}, {{1, 0x1p-1074, -0.2}, true}};
    (void)user;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        froe_scene *scene = scene_of(r, kinds[k], 25);
        froe_tree *tree = tree_of(r, scene, "density", "draw");
        froe_surface *surface;
        froe_projection view;
        froe_camera cameras[3], camera = froe_camera_defaults();
        froe_order_options o = froe_order_defaults();
        double page[2] = {0, 0}, turns[16];
        uint32_t *pieces = calloc(3 * froe_tree_piece_count(tree) + 1, sizeof *pieces);
        o.threads = 2, o.progress = floats_progress, o.user = r;
        for (int e = 0; e < 3; e++) MUST(r, froe_tree_order(tree, eyes + e, NULL, note_piece, r, NULL));
        MUST(r, froe_tree_orders(tree, eyes, 3, &o, pieces, NULL));
        MUST(r, froe_tree_order_nodes(tree, eyes, NULL, note_node, r, NULL));
        floats_note(r, pieces, 12 * froe_tree_piece_count(tree));
        free(pieces);
        MUST(r, froe_surface_new(scene, &(froe_allocator){floats_memory, r}, &surface, NULL));
        for (int e = 0; e < 3; e++) ask_visibility(r, tree, surface, eyes + e);
        if (!ASK(r, froe_camera_turn(&camera, scene, 3, cameras, NULL)))
            for (int c = 0; c < 3; c++) floats_note(r, cameras[c].eye, 24);
        if (!ASK(r, froe_camera_turns(&camera, 3, turns, NULL))) floats_note(r, turns, sizeof turns);
        if (!ASK(r, froe_camera_place(&camera, scene, &view, NULL))) {
            floats_note(r, view.window, sizeof view.window);
            TELL(r, froe_project(&view, froe_scene_vertex(scene, 0), page));
            floats_note(r, page, sizeof page);
            ask_picture(r, tree, surface, &view);
        }
        froe_surface_free(surface);
        froe_tree_free(tree);
        froe_scene_free(scene);
    }
}

static void every_view_is_the_same(void **state) {
    (void)state;
    floats_compare(views, NULL);
}

/* ------------------------------------------------------------------- motion -- */

static bool note_contact(void *user, const froe_contact *contact) {
    floats_called(user);
    floats_note(user, contact->begin, sizeof contact->begin);
    floats_note(user, contact->end, sizeof contact->end);
    return true;
}

typedef struct watch {
    floats_run *r;
    froe_kinetic *kinetic;
} watch;

static bool note_event(void *user, const froe_event *event) {
    const watch *w = user;
    double when[2];
    floats_called(w->r);
    if (froe_kinetic_instant(w->kinetic, when, NULL)) return false; /* a call within a call */
    floats_called(w->r);
    floats_note(w->r, when, sizeof when);
    floats_note(w->r, &event->tick, sizeof event->tick);
    floats_note(w->r, &event->late, sizeof event->late);
    return true;
}

static bool note_fragment(void *user, uint32_t object, const double ends[4]) {
    floats_called(user);
    floats_note(user, &object, sizeof object);
    floats_note(user, ends, 32);
    return true;
}

static void ask_present(floats_run *r, froe_kinetic *kinetic) {
    static const double eye[2] = {0.31, 0.47}, beyond[2] = {0.9, 0x1p-1074};
    froe_kinetic_place place;
    froe_snapshot snapshot;
    uint32_t hit;
    double time;
    TELL(r, time = froe_kinetic_time(kinetic));
    floats_note(r, &time, sizeof time);
    TELL(r, time = froe_kinetic_next(kinetic));
    floats_note(r, &time, sizeof time);
    MUST(r, froe_kinetic_locate(kinetic, eye, &place, NULL));
    floats_note(r, &place, sizeof place);
    MUST(r, froe_kinetic_ray(kinetic, eye, beyond, &hit, NULL));
    floats_note(r, &hit, sizeof hit);
    MUST(r, froe_kinetic_order(kinetic, eye, note_fragment, r, NULL));
    MUST(r, froe_kinetic_audit(kinetic, NULL));
    MUST(r, froe_kinetic_snapshot(kinetic, NULL, &snapshot, NULL));
    MUST(r, froe_tree_save(snapshot.tree, FILE_NAME, NULL));
    floats_note_file(r, FILE_NAME);
    MUST(r, froe_write_places(snapshot.places, "floats.csv", NULL));
    floats_note_file(r, "floats.csv");
    froe_scene *scene = (froe_scene *)(uintptr_t)froe_tree_scene(snapshot.tree);
    froe_tree_free(snapshot.tree);
    (void)scene;
    froe_places_free(snapshot.places);
}

static void ask_kinetic(floats_run *r, froe_motion *motion, double end) {
    static const size_t starts[] = {0, 2, 4};
    const double times[] = {0, end, 0, end}, coords[] = {0.1, 0.2, 0.7, 0.4, 0.3, 0x1p-1070, 0.1, 0.9};
    froe_moving more = froe_moving_defaults();
    watch w = {.r = r};
    const froe_kinetic_options o = froe_kinetic_defaults();
    volatile const double early = 0.3 * end, late = 0.6 * end;
    MUST(r, froe_kinetic_new(motion, &o, &(froe_allocator){floats_memory, r}, &w.kinetic, NULL));
    ask_present(r, w.kinetic);
    MUST(r, froe_kinetic_advance(w.kinetic, early, note_event, &w, NULL));
    ask_present(r, w.kinetic);
    more.vertex_count = 2, more.starts = starts, more.times = times, more.coords = coords, more.count = 1;
    MUST(r, froe_motion_add(motion, &more, NULL));
    MUST(r, froe_kinetic_update(w.kinetic, NULL));
    MUST(r, froe_kinetic_replan(w.kinetic, 0, 2, times, coords, NULL, NULL, NULL));
    MUST(r, froe_kinetic_remove(w.kinetic, 1, NULL));
    MUST(r, froe_kinetic_advance(w.kinetic, late, note_event, &w, NULL));
    ask_present(r, w.kinetic);
    froe_kinetic_free(w.kinetic);
}

/* A body that turns falls on another that rests. */
static void move_bodies(floats_run *r) {
    static const double times[] = {0, 8, 0, 0, 0, 0, 0, 0}, centres[] = {0.1, 0.3, 5, 0.2, 0.4, -4};
    static const double controls[] = {0.3, 0.1, 7, 0, 0, 0}, turns[] = {0, 0, 0, 1, 0.6, 0, 0, 0.8};
    static const double corners[] = {-1, -1, 0.1, 1, -1, 0.2, 0, 1, 0x1p-1070, -3, -3, 0.3, 3, -3, 0.7, 0, 3, 0.1};
    static const size_t starts[] = {0, 1, 2, 3, 4, 5, 6};
    static const uint32_t bodies[] = {0, 0, 0, FROE_NONE, FROE_NONE, FROE_NONE};
    froe_motion_options window = froe_motion_defaults();
    froe_moving b = froe_moving_defaults();
    froe_body body = froe_body_defaults();
    froe_motion *motion, *replaced;
    double at[4] = {0};
    window.dim = 3, window.begin = 0, window.end = 8;
    body.count = 2, body.times = times, body.coords = centres, body.controls = controls, body.turns = turns;
    b.vertex_count = 6, b.count = 2, b.starts = starts, b.times = times + 2, b.coords = corners, b.bodies = bodies;
    MUST(r, froe_motion_new(&window, &(froe_allocator){floats_memory, r}, &motion, NULL));
    MUST(r, froe_motion_add_body(motion, &body, NULL, NULL));
    MUST(r, froe_motion_add(motion, &b, NULL));
    TELL(r, froe_motion_position(motion, 0, 3.7, at));
    MUST(r, froe_motion_contacts(motion, NULL, note_contact, r, NULL));
    MUST(r, froe_motion_without_bodies(motion, 1e-3, NULL, &replaced, at + 3, NULL));
    floats_note(r, at, sizeof at);
    froe_motion_free(replaced), froe_motion_free(motion);
}

static void motions(floats_run *r, void *user) {
    static const char *const kinds[] = {"moving", "moving-quadratic", "moving-lattice"};
    (void)user;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        const froe_allocator memory = {floats_memory, r};
        froe_contact_options o = froe_contact_defaults();
        froe_motion *motion;
        froe_motion_options window;
        double at[2] = {0, 0};
        MUST(r, froe_generate_motion(kinds[k], 12, 3, &memory, &motion, NULL));
        TELL(r, froe_motion_window_into(motion, &window, sizeof window));
        floats_note(r, &window.tick, sizeof window.tick);
        TELL(r, froe_motion_position(motion, 0, 17.3, at));
        floats_note(r, at, sizeof at);
        o.threads = 2;
        o.progress = floats_progress;
        o.user = r;
        MUST(r, froe_motion_contacts(motion, &o, note_contact, r, NULL));
        ask_kinetic(r, motion, window.end);
        froe_motion_free(motion);
    }
    move_bodies(r);
}

static void motion_is_the_same(void **state) {
    (void)state;
    floats_compare(motions, NULL);
}

/* -------------------------------------------------------------------- files -- */

static void read_again(floats_run *r, const char *path, froe_faces faces) {
    const froe_allocator memory = {floats_memory, r};
    froe_read_options o = froe_read_defaults();
    froe_scene *scene;
    o.faces = faces;
    o.alloc = &memory;
    o.progress = floats_progress;
    o.user = r;
    MUST(r,
         froe_reads_own(path) ? froe_read_own(path, &o, &scene, NULL, NULL) : froe_read(path, &o, &scene, NULL, NULL));
    for (uint32_t v = 0; v < froe_scene_vertex_count(scene); v++)
        floats_note(r, froe_scene_vertex(scene, v), 8 * (size_t)froe_scene_dim(scene));
    froe_scene_free(scene);
}

static bool note_part(void *user, const froe_part *part) {
    floats_note(user, part->coords, part->corners * (size_t)part->dim * sizeof *part->coords);
    return true;
}

static void write_and_read(floats_run *r, const char *kind, const char *path, const char *export) {
    froe_export_options o = froe_export_defaults();
    froe_scene *scene = scene_of(r, kind, 20);
    froe_tree *tree = tree_of(r, scene, "autopartition", NULL);
    o.progress = floats_progress;
    o.user = r;
    MUST(r, froe_write_scene(scene, path, NULL));
    floats_note_file(r, path);
    read_again(r, path, FROE_FACES_POLYGONS);
    for (int what = 0; tree && export && what < 3; what++) {
        if (froe_exports_own(export))
            MUST(r, froe_export(tree, export, (froe_export_what)what, &o, NULL));
        else
            MUST(r, froe_export_map(tree, export, (froe_export_what)what, &o, NULL));
        floats_note_file(r, export);
        MUST(r, froe_tree_parts(tree, (froe_export_what)what, &o, note_part, r, NULL));
    }
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void draw_plan(floats_run *r) {
    const froe_allocator memory = {floats_memory, r};
    froe_render_options o = froe_render_defaults();
    froe_scene *scene = scene_of(r, "triangles", 20);
    froe_tree *tree = tree_of(r, scene, "autopartition", NULL);
    o.alloc = &memory, o.progress = floats_progress, o.user = r;
    MUST(r, froe_render_dxf(tree, "floats.dxf", &o, NULL, NULL));
    floats_note_file(r, "floats.dxf");
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static void follow_model(floats_run *r) {
    froe_motion *motion = NULL;
    MUST(r, froe_read_animation(FROE_TEST_DATA "/../tests/io/door.dae", NULL, &motion, NULL, NULL));
    const froe_body_knot knot = froe_motion_body_knot(motion, 1, 1);
    floats_note(r, knot.turn, sizeof knot.turn);
    froe_motion_free(motion);
}

static void files(floats_run *r, void *user) {
    (void)user;
    draw_plan(r);
    follow_model(r);
    write_and_read(r, "denormal", "floats.geojson", "floats-out.geojson");
    write_and_read(r, "mixed", "floats.geojson", "floats-out.csv");
    write_and_read(r, "denormal", "floats.geojson", "floats-out.fgb");
    write_and_read(r, "denormal-3d", "floats.obj", "floats-out.obj");
    write_and_read(r, "triangles", "floats.off", "floats-out.obj");
    write_and_read(r, "balls", "floats.csv", NULL);
    read_again(r, FROE_TEST_DATA "/utah-teapot.obj", FROE_FACES_POLYGONS);
    read_again(r, FROE_TEST_DATA "/fzk-haus-boxes.csv", FROE_FACES_TRIANGLES);
    read_again(r, FROE_TEST_DATA "/states-albers-10m.json", FROE_FACES_TRIANGLES);
    read_again(r, FROE_TEST_DATA "/fzk-haus.glb", FROE_FACES_TRIANGLES);
}

static void files_are_the_same(void **state) {
    (void)state;
    floats_compare(files, NULL);
}

typedef struct kept {
    froe_contact contacts[64];
    size_t count;
} kept;

static bool keep_contact(void *user, const froe_contact *contact) {
    kept *k = user;
    k->contacts[k->count++] = *contact;
    return k->count < 64;
}

/* A triangle in a group, by a table. */
static void poses_of_a_part(floats_run *r) {
    static const double at[] = {0.1, 0, 0, 1, 0.3, 0, 0, 1, 0x1p-1070};
    const froe_allocator memory = {floats_memory, r};
    froe_motion_read_options o = froe_motion_read_defaults();
    froe_objects triangle = froe_objects_defaults();
    froe_scene *model;
    froe_motion *motion;
    FILE *table = fopen("floats-poses.csv", "w");
    assert_non_null(table);
    fputs("body,time,x,y,z,qx,qy,qz,qw\na,0,0.1,0,0,0,0,0,1\na,0.7,0.3,0,0,0.6,0,0,0.8\n", table);
    fclose(table);
    triangle.kind = FROE_POLYGON, triangle.count = 1, triangle.coords = at, triangle.starts = (const size_t[]){0, 3};
    triangle.group = 0, o.alloc = &memory;
    MUST(r, froe_scene_new(3, &memory, &model));
    MUST(r, froe_scene_add_group(model, &(froe_group){.name = "a"}, NULL));
    MUST(r, froe_scene_add(model, &triangle, NULL));
    MUST(r, froe_read_poses("floats-poses.csv", model, &o, &motion, NULL, NULL));
    const froe_body_knot knot = froe_motion_body_knot(motion, 1, 1);
    floats_note(r, knot.turn, sizeof knot.turn);
    froe_motion_free(motion);
    froe_scene_free(model);
}

static void motion_files(floats_run *r, void *user) {
    static const froe_event event = {
        .kind = FROE_EVENT_TURN, .object_count = 1, .tick = 3, .early = 0.1, .late = 0x1p-1074};
    const froe_allocator memory = {floats_memory, r};
    froe_motion_read_options o = froe_motion_read_defaults();
    froe_motion_options window = froe_motion_defaults();
    froe_motion *motion, *again;
    kept k = {.count = 0};
    (void)user;
    window.begin = 0x1p-1074, window.end = 0.1;
    MUST(r, froe_motion_new(&window, &memory, &again, NULL));
    froe_motion_free(again);
    MUST(r, froe_generate_motion("moving-polygons", 30, 3, &memory, &motion, NULL));
    MUST(r, froe_motion_contacts(motion, NULL, keep_contact, &k, NULL));
    MUST(r, froe_write_contacts(motion, k.contacts, k.count, "floats.csv", NULL));
    floats_note_file(r, "floats.csv");
    froe_event_writer *events;
    MUST(r, froe_event_writer_new("floats.csv", &memory, &events, NULL));
    if (!froe_event_writer_put(events, &event)) fail_msg("an event cannot be written");
    MUST(r, froe_event_writer_close(events, FROE_OK, NULL));
    floats_note_file(r, "floats.csv");
    MUST(r, froe_animate(motion, k.contacts, k.count, NULL, "floats.svg", NULL));
    floats_note_file(r, "floats.svg");
    MUST(r, froe_write_motion(motion, "floats.mfjson", NULL));
    floats_note_file(r, "floats.mfjson");
    o.alloc = &memory;
    MUST(r, froe_read_motion("floats.mfjson", &o, &again, NULL, NULL));
    for (uint32_t v = 0; v < froe_motion_vertex_count(again); v++)
        for (size_t i = 0; i < froe_motion_knot_count(again, v); i++) {
            const froe_moving_knot knot = froe_motion_knot(again, v, i);
            floats_note(r, &knot.time, 8), floats_note(r, knot.at, 16);
        }
    froe_motion_free(again);
    froe_motion_free(motion);
    poses_of_a_part(r);
}

static void files_of_motion_are_the_same(void **state) {
    (void)state;
    floats_compare(motion_files, NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_builds_the_same_tree),
        cmocka_unit_test(scenes_and_sections_are_the_same),
        cmocka_unit_test(every_query_gives_the_same_answers),
        cmocka_unit_test(every_measure_is_the_same),
        cmocka_unit_test(every_view_is_the_same),
        cmocka_unit_test(motion_is_the_same),
        cmocka_unit_test(files_are_the_same),
        cmocka_unit_test(files_of_motion_are_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
