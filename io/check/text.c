/* text.c: texts that are looked through before assimp or GDAL reads them. */
#include "check/check.h"

froe_status io_text_refuse(const formats_source *source, formats_sink *sink, const io_fault *fault) {
    return fault->sentence ? support_fail(sink->diag, fault->status, "%s: line %zu: %s", support_short(source->path),
                                          fault->line, fault->sentence)
                           : FROE_OK;
}

froe_status io_text_look(const formats_source *source, formats_sink *sink, bool binary, io_find_fault *find) {
    formats_text text = {0};
    froe_status status = formats_load(source, sink, binary, &text);
    if (!status) {
        const io_fault fault = find(sink, text.data);
        status = io_text_refuse(source, sink, &fault);
    }
    array_free(&sink->alloc, &text);
    return status;
}
