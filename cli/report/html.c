/* html.c: small pieces of HTML made from reports. */
#include "report/html.h"
#include "files.h"
#include "support/xml.h"
#include "version.h"
#include <froe/froe.h>
#include <string.h>

void html_text(FILE *out, const char *text) {
    char bytes[8];
    for (size_t n; (n = support_xml_escape(&text, bytes));) fwrite(bytes, 1, n, out);
}

/* Digits in groups of three, parted by thin spaces. */
static void put_whole(FILE *out, json_int_t value) {
    char digits[32];
    const int length = snprintf(digits, sizeof digits, "%" JSON_INTEGER_FORMAT, value);
    for (int i = 0; i < length; i++) {
        const int rest = length - i;
        if (i && rest % 3 == 0 && digits[i - 1] != '-') fputs("&#8239;", out);
        fputc(digits[i], out);
    }
}

void html_value(FILE *out, const json_t *value) {
    const double number = json_number_value(value), size = number < 0 ? -number : number;
    if (json_is_integer(value))
        put_whole(out, json_integer_value(value));
    else if (json_is_real(value) && size < 1e15 && (size >= 1000 || number == (double)(json_int_t)number))
        put_whole(out, (json_int_t)number);
    else if (json_is_real(value))
        fprintf(out, "%.4g", number);
    else if (json_is_string(value))
        html_text(out, json_string_value(value));
    else if (json_is_boolean(value))
        fputs(json_is_true(value) ? "yes" : "no", out);
    else
        fputs("&ndash;", out);
}

/* "in_cut" reads "in cut", "defects.crossings" "crossings", "seconds.read" "read, s". */
static void put_label(FILE *out, const char *name) {
    const char *dot = strchr(name, '.');
    for (const char *key = dot ? dot + 1 : name; *key; key++) fputc(*key == '_' ? ' ' : *key, out);
    if (strncmp(name, "seconds.", 8) == 0) fputs(", s", out);
}

/* A key of the report, or "object.key" one level down. */
static const json_t *find(const json_t *report, const char *name) {
    const char *dot = strchr(name, '.');
    if (!dot) return json_object_get(report, name);
    char outer[64];
    snprintf(outer, sizeof outer, "%.*s", (int)(dot - name), name);
    return json_object_get(json_object_get(report, outer), dot + 1);
}

void html_pairs(FILE *out, const json_t *report, const char *const *names) {
    fputs("<table>\n", out);
    for (; *names; names++) {
        const json_t *value = find(report, *names);
        if (!value) continue;
        fputs("<tr><th>", out);
        put_label(out, *names);
        fputs("</th><td>", out);
        html_value(out, value);
        fputs("</td></tr>\n", out);
    }
    fputs("</table>\n", out);
}

void html_headings(FILE *out, const char *const *names) {
    fputs("<tr>", out);
    for (; *names; names++) {
        fputs("<th>", out);
        put_label(out, *names);
        fputs("</th>", out);
    }
    fputs("</tr>\n", out);
}

void html_row(FILE *out, const json_t *report, const char *const *names) {
    fputs("<tr>", out);
    for (; *names; names++) {
        fputs("<td>", out);
        html_value(out, find(report, *names));
        fputs("</td>", out);
    }
    fputs("</tr>\n", out);
}

void html_bounds(FILE *out, const json_t *bounds) {
    if (!json_object_size(bounds)) return;
    fputs("<table class=\"bounds\">\n<tr><th>promise</th><th>promised</th><th>measured</th><th></th></tr>\n", out);
    const char *name;
    json_t *bound;
    json_object_foreach((json_t *)bounds, name, bound) {
        const json_t *promised = json_object_get(bound, "promised"), *measured = json_object_get(bound, "measured");
        const double most = json_number_value(promised), is = json_number_value(measured);
        const double share = most > 0 ? 100 * is / most : is > 0 ? 100 : 0;
        fputs("<tr><th>", out);
        put_label(out, name);
        fputs("</th><td>at most ", out);
        html_value(out, promised);
        fputs("</td><td>", out);
        html_value(out, measured);
        fprintf(out, "</td><td class=\"bar\"><div><i style=\"width:%.1f%%\"></i></div></td></tr>\n",
                share > 100 ? 100 : share);
    }
    fputs("</table>\n", out);
}

static void put_style(FILE *out, const char *name) {
    const cli_embedded *style = name ? cli_embedded_named(name) : NULL;
    if (style) fwrite(style->bytes, 1, style->size, out);
}

void html_begin(FILE *out, const char *title, const char *style) {
    fputs("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
          out);
    html_text(out, title);
    fputs("</title>\n<style>\n", out);
    put_style(out, "page.css");
    put_style(out, style);
    fputs("</style>\n</head>\n<body>\n", out);
}

void html_end(FILE *out) {
    fprintf(out, "</main>\n<footer>froe %s, commit %s</footer>\n</body>\n</html>\n", froe_version(), cli_commit());
}
