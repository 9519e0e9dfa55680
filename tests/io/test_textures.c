/* test_textures.c: images by GDAL, and the colours of faces in models by assimp: glTF with images inside and beside it,
 * wrapped in every way, tinted and transparent; Collada; colours of corners. */
#include "support.h"
#include <gdal.h>
#include <sys/stat.h>
#include <unistd.h>

/* A PNG of two rows of two texels: red, green; blue, and white that is clear. */
static const unsigned char four_png[] = {137, 80, 78,  71, 13, 10, 26, 10, 0,   0,   0,   13,  73,  72,  68,  82,
                                         0,   0,  0,   2,  0,  0,  0,  2,  8,   6,   0,   0,   0,   114, 182, 13,
                                         36,  0,  0,   0,  19, 73, 68, 65, 84,  120, 218, 99,  248, 207, 192, 240,
                                         31,  12, 129, 52, 8,  48, 0,  0,  72,  201, 8,   248, 197, 52,  253, 5,
                                         0,   0,  0,   0,  73, 69, 78, 68, 174, 66,  96,  130};

static uint32_t colour_of(const froe_scene *scene, uint32_t object) {
    const uint32_t group = froe_scene_object(scene, object).group;
    return group == FROE_NONE ? 0 : froe_scene_group(scene, group).colour;
}

/* ------------------------------------------------------------------------- glTF -- */

/* Triangles with places in the image, each within one texel or over all of it; v downwards, as in glTF. */
static const float places[4][3][2] = {{{0.1f, 0.1f}, {0.4f, 0.1f}, {0.1f, 0.4f}},    /* red */
                                      {{1.6f, 0.1f}, {1.9f, 0.1f}, {1.6f, 0.4f}},    /* beyond the right side */
                                      {{-0.4f, 0.6f}, {-0.1f, 0.6f}, {-0.4f, 0.9f}}, /* and the left, lower half */
                                      {{0.6f, 0.6f}, {0.9f, 0.6f}, {0.6f, 0.9f}}};   /* the clear texel */

typedef struct gltf {
    const char *wrap;     /* of the sampler */
    const char *material; /* members of the material */
    const char *factor;
    const char *image; /* "uri":... ; NULL: inside */
    bool shades;       /* corners have colours: half red light */
    const char *moved; /* members of the reference to the texture */
} gltf;

static size_t pad(unsigned char *bytes, size_t count, int with) {
    while (count % 4) bytes[count++] = (unsigned char)with;
    return count;
}

static void put_word(unsigned char *at, size_t value) {
    for (int i = 0; i < 4; i++) at[i] = (unsigned char)(value >> 8 * i);
}

