/* test_rare.c: what trees of ordinary sizes reach by chance at most: wrong words of headers, texts without ends,
 * reports that differ in one number, overfull leaves while memory ends or the caller cancels, and missing arguments. */
#include "audits.h"
#include "geom/meet/meet.h"
#include "geom/selftest.h"
#include "scene/convex.h"
#include "support/forge.h"
#include "support/tree_file.h"
#include "tree/audit/aspect.h"
#include "tree/audit/inseparable.h"
#include "tree/audit/share.h"
#include "tree/packed/packer.h"
#include "tree/packed/wide.h"
#include "tree/validate.h"
#include <froe/query.h>
#include <stdio.h>
#include <unistd.h>

static froe_status read_whole(const tree_file *f, froe_diagnostic *why) {
    froe_tree *tree = NULL;
    froe_status status = froe_tree_open_memory(f->bytes, f->size, NULL, &tree, why);
    if (!status) status = froe_tree_check(tree, why);
    froe_tree_free(tree);
    return status;
}

/* Every word of the header and of the table of sections. The axis that points up is free in space. */
static void wrong_words_of_headers_are_refused(void **state) {
    (void)state;
    froe_tree *trees[] = {trees_grow(2, FROE_SEGMENT, 20, 0, 0.4, "index", 6),
                          trees_grow(3, FROE_POLYGON, 20, 0, 0.4, "index", 6),
                          trees_grow(4, FROE_BOX, 6, 0, 0.4, "density", 1)};
    for (size_t t = 0; t < sizeof trees / sizeof *trees; t++) {
        const tree_file f = tree_file_of(trees[t]);
        const size_t words = (sizeof(file_header) + FILE_SECTIONS * sizeof(file_section)) / 4;
        tree_file g = {.bytes = malloc(f.size), .size = f.size};
        for (size_t w = 0; w < words; w++) {
            uint32_t old, up = offsetof(file_header, up) / 4;
            memcpy(&old, f.bytes + 4 * w, 4);
            const uint32_t values[] = {0, 1, 2, 3, 4, 6, 9, old - 1, old + 1, old + 64, old - 64, UINT32_MAX};
            for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
                froe_diagnostic why = {0};
                file_header *h = (file_header *)(void *)g.bytes;
                memcpy(g.bytes, f.bytes, f.size);
                memcpy(g.bytes + 4 * w, values + v, 4);
                forge_checksums(g.bytes, g.size);
                if (!memcmp(g.bytes, f.bytes, f.size) || (w == up && values[v] < 3 && h->dim == 3)) continue;
                assert_int_equal(read_whole(&g, &why), FROE_E_FORMAT);
                assert_true(why.message[0] != 0);
            }
        }
        free(g.bytes), free(f.bytes);
    }
}

static void assert_refused(const tree_file *f, const char *what) {
    froe_diagnostic why = {0};
    assert_int_equal(read_whole(f, &why), FROE_E_FORMAT);
    if (!strstr(why.message, what)) fail_msg("%s instead of %s", why.message, what);
}

static void files_of_other_lengths_are_refused(void **state) {
    (void)state;
    tree_file f = tree_file_of(trees_grow(2, FROE_SEGMENT, 20, 0, 0.4, "autopartition", 1));
    f.bytes = realloc(f.bytes, f.size + FILE_ALIGN);
    assert_non_null(f.bytes);
    file_header *h = (file_header *)(void *)f.bytes;
    const tree_file nothing = {f.bytes, 0}, little = {f.bytes, 63};
    froe_tree *tree;
    assert_refused(&nothing, "it is empty");
    assert_refused(&little, "it is too short");
    assert_int_equal(froe_tree_open_memory(f.bytes, SIZE_MAX - 3, NULL, &tree, NULL), FROE_E_MEMORY);
    memset(f.bytes + f.size, 0, FILE_ALIGN);
    f.size += FILE_ALIGN, h->size += FILE_ALIGN;
    forge_checksums(f.bytes, f.size);
    assert_refused(&f, "something follows its end");
    f.size = h->size = sizeof *h + 1;
    assert_refused(&f, "its section table is wrong");
    free(f.bytes);
}

