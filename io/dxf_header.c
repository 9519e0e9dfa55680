/* dxf_header.c: GDAL writes DXF behind a template, header.dxf, which has one layer and inches. Here it gets a layer for
 * each kind of line, with its colour, width and type of line, so that a program that shows the drawing can change them
 * by layer. (AutoCAD 2004 DXF Reference: pairs of a code and a value, each on a line of its own.) */
#include "dxf.h"
#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

/* ----------------------------------------------------------------------- colours -- */

/* Part k of the hue at 15 i degrees, 0 .. 1: it is 1 for 60 degrees to both sides of its own, and then falls. */
static double part_of_hue(int i, int k) {
    const int steps = abs((i + 24 - 8 * k) % 24), away = steps < 12 ? steps : 24 - steps;
    return away <= 4 ? 1 : away >= 8 ? 0 : (8 - away) / 4.0;
}

/* Colour 1 .. 255 of AutoCAD's index: 1 to 9 by name, 24 hues in five lights and two strengths, greys. */
static uint32_t indexed_colour(int index) {
    static const uint32_t named[] = {0xFF0000, 0xFFFF00, 0x00FF00, 0x00FFFF, 0x0000FF,
                                     0xFF00FF, 0x000000, 0x808080, 0xC0C0C0},
                          greys[] = {0x333333, 0x505050, 0x696969, 0x828282, 0xBEBEBE, 0xFFFFFF};
    static const int lights[] = {255, 165, 127, 76, 38};
    if (index < 10) return named[index - 1];
    if (index >= 250) return greys[index - 250];
    const int hue = index / 10 - 1, light = lights[index % 10 / 2];
    uint32_t colour = 0;
    for (int k = 0; k < 3; k++) {
        const double part = part_of_hue(hue, k), shown = index % 2 ? 0.5 + 0.5 * part : part;
        colour = colour << 8 | (uint32_t)floor(light * shown + 0.5);
    }
    return colour;
}

int dxf_colour(uint32_t colour) {
    int best = 7, least = INT32_MAX;
    for (int i = 1; i <= 255; i++) {
        const uint32_t other = indexed_colour(i);
        int square = 0;
        for (int shift = 0; shift < 24; shift += 8) {
            const int away = (int)(colour >> shift & 255) - (int)(other >> shift & 255);
            square += away * away;
        }
        if (square < least) least = square, best = i;
    }
    return best;
}

/* Widths of lines that DXF has, in hundredths of a millimetre. */
static int width_of_line(double millimetres) {
    static const int widths[] = {0,  5,  9,  13, 15, 18,  20,  25,  30,  35,  40,  50,
                                 53, 60, 70, 80, 90, 100, 106, 120, 140, 158, 200, 211};
    int best = 0;
    for (size_t i = 0; i < sizeof widths / sizeof *widths; i++)
        if (fabs(100 * millimetres - widths[i]) < fabs(100 * millimetres - best)) best = widths[i];
    return best;
}

/* ------------------------------------------------------------------------ writing -- */

typedef struct header_writer {
    const froe_allocator *alloc;
    const dxf_layers *layers;
    dxf_text *out;
    bool millimetres, full; /* full: without memory */
} header_writer;

