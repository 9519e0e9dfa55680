/* test_refusals.c: options out of range, files that cannot be written, memory that runs out, calls
 * that are cancelled: a status, a sentence, nothing half-written. */
#include "pictures.h"
#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static froe_status draw(const froe_tree *tree, const char *path, const froe_draw_options *o, const char *says) {
    froe_diagnostic diag;
    memset(&diag, 0, sizeof diag);
    froe_status status = froe_draw(tree, path, o, &diag);
    if (status != FROE_OK) {
        assert_int_equal(diag.status, status);
        if (says && !strstr(diag.message, says)) fail_msg("\"%s\" does not say \"%s\"", diag.message, says);
    }
    return status;
}

static int files_here(void) {
    int count = 0;
    DIR *here = opendir(".");
    assert_non_null(here);
    while (readdir(here)) count++;
    closedir(here);
    return count;
}

static void options_out_of_range_are_refused_by_name(void **state) {
    (void)state;
    froe_tree *flat = tree_of(mixed_scene(2), "density", 1), *solid = tree_of(mixed_scene(3), "density", 1);
    int before = files_here();
    const froe_draw_options good = froe_draw_defaults();
    froe_draw_options o;
#define REFUSED(tree, member, value, says)                                                                             \
    (o = good, o.member = (value), assert_int_equal(draw(tree, "no.svg", &o, says), FROE_E_OPTIONS))
    REFUSED(flat, size, 0, "froe_draw_defaults");
    REFUSED(flat, style, FROE_DRAW_SECTIONS, "sections");
    REFUSED(flat, style, FROE_DRAW_EXPLODED, "exploded");
    REFUSED(solid, style, FROE_DRAW_FLAT, "flat");
    REFUSED(flat, style, FROE_DRAW_STYLE_COUNT, "style");
    REFUSED(flat, style, (froe_draw_style)-1, "style");
    REFUSED(flat, show, 16, "show");
    REFUSED(flat, background, 0xFF0000FF, "0xFF0000FF is not like 0xRRGGBB");
    REFUSED(flat, width, 0, "width");
    REFUSED(flat, width, 0.0 / 0.0, "width");
    REFUSED(flat, width, 1e300, "width");
    REFUSED(flat, height, -1, "height");
    REFUSED(flat, height, 40000, "height");
    REFUSED(flat, margin, 1000, "up to 480");
    REFUSED(flat, scale, 0, "scale");
    REFUSED(flat, detail, 0.0 / 0.0, "detail");
    REFUSED(solid, axis, 3, "axis");
    REFUSED(solid, up, -2, "up");
    REFUSED(solid, at, 1.0 / 0.0, "at");
    REFUSED(solid, explode, -0.5, "explode");
    REFUSED(solid, explode_depth, 33, "explode_depth");
    REFUSED(solid, view[1], 0.0 / 0.0, "direction");
    REFUSED(flat, hi[0], 1.0 / 0.0, "window");
    REFUSED(flat, lo[1], 0.0 / 0.0, "window");
    REFUSED(flat, mark_count, 1, "Mark 0");
    REFUSED(flat, title, "\xff\xfe", "UTF-8");
    o = good, o.accented_count = 1;
    assert_int_equal(draw(flat, "no.svg", &o, "accented"), FROE_E_OPTIONS);
    memset(&o, 0xA5, sizeof o); /* pointers that lead nowhere are not followed */
    assert_int_equal(draw(flat, "no.svg", &o, "froe_draw_defaults"), FROE_E_OPTIONS);
#undef REFUSED
    o = good;
    o.width = 30000;
    o.scale = 2;
    assert_int_equal(draw(flat, "no.png", &o, "pixels"), FROE_E_OPTIONS);
    o.width = 100, o.height = 30000;
    assert_int_equal(draw(flat, "no.png", &o, "pixels"), FROE_E_OPTIONS);
    assert_int_equal(draw(flat, "no.jpg", NULL, "no.jpg"), FROE_E_OPTIONS);
    assert_int_equal(draw(flat, "no", NULL, ".svg"), FROE_E_OPTIONS);
    assert_int_equal(draw(NULL, "no.svg", NULL, NULL), FROE_E_ARG);
    assert_int_equal(draw(flat, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_draw_write(flat, FROE_DRAW_FORMAT_COUNT, keep_picture, NULL, NULL, NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_draw_write(flat, (froe_draw_format)-1, keep_picture, NULL, NULL, NULL), FROE_E_OPTIONS);
    assert_int_equal(froe_draw_write(flat, FROE_DRAW_SVG, NULL, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(froe_draw_write(NULL, FROE_DRAW_SVG, keep_picture, NULL, NULL, NULL), FROE_E_ARG);
    assert_int_equal(files_here(), before);
    froe_tree_free(flat);
    froe_tree_free(solid);
}

static void marks_out_of_range_are_refused_by_number(void **state) {
    (void)state;
    froe_tree *flat = tree_of(mixed_scene(2), "density", 1);
    froe_draw_options o = froe_draw_defaults();
    const froe_draw_mark far = {.hi = {1, 1.0 / 0.0, 1}};
    o.marks = &far, o.mark_count = 1;
    assert_int_equal(draw(flat, "no.svg", &o, "Mark 0"), FROE_E_OPTIONS);
    const froe_draw_mark low = {.lo = {-1.0 / 0.0}}, before_all = {.hi = {1, 1}, .kind = (froe_draw_mark_kind)-1};
    o.marks = &low;
    assert_int_equal(draw(flat, "no.svg", &o, "Mark 0"), FROE_E_OPTIONS);
    o.marks = &before_all;
    assert_int_equal(draw(flat, "no.svg", &o, "Mark 0"), FROE_E_OPTIONS);
    const froe_draw_mark odd = {.hi = {1, 1, 1}, .kind = FROE_DRAW_MARK_KIND_COUNT}, scrawl = {.label = "\xff"};
    o.marks = &odd;
    assert_int_equal(draw(flat, "no.svg", &o, "Mark 0"), FROE_E_OPTIONS);
    o.marks = &scrawl;
    assert_int_equal(draw(flat, "no.svg", &o, "Mark 0"), FROE_E_OPTIONS);
    froe_tree_free(flat);
}

static void a_tree_of_higher_dimension_has_no_picture(void **state) {
    (void)state;
    froe_scene *scene = scene_of(4);
    const double p[] = {0, 0, 0, 0, 1, 1, 1, 1};
    add(scene, FROE_POINT, 2, p, NULL, NULL);
    froe_tree *tree = tree_of(scene, "density", 1);
    assert_int_equal(draw(tree, "no.svg", NULL, "4"), FROE_E_UNSUPPORTED);
    froe_tree_free(tree);
}

static void write_text(const char *path, const char *text) {
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void assert_text(const char *path, const char *text) {
    char found[64] = {0};
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    (void)!fread(found, 1, sizeof found - 1, file);
    fclose(file);
    assert_string_equal(found, text);
}

static void a_file_that_cannot_be_written_leaves_the_old_one(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_segments(500, 0.1, 1, 0), "density", 1);
    assert_int_equal(draw(tree, "no/such/folder/x.svg", NULL, "no/such/folder/x.svg"), FROE_E_IO);
    mkdir("folder.svg", 0777);
    assert_int_equal(draw(tree, "folder.svg", NULL, "folder.svg"), FROE_E_IO);
    rmdir("folder.svg");
    /* A disk that is full after 4096 bytes. */
    write_text("old.svg", "old");
    int before = files_here();
    struct rlimit limit, small = {4096, RLIM_INFINITY};
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    small.rlim_max = limit.rlim_max;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    froe_status status = froe_draw(tree, "old.svg", NULL, NULL);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    assert_int_equal(status, FROE_E_IO);
    assert_text("old.svg", "old");
    assert_int_equal(files_here(), before);
    unlink("old.svg");
    froe_tree_free(tree);
}

static void devices_and_links_are_written_through(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_segments(50, 0.1, 1, 0), "density", 1);
    struct stat info;
    unlink("full.svg");
    unlink("link.svg");
    if (symlink("/dev/full", "full.svg") == 0 && stat("/dev/full", &info) == 0) {
        assert_int_equal(draw(tree, "full.svg", NULL, "full.svg"), FROE_E_IO);
        assert_int_equal(lstat("full.svg", &info), 0);
        assert_true(S_ISLNK(info.st_mode));
    }
    write_text("target.svg", "old");
    chmod("target.svg", 0640);
    assert_int_equal(symlink("target.svg", "link.svg"), 0);
    assert_int_equal(draw(tree, "link.svg", NULL, NULL), FROE_OK);
    assert_int_equal(lstat("link.svg", &info), 0);
    assert_true(S_ISLNK(info.st_mode));
    assert_int_equal(stat("target.svg", &info), 0);
    assert_int_equal(info.st_mode & 0777, 0640);
    assert_true(info.st_size > 1000);
    unlink("full.svg");
    unlink("link.svg");
    unlink("target.svg");
    froe_tree_free(tree);
}

static void a_file_has_the_bytes_of_the_callback(void **state) {
    (void)state;
    froe_tree *tree = tree_of(random_segments(50, 0.1, 1, 0), "density", 1);
    assert_int_equal(draw(tree, "same.pdf", NULL, NULL), FROE_OK);
    image_bytes p = picture_of(tree, FROE_DRAW_PDF, NULL), q = {malloc(p.count + 1), p.count};
    FILE *file = fopen("same.pdf", "rb");
    assert_non_null(file);
    assert_int_equal(fread(q.bytes, 1, p.count + 1, file), p.count);
    fclose(file);
    assert_same_picture(p, q);
    unlink("same.pdf");
    froe_tree_free(tree);
}

static bool refuse(void *user, const void *bytes, size_t count) {
    (void)user;
    (void)bytes;
    (void)count;
    return false;
}

static void a_receiver_may_refuse(void **state) {
    (void)state;
    froe_tree *tree = tree_of(scene_of(2), "density", 1);
    assert_int_equal(froe_draw_write(tree, FROE_DRAW_SVG, refuse, NULL, NULL, NULL), FROE_E_IO);
    froe_tree_free(tree);
}

/* ------------------------------------------------------- memory and cancel -- */

typedef struct scenario {
    const froe_tree *tree;
    froe_draw_options options;
    froe_draw_format format;
} scenario;

static froe_status draw_to_memory(void *user, const froe_allocator *alloc) {
    scenario *s = user;
    image_bytes p = {NULL, 0};
    froe_diagnostic diag = {.message = ""};
    s->options.alloc = alloc;
    froe_status status = froe_draw_write(s->tree, s->format, keep_picture, &p, &s->options, &diag);
    assert_true((p.count > 0) == (status == FROE_OK));
    if (status != FROE_OK) assert_true(diag.message[0] && diag.status == status);
    free(p.bytes);
    return status;
}

/* A hull and a polygon of so many corners that lists of them grow, a box without thickness, and a point. */
static froe_scene *large_figures(void) {
    enum { CORNERS = 200 };
    static double ring[3 * CORNERS], hull[3 * CORNERS];
    const size_t starts[2] = {0, CORNERS};
    for (int i = 0; i < CORNERS; i++) { /* corners on a parabola: none of them is within */
        const double t = (i - CORNERS / 2) / 64.0;
        ring[3 * i] = t, ring[3 * i + 1] = t * t, ring[3 * i + 2] = 0.5;
        hull[3 * i] = t, hull[3 * i + 1] = t * t, hull[3 * i + 2] = i % 2;
    }
    froe_scene *scene = scene_of(3);
    froe_objects o = froe_objects_defaults();
    o.count = 1, o.starts = starts, o.coords = ring;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    o.kind = FROE_HULL, o.coords = hull;
    assert_int_equal(froe_scene_add(scene, &o, NULL), FROE_OK);
    add(scene, FROE_BOX, 2, (const double[]){0, 0, 0, 1, 0, 1, 0, 1, 0, 0, 2, 1}, NULL, NULL);
    add(scene, FROE_POINT, 1, (const double[]){0.25, 0.25, 0.5}, NULL, NULL);
    return scene;
}

static void every_allocation_may_fail(void **state) {
    (void)state;
    froe_tree *flat = tree_of(random_segments(60, 0.4, 1, 0), "autopartition", 0);
    froe_tree *solid = tree_of(mixed_scene(3), "density", 1), *plane = tree_of(mixed_scene(2), "density", 1);
    froe_tree *figures = tree_of(large_figures(), "density", 1);
    static const uint32_t accented[] = {0, 1, 2, 3, 4};
    scenario scenarios[] = {
        {flat, froe_draw_defaults(), FROE_DRAW_SVG},    {solid, froe_draw_defaults(), FROE_DRAW_PDF},
        {solid, froe_draw_defaults(), FROE_DRAW_PNG},   {plane, froe_draw_defaults(), FROE_DRAW_SVG},
        {plane, froe_draw_defaults(), FROE_DRAW_SVG},   {flat, froe_draw_defaults(), FROE_DRAW_PNG},
        {figures, froe_draw_defaults(), FROE_DRAW_SVG}, {figures, froe_draw_defaults(), FROE_DRAW_SVG},
        {figures, froe_draw_defaults(), FROE_DRAW_SVG}};
    scenarios[3].options.accented = accented, scenarios[3].options.accented_count = 5;
    scenarios[3].options.title = "Five";
    for (int k = 0; k < 2; k++) { /* so near to the ball that its border is drawn as a ring of lines */
        scenarios[4].options.lo[k] = (k ? 0.6 : 0.35) - 1e-5;
        scenarios[4].options.hi[k] = (k ? 0.6 : 0.35) + 1e-5;
    }
    scenarios[5].options.detail = 20, scenarios[5].options.max_depth = 0; /* cells are drawn as one */
    scenarios[6].options.axis = 2, scenarios[6].options.show = FROE_DRAW_OBJECTS;
    scenarios[7].options.style = FROE_DRAW_EXPLODED, scenarios[7].options.show = 15;
    scenarios[8].options.accented = accented, scenarios[8].options.accented_count = 5;
    scenarios[8].options.axis = 2, scenarios[8].options.at = 0.5;
    scenarios[2].options.style = FROE_DRAW_EXPLODED;
    scenarios[1].options.show = scenarios[2].options.show = 15;
    for (size_t i = 0; i < sizeof scenarios / sizeof *scenarios; i++) {
        scenarios[i].options.width = 200;
        assert_true(test_memory_each(draw_to_memory, scenarios + i) > 10);
    }
    froe_tree_free(flat);
    froe_tree_free(solid);
    froe_tree_free(plane);
    froe_tree_free(figures);
}

typedef struct patience {
    int left, heard;
    double last;
} patience;

static bool losing_patience(void *user, double done) {
    patience *p = user;
    assert_true(done >= p->last && done <= 1);
    p->last = done;
    p->heard++;
    return p->left-- > 0;
}

static void cancelling_writes_nothing(void **state) {
    (void)state;
    froe_tree *trees[] = {tree_of(random_segments(20000, 0.001, 1, 0), "density", 1),
                          tree_of(random_triangles(12000, 0.01), "density", 1)};
    for (int i = 0; i < 3; i++) {
        froe_draw_options o = froe_draw_defaults();
        if (i == 2) o.style = FROE_DRAW_EXPLODED;
        o.width = 100;
        patience endless = {1 << 30, 0, 0};
        o.progress = losing_patience;
        o.user = &endless;
        assert_int_equal(draw(trees[i > 0], "whole.png", &o, NULL), FROE_OK);
        assert_true(endless.heard > 2);
        assert_true(endless.last == 1);
        unlink("whole.png");
        int before = files_here();
        for (int left = 0; left < endless.heard; left++) {
            patience p = {left, 0, 0};
            o.user = &p;
            assert_int_equal(draw(trees[i > 0], "part.png", &o, "Cancelled."), FROE_E_CANCELLED);
            assert_int_equal(p.heard, left + 1);
        }
        assert_int_equal(files_here(), before);
    }
    froe_tree_free(trees[0]);
    froe_tree_free(trees[1]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options_out_of_range_are_refused_by_name),
        cmocka_unit_test(marks_out_of_range_are_refused_by_number),
        cmocka_unit_test(a_tree_of_higher_dimension_has_no_picture),
        cmocka_unit_test(a_file_that_cannot_be_written_leaves_the_old_one),
        cmocka_unit_test(devices_and_links_are_written_through),
        cmocka_unit_test(a_file_has_the_bytes_of_the_callback),
        cmocka_unit_test(a_receiver_may_refuse),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(cancelling_writes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
