/* test_file.c: saving and opening: what goes out comes back, and nothing else comes in. */
#include "support/forge.h"
#include "support/opened.h"
#include "support/sanitized.h"
#include "trees.h"
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#define NAME "test.froe"

/* ------------------------------------------------------------------- tools -- */

static uint8_t *slurp(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *size = (size_t)ftell(file);
    rewind(file);
    uint8_t *bytes = malloc(*size ? *size : 1);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    return bytes;
}

/* Overwrites in place: truncating to nothing first would make some file systems wait for the disk. */
static void spill(const char *path, const void *bytes, size_t size) {
    int fd = open(path, O_WRONLY | O_CREAT, 0666);
    assert_true(fd >= 0);
    assert_int_equal(pwrite(fd, bytes, size, 0), size);
    assert_int_equal(ftruncate(fd, (off_t)size), 0);
    assert_int_equal(close(fd), 0);
}

static size_t files_here(void) {
    DIR *folder = opendir(".");
    size_t count = 0;
    assert_non_null(folder);
    while (readdir(folder)) count++;
    closedir(folder);
    return count;
}

static void assert_saved(const froe_tree *tree, const char *path) {
    froe_diagnostic why;
    if (froe_tree_save(tree, path, &why)) fail_msg("%s", why.message);
}

static froe_tree *opened(const char *path) {
    froe_diagnostic why;
    froe_tree *tree = NULL;
    if (froe_tree_open(path, NULL, &tree, &why)) fail_msg("%s", why.message);
    return tree;
}

#define CRS_STRINGS "PROJCRS[\"grid\"]\0grid\0EPSG:25832\0metre\0"

/* A scene with everything in it: tags, faces, groups, demoted objects; 2D segments or 3D mixed kinds. */
static froe_scene *rich_scene(int dim) {
    froe_scene *scene = trees_scene(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, 5, 3, 1, 2);
    const froe_group group = {.name = "walls", .material = "oak", .right = "room"};
    const double points[6] = {0, 0, 1, 1, 1, 1};
    const uint64_t tags[1] = {99};
    const uint32_t faces[1] = {7}, indices[3] = {0, 0, 0};
    froe_objects o = froe_objects_defaults();
    const froe_crs crs = {FROE_CRS_PROJECTED, "PROJCRS[\"grid\"]", "grid", "EPSG:25832", "metre"};
    assert_int_equal(froe_scene_add_group(scene, &group, &o.group), FROE_OK);
    assert_int_equal(froe_scene_set_crs(scene, &crs), FROE_OK);
    o.kind = dim == 2 ? FROE_SEGMENT : FROE_POLYGON;
    o.count = 1;
    o.coords = points;
    o.point_count = 1;
    o.indices = indices;
    o.tags = tags;
    o.faces = faces;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    if (dim == 3) {
        assert_int_equal(trees_scatter(scene, FROE_BALL, 2, 0, 0.5, 1), FROE_OK);
        assert_int_equal(trees_scatter(scene, FROE_BOX, 2, 0, 0.5, 1), FROE_OK);
    }
    return scene;
}

enum { PLANE = 2, SPACE = 3, PACKED = 4, COVERED = 5, LAYOUTS };

static froe_tree *rich_tree(int layout) {
    froe_scene *scene = rich_scene(layout == SPACE ? 3 : 2);
    for (int i = 1; i < 13 && layout == COVERED; i++) { /* boxes around all: covers */
        const double box[4] = {-i, -i, 5 + i, 5 + i};
        assert_int_equal(trees_add(scene, FROE_BOX, 1, box, NULL, NULL), FROE_OK);
    }
    froe_tree *tree = layout == PACKED    ? trees_build(scene, "index", 2)
                      : layout == COVERED ? trees_build(scene, "kd", 1)
                                          : trees_build(scene, "density", 1);
    if (layout == COVERED) assert_true(froe_tree_report(tree).covers >= 5);
    froe_scene_free(scene);
    return tree;
}

