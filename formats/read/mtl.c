/* mtl.c: the material library of Wavefront OBJ, as far as faces are painted by it: a name, the diffuse colour, its
 * texture, and how opaque it is.
 *
 *     newmtl tiles
 *     Kd 0.7 0.3 0.2
 *     d 1                 or Tr 0
 *     map_Kd -clamp on -s 2 2 1 -o 0 0.5 0 tiles of clay.png
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

const formats_material *formats_material_find(const formats_materials *materials, const char *name) {
    for (size_t i = materials->count; i-- > 0;)
        if (!strcmp(materials->data[i].name, name)) return materials->data + i;
    return NULL;
}

/* Tints of textures are shares of sRGB. Black ones are what programs write that do not tint. */
static bool is_tinted(const formats_material *m) {
    return m->coloured && (m->rgba[0] > 0 || m->rgba[1] > 0 || m->rgba[2] > 0);
}

/* A texture is meant to be seen: MeshLab writes Tr 1 for opaque ones. */
static double textured_opacity(const formats_material *m) {
    return m->rgba[3] > 0 ? m->rgba[3] : 1;
}

uint32_t formats_material_colour(const formats_material *m) {
    if (!m || !m->coloured) return 0;
    if (!m->textured) return formats_colour(m->rgba);
    if (m->texture.image.pixels || !is_tinted(m)) return 0;
    return formats_colour((const double[4]){m->rgba[0], m->rgba[1], m->rgba[2], textured_opacity(m)});
}

uint32_t formats_material_texel(const formats_material *m, const double *corners, const double *places, size_t count) {
    double texel[4];
    if (!formats_texture_mean(&m->texture, corners, places, count, texel)) return 0;
    const bool tinted = is_tinted(m);
    for (int k = 0; k < 3; k++) texel[k] = formats_level(texel[k]) / 255.0 * (tinted ? m->rgba[k] : 1);
    texel[3] *= textured_opacity(m);
    return formats_step_colour(formats_colour(texel));
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
        m->rgba[count] = support_decimal_ahead(at, &end);
        if (end == at) break;
    }
    m->coloured = count > 0;
    for (; count > 0 && count < 3; count++) m->rgba[count] = m->rgba[count - 1];
}

static void read_share(double *share, const char *at, bool clear) {
    char *end;
    const double value = support_decimal_ahead(at, &end);
    if (end != at) *share = clear ? 1 - value : value;
}

/* Options, then the name of the image, which may have blanks. */
static void read_texture(formats_material *m, const char *at) {
    formats_texture *t = &m->texture;
    m->textured = true;
    while (*at == '-') {
        const size_t length = strcspn(at, " \t");
        const bool scale = !strncmp(at, "-s", length), offset = !strncmp(at, "-o", length),
                   numbers = scale || offset || !strncmp(at, "-t", length) || !strncmp(at, "-mm", length);
        const char *value = at + length + strspn(at + length, " \t");
        int k = 0;
        for (char *end; numbers && k < 3; k++, value = end + strspn(end, " \t")) {
            const double x = strtod(value, &end);
            if (end == value || !strchr(" \t", *end)) break;
            if (k < 2 && scale) t->scale[k] = x;
            if (k < 2 && offset) t->offset[k] = x;
        }
        if (!numbers && !strncmp(at, "-clamp", length))
            t->wrap[0] = t->wrap[1] = strncmp(value, "on", 2) ? FORMATS_REPEAT : FORMATS_CLAMP;
        if (!numbers) value += strcspn(value, " \t"), value += strspn(value, " \t");
        at = value;
    }
    size_t kept = strlen(at);
    while (kept && strchr(" \t\r", at[kept - 1])) kept--;
    if (kept >= sizeof m->image) kept = 0;
    memcpy(m->image, at, kept);
    m->image[kept] = '\0';
    for (char *c = m->image; *c; c++) *c = *c == '\\' ? '/' : *c;
}

static froe_status read_images(formats_sink *sink, const char *path, formats_materials *materials, size_t first,
                               formats_images *images) {
    froe_status status = FROE_OK;
    for (size_t i = first; i < materials->count && !status && !sink->boxes; i++) {
        formats_material *m = materials->data + i;
        if (m->textured) status = formats_image_find(sink, path, m->image, NULL, 0, images, &m->texture.image);
    }
    return status;
}

/* A library that cannot be read is no failure: it is told in the report. Boxes have no colours. */
static froe_status note_unread(formats_sink *sink, const char *name) {
    char *told = sink->report.unread_library;
    if (!*told && !sink->boxes) snprintf(told, sizeof sink->report.unread_library, "%.63s", name);
    return FROE_OK;
}

/* Appends a material whose name is the rest of a line, without the blanks behind it. */
static froe_status begin_material(formats_sink *sink, const char *at, formats_materials *materials) {
    size_t kept = strlen(at);
    while (kept && strchr(" \t\r", at[kept - 1])) kept--;
    const formats_material m = {
        .name = support_calloc(&sink->alloc, kept + 1, 1), .rgba = {0, 0, 0, 1}, .texture = {.scale = {1, 1}}};
    if (m.name && array_push(&sink->alloc, materials, m)) return memcpy(m.name, at, kept), FROE_OK;
    support_free(&sink->alloc, m.name, kept + 1);
    return support_fail_memory(sink->diag);
}

void formats_materials_free(const froe_allocator *alloc, formats_materials *materials) {
    for (size_t i = 0; i < materials->count; i++)
        support_free(alloc, materials->data[i].name, strlen(materials->data[i].name) + 1);
    array_free(alloc, materials);
}

froe_status formats_materials_read(formats_sink *sink, const char *path, const char *name, formats_materials *materials,
                                   formats_images *images) {
    char library[PATH_ROOM];
    struct stat about;
    formats_text text = {0};
    const char *slash = strrchr(path, '/');
    const int folder = slash ? (int)(slash - path) + 1 : 0,
              length = snprintf(library, PATH_ROOM, "%.*s%s", folder, path, name);
    const bool above = *name == '/' || !strcmp(name, "..") || !strncmp(name, "../", 3) || strstr(name, "/../");
    if (above || length <= 0 || length >= PATH_ROOM || stat(library, &about) || !S_ISREG(about.st_mode) ||
        about.st_size > MOST_BYTES)
        return note_unread(sink, name);
    const size_t first = materials->count;
    const formats_source source = {.file = library, .path = library, .size = (uint64_t)about.st_size};
    froe_status status = formats_load(&source, sink, false, &text);
    for (char *line = text.data, *next; !status && line && *line; line = next) {
        next = line + strcspn(line, "\n");
        if (*next) *next++ = '\0';
        const char *at = after(line, "newmtl");
        if (at) {
            status = begin_material(sink, at, materials);
        } else if (materials->count) {
            formats_material *last = materials->data + materials->count - 1;
            if ((at = after(line, "Kd"))) read_colour(last, at);
            if ((at = after(line, "map_Kd"))) read_texture(last, at);
            if ((at = after(line, "d"))) read_share(last->rgba + 3, at, false);
            if ((at = after(line, "Tr"))) read_share(last->rgba + 3, at, true);
        }
    }
    array_free(&sink->alloc, &text);
    if (status && status != FROE_E_MEMORY) note_unread(sink, name);
    if (status != FROE_E_MEMORY) status = read_images(sink, path, materials, first, images);
    return status == FROE_E_MEMORY ? status : FROE_OK;
}
