/* output.c: Cairo surfaces into memory. What could differ between two runs is
 * pinned: the date of a PDF, and the id that Cairo takes from a counter of the
 * process for the outer group of an SVG. */
#include "output.h"
#include "support/fail.h"
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <math.h>
#include <string.h>

static cairo_status_t collect(void *user, const unsigned char *data, unsigned length) {
    draw_output *output = user;
    if (output->full || !array_reserve(&output->alloc, &output->bytes, length)) {
        output->full = true;
        return CAIRO_STATUS_NO_MEMORY;
    }
    memcpy(output->bytes.data + output->bytes.count, data, length);
    output->bytes.count += length;
    return CAIRO_STATUS_SUCCESS;
}

static froe_status failed(const draw_output *output, cairo_status_t status, froe_diagnostic *diag) {
    if (status == CAIRO_STATUS_SUCCESS && !output->full) return FROE_OK;
    if (output->full || status == CAIRO_STATUS_NO_MEMORY) return support_fail_memory(diag);
    if (status == CAIRO_STATUS_INVALID_STRING)
        return support_fail(diag, FROE_E_OPTIONS, "The title of the picture is not UTF-8.");
    return support_fail(diag, FROE_E_UNSUPPORTED, "Cairo cannot make the picture: %s.", cairo_status_to_string(status));
}

froe_status draw_output_begin(draw_output *output, const froe_allocator *alloc, froe_draw_format format, double width,
                              double height, double scale, const char *title, froe_diagnostic *diag) {
    *output = (draw_output){.alloc = *alloc, .format = format};
    if (format == FROE_DRAW_SVG) {
        output->surface = cairo_svg_surface_create_for_stream(collect, output, width, height);
        cairo_svg_surface_set_document_unit(output->surface, CAIRO_SVG_UNIT_PX);
    } else if (format == FROE_DRAW_PNG) {
        output->surface =
            cairo_image_surface_create(CAIRO_FORMAT_ARGB32, (int)ceil(width * scale), (int)ceil(height * scale));
    } else {
        output->surface = cairo_pdf_surface_create_for_stream(collect, output, width, height);
        cairo_pdf_surface_set_metadata(output->surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
        cairo_pdf_surface_set_metadata(output->surface, CAIRO_PDF_METADATA_CREATOR, "froe");
        if (title && *title) cairo_pdf_surface_set_metadata(output->surface, CAIRO_PDF_METADATA_TITLE, title);
    }
    output->cr = cairo_create(output->surface);
    if (format == FROE_DRAW_PNG) cairo_scale(output->cr, scale, scale);
    return failed(output, cairo_status(output->cr), diag);
}

/* `id="surface12"` becomes `id="froe"`; and of the six decimals of coordinates, which are whole 1/256 in Cairo, those
 * from the third on are noise. */
static void pin_svg(draw_output *output) {
    static const char mark[] = "<g id=\"surface", name[] = "<g id=\"froe";
    unsigned char *data = output->bytes.data;
    size_t count = output->bytes.count, head = count < 1024 ? count : 1024, kept = 0, digits = 0;
    bool fraction = false;
    for (size_t i = 0; i + sizeof mark < head; i++) {
        if (memcmp(data + i, mark, sizeof mark - 1) != 0) continue;
        size_t end = i + sizeof mark - 1;
        while (end < count && data[end] >= '0' && data[end] <= '9') end++;
        memcpy(data + i, name, sizeof name - 1);
        memmove(data + i + sizeof name - 1, data + end, count - end);
        count -= end - (i + sizeof name - 1);
        break;
    }
    for (size_t i = 0; i < count; i++) {
        bool digit = data[i] >= '0' && data[i] <= '9';
        if (data[i] == '.') {
            fraction = true;
            digits = 0;
        } else if (!digit)
            fraction = false;
        if (fraction && digit && ++digits > 2) continue;
        data[kept++] = data[i];
    }
    output->bytes.count = kept;
}

froe_status draw_output_finish(draw_output *output, froe_diagnostic *diag) {
    cairo_status_t status = cairo_status(output->cr);
    if (status == CAIRO_STATUS_SUCCESS && output->format == FROE_DRAW_PNG)
        status = cairo_surface_write_to_png_stream(output->surface, collect, output);
    cairo_surface_finish(output->surface);
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(output->surface);
    if (status == CAIRO_STATUS_SUCCESS && output->format == FROE_DRAW_SVG) pin_svg(output);
    return failed(output, status, diag);
}

void draw_output_free(draw_output *output) {
    if (output->cr) cairo_destroy(output->cr);
    if (output->surface) cairo_surface_destroy(output->surface);
    output->cr = NULL;
    output->surface = NULL;
    array_free(&output->alloc, &output->bytes);
}
