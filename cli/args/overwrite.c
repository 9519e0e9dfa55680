/* overwrite.c: see overwrite.h. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "args/overwrite.h"
#include "args/output.h"
#include "exit.h"
#include "support/path.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* ---------------------------------------------------------------- the names -- */

/* Visits the names of files that options of one use were given. */
typedef struct name_walk {
    const cli_part *part;
    const cli_option *option;
    size_t next; /* of the names of the option */
} name_walk;

static size_t names_of(const cli_option *option, const void *field, const char *const **names) {
    if (option->type == CLI_TEXTS) {
        *names = ((const cli_texts *)field)->at;
        return ((const cli_texts *)field)->count;
    }
    *names = option->type == CLI_OUTPUT ? &((const cli_output *)field)->name : field;
    return **names != NULL;
}

/* The next name, or NULL. */
static const char *next_name(name_walk *w, cli_file file, void *args) {
    for (; w->part->title; w->part++, w->option = w->part->options)
        for (; w->option->type; w->option++, w->next = 0) {
            const char *const *names;
            if (w->option->file != file) continue;
            if (w->next < names_of(w->option, (char *)args + w->part->at + w->option->at, &names))
                return names[w->next++];
        }
    return NULL;
}

/* ---------------------------------------------------------------- comparing -- */

static bool is_dash(const char *name) {
    return !strcmp(name, "-");
}

/* Devices and pipes may serve twice. */
static bool same_file(const char *a, const char *b) {
    struct stat x, y;
    if (stat(a, &x) != 0 || stat(b, &y) != 0) return strcmp(a, b) == 0;
    return S_ISREG(x.st_mode) && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
}

/* The length of a path with the slash behind its last folder; 0 if it names none. */
static size_t folder_length(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* Does the output lie in a folder that is read, or in one within it? */
static bool is_inside(const char *output, const char *input) {
    struct stat about;
    if (stat(input, &about) != 0 || !S_ISDIR(about.st_mode)) return false;
    char *read = realpath(input, NULL), *written = realpath(output, NULL);
    if (!written) { /* it is not there yet: its folder */
        const size_t length = folder_length(output);
        char *folder = length ? strndup(output, length) : strdup(".");
        written = folder ? realpath(folder, NULL) : NULL;
        free(folder);
    }
    const bool inside = read && written && !strncmp(read, written, strlen(read)) && strchr("/", written[strlen(read)]);
    free(read);
    free(written);
    return inside;
}

static bool is_shapefile(const char *path) {
    static const char *const endings[] = {"shp", "dbf", "shx", "prj", "cpg"};
    const support_extension ending = support_path_extension(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (!strcmp(ending.text, endings[i])) return true;
    return false;
}

/* Are both parts of one Shapefile, whose files differ in their endings alone? */
static bool same_shapefile(const char *output, const char *input) {
    if (!is_shapefile(output) || !is_shapefile(input)) return false;
    const char *ending = strrchr(input, '.');
    const size_t stem = (size_t)(strrchr(output, '.') - output), room = stem + strlen(ending) + 1;
    char *sibling = malloc(room);
    if (!sibling) return true; /* nothing is overwritten */
    snprintf(sibling, room, "%.*s%s", (int)stem, output, ending);
    const bool same = same_file(sibling, input);
    free(sibling);
    return same;
}

/* ----------------------------------------------------------------- checking -- */

static int check_input(const char *output, const char *input) {
    if (same_file(output, is_dash(input) ? "/dev/stdin" : input))
        return cli_fail(CLI_USE, output, "The file is read as well. An output needs a file of its own.");
    if (is_inside(output, input))
        return cli_fail(CLI_USE, output, "The folder of the file is read. An output needs another folder.");
    if (same_shapefile(output, input))
        return cli_fail(CLI_USE, output, "The Shapefile is read as well. An output needs a name of its own.");
    return 0;
}

static int refuse_dash(const cli_option *option) {
    const char *name = option->name, *sentence = option->sentence;
    if (!sentence) return cli_fail(CLI_USE, NULL, "--%s: It writes a file and not to standard output.", name);
    return cli_fail(CLI_USE, NULL, "--%s: It writes a file and not to standard output. %s", name, sentence);
}

int cli_check_overwrite(const cli_part *parts, void *args) {
    const name_walk first = {parts, parts->options, 0};
    name_walk outputs = first;
    const char *output, *other;
    while ((output = next_name(&outputs, CLI_WRITTEN, args)) != NULL) {
        const cli_option *option = outputs.option;
        if (is_dash(output) && option->type == CLI_OUTPUT) continue;
        if (is_dash(output)) return refuse_dash(option);
        name_walk inputs = first, before = first;
        while ((other = next_name(&inputs, CLI_READ, args)) != NULL) {
            const int code = check_input(output, other);
            if (code) return code;
        }
        while (other = next_name(&before, CLI_WRITTEN, args), before.option != option)
            if (same_file(output, other))
                return cli_fail(CLI_USE, output, "The file is written twice. An output needs a file of its own.");
    }
    return 0;
}
