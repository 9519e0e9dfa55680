/* bytes.c: what froe writes to a function, in memory */
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

froe_status web_bytes_end(web_bytes *all, froe_status status, void **bytes, size_t *count, froe_diagnostic *diag) {
    if (status == FROE_OK) {
        *bytes = all->at;
        *count = all->count;
        return FROE_OK;
    }
    free(all->at);
    return all->no_memory ? web_no_memory(diag) : status;
}
