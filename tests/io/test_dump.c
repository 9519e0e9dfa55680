/* test_dump.c: models as assimp itself dumps them (.assbin), which may say anything: faces of points that are not there
 * or of none, meshes that are clouds, nodes of meshes that are not there, materials and images of any number. */
#include "support.h"

enum { MOST = 1 << 13, NODE = 0x123c, SCENE = 0x1239, MESH = 0x1237, MATERIAL = 0x123d, PROPERTY = 0x123e };
enum { IMAGE = 0x1236, ANIMATION = 0x123b, CHANNEL = 0x1238 };
enum { POINTS = 1, PLACES = 0x100, COLOURS = 0x10000 }; /* what the points of a mesh have */

typedef struct dump {
    unsigned char bytes[MOST];
    size_t used;
} dump;

static void put(dump *d, const void *bytes, size_t size) {
    assert_true(d->used + size <= sizeof d->bytes);
    memcpy(d->bytes + d->used, bytes, size);
    d->used += size;
}

/* Numbers of so many bytes, the lowest first. */
static void put_whole(dump *d, uint32_t value, size_t size) {
    const unsigned char bytes[4] = {(unsigned char)value, (unsigned char)(value >> 8), (unsigned char)(value >> 16),
                                    (unsigned char)(value >> 24)};
    put(d, bytes, size);
}

/* Numbers of four bytes each, and a -1 behind the last. */
static void put_words(dump *d, const int *words) {
    for (; *words >= 0; words++) put_whole(d, (uint32_t)*words, 4);
}
#define PUT(d, ...) put_words(d, (const int[]){__VA_ARGS__, -1})

static void put_floats(dump *d, const float *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, values + i, sizeof bits);
        put_whole(d, bits, 4);
    }
}

static void put_double(dump *d, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put_whole(d, (uint32_t)bits, 4), put_whole(d, (uint32_t)(bits >> 32), 4);
}

static void put_text(dump *d, const char *text) {
    put_whole(d, (uint32_t)strlen(text), 4);
    put(d, text, strlen(text));
}

/* What a model of one node says. Lists of words end with a -1. */
typedef struct model {
    const int *named;    /* by the node: numbers of meshes */
    int meshes;          /* all alike: */
    int points;          /* how many of the four */
    int has;             /* what points have */
    const int *faces;    /* each is a number of corners and as many indices; NULL: there are none */
    int material;        /* of the first mesh; of each other one it is one more */
    int materials;       /* all called "paint" */
    const char *image;   /* of the first material; NULL: none */
    int step;            /* the last digit of its name is so much more in each other material */
    int channel;         /* of the places in it */
    const float *colour; /* of materials; NULL: none */
    int images;          /* of one texel each: blue, red, ... */
} model;

static const int one_mesh[] = {0, -1}, triangle[] = {3, 0, 1, 2, -1};

static void put_node(dump *d, const model *m) {
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    int count = 0;
    while (m->named[count] >= 0) count++;
    PUT(d, NODE, 0);
    put_text(d, "node");
    put_floats(d, identity, 16);
    PUT(d, 0, count, 0);
    put_words(d, m->named);
}

static void put_mesh(dump *d, const model *m, int number) {
    static const float at[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};
    static const float green[4] = {0, 1, 0, 1};
    int faces = 0;
    for (const int *f = m->faces; f && *f >= 0; f += 1 + *f) faces++;
    PUT(d, MESH, 0, 4, m->points, faces, 0, m->material + number, m->has);
    put_floats(d, at[0], 3 * (size_t)m->points);
    for (int i = 0; i < m->points && (m->has & COLOURS); i++) put_floats(d, green, 4);
    if (m->has & PLACES) {
        PUT(d, 2);
        put_floats(d, at[0], 3 * (size_t)m->points);
    }
    for (const int *f = m->faces; f && *f >= 0; f += 1 + *f)
        for (int k = 0; k <= *f; k++) put_whole(d, (uint32_t)f[k], 2);
}

static void put_property(dump *d, const char *key, int semantic, int type, size_t size) {
    PUT(d, PROPERTY, 0);
    put_text(d, key);
    PUT(d, semantic, 0, (int)size, type);
}

static void put_material(dump *d, const model *m, int number) {
    enum { FLOATS = 1, TEXT = 3, WHOLE = 4, DIFFUSE = 1 };
    PUT(d, MATERIAL, 0, 1 + 2 * !!m->image + !!m->colour);
    put_property(d, "?mat.name", 0, TEXT, 4 + 6);
    put_text(d, "paint"), put_whole(d, 0, 1);
    if (m->colour) {
        put_property(d, "$clr.diffuse", 0, FLOATS, 16);
        put_floats(d, m->colour, 4);
    }
    if (!m->image) return;
    char name[8];
    const int length = snprintf(name, sizeof name, "%s", m->image);
    name[length - 1] = (char)(name[length - 1] + m->step * number);
    put_property(d, "$tex.file", DIFFUSE, TEXT, 4 + (size_t)length + 1);
    put_text(d, name), put_whole(d, 0, 1);
    put_property(d, "$tex.uvwsrc", DIFFUSE, WHOLE, 4);
    PUT(d, m->channel);
}

