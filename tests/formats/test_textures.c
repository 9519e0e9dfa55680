/* test_textures.c: means of textures, and OBJ with textures and colours of corners, by an image function of its own. */
#include "formats/input/texture.h"
#include "support/memory.h"
#include "support/scatter.h"
#include "support/scenes.h"
#include <math.h>
#include <sys/stat.h>

/* Two rows of two: red, green; blue, and white that is clear. */
static const uint8_t four[16] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 0};

/* Reads files that begin with F as those four texels. */
static bool read_four(void *user, const char *path, const void *bytes, size_t count, const froe_allocator *alloc,
                      froe_image *out) {
    FILE *file = path ? fopen(path, "r") : NULL;
    const int first = file ? fgetc(file) : EOF;
    if (file) fclose(file);
    if (first != 'F') return false;
    assert_true(!bytes && !count);
    ++*(int *)user;
    *out = (froe_image){2, 2, support_calloc(alloc, 2, 8)};
    if (out->pixels) memcpy(out->pixels, four, sizeof four);
    return out->pixels != NULL;
}

static froe_scene *read_textured(const char *path, froe_read_report *report, int *images) {
    froe_read_options o = froe_read_defaults();
    froe_scene *scene = NULL;
    froe_diagnostic why = {.message = ""};
    o.image = read_four, o.image_user = images;
    if (froe_read_own(path, &o, &scene, report, &why)) fail_msg("%s", why.message);
    return scene;
}

static uint32_t colour_of(const froe_scene *scene, uint32_t object) {
    const uint32_t group = froe_scene_object(scene, object).group;
    return group == FROE_NONE ? 0 : froe_scene_group(scene, group).colour;
}

/* ----------------------------------------------------------------------- levels -- */

static void levels_of_light_come_back(void **state) {
    (void)state;
    for (unsigned i = 0; i < 256; i++) {
        const double s = i / 255.0, light = s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
        assert_true(fabs(formats_light((uint8_t)i) - light) < 1e-5);
        assert_int_equal(formats_level(light), i);
    }
    assert_int_equal(formats_level(-1), 0);
    assert_int_equal(formats_level(2), 255);
    assert_int_equal(formats_level(0.5), 188);
    assert_int_equal(formats_step_colour(0x00ff80ffu), 0x00ff82ffu);
    const double rgba[4] = {0, 1, 0.5, 2};
    assert_int_equal(formats_light_colour(rgba), 0x00ffbaffu);
}

/* An image of 16 x 8 texels that are different. */
static formats_texture sixteen(uint8_t *pixels) {
    for (uint32_t i = 0; i < 4 * 16 * 8; i++) pixels[i] = (uint8_t)trees_random(3, i, 256);
    return (formats_texture){.image = {16, 8, pixels}, .cutoff = -1, .scale = {1, 1}};
}

/* The light of the texel at a place, with the image repeated. */
static double texel(const formats_texture *t, double u, double v, int channel) {
    const int x = (int)floor((u - floor(u)) * 16), y = 7 - (int)floor((v - floor(v)) * 8);
    return formats_light(t->image.pixels[4 * (16 * y + x) + channel]);
}

/* Against the mean of very many places of the triangle, at random: also where it reaches beyond the image. */
static void means_are_those_of_the_texels_under_a_triangle(void **state) {
    (void)state;
    enum { PLACES = 200000 };
    uint8_t pixels[4 * 16 * 8];
    const formats_texture t = sixteen(pixels);
    for (uint32_t i = 0; i < 12; i++) {
        double places[6], corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, rgba[4], sum[3] = {0};
        for (uint32_t k = 0; k < 6; k++) places[k] = (i + 1) * 0.2 * (trees_unit(i, k) - 0.3);
        assert_true(formats_texture_mean(&t, corners, places, 3, rgba));
        for (uint32_t p = 0; p < PLACES; p++) {
            double x = trees_unit(i + 50, 2 * p), y = trees_unit(i + 50, 2 * p + 1);
            if (x + y > 1) x = 1 - x, y = 1 - y;
            const double u = places[0] + x * (places[2] - places[0]) + y * (places[4] - places[0]),
                         v = places[1] + x * (places[3] - places[1]) + y * (places[5] - places[1]);
            for (int c = 0; c < 3; c++) sum[c] += texel(&t, u, v, c) / PLACES;
        }
        for (int c = 0; c < 3; c++)
            if (fabs(sum[c] - rgba[c]) > 0.05) fail_msg("triangle %u: %g instead of %g", i, rgba[c], sum[c]);
        assert_true(rgba[3] == 1);
    }
}

