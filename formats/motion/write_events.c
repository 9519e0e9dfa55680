/* write_events.c: froe_event_writer: the events of a kinetic partition, as a table written while they happen. */
#include "formats/write/writer.h"
#include "support/alloc.h"
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

/* The locale is the caller's between the calls. */
static void flush_events(froe_event_writer *writer) {
    formats_writer *w = &writer->writer;
    for (const froe_event *e = writer->events, *end = e + writer->count; e != end; e++) {
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
    writer->count = 0;
}

froe_status froe_event_writer_new(const char *path, const froe_allocator *given, froe_event_writer **out,
                                  froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!path || !out) return support_fail_null(diag, __func__);
    if (strcmp(support_path_extension(path).text, "csv") != 0)
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, "events", ".csv");
    const froe_allocator alloc = support_allocator(given);
    froe_event_writer *w = support_calloc(&alloc, 1, sizeof *w);
    if (!w) return support_fail_memory(diag);
    w->alloc = alloc;
    const froe_status status = formats_writer_open(&w->writer, path, diag);
    if (status) {
        support_free(&alloc, w, sizeof *w);
        return status;
    }
    support_locale_leave(&w->writer.locale);
    formats_put(&w->writer, "tick,early,late,kind,objects,a,b,c,d\n");
    *out = w;
    return FROE_OK;
}

bool froe_event_writer_put(froe_event_writer *w, const froe_event *event) {
    SUPPORT_FLOATS_OWN;
    if (w->count == ROOM) {
        if (!support_locale_enter(&w->writer.locale)) {
            w->status = FROE_E_MEMORY;
            return false;
        }
        flush_events(w);
        support_locale_leave(&w->writer.locale);
    }
    w->events[w->count++] = *event;
    return !w->writer.out.error;
}

froe_status froe_event_writer_close(froe_event_writer *w, froe_status status, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!w) return status;
    const froe_allocator alloc = w->alloc;
    const bool entered = support_locale_enter(&w->writer.locale);
    w->writer.out.diag = diag;
    if (!status && (w->status || !entered)) status = support_fail_memory(diag);
    if (!status) flush_events(w);
    if (entered) support_locale_leave(&w->writer.locale);
    status = support_writer_close(&w->writer.out, status);
    support_free(&alloc, w, sizeof *w);
    return status;
}