static void assert_scenes_equal(const froe_scene *a, const froe_scene *b) {
    assert_int_equal(a->dim, b->dim);
    assert_int_equal(a->object_count, b->object_count);
    assert_int_equal(a->vertex_count, b->vertex_count);
    for (uint32_t i = 0; i < a->object_count; i++) {
        froe_object x = froe_scene_object(a, i), y = froe_scene_object(b, i);
        assert_true(x.kind == y.kind && x.form == y.form && x.corners == y.corners && x.face == y.face);
        assert_true(x.group == y.group && x.tag == y.tag && x.radius == y.radius);
        for (uint32_t c = 0; c < x.corners; c++)
            assert_int_equal(froe_scene_corner(a, i, c), froe_scene_corner(b, i, c));
    }
    assert_memory_equal(a->coords, b->coords, a->vertex_count * (size_t)a->dim * sizeof *a->coords);
    assert_int_equal(froe_scene_group_count(a), froe_scene_group_count(b));
    for (uint32_t i = 0; i < a->group_count; i++) {
        assert_string_equal(froe_scene_group(a, i).name, froe_scene_group(b, i).name);
        assert_string_equal(froe_scene_group(a, i).material, froe_scene_group(b, i).material);
        assert_string_equal(froe_scene_group(a, i).left, froe_scene_group(b, i).left);
        assert_string_equal(froe_scene_group(a, i).right, froe_scene_group(b, i).right);
    }
    const froe_crs x = froe_scene_crs(a), y = froe_scene_crs(b);
    assert_int_equal(x.kind, y.kind);
    assert_string_equal(x.wkt, y.wkt);
    assert_string_equal(x.name, y.name);
    assert_string_equal(x.code, y.code);
    assert_string_equal(x.unit, y.unit);
    assert_memory_equal(a->lo, b->lo, (size_t)a->dim * sizeof *a->lo);
    assert_memory_equal(a->hi, b->hi, (size_t)a->dim * sizeof *a->hi);
}

static void assert_reports_equal(froe_report a, froe_report b) {
    assert_string_equal(a.method, b.method);
    assert_string_equal(a.settings, b.settings);
    for (size_t i = 0; a.promises[i].name || b.promises[i].name; i++) {
        assert_string_equal(a.promises[i].name, b.promises[i].name);
        assert_true(a.promises[i].promised == b.promises[i].promised);
        assert_true(a.promises[i].measured == b.promises[i].measured);
    }
    const froe_predicate_stats none = {0};
    assert_memory_equal(&b.predicates, &none, sizeof none); /* of the build, not of the file */
    a.predicates = b.predicates;
    a.method = b.method;
    a.settings = b.settings;
    a.promises = b.promises;
    assert_memory_equal(&a, &b, sizeof a);
}

/* Asks an opened tree for everything: nothing may crash, whatever it answers. */
static bool see(void *user, const froe_cell *cell) {
    double *sum = user;
    for (size_t i = 0; i < cell->corners; i++) *sum += cell->coords[i];
    return true;
}
static void look_at_all(const froe_tree *tree) {
    double corners[3 * 64], sum = 0, lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    froe_node made[64];
    for (uint32_t i = 0; i < tree->node_count; i++) (void)froe_tree_node(tree, (froe_node){i + 1});
    for (size_t i = 0; i < froe_tree_piece_count(tree); i++)
        sum += (double)froe_tree_piece_corners(tree, i, corners, made, 64);
    if (froe_scene_bounds(froe_tree_scene(tree), lo, hi)) (void)froe_tree_cells(tree, lo, hi, see, &sum, NULL);
    (void)froe_tree_audit(tree, NULL, NULL);
    volatile double used = sum;
    (void)used;
}

/* ------------------------------------------------------------- round trips -- */

