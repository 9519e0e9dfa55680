/* help.c: writes the tables of options, wrapped for a terminal or as roff. */
#include "help.h"
#include "exit.h"
#include "report/report.h"
#include <ctype.h>
#include <froe/froe.h>
#include <stdarg.h>
#include <string.h>

static const char introduction[] =
    "froe builds binary space partitions of maps, floor plans and models: small, exact, and checked.";

static const struct {
    int code;
    const char *meaning;
} exits[] = {
    {CLI_YES, "done; the answer is yes"},
    {CLI_NO, "the answer is no: an audit failed"},
    {CLI_USE, "bad use: unknown command, option or method, a value out of range, a request that cannot be served"},
    {CLI_INPUT, "bad input: a file that cannot be read, is not what it claims to be, or holds a bad object"},
    {CLI_RESOURCES, "out of resources: memory, a budget, a limit, or an output that cannot be written"},
    {CLI_CANCELLED, "cancelled by Ctrl-C; by another signal 128 and its number"},
};
enum { EXITS = sizeof exits / sizeof *exits };

/* --------------------------------------------------------------- terminal -- */

enum { OPTION_COLUMN = 26 };

/* "-o, --output FILE" */
static void option_label(const cli_option *option, char *label, size_t size) {
    if (!option->name) {
        snprintf(label, size, "%s", option->value);
        return;
    }
    char letter[8] = "";
    if (option->letter) snprintf(letter, sizeof letter, "-%c, ", option->letter);
    snprintf(label, size, "%s--%s%s%s", letter, option->name, option->value ? " " : "",
             option->value ? option->value : "");
}

static void print_entry(FILE *out, const char *label, const char *help) {
    int at = fprintf(out, "  %s", label);
    if (at >= OPTION_COLUMN) {
        fputc('\n', out);
        at = 0;
    }
    cli_wrap(out, help, strlen(help), at, OPTION_COLUMN);
}

/* "SCENE [-o TREE] [options]": operands, then options that must be there. */
static void synopsis(FILE *out, const cli_command *command) {
    for (const cli_part *part = command->parts; part->title; part++)
        for (const cli_option *option = part->options; option->type; option++)
            if (!option->name)
                fprintf(out, option->required ? " %s%s" : " [%s%s]", option->value,
                        option->type == CLI_TEXTS ? "..." : "");
    for (const cli_part *part = command->parts; part->title; part++)
        for (const cli_option *option = part->options; option->type; option++) {
            if (!option->name || !option->required) continue;
            if (option->letter)
                fprintf(out, " -%c %s", option->letter, option->value);
            else
                fprintf(out, " --%s %s", option->name, option->value);
        }
    fputs(" [options]", out);
}

/* Calls `line` for each paragraph of a text parted by empty lines. */
typedef void paragraph_fn(FILE *out, const char *text, size_t length);
static void each_paragraph(FILE *out, const char *text, paragraph_fn *fn) {
    while (*text) {
        const char *end = strstr(text, "\n\n");
        const size_t length = end ? (size_t)(end - text) : strlen(text);
        fn(out, text, length);
        text += length;
        text += strspn(text, "\n");
    }
}

static void print_paragraph(FILE *out, const char *text, size_t length) {
    fputc('\n', out);
    cli_wrap(out, text, length, 0, 0);
}

static void each_exit(FILE *out, void (*entry)(FILE *, const char *label, const char *help)) {
    for (int i = 0; i < EXITS; i++) {
        char code[8];
        snprintf(code, sizeof code, "%d", exits[i].code);
        entry(out, code, exits[i].meaning);
    }
}

static void each_option(FILE *out, void (*entry)(FILE *, const char *label, const char *help)) {
    entry(out, "--version", "version, commit, and the libraries inside; --version --json as an object");
    entry(out, "--completion SHELL", "a script: bash, zsh or fish completes command lines with it");
    entry(out, "-h, --help", "this text; froe COMMAND --help tells about one command");
}

void cli_help(FILE *out) {
    fprintf(out, "%s\n\nUsage: froe COMMAND [options]\n\nCommands:\n", introduction);
    const cli_command *command;
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++) print_entry(out, command->name, command->summary);
    fputs("\nOptions:\n", out);
    each_option(out, print_entry);
    fputs("\nExit codes:\n", out);
    each_exit(out, print_entry);
}

