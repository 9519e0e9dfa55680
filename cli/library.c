/* library.c: see library.h. */
#include "library.h"
#ifdef CLI_LINKED

int cli_open_io(cli_io *out) {
    *out = (cli_io){froe_read, froe_export_map, froe_render_dxf, froe_read_animation};
    return 0;
}

int cli_open_draw(cli_draw *out) {
    *out = (cli_draw){froe_draw_defaults_into, froe_draw,      froe_draw_write, froe_draw_format_of,
                      froe_draw_layer_name,    froe_render_png};
    return 0;
}

#else
#include "allowance.h"
#include "exit.h"
#include <dlfcn.h>
#include <string.h>

/* A library stays open until the program ends; opening it again finds it. */
static int open_library(const char *name, const char *what, const char *const *names, void *functions) {
    const cli_limits limits = cli_limit_pause();
    void *library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    cli_limit_resume(limits);
    if (!library)
        return cli_fail(CLI_RESOURCES, NULL, "The library %s, which %s, cannot be opened: %s.", name, what, dlerror());
    for (size_t i = 0; names[i]; i++) {
        void *const function = dlsym(library, names[i]);
        if (!function)
            return cli_fail(CLI_RESOURCES, NULL, "The library %s, which %s, is of another version: %s.", name, what,
                            dlerror());
        memcpy((char *)functions + i * sizeof function, &function, sizeof function); /* POSIX: both kinds of pointers */
    }
    return 0;
}

int cli_open_io(cli_io *out) {
    static const char *const names[] = {"froe_read", "froe_export_map", "froe_render_dxf", "froe_read_animation", NULL};
    return open_library(CLI_IO_FILE, "reads and writes maps, reads models and writes DXF", names, out);
}

int cli_open_draw(cli_draw *out) {
    static const char *const names[] = {
        "froe_draw_defaults_into", "froe_draw", "froe_draw_write", "froe_draw_format_of", "froe_draw_layer_name",
        "froe_render_png",         NULL};
    return open_library(CLI_DRAW_FILE, "draws partitions and PNG files", names, out);
}
#endif