static void empty_files_are_no_trees(void **state) {
    (void)state;
    froe_tree *tree;
    froe_diagnostic why;
    FILE *out = fopen("empty.froe", "wb");
    assert_non_null(out);
    fclose(out);
    assert_false(froe_is_tree("empty.froe"));
    assert_false(froe_is_tree(NULL));
    assert_int_equal(froe_tree_open("empty.froe", NULL, &tree, &why), FROE_E_FORMAT);
    assert_non_null(strstr(why.message, "it is empty"));
    unlink("empty.froe");
}

/* And promises are finite. */
static void texts_of_descriptions_are_printable_and_end(void **state) {
    (void)state;
    static const double numbers[] = {1, 2, NAN, 2, 1, NAN, 1, INFINITY, -INFINITY, 2, -INFINITY, INFINITY};
    const tree_file f = tree_file_of(trees_grow(2, FROE_SEGMENT, 20, 0, 0.4, "autopartition", 1));
    tree_meta *m = tree_file_at(&f, FILE_META), right = *m;
    m->promise_count = 1;
    for (int i = 0; i < 6; i++) {
        m->promises[0] = (tree_promise){.name = "far", .promised = numbers[2 * i + 1], .measured = numbers[2 * i]};
        forge_checksums(f.bytes, f.size);
        if (i)
            assert_refused(&f, "its description is wrong");
        else
            assert_int_equal(read_whole(&f, NULL), FROE_OK);
    }
    for (int wrong = 0; wrong < 4; wrong++) {
        *m = right;
        if (wrong == 0) memset(m->method, 'a', sizeof m->method);
        if (wrong == 1) m->method[1] = 0x7f;
        if (wrong == 2) m->method[1] = '\n';
        if (wrong == 3) m->method[sizeof m->method - 1] = 'a';
        forge_checksums(f.bytes, f.size);
        assert_refused(&f, "its description is wrong");
    }
    *m = right;
    forge_checksums(f.bytes, f.size);
    assert_int_equal(read_whole(&f, NULL), FROE_OK);
    free(f.bytes);
}

/* -------------------------------------------------------------------------- reports -- */

static void every_number_of_a_report_is_audited(void **state) {
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 20, 0, 0.4, "autopartition", 1);
    const froe_report right = tree->report;
    assert_right(tree);
    for (int wrong = 0; wrong < 15; wrong++) {
        froe_report *r = &tree->report;
        *r = right;
        if (wrong == 0) r->dim++;
        if (wrong == 1) r->leaf++;
        if (wrong == 2) r->seed++;
        if (wrong == 3) r->objects++;
        if (wrong == 4) r->nodes++;
        if (wrong == 5) r->leaves++;
        if (wrong == 6) r->fragments++;
        if (wrong == 7) r->in_cut++;
        if (wrong == 8) r->covers++;
        if (wrong == 9) r->size++;
        if (wrong == 10) r->height++;
        if (wrong == 11) r->mean_depth = nextafter(r->mean_depth, 0);
        if (wrong == 12) r->max_leaf++;
        if (wrong == 13) r->inseparable++;
        if (wrong == 14) r->crowded++;
        assert_wrong(tree, "report");
    }
    froe_tree_free(tree);
}

/* A guard stage whose cells are as fat as anything: cut by supports, or by planes that bound no difference. */
static void only_differences_bound_the_cells_of_guards(void **state) {
    (void)state;
    double aspect;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 6, 0, 0.4, "autopartition", 1);
    assert_int_equal(tree_aspect(tree, &aspect), FROE_OK);
    assert_true(aspect == 1);
    tree->nodes[0].flags |= TREE_GUARD;
    assert_int_equal(tree_aspect(tree, &aspect), FROE_OK);
    assert_true(isinf(aspect));
    froe_tree_free(tree);
    tree = trees_grow(2, FROE_BOX, 20, 0, 0.1, "density", 1);
    tree->nodes[0].flags |= TREE_GUARD;
    assert_int_equal(tree_aspect(tree, &aspect), FROE_OK);
    assert_true(aspect >= 1 && !isinf(aspect));
    tree->meta.root_hi[0] = tree->meta.root_lo[0], tree->meta.root_hi[1] = tree->meta.root_lo[1];
    assert_int_equal(tree_aspect(tree, &aspect), FROE_OK);
    assert_true(isinf(aspect));
    froe_tree_free(tree);
}

/* ------------------------------------------------------------------- overfull leaves -- */