static void what_is_saved_is_opened(void **state) {
    (void)state;
    for (int layout = PLANE; layout < LAYOUTS; layout++) {
        froe_tree *tree = rich_tree(layout), *again;
        assert_saved(tree, NAME);
        again = opened(NAME);
        trees_assert_equal(tree, again);
        assert_scenes_equal(froe_tree_scene(tree), froe_tree_scene(again));
        assert_reports_equal(froe_tree_report(tree), froe_tree_report(again));
        look_at_all(again);
        assert_saved(again, "again.froe");
        size_t size, size_again;
        uint8_t *a = slurp(NAME, &size), *b = slurp("again.froe", &size_again);
        assert_int_equal(size, size_again);
        assert_memory_equal(a, b, size);
        free(a);
        free(b);
        froe_tree_free(tree);
        froe_tree_free(again);
    }
    unlink(NAME);
    unlink("again.froe");
}

/* What froe_tree_write() hands over, as far as it is taken. */
typedef struct receiver {
    uint8_t *bytes;
    size_t count, calls, most;
} receiver;

static bool receive(void *user, const void *bytes, size_t count) {
    receiver *r = user;
    assert_true(count > 0);
    if (r->calls++ == r->most) return false;
    r->bytes = realloc(r->bytes, r->count + count);
    assert_non_null(r->bytes);
    memcpy(r->bytes + r->count, bytes, count);
    r->count += count;
    return true;
}

/* Written, moved to an odd address, opened, and freed. */
static void trees_go_through_memory(void **state) {
    (void)state;
    for (int layout = PLANE; layout < LAYOUTS; layout++) {
        froe_tree *tree = rich_tree(layout), *again = NULL;
        size_t size;
        receiver r = {.most = SIZE_MAX};
        assert_saved(tree, NAME);
        uint8_t *file = slurp(NAME, &size);
        unlink(NAME);
        assert_int_equal(froe_tree_write(tree, receive, &r, NULL), FROE_OK);
        assert_int_equal(r.count, size);
        assert_int_equal(froe_tree_saved_size(tree), size);
        assert_memory_equal(r.bytes, file, size);
        uint8_t *odd = malloc(size + 1);
        assert_non_null(odd);
        memcpy(odd + 1, file, size);
        assert_int_equal(froe_tree_open_memory(odd + 1, size, NULL, &again, NULL), FROE_OK);
        memset(odd, 0xff, size + 1);
        free(odd);
        trees_assert_equal(tree, again);
        assert_scenes_equal(froe_tree_scene(tree), froe_tree_scene(again));
        assert_reports_equal(froe_tree_report(tree), froe_tree_report(again));
        look_at_all(again);
        froe_tree_free(again);
        free(file);
        froe_tree_free(tree);
        free(r.bytes);
    }
}

/* Wherever the caller's function stops, it has received the beginning of the file. */
static void a_receiver_may_stop(void **state) {
    (void)state;
    froe_tree *tree = rich_tree(PLANE);
    receiver all = {.most = SIZE_MAX};
    froe_diagnostic why;
    assert_int_equal(froe_tree_write(tree, receive, &all, NULL), FROE_OK);
    for (size_t most = 0; most < all.calls; most++) {
        receiver some = {.most = most};
        assert_int_equal(froe_tree_write(tree, receive, &some, &why), FROE_E_IO);
        assert_int_equal(some.calls, most + 1);
        assert_true(some.count < all.count);
        if (some.count) assert_memory_equal(some.bytes, all.bytes, some.count);
        free(some.bytes);
    }
    assert_int_equal(froe_tree_write(tree, NULL, NULL, &why), FROE_E_ARG);
    assert_int_equal(froe_tree_open_memory(NULL, 1, NULL, &tree, &why), FROE_E_ARG);
    assert_int_equal(froe_tree_open_memory(NULL, 0, NULL, &tree, &why), FROE_E_FORMAT);
    assert_non_null(strstr(why.message, "empty"));
    assert_int_equal(froe_tree_open_memory(all.bytes, 63, NULL, &tree, &why), FROE_E_FORMAT);
    froe_tree_free(tree);
    free(all.bytes);
}

/* By the offsets of docs/format.md, not by the structs of the code under test. */
static uint64_t number(const uint8_t *bytes, size_t offset, size_t size) {
    uint64_t value = 0;
    for (size_t i = 0; i < size; i++) value |= (uint64_t)bytes[offset + i] << 8 * i;
    return value;
}

