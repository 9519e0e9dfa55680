/* test_forgeries.c: tree files with right checksums whose numbers are special ones, or whose sections are shorter or
 * longer than they were. Such a file is refused, or fails the audit, or is another right tree: then all answers are
 * those of brute force on the scene that it holds. (Single bits: test_mutations.c.) */
#include "query/answers.h"
#include "support/forge.h"
#include "support/opened.h"
#include "support/samples.h"
#include "support/tree_file.h"

enum { KINDS = 10, ROUNDS = 2, WORDS_MOST = 48 };

/* Segments with all that a scene may carry besides. */
static froe_tree *labelled(const char *method, uint32_t leaf) {
    froe_scene *scene;
    const froe_group group = {.name = "a", .material = "b", .left = "c", .right = "d"};
    const froe_crs crs = {.kind = FROE_CRS_PROJECTED, .name = "grid"};
    static const double coords[] = {0, 0, 3, 1, 1, 2, 2, -1, 3, 3, 0, 2, 1, 1, 2, 2, -1, 0, 1, 0};
    const uint64_t tags[] = {7, 8, 9, 10, 11};
    const uint32_t faces[] = {0, 0, 1, 1, 2};
    froe_objects o = froe_objects_defaults();
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(froe_scene_add_group(scene, &group, &o.group), FROE_OK);
    assert_int_equal(froe_scene_set_crs(scene, &crs), FROE_OK);
    o.kind = FROE_SEGMENT, o.count = 5, o.coords = coords, o.tags = tags, o.faces = faces;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_BALL, 1, (const double[]){1, 1}, (const double[]){0.5}, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, method, leaf);
    froe_scene_free(scene);
    return tree;
}

/* Points on a line: the tree is packed and has no jump table, which depends on the root box. */
static froe_tree *collinear(void) {
    double points[40];
    froe_scene *scene;
    for (int i = 0; i < 20; i++) points[2 * i] = i * i, points[2 * i + 1] = 3;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POINT, 20, points, NULL, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, "index", 4);
    froe_scene_free(scene);
    return tree;
}

static froe_tree *tree_of(int kind) {
    switch (kind) {
    case 0:
        return trees_grow(2, FROE_SEGMENT, 40, 0, 0.4, "index", 6);
    case 1:
        return trees_grow(2, FROE_SEGMENT, 8, 8, 0.4, "autopartition", 0);
    case 2:
        return trees_grow(3, FROE_POLYGON, 60, 0, 0.4, "index", 6);
    case 3:
        return trees_grow(3, FROE_POLYGON, 8, 0, 0.6, "grain", 1);
    case 4:
        return trees_grow(2, FROE_SEGMENT, 8, 0, 0.5, "cylindrical", 0);
    case 5:
        return trees_grow(4, FROE_BOX, 8, 0, 0.4, "density", 1);
    case 6:
        return trees_grow(2, FROE_SEGMENT, 60, 30, 0.2, "index", 4);
    case 7:
        return trees_grow(3, FROE_HULL, 8, 0, 0.3, "density", 1);
    case 8:
        return collinear();
    default:
        return labelled("density", 1);
    }
}

/* ----------------------------------------------------------------------- judgement -- */

typedef struct tally {
    size_t refused, failed, right;
} tally;

static void judge(const tree_file *f, const char *what, tally *t) {
    froe_tree *tree = NULL;
    froe_diagnostic why = {0};
    char text[300];
    test_memory memory;
    const froe_allocator alloc = test_memory_begin(&memory);
    froe_audit_options o = froe_audit_defaults();
    o.threads = 1;
    froe_status status = froe_tree_open_memory(f->bytes, f->size, &alloc, &tree, &why);
    if (!status) {
        opened_ask(tree, 1, ROUNDS); /* of which nothing has been checked yet */
        status = froe_tree_check(tree, &why);
    }
    if (status) {
        if (status != FROE_E_FORMAT || !why.message[0]) fail_msg("%s: status %d", what, status);
        t->refused++;
    } else if ((status = froe_tree_audit(tree, &o, &why)) != FROE_OK) {
        if (status != FROE_E_AUDIT || !why.message[0]) fail_msg("%s: audit says %d", what, status);
        t->failed++;
    } else {
        if (!answers_right(tree, 3, ROUNDS, text, sizeof text)) fail_msg("%s: %s", what, text);
        t->right++;
    }
    froe_tree_free(tree);
    test_memory_end(&memory);
}

