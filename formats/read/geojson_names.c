/* geojson_names.c: see geojson_names.h. */
#include "formats/read/geojson_names.h"
#include <stdio.h>
#include <string.h>

/* Which column has this name, in small letters or capitals? GEOJSON_COLUMNS: none. */
static int column_of(const formats_scan_text *name) {
    static const char *const words[GEOJSON_COLUMNS] = {"name", "title", "label", "id", "layer"};
    int column = 0;
    for (; column < GEOJSON_COLUMNS; column++) {
        const char *word = words[column];
        size_t i = 0;
        while (i < name->length && word[i] && (name->text[i] | 0x20) == word[i]) i++;
        if (i == name->length && !word[i]) break;
    }
    return column;
}

/* null, a string or a whole number. */
static bool read_value(char **at, geojson_value *out) {
    formats_scan_blanks(at);
    char *const first = *at;
    formats_scan_text text;
    double number;
    if (*first == 'n') return out->kind = GEOJSON_NULL, formats_scan_null(at);
    if (*first == '"') {
        out->kind = GEOJSON_TEXT;
        if (!formats_scan_string(at, &text)) return false;
        out->text = formats_scan_decode(&text);
        return true;
    }
    if (!formats_scan_number(at, &number) || (*first == '-' && number == 0)) return false;
    out->kind = GEOJSON_WHOLE;
    out->number = 0;
    const char *const digits = first + (*first == '-');
    for (const char *c = digits; c < *at; c++) { /* an integer holds 18; more may come before a fraction */
        if ((unsigned char)(*c - '0') >= 10 || c - digits == 18) return false;
        out->number = 10 * out->number + (*c - '0');
    }
    if (*first == '-') out->number = -out->number;
    return true;
}

/* Could GDAL take it for a date or a time (OGRParseDate)? */
static bool may_be_date(const char *text) {
    text += strspn(text, " ");
    return ((*text >= '0' && *text <= '9') || *text == '-' || *text == '+') && strpbrk(text, "-/:");
}

bool geojson_read_id(char **at, geojson_feature *feature) {
    geojson_value *id = &feature->id;
    return read_value(at, id) && !(id->kind == GEOJSON_WHOLE && id->number < 0);
}

bool geojson_read_properties(char **at, geojson_names *names, geojson_feature *feature) {
    formats_scan_text name;
    formats_scan_step step;
    for (bool first = true; (step = formats_scan_member(at, first, &name)) == FORMATS_SCAN_MORE; first = false) {
        if (!name.length) return false; /* GDAL takes a whole number in a column without name for that of the feature */
        const int column = column_of(&name);
        if (formats_scan_is(&name, "_rev")) return false; /* of CouchDB, whose features are nested */
        if (column == GEOJSON_COLUMNS) {
            if (!formats_scan_skip(at)) return false;
            continue;
        }
        geojson_value *value = feature->columns + column;
        if (value->kind != GEOJSON_ABSENT || !read_value(at, value)) return false;
        name.text[name.length] = '\0';
        if (!names->columns[column].spelling) names->columns[column].spelling = name.text;
        if (strcmp(names->columns[column].spelling, name.text) != 0) return false;
        if (value->kind != GEOJSON_TEXT) continue;
        *(may_be_date(value->text) ? &names->columns[column].dates : &names->columns[column].words) = true;
    }
    return step == FORMATS_SCAN_END;
}

/* Settles the number of a feature. */
static bool settle_number(geojson_names *names, const geojson_feature *feature, int64_t *number) {
    const geojson_value *id = &feature->id, *property = feature->columns + GEOJSON_ID;
    const char *spelling = names->columns[GEOJSON_ID].spelling;
    const bool own = property->kind && !strcmp(spelling, "id");
    if (id->kind == GEOJSON_WHOLE && !names->numbers && names->own) return false;
    names->numbers = names->numbers || id->kind == GEOJSON_WHOLE;
    names->texts = names->texts || id->kind == GEOJSON_TEXT;
    names->own = names->own || own;
    names->own_numbers = names->own_numbers || (own && property->kind == GEOJSON_WHOLE);
    names->own_texts = names->own_texts || (own && property->kind == GEOJSON_TEXT);
    if (names->texts && (names->numbers || spelling)) return false;
    if (names->own_texts && names->own_numbers && !names->numbers) return false;
    if (property->kind == GEOJSON_WHOLE && property->number < 0) return false;
    *number = id->kind == GEOJSON_WHOLE                                   ? id->number
              : own && property->kind == GEOJSON_WHOLE && !names->numbers ? property->number
                                                                          : names->next++;
    return true;
}

static const char *text_of(const geojson_value *value, char printed[24]) {
    if (value->kind != GEOJSON_WHOLE) return value->kind == GEOJSON_TEXT ? value->text : "";
    snprintf(printed, 24, "%lld", (long long)value->number);
    return printed;
}

bool geojson_label(geojson_names *names, const geojson_feature *feature, geojson_labels *out) {
    int named = 0;
    for (int column = GEOJSON_LABEL; column >= GEOJSON_NAME; column--)
        if (names->columns[column].spelling) named = 1 + column;
    if (names->named && named != names->named) return false; /* features before were called by another column */
    names->named = named;
    if (!settle_number(names, feature, &out->number)) return false;
    static const geojson_value none = {GEOJSON_ABSENT, NULL, 0};
    out->name = text_of(named ? feature->columns + named - 1 : &none, out->printed[0]);
    out->id = text_of(names->texts ? &feature->id : feature->columns + GEOJSON_ID, out->printed[1]);
    out->material = text_of(feature->columns + GEOJSON_LAYER, out->printed[2]);
    return true;
}

bool geojson_names_right(const geojson_names *names) {
    for (int column = 0; column < GEOJSON_COLUMNS; column++)
        if (names->columns[column].dates && !names->columns[column].words) return false;
    return true;
}