static void checksums_are_as_specified(void **state) {
    (void)state;
    uint8_t bytes[100];
    for (uint8_t i = 0; i < 100; i++) bytes[i] = i;
    assert_true(file_checksum("", 0, 0) == 0x8813fa1cbc461847u); /* by another program */
    assert_true(file_checksum("froe", 4, 0) == 0xcd966b9a03e96491u);
    assert_true(file_checksum(bytes, 100, 7) == 0x82d79541921a0b2du);
}

static void files_are_as_specified(void **state) {
    (void)state;
    static const uint8_t magic[8] = {0x89, 0x66, 0x72, 0x6f, 0x65, 0x0d, 0x0a, 0x1a};
    static const uint64_t items[24] = {1264, 16, 24, 8,  4, 8,  8, 1, 1,   4, 4, 8,
                                       8,    4,  4,  20, 1, 64, 4, 1, 208, 4, 1, 192};
    froe_tree *tree = rich_tree(3);
    const froe_scene *scene = froe_tree_scene(tree);
    size_t size, offset = 832;
    assert_saved(tree, NAME);
    uint8_t *bytes = slurp(NAME, &size);
    assert_memory_equal(bytes, magic, 8);
    assert_int_equal(number(bytes, 8, 4), 4);
    assert_int_equal(number(bytes, 12, 4), 24);
    assert_int_equal(number(bytes, 16, 8), size);
    assert_int_equal(number(bytes, 24, 4), 3);
    assert_int_equal(number(bytes, 32, 4), FROE_CRS_PROJECTED);
    assert_true(number(bytes, 56, 8) == file_checksum(bytes + 64, 24 * 32, file_checksum(bytes, 56, 0)));
    const uint64_t counts[24] = {1,
                                 tree->node_count,
                                 tree->cut_count,
                                 tree->piece_count,
                                 tree->bound_count,
                                 tree->normal_count,
                                 3 * froe_scene_vertex_count(scene),
                                 froe_scene_object_count(scene),
                                 froe_scene_object_count(scene),
                                 froe_scene_object_count(scene) + 1,
                                 scene->corner_count,
                                 froe_scene_kind_count(scene, FROE_BALL),
                                 froe_scene_object_count(scene),
                                 froe_scene_object_count(scene),
                                 froe_scene_object_count(scene),
                                 1,
                                 scene->text_size,
                                 0,
                                 0,
                                 sizeof CRS_STRINGS - 1,
                                 1,
                                 0,
                                 0,
                                 0};
    for (size_t i = 0; i < 24; i++) {
        const size_t entry = 64 + 32 * i;
        assert_int_equal(number(bytes, entry, 4), i + 1);
        assert_int_equal(number(bytes, entry + 4, 4), items[i]);
        assert_int_equal(number(bytes, entry + 8, 8), offset);
        assert_int_equal(number(bytes, entry + 16, 8), counts[i] * items[i]);
        assert_true(number(bytes, entry + 24, 8) == file_checksum(bytes + offset, counts[i] * items[i], 0));
        offset = (offset + counts[i] * items[i] + 63) / 64 * 64;
    }
    assert_int_equal(offset, size);
    assert_string_equal(bytes + 832, "density");
    const size_t strings = (sizeof CRS_STRINGS - 1 + 63) / 64 * 64;
    assert_memory_equal(bytes + size - 256 - strings, CRS_STRINGS, sizeof CRS_STRINGS - 1);
    free(bytes);
    froe_tree_free(tree);
    unlink(NAME);
}

static void a_tree_of_nothing_is_saved_too(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 0, 0, 1, "density", 1);
    assert_saved(tree, NAME);
    froe_tree *again = opened(NAME);
    assert_int_equal(froe_tree_report(again).objects, 0);
    assert_int_equal(froe_tree_report(again).nodes, 1);
    look_at_all(again);
    froe_tree_free(tree);
    froe_tree_free(again);
    unlink(NAME);
}