/* ------------------------------------------------------------------ special numbers -- */

/* A number of 8 bytes, or two of 4, in place of what is there. */
static bool special_bytes(int which, uint8_t *at) {
    static const double doubles[] = {NAN, INFINITY, -INFINITY, 0, -1, 1e300, 0x1p-1074};
    static const float floats[] = {NAN, INFINITY, -INFINITY, 0, -1, 1e30f};
    enum { DOUBLES = sizeof doubles / sizeof *doubles, FLOATS = sizeof floats / sizeof *floats };
    double x;
    float y;
    memcpy(&x, at, sizeof x);
    memcpy(&y, at, sizeof y);
    if (which < DOUBLES) {
        memcpy(at, doubles + which, sizeof x);
    } else if (which < DOUBLES + 3) {
        x = which == DOUBLES ? -x : nextafter(x, which == DOUBLES + 1 ? INFINITY : -INFINITY);
        memcpy(at, &x, sizeof x);
    } else if (which < DOUBLES + 3 + 2 * FLOATS) {
        const int i = which - DOUBLES - 3;
        memcpy(at + i % 2 * 4, floats + i / 2, sizeof y);
    } else if (which == DOUBLES + 3 + 2 * FLOATS) {
        y = nextafterf(y, INFINITY);
        memcpy(at, &y, sizeof y);
    } else {
        return false;
    }
    return true;
}

static void special_numbers_are_refused_or_found(void **state) {
    static const file_id ids[] = {FILE_META,   FILE_FACTS,   FILE_NODES, FILE_CUTS,   FILE_PIECES, FILE_BOUNDS,
                                  FILE_COORDS, FILE_NORMALS, FILE_RADII, FILE_BLOCKS, FILE_WIDE};
    tally t = {0};
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        const tree_file f = tree_file_of(tree_of(kind));
        tree_file g = f;
        g.bytes = malloc(f.size);
        assert_non_null(g.bytes);
        for (size_t i = 0; i < sizeof ids / sizeof *ids; i++) {
            const file_section s = tree_file_section(&f, ids[i]);
            const uint64_t words = s.size / 8, step = words / WORDS_MOST + 1;
            for (uint64_t w = 0; w < words; w += step) /* of a long section other words for other numbers */
                for (int which = 0;; which++) {
                    char what[100];
                    const uint64_t word = (w + (uint64_t)which % step) % words;
                    if (words > WORDS_MOST / 2 && (w / step + (uint64_t)which) % 11) {
                        uint8_t none[8] = {0};
                        if (!special_bytes(which, none)) break;
                        continue;
                    }
                    memcpy(g.bytes, f.bytes, f.size);
                    if (!special_bytes(which, g.bytes + s.offset + 8 * word)) break;
                    if (!memcmp(g.bytes + s.offset, f.bytes + s.offset, s.size)) continue;
                    forge_checksums(g.bytes, g.size);
                    snprintf(what, sizeof what, "tree %d, section %u, word %u, number %d", kind, (unsigned)ids[i],
                             (unsigned)word, which);
                    judge(&g, what, &t);
                }
        }
        free(g.bytes);
        free(f.bytes);
    }
    print_message("%zu refused, %zu fail the audit, %zu right\n", t.refused, t.failed, t.right);
    assert_true(t.refused > 1000 && t.failed > 100 && t.right > 100);
}

/* ------------------------------------------------------------------------ sections -- */

/* The file with so many bytes in one section: the first of them, then zeros. */
static tree_file resized(const tree_file *f, uint32_t id, uint64_t size) {
    const file_section old = tree_file_section(f, id);
    tree_file g = {.size = f->size + (size_t)size + 2 * FILE_ALIGN};
    g.bytes = calloc(g.size, 1);
    assert_non_null(g.bytes);
    memcpy(g.bytes, f->bytes, sizeof(file_header) + FILE_SECTIONS * sizeof(file_section));
    uint64_t end = sizeof(file_header) + FILE_SECTIONS * sizeof(file_section);
    for (uint32_t i = 1; i <= FILE_SECTIONS; i++) {
        file_section s = tree_file_section(f, i);
        const uint64_t kept = i == id && size < old.size ? size : s.size, from = s.offset;
        s.offset = file_align(end);
        if (i == id) s.size = size;
        memcpy(g.bytes + s.offset, f->bytes + from, kept);
        memcpy(g.bytes + sizeof(file_header) + (i - 1) * sizeof s, &s, sizeof s);
        end = s.offset + s.size;
    }
    g.size = file_align(end);
    file_header h;
    memcpy(&h, g.bytes, sizeof h);
    h.size = g.size;
    memcpy(g.bytes, &h, sizeof h);
    forge_checksums(g.bytes, g.size);
    return g;
}

