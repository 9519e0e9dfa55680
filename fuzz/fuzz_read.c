/* fuzz_read.c: any bytes as a CSV, OFF, PLY, OBJ or GeoJSON file: the formats that froe parses by itself. (What
 * GDAL and assimp parse, their own fuzzers see to.) A header is put before the bytes, so that
 * they reach the right reader. */
#include "support.h"
#include <froe/formats.h>
#include <stdio.h>

static const struct {
    const char *header, *suffix;
} forms[] = {
    {"x;y\n", ".csv"},
    {"x,y\n", ".csv"},
    {"x,y,z,tag\n", ".csv"},
    {"lo_x,lo_y,hi_x,hi_y\n", ".csv"},
    {"x,y,r\n", ".csv"},
    {"OFF\n", ".off"},
    {"z\tx\ty\tnote\n", ".csv"},
    {"ply\n", ".ply"},
    {"v 0 0 0\n", ".obj"},
    /* by bytes from 252 on, so that what others stand for stays the same */
    {"", ".csv"},
    {"name;lon;lat\n", ".csv"},
    {"{\"type\":\"FeatureCollection\",", ".geojson"},
};
enum { LATER = 3, FORMS = sizeof forms / sizeof *forms - LATER };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char path[256];
    fuzz_bytes bytes = {data, size};
    const uint8_t first = fuzz_byte(&bytes);
    const size_t form = first < 252 ? first % FORMS : (size_t)FORMS + (first - 252) % LATER;
    fuzz_file(forms[form].header, forms[form].suffix, bytes.data, bytes.size, path, sizeof path);
    froe_read_options options = froe_read_defaults();
    options.boxes = size % 2 != 0;
    froe_scene *scene;
    froe_read_report report;
    froe_diagnostic why;
    if (froe_read_own(path, &options, &scene, &report, &why) == FROE_OK) froe_scene_free(scene);
    remove(path);
    return 0;
}