/* A GLB: the header, the JSON, and a buffer with positions, places, colours and the image. */
static void write_glb(const char *path, gltf g) {
    unsigned char bytes[8192];
    float buffer[12 * 3 + 12 * 2 + 12 * 3];
    for (int i = 0; i < 12; i++) {
        const float at[3] = {(float)(i / 3 * 2 + i % 2), (float)(i % 3 / 2), 0};
        memcpy(buffer + 3 * i, at, sizeof at);
        memcpy(buffer + 36 + 2 * i, places[i / 3][i % 3], sizeof places[0][0]);
        const float shade[3] = {0.5f, 0, 0};
        memcpy(buffer + 60 + 3 * i, shade, sizeof shade);
    }
    const size_t data = sizeof buffer + sizeof four_png;
    char image[500] = "\"bufferView\":3,\"mimeType\":\"image/png\"";
    if (g.image) snprintf(image, sizeof image, "\"uri\":\"%s\"", g.image);
    size_t count = (size_t)snprintf(
        (char *)bytes + 20, sizeof bytes - 20,
        "{\"asset\":{\"version\":\"2.0\"}%s,\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"name\":"
        "\"sheet\"}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1%s},\"material\":0}]}"
        "],"
        "\"materials\":[{\"name\":\"print\",\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0%s}%s}%s}],"
        "\"textures\":[{\"source\":0,\"sampler\":0}],\"images\":[{%s}],\"samplers\":[{%s}],\"buffers\":[{"
        "\"byteLength\":"
        "%zu}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":144},{\"buffer\":0,\"byteOffset\":144,"
        "\"byteLength\":96},{\"buffer\":0,\"byteOffset\":240,\"byteLength\":144},{\"buffer\":0,\"byteOffset\":384,"
        "\"byteLength\":%zu}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":12,\"type\":\"VEC3\","
        "\"min\":[0,0,0],\"max\":[7,1,0]},{\"bufferView\":1,\"componentType\":5126,\"count\":12,\"type\":\"VEC2\"},"
        "{\"bufferView\":2,\"componentType\":5126,\"count\":12,\"type\":\"VEC3\"}]}",
        g.moved ? ",\"extensionsUsed\":[\"KHR_texture_transform\"]" : "", g.shades ? ",\"COLOR_0\":2" : "",
        g.moved ? g.moved : "", g.factor ? g.factor : "", g.material ? g.material : "", image, g.wrap ? g.wrap : "",
        data, sizeof four_png);
    count = pad(bytes + 20, count, ' ');
    memcpy(bytes, "glTF\2\0\0\0", 8);
    put_word(bytes + 12, count);
    memcpy(bytes + 16, "JSON", 4);
    unsigned char *chunk = bytes + 20 + count;
    memcpy(chunk + 4, "BIN", 4);
    memcpy(chunk + 8, buffer, sizeof buffer);
    memcpy(chunk + 8 + sizeof buffer, four_png, sizeof four_png);
    const size_t padded = pad(chunk + 8, data, 0);
    put_word(chunk, padded);
    put_word(bytes + 8, 20 + count + 8 + padded);
    write_bytes(path, bytes, 20 + count + 8 + padded);
}

static void expect(gltf g, uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    const uint32_t colours[4] = {a, b, c, d};
    froe_read_report report;
    write_glb("sheet.glb", g);
    froe_scene *scene = read_scene("sheet.glb", &report);
    assert_int_equal(froe_scene_object_count(scene), 4);
    assert_int_equal(report.textures, 1);
    assert_int_equal(report.unread, 0);
    for (uint32_t i = 0; i < 4; i++)
        if (colour_of(scene, i) != colours[i])
            fail_msg("face %u: %08x instead of %08x", i, colour_of(scene, i), colours[i]);
    assert_string_equal(froe_scene_group(scene, 0).name, "sheet");
    assert_string_equal(froe_scene_group(scene, 0).material, "print");
    froe_scene_free(scene);
}

enum { RED = 0xff0000ff, GREEN = 0x00ff00ff, BLUE = 0x0000ffff, WHITE = 0xffffffff };

static void an_image_inside_is_wrapped_as_its_sampler_says(void **state) {
    (void)state;
    expect((gltf){0}, RED, GREEN, WHITE, WHITE); /* opaque, whatever the texels say */
    expect((gltf){.wrap = "\"wrapS\":10497,\"wrapT\":10497"}, RED, GREEN, WHITE, WHITE);
    expect((gltf){.wrap = "\"wrapS\":33071"}, RED, GREEN, BLUE, WHITE);
    expect((gltf){.wrap = "\"wrapS\":33648"}, RED, RED, BLUE, WHITE);
}

static void an_image_beside_is_found(void **state) {
    (void)state;
    write_bytes("four colours.png", four_png, sizeof four_png);
    expect((gltf){.image = "four%20colours.png"}, RED, GREEN, WHITE, WHITE);
    (void)mkdir("in", 0777);
    write_bytes("in/4%4.png", four_png, sizeof four_png);
    write_bytes("in/%zz%0.png", four_png, sizeof four_png);
    expect((gltf){.image = "in/4%4.png"}, RED, GREEN, WHITE, WHITE);
    expect((gltf){.image = "in\\\\4%254.png"}, RED, GREEN, WHITE, WHITE);
    expect((gltf){.image = "in/%zz%0.png"}, RED, GREEN, WHITE, WHITE);
}