/* Four hulls in space: the boxes of all meet, and planes that are not axis-parallel separate the first two. */
static froe_tree *hulls(void) {
    static const double coords[4][4][3] = {{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}},
                                           {{4, 4, 4}, {1, 4, 4}, {4, 1, 4}, {4, 4, 1}},
                                           {{2, 2, 2}, {0, 0, 1}, {3, 0, 2}, {1, 3, 2}},
                                           {{0, 0, 0}, {3, 3, 3}, {3, 0, 3}, {0, 3, 3}}};
    static const size_t starts[] = {0, 4, 8, 12, 16};
    froe_scene *scene;
    assert_int_equal(froe_scene_new(3, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_HULL, 4, coords[0][0], NULL, starts), FROE_OK);
    froe_tree *tree = trees_build(scene, "density", 9);
    froe_scene_free(scene);
    return tree;
}

typedef struct refuting {
    froe_tree *tree;
    bool crowded;
} refuting;

static const char *refuted_by(const refuting *r, const froe_allocator *alloc, base_task *task, froe_status *status) {
    const char *why = NULL;
    num_context context;
    froe_tree tree = *r->tree;
    const tree_objects list = tree_own_list(&tree, 0);
    assert_int_equal(list.count, 4);
    if (alloc) tree.alloc = *alloc;
    assert_int_equal(geom_context_new(NULL, &context), FROE_OK);
    *status = (r->crowded ? crowded_refuted : inseparable_refuted)(&context, task, &tree, &list, &why);
    num_context_free(&context);
    return why;
}

static froe_status refute(void *user, const froe_allocator *alloc) {
    const refuting *r = user;
    base_task task;
    froe_status status;
    base_task_init(&task, 1, NULL, NULL);
    const char *why = refuted_by(r, alloc, &task, &status);
    if (!status && !r->crowded) assert_string_equal(why, "a plane separates two of its objects");
    return status;
}

static void leaves_of_hulls_are_judged_or_memory_ends(void **state) {
    (void)state;
    refuting r = {.tree = hulls()};
    for (int crowded = 0; crowded < 2; crowded++) {
        froe_status status;
        base_task task;
        r.crowded = crowded;
        assert_true(test_memory_each(refute, &r) > 2);
        base_task_init(&task, 1, NULL, NULL);
        atomic_store(&task.cancelled, true);
        assert_null(refuted_by(&r, NULL, &task, &status)); /* a call that is cancelled finds nothing */
        assert_int_equal(status, FROE_OK);
    }
    froe_tree_free(r.tree);
}

static bool stop_at(void *user, double done) {
    (void)done;
    return --*(int *)user != 0;
}

static void audits_can_be_cancelled_at_every_call(void **state) {
    (void)state;
    froe_tree *trees[] = {hulls(), trees_grow(3, FROE_POLYGON, 40, 0, 0.4, "index", 6),
                          trees_grow(2, FROE_SEGMENT, 40, 0, 0.4, "autopartition", 1)};
    for (size_t t = 0; t < sizeof trees / sizeof *trees; t++) {
        froe_status status = FROE_E_CANCELLED;
        for (int stop = 1; status; stop++) {
            int left = stop;
            froe_audit_options o = froe_audit_defaults();
            o.threads = 1, o.progress = stop_at, o.user = &left;
            status = froe_tree_audit(trees[t], &o, NULL);
            assert_int_equal(status, left > 0 ? FROE_OK : FROE_E_CANCELLED);
            assert_true(stop > 3 || status);
        }
        froe_tree_free(trees[t]);
    }
}

/* Above dimension 3 the audit solves linear programs for hulls, and asks for distances where something is round. */
static void round_solids_share_points_where_distances_say_so(void **state) {
    (void)state;
    num_context context;
    froe_scene *s;
    const double simplex[] = {0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const double centres[] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};
    assert_int_equal(froe_scene_new(4, NULL, &s), FROE_OK);
    assert_int_equal(geom_context_new(NULL, &context), FROE_OK);
    assert_int_equal(trees_add(s, FROE_HULL, 1, simplex, NULL, (const size_t[]){0, 5}), FROE_OK);
    assert_int_equal(trees_add(s, FROE_BALL, 2, centres, (const double[]){0.49, 0.51}, NULL), FROE_OK);
    const geom_convex hull = scene_convex(s, 0), near = scene_convex(s, 1), reach = scene_convex(s, 2);
    assert_false(share_point(&context, &hull, &near)); /* the plane x + y + z + w = 1 is 0.5 away */
    assert_true(share_point(&context, &hull, &reach));
    assert_false(share_point(&context, &near, &hull));
    assert_true(share_point(&context, &reach, &hull));
    num_context_free(&context);
    froe_scene_free(s);
}

