/* seeds.c: inputs for the fuzzers, made by the library as it is, so that they are of its formats.
 *
 *     seeds FOLDER     writes FOLDER/NAME for each fuzzer */
#include "base/random.h"
#include "support/samples.h"
#include <froe/formats.h>
#include <froe/kinetic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { QUESTIONS = 400, PROGRAMS = 48 };

/* Fuzzers whose inputs are decisions. */
static const char *const deciders[] = {"scene", "kinetic", "folder", "space", "import"};

typedef struct output {
    const char *folder;
    char path[4096];
} output;

static void give_up(const char *path) {
    perror(path);
    exit(2);
}

static const char *path_of(output *out, const char *fuzzer, const char *name) {
    snprintf(out->path, sizeof out->path, "%s/%s", out->folder, fuzzer);
    (void)mkdir(out->path, 0777);
    snprintf(out->path, sizeof out->path, "%s/%s/%s", out->folder, fuzzer, name);
    return out->path;
}

static void put(const char *path, const char *mode, const void *bytes, size_t size) {
    FILE *file = fopen(path, mode);
    if (!file || fwrite(bytes, 1, size, file) != size || fclose(file)) give_up(path);
}

/* Bytes that decide something, the same ones for the same seed. */
static void random_bytes(uint64_t seed, uint8_t *bytes, size_t size) {
    for (size_t i = 0; i < size; i++) bytes[i] = (uint8_t)(base_hash(seed, 1, i) >> 56);
}

/* ------------------------------------------------------------------- trees -- */

static bool save_tree(void *user, const char *method, const char *scene, const froe_tree *tree) {
    output *out = user;
    char name[100];
    uint8_t questions[QUESTIONS];
    snprintf(name, sizeof name, "%s-of-%s", method, scene);
    random_bytes(strlen(name), questions, sizeof questions);
    path_of(out, "open", name);
    if (froe_tree_save(tree, out->path, NULL)) give_up(out->path);
    put(out->path, "ab", questions, sizeof questions);
    return true;
}

/* Half a tree. */
static void truncate_tree(output *out) {
    uint8_t half[1500];
    FILE *file = fopen(path_of(out, "open", "kd-of-segments"), "rb");
    if (!file || fread(half, 1, sizeof half, file) != sizeof half) give_up(out->path);
    fclose(file);
    put(path_of(out, "open", "truncated"), "wb", half, sizeof half);
}

/* ---------------------------------------------------------------- programs -- */

static void save_programs(output *out) {
    for (uint64_t i = 0; i < PROGRAMS; i++) {
        uint8_t bytes[600];
        char name[30];
        random_bytes(i, bytes, sizeof bytes);
        snprintf(name, sizeof name, "program-%02d", (int)i);
        for (size_t k = 0; k < sizeof deciders / sizeof *deciders; k++)
            put(path_of(out, deciders[k], name), "wb", bytes, sizeof bytes);
    }
}

/* ------------------------------------------------------------------- files -- */

/* A file without the header that fuzz_read puts before it, after the number of that header. */
static void save_read(output *out, const char *name, uint8_t form, const char *rest, size_t size) {
    put(path_of(out, "read", name), "wb", &form, 1);
    put(out->path, "ab", rest, size);
}

static void save_scene(output *out, const char *kind, const char *name, uint8_t form, const char *suffix,
                       size_t header) {
    char path[4100], text[20000];
    froe_scene *scene;
    if (froe_generate(kind, 8, 1, NULL, &scene, NULL)) give_up(kind);
    snprintf(path, sizeof path, "%s%s", path_of(out, "read", "whole"), suffix);
    if (froe_write_scene(scene, path, NULL)) give_up(path);
    FILE *file = fopen(path, "rb");
    if (!file) give_up(path);
    const size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    remove(path);
    froe_scene_free(scene);
    save_read(out, name, form, text + header, size - header);
}

static void save_files(output *out) {
    static const char text[] = "format ascii 1.0\nelement vertex 4\nproperty double x\nproperty float y\n"
                               "property double z\nelement face 2\nproperty list uchar int vertex_indices\n"
                               "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
                               "0 0 0\n1 0 0\n1 1 0\n0 1 0.5\n4 0 1 2 2\n3 0 2 3\n0 3\n";
    static const char binary[] =
        "format binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\n"
        "property uchar z\nelement face 1\nproperty list uchar uchar vertex_index\nend_header\n"
        "\0\0\0\1\0\0\0\1\0\3\0\1\2";
    static const char obj[] = "v 1 0 0\nv 0 1 0\nv 1 1 0.5\no one\nusemtl red\nf 1 2 3\nf -1/1 -2/2/2 -3//1\n"
                              "g two\nl 1 2 3\np 4\nmtllib none.mtl\nvn 0 0 1\nvt 0 0\n# end\n";
    save_scene(out, "triangles", "triangles-off", 5, ".off", 4);
    save_scene(out, "triangles", "triangles-obj", 8, ".obj", 0);
    save_read(out, "text-ply", 7, text, sizeof text - 1);
    save_read(out, "binary-ply", 7, binary, sizeof binary - 1);
    save_read(out, "all-of-obj", 8, obj, sizeof obj - 1);
}

