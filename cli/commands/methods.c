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

/* ------------------------------------------------------------------- JSON -- */

static json_t *dims_json(const uint32_t *kinds) {
    json_t *list = json_array();
    for (int d = 0; d <= FROE_MAX_DIM; d++)
        if (kinds[d]) json_array_append_new(list, json_integer(d));
    return list;
}

/* By dimension. */
static json_t *kinds_json(const uint32_t *kinds) {
    json_t *all = json_object();
    for (int d = 0; d <= FROE_MAX_DIM; d++) {
        json_t *list = json_array();
        for (int k = 0; k < FROE_KIND_COUNT; k++)
            if (kinds[d] >> k & 1) json_array_append_new(list, json_string(froe_kind_name((froe_kind)k)));
        const char name[] = {(char)('0' + d), 0};
        if (kinds[d]) json_object_set(all, name, list);
        json_decref(list);
    }
    return all;
}

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
    json_t *list = json_array();
    for (const froe_option_info *o = m->options; o && o->name; o++) json_array_append_new(list, option_json(o));
    return json_pack("{s:s, s:s, s:s, s:s, s:o, s:o, s:i, s:o}", "name", m->name, "summary", m->summary, "source",
                     m->source, "guarantee", m->guarantee, "dims", dims_json(m->kinds), "kinds", kinds_json(m->kinds),
                     "leaf", m->leaf ? (int)m->leaf : 1, "options", list);
}

/* ------------------------------------------------------------------- text -- */

enum { COLUMN = 14 };

static void put_line(const char *label, const char *text) {
    cli_wrap(stdout, text, strlen(text), printf("  %s", label), COLUMN);
}

/* A line for all dimensions with the same kinds. */
static void put_kinds(const froe_method_info *m) {
    for (int d = 0, last; d <= FROE_MAX_DIM; d = last + 1) {
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
}

static void put_option(const froe_option_info *o) {
    char standard[32], lo[32], hi[32], text[500];
    if (o->choices) {
        size_t used = (size_t)snprintf(text, sizeof text, "%s: ", o->summary);
        for (size_t i = 0; o->choices[i] && used < sizeof text; i++)
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
    put_kinds(m);
    if (m->options && m->options->name) printf("  options, with their defaults:\n");
    for (const froe_option_info *o = m->options; o && o->name; o++) put_option(o);
}

/* -------------------------------------------------------------------- run -- */

static bool is_wanted(const methods_args *args, const froe_method_info *m) {
    return !args->name || strcmp(args->name, m->name) == 0;
}

static int print_text(const methods_args *args) {
    const froe_method_info *m;
    for (size_t i = 0, printed = 0; (m = froe_method_at(i)) != NULL; i++) {
        if (!is_wanted(args, m)) continue;
        if (printed++) putchar('\n');
        put_method(m);
    }
    return cli_flush();
}

static int print_json(const methods_args *args) {
    json_t *list = json_array();
    const froe_method_info *m;
    for (size_t i = 0; (m = froe_method_at(i)) != NULL; i++)
        if (is_wanted(args, m)) json_array_append_new(list, method_json(m));
    return cli_report(&args->common, NULL, json_pack("{s:o}", "methods", list));
}

static int run_methods(const void *given) {
    const methods_args *args = given;
    bool known = !args->name;
    const froe_method_info *m;
    for (size_t i = 0; !known && (m = froe_method_at(i)) != NULL; i++) known = is_wanted(args, m);
    if (!known) return cli_fail_unknown("method", args->name, NULL, "froe methods lists what there is.");
    if (args->common.json) return print_json(args);
    return args->common.quiet ? 0 : print_text(args);
}

const cli_command cli_command_methods = {
    .name = "methods",
    .summary = "builders with source, dimensions, guarantee and options",
    .about = "Lists what --method of froe build takes. Options of a method are set by --option NAME=VALUE.",
    .examples = "froe methods\nfroe methods density\nfroe methods --json\n",
    .parts = parts,
    .defaults = &(const methods_args){.common = CLI_COMMON_DEFAULTS},
    .size = sizeof(methods_args),
    .run = run_methods,
};