/* ------------------------------------------------------------------------ arguments -- */

static bool take_cell(void *user, const froe_cell *cell) {
    (void)user, (void)cell;
    return true;
}

static void missing_arguments_are_refused(void **state) {
    (void)state;
    froe_tree *made, *tree = trees_grow(2, FROE_SEGMENT, 6, 0, 0.4, "autopartition", 1);
    const double lo[2] = {0, 0}, hi[2] = {1, 1}, far[2] = {1, INFINITY}, low[2] = {-INFINITY, 0};
    tree_file f = {0};
    assert_int_equal(froe_tree_cells(NULL, lo, hi, take_cell, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_cells(tree, NULL, hi, take_cell, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_cells(tree, lo, NULL, take_cell, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_cells(tree, lo, hi, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_cells(tree, lo, far, take_cell, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_cells(tree, low, hi, take_cell, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_check(NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_open("x", NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_open(NULL, NULL, &made, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_open_memory(lo, 16, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_open_memory(NULL, 16, NULL, &made, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_write(NULL, tree_file_receive, &f, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_write(tree, NULL, &f, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_save(NULL, "x", NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_save(tree, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_open_copy("x", NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_tree_open_copy(NULL, NULL, &made, NULL), FROE_E_ARG);
    assert_true(froe_tree_piece(tree, froe_tree_piece_count(tree)).object == FROE_NONE);
    froe_tree_free(tree);
}

/* Trees are told by how they begin; folders, and files that are shorter than that, are none. */
static void files_that_begin_like_trees_are_trees(void **state) {
    static const char *const starts[] = {"", "f", "PNG data", NULL};
    (void)state;
    froe_tree *tree = trees_grow(2, FROE_SEGMENT, 6, 0, 0.4, "autopartition", 1);
    assert_int_equal(froe_tree_save(tree, "is.froe", NULL), FROE_OK);
    assert_true(froe_is_tree("is.froe"));
    assert_false(froe_is_tree(NULL) || froe_is_tree(".") || froe_is_tree("there-is-none"));
    for (int i = 0; starts[i]; i++) {
        FILE *out = fopen("short", "w");
        assert_true(out && fputs(starts[i], out) >= 0 && fclose(out) == 0);
        assert_false(froe_is_tree("short"));
    }
    froe_tree_free(tree);
}

/* --------------------------------------------------------------------------- cuts -- */

/* The first cut of a kind; the tree's tables are those of its maker, so that they may be changed. */
static tree_cut *cut_of_kind(const froe_tree *tree, uint32_t kind) {
    for (uint32_t i = 0; i < tree->cut_count; i++)
        if (tree->cuts[i].kind == kind) return (tree_cut *)(uintptr_t)(tree->cuts + i);
    fail_msg("no cut of kind %u", kind);
    return NULL;
}

static void cuts_of_the_plane_and_of_space_are_in_no_other_dimension(void **state) {
    static const uint32_t kinds[] = {FROE_CUT_OBJECT, FROE_CUT_VERTICES, FROE_CUT_EDGE, FROE_CUT_VERTEX,
                                     FROE_CUT_CROSSING};
    (void)state;
    froe_tree *tree = trees_grow(4, FROE_BALL, 60, 0, 0.6, "density", 1);
    tree_cut *cut = cut_of_kind(tree, FROE_CUT_PLANE);
    const tree_cut right = *cut;
    assert_int_equal(tree_validate(tree, NULL), FROE_OK);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        *cut = (tree_cut){.kind = kinds[i], .a = 0};
        cut->u.id.b = kinds[i] == FROE_CUT_VERTICES;
        froe_diagnostic why = {0};
        assert_int_equal(tree_validate(tree, &why), FROE_E_FORMAT);
        assert_true(why.message[0] != 0);
    }
    *cut = right;
    froe_tree_free(tree);
}

/* Only segments cross, those that there are, the second from the right of the first to its left. */
static void crossings_name_segments(void **state) {
    static const double segments[6 * 4] = {0, 0, 4, 4, 0, 4, 4, 0, 5, 0, 5, 4}, points[] = {9, 1, 9, 2};
    (void)state;
    froe_scene *scene;
    assert_int_equal(froe_scene_new(2, NULL, &scene), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_SEGMENT, 3, segments, NULL, NULL), FROE_OK);
    assert_int_equal(trees_add(scene, FROE_POINT, 2, points, NULL, NULL), FROE_OK);
    froe_tree *tree = trees_build(scene, "autopartition", 1);
    tree_cut *cut = cut_of_kind(tree, FROE_CUT_OBJECT);
    const tree_cut right = *cut;
    for (uint32_t a = 0; a < 6; a++)
        for (uint32_t b = 0; b < 6; b++)
            for (uint32_t c = 0; c < 2; c++) {
                const double *s = segments + 4 * a, *t = segments + 4 * b;
                const bool fits = a < 3 && b < 3 && !c && (s[2] - s[0]) * (t[3] - t[1]) > (s[3] - s[1]) * (t[2] - t[0]);
                froe_diagnostic why = {0};
                *cut = (tree_cut){.kind = FROE_CUT_CROSSING, .a = a};
                cut->u.id.b = b, cut->u.id.c = c;
                assert_int_equal(tree_validate(tree, &why), FROE_E_FORMAT); /* lists of walls are empty: they say so */
                assert_int_equal(!strstr(why.message, "a cut that does not exist"), fits);
            }
    *cut = right;
    assert_int_equal(tree_validate(tree, NULL), FROE_OK);
    froe_tree_free(tree);
    froe_scene_free(scene);
}

static bool ignore(void *user, const void *data, size_t count) {
    (void)user, (void)data, (void)count;
    return true;
}

static froe_status write_with(void *user, const froe_allocator *alloc) {
    froe_tree tree = *(const froe_tree *)user;
    tree.alloc = *alloc;
    return froe_tree_write(&tree, ignore, NULL, NULL);
}

static void writing_may_lack_memory(void **state) {
    (void)state;
    froe_tree *trees[] = {trees_grow(2, FROE_SEGMENT, 60, 0, 0.1, "index", 6),
                          trees_grow(2, FROE_SEGMENT, 6, 0, 0.4, "autopartition", 1)};
    for (size_t t = 0; t < 2; t++) {
        assert_true(test_memory_each(write_with, trees[t]) >= 2);
        froe_tree_free(trees[t]);
    }
}

/* Owners are checked some at a time; a tree of nothing has no wide nodes. */
static void opened_trees_of_many_objects_and_of_none_answer(void **state) {
    (void)state;
    for (size_t count = 0; count <= 6000; count += 6000)
        for (int dim = 2; dim <= 3; dim++) {
            const tree_file f =
                tree_file_of(trees_grow(dim, dim == 2 ? FROE_SEGMENT : FROE_POLYGON, count, 0, 0.01, "index", 8));
            froe_tree *tree;
            froe_query *q;
            froe_list found;
            froe_range r = froe_range_defaults();
            const double all[] = {-1, -1, -1, 2, 2, 2}, box[] = {-1, -1, 2, 2};
            assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
            assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
            r.points = dim == 2 ? box : all;
            assert_int_equal(froe_query_range(q, &r, &found, NULL), FROE_OK);
            assert_int_equal(found.count, count);
            froe_query_free(q);
            froe_tree_free(tree);
            free(f.bytes);
        }
}

static void packers_take_large_leaves_and_may_lack_memory(void **state) {
    (void)state;
    test_memory m;
    tree_packer p;
    const froe_allocator alloc = test_memory_begin(&m);
    m.fail_at = 1;
    assert_int_equal(packer_new(&alloc, 0, UINT32_MAX, 0, &p), FROE_E_MEMORY);
    test_memory_end(&m);
}

/* A file that ends where a section does, before the zeros that align the next one. */
static void sections_that_begin_behind_the_end_are_refused(void **state) {
    (void)state;
    tree_file f = tree_file_of(trees_grow(2, FROE_SEGMENT, 21, 0, 0.4, "autopartition", 1));
    file_header *h = (file_header *)(void *)f.bytes;
    const size_t whole = f.size;
    int ends = 0;
    for (uint32_t i = 0; i + 1 < FILE_SECTIONS; i++) {
        file_section s;
        memcpy(&s, f.bytes + sizeof *h + i * sizeof s, sizeof s);
        const uint64_t end = s.offset + s.size;
        if (end % FILE_ALIGN == 0 || end >= whole) continue;
        f.size = h->size = (size_t)end;
        forge_checksums(f.bytes, f.size);
        assert_refused(&f, "a section is out of place");
        ends++;
    }
    assert_true(ends > 1);
    free(f.bytes);
}

/* What is asked before all of a file is checked: pieces and blocks that name what is not there. */
static void parts_that_name_what_is_not_there_are_refused_when_asked(void **state) {
    (void)state;
    for (int wrong = 0; wrong < 4; wrong++) {
        const tree_file f =
            tree_file_of(trees_grow(2, FROE_SEGMENT, 300, 0, 0.05, wrong ? "index" : "autopartition", 6));
        const file_section s = tree_file_section(&f, FILE_BLOCKS);
        packed_header *first = tree_file_at(&f, FILE_BLOCKS);
        packed_header *last = (packed_header *)(void *)(f.bytes + s.offset + s.size - PACKED_BLOCK);
        if (wrong == 0) ((tree_piece *)tree_file_at(&f, FILE_PIECES))->object = 300;
        if (wrong == 1) first->owner = UINT32_MAX;
        if (wrong == 2) last->owner += 1;
        if (wrong == 3) *(uint32_t *)tree_file_at(&f, FILE_OWNERS) = 300;
        forge_checksums(f.bytes, f.size);
        const double all[4] = {-9, -9, 9, 9};
        froe_tree *tree;
        froe_query *q;
        froe_list found;
        froe_diagnostic why = {0};
        froe_range r = froe_range_defaults();
        r.points = all;
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        if (wrong) {
            assert_int_equal(froe_query_new(tree, &q, NULL), FROE_OK);
            assert_int_equal(froe_query_range(q, &r, &found, &why), FROE_E_FORMAT);
            assert_non_null(strstr(why.message, "owners that do not exist"));
            froe_query_free(q);
        }
        assert_int_equal(froe_tree_piece(tree, 0).object, FROE_NONE);
        assert_int_equal(froe_tree_check(tree, NULL), FROE_E_FORMAT);
        froe_tree_free(tree);
        free(f.bytes);
    }
}

/* Boxes of trees in space follow from their nodes: no other number of children, unit, corner or level will do. */
static void wide_nodes_that_do_not_fit_are_refused(void **state) {
    (void)state;
    const tree_file f = tree_file_of(trees_grow(3, FROE_POLYGON, 400, 0, 0.1, "index", 2));
    wide_node *nodes = tree_file_at(&f, FILE_WIDE);
    const wide_node right = *nodes;
    for (int wrong = 0; wrong < 8; wrong++) {
        *nodes = right;
        if (wrong == 0) nodes->count = 0;
        if (wrong == 1) nodes->count = WIDE_CHILDREN + 1;
        if (wrong == 2) nodes->unused++;
        if (wrong == 3) nodes->lo[2] = 2.5;
        if (wrong == 4) nodes->shift[1] = 3;
        if (wrong == 5) nodes->child[0]++;
        if (wrong == 6) nodes->child[0] = WIDE_LEAF | 0x7ffffff;
        if (wrong == 7) nodes->box[1][0][0] ^= 1;
        forge_checksums(f.bytes, f.size);
        froe_diagnostic why = {0};
        assert_int_equal(read_whole(&f, &why), FROE_E_FORMAT);
        assert_true(why.message[0] != 0);
        if (wrong == 7) continue; /* a search does not rely on that */
        froe_tree *tree;
        froe_query *q;
        uint64_t count;
        const double all[6] = {-1, -1, -1, 2, 2, 2};
        froe_range r = froe_range_defaults();
        r.points = all;
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        froe_status status = froe_query_new(tree, &q, &why);
        if (!status) status = froe_query_count(q, &r, &count, &why), froe_query_free(q);
        assert_int_equal(status, FROE_E_FORMAT);
        froe_tree_free(tree);
    }
    *nodes = right;
    forge_checksums(f.bytes, f.size);
    assert_int_equal(read_whole(&f, NULL), FROE_OK);
    free(f.bytes);
}

/* The cut of a tree of two leaves is moved out of its root box, and the blocks say so: then the tree may not be told
 * from one that froe has made, but it is audited as wrong. */
static void cuts_beside_the_root_box_are_found(void **state) {
    static const double places[] = {-1e9, 1e9};
    (void)state;
    for (int i = 0; i < 2; i++) {
        const tree_file f = tree_file_of(trees_grow(2, FROE_SEGMENT, 12, 0, 0.01, "index", 9));
        tree_node *nodes = tree_file_at(&f, FILE_NODES);
        packed_header *blocks = tree_file_at(&f, FILE_BLOCKS);
        assert_int_equal(nodes[0].type, TREE_PLAIN);
        assert_true(nodes[1].type == TREE_LEAF && nodes[2].type == TREE_LEAF);
        packed_header *of[2] = {blocks + 2 * nodes[1].child, blocks + 2 * nodes[2].child};
        of[1]->lo[nodes[0].axis] = nodes[0].u.value = places[i];
        for (int side = 0; side < 2; side++) of[side]->scale = 0, of[side]->error = PACKED_COARSE;
        forge_checksums(f.bytes, f.size);
        froe_tree *tree;
        assert_int_equal(froe_tree_open_memory(f.bytes, f.size, NULL, &tree, NULL), FROE_OK);
        const froe_status status = froe_tree_check(tree, NULL);
        assert_true(status == FROE_E_FORMAT || (status == FROE_OK && froe_tree_audit(tree, NULL, NULL)));
        froe_tree_free(tree);
        free(f.bytes);
    }
}

typedef struct growing {
    int dim;
    froe_kind kind;
    size_t count;
    const char *method;
} growing;

static froe_status grow_with(void *user, const froe_allocator *alloc) {
    const growing *g = user;
    froe_scene *scene = NULL;
    froe_tree *tree = NULL;
    froe_status status = froe_scene_new(g->dim, alloc, &scene);
    if (!status) status = trees_scatter(scene, g->kind, g->count, 0, 0.3, 1);
    froe_build_options o = froe_build_defaults();
    o.method = g->method, o.leaf = 1, o.threads = 1;
    if (!status) status = froe_build(scene, &o, &tree, NULL);
    froe_tree_free(tree), froe_scene_free(scene);
    return status;
}

static void growing_trees_may_lack_memory(void **state) {
    static const growing all[] = {{2, FROE_SEGMENT, 90, "autopartition"}, {3, FROE_POLYGON, 120, "index"}};
    (void)state;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        assert_true(test_memory_each(grow_with, (void *)(uintptr_t)(all + i)) > 30);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_words_of_headers_are_refused),
        cmocka_unit_test(files_of_other_lengths_are_refused),
        cmocka_unit_test(empty_files_are_no_trees),
        cmocka_unit_test(texts_of_descriptions_are_printable_and_end),
        cmocka_unit_test(every_number_of_a_report_is_audited),
        cmocka_unit_test(only_differences_bound_the_cells_of_guards),
        cmocka_unit_test(leaves_of_hulls_are_judged_or_memory_ends),
        cmocka_unit_test(audits_can_be_cancelled_at_every_call),
        cmocka_unit_test(round_solids_share_points_where_distances_say_so),
        cmocka_unit_test(missing_arguments_are_refused),
        cmocka_unit_test(files_that_begin_like_trees_are_trees),
        cmocka_unit_test(cuts_of_the_plane_and_of_space_are_in_no_other_dimension),
        cmocka_unit_test(crossings_name_segments),
        cmocka_unit_test(writing_may_lack_memory),
        cmocka_unit_test(opened_trees_of_many_objects_and_of_none_answer),
        cmocka_unit_test(packers_take_large_leaves_and_may_lack_memory),
        cmocka_unit_test(sections_that_begin_behind_the_end_are_refused),
        cmocka_unit_test(parts_that_name_what_is_not_there_are_refused_when_asked),
        cmocka_unit_test(wide_nodes_that_do_not_fit_are_refused),
        cmocka_unit_test(cuts_beside_the_root_box_are_found),
        cmocka_unit_test(growing_trees_may_lack_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