/* Labels may be missing; of everything else there is as much as the rest says. */
static void shorter_and_longer_sections_are_refused_or_optional(void **state) {
    tally t = {0};
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        const tree_file f = tree_file_of(tree_of(kind));
        for (uint32_t id = 1; id <= FILE_SECTIONS; id++) {
            const file_section s = tree_file_section(&f, id);
            const uint64_t sizes[] = {0,          s.size - s.item_size,     s.size - 1, s.size + s.item_size,
                                      s.size / 2, s.size + 2 * s.item_size, s.item_size};
            for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
                char what[100];
                if (sizes[i] == s.size || sizes[i] > s.size + 2 * s.item_size) continue;
                const tree_file g = resized(&f, id, sizes[i]);
                snprintf(what, sizeof what, "tree %d, section %u, %u bytes instead of %u", kind, (unsigned)id,
                         (unsigned)sizes[i], (unsigned)s.size);
                judge(&g, what, &t);
                free(g.bytes);
            }
        }
        const tree_file same = resized(&f, FILE_META, tree_file_section(&f, FILE_META).size);
        assert_int_equal(same.size, f.size);
        assert_memory_equal(same.bytes, f.bytes, f.size);
        free(same.bytes);
        free(f.bytes);
    }
    print_message("%zu refused, %zu fail the audit, %zu right\n", t.refused, t.failed, t.right);
    assert_true(t.refused > 500 && t.right >= 3);
}

/* The sections of one tree, and one of another. */
static void sections_of_other_trees_do_not_fit(void **state) {
    tally t = {0};
    (void)state;
    for (int kind = 0; kind < KINDS; kind++)
        for (int other = 0; other < KINDS; other++) {
            if (other == kind) continue;
            const tree_file f = tree_file_of(tree_of(kind)), o = tree_file_of(tree_of(other));
            for (uint32_t id = 1; id <= FILE_SECTIONS; id++) {
                char what[100];
                const file_section s = tree_file_section(&o, id), old = tree_file_section(&f, id);
                if (s.size == old.size && !memcmp(f.bytes + old.offset, o.bytes + s.offset, s.size)) continue;
                tree_file g = resized(&f, id, s.size);
                const file_section at = tree_file_section(&g, id);
                memcpy(g.bytes + at.offset, o.bytes + s.offset, s.size);
                forge_checksums(g.bytes, g.size);
                snprintf(what, sizeof what, "tree %d, section %u of tree %d", kind, (unsigned)id, other);
                judge(&g, what, &t);
                free(g.bytes);
            }
            free(f.bytes), free(o.bytes);
        }
    print_message("%zu refused, %zu fail the audit, %zu right\n", t.refused, t.failed, t.right);
    assert_true(t.refused > 500);
}

/* --------------------------------------------------------------------------- memory -- */

static froe_status read_whole(void *user, const froe_allocator *alloc) {
    const tree_file *f = user;
    froe_tree *tree = NULL;
    froe_audit_options o = froe_audit_defaults();
    o.threads = 1;
    froe_status status = froe_tree_open_memory(f->bytes, f->size, alloc, &tree, NULL);
    if (!status) status = froe_tree_check(tree, NULL);
    if (!status) status = froe_tree_audit(tree, &o, NULL);
    froe_tree_free(tree);
    return status;
}

static void any_allocation_of_reading_and_auditing_may_fail(void **state) {
    (void)state;
    for (int kind = 0; kind < KINDS; kind++) {
        tree_file f = tree_file_of(tree_of(kind));
        assert_true(test_memory_each(read_whole, &f) > 5);
        free(f.bytes);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(special_numbers_are_refused_or_found),
        cmocka_unit_test(shorter_and_longer_sections_are_refused_or_optional),
        cmocka_unit_test(sections_of_other_trees_do_not_fit),
        cmocka_unit_test(any_allocation_of_reading_and_auditing_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
