/* text.c: texts that are looked through before assimp or GDAL reads them. */
#include "check/check.h"

froe_status io_text_look(const formats_source *source, formats_sink *sink, bool binary, io_find_fault *find) {
    formats_text text = {0};
    io_fault fault = {.sentence = NULL};
    froe_status status = formats_load(source, sink, binary, &text);
    if (!status) fault = find(sink, text.data);
    if (fault.sentence)
        status = support_fail(sink->diag, fault.status, "%s: line %zu: %s", support_short(source->path), fault.line,
                              fault.sentence);
    array_free(&sink->alloc, &text);
    return status;
}
