/* Trees, answers, pictures and events of every method, as hashes in hashes.txt: a change of the code that should leave
 * them alone shows here if it does not. A tree is hashed as the bytes of its file, so a new format changes every line.
 *
 *     test_conformance_hashes            compares; the lines that differ are printed, both ways
 *     test_conformance_hashes --write    prints the list as it is now, for hashes.txt; the commit says why */
#include "base/random.h"
#include "build/options.h"
#include <froe/io.h>
#include <froe/kinetic.h>
#include <froe/query.h>
#include <froe/view.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OBJECTS = 48, ROUNDS = 4, LINE = 200 };

typedef struct hash {
    uint64_t state;
} hash;

static void put(hash *h, const void *data, size_t bytes) {
    const unsigned char *p = data;
    for (size_t i = 0; i < bytes; i++) h->state = (h->state ^ p[i]) * UINT64_C(0x100000001b3); /* FNV-1a */
}

/* Items of 4 or 8 bytes, the lowest byte first on any machine. */
static void put_items(hash *h, const void *data, size_t count, size_t size) {
    const unsigned char *p = data;
    const bool lowest_first = *(const unsigned char *)&(const uint32_t){1} == 1;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < size; k++) put(h, p + i * size + (lowest_first ? k : size - 1 - k), 1);
}

static void put_number(hash *h, uint64_t x) {
    put_items(h, &x, 1, sizeof x);
}

static void put_double(hash *h, double x) {
    put_items(h, &x, 1, sizeof x);
}

/** The list, now and as it should be; one line a case. */
typedef struct list {
    FILE *expected; /**< NULL: --write */
    size_t lines, wrong;
} list;

/* A tree that was not saved (hash_of_tree()) is like any. */
static bool is_same(const char *expected, const char *line) {
    enum { DIGITS = 16 };
    static const char none[] = " tree 0000000000000000";
    const char *at = strstr(line, none);
    const size_t before = at ? (size_t)(at - line) + sizeof none - 1 - DIGITS : 0;
    if (!at || strlen(expected) != strlen(line)) return !strcmp(expected, line);
    return !strncmp(expected, line, before) && !strcmp(expected + before + DIGITS, line + before + DIGITS);
}

static void say(list *l, const char *line) {
    char expected[LINE] = "";
    if (!l->expected) {
        puts(line);
    } else {
        if (fgets(expected, sizeof expected, l->expected)) expected[strcspn(expected, "\n")] = 0;
        if (!is_same(expected, line)) l->wrong++, printf("- %s\n+ %s\n", expected, line);
    }
    l->lines++;
}

/* ------------------------------------------------------------------- trees -- */

/* 0 on machines whose highest byte comes first, which save no trees. */
static uint64_t hash_of_tree(const froe_tree *tree) {
    static unsigned char bytes[1 << 16];
    hash h = {0};
    const char *path = "hashes.froe";
    const froe_status status = froe_tree_save(tree, path, NULL);
    if (status == FROE_E_UNSUPPORTED) return 0;
    FILE *file = status ? NULL : fopen(path, "rb");
    if (!file) perror(path), abort();
    for (size_t n; (n = fread(bytes, 1, sizeof bytes, file));) put(&h, bytes, n);
    fclose(file);
    remove(path);
    return h.state;
}

/* ----------------------------------------------------------------- answers -- */

/** Numbers in and around the bounds of a scene. */
typedef struct source {
    uint64_t draws;
    int dim;
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
} source;

static double draw(source *s) {
    return (double)(base_hash(11, 1, s->draws++) >> 11) * 0x1p-53;
}

static void draw_point(source *s, double *out) {
    for (int k = 0; k < s->dim; k++) out[k] = s->lo[k] + (1.2 * draw(s) - 0.1) * (s->hi[k] - s->lo[k]);
}

static void draw_box(source *s, double *lo_hi) {
    draw_point(s, lo_hi);
    for (int k = 0; k < s->dim; k++) lo_hi[s->dim + k] = lo_hi[k] + (0.05 + 0.3 * draw(s)) * (s->hi[k] - s->lo[k]);
}

static void put_ids(hash *h, froe_status status, const froe_list *found) {
    put_number(h, status);
    if (!status) put_number(h, found->count), put_items(h, found->ids, found->count, sizeof *found->ids);
}

