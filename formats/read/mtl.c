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
#include "support/decimal/decimal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_ROOM = 4096, MOST_BYTES = 1 << 24 };

uint32_t formats_material_colour(const formats_materials *materials, const char *name) {
    for (size_t i = materials->count; i-- > 0;) {
        const formats_material *m = materials->data + i;
        if (!strcmp(m->name, name)) return m->coloured && !m->painted ? formats_colour(m->rgba) : 0;
    }
    return 0;
}

/* What follows the word at the beginning of a line; NULL: the line begins with another. */
static const char *after(const char *line, const char *word) {
    const size_t length = strlen(word);
    line += strspn(line, " \t");
    if (strncmp(line, word, length) || !strchr(" \t", line[length]) || !line[length]) return NULL;
    return line + length + strspn(line + length, " \t");
}

/* Kd r g b; one number stands for three. Spectra (Kd spectral, Kd xyz) stay unknown. */
static void read_colour(formats_material *m, const char *at) {
    int count = 0;
    for (char *end; count < 3; count++, at = end) {
        m->rgba[count] = support_decimal(at, &end);
        if (end == at) break;
    }
    m->coloured = count > 0;
    for (; count > 0 && count < 3; count++) m->rgba[count] = m->rgba[count - 1];
}

static void read_share(double *share, const char *at, bool clear) {
    char *end;
    const double value = support_decimal(at, &end);
    if (end != at) *share = clear ? 1 - value : value;
}

froe_status formats_materials_read(formats_sink *sink, const char *path, const char *name,
                                   formats_materials *materials) {
    char library[PATH_ROOM];
    struct stat about;
    formats_text text = {0};
    const char *slash = strrchr(path, '/');
    const int folder = slash ? (int)(slash - path) + 1 : 0,
              length = snprintf(library, PATH_ROOM, "%.*s%s", folder, path, name);
    const bool above = *name == '/' || !strcmp(name, "..") || !strncmp(name, "../", 3) || strstr(name, "/../");
    if (above || length <= 0 || length >= PATH_ROOM || stat(library, &about) || !S_ISREG(about.st_mode) ||
        about.st_size > MOST_BYTES)
        return FROE_OK;
    const formats_source source = {.file = library, .path = library, .size = (uint64_t)about.st_size};
    froe_status status = formats_load(&source, sink, false, &text);
    for (char *line = text.data, *next; !status && line && *line; line = next) {
        next = line + strcspn(line, "\n");
        if (*next) *next++ = '\0';
        const char *at = after(line, "newmtl");
        if (at) {
            size_t kept = strlen(at);
            while (kept && strchr(" \t\r", at[kept - 1])) kept--;
            if (kept >= FORMATS_MATERIAL_NAME) kept = FORMATS_MATERIAL_NAME - 1;
            formats_material m = {.rgba = {0, 0, 0, 1}};
            memcpy(m.name, at, kept);
            if (!array_push(&sink->alloc, materials, m)) status = support_fail_memory(sink->diag);
        } else if (materials->count) {
            formats_material *last = materials->data + materials->count - 1;
            if ((at = after(line, "Kd"))) read_colour(last, at);
            if (after(line, "map_Kd")) last->painted = true;
            if ((at = after(line, "d"))) read_share(last->rgba + 3, at, false);
            if ((at = after(line, "Tr"))) read_share(last->rgba + 3, at, true);
        }
    }
    array_free(&sink->alloc, &text);
    return status == FROE_E_MEMORY ? status : FROE_OK;
}
