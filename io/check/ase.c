/* ase.c: whether an ASE file (of 3ds Max) lists as many vertices and faces as it counts, and faces name corners that
 * exist. For vertices that are not there assimp takes the origin, and for faces and corners any memory.
 *
 *     *MESH { *MESH_NUMVERTEX 3  *MESH_NUMFACES 1
 *       *MESH_VERTEX_LIST { *MESH_VERTEX 0  0.0 0.0 0.0 ... }
 *       *MESH_FACE_LIST { *MESH_FACE 0: A: 0 B: 1 C: 2 ... }
 *       *MESH_NUMTVERTEX 3 ... *MESH_TFACE 0  0 1 2 ... }       places in a texture; with a C: colours
 */
#include "check/check.h"
#include <stdlib.h>
#include <string.h>

bool io_is_ase(const formats_source *source) {
    return !strcmp(source->extension.text, "ase") || !strcmp(source->extension.text, "ask");
}

typedef struct ase_check {      /* of a mesh: its vertices, places in a texture and colours */
    size_t counted[3], faces;   /* as the file counts */
    size_t vertices, listed[3]; /* so far: vertices, and faces of each kind */
} ase_check;

static const char blanks[] = " \t", digits[] = "0123456789";

/* What stands behind a word; NULL: it is another one. */
static const char *behind(const char *at, const char *word) {
    const size_t length = strlen(word);
    return !strncmp(at, word, length) && strchr(" \t\r\n", at[length]) ? at + length : NULL;
}

/* Passes a whole number and blanks around it; false: there is none. */
static bool pass_number(const char **at, size_t *number) {
    char *end;
    *at += strspn(*at, blanks);
    if (!strspn(*at, digits)) return false;
    *number = strtoul(*at, &end, 10);
    *at = end + strspn(end, blanks);
    return true;
}

/* Is it a number, and the next one? */
static bool is_next(const char **at, size_t *listed) {
    size_t number;
    return pass_number(at, &number) && number == (*listed)++;
}

/* Passes `A:` or another letter of a corner; false: it is none. */
static bool pass_letter(const char **at, unsigned *seen) {
    *at += strspn(*at, blanks);
    if (strspn(*at, "ABCabc") != 1) return false;
    *seen |= 1u << (**at & 3); /* 1 to 3, in either case */
    *at += 1 + strspn(*at + 1, blanks);
    return *(*at)++ == ':';
}

static const char *look_at_corners(const char *at, bool letters, size_t count) {
    static const char broken[] = "A face is not three corners.";
    unsigned seen = 0;
    at += *at == ':';
    for (int i = 0; i < 3; i++) {
        size_t corner;
        if ((letters && !pass_letter(&at, &seen)) || !pass_number(&at, &corner)) return broken;
        if (corner >= count) return "A face names a vertex that does not exist.";
    }
    return letters && seen != 14 ? broken : NULL;
}

/* At the end of its lists of that kind. */
static const char *look_at_lists(const ase_check *c, int kind) {
    if (!kind && c->vertices != c->counted[0]) return "The mesh has fewer vertices than it counts.";
    const bool used = !kind || c->counted[kind];
    return used && c->listed[kind] != c->faces ? "The mesh has another number of faces than it counts." : NULL;
}

static const char *look_at_mesh(const ase_check *c) {
    const char *fault = NULL;
    for (int kind = 0; kind < 3 && !fault; kind++) fault = look_at_lists(c, kind);
    return fault;
}

static const char *look_at_ase_word(ase_check *c, const char *at) {
    static const char *const counts[] = {"MESH_NUMVERTEX", "MESH_NUMTVERTEX", "MESH_NUMCVERTEX"};
    static const char *const faces[] = {"MESH_FACE", "MESH_TFACE", "MESH_CFACE"};
    static const char order[] = "Vertices and faces are not numbered from 0 on.";
    const char *next, *fault = NULL;
    if (behind(at, "MESH")) {
        fault = look_at_mesh(c);
        *c = (ase_check){.faces = 0};
    }
    if ((next = behind(at, "MESH_NUMFACES"))) c->faces = strtoul(next, NULL, 10);
    if ((next = behind(at, "MESH_VERTEX")) && !is_next(&next, &c->vertices)) fault = order;
    for (int kind = 0; kind < 3 && !fault; kind++) {
        if ((next = behind(at, counts[kind]))) { /* a mesh may have several textures */
            if (kind) fault = look_at_lists(c, kind);
            c->counted[kind] = strtoul(next, NULL, 10), c->listed[kind] = 0;
        }
        if (!(next = behind(at, faces[kind]))) continue;
        const bool used = !kind || c->counted[kind];
        fault = !is_next(&next, c->listed + kind) ? order
                : used                            ? look_at_corners(next, !kind, c->counted[kind])
                                                  : NULL;
    }
    return fault;
}

static io_fault find_ase_fault(formats_sink *sink, const char *text) {
    ase_check c = {.faces = 0};
    size_t line = 1;
    const char *fault = NULL;
    (void)sink;
    for (const char *at = text; !fault && *at; at++) {
        line += *at == '\n';
        if (*at == '*') fault = look_at_ase_word(&c, at + 1);
    }
    return (io_fault){fault ? fault : look_at_mesh(&c), line, FROE_E_FORMAT};
}

froe_status io_ase_check(const formats_source *source, formats_sink *sink) {
    return io_text_look(source, sink, false, find_ase_fault);
}
