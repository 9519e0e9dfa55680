/* methods.c: froe methods, the builders and what they promise. */
#include "command.h"
#include "exit.h"
#include "report/report.h"
#include <froe/froe.h>
#include <string.h>

typedef struct methods_args {
    cli_common common;
    const char *name;
} methods_args;

static const cli_option options[] = {
    {NULL, 0, CLI_TEXT, offsetof(methods_args, name), "METHOD", .help = "tell about this one only"},
    {0},
};

static const cli_part parts[] = {{"Methods", options, 0}, {"Options", cli_common_options, 0}, {0}};

static json_t *option_json(const froe_option_info *o) {
    if (!o->choices)
        return json_pack("{s:s, s:s, s:f, s:f, s:f, s:b}", "name", o->name, "summary", o->summary, "default",
                         o->standard, "lo", o->lo, "hi", o->hi, "whole", (int)o->whole);
    json_t *choices = json_array();
    for (size_t i = 0; o->choices[i]; i++) json_array_append_new(choices, json_string(o->choices[i]));
    return json_pack("{s:s, s:s, s:s, s:o}", "name", o->name, "summary", o->summary, "default",
                     o->choices[(size_t)o->standard], "choices", choices);
}

static json_t *method_json(const froe_method_info *m) {
    json_t *dims = json_array(), *kinds = json_object(), *list = json_array();
    for (int d = 0; d <= FROE_MAX_DIM; d++) {
        if (!m->kinds[d]) continue;
        const char name[] = {(char)('0' + d), 0};
        json_t *served = json_array();
        for (int k = 0; k < FROE_KIND_COUNT; k++)
            if (m->kinds[d] >> k & 1) json_array_append_new(served, json_string(froe_kind_name((froe_kind)k)));
        json_array_append_new(dims, json_integer(d));
        json_object_set_new(kinds, name, served);
    }
    for (const froe_option_info *o = m->options; o->name; o++) json_array_append_new(list, option_json(o));
    return json_pack("{s:s, s:s, s:s, s:s, s:o, s:o, s:i, s:o}", "name", m->name, "summary", m->summary, "source",
                     m->source, "guarantee", m->guarantee, "dims", dims, "kinds", kinds, "leaf",
                     m->leaf ? (int)m->leaf : 1, "options", list);
}

enum { COLUMN = 14 };

static void put_line(const char *label, const char *text) {
    cli_wrap(stdout, text, strlen(text), printf("  %s", label), COLUMN);
}

static void put_option(const froe_option_info *o) {
    char standard[32], lo[32], hi[32], text[500];
    if (o->choices) {
        size_t used = (size_t)snprintf(text, sizeof text, "%s: ", o->summary);
        for (size_t i = 0; o->choices[i] && used < sizeof text; i++) /* one way: there is room */
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%s", i ? ", " : "", o->choices[i]);
        snprintf(standard, sizeof standard, "%s", o->choices[(size_t)o->standard]);
    } else {
        cli_number(standard, o->standard), cli_number(lo, o->lo), cli_number(hi, o->hi);
        snprintf(text, sizeof text, "%s (%s to %s)", o->summary, lo, hi);
    }
    const int at = printf("  %-*s%s=%s  ", COLUMN - 2, "", o->name, standard);
    cli_wrap(stdout, text, strlen(text), at, COLUMN + 2);
}

static void put_method(const froe_method_info *m) {
    printf("%s\n", m->name);
    put_line("", m->summary);
    put_line("source", m->source);
    put_line("guarantee", m->guarantee);
    for (int d = 0, last; d <= FROE_MAX_DIM; d = last + 1) { /* a line for all dimensions with the same kinds */
        char label[32], list[100] = "";
        for (last = d; last < FROE_MAX_DIM && m->kinds[last + 1] == m->kinds[d];) last++;
        if (!m->kinds[d]) continue;
        snprintf(label, sizeof label, d < last ? "in R^%d..R^%d" : "in R^%d", d, last);
        for (int k = 0; k < FROE_KIND_COUNT; k++) {
            const size_t used = strlen(list);
            if (m->kinds[d] >> k & 1)
                snprintf(list + used, sizeof list - used, "%s%s", used ? ", " : "", froe_kind_name((froe_kind)k));
        }
        put_line(label, list);
    }
    if (m->options->name) /* one way: each method has options */
        printf("  options, with their defaults:\n");
    for (const froe_option_info *o = m->options; o->name; o++) put_option(o);
}

static int run_methods(const void *given) {
    const methods_args *args = given;
    const froe_method_info *m;
    json_t *list = args->common.json ? json_array() : NULL;
    size_t found = 0;
    for (size_t i = 0; (m = froe_method_at(i)) != NULL; i++) {
        if (args->name && strcmp(args->name, m->name) != 0) continue;
        found++;
        if (args->common.json) {
            json_array_append_new(list, method_json(m));
        } else if (!args->common.quiet) {
            if (found > 1) putchar('\n');
            put_method(m);
        }
    }
    if (!found) {
        json_decref(list);
        return cli_fail_unknown("method", args->name, NULL, "froe methods lists what there is.");
    }
    if (args->common.json) return cli_report(&args->common, NULL, json_pack("{s:o}", "methods", list));
    return args->common.quiet ? 0 : cli_flush();
}

const cli_command cli_command_methods = {
    .name = "methods",
    .summary = "list the methods of building: source, dimensions, guarantee and options",
    .about = "Lists what --method of froe build takes. Options of a method are set by --option NAME=VALUE.",
    .examples = "froe methods\nfroe methods density\nfroe methods --json\n",
    .parts = parts,
    .defaults = &(const methods_args){.common = CLI_COMMON_DEFAULTS},
    .size = sizeof(methods_args),
    .run = run_methods,
};