static void trees_in_many_dimensions_are_saved(void **state) {
    (void)state;
    for (int dim = 4; dim <= FROE_MAX_DIM; dim += 4) {
        froe_tree *tree = trees_grow(dim, FROE_BOX, 20, 4, 0.5, "density", 2);
        assert_saved(tree, NAME);
        froe_tree *again = opened(NAME);
        trees_assert_equal(tree, again);
        froe_tree_free(tree);
        froe_tree_free(again);
    }
    unlink(NAME);
}

static void a_scene_from_a_file_never_grows(void **state) {
    (void)state;
    froe_tree *tree = rich_tree(2);
    assert_saved(tree, NAME);
    froe_tree_free(tree);
    tree = opened(NAME);
    assert_int_equal(trees_scatter((froe_scene *)froe_tree_scene(tree), FROE_SEGMENT, 1, 0, 1, 1), FROE_E_FROZEN);
    froe_tree_free(tree);
    unlink(NAME);
}

/* -------------------------------------------------------------- corruption -- */

static froe_status try_bytes(const uint8_t *bytes, size_t size, froe_diagnostic *why) {
    froe_tree *tree = NULL;
    froe_status status = froe_tree_open_memory(bytes, size, NULL, &tree, why);
    if (status == FROE_OK) {
        opened_ask(tree, size, 4); /* what each search reads is checked by it ... */
        status = froe_tree_check(tree, why);
        look_at_all(tree); /* ... and by the first other call, everything */
        if (status) assert_int_equal(froe_tree_save(tree, "never.froe", NULL), FROE_E_FORMAT);
        froe_tree_free(tree);
    } else {
        assert_int_equal(why->status, status);
        assert_non_null(strstr(why->message, ""));
        assert_null(tree);
    }
    return status;
}

static uint8_t *small_file(int layout, size_t *size) {
    froe_tree *tree = rich_tree(layout);
    assert_saved(tree, NAME);
    froe_tree_free(tree);
    return slurp(NAME, size);
}

/* What to do about it is said. */
static void files_of_other_versions_are_refused(void **state) {
    (void)state;
    static const uint8_t versions[] = {0, 1, 2, 3, 5};
    size_t size;
    uint8_t *bytes = small_file(COVERED, &size);
    for (size_t i = 0; i < sizeof versions; i++) {
        char expected[200];
        froe_diagnostic why;
        froe_tree *tree;
        bytes[8] = versions[i];
        forge_checksums(bytes, size);
        spill("other.froe", bytes, size);
        assert_int_equal(froe_tree_open("other.froe", NULL, &tree, &why), FROE_E_FORMAT);
        snprintf(
            expected, sizeof expected,
            "other.froe: It is a tree file of version %u, and this froe reads version 4: %sbuild it again from its "
            "scene.",
            versions[i], versions[i] > 4 ? "open it with a newer froe, or " : "");
        assert_string_equal(why.message, expected);
    }
    free(bytes);
}

static void every_changed_byte_is_noticed(void **state) {
    (void)state;
    size_t size;
    froe_diagnostic why;
    uint8_t *bytes = small_file(PACKED, &size);
    assert_int_equal(try_bytes(bytes, size, &why), FROE_OK);
    for (size_t i = 0; i < size; i++) {
        uint8_t old = bytes[i];
        bytes[i] = (uint8_t)(old ^ (1u << i % 8));
        if (try_bytes(bytes, size, &why) != FROE_E_FORMAT) fail_msg("byte %zu", i);
        bytes[i] = (uint8_t)~old;
        if (try_bytes(bytes, size, &why) != FROE_E_FORMAT) fail_msg("byte %zu", i);
        bytes[i] = old;
    }
    free(bytes);
    unlink(NAME);
}

static void every_truncation_is_noticed(void **state) {
    (void)state;
    size_t size;
    froe_diagnostic why;
    uint8_t *bytes = small_file(PACKED, &size);
    for (size_t i = 0; i < size; i++)
        if (try_bytes(bytes, i, &why) != FROE_E_FORMAT) fail_msg("length %zu", i);
    uint8_t *longer = calloc(1, size + 64);
    assert_non_null(longer);
    memcpy(longer, bytes, size);
    assert_int_equal(try_bytes(longer, size + 1, &why), FROE_E_FORMAT);
    assert_int_equal(try_bytes(longer, size + 64, &why), FROE_E_FORMAT);
    free(longer);
    free(bytes);
    unlink(NAME);
}

