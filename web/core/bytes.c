/* bytes.c: what froe writes to a function, and what its visitors collect, in memory */
#include "web.h"
#include <stdlib.h>
#include <string.h>

bool web_bytes_take(void *user, const void *bytes, size_t count) {
    web_bytes *all = user;
    if (all->count + count > all->room) {
        const size_t room = 2 * all->room + count;
        unsigned char *more = realloc(all->at, room);
        if (!more) return !(all->no_memory = true);
        all->at = more;
        all->room = room;
    }
    memcpy(all->at + all->count, bytes, count);
    all->count += count;
    return true;
}

WEB_EXPORT void web_bytes_free(web_bytes *all) {
    free(all->at);
    *all = (web_bytes){NULL, 0, 0, false};
}
froe_status web_bytes_end(web_bytes *all, froe_status status, froe_diagnostic *diag) {
    if (all->no_memory) status = web_no_memory(diag);
    if (status != FROE_OK) web_bytes_free(all);
    return status;
}

WEB_EXPORT void web_free(void *memory) {
    free(memory);
}
