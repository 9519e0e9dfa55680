/* read.c: froe_read: froe's own readers, those of the core, or else 3MF, assimp or OGR. */
#include "readers.h"
#include "support/floats.h"

static formats_reader *choose_library(const formats_source *source) {
    if (io_3mf_recognise(source)) return io_read_3mf;
    return io_assimp_recognise(source) ? io_read_assimp : io_read_ogr;
}

froe_status froe_read(const char *path, const froe_read_options *options, froe_scene **out, froe_read_report *report,
                      froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    const froe_status status = formats_check_reading("froe_read", path, options, out, diag);
    if (status) return status;
    froe_read_options o = options ? *options : froe_read_defaults();
    if (!o.image) o.image = io_read_image;
    if (froe_reads_own(path)) return froe_read_own(path, &o, out, report, diag);
    return formats_read(choose_library, io_read_ogr, path, &o, out, report, diag);
}
