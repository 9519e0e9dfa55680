/* virtual.c: files in the virtual file systems of GDAL, such as those in archives, that are looked through. */
#include "check/check.h"
#include "heard.h"
#include "support/decimal/decimal.h"
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <stdio.h>
#include <string.h>

froe_status io_virtual_load(const char *path, formats_sink *sink, formats_text *text) {
    enum { BEHIND = 1 + SUPPORT_DECIMAL_AHEAD }; /* zeros behind the text, as formats_load_part() has them */
    GByte *bytes = NULL;
    vsi_l_offset size = 0;
    if (!VSIIngestFile(NULL, path, &bytes, &size, -1)) return FROE_E_FORMAT;
    const bool room = array_append(&sink->alloc, text, (const char *)bytes, (size_t)size) &&
                      array_reserve(&sink->alloc, text, BEHIND);
    VSIFree(bytes);
    if (!room) return support_fail_memory(sink->diag);
    memset(text->data + text->count, 0, BEHIND);
    return FROE_OK;
}

/* Loads a file of an archive. */
static froe_status load_packed(const formats_source *source, formats_sink *sink, const char *file, formats_text *text) {
    static const char form[] = "/vsizip/{%s}/%s";
    const size_t size = sizeof form + strlen(source->file) + strlen(file);
    char *path = support_calloc(&sink->alloc, 1, size);
    if (!path) return support_fail_memory(sink->diag);
    snprintf(path, size, form, source->file, file);
    const froe_status status = io_virtual_load(path, sink, text);
    support_free(&sink->alloc, path, size);
    return status;
}

froe_status io_archive_look(const formats_source *source, formats_sink *sink, const char *extension, io_look_fn *look) {
    io_heard heard = {.path = source->file};
    froe_status status = FROE_OK;
    io_gdal_begin(&heard);
    char **files = VSIReadDirRecursive(CPLSPrintf("/vsizip/{%s}", source->file));
    for (char **file = files; file && *file && !status; file++) {
        formats_text text = {0};
        if (strcmp(support_path_extension(*file).text, extension) != 0) continue;
        status = load_packed(source, sink, *file, &text);
        if (status == FROE_E_FORMAT)
            status = io_gdal_fail(&heard, sink->diag, FROE_E_FORMAT, source->path, "It cannot be unpacked.");
        if (!status) status = look(&text, sink);
        array_free(&sink->alloc, &text);
    }
    CSLDestroy(files);
    io_gdal_end(&heard);
    return status;
}