static void factors_and_colours_of_corners_are_multiplied_as_light(void **state) {
    (void)state;
    const char *half = ",\"baseColorFactor\":[0.5,1,1,1]";
    expect((gltf){.factor = half}, 0xba0000ff, GREEN, 0xbaffffff, 0xbaffffff);
    expect((gltf){.shades = true}, 0xba0000ff, 0x000000ff, 0xba0000ff, 0xba0000ff);
    expect((gltf){.shades = true, .material = ",\"alphaMode\":\"BLEND\""}, 0xba0000ff, 0x000000ff, 1, 1);
    expect((gltf){.shades = true, .factor = half}, 0x8a0000ff, 0x000000ff, 0x8a0000ff, 0x8a0000ff);
}

static void opacity_is_that_of_the_mode(void **state) {
    (void)state;
    const char *half = ",\"baseColorFactor\":[1,1,1,0.5]";
    expect((gltf){.factor = half}, RED, GREEN, WHITE, WHITE);
    expect((gltf){.factor = half, .material = ",\"alphaMode\":\"BLEND\""}, 0xff000082, 0x00ff0082, 1, 1);
    expect((gltf){.material = ",\"alphaMode\":\"MASK\""}, RED, GREEN, 0x00000001, 0x00000001);
    expect((gltf){.material = ",\"alphaMode\":\"MASK\",\"alphaCutoff\":0"}, RED, GREEN, WHITE, WHITE);
}

static void a_texture_may_be_moved_and_scaled(void **state) {
    (void)state;
#define MOVED(members) ",\"extensions\":{\"KHR_texture_transform\":{" members "}}"
    expect((gltf){.moved = MOVED("\"offset\":[0.5,0]")}, GREEN, RED, BLUE, BLUE);
    expect((gltf){.moved = MOVED("\"offset\":[0,0.5]")}, BLUE, WHITE, GREEN, GREEN);
    expect((gltf){.moved = MOVED("\"scale\":[0,0],\"offset\":[0.25,0.25]")}, RED, RED, RED, RED);
    expect((gltf){.moved = MOVED("\"scale\":[0,0],\"offset\":[0.25,0.75]")}, BLUE, BLUE, BLUE, BLUE);
}

static void textures_that_are_missing_or_broken_are_counted(void **state) {
    (void)state;
    froe_read_report report;
    write_text("broken.png", "\211PNG\r\n\032\n and nothing more");
    const char *images[] = {"gone.png", "broken.png", "/dev/null", "http://example.org/x.png"};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++) {
        write_glb("sheet.glb", (gltf){.image = images[i], .factor = ",\"baseColorFactor\":[1,0,0,1]"});
        froe_scene *scene = read_scene("sheet.glb", &report);
        assert_int_equal(report.textures, 1);
        assert_int_equal(report.unread, 1);
        assert_string_equal(report.unread_name, images[i]);
        assert_int_equal(colour_of(scene, 0), RED); /* that of the material */
        assert_int_equal(froe_scene_group_count(scene), 1);
        froe_scene_free(scene);
    }
}

/* ----------------------------------------------------------------------- others -- */

static void an_obj_is_read_with_its_images(void **state) {
    (void)state;
    froe_read_report report;
    write_bytes("four.png", four_png, sizeof four_png);
    write_text("one.mtl", "newmtl print\nmap_Kd four.png\n");
    write_text("one.obj", "mtllib one.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.1 0.6\nvt 0.4 0.6\nvt 0.4 0.9\n"
                          "usemtl print\nf 1/1 2/2 3/3\n");
    froe_scene *scene = read_scene("one.obj", &report);
    assert_int_equal(report.textures, 1);
    assert_int_equal(report.unread, 0);
    assert_int_equal(colour_of(scene, 0), RED);
    froe_scene_free(scene);
}

