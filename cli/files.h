/* files.h: files that the program writes. */
#ifndef FROE_CLI_FILES_H
#define FROE_CLI_FILES_H
#include <stdbool.h>
#include <stdio.h>

/** A file that appears whole or not at all (support/writer.h). Returns 0 or an exit code after saying why. */
int cli_write_file(const char *path, const void *bytes, size_t count);
/** The same, of what a function writes, which returns false without memory. */
typedef bool cli_write_fn(FILE *out, const void *user);
int cli_write_text(const char *path, cli_write_fn *fn, const void *user);

enum { CLI_FOLDER = 4000 };
/** Makes a folder for temporary files, named in `folder`; "" when it fails. Returns 0, or an exit code after saying
 * why. */
int cli_make_folder(char folder[CLI_FOLDER]);
enum { CLI_ENDING = 16 };
/** Sets the ending that a text names, with or without a dot before it, in lower case and without the dot. False: the
 * text can be no ending. */
bool cli_set_ending(const char *text, char ending[CLI_ENDING]);
#endif