/* A face within one texel has its colour, wherever beyond the image that is. */
static void what_is_beyond_an_image(void **state) {
    (void)state;
    static const struct {
        formats_wrap wrap;
        double u, v;
        uint32_t colour;
    } cases[] = {{FORMATS_REPEAT, 0.2, 0.8, 0xff0000ff},     {FORMATS_REPEAT, -0.8, 3.8, 0xff0000ff},
                 {FORMATS_REPEAT, 1.7, 0.8, 0x00ff00ff},     {FORMATS_CLAMP, 1.7, 0.8, 0x00ff00ff},
                 {FORMATS_CLAMP, -3, 0.8, 0xff0000ff},       {FORMATS_CLAMP, -3, -3, 0x0000ffff},
                 {FORMATS_MIRROR, 1.2, 0.8, 0x00ff00ff},     {FORMATS_MIRROR, -0.2, 0.8, 0xff0000ff},
                 {FORMATS_MIRROR, 2.2, -0.2, 0x0000ffff},    {FORMATS_REPEAT, NAN, 0.8, 0xff0000ff},
                 {FORMATS_REPEAT, 0.2, INFINITY, 0x0000ffff}};
    const double corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    uint8_t pixels[16];
    memcpy(pixels, four, sizeof four);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const formats_texture t = {
            .image = {2, 2, pixels}, .wrap = {cases[i].wrap, cases[i].wrap}, .cutoff = -1, .scale = {1, 1}};
        const double u = cases[i].u, v = cases[i].v, places[6] = {u, v, u + 0.01, v, u, v + 0.01};
        double rgba[4];
        assert_true(formats_texture_mean(&t, corners, places, 3, rgba));
        if (formats_light_colour(rgba) != cases[i].colour)
            fail_msg("case %zu: %08x instead of %08x", i, formats_light_colour(rgba), cases[i].colour);
    }
}