/* Bytes of the structure must be refused even with right checksums; numbers may be others', but nothing may crash. */
static void forged_files_are_refused_or_harmless(void **state) {
    (void)state;
    for (int layout = PLANE; layout < LAYOUTS; layout++) {
        size_t size, opened_count = 0;
        froe_diagnostic why;
        uint8_t *bytes = small_file(layout, &size), *copy = malloc(size);
        assert_non_null(copy);
        for (size_t i = 0; i < size; i++) {
            static const uint8_t flips[] = {0x01, 0x80, 0xff};
            memcpy(copy, bytes, size);
            copy[i] ^= flips[i % 3];
            forge_checksums(copy, size);
            opened_count += try_bytes(copy, size, &why) == FROE_OK;
        }
        assert_true(opened_count > 0 && opened_count < size);
        free(copy);
        free(bytes);
    }
    unlink(NAME);
}

/* Words of the arrays that hold indices, replaced by small numbers and some large ones. */
static void forge_words(const uint8_t *bytes, size_t size, file_id id) {
    static const uint32_t values[] = {0,  1,          2,           3,           5,           8,
                                      13, 0x7fffffff, 0x80000000u, 0x80000001u, 0x80000002u, 0xffffffffu};
    const size_t step = SANITIZED ? 6 : 3; /* each word becomes some of them */
    froe_diagnostic why;
    file_section s;
    uint8_t *copy = malloc(size);
    assert_non_null(copy);
    memcpy(&s, bytes + sizeof(file_header) + (id - 1) * sizeof s, sizeof s);
    for (uint64_t at = 0; at + 4 <= s.size; at += 4)
        for (size_t v = at / 4 % step; v < sizeof values / sizeof *values; v += step) {
            memcpy(copy, bytes, size);
            memcpy(copy + s.offset + at, values + v, 4);
            forge_checksums(copy, size);
            (void)try_bytes(copy, size, &why);
        }
    free(copy);
}

static void forged_indices_are_refused_or_harmless(void **state) {
    (void)state;
    static const file_id indices[] = {FILE_NODES,  FILE_CUTS,    FILE_PIECES, FILE_BOUNDS,
                                      FILE_STARTS, FILE_CORNERS, FILE_BLOCKS, FILE_OWNERS};
    for (int layout = SPACE; layout < LAYOUTS; layout++) {
        size_t size;
        uint8_t *bytes = small_file(layout, &size);
        for (size_t k = 0; k < sizeof indices / sizeof *indices; k++) forge_words(bytes, size, indices[k]);
        free(bytes);
    }
    unlink(NAME);
}

static void reasons_are_given(void **state) {
    (void)state;
    froe_tree *tree = NULL;
    froe_diagnostic why;
    assert_int_equal(froe_tree_open("no/such/file", NULL, &tree, &why), FROE_E_IO);
    assert_non_null(strstr(why.message, "no/such/file"));
    assert_non_null(strstr(why.message, "No such file"));
    assert_int_equal(froe_tree_open(".", NULL, &tree, &why), FROE_E_IO);
    assert_non_null(strstr(why.message, "directory"));
    spill(NAME, "", 0);
    assert_int_equal(froe_tree_open(NAME, NULL, &tree, &why), FROE_E_FORMAT);
    assert_non_null(strstr(why.message, "empty"));
    char text[1000];
    memset(text, 'x', sizeof text);
    spill(NAME, text, sizeof text);
    assert_int_equal(froe_tree_open(NAME, NULL, &tree, &why), FROE_E_FORMAT);
    assert_int_equal(froe_tree_open(NULL, NULL, &tree, &why), FROE_E_ARG);
    assert_null(tree);
    unlink(NAME);
}

/* ---------------------------------------------------------------- atomicity -- */

