/* save.c: a tree as the bytes of its file: header, section table, sections. */
#include "base/floats.h"
#include "support/fail.h"
#include "support/writer.h"
#include "tree/file.h"
#include <string.h>

typedef struct file_head {
    file_header header;
    file_section table[FILE_SECTIONS];
    uint8_t zeros[FILE_ALIGN]; /* at least up to the first section */
} file_head;

/* The scene of the tree has all its arrays. */
static void write_file(const froe_tree *tree, support_writer *out) {
    static const uint8_t zeros[FILE_ALIGN];
    file_head head;
    file_header *h = &head.header;
    memset(&head, 0, sizeof head);
    uint64_t offset = file_align(sizeof *h + sizeof head.table), size;
    const void *data;
    for (uint32_t i = 0; i < FILE_SECTIONS; i++) {
        file_section *s = head.table + i;
        s->id = i + 1;
        s->item_size = file_part(tree, (file_id)s->id, &data, &s->size);
        s->offset = offset;
        s->checksum = file_checksum(data, s->size, 0);
        offset = file_align(offset + s->size);
    }
    memcpy(h->magic, FILE_MAGIC, sizeof h->magic);
    h->version = FILE_VERSION;
    h->sections = FILE_SECTIONS;
    h->size = offset;
    h->dim = (uint32_t)tree->scene->dim;
    h->up = ((uint32_t)tree->scene->up + 1) % 3; /* 0 where there is none */
    h->crs = tree->scene->crs_kind;
    h->checksum = file_checksum(head.table, sizeof head.table, file_checksum(h, offsetof(file_header, checksum), 0));
    support_writer_put(out, &head, head.table[0].offset);
    for (uint32_t i = 0; i < FILE_SECTIONS; i++) {
        file_part(tree, (file_id)(i + 1), &data, &size);
        support_writer_put(out, data, size);
        support_writer_put(out, zeros, file_align(size) - size);
    }
}

froe_status froe_tree_save(const froe_tree *tree, const char *path, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    if (!tree || !path) return support_fail_null(diag, __func__);
    if (!file_machine_fits())
        return support_fail(diag, FROE_E_UNSUPPORTED, "Tree files are little-endian, and this machine is not.");
    support_writer out;
    froe_scene scene;
    froe_tree whole = *tree;
    if (scene_explicit(tree->scene, &tree->alloc, &scene)) return support_fail_memory(diag);
    whole.scene = &scene;
    froe_status status = support_writer_open(&out, path, &tree->alloc, diag);
    if (!status) {
        write_file(&whole, &out);
        status = support_writer_close(&out, FROE_OK);
    }
    scene_explicit_free(tree->scene, &tree->alloc, &scene);
    return status;
}