/* The name of an image may be anything that a line can hold; none of these is there. */
static void odd_names_of_images_are_those_of_files(void **state) {
    (void)state;
    char long_name[400];
    memset(long_name, 'n', sizeof long_name - 1), long_name[sizeof long_name - 1] = '\0';
    const char *const names[] = {"*7", "*x", "*", "gone%", "gone%4", "gone%00.png", "gone%g1.png", long_name};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        FILE *file = fopen("odd.mtl", "w");
        assert_non_null(file);
        fprintf(file, "newmtl print\nKd 0 0 1\nmap_Kd %s\n", names[i]);
        fclose(file);
        write_text("odd.obj", "mtllib odd.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl print\n"
                              "f 1/1 2/2 3/3\nf 1 2 3\n");
        froe_read_report report;
        froe_scene *scene = read_scene("odd.obj", &report);
        if (report.textures != 1 || report.unread != 1) fail_msg("%s: %d", names[i], (int)report.unread);
        assert_int_equal(froe_scene_object_count(scene), 2);
        froe_scene_free(scene);
        write_glb("odd.glb", (gltf){.image = names[i]});
        scene = read_scene("odd.glb", &report);
        if (report.textures != 1 || report.unread != 1) fail_msg("%s: %d", names[i], (int)report.unread);
        froe_scene_free(scene);
    }
    froe_read_options boxes = froe_read_defaults();
    boxes.boxes = true;
    static const char *const paths[] = {"odd.obj", "odd.glb"};
    for (int i = 0; i < 2; i++) { /* boxes have no colours, and images are not opened */
        froe_read_report report;
        froe_scene *scene = read_with(paths[i], &boxes, &report);
        assert_int_equal(report.textures, 0);
        froe_scene_free(scene);
    }
}

static unsigned char *put_floats(unsigned char *at, const float *values, size_t count) {
    memcpy(at, values, count * sizeof *values);
    return at + count * sizeof *values;
}

/* A model of Quake: its image is uncompressed within the file, as numbers of a palette. */
static void texels_within_a_model_are_its_colours(void **state) {
    (void)state;
    static const float scale[] = {1, 1, 1}, none[4] = {0};
    unsigned char bytes[400] = "IDPO\6", *at = put_floats(bytes + 8, scale, 3);
    at = put_floats(put_floats(at, none, 4), none, 3);         /* the origin, the radius, the eye */
    static const unsigned counts[] = {1, 4, 4, 3, 1, 1, 0, 0}; /* skins, width, height, vertices, faces, frames */
    for (size_t i = 0; i < 8; i++, at += 4) put_word(at, counts[i]);
    at = put_floats(at, none, 1);                        /* size */
    at += 4, memset(at, 251, 16), at[15] = 15, at += 16; /* one image, nearly of one colour */
    for (unsigned i = 0; i < 3; i++, at += 12) put_word(at + 4, i % 2 * 2), put_word(at + 8, i / 2 * 2);
    put_word(at, 1);
    for (unsigned i = 0; i < 3; i++) put_word(at + 4 + 4 * i, i);
    at += 16 + 4 + 8;
    memcpy(at, "frame", 5), at += 16;
    for (unsigned i = 0; i < 3; i++, at += 4) at[0] = (unsigned char)(i % 2), at[1] = (unsigned char)(i / 2);
    write_bytes("quake.mdl", bytes, (size_t)(at - bytes));
    froe_read_report report;
    froe_scene *scene = read_scene("quake.mdl", &report);
    assert_int_equal(froe_scene_object_count(scene), 1);
    assert_int_equal(report.textures, 1);
    assert_int_equal(report.unread, 0);
    assert_true((colour_of(scene, 0) & 0xff) == 0xff && colour_of(scene, 0) != WHITE);
    froe_scene_free(scene);
}

