/* render_writer.c: see render_writer.h. */
#include "commands/render_writer.h"
#include "library.h"
#include "support/path.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool render_name_frame(const char *pattern, size_t i, char *out, size_t room) {
    const char *percent = strchr(pattern, '%'), *at = percent;
    char *end;
    if (!percent) return false;
    const bool zeros = at[1] == '0';
    const long width = strtol(at + 1, &end, 10);
    if (*end != 'd' || width < 0 || width > 20 || strchr(end, '%')) return false;
    const int head = (int)(percent - pattern);
    const int length = zeros ? snprintf(out, room, "%.*s%0*zu%s", head, pattern, (int)width, i, end + 1)
                             : snprintf(out, room, "%.*s%*zu%s", head, pattern, (int)width, i, end + 1);
    return length > 0 && (size_t)length < room;
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
