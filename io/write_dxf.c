/* write_dxf.c: the lines of a picture as a drawing in DXF. GDAL writes the entities, each on the layer of its lines,
 * and what surrounds them. */
#include "dxf.h"
#include "heard.h"
#include "support/fail.h"
#include "support/floats.h"
#include "support/utf8.h"
#include "support/writer.h"
#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <ctype.h>
#include <froe/io.h>
#include <gdal.h>
#include <math.h>
#include <ogr_api.h>
#include <stdio.h>

typedef struct dxf_line {
    uint32_t layer, colour;
    size_t first, count; /* of its points */
} dxf_line;

/* A drawing in the making: all lines, then their layers, then the file. */
typedef struct dxf_drawing {
    froe_allocator alloc;
    const froe_scene *scene;
    const froe_render_options *options;
    dxf_layers layers;
    ARRAY(dxf_line) lines;
    ARRAY(double) points; /* y upwards */
    dxf_text header;
    bool full; /* without memory */
    io_heard heard;
} dxf_drawing;

/* ------------------------------------------------------------------------- layers -- */

/* Appends a name in characters that every program takes for the same: ASCII in capitals, U+00FC for others. Signs that
 * DXF does not have become underscores. (GDAL takes the backslash of DXF's own \U+00FC for such a sign.) */
static void put_name(char name[DXF_NAME], const char *text) {
    size_t used = strlen(name);
    while (*text && used + 10 < DXF_NAME) {
        const size_t length = support_utf8_length(text);
        uint32_t number = (unsigned char)*text & (length > 1 ? 0x7Fu >> length : 0x7Fu);
        for (size_t i = 1; i < length; i++) number = number << 6 | (text[i] & 0x3Fu);
        if (!length || number < 0x20 || number == 0x7F || (number < 0x7F && strchr("<>/\\\":;?*|=',`", (int)number)))
            name[used++] = '_';
        else if (length == 1)
            name[used++] = (char)toupper((int)number);
        else
            used += (size_t)snprintf(name + used, DXF_NAME - used, "U+%04X", number);
        text += length ? length : 1;
    }
    name[used] = '\0';
}

/* The number of the layer of a path, which may be a new one. */
static bool find_layer(dxf_drawing *d, const froe_render_path *path, uint32_t *out) {
    dxf_layer layer = {.colour = path->colour & 0xFFFFFF, .width = path->width, .dash = path->dash, .gap = path->gap};
    if (d->options->layers == FROE_LAYERS_OBJECT) {
        if (path->layer != FROE_NONE) put_name(layer.name, froe_scene_group(d->scene, path->layer).name);
        if (*layer.name) put_name(layer.name, "-");
    }
    put_name(layer.name, path->hidden ? "hidden" : "visible");
    if (d->options->layers != FROE_LAYERS_OBJECT) {
        put_name(layer.name, "-");
        put_name(layer.name, froe_line_name(path->kind));
    }
    for (*out = 0; *out < d->layers.count; ++*out)
        if (!strcmp(d->layers.data[*out].name, layer.name)) return true;
    return array_push(&d->alloc, &d->layers, layer);
}

static bool keep_path(void *user, const froe_render_path *path) {
    SUPPORT_FLOATS_OWN;
    dxf_drawing *d = user;
    uint32_t layer;
    if (!path->lines) return true;
    d->full = !find_layer(d, path, &layer);
    for (size_t i = 0; !d->full && i < path->count; i++) {
        const froe_outline *o = path->outlines + i;
        const dxf_line line = {layer, path->colour & 0xFFFFFF, d->points.count / 2,
                               o->count + (o->closed && o->count > 1)};
        d->full = !array_push(&d->alloc, &d->lines, line) || !array_reserve(&d->alloc, &d->points, 2 * line.count);
        for (size_t k = 0; !d->full && k < line.count; k++) {
            const double *p = o->points + 2 * (k % o->count);
            d->points.data[d->points.count++] = p[0];
            d->points.data[d->points.count++] = d->options->camera.height - p[1];
        }
    }
    return !d->full;
}

/* ------------------------------------------------------------------------ writing -- */