static void ask_ranges(hash *h, froe_query *query, source *s) {
    const double span = s->hi[0] - s->lo[0];
    for (int shape = 0; shape < FROE_SHAPE_COUNT; shape++)
        for (int walk = FROE_WALK_AUTO; walk <= FROE_WALK_BOX; walk++) {
            double points[(FROE_MAX_DIM + 1) * FROE_MAX_DIM];
            const double offsets[3] = {draw(s), draw(s), draw(s)};
            froe_range range = froe_range_defaults();
            froe_list found;
            for (int i = 0; i <= s->dim; i++) draw_point(s, points + i * s->dim);
            if (shape == FROE_SHAPE_BOX) draw_box(s, points);
            range.shape = (froe_range_shape)shape;
            range.points = points;
            range.offsets = offsets;
            range.count = 3;
            range.radius = 0.2 * draw(s) * span;
            range.walk = (froe_walk)walk;
            const froe_status status = froe_query_range(query, &range, &found, NULL);
            put_ids(h, status, &found);
        }
}

static void ask_point(hash *h, froe_query *query, source *s) {
    double at[FROE_MAX_DIM];
    froe_list found;
    froe_neighbours near;
    draw_point(s, at);
    froe_status status = froe_query_locate(query, at, &found, NULL);
    put_ids(h, status, &found);
    status = froe_query_groups(query, at, &found, NULL);
    put_ids(h, status, &found);
    for (int direction = -1; direction <= 1; direction += 2) {
        uint32_t object = FROE_NONE;
        put_number(h, froe_query_vertical(query, at, direction, &object, NULL));
        put_number(h, object);
    }
    put_number(h, status = froe_query_near(query, at, 5, 1e300, &near, NULL));
    for (size_t i = 0; !status && i < near.count; i++)
        put_number(h, near.items[i].object), put_double(h, near.items[i].distance);
}

static void ask_ray(hash *h, froe_query *query, source *s) {
    double from[FROE_MAX_DIM], way[FROE_MAX_DIM];
    froe_hits hits;
    draw_point(s, from), draw_point(s, way);
    for (int k = 0; k < s->dim; k++) way[k] -= from[k];
    const froe_status status = froe_query_ray_all(query, from, way, 4, &hits, NULL);
    put_number(h, status);
    for (size_t i = 0; !status && i < hits.count; i++)
        put_number(h, hits.hits[i].object), put_double(h, hits.hits[i].t);
}

static bool put_pair(void *user, const froe_pair *pair) {
    put_number(user, pair->a), put_number(user, pair->b), put_number(user, pair->kind);
    return true;
}

static uint64_t hash_of_answers(const froe_tree *tree) {
    hash h = {0};
    source s = {.dim = froe_scene_dim(froe_tree_scene(tree))};
    froe_query *query;
    if (froe_query_new(tree, &query, NULL) || !froe_scene_bounds(froe_tree_scene(tree), s.lo, s.hi)) abort();
    for (int i = 0; i < ROUNDS; i++) ask_ranges(&h, query, &s), ask_point(&h, query, &s), ask_ray(&h, query, &s);
    put_number(&h, froe_query_pairs(query, true, put_pair, &h, NULL));
    froe_query_free(query);
    return h.state;
}

/* ---------------------------------------------------------------- pictures -- */

/** Of polygons in space: shapes and lines of a picture; 0 for other scenes. */
static uint64_t hash_of_picture(const froe_tree *tree) {
    const froe_scene *scene = froe_tree_scene(tree);
    hash h = {0};
    froe_surface *surface;
    froe_projection view;
    froe_picture *picture;
    froe_camera camera = froe_camera_defaults();
    if (froe_scene_dim(scene) != 3 || !froe_scene_kind_count(scene, FROE_POLYGON)) return 0;
    if (froe_surface_new(scene, NULL, &surface, NULL)) return 1;
    froe_picture_options o = froe_picture_defaults();
    o.view = &view;
    o.lines = FROE_LINE_END - 1;
    o.hidden = true;
    froe_status status = froe_camera_place(&camera, scene, &view, NULL);
    if (!status) status = froe_picture_new(tree, surface, &o, &picture, NULL);
    put_number(&h, status);
    if (!status) {
        for (size_t i = 0; i < froe_picture_shape_count(picture); i++) {
            const froe_shape shape = froe_picture_shape(picture, i);
            for (size_t r = shape.first_ring, count; r < shape.first_ring + shape.ring_count; r++) {
                const double *points = froe_picture_ring(picture, r, &count);
                put_items(&h, points, 2 * count, sizeof *points);
            }
        }
        for (size_t i = 0; i < froe_picture_stroke_count(picture); i++) {
            const froe_stroke stroke = froe_picture_stroke(picture, i);
            put_number(&h, stroke.kind * 4 + stroke.hidden * 2 + stroke.closed);
            put_items(&h, stroke.points, 2 * stroke.count, sizeof *stroke.points);
        }
        froe_picture_free(picture);
    }
    froe_surface_free(surface);
    return h.state;
}

/* ------------------------------------------------------------------- cases -- */

