/* pdf.c: a PDF 1.4 file: six objects, of which one holds what the page shows, and the table of where they are
 * (ISO 32000-1, 7.5). Nothing is compressed, and nothing differs between two runs.
 *
 * A page has at most 14,400 units (Annex C.2). A longer one has units of several points, which is PDF 1.6. */
#include "page.h"
#include "render.h"
#include <math.h>
#include <string.h>

enum { CATALOG = 1, PAGES, PAGE, CONTENT, LENGTH, INFO, OBJECTS };
enum { MOST_UNITS = 14400 };

typedef struct pdf_writer {
    vector_output *output;
    uint64_t begins[OBJECTS]; /* where each object begins */
    int unit;                 /* points to a unit of the page: 1, 2, 4 ... */
} pdf_writer;

static void begin_object(pdf_writer *w, int number) {
    w->begins[number] = w->output->count;
    vector_print(w->output, "%d 0 obj\n", number);
}

static void end_object(pdf_writer *w) {
    vector_print(w->output, "endobj\n");
}

/* A text of valid UTF-8 as UTF-16 in hexadecimal digits (7.9.2.2), which needs no escaping. */
static void put_entry(pdf_writer *w, const char *key, const char *text) {
    if (!text || !*text) return;
    vector_print(w->output, "/%s<FEFF", key);
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        const int more = *at < 0x80 ? 0 : *at < 0xE0 ? 1 : *at < 0xF0 ? 2 : 3;
        uint32_t c = more ? *at & (0x3Fu >> more) : *at;
        for (int i = 1; i <= more; i++) c = c << 6 | (at[i] & 0x3Fu);
        at += more + 1;
        if (c < 0x10000)
            vector_print(w->output, "%04X", c);
        else
            vector_print(w->output, "%04X%04X", 0xD800 + ((c - 0x10000) >> 10), 0xDC00 + ((c - 0x10000) & 0x3FF));
    }
    vector_print(w->output, ">\n");
}

static void put_content(pdf_writer *w, vector_render *render, bool alphas[256]) {
    begin_object(w, CONTENT);
    vector_print(w->output, "<</Length %d 0 R>>\nstream\n", LENGTH);
    const uint64_t begin = w->output->count;
    const vector_digits scale = vector_real(10, 1.0 / w->unit);
    if (w->unit > 1) vector_print(w->output, "%s 0 0 %s 0 0 cm\n", scale.text, scale.text);
    vector_put_page(render, w->output, alphas);
    const uint64_t length = w->output->count - begin;
    vector_print(w->output, "endstream\n");
    end_object(w);
    begin_object(w, LENGTH);
    vector_print(w->output, "%llu\n", (unsigned long long)length);
    end_object(w);
}

/* Colours are blended as they are given: the page is a transparency group of RGB (11.6.6). */
static void put_page(pdf_writer *w, const vector_render *render, const bool alphas[256]) {
    const froe_camera *camera = &render->options->camera;
    begin_object(w, PAGE);
    vector_print(w->output, "<</Type/Page/Parent %d 0 R/MediaBox[0 0 %s %s]/Contents %d 0 R\n", PAGES,
                 vector_points(render, camera->width / w->unit).text,
                 vector_points(render, camera->height / w->unit).text, CONTENT);
    if (w->unit > 1) vector_print(w->output, "/UserUnit %d\n", w->unit);
    vector_print(w->output, "/Group<</S/Transparency/CS/DeviceRGB/I true>>\n/Resources<</ExtGState<<");
    for (unsigned a = 0; a < 256; a++)
        if (alphas[a])
            vector_print(w->output, "/a%u<</ca %s/CA %s>>\n", a, vector_real(4, a / 255.0).text,
                         vector_real(4, a / 255.0).text);
    vector_print(w->output, ">>>>>>\n");
    end_object(w);
}

void vector_pdf(vector_render *render, vector_output *output) {
    const froe_camera *camera = &render->options->camera;
    pdf_writer w = {.output = output, .unit = 1};
    bool alphas[256] = {false};
    while (fmax(camera->width, camera->height) * vector_unit(render->options) > (double)MOST_UNITS * w.unit)
        w.unit *= 2;
    /* bytes above 127 tell transports that the file is binary */
    vector_print(output, "%%PDF-1.%d\n%%\xE2\xE3\xCF\xD3\n", w.unit > 1 ? 6 : 4);
    begin_object(&w, CATALOG);
    vector_print(output, "<</Type/Catalog/Pages %d 0 R>>\n", PAGES);
    end_object(&w);
    begin_object(&w, PAGES);
    vector_print(output, "<</Type/Pages/Kids[%d 0 R]/Count 1>>\n", PAGE);
    end_object(&w);
    put_content(&w, render, alphas);
    put_page(&w, render, alphas);
    begin_object(&w, INFO);
    vector_print(output, "<</Creator(froe)\n");
    put_entry(&w, "Title", render->options->title);
    put_entry(&w, "Subject", render->options->description);
    vector_print(output, ">>\n");
    end_object(&w);
    const uint64_t table = output->count;
    vector_print(output, "xref\n0 %d\n0000000000 65535 f \n", OBJECTS);
    for (int i = 1; i < OBJECTS; i++) vector_print(output, "%010llu 00000 n \n", (unsigned long long)w.begins[i]);
    vector_print(output, "trailer\n<</Size %d/Root %d 0 R/Info %d 0 R>>\nstartxref\n%llu\n%%%%EOF\n", OBJECTS, CATALOG,
                 INFO, (unsigned long long)table);
}
