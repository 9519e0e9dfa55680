/* file.h: a tree file as bytes: header, section table, sections. docs/format.md is the specification.
 *
 *     0     header        64 bytes
 *     64    table         32 bytes a section
 *     ...   sections      in the order of their ids, each at a multiple of 64, zeros between
 *
 * Sections are the arrays of the tree and its scene as they lie in memory, so that opening is
 * mapping. Two equal trees make equal files. What follows from other sections, and would take a walk through them, is
 * there, too: facts, the jump table, wide nodes.
 *
 * It speaks for file.c, open.c and save.c. */
#ifndef FROE_TREE_FILE_H
#define FROE_TREE_FILE_H
#include "tree/packed/packed.h"
#include "tree/packed/wide.h"

#define FILE_VERSION 4u
#define FILE_ALIGN 64u
#define FILE_MAGIC                                                                                                     \
    "\x89"                                                                                                             \
    "froe\r\n\x1a" /* a high byte, a line end and an end of file: text transfers break it */

typedef enum file_id {
    FILE_META = 1,
    FILE_NODES,
    FILE_CUTS,
    FILE_PIECES,
    FILE_BOUNDS,
    FILE_NORMALS,
    FILE_COORDS,
    FILE_KINDS,
    FILE_FORMS,
    FILE_STARTS,
    FILE_CORNERS,
    FILE_RADII,
    FILE_TAGS,
    FILE_FACES,
    FILE_GROUPS,
    FILE_GROUP_TABLE,
    FILE_TEXT,
    FILE_BLOCKS,
    FILE_OWNERS,
    FILE_CRS,
    FILE_FACTS,
    FILE_CELLS,
    FILE_LINES,
    FILE_WIDE,
    FILE_END
} file_id;
#define FILE_SECTIONS ((uint32_t)FILE_END - 1)

typedef struct file_header {
    char magic[8];
    uint32_t version, sections;
    uint64_t size;     /**< of the whole file */
    uint32_t dim;      /**< of the scene */
    uint32_t up;       /**< the axis of a scene in space that points up: 0 z, 1 x, 2 y; otherwise 0 */
    uint32_t crs;      /**< the kind of its coordinate system, see froe_crs_kind */
    uint32_t spare[5]; /**< 0 */
    uint64_t checksum; /**< of the bytes before it, then of the table */
} file_header;

typedef struct file_section {
    uint32_t id, item_size;
    uint64_t offset, size, checksum; /**< size without the zeros that follow */
} file_section;

_Static_assert(sizeof(file_header) == 64 && sizeof(file_section) == 32, "as specified");
_Static_assert(sizeof(tree_meta) == 1264 && sizeof(tree_promise) == 48, "as specified");
_Static_assert(sizeof(tree_node) == 16 && sizeof(tree_cut) == 24 && sizeof(tree_piece) == 8, "as specified");
_Static_assert(sizeof(scene_group) == 20 && sizeof(tree_facts) == 208 && sizeof(wide_node) == 192, "as specified");

/** FROE_E_UNSUPPORTED: this machine does not store numbers as the file does. */
froe_status file_check_machine(froe_diagnostic *diag);
/** Checksum of bytes followed by zeros up to a multiple of 64, continuing `seed` (0 at first). A change within
 * any 8 aligned bytes changes it for certain. */
uint64_t file_checksum(const void *bytes, size_t size, uint64_t seed);
static inline bool file_is_of_tree(file_id id) { /* not of its scene, and not made from other sections */
    return id <= FILE_NORMALS || id == FILE_BLOCKS || id == FILE_OWNERS;
}
/** Where a section of a tree lies in memory: *data (NULL: absent) and its size; returns the size of an item. */
uint32_t file_part(const froe_tree *tree, file_id id, const void **data, uint64_t *size);
static inline uint64_t file_align(uint64_t offset) {
    return (offset + FILE_ALIGN - 1) / FILE_ALIGN * FILE_ALIGN;
}
#endif
