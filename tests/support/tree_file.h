/* tree_file.h: a tree as the bytes of its file, in memory, to be changed and opened. */
#ifndef FROE_TESTS_SUPPORT_TREE_FILE_H
#define FROE_TESTS_SUPPORT_TREE_FILE_H
#include "support/memory.h"
#include "tree/file.h"
#include <stdlib.h>
#include <string.h>

typedef struct tree_file {
    uint8_t *bytes; /**< to be freed */
    size_t size;
} tree_file;

/** For froe_tree_write(). */
static inline bool tree_file_receive(void *user, const void *data, size_t count) {
    tree_file *f = user;
    f->bytes = realloc(f->bytes, f->size + count);
    assert_non_null(f->bytes);
    memcpy(f->bytes + f->size, data, count);
    f->size += count;
    return true;
}

/** The file of a tree, which is freed. */
static inline tree_file tree_file_of(froe_tree *tree) {
    tree_file f = {0};
    assert_int_equal(froe_tree_write(tree, tree_file_receive, &f, NULL), FROE_OK);
    froe_tree_free(tree);
    return f;
}

/** What the table says of a section. */
static inline file_section tree_file_section(const tree_file *f, uint32_t id) {
    file_section s;
    memcpy(&s, f->bytes + sizeof(file_header) + (id - 1) * sizeof s, sizeof s);
    return s;
}

/** Where a section begins. */
static inline void *tree_file_at(const tree_file *f, uint32_t id) {
    return f->bytes + tree_file_section(f, id).offset;
}

/** The same tree, opened from its file, in which a corner names no vertex: that is found by the first call that looks
 * at all of it. *f outlives the tree. */
static inline froe_tree *tree_file_damaged(froe_tree *tree, tree_file *f) {
    froe_tree *opened;
    *f = tree_file_of(tree);
    memset(tree_file_at(f, FILE_CORNERS), 0xee, sizeof(uint32_t));
    assert_int_equal(froe_tree_open_memory(f->bytes, f->size, NULL, &opened, NULL), FROE_OK);
    return opened;
}
#endif
