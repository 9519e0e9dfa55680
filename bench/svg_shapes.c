/* svg_shapes.c: just as much SVG as the two programs write. */
#include "svg_shapes.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static char *read_file(const char *path, size_t *size) {
    FILE *f = fopen(path, "rb");
    if (!f || fseek(f, 0, SEEK_END) || (*size = (size_t)ftell(f)) == 0 || fseek(f, 0, SEEK_SET)) {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(1);
    }
    char *text = calloc(*size + 1, 1);
    if (!text || fread(text, 1, *size, f) != *size) exit(1);
    fclose(f);
    return text;
}

/* The value of an attribute within an element; NULL. */
static const char *attribute(const char *element, const char *name) {
    const char *end = strchr(element, '>'), *at = strstr(element, name);
    return at && end && at < end ? at + strlen(name) : NULL;
}

static uint32_t colour_of(const char *element) {
    const char *text = attribute(element, " fill=\"#");
    char *end;
    if (!text) return 0;
    const uint32_t x = (uint32_t)strtoul(text, &end, 16);
    if (end - text != 3) return x;
    return (x >> 8 & 15) * 0x110000 + (x >> 4 & 15) * 0x1100 + (x & 15) * 0x11;
}

/* A number, where "1.5.5-2" are three. */
static double number(const char **at) {
    char text[32];
    size_t n = 0;
    bool point = false;
    const char *c = *at;
    while (*c == ' ' || *c == ',') c++;
    for (; n < 31 && ((*c >= '0' && *c <= '9') || (*c == '.' && !point) || (*c == '-' && n == 0)); c++) {
        point = point || *c == '.';
        text[n++] = *c;
    }
    text[n] = 0;
    *at = n ? c : c + 1;
    return strtod(text, NULL);
}

static void paint_path(const char *d, double scale, oracle_canvas *canvas) {
    double at[2] = {0, 0}, start[2] = {0, 0};
    for (char command = 0; *d && *d != '"';) {
        if (strchr("MmlhvLz", *d)) command = *d++;
        double to[2] = {at[0], at[1]};
        const bool along = command == 'l' || command == 'm';
        if (command == 'z') {
            memcpy(to, start, sizeof to);
            while (*d == ' ') d++;
        } else if (command == 'h' || command == 'v') {
            to[command == 'v'] += scale * number(&d);
        } else {
            for (int k = 0; k < 2; k++) to[k] = (along ? at[k] : 0) + scale * number(&d);
        }
        if (command == 'm' || command == 'M')
            memcpy(start, to, sizeof start), command = command == 'm' ? 'l' : 'L';
        else
            oracle_side(canvas, at, to);
        memcpy(at, to, sizeof at);
    }
}

static void paint_polygon(const char *points, oracle_canvas *canvas) {
    double first[2] = {0, 0}, at[2] = {0, 0};
    for (int i = 0; *points && *points != '"'; i++) {
        double to[2];
        for (int k = 0; k < 2; k++) to[k] = number(&points);
        if (i)
            oracle_side(canvas, at, to);
        else
            memcpy(first, to, sizeof first);
        memcpy(at, to, sizeof at);
        while (*points == ' ') points++;
    }
    oracle_side(canvas, at, first);
}

svg_count svg_paint(const char *path, oracle_canvas *canvas, void (*seen)(void *, uint32_t object, uint32_t colour),
                    void *user) {
    svg_count count = {0, 0};
    char *text = read_file(path, &count.bytes);
    double scale = 1;
    for (const char *at = text; (at = strchr(at, '<')) != NULL; at++) {
        const char *d = strncmp(at, "<path ", 6) ? NULL : attribute(at, " d=\"");
        const char *points = strncmp(at, "<polygon ", 9) ? NULL : attribute(at, " points=\"");
        const char *object = attribute(at, " data-object=\""), *scaled = attribute(at, " transform=\"scale(");
        if (scaled) scale = strtod(scaled, NULL);
        if (d) paint_path(d, scale, canvas);
        if (points) paint_polygon(points, canvas);
        if (object && seen) seen(user, (uint32_t)strtoul(object, NULL, 10), colour_of(at));
        if (!d && !points) continue;
        oracle_fill(canvas, colour_of(at), false);
        count.shapes++;
    }
    free(text);
    return count;
}
