/* write_events.c: what happens in a kinetic partition, as a table that is written while it happens. */
#include "formats/write/writer.h"
#include "support/floats.h"
#include <string.h>

enum { ROOM = 512 }; /* events that wait to be written */

struct froe_event_writer {
    froe_allocator alloc;
    formats_writer writer;
    froe_status status; /* the first failure of writing events */
    size_t count;
    froe_event events[ROOM];
};

static void put_event(formats_writer *w, const froe_event *e) {
    formats_put_number(w, (double)e->tick); /* whole, below 2^53 */
    formats_put(w, ",");
    formats_put_number(w, e->early);
    formats_put(w, ",");
    formats_put_number(w, e->late);
    formats_put(w, ",");
    formats_put(w, froe_event_name(e->kind));
    formats_put(w, ",");
    formats_put_whole(w, e->object_count);
    for (unsigned i = 0; i < 4; i++) {
        formats_put(w, ",");
        if (i < e->object_count) formats_put_whole(w, e->objects[i]);
    }
    formats_put(w, "\n");
}

/* The locale is the caller's between the calls. */
static void flush_events(froe_event_writer *w) {
    for (size_t i = 0; i < w->count; i++) put_event(&w->writer, w->events + i);
    w->count = 0;
}

froe_status froe_event_writer_new(const char *path, const froe_allocator *given, froe_event_writer **out,
                                  froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!path || !out) return support_fail(diag, FROE_E_ARG, "froe_event_writer_new: path and out must not be NULL");
    if (strcmp(formats_path_extension(path).text, "csv") != 0)
        return support_fail(diag, FROE_E_UNSUPPORTED, "%s: events are written as .csv", support_short(path));
    const froe_allocator alloc = support_allocator(given);
    froe_event_writer *w = NULL;
    support_callback(w = alloc.fn(alloc.user, NULL, 0, sizeof *w));
    if (!w) return support_fail_memory(diag);
    *w = (froe_event_writer){.alloc = alloc};
    const froe_status status = formats_writer_open(&w->writer, path, diag);
    if (status) {
        support_callback(alloc.fn(alloc.user, w, sizeof *w, 0));
        return status;
    }
    formats_locale_leave(&w->writer.locale);
    formats_put(&w->writer, "tick,early,late,kind,objects,a,b,c,d\n");
    *out = w;
    return FROE_OK;
}

bool froe_event_writer_put(froe_event_writer *w, const froe_event *event) {
    SUPPORT_FLOATS_OWN;
    if (w->count == ROOM) {
        if (!formats_locale_enter(&w->writer.locale)) {
            w->status = FROE_E_MEMORY;
            return false;
        }
        flush_events(w);
        formats_locale_leave(&w->writer.locale);
    }
    w->events[w->count++] = *event;
    return !w->writer.out.error;
}

froe_status froe_event_writer_close(froe_event_writer *w, froe_status status, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!w) return status;
    const froe_allocator alloc = w->alloc;
    const bool entered = formats_locale_enter(&w->writer.locale);
    w->writer.out.diag = diag;
    if (!status && (w->status || !entered)) status = support_fail_memory(diag);
    if (!status) flush_events(w);
    if (entered) formats_locale_leave(&w->writer.locale);
    status = support_writer_close(&w->writer.out, status);
    support_callback(alloc.fn(alloc.user, w, sizeof *w, 0));
    return status;
}