/* Colours of corners are of sRGB where no image and no glTF is. */
static void colours_of_corners_are_averaged(void **state) {
    (void)state;
    write_text("corners.x",
               "xof 0303txt 0032\nMesh m { 3; 0.0;0.0;0.0;, 1.0;0.0;0.0;, 0.0;1.0;0.0;; 1; 3;0,1,2;;\n"
               "MeshVertexColors { 3; 0; 1.0;0.0;0.0;1.0;;, 1; 1.0;0.0;0.0;1.0;;, 2; 1.0;0.0;0.0;1.0;;; } }\n");
    froe_scene *scene = read_scene("corners.x", NULL);
    assert_int_equal(froe_scene_object_count(scene), 1);
    assert_int_equal(colour_of(scene, 0), RED);
    froe_scene_free(scene);
}

/* Large images come smaller: 600 x 300 in grey, the left half black, the right half white, with a palette. */
static void a_large_image_has_its_means(void **state) {
    (void)state;
    enum { WIDE = 600, HIGH = 300, HEAD = 54 + 8 };
    static unsigned char bmp[HEAD + WIDE * HIGH];
    froe_read_report report;
    memcpy(bmp, "BM", 2);
    put_word(bmp + 2, sizeof bmp);
    put_word(bmp + 10, HEAD);
    put_word(bmp + 14, 40);
    put_word(bmp + 18, WIDE);
    put_word(bmp + 22, HIGH);
    bmp[26] = 1, bmp[28] = 8;
    put_word(bmp + 34, WIDE * HIGH);
    put_word(bmp + 46, 2);
    put_word(bmp + 58, 0x0000ff00); /* entry 1: green */
    for (int i = 0; i < WIDE * HIGH; i++) bmp[HEAD + i] = i % WIDE >= WIDE / 2;
    write_bytes("large.bmp", bmp, sizeof bmp);
    write_text("large.mtl", "newmtl print\nmap_Kd large.bmp\n");
    write_text("large.obj",
               "mtllib large.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
               "vt 0.4 0\nvt 0.6 0\nvt 0.4 1\nvt 0.6 1\nusemtl print\nf 1/1 2/5 3/7 4/4\nf 1/6 2/2 3/3 4/8\n"
               "f 1/1 2/2 3/3 4/4\n");
    froe_scene *scene = read_scene("large.obj", &report);
    assert_int_equal(report.unread, 0);
    assert_int_equal(colour_of(scene, 0), 0x000000ff);
    assert_int_equal(colour_of(scene, 2), GREEN);
    assert_int_equal(colour_of(scene, 4), 0x00ba00ff);
    froe_scene_free(scene);
    memset(bmp + HEAD, 9, WIDE * HIGH); /* no such entry: black */
    write_bytes("large.bmp", bmp, sizeof bmp);
    scene = read_scene("large.obj", &report);
    assert_int_equal(report.unread, 0);
    assert_int_equal(colour_of(scene, 4), 0x000000ff);
    froe_scene_free(scene);
}

/* A raster with one level, but for the first texel of the last band. */
static void write_raster(const char *path, int width, int height, int bands, GDALDataType type, const double *levels) {
    GDALDatasetH data = GDALCreate(GDALGetDriverByName("GTiff"), path, width, height, bands, type, NULL);
    assert_non_null(data);
    for (int i = 0; i < bands; i++) assert_int_equal(GDALFillRaster(GDALGetRasterBand(data, i + 1), levels[i], 0), 0);
    GDALClose(data);
}

