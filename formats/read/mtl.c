/* mtl.c: the material library of Wavefront OBJ, as far as faces are painted by it: a name, the diffuse colour and
 * how opaque it is.
 *
 *     newmtl tiles
 *     Kd 0.7 0.3 0.2
 *     d 1                 or Tr 0
 */
#include "formats/read/mtl.h"
#include "formats/input/colour.h"
#include "formats/input/source.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { NAME_ROOM = 128, PATH_ROOM = 4096, MOST_BYTES = 1 << 24 };

typedef struct material {
    char name[NAME_ROOM];
    double rgba[4];
    bool coloured, painted; /* painted: by a picture, the colour only tints it */
} material;

uint32_t formats_material_colour(const formats_materials *materials, const char *name) {
    const material *all = materials->all.data;
    for (size_t i = materials->all.size / sizeof *all; i-- > 0;)
        if (!strcmp(all[i].name, name)) return all[i].coloured && !all[i].painted ? formats_colour(all[i].rgba) : 0;
    return 0;
}

void formats_materials_free(formats_sink *sink, formats_materials *materials) {
    formats_buffer_free(&sink->alloc, &materials->all);
}

/* --------------------------------------------------------------------- reading -- */

/* What follows the word at the beginning of a line; NULL: the line begins with another. */
static const char *after(const char *line, const char *word) {
    const size_t length = strlen(word);
    line += strspn(line, " \t");
    if (strncmp(line, word, length) || !strchr(" \t", line[length]) || !line[length]) return NULL;
    return line + length + strspn(line + length, " \t");
}

static void copy_name(char *to, const char *from) {
    size_t length = strlen(from);
    while (length && strchr(" \t\r", from[length - 1])) length--;
    if (length >= NAME_ROOM) length = NAME_ROOM - 1;
    memcpy(to, from, length);
    to[length] = '\0';
}

/* Kd r g b; one number stands for three. Spectra (Kd spectral, Kd xyz) stay unknown. */
static void read_colour(material *m, const char *at) {
    int count = 0;
    for (char *end; count < 3; count++, at = end) {
        m->rgba[count] = strtod(at, &end);
        if (end == at) break;
    }
    m->coloured = count > 0;
    for (; count > 0 && count < 3; count++) m->rgba[count] = m->rgba[count - 1];
}

static void read_share(double *share, const char *at, bool clear) {
    char *end;
    const double value = strtod(at, &end);
    if (end != at) *share = clear ? 1 - value : value;
}

static froe_status read_line(formats_sink *sink, formats_materials *materials, const char *line) {
    const char *name = after(line, "newmtl"), *at;
    if (name) {
        material *m = formats_buffer_add(&sink->alloc, &materials->all, sizeof *m);
        if (!m) return support_fail_memory(sink->diag);
        *m = (material){.rgba = {0, 0, 0, 1}};
        copy_name(m->name, name);
    } else if (materials->all.size) {
        material *last = (material *)materials->all.data + materials->all.size / sizeof *last - 1;
        if ((at = after(line, "Kd"))) read_colour(last, at);
        if (after(line, "map_Kd")) last->painted = true;
        if ((at = after(line, "d"))) read_share(last->rgba + 3, at, false);
        if ((at = after(line, "Tr"))) read_share(last->rgba + 3, at, true);
    }
    return FROE_OK;
}

/* A name at or below the folder of the OBJ, as a path. False: it is none. */
static bool find_material(const char *path, const char *name, char out[PATH_ROOM]) {
    const char *slash = strrchr(path, '/');
    const int folder = slash ? (int)(slash - path) + 1 : 0;
    if (*name == '/' || !strcmp(name, "..") || !strncmp(name, "../", 3) || strstr(name, "/../")) return false;
    const int length = snprintf(out, PATH_ROOM, "%.*s%s", folder, path, name);
    struct stat about;
    return length > 0 && length < PATH_ROOM && !stat(out, &about) && S_ISREG(about.st_mode) &&
           about.st_size <= MOST_BYTES;
}

froe_status formats_materials_read(formats_sink *sink, const char *path, const char *name,
                                   formats_materials *materials) {
    char library[PATH_ROOM];
    struct stat about;
    formats_buffer text = {0};
    if (!find_material(path, name, library) || stat(library, &about)) return FROE_OK;
    const formats_source source = {.path = library, .size = (uint64_t)about.st_size};
    froe_status status = formats_load(&source, sink, false, &text);
    for (char *line = text.data, *next; !status && line && *line; line = next) {
        next = line + strcspn(line, "\n");
        if (*next) *next++ = '\0';
        status = read_line(sink, materials, line);
    }
    formats_buffer_free(&sink->alloc, &text);
    return status == FROE_E_MEMORY ? status : FROE_OK;
}
