/* open.c: a saved tree by mapping its file, or from a copy of it or of its bytes. Nothing in it is used before it has
 * been checked. What has no size is checked here: header and table, the places of sections, description, facts and the
 * coordinate system. The rest is checked when it is first asked for (gate.h).
 *
 * The mapping is private and read-only. If another program shortens the file while it is
 * mapped, its pages are lost (SIGBUS), but for froe_tree_open_copy(). froe itself replaces files and never shortens
 * them. */
#include "base/floats.h"
#include "num/context.h"
#include "support/fail.h"
#include "tree/file.h"
#include "tree/gate.h"
#include "tree/packed/table.h"
#include "tree/validate.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct opening {
    const char *path;
    froe_diagnostic *diag;
    void *map; /* what the bytes lie in */
    size_t map_size;
    bool copied; /* see froe_scene */
    const uint8_t *bytes;
    size_t size;
    const file_header *header;
    const file_section *table;
    froe_scene scene; /* arrays as the file claims them */
} opening;

static froe_status bad_file(const opening *o, const char *what) {
    return support_fail(o->diag, FROE_E_FORMAT, "%s: It is no valid tree file, because %s.", support_short(o->path),
                        what);
}

static froe_status unreadable(const opening *o, int error) {
    return support_fail_file(o->diag, "read", o->path, error);
}

/* -------------------------------------------------------------------- file -- */

static froe_status check_size(const opening *o, uint64_t size) {
    if (size >= sizeof(file_header)) return FROE_OK;
    return bad_file(o, size ? "it is too short" : "it is empty");
}

