/* version.c: the version, commit and features of this program, set by the build. */
#include "version.h"
#include "report/report.h"
#include <froe/froe.h>

#ifndef FROE_COMMIT
#define FROE_COMMIT ""
#endif
#ifndef FROE_GDAL_VERSION
#define FROE_GDAL_VERSION "unknown"
#endif
#ifndef FROE_ASSIMP_VERSION
#define FROE_ASSIMP_VERSION "unknown"
#endif
#ifndef FROE_CAIRO_VERSION
#define FROE_CAIRO_VERSION "unknown"
#endif

#if defined(__clang__)
#define COMPILER "clang " __clang_version__
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "unknown"
#endif

const char *cli_commit(void) {
    return FROE_COMMIT[0] ? FROE_COMMIT : "unknown";
}

int cli_version(bool json) {
    const cli_common common = {.json = json};
    return cli_report(&common, NULL,
                      json_pack("{s:s, s:s, s:s, s:s, s:s, s:s}", "froe", froe_version(), "commit", cli_commit(),
                                "gdal", FROE_GDAL_VERSION, "assimp", FROE_ASSIMP_VERSION, "cairo", FROE_CAIRO_VERSION,
                                "compiler", COMPILER));
}
