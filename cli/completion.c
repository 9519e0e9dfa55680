/* completion.c: see completion.h. What a script knows of an option is whether it takes a value, and the words that are
 * its values. Where no words are known the shell completes names of files. */
#include "completion.h"
#include "command.h"
#include "exit.h"
#include "report/report.h"
#include <froe/formats.h>
#include <stdio.h>
#include <string.h>

/* Writes a text within single quotes of a shell, or as much of it as `special`, characters to put behind a backslash,
 * leaves plain. A quote ends the quoted text, stands behind a backslash, and begins it again. */
static void put_quoted(const char *text, const char *special) {
    for (; *text; text++) {
        if (*text == '\'')
            fputs("'\\''", stdout);
        else
            printf(strchr(special, *text) ? "\\%c" : "%c", *text);
    }
}

/* The i-th of the words that an option or an operand takes; NULL behind the last, or when they are not known. */
static const char *word_at(const cli_option *option, size_t i) {
    const char *const what = option->name ? option->name : option->value;
    const froe_method_info *method = strcmp(what, "method") != 0 ? NULL : froe_method_at(i);
    const froe_generator_info *kind = strcmp(what, "KIND") != 0 ? NULL : froe_generator_at(i);
    if (option->type == CLI_CHOICE) return option->choices[i];
    return method ? method->name : kind ? kind->name : NULL;
}

static void put_words(const cli_option *option) {
    const char *word;
    for (size_t i = 0; (word = word_at(option, i)) != NULL; i++) printf("%s%s", i ? " " : "", word);
}

typedef void option_fn(const cli_command *command, const cli_option *option);
static void each_option(option_fn *fn) {
    const cli_command *command;
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++)
        for (const cli_part *part = command->parts; part->title; part++)
            for (const cli_option *option = part->options; option->type; option++) fn(command, option);
}

/* -------------------------------------------------------------------- bash -- */

/* What follows an option with a value, or a command whose first operand is one of some words. */
static void bash_values(const cli_command *command, const cli_option *option) {
    if (option->type == CLI_FLAG) return;
    if (!option->name && !word_at(option, 0)) return;
    if (option->name)
        printf("        %s:--%s", command->name, option->name);
    else
        printf("        %s:%s", command->name, command->name);
    if (option->letter) printf("|%s:-%c", command->name, option->letter);
    fputs(") words='", stdout);
    put_words(option);
    puts("' ;;");
}

static void print_bash(void) {
    const cli_command *command;
    fputs("# bash completion for froe\n"
          "_froe() {\n"
          "    local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} words=''\n"
          "    if ((COMP_CWORD == 1)); then\n"
          "        words='--help --version",
          stdout);
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++) printf(" %s", command->name);
    puts("'\n    elif [[ $current == -* ]]; then\n        case ${COMP_WORDS[1]} in");
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++) {
        printf("        %s) words='", command->name);
        for (const cli_part *part = command->parts; part->title; part++)
            for (const cli_option *option = part->options; option->type; option++)
                if (option->name) printf("--%s ", option->name);
        puts("' ;;");
    }
    puts("        esac\n    else\n        case ${COMP_WORDS[1]}:$before in");
    each_option(bash_values);
    puts("        esac\n    fi\n"
         "    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         "}\n"
         "complete -o default -F _froe froe");
}

/* --------------------------------------------------------------------- zsh -- */

/* A line of _arguments; `name` is "", "-o" or "--output". */
static void zsh_option(const cli_option *option, const char *name) {
    const bool value = option->type != CLI_FLAG;
    fputs(" \\\n            '", stdout);
    if (option->type == CLI_TEXTS) putchar('*');
    if (option->name) {
        printf("%s%s[", name, value && name[1] == '-' ? "=" : "");
        put_quoted(option->help, "[]:\\");
        putchar(']');
    }
    if (value) printf(":%s:", option->value);
    if (value && word_at(option, 0)) {
        putchar('(');
        put_words(option);
        putchar(')');
    } else if (value) {
        fputs(option->type == CLI_WHOLE || option->type == CLI_REAL ? " " : "_files", stdout);
    }
    putchar('\'');
}

static void print_zsh(void) {
    const cli_command *command;
    puts("#compdef froe\n"
         "_froe() {\n"
         "    local -a commands=(");
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++) {
        printf("        '%s:", command->name);
        put_quoted(command->summary, ":\\");
        puts("'");
    }
    puts("    )\n"
         "    if ((CURRENT == 2)); then\n"
         "        _describe command commands\n"
         "        return\n"
         "    fi\n"
         "    local command=$words[2]\n"
         "    shift words\n"
         "    ((CURRENT--))\n"
         "    case $command in");
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++) {
        printf("    %s)\n        _arguments", command->name);
        for (const cli_part *part = command->parts; part->title; part++)
            for (const cli_option *option = part->options; option->type; option++) {
                char name[40] = "";
                if (option->name) snprintf(name, sizeof name, "--%s", option->name);
                zsh_option(option, name);
                if (option->letter) zsh_option(option, (char[]){'-', option->letter, '\0'});
            }
        puts("\n        ;;");
    }
    puts("    esac\n}\n_froe \"$@\"");
}

/* -------------------------------------------------------------------- fish -- */

static void fish_option(const cli_command *command, const cli_option *option) {
    if (!option->name && !word_at(option, 0)) return;
    printf("complete -c froe -n '__fish_seen_subcommand_from %s'", command->name);
    if (option->name) printf(" -l %s", option->name);
    if (option->letter) printf(" -s %c", option->letter);
    if (option->type != CLI_FLAG) {
        fputs(word_at(option, 0) ? " -x -a '" : " -r", stdout);
        put_words(option);
        if (word_at(option, 0)) putchar('\'');
    }
    fputs(" -d '", stdout);
    for (const char *at = option->help; *at; at++) printf(strchr("'\\", *at) ? "\\%c" : "%c", *at);
    puts("'");
}

static void print_fish(void) {
    const cli_command *command;
    puts("# fish completion for froe");
    for (size_t i = 0; (command = cli_command_at(i)) != NULL; i++)
        printf("complete -c froe -f -n __fish_use_subcommand -a %s -d '%s'\n", command->name, command->summary);
    each_option(fish_option);
}

int cli_completion(const char *shell) {
    static const struct {
        const char *name;
        void (*print)(void);
    } shells[] = {{"bash", print_bash}, {"zsh", print_zsh}, {"fish", print_fish}};
    for (size_t i = 0; shell && i < sizeof shells / sizeof *shells; i++)
        if (!strcmp(shell, shells[i].name)) {
            shells[i].print();
            return cli_flush();
        }
    return cli_fail_unknown("shell", shell ? shell : "", NULL, "There are: bash, zsh, fish.");
}
