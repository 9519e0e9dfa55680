/* file.c: what save and open share: the checksum, and which array is which section. */
#include "tree/file.h"
#include "base/random.h"
#include "support/fail.h"
#include <string.h>

froe_status file_check_machine(froe_diagnostic *diag) {
    const double x = -2.5;
    uint64_t bits;
    uint8_t first;
    memcpy(&bits, &x, sizeof bits);
    memcpy(&first, &bits, 1);                                      /* little-endian: the last byte of the mantissa */
    if (bits == 0xc004000000000000u && first == 0) return FROE_OK; /* one way: this machine is little-endian */
    return support_fail(diag, FROE_E_UNSUPPORTED, "Tree files are little-endian, and this machine is not.");
}

/* Eight lanes of one multiplication and one rotation a word. Each step is a bijection of the
 * lane for a given word and of the word for a given lane, so a change of one word changes the sum for certain. */
static void absorb(uint64_t lanes[8], const uint8_t *block) {
    uint64_t words[8];
    memcpy(words, block, sizeof words);
    for (int i = 0; i < 8; i++) {
        uint64_t x = (lanes[i] ^ words[i]) * 0x9e3779b97f4a7c15u;
        lanes[i] = x << 29 | x >> 35;
    }
}

uint64_t file_checksum(const void *bytes, size_t size, uint64_t seed) {
    const uint8_t *at = bytes;
    uint64_t lanes[8], sum = base_mix(seed + size);
    uint8_t last[64] = {0};
    for (uint64_t i = 0; i < 8; i++) lanes[i] = base_mix(i + 1);
    for (; size >= 64; at += 64, size -= 64) absorb(lanes, at);
    if (size) {
        memcpy(last, at, size);
        absorb(lanes, last);
    }
    for (int i = 0; i < 8; i++) sum = base_mix(sum ^ lanes[i]);
    return sum;
}

typedef struct file_array {
    const void *data;
    uint64_t count;
    uint32_t item_size;
} file_array;

/* What follows from other sections. */
static file_array made_array_of(const froe_tree *t, file_id id) {
    const table_cells *cells = &t->packed.cells;
    const tree_wide *wide = t->packed.wide;
    switch (id) {
    case FILE_FACTS:
        return (file_array){&t->facts, 1, sizeof t->facts};
    case FILE_CELLS:
        return (file_array){cells->nodes, cells->count, sizeof *cells->nodes};
    case FILE_LINES:
        return (file_array){cells->crooked, cells->lines, sizeof *cells->crooked};
    default:
        return (file_array){wide ? wide->nodes : NULL, wide ? wide->count : 0, sizeof(wide_node)};
    }
}

static file_array array_of(const froe_tree *t, file_id id) {
    const froe_scene *s = t->scene;
    const uint64_t objects = s->object_count;
    switch (id) {
    case FILE_META:
        return (file_array){&t->meta, 1, sizeof t->meta};
    case FILE_NODES:
        return (file_array){t->nodes, t->node_count, sizeof *t->nodes};
    case FILE_CUTS:
        return (file_array){t->cuts, t->cut_count, sizeof *t->cuts};
    case FILE_PIECES:
        return (file_array){t->pieces, tree_is_packed(t) ? 0 : t->piece_count, sizeof *t->pieces};
    case FILE_BOUNDS:
        return (file_array){t->bounds, t->bound_count, sizeof *t->bounds};
    case FILE_NORMALS:
        return (file_array){t->normals, t->normal_count, sizeof *t->normals};
    case FILE_COORDS:
        return (file_array){s->coords, (uint64_t)s->vertex_count * (uint64_t)s->dim, sizeof *s->coords};
    case FILE_KINDS:
        return (file_array){s->kind_of, objects, sizeof *s->kind_of};
    case FILE_FORMS:
        return (file_array){s->form_of, objects, sizeof *s->form_of};
    case FILE_STARTS:
        return (file_array){s->start_of, objects + 1, sizeof *s->start_of};
    case FILE_CORNERS:
        return (file_array){s->vertex_of, s->corner_count, sizeof *s->vertex_of};
    case FILE_RADII:
        return (file_array){s->radii, s->radius_count, sizeof *s->radii};
    case FILE_TAGS:
        return (file_array){s->tags, s->tags ? objects : 0, sizeof *s->tags};
    case FILE_FACES:
        return (file_array){s->faces, s->faces ? objects : 0, sizeof *s->faces};
    case FILE_GROUPS:
        return (file_array){s->groups, s->groups ? objects : 0, sizeof *s->groups};
    case FILE_GROUP_TABLE:
        return (file_array){s->group_table, s->group_count, sizeof *s->group_table};
    case FILE_BLOCKS:
        return (file_array){t->packed.blocks, t->packed.block_count, PACKED_BLOCK};
    case FILE_OWNERS:
        return (file_array){t->packed.owners, t->packed.owner_count, sizeof *t->packed.owners};
    case FILE_CRS:
        return (file_array){s->crs, s->crs_size, 1};
    case FILE_TEXT:
        return (file_array){s->text, s->text_size, 1};
    default:
        return made_array_of(t, id);
    }
}

uint32_t file_part(const froe_tree *tree, file_id id, const void **data, uint64_t *size) {
    const file_array p = array_of(tree, id);
    *data = p.data;
    *size = p.count * p.item_size;
    return p.item_size;
}
