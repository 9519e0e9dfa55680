/* virtual.c: files in the virtual file systems of GDAL, such as those in archives, that are looked through. */
#include "check/check.h"
#include <cpl_vsi.h>
#include <string.h>

froe_status io_virtual_load(const char *path, formats_sink *sink, formats_text *text) {
    enum { AHEAD = 16 }; /* zeros behind the text: numbers are read ahead */
    GByte *bytes = NULL;
    vsi_l_offset size = 0;
    if (!VSIIngestFile(NULL, path, &bytes, &size, -1)) return FROE_E_FORMAT;
    const bool room =
        array_append(&sink->alloc, text, (const char *)bytes, (size_t)size) && array_reserve(&sink->alloc, text, AHEAD);
    VSIFree(bytes);
    if (!room) return support_fail_memory(sink->diag);
    memset(text->data + text->count, 0, AHEAD);
    return FROE_OK;
}
