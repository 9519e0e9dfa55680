/* options.c: parsing and printing the settings of a method. */
#include "build/options.h"
#include "support/fail.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct word {
    const char *text;
    int length;
} word;

static word next_word(const char **at) {
    *at += strspn(*at, " ,\t\n");
    word w = {*at, (int)strcspn(*at, " ,\t\n")};
    *at += w.length;
    return w;
}

static bool is_word(const char *name, const char *text, size_t length) {
    return strlen(name) == length && !strncmp(name, text, length);
}

const froe_option_info *options_tuning(const build_method *method) {
    const froe_option_info *o = method->info.options;
    if (!method->tunable) return NULL;
    while (o->name) o++;
    return o + 1;
}

static const froe_option_info *find_option(const froe_option_info *table, const char *name, size_t length) {
    for (const froe_option_info *o = table; o && o->name; o++)
        if (is_word(o->name, name, length)) return o;
    return NULL;
}

static bool parse_value(const froe_option_info *option, const char *text, size_t length, double *out) {
    for (size_t i = 0; option->choices && option->choices[i]; i++)
        if (is_word(option->choices[i], text, length)) {
            *out = (double)i;
            return true;
        }
    /* a plain decimal number that fills the word: only digits, sign, point, e */
    char copy[64], *end;
    if (option->choices || !length || length >= sizeof copy) return false;
    if (strspn(text, "+-.0123456789eE") < length) return false;
    memcpy(copy, text, length);
    copy[length] = 0;
    *out = strtod(copy, &end);
    if (*end) return false;
    bool whole = *out >= -0x1p53 && *out <= 0x1p53 && *out == (double)(int64_t)*out;
    return *out >= option->lo && *out <= option->hi && (whole || !option->whole);
}

froe_status options_parse(const build_method *method, const char *settings, bool tuned, double *value,
                          froe_diagnostic *diag) {
    const froe_option_info *options = method->info.options, *tuning = options_tuning(method);
    for (const froe_option_info *o = options; o && o->name; o++) value[o - options] = o->standard;
    for (const froe_option_info *o = tuning; o && o->name; o++) value[o - options] = o->standard;
    const char *at = settings ? settings : "";
    for (word w = next_word(&at); w.length; w = next_word(&at)) {
        const char *equal = memchr(w.text, '=', (size_t)w.length);
        size_t name = equal ? (size_t)(equal - w.text) : (size_t)w.length;
        const froe_option_info *o = find_option(options, w.text, name);
        if (!o && tuned) o = find_option(tuning, w.text, name);
        if (!o)
            return support_fail(diag, FROE_E_OPTIONS, "Method '%s' has no option '%.*s'.", method->info.name, (int)name,
                                w.text);
        if (!equal || !parse_value(o, equal + 1, (size_t)w.length - name - 1, &value[o - options])) {
            /* says which values there are */
            char list[128] = "";
            for (size_t i = 0; o->choices && o->choices[i]; i++) {
                size_t used = strlen(list);
                snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", o->choices[i]);
            }
            if (o->choices)
                return support_fail(diag, FROE_E_OPTIONS, "option '%.*s': Its value is not one of %s.", w.length,
                                    w.text, list);
            return support_fail(diag, FROE_E_OPTIONS, "option '%.*s': Its value is not a %snumber from %g to %g.",
                                w.length, w.text, o->whole ? "whole " : "", o->lo, o->hi);
        }
    }
    return FROE_OK;
}

void options_print(const build_method *method, const double *value, char *text, size_t capacity) {
    size_t used = 0;
    text[0] = 0;
    for (const froe_option_info *o = method->info.options; o && o->name && used < capacity; o++) {
        double v = value[o - method->info.options];
        const char *gap = used ? " " : "";
        int n = o->choices ? snprintf(text + used, capacity - used, "%s%s=%s", gap, o->name, o->choices[(int)v])
                           : snprintf(text + used, capacity - used, "%s%s=%.17g", gap, o->name, v);
        used += n > 0 ? (size_t)n : 0;
    }
}