/* Grey, with opacity, of 16 bits; so long that their short side would have less than one pixel. */
static void rasters_of_every_sort_have_their_colours(void **state) {
    (void)state;
    static const struct {
        int width, height, bands;
        GDALDataType type;
        double levels[4];
        uint32_t colour;
    } cases[] = {
        {2, 2, 1, GDT_Byte, {255}, 0xffffffff},
        {2, 2, 1, GDT_UInt16, {0}, 0x000000ff},
        {2, 2, 3, GDT_UInt16, {65535, 0, 65535}, 0xff00ffff},
        {2, 2, 2, GDT_Byte, {0, 0}, 0x00000001},
        {2, 2, 4, GDT_Byte, {0, 255, 0, 255}, 0x00ff00ff},
        {2, 2, 4, GDT_UInt16, {0, 65535, 0, 0}, 0x00000001},
        {3000, 1, 3, GDT_Byte, {0, 255, 255}, 0x00ffffff},
        {1, 3000, 3, GDT_Byte, {255, 255, 0}, 0xffff00ff},
    };
    GDALAllRegister();
    write_text("raster.mtl", "newmtl print\nmap_Kd raster.tif\n");
    write_text("raster.obj", "mtllib raster.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl print\n"
                             "f 1/1 2/2 3/3\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_read_report report;
        write_raster("raster.tif", cases[i].width, cases[i].height, cases[i].bands, cases[i].type, cases[i].levels);
        froe_scene *scene = read_scene("raster.obj", &report);
        assert_int_equal(report.unread, 0);
        if (colour_of(scene, 0) != cases[i].colour) fail_msg("raster %zu: %08x", i, colour_of(scene, 0));
        froe_scene_free(scene);
    }
}

/* The file of an image ends before its last texel. */
static void rasters_that_are_cut_off_are_counted(void **state) {
    (void)state;
    static const struct {
        int bands;
        GDALDataType type;
    } cases[] = {{1, GDT_Byte}, {4, GDT_Byte}, {1, GDT_UInt16}, {4, GDT_UInt16}};
    static const double levels[4] = {1, 2, 3, 4};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_read_report report;
        struct stat info;
        write_raster("raster.tif", 200, 200, cases[i].bands, cases[i].type, levels);
        assert_int_equal(stat("raster.tif", &info), 0);
        assert_int_equal(truncate("raster.tif", info.st_size / 2), 0);
        froe_scene *scene = read_scene("raster.obj", &report);
        assert_int_equal(report.textures, 1);
        if (report.unread != 1) fail_msg("raster %zu is read", i);
        froe_scene_free(scene);
    }
}

/* Without memory for its texels an image is one that cannot be read. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    write_glb("inside.glb", (gltf){.shades = true});
    write_bytes("four.png", four_png, sizeof four_png);
    write_glb("beside.glb", (gltf){.image = "four.png"});
    write_text("four.mtl", "newmtl print\nmap_Kd four.png\n");
    write_text("four.obj", "mtllib four.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.1 0.6\nvt 0.4 0.6\nvt 0.4 0.9\n"
                           "usemtl print\nf 1/1 2/2 3/3\n");
    assert_true(test_memory_each(read_with_memory, "inside.glb") > 5);
    assert_true(test_memory_each(read_with_memory, "beside.glb") > 5);
    assert_true(test_memory_each(read_with_memory, "four.obj") > 5);
    assert_true(test_memory_each(read_with_memory, "quake.mdl") > 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_image_inside_is_wrapped_as_its_sampler_says),
        cmocka_unit_test(an_image_beside_is_found),
        cmocka_unit_test(factors_and_colours_of_corners_are_multiplied_as_light),
        cmocka_unit_test(opacity_is_that_of_the_mode),
        cmocka_unit_test(a_texture_may_be_moved_and_scaled),
        cmocka_unit_test(textures_that_are_missing_or_broken_are_counted),
        cmocka_unit_test(an_obj_is_read_with_its_images),
        cmocka_unit_test(odd_names_of_images_are_those_of_files),
        cmocka_unit_test(texels_within_a_model_are_its_colours),
        cmocka_unit_test(colours_of_corners_are_averaged),
        cmocka_unit_test(a_large_image_has_its_means),
        cmocka_unit_test(rasters_of_every_sort_have_their_colours),
        cmocka_unit_test(rasters_that_are_cut_off_are_counted),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
