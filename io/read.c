/* read.c: froe_read: froe's own readers, those of the core, or else 3MF, assimp or OGR. */
#include "readers.h"
#include "support/floats.h"

static formats_reader *choose_library(const formats_source *source) {
    if (io_3mf_recognise(source)) return io_read_3mf;
    return io_assimp_recognise(source) ? io_read_assimp : io_read_ogr;
}

/* GeoJSON that is not plain is left to GDAL. */
static bool is_collection(const char *path) {
    formats_source source;
    return !formats_source_open(path, NULL, &source, NULL) && formats_is_collection(&source);
}

/* Is a file left to libraries whose reading by the core has ended so? One that cannot be read is not: a read that fails
 * must not choose the reader. */
static bool is_left(const char *path, froe_status status) {
    if (status == FROE_E_IO) return support_path_is_beyond(path);
    return status == FROE_E_UNSUPPORTED && (!froe_reads_own(path) || is_collection(path));
}

froe_status froe_read(const char *path, const froe_read_options *options, froe_scene **out, froe_read_report *report,
                      froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    static const formats_readers libraries = {.choose = choose_library, .maps = io_read_ogr, .beyond = true};
    froe_status status = formats_check_reading("froe_read", path, options, out, diag);
    if (status) return status;
    froe_read_options o = options ? *options : froe_read_defaults();
    if (!o.image) o.image = io_read_image;
    status = froe_read_own(path, &o, out, report, diag);
    return !is_left(path, status) ? status : formats_read(&libraries, path, &o, out, report, diag);
}