/* The file's descriptor, and its size as o->size. */
static froe_status open_file(opening *o, int *fd) {
    *fd = open(o->path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* opening a pipe must not block */
    froe_status status = FROE_OK;
    struct stat info;
    if (*fd < 0) return unreadable(o, errno);
    if (fstat(*fd, &info))
        status = unreadable(o, errno);
    else if (!S_ISREG(info.st_mode))
        status = support_fail_irregular(o->diag, o->path, info.st_mode);
    else
        status = check_size(o, (uint64_t)info.st_size);
    if (status)
        close(*fd);
    else
        o->size = (size_t)info.st_size;
    return status;
}

static froe_status map_file(opening *o) {
    int fd;
    froe_status status = open_file(o, &fd);
    if (status) return status;
    void *map = mmap(NULL, o->size, PROT_READ, MAP_PRIVATE, fd, 0);
    if (map == MAP_FAILED) status = unreadable(o, errno);
    o->bytes = o->map = map;
    o->map_size = o->size;
    close(fd);
    return status;
}

/* Memory for o->size bytes, where they are aligned; NULL: there is none. */
static uint8_t *make_room(opening *o, const froe_allocator *alloc) {
    o->copied = true;
    o->map_size = o->size + FILE_ALIGN;
    o->map = o->size < SIZE_MAX - FILE_ALIGN ? support_realloc(alloc, NULL, 0, o->map_size) : NULL;
    uint8_t *room = o->map ? (uint8_t *)o->map + (FILE_ALIGN - (uintptr_t)o->map % FILE_ALIGN) % FILE_ALIGN : NULL;
    o->bytes = room;
    return room;
}

/* A file that has become shorter meanwhile is read as far as it goes. */
static froe_status read_bytes(opening *o, int fd, uint8_t *to) {
    size_t count = 0;
    for (ssize_t got = 1; count < o->size && got;) {
        got = read(fd, to + count, o->size - count);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return unreadable(o, errno);
        count += (size_t)got;
    }
    o->size = count;
    return check_size(o, count);
}

static froe_status read_file(opening *o, const froe_allocator *alloc) {
    int fd;
    froe_status status = open_file(o, &fd);
    if (status) return status;
    uint8_t *room = make_room(o, alloc);
    status = room ? read_bytes(o, fd, room) : support_fail_memory(o->diag);
    if (room && status) support_free(alloc, o->map, o->map_size);
    close(fd);
    return status;
}

static froe_status copy_bytes(opening *o, const void *bytes, size_t size, const froe_allocator *alloc) {
    const froe_status status = check_size(o, size);
    o->size = size;
    if (status) return status;
    uint8_t *room = make_room(o, alloc);
    if (!room) return support_fail_memory(o->diag);
    memcpy(room, bytes, size);
    return FROE_OK;
}

/* ------------------------------------------------------------------ layout -- */

static bool is_read_at_once(uint32_t id) {
    return id == FILE_META || id == FILE_FACTS || id == FILE_CRS;
}

/* Sections lie in the order of their ids, without gaps but for the zeros that align them. */
static froe_status check_layout(opening *o) {
    const file_header *h = o->header = (const file_header *)(const void *)o->bytes;
    const size_t table = FILE_SECTIONS * sizeof(file_section);
    if (memcmp(h->magic, FILE_MAGIC, sizeof h->magic) != 0) return bad_file(o, "it does not begin as one");
    if (h->version != FILE_VERSION)
        return support_fail(o->diag, FROE_E_FORMAT,
                            "%s: It is a tree file of version %u, and this froe reads version %u: %s.",
                            support_short(o->path), h->version, FILE_VERSION,
                            h->version < FILE_VERSION ? "build it again from its scene"
                                                      : "open it with a newer froe, or build it again from its scene");
    if (h->size != o->size) return bad_file(o, h->size > o->size ? "it is truncated" : "something follows its end");
    if (h->sections != FILE_SECTIONS || o->size < sizeof *h + table) return bad_file(o, "its section table is wrong");
    o->table = (const file_section *)(const void *)(o->bytes + sizeof *h);
    if (h->checksum != file_checksum(o->table, table, file_checksum(h, offsetof(file_header, checksum), 0)))
        return bad_file(o, "the checksum of its header is wrong");
    if (h->up > (h->dim == 3 ? 2 : 0)) return bad_file(o, "the axis that points up is wrong");
    for (size_t i = 0; i < sizeof h->spare / sizeof *h->spare; i++)
        if (h->spare[i]) return bad_file(o, "an unused field is not 0");
    if (h->dim < 2 || h->dim > FROE_MAX_DIM) return bad_file(o, "its dimension is wrong");
    const froe_scene none = {.dim = 0};
    const froe_tree empty = {.scene = (froe_scene *)&none};
    uint64_t end = sizeof *h + table, size;
    const void *data;
    for (uint32_t i = 0; i < FILE_SECTIONS; i++) {
        const file_section *s = o->table + i;
        uint64_t offset = file_align(end);
        if (s->id != i + 1 || s->item_size != file_part(&empty, (file_id)s->id, &data, &size))
            return bad_file(o, "it has a section of unknown kind");
        if (s->offset != offset || offset > o->size || s->size > o->size - offset)
            return bad_file(o, "a section is out of place");
        /* one way: a section of 2^32 items needs a file of 4 GB */
        if (s->size % s->item_size || s->size / s->item_size > UINT32_MAX)
            return bad_file(o, "a section is of odd size");
        if (is_read_at_once(s->id) && s->checksum != file_checksum(o->bytes + offset, s->size, 0))
            return bad_file(o, "the checksum of a section is wrong");
        end = offset + s->size;
    }
    if (file_align(end) != o->size) return bad_file(o, "something follows its end");
    return FROE_OK;
}

/* Array of a section, NULL when it is empty. */
static void *section(const opening *o, file_id id, uint32_t *count) {
    const file_section *s = o->table + id - 1;
    *count = (uint32_t)(s->size / s->item_size);
    return s->size ? (void *)(uintptr_t)(o->bytes + s->offset) : NULL;
}

#define MISFIT "its sections do not fit together"

static bool optional(uint32_t count, uint32_t objects) {
    return count == 0 || count == objects;
}

/* The arrays of the scene, as the file claims them. */
static froe_status claim_scene(opening *o) {
    froe_scene *s = &o->scene;
    uint32_t coords, forms, starts, tags, faces, groups, text;
    s->dim = (int)o->header->dim;
    s->up = s->dim == 3 ? (int)(o->header->up + 2) % 3 : -1;
    s->coords = section(o, FILE_COORDS, &coords);
    s->kind_of = section(o, FILE_KINDS, &s->object_count);
    s->form_of = section(o, FILE_FORMS, &forms);
    s->start_of = section(o, FILE_STARTS, &starts);
    s->vertex_of = section(o, FILE_CORNERS, &s->corner_count);
    s->radii = section(o, FILE_RADII, &s->radius_count);
    s->tags = section(o, FILE_TAGS, &tags);
    s->faces = section(o, FILE_FACES, &faces);
    s->groups = section(o, FILE_GROUPS, &groups);
    s->group_table = section(o, FILE_GROUP_TABLE, &s->group_count);
    s->text = section(o, FILE_TEXT, &text);
    s->text_size = text;
    s->crs_kind = (froe_crs_kind)o->header->crs;
    s->crs = section(o, FILE_CRS, &s->crs_size);
    s->vertex_count = coords / o->header->dim;
    bool fits = coords % o->header->dim == 0 && forms == s->object_count && starts == (uint64_t)s->object_count + 1 &&
                optional(tags, forms) && optional(faces, forms) && optional(groups, forms);
    if (!fits) return bad_file(o, MISFIT);
    return FROE_OK;
}

/* Facts that the sizes of the sections exclude would cost memory. */
static bool facts_are_possible(const froe_tree *t, const froe_scene *s) {
    const tree_facts *f = &t->facts;
    const uint64_t bytes = (uint64_t)t->packed.block_count * PACKED_BLOCK;
    bool possible = tree_is_packed(t) ? f->pieces <= TREE_MOST && 12 * f->pieces <= bytes : f->pieces == t->piece_count;
    possible = possible && 2 * (f->height & UINT32_MAX) < t->node_count && f->height < t->node_count &&
               f->max_leaf <= f->pieces && f->leaves <= t->node_count && isfinite(f->mean_depth);
    for (int k = 0; k < FROE_MAX_DIM; k++)
        possible = possible && isfinite(f->lo[k]) && isfinite(f->hi[k]) && f->lo[k] <= f->hi[k] &&
                   ((s->object_count && k < s->dim) || (f->lo[k] == 0 && f->hi[k] == 0));
    return possible;
}

/* Description and facts, and what is known by them. */
static froe_status claim_description(opening *o, froe_tree *t) {
    froe_scene *s = &o->scene;
    uint32_t metas, facts;
    const void *meta = section(o, FILE_META, &metas), *known = section(o, FILE_FACTS, &facts);
    if (metas != 1 || facts != 1) return bad_file(o, "its description is wrong");
    memcpy(&t->meta, meta, sizeof t->meta);
    memcpy(&t->facts, known, sizeof t->facts);
    t->scene = s; /* for these checks alone */
    const bool fits = tree_meta_fits(t) && facts_are_possible(t, s);
    t->scene = NULL;
    if (!fits) return bad_file(o, "its description is wrong");
    for (int k = 0; k < FROE_MAX_DIM; k++) {
        const bool there = s->object_count && k < s->dim;
        s->lo[k] = there ? t->facts.lo[k] : (double)INFINITY;
        s->hi[k] = there ? t->facts.hi[k] : -(double)INFINITY;
    }
    if (tree_is_packed(t)) t->piece_count = (uint32_t)t->facts.pieces;
    return FROE_OK;
}

/* The arrays of the tree, as the file claims them; those of the scene are claimed. */
static froe_status claim_tree(opening *o, froe_tree *t) {
    t->nodes = section(o, FILE_NODES, &t->node_count);
    t->cuts = section(o, FILE_CUTS, &t->cut_count);
    t->pieces = section(o, FILE_PIECES, &t->piece_count);
    t->bounds = section(o, FILE_BOUNDS, &t->bound_count);
    t->normals = section(o, FILE_NORMALS, &t->normal_count);
    t->packed.blocks = section(o, FILE_BLOCKS, &t->packed.block_count);
    t->packed.owners = section(o, FILE_OWNERS, &t->packed.owner_count);
    if (tree_is_packed(t) && (t->piece_count || o->scene.dim > 3)) return bad_file(o, MISFIT);
    return t->node_count ? claim_description(o, t) : bad_file(o, "it has no root");
}

/* Sections that follow from others; tree and scene are one. */
static froe_status claim_made(opening *o, froe_tree *t) {
    uint32_t cells, lines, wide;
    const table_cells shape = tree_table_shape(t);
    t->packed.cells.nodes = section(o, FILE_CELLS, &cells);
    t->packed.cells.crooked = section(o, FILE_LINES, &lines);
    t->packed.cells.count = cells;
    t->packed.cells.lines = lines;
    wide_node *nodes = section(o, FILE_WIDE, &wide);
    if (cells != shape.count || lines != shape.lines) return bad_file(o, MISFIT);
    const froe_status status = tree_wide_from(t, nodes, wide, t->facts.levels, &t->packed.wide);
    if (status == FROE_E_MEMORY) return support_fail_memory(o->diag);
    return status ? bad_file(o, MISFIT) : FROE_OK;
}

/* ------------------------------------------------------------------- whole -- */

bool froe_is_tree(const char *path) {
    enum { WORD = 5 }; /* bytes of the magic that no transfer of text changes */
    char head[WORD];
    struct stat about;
    if (!path || stat(path, &about) || !S_ISREG(about.st_mode)) return false; /* opening a pipe would disturb it */
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return false;
    const bool is = read(file, head, WORD) == WORD && !memcmp(head, FILE_MAGIC, WORD);
    close(file);
    return is;
}

/* The tree in the bytes, which go with its scene, or on failure at once. */
static froe_status open_bytes(opening *o, const froe_allocator *alloc, froe_tree **out) {
    froe_tree *t = support_calloc(alloc, 1, sizeof *t);
    froe_status status = t ? FROE_OK : support_fail_memory(o->diag);
    if (t) t->alloc = *alloc, t->mapped = true;
    if (!status) status = check_layout(o);
    if (!status) status = claim_scene(o);
    if (!status) status = claim_tree(o, t);
    if (!status) status = scene_mapped(&o->scene, alloc, &t->scene, o->diag);
    if (!status) status = claim_made(o, t);
    if (!status && (tree_gate_new(alloc, o->bytes, o->size, &t->gate) || tree_show(t)))
        status = support_fail_memory(o->diag);
    if (!status) {
        t->scene->map = o->map;
        t->scene->map_size = o->map_size;
        t->scene->copied = o->copied;
        *out = t;
        return FROE_OK;
    }
    froe_tree_free(t);
    if (o->copied)
        support_free(alloc, o->map, o->map_size);
    else
        munmap(o->map, o->map_size);
    return status;
}

static froe_status check_machine(froe_diagnostic *diag) {
    const froe_status status = file_check_machine(diag);
    return status ? status : num_rounding_check(diag);
}

static froe_status open_path(opening *o, bool mapped, const froe_allocator *caller, froe_tree **out) {
    const froe_allocator alloc = support_allocator(caller);
    froe_status status = check_machine(o->diag);
    if (!status) status = mapped ? map_file(o) : read_file(o, &alloc);
    return status ? status : open_bytes(o, &alloc, out);
}

froe_status froe_tree_open(const char *path, const froe_allocator *caller, froe_tree **out, froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    opening o = {.path = path, .diag = diag};
    if (!path || !out) return support_fail_null(diag, __func__);
    return open_path(&o, true, caller, out);
}

froe_status froe_tree_open_copy(const char *path, const froe_allocator *caller, froe_tree **out,
                                froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    opening o = {.path = path, .diag = diag};
    if (!path || !out) return support_fail_null(diag, __func__);
    return open_path(&o, false, caller, out);
}

froe_status froe_tree_open_memory(const void *bytes, size_t count, const froe_allocator *caller, froe_tree **out,
                                  froe_diagnostic *diag) {
    BASE_FLOATS_OWN;
    opening o = {.path = "memory", .diag = diag};
    if ((count && !bytes) || !out) return support_fail_null(diag, __func__);
    const froe_allocator alloc = support_allocator(caller);
    froe_status status = check_machine(diag);
    if (!status) status = copy_bytes(&o, bytes, count, &alloc);
    return status ? status : open_bytes(&o, &alloc, out);
}