void cli_help_command(FILE *out, const cli_command *command) {
    fprintf(out, "froe %s: %s\n\nUsage: froe %s", command->name, command->summary, command->name);
    synopsis(out, command);
    fputc('\n', out);
    each_paragraph(out, command->about, print_paragraph);
    for (const cli_part *part = command->parts; part->title; part++) {
        fprintf(out, "\n%s:\n", part->title);
        for (const cli_option *option = part->options; option->type; option++) {
            char label[64];
            option_label(option, label, sizeof label);
            print_entry(out, label, option->help);
        }
    }
    fputs("\nExamples:\n", out);
    for (const char *line = command->examples; *line; line += strcspn(line, "\n") + 1)
        fprintf(out, "  %.*s\n", (int)strcspn(line, "\n"), line);
}

/* ----------------------------------------------------------------- manual -- */

/* Text with what roff takes for its own escaped. */
static void put_roff(FILE *out, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++) {
        const bool starts = i == 0 || text[i - 1] == '\n';
        if (starts && strchr(".'", text[i])) fputs("\\&", out);
        if (text[i] == '\\') /* one way: no text has any */
            fputs("\\e", out);
        else if (text[i] == '-')
            fputs("\\-", out);
        else
            fputc(text[i], out);
    }
}

static void roff_paragraph(FILE *out, const char *text, size_t length) {
    fputs(".PP\n", out);
    put_roff(out, text, length);
    fputc('\n', out);
}

static void roff_entry(FILE *out, const char *label, const char *help) {
    fputs(".TP\n\\fB", out);
    put_roff(out, label, strlen(label));
    fputs("\\fR\n", out);
    put_roff(out, help, strlen(help));
    fputc('\n', out);
}

static void roff_exits(FILE *out) {
    fputs(".SH EXIT STATUS\n", out);
    each_exit(out, roff_entry);
}

static void manual_of_command(FILE *out, const cli_command *command) {
    fprintf(out, "\\fBfroe %s\\fR", command->name);
    synopsis(out, command);
    fputs("\n.SH DESCRIPTION\n", out);
    each_paragraph(out, command->about, roff_paragraph);
    for (const cli_part *part = command->parts; part->title; part++) {
        fputs(".SH ", out);
        for (const char *c = part->title; *c; c++) fputc((toupper)((unsigned char)*c), out);
        fputc('\n', out);
        for (const cli_option *option = part->options; option->type; option++) {
            char label[64];
            option_label(option, label, sizeof label);
            roff_entry(out, label, option->help);
        }
    }
    roff_exits(out);
    fputs(".SH EXAMPLES\n.nf\n", out);
    put_roff(out, command->examples, strlen(command->examples));
    fputs(".fi\n.SH SEE ALSO\n.BR froe (1)\n", out);
}

void cli_manual(FILE *out, const cli_command *command) {
    char upper[32] = "FROE", name[32] = "froe";
    const char *summary = command ? command->summary : "small, exact binary space partitions";
    if (command) {
        snprintf(name, sizeof name, "froe-%s", command->name);
        for (size_t i = 0; name[i]; i++) upper[i] = (char)(toupper)((unsigned char)name[i]), upper[i + 1] = '\0';
    }
    fprintf(out, ".TH %s 1 \"\" \"froe %s\" \"User Commands\"\n.SH NAME\n", upper, froe_version());
    put_roff(out, name, strlen(name));
    fputs(" \\- ", out);
    put_roff(out, summary, strlen(summary));
    fputs("\n.SH SYNOPSIS\n", out);
    if (command) {
        manual_of_command(out, command);
        return;
    }
    fputs("\\fBfroe\\fR COMMAND [options]\n.SH DESCRIPTION\n", out);
    put_roff(out, introduction, strlen(introduction));
    fputs("\n.SH COMMANDS\n", out);
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++) roff_entry(out, command->name, command->summary);
    fputs(".SH OPTIONS\n", out);
    each_option(out, roff_entry);
    roff_exits(out);
    fputs(".SH SEE ALSO\n", out);
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++)
        fprintf(out, ".BR froe\\-%s (1)%s\n", command->name, cli_command_at(i + 1) ? "," : "");
}