static void a_failing_save_leaves_the_old_file_and_nothing_else(void **state) {
    (void)state;
    froe_tree *small = rich_tree(2), *large = trees_grow(2, FROE_SEGMENT, 500, 0, 0.1, "density", 1);
    size_t size, now;
    assert_saved(small, NAME);
    uint8_t *before = slurp(NAME, &size);
    size_t files = files_here();
    struct rlimit old, limit = {size, RLIM_INFINITY};
    froe_diagnostic why;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
    limit.rlim_max = old.rlim_max;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0); /* a disk that is full after `size` bytes */
    froe_status status = froe_tree_save(large, NAME, &why);
    froe_status fresh = froe_tree_save(large, "new.froe", &why);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &old), 0);
    assert_int_equal(status, FROE_E_IO);
    assert_int_equal(fresh, FROE_E_IO);
    assert_non_null(strstr(why.message, "new.froe"));
    assert_int_equal(files_here(), files);
    uint8_t *after = slurp(NAME, &now);
    assert_int_equal(size, now);
    assert_memory_equal(before, after, size);
    free(before);
    free(after);
    froe_tree_free(small);
    froe_tree_free(large);
    unlink(NAME);
}

static void places_that_cannot_be_written_are_refused(void **state) {
    (void)state;
    froe_tree *tree = rich_tree(2);
    froe_diagnostic why;
    size_t files = files_here();
    assert_int_equal(froe_tree_save(tree, "no/such/folder/tree.froe", &why), FROE_E_IO);
    assert_non_null(strstr(why.message, "No such file"));
    assert_int_equal(froe_tree_save(tree, "/dev/full", &why), FROE_E_IO);
    assert_int_equal(froe_tree_save(tree, ".", &why), FROE_E_IO);
    assert_int_equal(froe_tree_save(tree, "", &why), FROE_E_IO);
    assert_int_equal(froe_tree_save(tree, NULL, &why), FROE_E_ARG);
    assert_int_equal(mkdir("shut", 0500), 0);
    if (geteuid() != 0) assert_int_equal(froe_tree_save(tree, "shut/tree.froe", &why), FROE_E_IO);
    unlink("shut/tree.froe");
    rmdir("shut");
    assert_int_equal(files_here(), files);
    struct stat device;
    assert_int_equal(stat("/dev/full", &device), 0);
    assert_true(S_ISCHR(device.st_mode));
    froe_tree_free(tree);
}

