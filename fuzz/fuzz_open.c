/* fuzz_open.c: any bytes as a tree file, and what follows the file's end as questions. Checksums are made right, so
 * that what lies behind them is reached. What opens must be safe to look at and to ask, all of it, even when it is
 * wrong; and when it passes the audit its answers must agree. */
#include "ask.h"
#include "base/random.h"
#include "look.h"
#include "support/forge.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool see_cell(void *user, const froe_cell *cell) {
    size_t *seen = user;
    return cell->leaf ? ++*seen < 10000 : true;
}

static void look_at_nodes(const froe_tree *tree, froe_node node, const froe_report *report) {
    /* Down the path that prefers child 1: nodes are values, no stack is needed. */
    for (uint64_t steps = 0; node.id1 && steps <= report->height; steps++) {
        const froe_node_info info = froe_tree_node(tree, node);
        for (size_t i = 0; i < info.piece_count; i++) (void)froe_tree_piece(tree, info.first_piece + i);
        node = info.child[1];
    }
}

static void look_at_scene(const froe_scene *scene) {
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM], sum = 0;
    for (size_t i = 0; i < froe_scene_object_count(scene); i++) {
        const froe_object object = froe_scene_object(scene, (uint32_t)i);
        for (uint32_t corner = 0; corner < object.corners; corner++)
            sum += *froe_scene_vertex(scene, froe_scene_corner(scene, (uint32_t)i, corner));
        if (object.group != FROE_NONE) sum += froe_scene_group(scene, object.group).name[0];
    }
    uint32_t ends[2];
    for (uint32_t edge = 0; froe_scene_edge(scene, edge, ends); edge++) sum += *froe_scene_vertex(scene, ends[1]);
    sum += froe_scene_crs(scene).unit[0] + (double)froe_scene_across(scene, NULL);
    if (froe_scene_bounds(scene, lo, hi)) sum += lo[0] + hi[froe_scene_dim(scene) - 1];
    volatile double used = sum;
    (void)used;
}

static void look_at_pieces(const froe_tree *tree) {
    for (size_t i = 0; i < froe_tree_piece_count(tree); i++) {
        double corners[8 * FROE_MAX_DIM];
        froe_node made[8];
        (void)froe_tree_piece_corners(tree, i, corners, made, 8);
    }
}

static void look_at_all(const froe_tree *tree, fuzz_bytes *questions) {
    const froe_report report = froe_tree_report(tree);
    const froe_scene *scene = froe_tree_scene(tree);
    froe_audit_options o = froe_audit_defaults();
    double lo[FROE_MAX_DIM], hi[FROE_MAX_DIM];
    size_t seen = 0;
    look_at_scene(scene);
    look_at_nodes(tree, froe_tree_root(tree), &report);
    look_at_pieces(tree);
    if (report.dim <= 3 && froe_scene_bounds(scene, lo, hi)) froe_tree_cells(tree, lo, hi, see_cell, &seen, NULL);
    o.threads = 1;
    const bool right = froe_tree_audit(tree, &o, NULL) == FROE_OK;
    ask(tree, right, questions);
    if (report.dim == 3) look(tree, right, questions);
}

/* Of the file, by its header. */
static size_t size_of_file(const uint8_t *data, size_t size) {
    file_header h;
    if (size < sizeof h) return size;
    memcpy(&h, data, sizeof h);
    return h.size < size ? (size_t)h.size : size;
}

/* The bytes that are still expected. */
static bool expect(void *user, const void *bytes, size_t count) {
    fuzz_bytes *left = user;
    if (count > left->size || memcmp(bytes, left->data, count) != 0) abort();
    left->data += count;
    left->size -= count;
    return true;
}

/* A file that is right is what its tree is written as, and no other is written. */
static void check_bytes(const froe_tree *tree, const uint8_t *file, size_t size) {
    fuzz_bytes left = {file, size};
    const bool right = froe_tree_check(tree, NULL) == FROE_OK;
    if (right && froe_tree_saved_size(tree) != size) abort();
    if (right != (froe_tree_write(tree, expect, &left, NULL) == FROE_OK)) abort();
    if (right && left.size) abort();
}

/* ---------------------------------------------------------------- mutation -- */

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most) __attribute__((weak)); /* of libFuzzer */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

/* A word of a section becomes another one: of the same section, a neighbour, an end, a number of items. */
static void change_word(uint8_t *words, size_t count, const file_section *table, uint64_t bits) {
    static const uint32_t ends[] = {0, 1, UINT32_MAX, UINT32_MAX - 1, 0x7fffffff, 0x80000000, 0x7ff00000, 0x00100000};
    uint32_t word, other;
    uint8_t *at = words + 4 * (bits % count);
    memcpy(&word, at, 4);
    memcpy(&other, words + 4 * ((bits >> 16) % count), 4);
    const file_section *s = table + (bits >> 32) % FILE_SECTIONS;
    switch (bits >> 48 & 7) {
    case 0:
    case 1:
        word = other;
        break;
    case 2:
        word += 1 + (uint32_t)(bits >> 56);
        break;
    case 3:
        word -= 1 + (uint32_t)(bits >> 56);
        break;
    case 4:
        word = ends[bits >> 56 & 7];
        break;
    case 5:
        word ^= UINT32_C(1) << (bits >> 56 & 31);
        break;
    default:
        word = (uint32_t)(s->size / (s->item_size ? s->item_size : 1)) - (bits >> 56 & 1);
    }
    memcpy(at, &word, 4);
}

/* Of three mutations two change words within sections, so that a tree stays one; the others are libFuzzer's, which
 * reach the questions behind the file as well. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed) {
    file_section table[FILE_SECTIONS];
    const size_t begin = sizeof(file_header), file = size_of_file(data, size);
    if (seed % 3 == 0 || file < begin + sizeof table) return LLVMFuzzerMutate(data, size, most);
    memcpy(table, data + begin, sizeof table);
    for (uint64_t i = 0; i < 1 + seed / 3 % 3; i++) {
        const uint64_t bits = base_hash(seed, 3, i);
        const file_section *s = table + base_hash(seed, 4, i) % FILE_SECTIONS;
        if (s->size >= 4 && s->offset < file && s->size <= file - s->offset)
            change_word(data + s->offset, s->size / 4, table, bits);
    }
    return size;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[256];
    froe_tree *tree;
    const size_t file = size_of_file(data, size);
    fuzz_bytes questions = {data + file, size - file};
    uint8_t *copy = malloc(file + 1);
    if (!copy) return 0;
    if (file) memcpy(copy, data, file);
    forge_checksums(copy, file);
    fuzz_file("", ".froe", copy, file, path, sizeof path);
    const bool opens = froe_tree_open_memory(copy, file, NULL, &tree, NULL) == FROE_OK;
    if (opens) {
        check_bytes(tree, copy, file);
        froe_tree_free(tree);
    }
    free(copy);
    const bool is_tree = froe_is_tree(path);
    if (froe_tree_open(path, NULL, &tree, NULL) == FROE_OK) {
        fuzz_bytes first = questions;
        if (!is_tree || !opens) abort();
        look_at_scene(froe_tree_scene(tree));
        ask(tree, false, &first); /* nothing has been checked yet but what these questions read */
        froe_tree_free(tree);
    }
    if (froe_tree_open_copy(path, NULL, &tree, NULL) == FROE_OK) {
        look_at_all(tree, &questions);
        froe_tree_free(tree);
    }
    remove(path);
    return 0;
}
