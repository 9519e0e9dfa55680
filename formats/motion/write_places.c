/* write_places.c: froe_write_places: the exact places of the ends of a snapshot's objects, as a table: x / w, y / w. */
#include "formats/write/writer.h"
#include "support/floats.h"
#include <string.h>

enum {
    MOST_DIGITS = 1 << 13
}; /* twice as many as there may be: two times squared and a coordinate, of 2098 bits each */

static void put_whole(formats_writer *w, const froe_whole *number) {
    char digits[MOST_DIGITS];
    froe_whole_text(number, digits, MOST_DIGITS);
    formats_put(w, ",");
    formats_put(w, digits);
}

froe_status froe_write_places(const froe_places *places, const char *path, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!places || !path) return support_fail_null(diag, __func__);
    if (strcmp(support_path_extension(path).text, "csv") != 0)
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, "exact places", ".csv");
    formats_writer w;
    froe_status status = formats_writer_open(&w, path, diag);
    if (status) return status;
    formats_put(&w, "object,end,x,y,w,rounded\n");
    froe_exact_place at;
    for (uint32_t i = 0; i < froe_places_count(places); i++)
        for (int end = 0; end < 2 && froe_places_end(places, i, end, &at); end++) {
            formats_put_whole(&w, i);
            formats_put(&w, end ? ",1" : ",0");
            put_whole(&w, &at.x);
            put_whole(&w, &at.y);
            put_whole(&w, &at.w);
            formats_put(&w, at.rounded ? ",1\n" : ",0\n");
        }
    return formats_writer_close(&w, FROE_OK);
}