static void put(header_writer *w, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void put(header_writer *w, const char *format, ...) {
    char text[DXF_NAME + 64];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    w->full = w->full || !array_append(w->alloc, w->out, text, (size_t)length);
}

/* A number of whole hundred-thousandths: without a decimal point of some language. */
static void put_length(header_writer *w, int code, double x) {
    const long long steps = (long long)floor(fabs(x) * 1e5 + 0.5);
    put(w, "%3d\n%s%lld.%05lld\n", code, x < 0 ? "-" : "", steps / 100000, steps % 100000);
}

/* The first layer with the dashes of this one; they share a type of line. */
static size_t first_like(const dxf_layers *layers, size_t i) {
    size_t first = 0;
    while (layers->data[first].dash != layers->data[i].dash || layers->data[first].gap != layers->data[i].gap) first++;
    return first;
}

/* Continuous, or DASHED, DASHED2, ... in the order of the layers. */
static void put_line_type_name(header_writer *w, int code, size_t layer) {
    const dxf_layers *layers = w->layers;
    const size_t first = first_like(layers, layer);
    size_t number = 1;
    for (size_t i = 0; i < first; i++) number += layers->data[i].dash > 0 && first_like(layers, i) == i;
    if (layers->data[layer].dash <= 0)
        put(w, "%3d\nContinuous\n", code);
    else if (number == 1)
        put(w, "%3d\nDASHED\n", code);
    else
        put(w, "%3d\nDASHED%zu\n", code, number);
}

/* Handles are numbers that nothing else in the template has, below those that GDAL gives entities. */
enum { FIRST_TYPE = 0x1000, FIRST_LAYER = 0x8000 };

static void put_line_types(header_writer *w) {
    for (size_t i = 0; i < w->layers->count; i++) {
        const dxf_layer *layer = w->layers->data + i;
        if (layer->dash <= 0 || first_like(w->layers, i) < i) continue;
        put(w, "  0\nLTYPE\n  5\n%X\n330\n5\n100\nAcDbSymbolTableRecord\n100\nAcDbLinetypeTableRecord\n",
            (unsigned)(FIRST_TYPE + i));
        put_line_type_name(w, 2, i);
        put(w, " 70\n     0\n  3\n_ _ _ _\n 72\n    65\n 73\n     2\n");
        put_length(w, 40, layer->dash + layer->gap);
        put_length(w, 49, layer->dash);
        put(w, " 74\n     0\n");
        put_length(w, 49, -layer->gap);
        put(w, " 74\n     0\n");
    }
}

static void put_layers(header_writer *w) {
    for (size_t i = 0; i < w->layers->count; i++) {
        const dxf_layer *layer = w->layers->data + i;
        put(w, "  0\nLAYER\n  5\n%X\n330\n2\n100\nAcDbSymbolTableRecord\n100\nAcDbLayerTableRecord\n",
            (unsigned)(FIRST_LAYER + i));
        const int colour = layer->colour == FROE_LINE_COLOUR ? 7 : dxf_colour(layer->colour);
        put(w, "  2\n%s\n 70\n     0\n 62\n%6d\n", layer->name, colour);
        if (colour != 7) put(w, "420\n%u\n", layer->colour); /* exactly, for programs that know more colours */
        put_line_type_name(w, 6, i);
        put(w, "370\n%6d\n390\nF\n", w->millimetres ? width_of_line(layer->width) : -3); /* -3: as the program likes */
    }
}

/* ------------------------------------------------------------------------ reading -- */

static char *next_line(char **at) {
    char *line = *at;
    if (!*line) return NULL;
    const size_t length = strcspn(line, "\r\n");
    char *end = line + length;
    *at = end + (*end == '\r') + (end[*end == '\r'] == '\n');
    *end = '\0';
    return line + strspn(line, " ");
}

/* The template pair by pair: units are replaced, and records added where their tables end. */
static void put_template(header_writer *w, char *text) {
    char table[16] = "";
    const char *code, *value, *variable = "", *opened = "";
    while ((code = next_line(&text)) && (value = next_line(&text))) {
        const int number = atoi(code);
        if (number == 0 && !strcmp(value, "ENDTAB")) {
            if (!strcmp(table, "LTYPE")) put_line_types(w);
            if (!strcmp(table, "LAYER")) put_layers(w);
        }
        if (number == 2 && !strcmp(opened, "TABLE")) snprintf(table, sizeof table, "%s", value);
        opened = number == 0 ? value : "";
        if (number == 70 && !strcmp(variable, "$INSUNITS")) value = w->millimetres ? "4" : "0";
        if (number == 70 && !strcmp(variable, "$MEASUREMENT")) value = "1"; /* metric */
        variable = number == 9 ? value : "";
        put(w, "%3d\n%s\n", number, value);
    }
}

froe_status dxf_header(const froe_allocator *alloc, const dxf_layers *layers, bool millimetres, dxf_text *out) {
    enum { MOST = 1 << 20 };
    header_writer w = {.alloc = alloc, .layers = layers, .out = out, .millimetres = millimetres};
    const char *path = CPLFindFile("gdal", "header.dxf");
    VSILFILE *file = path ? VSIFOpenL(path, "rb") : NULL;
    if (!file) return FROE_E_UNSUPPORTED;
    char *text = support_calloc(alloc, MOST, 1);
    if (text) VSIFReadL(text, 1, MOST - 1, file);
    VSIFCloseL(file);
    if (!text) return FROE_E_MEMORY;
    put_template(&w, text);
    support_free(alloc, text, MOST);
    return w.full ? FROE_E_MEMORY : FROE_OK;
}
