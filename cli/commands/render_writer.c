/* render_writer.c: see render_writer.h. */
#include "commands/render_writer.h"
#include "library.h"
#include "support/path.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_WIDTH = 20 }; /* as many digits as a number of 64 bits has */

/* The width in front of the only 'd' behind the only '%'; *end: behind the d. -1: there is none. */
static int find_width(const char *pattern, const char **end) {
    const char *percent = strchr(pattern, '%');
    char *behind;
    if (!percent) return -1;
    const long width = strtol(percent + 1, &behind, 10);
    if (*behind != 'd' || width < 0 || width > MOST_WIDTH || strchr(behind, '%')) return -1;
    *end = behind + 1;
    return (int)width;
}

bool render_names_frames(const char *pattern) {
    const char *end;
    return find_width(pattern, &end) >= 0;
}

char *render_frame_name(const char *pattern, size_t i) {
    const char *percent = strchr(pattern, '%'), *end = "";
    const int width = find_width(pattern, &end), head = (int)(percent - pattern);
    const size_t room = strlen(pattern) + MOST_WIDTH + 1;
    char *name = malloc(room);
    if (name) snprintf(name, room, percent[1] == '0' ? "%.*s%0*zu%s" : "%.*s%*zu%s", head, pattern, width, i, end);
    return name;
}

int render_find_writer(const char *path, render_fn **write) {
    const support_extension extension = support_path_extension(path);
    int code = 0;
    if (!strcmp(extension.text, "png")) {
        cli_draw library;
        code = cli_open_draw(&library);
        if (!code) *write = library.render_png;
    } else if (!strcmp(extension.text, "dxf")) {
        cli_io library;
        code = cli_open_io(&library);
        if (!code) *write = library.render_dxf;
    }
    return code;
}
