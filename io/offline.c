/* offline.c: see offline.h. GDAL reaches the network in two ways: it fetches addresses, for which a thread may have a
 * function of its own, and it opens files in virtual file systems such as /vsicurl/, of which a setting allows one. */
#include "offline.h"
#include <cpl_conv.h>
#include <cpl_http.h>
#include <cpl_string.h>

/* Without a result GDAL would fetch the address itself. */
static CPLHTTPResult *fetch_nothing(const char *address, CSLConstList options, GDALProgressFunc progress, void *shown,
                                    CPLHTTPFetchWriteFunc write, void *written, void *user) {
    CPLHTTPResult *result = CPLCalloc(1, sizeof *result);
    (void)address, (void)options, (void)progress, (void)shown, (void)write, (void)written, (void)user;
    result->nStatus = 1;
    result->pszErrBuf = CPLStrdup("No file is read from the network.");
    return result;
}

void io_offline_begin(io_offline *offline) {
    io_setting_begin(&offline->allowed, "CPL_VSIL_CURL_ALLOWED_FILENAME", "");
    CPLHTTPPushFetchCallback(fetch_nothing, NULL);
}

void io_offline_end(io_offline *offline) {
    CPLHTTPPopFetchCallback();
    io_setting_end(&offline->allowed);
}