/** Methods that have a guard stage enter it, and those that refuse crossings are told to split. */
static const char *settings_of(const froe_method_info *method) {
    if (!strcmp(method->name, "density") || !strcmp(method->name, "bar")) return "k=4 stop=1";
    return strcmp(method->name, "cylindrical") ? NULL : "crossing=split";
}

static void check_scene(list *l, const froe_generator_info *kind, const froe_method_info *method, uint32_t leaf) {
    char line[LINE];
    froe_scene *scene;
    froe_tree *tree;
    froe_build_options o = froe_build_defaults();
    o.method = method->name;
    o.settings = settings_of(method);
    o.leaf = leaf;
    o.threads = 1;
    o.max_fragments = 4000;
    if (froe_generate(kind->name, OBJECTS, 5, NULL, &scene, NULL)) abort();
    const froe_status status = build_tuned(scene, &o, &tree, NULL);
    if (status != FROE_E_UNSUPPORTED) {
        if (status) {
            snprintf(line, sizeof line, "%s %s %u status %d", kind->name, method->name, leaf, status);
        } else {
            snprintf(line, sizeof line, "%s %s %u tree %016llx answers %016llx picture %016llx", kind->name,
                     method->name, leaf, (unsigned long long)hash_of_tree(tree),
                     (unsigned long long)hash_of_answers(tree), (unsigned long long)hash_of_picture(tree));
            froe_tree_free(tree);
        }
        say(l, line);
    }
    froe_scene_free(scene);
}

static bool put_event(void *user, const froe_event *event) {
    put_number(user, event->kind), put_number(user, (uint64_t)event->tick);
    for (unsigned i = 0; i < event->object_count && i < 4; i++) put_number(user, event->objects[i]);
    return true;
}

static void check_motion(list *l, const froe_motion_generator_info *kind, bool augmented) {
    char line[LINE];
    hash h = {0};
    froe_motion *motion;
    froe_kinetic *kinetic;
    froe_snapshot now;
    froe_kinetic_options o = froe_kinetic_defaults();
    o.augmented = augmented;
    if (froe_generate_motion(kind->name, OBJECTS / 3, 5, NULL, &motion, NULL) ||
        froe_kinetic_new(motion, &o, NULL, &kinetic, NULL))
        abort();
    put_number(&h, froe_kinetic_advance(kinetic, 17.3, put_event, &h, NULL));
    if (froe_kinetic_snapshot(kinetic, NULL, &now, NULL)) abort();
    snprintf(line, sizeof line, "%s %s tree %016llx events %016llx", kind->name, augmented ? "augmented" : "ordinary",
             (unsigned long long)hash_of_tree(now.tree), (unsigned long long)h.state);
    say(l, line);
    froe_places_free(now.places);
    froe_tree_free(now.tree);
    froe_kinetic_free(kinetic);
    froe_motion_free(motion);
}

static bool put_contact(void *user, const froe_contact *c) {
    put_number(user, c->a), put_number(user, c->b);
    for (int i = 0; i < 2; i++) put_double(user, c->begin[i]), put_double(user, c->end[i]);
    return true;
}

static void check_contacts(list *l, const froe_motion_generator_info *kind) {
    char line[LINE];
    hash h = {0};
    froe_motion *motion;
    if (froe_generate_motion(kind->name, kind->dim == 3 ? OBJECTS : OBJECTS / 3, 5, NULL, &motion, NULL) ||
        froe_motion_contacts(motion, NULL, put_contact, &h, NULL))
        abort();
    snprintf(line, sizeof line, "%s contacts %016llx", kind->name, (unsigned long long)h.state);
    say(l, line);
    froe_motion_free(motion);
}

int main(int count, char **arguments) {
    list l = {0};
    if (count < 2 || strcmp(arguments[1], "--write")) {
        l.expected = fopen(FROE_TEST_DATA "/../tests/conformance/hashes.txt", "r");
        if (!l.expected) return perror("hashes.txt"), 1;
    }
    for (size_t k = 0; froe_generator_at(k); k++)
        for (size_t m = 0; froe_method_at(m); m++)
            for (uint32_t leaf = 1; leaf <= 5; leaf += 4)
                check_scene(&l, froe_generator_at(k), froe_method_at(m), leaf);
    for (size_t k = 0; froe_motion_generator_at(k); k++)
        for (int augmented = 0; augmented < 2 && froe_motion_generator_at(k)->dim == 2; augmented++)
            check_motion(&l, froe_motion_generator_at(k), augmented);
    for (size_t k = 0; froe_motion_generator_at(k); k++) check_contacts(&l, froe_motion_generator_at(k));
    if (!l.expected) return 0;
    char more[LINE];
    while (fgets(more, sizeof more, l.expected)) l.wrong++, printf("- %s", more);
    fclose(l.expected);
    printf("%zu lines, %zu of them differ\n", l.lines, l.wrong);
    return l.wrong != 0;
}
