/* write_contacts.c: froe_write_contacts: contacts as a table, CSV or JSON: one list of columns for both. */
#include "formats/write/writer.h"
#include "support/floats.h"
#include <string.h>

typedef enum column_type { WHOLE, NUMBER, NAME } column_type;

static const struct {
    const char *name;
    column_type type;
} columns[] = {
    {"a", WHOLE},        {"b", WHOLE},         {"begin_low", NUMBER}, {"begin_high", NUMBER},
    {"end_low", NUMBER}, {"end_high", NUMBER}, {"instant", WHOLE},    {"since_start", WHOLE},
    {"to_stop", WHOLE},  {"a_name", NAME},     {"b_name", NAME},
};
enum { COLUMNS = sizeof columns / sizeof *columns };

static void put_contact_cell(formats_writer *w, const froe_motion *m, const froe_contact *c, int column, bool json) {
    const uint64_t wholes[] = {c->a, c->b, 0, 0, 0, 0, c->instant, c->since_start, c->to_stop};
    const double numbers[] = {0, 0, c->begin[0], c->begin[1], c->end[0], c->end[1]};
    const uint32_t group = froe_motion_object(m, column == COLUMNS - 1 ? c->b : c->a).group;
    if (columns[column].type == WHOLE)
        formats_put_whole(w, wholes[column]);
    else if (columns[column].type == NUMBER)
        formats_put_number(w, numbers[column]);
    else
        (json ? formats_put_json : formats_put_csv)(w, group == FROE_NONE ? "" : froe_motion_group(m, group).name);
}

froe_status froe_write_contacts(const froe_motion *motion, const froe_contact *contacts, size_t count, const char *path,
                                froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!motion || !path || (count && !contacts)) return support_fail_null(diag, __func__);
    support_extension extension = support_path_extension(path);
    bool json = strcmp(extension.text, "json") == 0;
    if (!json && strcmp(extension.text, "csv") != 0)
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, "contacts", ".csv or .json");
    formats_writer w;
    froe_status status = formats_writer_open(&w, path, diag);
    if (status) return status;
    if (json) formats_put(&w, "[");
    for (int k = 0; k < COLUMNS && !json; k++) formats_put(&w, k ? "," : ""), formats_put(&w, columns[k].name);
    if (!json) formats_put(&w, "\n");
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < COLUMNS; k++) {
            if (json) {
                formats_put(&w, k ? ", " : i ? ",\n {" : "\n {");
                formats_put_json(&w, columns[k].name);
            }
            formats_put(&w, json ? ": " : k ? "," : "");
            put_contact_cell(&w, motion, contacts + i, k, json);
        }
        formats_put(&w, json ? "}" : "\n");
    }
    if (json) formats_put(&w, "\n]\n");
    return formats_writer_close(&w, FROE_OK);
}
