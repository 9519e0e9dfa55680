/* html.c: small pieces of HTML made from reports. */
#include "report/html.h"
#include "embedded.h"
#include "support/escape.h"
#include "version.h"
#include <froe/froe.h>
#include <math.h>
#include <string.h>

void html_text(FILE *out, const char *text) {
    char bytes[8];
    for (size_t n; (n = support_xml_escape(&text, bytes));) fwrite(bytes, 1, n, out);
}

void html_element(FILE *out, const char *tag, const char *text) {
    fprintf(out, "<%s>", tag);
    html_text(out, text);
    fprintf(out, "</%s>\n", tag);
}

void html_command_begin(FILE *out) {
    fputs("<div class=\"command\"><code>", out);
}

void html_command(FILE *out, const char *words) {
    fputs("froe ", out);
    html_text(out, words);
    fputc('\n', out);
}

void html_command_end(FILE *out) {
    fputs("</code></div>\n", out);
}

/* Buttons are made by the script: where none runs, there is none, and a click on the line selects all of it. */
void html_copying(FILE *out) {
    fputs("<script>\n"
          "for (const line of document.querySelectorAll('.command')) {\n"
          "  const button = line.appendChild(document.createElement('button'));\n"
          "  button.type = 'button'; button.textContent = 'Copy';\n"
          "  button.onclick = async () => {\n"
          "    getSelection().selectAllChildren(line.firstChild);\n"
          "    try { await navigator.clipboard.writeText(line.firstChild.textContent); }\n"
          "    catch { document.execCommand('copy'); }\n"
          "    button.textContent = 'Copied'; setTimeout(() => button.textContent = 'Copy', 1500);\n"
          "  };\n}\n</script>\n",
          out);
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
    const double number = json_number_value(value), size = fabs(number);
    if (json_is_integer(value))
        put_whole(out, json_integer_value(value));
    else if (json_is_real(value) && size < 1e15 && (size >= 1000 || number == (double)(json_int_t)number))
        put_whole(out, (json_int_t)number);
    else if (json_is_real(value))
        fprintf(out, "%.3g", number);
    else if (json_is_string(value))
        html_text(out, json_string_value(value));
    else
        fputs("&ndash;", out);
}

/* A key of the report, or "object.key" one level down. */
static const json_t *find(const json_t *report, const char *name) {
    const char *dot = strchr(name, '.');
    if (!dot) return json_object_get(report, name);
    char outer[64];
    snprintf(outer, sizeof outer, "%.*s", (int)(dot - name), name);
    return json_object_get(json_object_get(report, outer), dot + 1);
}

static void put_field(FILE *out, const json_t *value) {
    fputs("<td>", out);
    html_value(out, value);
    fputs("</td>", out);
}

void html_pairs(FILE *out, const json_t *report, const html_field *fields) {
    fputs("<div class=\"scroll\"><table>\n", out);
    for (; fields->key; fields++) {
        const json_t *value = find(report, fields->key);
        if (!value) continue;
        fprintf(out, "<tr><th scope=\"row\">%s</th>", fields->label);
        put_field(out, value);
        fputs("</tr>\n", out);
    }
    fputs("</table></div>\n", out);
}

void html_rows(FILE *out, const json_t *reports, const html_field *fields) {
    size_t i;
    json_t *report;
    fputs("<div class=\"scroll\"><table>\n<thead><tr>", out);
    for (const html_field *f = fields; f->key; f++) fprintf(out, "<th scope=\"col\">%s</th>", f->label);
    fputs("</tr></thead>\n<tbody>\n", out);
    json_array_foreach((json_t *)reports, i, report) {
        fputs("<tr>", out);
        for (const html_field *f = fields; f->key; f++) put_field(out, find(report, f->key));
        fputs("</tr>\n", out);
    }
    fputs("</tbody>\n</table></div>\n", out);
}

void html_bounds(FILE *out, const json_t *bounds) {
    fputs("<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">promise</th><th scope=\"col\">at most</th>"
          "<th scope=\"col\">came out</th><th class=\"bar\"></th></tr></thead>\n<tbody>\n",
          out);
    const char *name;
    json_t *bound;
    json_object_foreach((json_t *)bounds, name, bound) {
        const json_t *promised = json_object_get(bound, "promised"), *measured = json_object_get(bound, "measured");
        const double most = json_number_value(promised), is = json_number_value(measured);
        const double share = most > 0 ? 100 * is / most : is > 0 ? 100 : 0;
        fputs("<tr><th scope=\"row\">", out);
        for (const char *c = name; *c; c++) fputc(*c == '_' ? ' ' : *c, out);
        fputs("</th>", out);
        put_field(out, promised);
        put_field(out, measured);
        fprintf(out, "<td class=\"bar\"><div><i style=\"width:%.1f%%\"></i></div></td></tr>\n",
                share > 100 ? 100 : share);
    }
    fputs("</tbody>\n</table></div>\n", out);
}

static void put_style(FILE *out, const char *name) {
    const support_embedded *style = name ? support_embedded_named(cli_embedded_files, name) : NULL;
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