static bool put_entity(const dxf_drawing *d, OGRLayerH out, const dxf_line *line) {
    const double *p = d->points.data + 2 * line->first;
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(out));
    OGRGeometryH geometry = OGR_G_CreateGeometry(line->count > 1 ? wkbLineString : wkbPoint);
    for (size_t k = 0; k < line->count; k++) OGR_G_AddPoint_2D(geometry, p[2 * k], p[2 * k + 1]);
    OGR_F_SetFieldString(feature, OGR_F_GetFieldIndex(feature, "Layer"), d->layers.data[line->layer].name);
    if (line->colour != d->layers.data[line->layer].colour) {
        char style[24];
        snprintf(style, sizeof style, "PEN(c:#%06x)", line->colour == FROE_LINE_COLOUR ? 0 : line->colour);
        OGR_F_SetStyleString(feature, style);
    }
    OGR_F_SetGeometryDirectly(feature, geometry);
    const bool ok = OGR_L_CreateFeature(out, feature) == OGRERR_NONE;
    OGR_F_Destroy(feature);
    return ok;
}

/* GDAL writes into memory; then the file appears whole or not at all. */
static froe_status write_drawing(dxf_drawing *d, const char *path, uint64_t *bytes, froe_diagnostic *diag) {
    char head[64], name[64], option[80];
    snprintf(head, sizeof head, "/vsimem/froe-%p.header.dxf", (void *)d);
    snprintf(name, sizeof name, "/vsimem/froe-%p.dxf", (void *)d);
    snprintf(option, sizeof option, "HEADER=%s", head);
    char *options[] = {option, NULL};
    GDALDriverH driver = GDALGetDriverByName("DXF");
    VSILFILE *file = VSIFileFromMemBuffer(head, (GByte *)d->header.data, d->header.count, FALSE);
    if (file) VSIFCloseL(file);
    GDALDatasetH data = driver && file ? GDALCreate(driver, name, 0, 0, 0, GDT_Unknown, options) : NULL;
    OGRLayerH out = data ? GDALDatasetCreateLayer(data, "entities", NULL, wkbUnknown, NULL) : NULL;
    bool ok = out != NULL;
    for (size_t i = 0; ok && i < d->lines.count; i++) ok = put_entity(d, out, d->lines.data + i);
    if (data) GDALClose(data);
    vsi_l_offset count = 0;
    const GByte *text = VSIGetMemFileBuffer(name, &count, FALSE);
    froe_status status = FROE_OK;
    if (!ok || d->heard.failed || !text)
        status = io_gdal_fail(&d->heard, diag, FROE_E_UNSUPPORTED, path, "GDAL has no driver that writes DXF.");
    if (!status) status = support_write(path, text, count, &d->alloc, diag);
    *bytes = count;
    VSIUnlink(name);
    VSIUnlink(head);
    return status;
}

froe_status froe_render_dxf(const froe_tree *tree, const char *path, const froe_render_options *options,
                            froe_render_report *report, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    froe_render_options o = options ? *options : froe_render_defaults();
    froe_render_report found;
    double steps = 1;
    if (!tree || !path) return support_fail_null(diag, __func__);
    if (o.size != sizeof o) return support_fail_defaults(diag, "froe_render_defaults");
    o.shading = FROE_SHADE_NONE;
    o.interleaved = false;
    dxf_drawing d = {
        .alloc = support_allocator(o.alloc), .scene = froe_tree_scene(tree), .options = &o, .heard.path = path};
    for (int i = 0; i < o.decimals && i < 6; i++) steps *= 10;
    froe_status status = froe_render_paths(tree, steps, keep_path, &d, &o, &found, diag);
    if (!status && d.full) status = support_fail_memory(diag);
    io_gdal_begin(&d.heard);
    if (!status) {
        status = dxf_header(&d.alloc, &d.layers, o.millimetres, &d.header);
        if (status == FROE_E_MEMORY) support_fail_memory(diag);
        if (status == FROE_E_UNSUPPORTED)
            support_fail(diag, status, "GDAL cannot write DXF: its file header.dxf is missing.");
        if (!status) status = write_drawing(&d, path, &found.bytes, diag);
    }
    io_gdal_end(&d.heard);
    if (!status && report) *report = found;
    array_free(&d.alloc, &d.layers);
    array_free(&d.alloc, &d.lines);
    array_free(&d.alloc, &d.points);
    array_free(&d.alloc, &d.header);
    return status;
}
