/* csv.c: see csv.h. */
#include "support/text/csv.h"
#include "support/decimal/decimal.h"
#include "support/path.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------ fields -- */

/* The quotation mark that ends what one begins; the end of the text if none does. */
static const char *end_of_quotes(const char *at) {
    for (++at; *at && (*at != '"' || at[1] == '"'); ++at)
        if (*at == '"') ++at;
    return at;
}

static const char *first_of_field(const char *at) {
    while (*at == ' ') ++at;
    return at;
}

char support_csv_separator(const char *text) {
    static const char separators[] = ",;\t";
    size_t counts[3] = {0}, best = 0;
    const char *found;
    bool begins = true; /* a field, whatever separates: quotation marks within fields are letters */
    for (const char *at = text; *at && *at != '\n'; ++at) {
        if (begins && *at == '"') {
            at = end_of_quotes(at);
            if (!*at) break;
            continue;
        }
        found = strchr(separators, *at);
        if (found) ++counts[found - separators];
        begins = found || (begins && *at == ' ');
    }
    for (size_t i = 1; i < 3; ++i)
        if (counts[i] > counts[best]) best = i;
    return counts[best] ? separators[best] : ',';
}

static inline bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/* The text of a field in quotation marks, which begin at `from`, moves to `to`. Returns its end, and where to go on.
 */
static char *unquote(char *to, const char *from, char **rest) {
    const char *end = end_of_quotes(from);
    for (++from; from < end; ++from) {
        if (*from == '"') ++from;
        *to++ = *from;
    }
    *rest = (char *)end + (*end == '"');
    return to;
}

/* Does nothing but blanks stand between the closing quotation mark and the end of the field? */
static bool ends_field(const char *closing, char separator) {
    const char *at = closing + 1;
    while (*at != separator && is_blank(*at)) ++at;
    return !*at || *at == separator || *at == '\n';
}

support_csv_field support_csv_next(char **at, char separator) {
    char *from = *at, *to, *least;
    while (*from == ' ') ++from;
    support_csv_field field = {.text = from, .quoted = *from == '"'};
    to = least = from;
    if (field.quoted) {
        const char *closing = end_of_quotes(from);
        field.open = !*closing;
        if (field.open || ends_field(closing, separator))
            to = least = unquote(to, from, &from);
        else
            to = least = from = (char *)closing + 1;
    }
    const size_t moved = (size_t)(from - to);
    while (*from && *from != separator && *from != '\n') ++from;
    to = from - moved;
    if (moved) memmove(least, least + moved, (size_t)(to - least));
    field.last = *from != separator;
    *at = from + (*from != '\0');
    while (to > least && is_blank(to[-1])) to--;
    *to = '\0';
    if (!field.quoted)
        while (is_blank(*field.text)) field.text++;
    return field;
}

size_t support_csv_line_ends(const support_csv_field *field) {
    size_t count = 0;
    for (const char *at = field->text; field->quoted && (at = strchr(at, '\n')); ++at) ++count;
    return count;
}

bool support_csv_goes_on(const char *text, char separator, bool within) {
    do {
        const char *field = within ? text - 1 : first_of_field(text);
        if (within || *field == '"') {
            field = end_of_quotes(field);
            if (!*field) return true;
            within = false;
        }
        while (*field && *field != separator && *field != '\n') ++field;
        text = field + (*field != '\0');
    } while (*text);
    return false;
}

bool support_csv_plain(char **at, char separator, double *out, bool *last) {
    char *from = *at, *end;
    if ((unsigned char)(*from - '0') >= 10 && *from != '-' && *from != '.') return false; /* blanks may be line ends */
    *out = support_decimal_ahead(from, &end);
    end += *end == '\r';
    if (end == from || (*end && *end != separator && *end != '\n')) return false;
    *last = *end != separator;
    *at = end + (*end != '\0');
    return true;
}

bool support_csv_number(char *field, char separator, double *out) {
    char *end, *comma = separator == ';' ? strchr(field, ',') : NULL;
    if (comma) *comma = '.';
    *out = support_decimal_ahead(field, &end);
    const bool whole = end != field && (!*end || !end[strspn(end, " 	")]);
    if (comma) *comma = ',';
    return whole;
}

void support_csv_point(char *number, char separator) {
    char *comma = separator == ';' ? strchr(number, ',') : NULL;
    if (comma) *comma = '.';
}

/* ------------------------------------------------------------------- names -- */

/* x, z or x7; behind a prefix also 7. */
static int numbered_axis(const char *name, bool sided) {
    static const char letters[] = "xyzw";
    const char *letter = name[0] && !name[1] ? strchr(letters, name[0] | 0x20) : NULL;
    char *end;
    if (letter) return (int)(letter - letters);
    if ((name[0] | 0x20) == 'x')
        ++name;
    else if (!sided)
        return -1;
    if (name[0] < '1' || name[0] > '9') return -1;
    const long number = strtol(name, &end, 10);
    return *end ? -1 : number < 1000 ? (int)number - 1 : 999;
}

int support_csv_axis(const char *name, int family, bool sided) {
    static const struct {
        const char *name;
        int family, axis;
    } places[] = {{"lon", 1, 0}, {"lng", 1, 0},      {"long", 1, 0},    {"longitude", 1, 0}, {"lat", 1, 1},
                  {"z", 1, 2},   {"latitude", 1, 1}, {"easting", 2, 0}, {"northing", 2, 1},  {"z", 2, 2}};
    if (!family) return numbered_axis(name, sided);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        if (places[i].family == family && support_equal_nocase(name, places[i].name)) return places[i].axis;
    return -1;
}

int support_csv_bound(const char *name, int family, bool *high) {
    enum { WORD = 3, LONGEST = 16 };
    const size_t length = strlen(name);
    for (int behind = 0; behind < 2 && length > WORD && length < LONGEST; behind++) {
        char word[WORD + 1], axis[LONGEST];
        const char *from = behind ? name : name + WORD, *end = behind ? name + length - WORD : name + length;
        snprintf(word, sizeof word, "%.*s", WORD, behind ? end : name);
        if (behind && end[-1] == '_') end--;
        if (!behind && *from == '_') from++;
        snprintf(axis, sizeof axis, "%.*s", (int)(end - from), from);
        *high = support_equal_nocase(word, "max");
        const int found = support_csv_axis(axis, family, false);
        if (found >= 0 && (*high || support_equal_nocase(word, "min"))) return found;
    }
    return -1;
}

void support_csv_names(char *out, size_t size, const char *const *names, size_t count) {
    enum { REST = 32 }; /* what is said of those that are left out */
    size_t length = 0;
    *out = '\0';
    for (size_t i = 0; i < count; i++) {
        const char *name = *names[i] ? names[i] : "''";
        if (length + strlen(name) + REST > size) {
            snprintf(out + length, size - length, i ? " and %zu more" : "%zu columns", count - i);
            return;
        }
        length += (size_t)snprintf(out + length, size - length, "%s%s", i ? ", " : "", name);
    }
}
