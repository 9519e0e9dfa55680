/* export.c: froe_export: the pieces, cells or cuts of a tree in a text file, one after the other. */
#include "formats/write/shapes.h"
#include "support/fail.h"
#include "support/floats.h"
#include <stdio.h>

void froe_export_defaults_into(froe_export_options *out, size_t size) {
    const froe_export_options all = {.size = size};
    support_defaults(out, size, &all, sizeof all);
}

bool froe_exports_own(const char *path) {
    return path && formats_shape_file_of(path);
}

typedef struct export_file {
    const formats_shape_file *format;
    formats_writer writer;
    bool any;
} export_file;

static bool put_part(void *user, const froe_part *part) {
    SUPPORT_FLOATS_OWN;
    export_file *file = user;
    file->format->shape(&file->writer, part, !file->any);
    return file->any = true;
}

froe_status froe_export(const froe_tree *tree, const char *path, froe_export_what what,
                        const froe_export_options *options, froe_diagnostic *diag) {
    SUPPORT_FLOATS_OWN;
    if (!tree || !path) return support_fail_null(diag, __func__);
    const froe_scene *scene = froe_tree_scene(tree);
    const int dim = froe_scene_dim(scene);
    froe_diagnostic why;
    export_file file = {.format = formats_shape_file_of(path)};
    if (!file.format || dim < file.format->least_dim || dim > file.format->most_dim) {
        char trees[40];
        snprintf(trees, sizeof trees, "trees of dimension %d", dim);
        return support_fail_ending(diag, FROE_E_UNSUPPORTED, path, trees,
                                   dim == 2   ? ".geojson, .csv or, with GDAL, .gpkg, .fgb or .shp"
                                   : dim == 3 ? ".obj or .csv"
                                              : ".csv");
    }
    froe_status status = file.format->check ? file.format->check(scene, path, diag) : FROE_OK;
    if (!status) status = formats_writer_open(&file.writer, path, diag);
    if (status) return status;
    froe_part like = froe_part_like(what);
    like.dim = dim;
    file.format->begin(&file.writer, scene, &like);
    status = froe_tree_parts(tree, what, options, put_part, &file, &why);
    if (status == FROE_E_UNSUPPORTED)
        support_fail(diag, status, "%s: %s", support_short(path), why.message);
    else if (status && diag)
        *diag = why;
    if (!status) formats_put(&file.writer, file.format->end);
    return formats_writer_close(&file.writer, status);
}