static void put_head(dump *d, int meshes, int materials, int animations, int images) {
    static const char head[44] = "ASSIMP.binary-dump.";
    d->used = 0;
    put(d, head, sizeof head);
    PUT(d, 1, 0, 0, 0, 0); /* the version; neither shortened nor compressed */
    for (int i = 0; i < (256 + 128 + 64) / 4; i++) PUT(d, 0);
    PUT(d, SCENE, 0, 0, meshes, materials, animations, images, 0, 0);
}

static void write_model(const char *path, const model *m) {
    static const unsigned char texels[2][4] = {{255, 0, 0, 255}, {0, 0, 255, 255}}; /* blue first */
    static dump d;
    put_head(&d, m->meshes, m->materials, 0, m->images);
    put_node(&d, m);
    for (int i = 0; i < m->meshes; i++) put_mesh(&d, m, i);
    for (int i = 0; i < m->materials; i++) put_material(&d, m, i);
    for (int i = 0; i < m->images; i++) {
        PUT(&d, IMAGE, 0, 1, 1);
        put(&d, "rgba8888", 8);
        put(&d, texels[i % 2], 4);
    }
    write_bytes(path, d.bytes, d.used);
}

static const model simple = {
    .named = one_mesh, .meshes = 1, .points = 3, .has = POINTS, .faces = triangle, .materials = 1};

static void broken_numbers_are_refused(void **state) {
    (void)state;
    static const struct {
        int named[3], face[5];
        const char *sentence;
    } cases[] = {
        {{0, -1}, {3, 0, 1, 3, -1}, "dump.assbin: A face names a vertex that does not exist."},
        {{0, 1, -1}, {3, 0, 1, 2, -1}, "dump.assbin: A node names a mesh that does not exist."},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        model m = simple;
        m.named = cases[i].named, m.faces = cases[i].face;
        write_model("dump.assbin", &m);
        refuse("dump.assbin", FROE_E_FORMAT, cases[i].sentence);
    }
}

static void faces_without_corners_are_counted(void **state) {
    (void)state;
    static const int faces[] = {0, 3, 0, 1, 2, 0, -1};
    froe_read_report report;
    model m = simple;
    m.faces = faces;
    write_model("dump.assbin", &m);
    froe_scene *scene = read_scene("dump.assbin", &report);
    assert_string_equal(report.format, "Assimp Binary (assimp)");
    assert_int_equal(froe_scene_up(scene), 2);
    assert_int_equal(froe_scene_object_count(scene), 1);
    assert_int_equal(report.skipped, 2);
    froe_scene_free(scene);
}

static void a_mesh_without_faces_is_a_cloud(void **state) {
    (void)state;
    model m = simple;
    m.points = 4, m.faces = NULL;
    write_model("dump.assbin", &m);
    froe_scene *scene = read_scene("dump.assbin", NULL);
    assert_int_equal(froe_scene_object_count(scene), 4);
    assert_int_equal(froe_scene_kind_count(scene, FROE_POINT), 4);
    assert_true(corner(scene, 3, 0)[0] == 1 && corner(scene, 3, 0)[1] == 1 && corner(scene, 3, 0)[2] == 1);
    froe_scene_free(scene);
}