/* Over all four texels, of which the white one is clear. */
static void clear_texels_count_as_the_material_says(void **state) {
    (void)state;
    const double corners[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, places[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const struct {
        double cutoff;
        uint32_t colour;
    } cases[] = {{-1, 0xbababaff}, {0, 0x9e9e9ebe}, {0.5, 0x9e9e9eff}};
    uint8_t pixels[16];
    memcpy(pixels, four, sizeof four);
    for (size_t i = 0; i < 3; i++) {
        const formats_texture t = {.image = {2, 2, pixels}, .cutoff = cases[i].cutoff, .scale = {1, 1}};
        double rgba[4];
        assert_true(formats_texture_mean(&t, corners, places, 4, rgba));
        if (formats_light_colour(rgba) != cases[i].colour)
            fail_msg("case %zu: %08x instead of %08x", i, formats_light_colour(rgba), cases[i].colour);
    }
    const formats_texture none = {.scale = {1, 1}};
    double rgba[4];
    assert_false(formats_texture_mean(&none, corners, places, 4, rgba));
}

/* -------------------------------------------------------------------------- OBJ -- */

static const char quads[] = "mtllib quads.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                            "vt 0.1 0.6\nvt 0.4 0.6\nvt 0.4 0.9\nusemtl all\nf 1/1 2/2 3/3 4/4\nusemtl red\n"
                            "f 1/5/ 2/6 3/7\nf 1/-3 2/-2 3/-1\nusemtl tinted\nf 1/5 2/6 3/7\nusemtl gone\n"
                            "f 1/5 2/6 3/7\nusemtl red\nf 1 2 3\nf 1//1 2//1 3//1\nf 1/99 2/6 3/7\n";

static void faces_of_an_obj_have_the_means_of_their_textures(void **state) {
    (void)state;
    froe_read_report report;
    int images = 0;
    write_text("F four.png", "F");
    write_text("quads.mtl",
               "newmtl all\nmap_Kd F four.png\nnewmtl red\nKd 0 0 0\nTr 1.0\nmap_Kd -clamp on -s 1 1 1 F four.png\r\n"
               "newmtl tinted\nKd 0.5 1 1\nd 0.5\nmap_Kd -o 0.5 0 0 -bm 1 -blendu off F four.png\n"
               "newmtl gone\nKd 0.2 0.4 0.6\nmap_Kd textures\\gone.png\n");
    write_text("quads.obj", quads);
    froe_scene *scene = read_textured("quads.obj", &report, &images);
    assert_int_equal(images, 1);
    assert_int_equal(report.textures, 2);
    assert_int_equal(report.unread, 1);
    assert_string_equal(report.unread_name, "textures/gone.png");
    assert_int_equal(froe_scene_object_count(scene), 9);
    assert_int_equal(colour_of(scene, 0), 0x9e9e9ebe); /* both triangles of the first face */
    assert_int_equal(colour_of(scene, 1), 0x9e9e9ebe);
    assert_int_equal(colour_of(scene, 2), 0xff0000ff);
    assert_int_equal(colour_of(scene, 3), 0xff0000ff);
    assert_int_equal(colour_of(scene, 4), 0x00ff0082); /* the green texel, moved; the tint takes no green */
    assert_int_equal(colour_of(scene, 5), 0x336699ff); /* a missing texture leaves the colour of the material */
    for (uint32_t i = 6; i < 9; i++) assert_int_equal(colour_of(scene, i), 0);
    assert_string_equal(report.unread_library, "");
    assert_int_equal(froe_scene_object(scene, 2).group, froe_scene_object(scene, 3).group);
    assert_string_equal(froe_scene_group(scene, froe_scene_object(scene, 4).group).material, "tinted");
    froe_scene_free(scene);
}

/* A material by its lines, for a face of the whole image, and what colour the face gets. */
static void lines_of_a_material_decide_the_colour(void **state) {
    (void)state;
    static const struct {
        const char *lines;
        uint32_t colour;
    } cases[] = {
        {"", 0},
        {"Kd 0.2 0.4 0.6", 0x336699ff},
        {" \tKd\t0.2 0.4 0.6\t\r", 0x336699ff},
        {"Kd 0.2", 0x333333ff}, /* one number stands for three */
        {"Kd 0.2 0.4", 0x336666ff},
        {"Kd spectral file.rfl", 0},
        {"Kd", 0},
        {"Kdx 0.2 0.4 0.6", 0},
        {"Kd 0.2 0.4 0.6\nd 0.5\nd", 0x33669980},
        {"Kd 0.2 0.4 0.6\nTr 0.75\nTr x\nd x", 0x33669940},
        {"map_Kd F four.png", 0x9e9e9ebe},
        {"map_Kd F four.png \t\r", 0x9e9e9ebe},
        {"Kd 0 1 0\nmap_Kd F four.png", 0x009e00be},
        {"Kd 0 0 1\nmap_Kd F four.png", 0x00009ebe},
        {"Kd 0 0 0\nmap_Kd F four.png", 0x9e9e9ebe}, /* black is no tint */
        {"Kd 0 0 0\nmap_Kd gone.png", 0},
        {"Kd 1 0 0\nmap_Kd gone.png", 0xff0000ff},
        {"map_Kd -s 0 0 1 F four.png", 0x0000ffff}, /* all of it is the first texel of the lowest row */
        {"map_Kd -s 0 0 -o 0.5 0.5 F four.png", 0x00ff00ff},
        {"map_Kd -s 0 0 -o 0.5 0.5 -t 1 1 1 -mm 0 1 F four.png", 0x00ff00ff},
        {"map_Kd -s 0 0 -o 1.25 0.25 -clamp on F four.png", 0x00000001}, /* the clear one */
        {"map_Kd -s 0 0 -o 1.25 0.25 -clamp off F four.png", 0x0000ffff},
        {"map_Kd -s nan nan F four.png", 0x0000ffff},
        {"map_Kd -s", 0},
        {"map_Kd -clamp", 0},
    };
    write_text("F four.png", "F");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[200];
        int images = 0;
        snprintf(text, sizeof text, "Kd 9 9 9\nnewmtl\nnewmtl one \t\n%s", cases[i].lines);
        write_text("one.mtl", text);
        write_text("one.obj", "mtllib one.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                              "usemtl one\nf 1/1 2/2 3/3 4/4\n");
        froe_scene *scene = read_textured("one.obj", NULL, &images);
        if (colour_of(scene, 0) != cases[i].colour)
            fail_msg("%s: %08x instead of %08x", cases[i].lines, colour_of(scene, 0), cases[i].colour);
        froe_scene_free(scene);
    }
}

/* Faces without an area have the mean over their places in the image; lines and points have none. So have faces with a
 * corner that names no place, although the next word is a number. */
static void odd_elements_have_colours_of_textures_or_none(void **state) {
    (void)state;
    int images = 0;
    write_text("F four.png", "F");
    write_text("one.mtl", "newmtl one\nmap_Kd F four.png");
    write_text("odd.obj", "mtllib one.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv -1e200 0 0\nv 1e200 -1e200 0\nv 1e200 1e200 1\n"
                          "vt 0.1 0.6\nvt 0.4 0.6\nvt 0.4 0.9\nusemtl one\nf 1/1 1/2 1/3\nf 4/1 5/2 6/3\nl 1/1 2/2\n"
                          "p 1/1\nf 1/ 2/2 3/3\nf 1/ 2/ 3/1\nf 1/x 2/1 3/1\nf 1/-4 2/1 3/1\nf 1/1 2/1 3/\n");
    froe_scene *scene = read_textured("odd.obj", NULL, &images);
    assert_int_equal(froe_scene_object_count(scene), 9);
    for (uint32_t i = 0; i < 9; i++) assert_int_equal(colour_of(scene, i), i < 2 ? 0xff0000ff : 0);
    froe_scene_free(scene);
}

/* A library lies at or below the folder of the model; one that cannot be read is told. */
static void libraries_lie_with_their_model(void **state) {
    (void)state;
    char name[5000];
    memset(name, 'm', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    const struct {
        const char *name;
        bool read;
    } cases[] = {{"red.mtl", true}, {"in/red.mtl", true}, {"in/../red.mtl", false}, {"../sub/red.mtl", false},
                 {"..", false},     {"in", false},        {"/etc/red.mtl", false},  {name, false}};
    (void)mkdir("sub", 0777);
    (void)mkdir("sub/in", 0777);
    write_text("sub/red.mtl", "newmtl red\nKd 1 0 0\n");
    write_text("sub/in/red.mtl", "newmtl red\nKd 1 0 0\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[6000];
        int images = 0;
        froe_read_report report;
        snprintf(text, sizeof text, "mtllib %s\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3\n", cases[i].name);
        write_text("sub/model.obj", text);
        froe_scene *scene = read_textured("sub/model.obj", &report, &images);
        assert_int_equal(colour_of(scene, 0), cases[i].read ? 0xff0000ff : 0);
        assert_int_equal(strncmp(report.unread_library, cases[i].read ? "" : cases[i].name, 63), 0);
        assert_int_equal(!*report.unread_library, cases[i].read);
        froe_scene_free(scene);
    }
}

static void without_an_image_function_textures_are_counted(void **state) {
    (void)state;
    froe_read_report report;
    froe_scene *scene;
    write_text("F four.png", "F");
    write_text("quads.mtl", "newmtl all\nmap_Kd F four.png\n");
    write_text("quads.obj", quads);
    assert_int_equal(froe_read_own("quads.obj", NULL, &scene, &report, NULL), FROE_OK);
    assert_int_equal(report.textures, 1);
    assert_int_equal(report.unread, 1);
    assert_int_equal(colour_of(scene, 0), 0);
    froe_scene_free(scene);
    froe_read_options o = froe_read_defaults(); /* boxes have no faces, and no textures */
    int images = 0;
    o.boxes = true, o.image = read_four, o.image_user = &images;
    assert_int_equal(froe_read_own("quads.obj", &o, &scene, &report, NULL), FROE_OK);
    assert_int_equal(images + (int)report.textures, 0);
    froe_scene_free(scene);
}

/* Below the folder of the file, or beside it; nowhere else. */
static void images_lie_with_their_model(void **state) {
    (void)state;
    static const struct {
        const char *name;
        uint64_t unread;
    } cases[] = {{"F.png", 0},          {"../F.png", 0}, {"/etc/F.png", 0}, {"/etc/passwd", 1}, {"../../passwd.png", 1},
                 {"C:\\art\\F.png", 0}, {"..", 1},       {"a/../F.png", 0}, {"F.folder", 1},    {"folder/", 1}};
    (void)mkdir("F.folder", 0777);
    write_text("F.png", "F");
    write_text("quads.obj", quads);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[200];
        int images = 0;
        froe_read_report report;
        snprintf(text, sizeof text, "newmtl all\nmap_Kd %s\n", cases[i].name);
        write_text("quads.mtl", text);
        froe_scene *scene = read_textured("quads.obj", &report, &images);
        if (report.unread != cases[i].unread) fail_msg("%s", cases[i].name);
        froe_scene_free(scene);
    }
}

static void faces_of_an_obj_have_the_means_of_their_corners(void **state) {
    (void)state;
    froe_read_report report;
    int images = 0;
    write_text("quads.mtl", "newmtl paint\nKd 0 0 1\nmap_Kd F four.png\n");
    write_text("F four.png", "F");
    write_text("shades.obj",
               "mtllib quads.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 0 0 1\nv 0 1 0\nv 2 2 2 1.0\nv 3 3 3 0 1 0\n"
               "vt 0 0\no thing\nusemtl paint\nf 1/1 2/1 3/1\nf 1 1 2\nf 1 2 4\nl 1 2\np 6\nf 1 2 5\n");
    froe_scene *scene = read_textured("shades.obj", &report, &images);
    assert_int_equal(colour_of(scene, 0), 0xaa0055ff); /* in sRGB, as those of OFF and PLY; before the texture */
    assert_int_equal(colour_of(scene, 1), 0xff0000ff);
    assert_int_equal(colour_of(scene, 2), 0); /* a corner has none */
    assert_int_equal(colour_of(scene, 3), 0xff0000ff);
    assert_int_equal(colour_of(scene, 4), 0x00ff00ff);
    assert_int_equal(colour_of(scene, 5), 0);
    assert_string_equal(froe_scene_group(scene, froe_scene_object(scene, 0).group).name, "thing");
    froe_scene_free(scene);
    write_text("cloud.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 2 0 0\n");
    scene = read_textured("cloud.obj", &report, &images);
    assert_int_equal(colour_of(scene, 0), 0xff0000ff);
    assert_int_equal(colour_of(scene, 1), 0x00ff00ff);
    assert_int_equal(colour_of(scene, 2), 0);
    froe_scene_free(scene);
}

static void points_of_a_ply_have_their_colours(void **state) {
    (void)state;
    froe_read_report report;
    int images = 0;
    write_text("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                            "end_header\n0 0 0 255 0 0\n1 0 0 0 255 0\n2 0 0 255 1 0\n");
    froe_scene *scene = read_textured("cloud.ply", &report, &images);
    assert_int_equal(froe_scene_kind_count(scene, FROE_POINT), 3);
    assert_int_equal(colour_of(scene, 0), 0xff0000ff);
    assert_int_equal(colour_of(scene, 1), 0x00ff00ff);
    assert_int_equal(froe_scene_object(scene, 2).group, 0); /* in 64 steps a channel */
    froe_scene_free(scene);
}

static froe_status read_by(void *user, const froe_allocator *alloc) {
    int images = 0;
    froe_read_options o = froe_read_defaults();
    froe_scene *scene = NULL;
    o.alloc = alloc, o.image = read_four, o.image_user = &images;
    const froe_status status = froe_read_own(user, &o, &scene, NULL, NULL);
    froe_scene_free(scene);
    return status;
}

/* But for the image itself: without memory it is one that cannot be read. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    write_text("quads.mtl", "newmtl all\nmap_Kd gone.png\nnewmtl red\nKd 1 0 0\n");
    write_text("shades.obj", "mtllib quads.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 0 0 1\nvt 0 0\nusemtl all\n"
                             "f 1/1 2/1 3/1\nusemtl red\nf 1/1 2/1 3/1\n");
    assert_true(test_memory_each(read_by, "shades.obj") > 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_of_light_come_back),
        cmocka_unit_test(means_are_those_of_the_texels_under_a_triangle),
        cmocka_unit_test(what_is_beyond_an_image),
        cmocka_unit_test(clear_texels_count_as_the_material_says),
        cmocka_unit_test(faces_of_an_obj_have_the_means_of_their_textures),
        cmocka_unit_test(lines_of_a_material_decide_the_colour),
        cmocka_unit_test(odd_elements_have_colours_of_textures_or_none),
        cmocka_unit_test(libraries_lie_with_their_model),
        cmocka_unit_test(without_an_image_function_textures_are_counted),
        cmocka_unit_test(images_lie_with_their_model),
        cmocka_unit_test(faces_of_an_obj_have_the_means_of_their_corners),
        cmocka_unit_test(points_of_a_ply_have_their_colours),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
