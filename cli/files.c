/* files.c: files written as a whole. */
#include "files.h"
#include "exit.h"
#include "report/report.h"
#include "support/writer.h"
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int cli_write_file(const char *path, const void *bytes, size_t count) {
    froe_diagnostic diag;
    const froe_status status = support_write(path, bytes, count, NULL, &diag);
    return status ? cli_fail_status(CLI_WRITING, path, status, &diag) : 0;
}

int cli_write_text(const char *path, cli_write_fn *fn, const void *user) {
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out) return cli_fail_memory();
    const bool whole = fn(out, user) && !ferror(out) && !cli_report_short();
    const int code = fclose(out) || !whole ? cli_fail_memory() : cli_write_file(path, text, length);
    free(text);
    return code;
}

int cli_make_folder(char folder[CLI_FOLDER]) {
    const char *above = getenv("TMPDIR");
    snprintf(folder, CLI_FOLDER, "%s/froe-XXXXXX", above && *above ? above : "/tmp");
    if (mkdtemp(folder)) return 0;
    const int code = cli_fail_file(CLI_RESOURCES, folder, "written");
    folder[0] = '\0';
    return code;
}

bool cli_set_ending(const char *text, char ending[CLI_ENDING]) {
    static const char capitals[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ", known[] = "abcdefghijklmnopqrstuvwxyz0123456789";
    text += *text == '.';
    size_t length = 0;
    for (; text[length] && length < CLI_ENDING - 1; length++) {
        const char *capital = strchr(capitals, text[length]);
        ending[length] = capital ? known[capital - capitals] : text[length];
    }
    ending[length] = '\0';
    return length && !text[length] && strspn(ending, known) == length;
}
