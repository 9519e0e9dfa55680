/* save.c: a tree as the bytes of its file: header, section table, sections. */
#include "base/floats.h"
#include "support/fail.h"
#include "support/writer.h"
#include "tree/file.h"
#include "tree/gate.h"
#include "tree/packed/table.h"
#include <string.h>

typedef struct file_head {
    file_header header;
    file_section table[FILE_SECTIONS];
    uint8_t zeros[FILE_ALIGN]; /* at least up to the first section */
} file_head;

/* Where the sections lie; checksums only if asked for. Returns the size of the file. */
static uint64_t lay_out_sections(const froe_tree *tree, file_section *table, bool checksums) {
    uint64_t offset = file_align(sizeof(file_header) + FILE_SECTIONS * sizeof *table);
    for (uint32_t i = 0; i < FILE_SECTIONS; i++) {
        const void *data;
        file_section *s = table + i;
        s->id = i + 1;
        s->item_size = file_part(tree, (file_id)s->id, &data, &s->size);
        s->offset = offset;
        s->checksum = checksums ? file_checksum(data, s->size, 0) : 0;
        offset = file_align(offset + s->size);
    }
    return offset;
}

uint64_t froe_tree_saved_size(const froe_tree *tree) {
    file_section table[FILE_SECTIONS];
    return lay_out_sections(tree, table, false);
}

/* The scene of the tree has all its arrays, and the tree the cells of its table. False: fn has stopped. */
static bool write_file(const froe_tree *tree, froe_write_fn *fn, void *user) {
    static const uint8_t zeros[FILE_ALIGN];
    file_head head;
    file_header *h = &head.header;
    memset(&head, 0, sizeof head);
    h->size = lay_out_sections(tree, head.table, true);
    memcpy(h->magic, FILE_MAGIC, sizeof h->magic);
    h->version = FILE_VERSION;
    h->sections = FILE_SECTIONS;
    h->dim = (uint32_t)tree->scene->dim;
    h->up = ((uint32_t)tree->scene->up + 1) % 3; /* 0 where there is none */
    h->crs = tree->scene->crs_kind;
    h->checksum = file_checksum(head.table, sizeof head.table, file_checksum(h, offsetof(file_header, checksum), 0));
    bool going = base_callback(fn(user, &head, head.table[0].offset));
    for (uint32_t i = 0; i < FILE_SECTIONS && going; i++) {
        const void *data;
        uint64_t size;
        file_part(tree, (file_id)(i + 1), &data, &size);
        const size_t rest = file_align(size) - size;
        if (size) going = base_callback(fn(user, data, size));
        if (rest && going) going = base_callback(fn(user, zeros, rest));
    }
    return going;
}

/* *done: fn has taken all. FROE_E_MEMORY; FROE_E_FORMAT: the file that the tree lies in is bad. */
static froe_status write_tree(const froe_tree *tree, froe_write_fn *fn, void *user, bool *done, froe_diagnostic *diag) {
    froe_scene scene;
    froe_status status = tree_settle(tree, diag);
    if (status) return status;
    froe_tree whole = *tree;
    if (!tree->gate && tree_table_cells(tree, &whole.packed.cells)) return support_fail_memory(diag);
    if (scene_explicit(tree->scene, &tree->alloc, &scene)) {
        status = support_fail_memory(diag);
    } else {
        whole.scene = &scene;
        *done = write_file(&whole, fn, user);
        scene_explicit_free(tree->scene, &tree->alloc, &scene);
    }
    if (!tree->gate) tree_table_cells_free(tree, &whole.packed.cells);
    return status;
}

froe_status froe_tree_write(const froe_tree *tree, froe_write_fn *fn, void *user, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    bool done;
    if (!tree || !fn) return support_fail_null(diag, __func__);
    froe_status status = file_check_machine(diag);
    if (!status) status = write_tree(tree, fn, user, &done, diag);
    if (status || done) return status;
    return support_fail(diag, FROE_E_IO, "The function that receives the bytes of the tree has stopped.");
}

static bool put_to_file(void *user, const void *bytes, size_t count) {
    BASE_FLOATS_OWN;
    return support_writer_put(user, bytes, count);
}

froe_status froe_tree_save(const froe_tree *tree, const char *path, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    support_writer out;
    bool done; /* as the writer says */
    if (!tree || !path) return support_fail_null(diag, __func__);
    froe_status status = file_check_machine(diag);
    if (!status) status = support_writer_open(&out, path, &tree->alloc, diag);
    if (status) return status;
    status = write_tree(tree, put_to_file, &out, &done, diag);
    return support_writer_close(&out, status);
}
