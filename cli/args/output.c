/* output.c: see output.h. */
#include "args/output.h"
#include "exit.h"
#include "files.h"
#include "support/fail.h"
#include "support/path.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const cli_option *option_of(const cli_part *parts, void *args, cli_output **output) {
    for (const cli_part *part = parts; part->title; part++)
        for (const cli_option *option = part->options; option->type; option++)
            if (option->type == CLI_OUTPUT) {
                *output = (cli_output *)((char *)args + part->at + option->at);
                return option;
            }
    return NULL;
}

/* The descriptor of this program that a path stands for; -1: none. */
static int descriptor_of(const char *path) {
    static const char folder[] = "/dev/fd/";
    if (!strcmp(path, "-") || !strcmp(path, "/dev/stdout")) return STDOUT_FILENO;
    if (strncmp(path, folder, sizeof folder - 1) != 0) return -1;
    char *end;
    const long number = strtol(path + sizeof folder - 1, &end, 10);
    return *end || number < 0 || number > 1 << 20 ? -1 : (int)number;
}

/* Is a file of this ending no text? */
static bool is_binary(const char *ending) {
    static const char *const texts[] = {"svg", "eps", "geojson", "json", "geojsonl", "jsonl", "csv", "tsv",
                                        "obj", "off", "html",    "dxf",  "mfjson",   "gml",   "kml", "txt"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (!strcmp(ending, texts[i])) return false;
    return true;
}

int cli_check_ending(const char *option, const char *path, const char *ending) {
    if (!path || !strcmp(support_path_extension(path).text, ending)) return 0;
    return cli_fail(CLI_USE, NULL, "--%s: '%s' does not end in .%s.", option, path, ending);
}

/* A file with the ending, in a folder of its own. */
static int make_copy(cli_output *out, const char *ending) {
    const int code = cli_make_folder(out->folder);
    if (code) return code;
    snprintf(out->copy, sizeof out->copy, "%s/output.%s", out->folder, ending);
    out->path = out->copy;
    return 0;
}

int cli_output_open(const cli_part *parts, void *args) {
    cli_output *out;
    struct stat about;
    const cli_option *option = option_of(parts, args, &out);
    if (!option || !out->name) return 0;
    const bool dash = !strcmp(out->name, "-");
    if (!dash && !out->format) return 0;
    const int descriptor = descriptor_of(out->name);
    const bool standard = descriptor == STDOUT_FILENO;
    if (descriptor < 0 && (stat(out->name, &about) || S_ISREG(about.st_mode) || S_ISDIR(about.st_mode)))
        return cli_fail(CLI_USE, out->name,
                        "The format is known by the ending of the file. --output-format is for standard output and "
                        "pipes.");
    if (dash) out->name = "standard output";
    const char *ending = out->format ? out->format : option->ending;
    if (!ending || !cli_set_ending(ending, out->ending))
        return cli_fail(CLI_USE, out->name,
                        "The format must be named, as in --output-format svg: the usual extension of its files.");
    out->format = ending = out->ending;
    out->target = descriptor >= 0 ? dup(descriptor) : open(out->name, O_WRONLY | O_NOCTTY | O_CLOEXEC);
    if (out->target < 0) return cli_fail_file(CLI_RESOURCES, out->name, "written");
    int code = is_binary(ending) && isatty(out->target)
                   ? cli_fail(CLI_USE, out->name, "It is a terminal, and a file of format %s is no text.", ending)
                   : make_copy(out, ending);
    if (code)
        close(out->target);
    else if (standard)
        (void)dup2(STDERR_FILENO, STDOUT_FILENO); /* main() has seen that both are open */
    return code;
}

/* NAME': ... of the library, where options are members of a struct, as --NAME: ... */
static int fail_option(const char *text) {
    const size_t length = strcspn(text, "'");
    const char *sentence = text + length + strlen("': ");
    return cli_fail(CLI_USE, NULL, "--%.*s: %s", (int)length, text, sentence);
}

int cli_output_fail(const cli_output *output, froe_status status, const froe_diagnostic *diag) {
    froe_diagnostic told = *diag;
    const char *path = support_short(output->path);
    const size_t length = strlen(path);
    const bool copy = output->path != output->name && status != FROE_E_IO && !strncmp(diag->message, path, length) &&
                      !strncmp(diag->message + length, ": ", 2);
    const char *sentence = diag->message + (copy ? length + 2 : 0);
    if (status == FROE_E_OPTIONS && !strncmp(sentence, "option '", 8)) return fail_option(sentence + 8);
    if (status == FROE_E_ARG || status == FROE_E_OPTIONS)
        return cli_fail(CLI_USE, copy ? output->name : NULL, "%s", sentence);
    memmove(told.message, sentence, strlen(sentence) + 1);
    return cli_fail_status(CLI_WRITING, output->name, status, &told);
}

/* The command wrote one file, which is what can be copied. Returns an exit code. */
static int check_one_file(const cli_output *out) {
    DIR *folder = opendir(out->folder);
    int files = 0;
    if (!folder) return cli_fail_file(CLI_RESOURCES, out->folder, "read");
    for (struct dirent *entry; (entry = readdir(folder));) files += entry->d_name[0] != '.';
    closedir(folder);
    if (files == 1) return 0;
    return cli_fail(CLI_USE, out->name, "The format %s has several files, which need names.", out->format);
}

/* False: not all bytes could be written, and errno says why. */
static bool write_whole(int target, const char *bytes, size_t count) {
    while (count) {
        const ssize_t put = write(target, bytes, count);
        if (put < 0 && errno != EINTR) return false;
        if (put > 0) bytes += put, count -= (size_t)put;
    }
    return true;
}

/* Returns an exit code. */
static int copy_output(const cli_output *out) {
    char buffer[1 << 14];
    ssize_t got = 0;
    bool whole = true;
    const int in = open(out->copy, O_RDONLY | O_CLOEXEC);
    if (in < 0) return cli_fail_file(CLI_RESOURCES, out->copy, "read");
    while (whole && (got = read(in, buffer, sizeof buffer)) > 0) whole = write_whole(out->target, buffer, (size_t)got);
    const int error = errno;
    close(in);
    errno = error;
    if (!whole) return error == EPIPE ? CLI_PIPE : cli_fail_file(CLI_RESOURCES, out->name, "written");
    return got < 0 ? cli_fail_file(CLI_RESOURCES, out->copy, "read") : 0;
}

static void remove_folder(const cli_output *out) {
    DIR *folder = opendir(out->folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        if (entry->d_name[0] != '.') unlinkat(dirfd(folder), entry->d_name, 0);
    if (folder)
        closedir(folder);
    else
        unlink(out->copy); /* mostly all that there is */
    rmdir(out->folder);
}

int cli_output_close(const cli_part *parts, void *args, int code) {
    cli_output *out;
    if (!option_of(parts, args, &out) || !out->name || !*out->folder) return code;
    if (!code) code = check_one_file(out);
    void (*before)(int) = signal(SIGPIPE, SIG_IGN); /* the folder is to be removed whatever happens */
    if (!code) code = copy_output(out);
    signal(SIGPIPE, before);
    if (close(out->target) && !code) code = cli_fail_file(CLI_RESOURCES, out->name, "written");
    remove_folder(out);
    return code;
}