/* A door of a plan, which turns by a quarter. */
static void save_door(output *out) {
    static const double times[] = {0, 2}, hinge[4], turns[] = {0, 1, 0.70710678118654757, 0.70710678118654757};
    static const double zeros[2], ends[] = {0, 0, 5, 0};
    char path[4110];
    froe_motion *motion;
    froe_motion_options window = froe_motion_defaults();
    froe_body body = froe_body_defaults();
    froe_moving batch = froe_moving_defaults();
    window.begin = 0, window.end = 2;
    body.count = 2, body.times = times, body.coords = hinge, body.turns = turns;
    batch.vertex_count = 2, batch.count = 1, batch.starts = (const size_t[]){0, 1, 2}, batch.times = zeros;
    batch.coords = ends, batch.bodies = (const uint32_t[]){0, 0};
    if (froe_motion_new(&window, NULL, &motion, NULL) || froe_motion_add_body(motion, &body, NULL, NULL) ||
        froe_motion_add(motion, &batch, NULL))
        give_up("door");
    snprintf(path, sizeof path, "%s.mfjson", path_of(out, "motion", "door"));
    if (froe_write_motion(motion, path, NULL) || rename(path, out->path)) give_up(path);
    froe_motion_free(motion);
}

static void save_motions(output *out) {
    for (size_t i = 0; froe_motion_generator_at(i); i++) {
        const char *name = froe_motion_generator_at(i)->name;
        char path[4110];
        froe_motion *motion;
        if (froe_generate_motion(name, 4, 1, NULL, &motion, NULL)) give_up(name);
        snprintf(path, sizeof path, "%s.mfjson", path_of(out, "motion", name));
        if (froe_write_motion(motion, path, NULL)) give_up(path);
        if (rename(path, out->path)) give_up(path);
        froe_motion_free(motion);
    }
}

/* ----------------------------------------------------------------- manifests -- */

static void save_poses(output *out) {
    static const char rows[] = "\0a,0,0,0,0,0,0,0,1\na,1,1,0,0,0,0,0.6,0.8\na,3,9,8,7,0,0,0,1\n\"b\",0,1,2,3,1,0,0,0\n"
                               "b,2.5,-1,2,3,0.6,0,0.8,0\nc,1,0,0,0,0,0,0,1\n";
    static const char plain[] = "\1"
                                "0,a,1,2,3\n1,a,2,3,4\n0,b,5,5,5\n4,b,6,7,8\n";
    static const char wrong[] = "\2a,1,0,0,0,x\na,1,0,0,0,x\nd,0,0,0,0,y\n";
    put(path_of(out, "poses", "turns"), "wb", rows, sizeof rows - 1);
    put(path_of(out, "poses", "plain"), "wb", plain, sizeof plain - 1);
    put(path_of(out, "poses", "wrong"), "wb", wrong, sizeof wrong - 1);
}

static void save_command_lines(output *out) {
    static const char all[] = "a.csv\0-f\0-t\0text\0--words=one\0--words\0two\0-n5\0--real\0-1e-3\0--choice=green\0"
                              "--reals=1,2.5,-3\0-o\0out.csv\0--threads\0"
                              "2\0--seed=7\0--\0-b";
    static const char wrong[] = "--whol\0"
                                "5\0--whole=2\0--real=nan\0--choice=gren\0--reals=1,,2\0-x\0--flag=1\0--text";
    put(path_of(out, "options", "all"), "wb", all, sizeof all - 1);
    put(path_of(out, "options", "wrong"), "wb", wrong, sizeof wrong - 1);
}

static void save_manifest(output *out) {
    static const char text[] =
        "froe shards 1\ndimension 2\ncut 1 0.5\nshard 2 2 64 00000000000000ff 0 0 1 0.5\nshard 0\n";
    put(path_of(out, "shards", "two"), "wb", text, sizeof text - 1);
}

int main(int argc, char **argv) {
    if (argc != 2) {
        fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
        return 2;
    }
    output out = {.folder = argv[1]};
    (void)mkdir(argv[1], 0777);
    samples_each(save_tree, &out);
    truncate_tree(&out);
    save_programs(&out);
    save_files(&out);
    save_motions(&out);
    save_door(&out);
    save_manifest(&out);
    save_poses(&out);
    save_command_lines(&out);
    return 0;
}
