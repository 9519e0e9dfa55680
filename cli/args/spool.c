/* spool.c: see spool.h. */
#include "args/spool.h"
#include "exit.h"
#include "files.h"
#include "progress.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Copies until the input ends. Exit code. */
static int copy_input(FILE *in, const char *name, const char *copy) {
    char buffer[1 << 14];
    size_t got = 0;
    int code = 0;
    FILE *out = fopen(copy, "wb");
    if (!out) return cli_fail_file(CLI_RESOURCES, copy, "written");
    while (!code && (got = fread(buffer, 1, sizeof buffer, in)) > 0) {
        if (fwrite(buffer, 1, got, out) != got) code = cli_fail_file(CLI_RESOURCES, copy, "written");
        if (!code && cli_interrupted()) code = cli_fail_cancelled(name);
    }
    if (!code && ferror(in)) code = cli_fail_file(CLI_INPUT, name, "read");
    if (fclose(out) && !code) code = cli_fail_file(CLI_RESOURCES, copy, "written");
    return code;
}

int cli_spool_open(const char *path, const char *format, cli_spool *out) {
    struct stat about;
    const bool standard = !strcmp(path, "-");
    char ending[CLI_ENDING];
    *out = (cli_spool){.name = standard ? "standard input" : path, .path = path};
    /* /dev/stdin and /dev/fd/3 may be regular files, but their names say nothing of the format. */
    const bool once = standard || !strncmp(path, "/dev/", 5) ||
                      (!stat(path, &about) && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode));
    if (!once && format)
        return cli_fail(CLI_USE, path,
                        "The format is known by the file itself. --input-format is for standard input and pipes.");
    if (!once) return 0;
    if (!format || !cli_set_ending(format, ending))
        return cli_fail(CLI_USE, out->name,
                        "The format must be named, as in --input-format geojson: the usual extension of its files.");
    int code = cli_make_folder(out->folder);
    if (code) return code;
    snprintf(out->copy, sizeof out->copy, "%s/input.%s", out->folder, ending);
    FILE *in = standard ? stdin : fopen(path, "rb");
    code = in ? copy_input(in, out->name, out->copy) : cli_fail_file(CLI_INPUT, path, "read");
    if (in && in != stdin) fclose(in);
    out->path = out->copy;
    if (code) cli_spool_free(out);
    return code;
}

void cli_spool_free(cli_spool *spool) {
    if (!*spool->folder) return;
    remove(spool->copy);
    rmdir(spool->folder);
    spool->folder[0] = '\0';
}
