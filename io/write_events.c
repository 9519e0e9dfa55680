/* write_events.c: what happened in a kinetic partition, as a table. */
#include "support/floats.h"
#include "writer.h"
#include <string.h>

static void put_event(io_writer *w, const froe_event *e) {
    io_put_number(w, (double)e->tick); /* whole, below 2^53 */
    io_put(w, ",");
    io_put_number(w, e->early);
    io_put(w, ",");
    io_put_number(w, e->late);
    io_put(w, ",");
    io_put(w, froe_event_name(e->kind));
    io_put(w, ",");
    io_put_whole(w, e->object_count);
    for (unsigned i = 0; i < 4; i++) {
        io_put(w, ",");
        if (i < e->object_count) io_put_whole(w, e->objects[i]);
    }
    io_put(w, "\n");
}

froe_status froe_write_events(const froe_event *events, size_t count, const char *path, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!path || (count && !events))
        return io_fail(diag, FROE_E_ARG, "froe_write_events: events and path must not be NULL");
    io_extension extension = io_path_extension(path);
    if (strcmp(extension.text, "csv") != 0)
        return io_fail(diag, FROE_E_UNSUPPORTED, "%s: events are written as .csv", io_short(path));
    io_writer w;
    froe_status status = io_writer_open(&w, path, diag);
    if (status) return status;
    io_put(&w, "tick,early,late,kind,objects,a,b,c,d\n");
    for (size_t i = 0; i < count; i++) put_event(&w, events + i);
    return io_writer_close(&w, FROE_OK);
}