/* A mesh of a material that is not there has none. */
static void materials_are_those_that_are_there(void **state) {
    (void)state;
    static const float red[4] = {1, 0, 0, 1};
    static const int both[] = {0, 1, -1}, again[] = {0, 0, -1};
    static const struct {
        const int *named;
        int meshes, material, has;
        size_t groups;
        const char *materials[2];
        uint32_t colours[2];
    } cases[] = {
        {one_mesh, 1, 0, POINTS, 1, {"paint"}, {0xff0000ff}},
        {one_mesh, 1, 7, POINTS, 1, {""}, {0}},
        {one_mesh, 1, 7, POINTS | COLOURS, 1, {""}, {0}},
        {one_mesh, 1, 0, POINTS | COLOURS, 1, {"paint"}, {0x00ff00ff}}, /* colours of corners go before */
        {both, 2, 0, POINTS, 2, {"paint", ""}, {0xff0000ff, 0}},
        {again, 1, 0, POINTS, 1, {"paint"}, {0xff0000ff}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        model m = simple;
        m.named = cases[i].named, m.meshes = cases[i].meshes, m.material = cases[i].material, m.has = cases[i].has;
        m.colour = red;
        write_model("dump.assbin", &m);
        froe_scene *scene = read_scene("dump.assbin", NULL);
        assert_int_equal(froe_scene_object_count(scene), cases[i].named[1] < 0 ? 1 : 2);
        assert_int_equal(froe_scene_group_count(scene), cases[i].groups);
        for (uint32_t g = 0; g < cases[i].groups; g++) {
            assert_string_equal(froe_scene_group(scene, g).material, cases[i].materials[g]);
            assert_int_equal(froe_scene_group(scene, g).colour, cases[i].colours[g]);
        }
        froe_scene_free(scene);
    }
}

/* Texels within the file are images of names such as "*0"; the same one is an image once. */
static void images_of_texels_colour_faces(void **state) {
    (void)state;
    static const int both[] = {0, 1, -1}, mixed[] = {2, 0, 1, 3, 0, 1, 2, -1};
    static const struct {
        int step, channel, has;
        const int *faces;
        size_t textures;
        uint32_t colour[2]; /* of objects */
    } cases[] = {
        {1, 0, POINTS | PLACES, triangle, 2, {0x0000ffff, 0xff0000ff}},
        {0, 0, POINTS | PLACES, triangle, 1, {0x0000ffff, 0x0000ffff}},
        {1, 0, POINTS | PLACES, mixed, 2, {0, 0x0000ffff}}, /* a line has no area that would show it */
        {1, 0, POINTS, triangle, 2, {0, 0}},                /* no places in it */
        {1, 3, POINTS | PLACES, triangle, 2, {0, 0}},
        {1, 9, POINTS | PLACES, triangle, 2, {0, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        froe_read_report report;
        model m = simple;
        m.named = both, m.meshes = m.materials = m.images = 2, m.image = "*0", m.step = cases[i].step;
        m.channel = cases[i].channel, m.has = cases[i].has, m.faces = cases[i].faces;
        write_model("dump.assbin", &m);
        froe_scene *scene = read_scene("dump.assbin", &report);
        assert_int_equal(report.textures, cases[i].textures);
        for (uint32_t k = 0; k < 2; k++) {
            const uint32_t group = froe_scene_object(scene, k).group;
            assert_int_equal(froe_scene_group(scene, group).colour, cases[i].colour[k]);
        }
        froe_scene_free(scene);
    }
}

/* The node goes from 0 to 2 along x, and has nine keys of its scale, which is 1. */
static void write_moving(const char *path) {
    static const float places[2][3] = {{0, 0, 0}, {2, 0, 0}}, turn[4] = {1, 0, 0, 0}, scale[3] = {1, 1, 1};
    static dump d;
    put_head(&d, 1, 1, 1, 0);
    put_node(&d, &simple);
    put_mesh(&d, &simple, 0);
    put_material(&d, &simple, 0);
    PUT(&d, ANIMATION, 0);
    put_text(&d, "go");
    put_double(&d, 16), put_double(&d, 2); /* ticks, and ticks a second */
    PUT(&d, 1, CHANNEL, 0);
    put_text(&d, "node");
    PUT(&d, 2, 1, 9, 0, 0);
    for (int i = 0; i < 2; i++) put_double(&d, 16 * i), put_floats(&d, places[i], 3);
    put_double(&d, 0), put_floats(&d, turn, 4);
    for (int i = 0; i < 9; i++) put_double(&d, 2 * i), put_floats(&d, scale, 3);
    write_bytes(path, d.bytes, d.used);
}

static froe_status read_motion(void *path, const froe_allocator *alloc) {
    froe_motion_read_options o = froe_motion_read_defaults();
    froe_motion *motion = NULL;
    o.alloc = alloc;
    const froe_status status = froe_read_animation(path, &o, &motion, NULL, NULL);
    froe_motion_free(motion);
    return status;
}

static void keys_move_the_node(void **state) {
    (void)state;
    froe_motion *motion = NULL;
    froe_diagnostic why = {.message = ""};
    double at[3];
    write_moving("moving.assbin");
    if (froe_read_animation("moving.assbin", NULL, &motion, NULL, &why)) fail_msg("%s", why.message);
    assert_int_equal(froe_motion_object_count(motion), 1);
    assert_true(froe_motion_window(motion).begin == 0 && froe_motion_window(motion).end == 8);
    for (int k = 0; k <= 8; k++) {
        assert_true(froe_motion_position(motion, froe_motion_object(motion, 0).vertices[0], k, at));
        assert_true(at[0] == k / 4.0 && at[1] == 0 && at[2] == 0);
    }
    froe_motion_free(motion);
    assert_true(test_memory_each(read_motion, "moving.assbin") > 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(broken_numbers_are_refused),      cmocka_unit_test(faces_without_corners_are_counted),
        cmocka_unit_test(a_mesh_without_faces_is_a_cloud), cmocka_unit_test(materials_are_those_that_are_there),
        cmocka_unit_test(images_of_texels_colour_faces),   cmocka_unit_test(keys_move_the_node),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