static void saving_keeps_links_and_modes(void **state) {
    (void)state;
    froe_tree *tree = rich_tree(2);
    struct stat info;
    spill(NAME, "old", 3);
    assert_int_equal(chmod(NAME, 0640), 0);
    assert_int_equal(symlink(NAME, "link.froe"), 0);
    assert_saved(tree, "link.froe");
    assert_int_equal(lstat("link.froe", &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(stat(NAME, &info), 0);
    assert_int_equal(info.st_mode & 07777, 0640);
    froe_tree_free(opened(NAME));
    froe_tree_free(tree);
    unlink(NAME);
    unlink("link.froe");
}

static void a_file_replaced_while_open_does_not_change(void **state) {
    (void)state;
    froe_tree *first = rich_tree(2), *second = rich_tree(3);
    assert_saved(first, NAME);
    froe_tree *open = opened(NAME);
    assert_saved(second, NAME);
    trees_assert_equal(first, open);
    froe_tree *other = opened(NAME);
    trees_assert_equal(second, other);
    froe_tree_free(first);
    froe_tree_free(second);
    froe_tree_free(open);
    froe_tree_free(other);
    unlink(NAME);
}

/* A mapped file that is shortened kills (SIGBUS); one that was copied answers as before. */
static void a_file_shortened_while_open_does_not_change_its_copy(void **state) {
    (void)state;
    for (int layout = PLANE; layout < LAYOUTS; layout++) {
        froe_tree *first = rich_tree(layout), *open = NULL;
        froe_diagnostic why;
        assert_saved(first, NAME);
        assert_int_equal(froe_tree_open_copy(NAME, NULL, &open, &why), FROE_OK);
        assert_int_equal(truncate(NAME, 100), 0);
        trees_assert_equal(first, open);
        assert_int_equal(froe_tree_check(open, &why), FROE_OK);
        froe_tree_free(open);
        assert_int_equal(froe_tree_open_copy(NAME, NULL, &open, &why), FROE_E_FORMAT);
        assert_non_null(strstr(why.message, "truncated"));
        froe_tree_free(first);
    }
    froe_diagnostic why;
    froe_tree *open = NULL;
    assert_int_equal(truncate(NAME, 0), 0);
    assert_int_equal(froe_tree_open_copy(NAME, NULL, &open, &why), FROE_E_FORMAT);
    assert_int_equal(froe_tree_open_copy(".", NULL, &open, &why), FROE_E_IO);
    unlink(NAME);
    assert_int_equal(froe_tree_open_copy(NAME, NULL, &open, &why), FROE_E_IO);
    assert_int_equal(froe_tree_open_copy(NULL, NULL, &open, &why), FROE_E_ARG);
    assert_null(open);
}

/* ------------------------------------------------------------------ memory -- */

static froe_status copying(void *user, const froe_allocator *alloc) {
    (void)user;
    froe_tree *tree = NULL;
    const froe_status status = froe_tree_open_copy("model.froe", alloc, &tree, NULL);
    froe_tree_free(tree);
    return status;
}

static froe_status sending(void *user, const froe_allocator *alloc) {
    const receiver *r = user;
    froe_tree *tree = NULL;
    const froe_status status = froe_tree_open_memory(r->bytes, r->count, alloc, &tree, NULL);
    froe_tree_free(tree);
    return status;
}

static froe_status saving(void *user, const froe_allocator *alloc) {
    const froe_tree *model = user;
    froe_tree *tree = NULL;
    froe_status status = froe_tree_open("model.froe", alloc, &tree, NULL);
    if (!status) status = froe_tree_save(tree, NAME, NULL);
    if (!status) trees_assert_equal(model, tree);
    froe_tree_free(tree);
    return status;
}

static void any_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *tree = rich_tree(3);
    assert_saved(tree, "model.froe");
    assert_true(test_memory_each(saving, tree) >= 6);
    assert_true(test_memory_each(copying, NULL) >= 6);
    receiver r = {.most = SIZE_MAX};
    assert_int_equal(froe_tree_write(tree, receive, &r, NULL), FROE_OK);
    assert_true(test_memory_each(sending, &r) >= 6);
    free(r.bytes);
    froe_tree_free(tree);
    unlink(NAME);
    unlink("model.froe");
}

static int clean_up(void **state) {
    (void)state;
    static const char *const names[] = {NAME, "link.froe", "again.froe", "model.froe", "new.froe"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) unlink(names[i]);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_saved_is_opened),
        cmocka_unit_test(trees_go_through_memory),
        cmocka_unit_test(a_receiver_may_stop),
        cmocka_unit_test(checksums_are_as_specified),
        cmocka_unit_test(files_are_as_specified),
        cmocka_unit_test(files_of_other_versions_are_refused),
        cmocka_unit_test(a_tree_of_nothing_is_saved_too),
        cmocka_unit_test(trees_in_many_dimensions_are_saved),
        cmocka_unit_test(a_scene_from_a_file_never_grows),
        cmocka_unit_test(every_changed_byte_is_noticed),
        cmocka_unit_test(every_truncation_is_noticed),
        cmocka_unit_test(forged_files_are_refused_or_harmless),
        cmocka_unit_test(forged_indices_are_refused_or_harmless),
        cmocka_unit_test(reasons_are_given),
        cmocka_unit_test(a_failing_save_leaves_the_old_file_and_nothing_else),
        cmocka_unit_test(places_that_cannot_be_written_are_refused),
        cmocka_unit_test(saving_keeps_links_and_modes),
        cmocka_unit_test(a_file_replaced_while_open_does_not_change),
        cmocka_unit_test(a_file_shortened_while_open_does_not_change_its_copy),
        cmocka_unit_test(any_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, clean_up, clean_up);
}
