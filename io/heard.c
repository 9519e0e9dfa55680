/* heard.c: see heard.h. */
#include "heard.h"
#include <cpl_error.h>
#include <gdal.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* The reader of DXF tells of entities that it does not read in notes for developers alone, once for each sort.
 * Viewports are windows of a sheet, in which there is nothing of their own. */
static void hear_note(io_heard *h, const char *text) {
    char name[32], one[sizeof name + 4], all[sizeof h->left.text + 4];
    const char *found = strstr(text, "gnoring ");
    if (!found || !(found = strchr(found, '\'')) || sscanf(found, "'%31[A-Z0-9_]'", name) != 1) return;
    snprintf(one, sizeof one, ", %s,", name);
    snprintf(all, sizeof all, ", %s,", h->left.text);
    if (strcmp(name, "VIEWPORT") != 0 && !strstr(all, one)) io_names_put(&h->left, name);
}

/* So does the reader of OSM of ways with fewer nodes than they name, which it draws without them or leaves out, and of
 * relations without all their ways, which parts of larger files mostly have. */
static bool is_cut(io_heard *h, const char *text) {
    static const char relations[] = "incomplete relations";
    if (strstr(text, "has missing ways") && !strstr(h->left.text, relations)) io_names_put(&h->left, relations);
    return !strncmp(text, "OSM", 3) && (strstr(text, "nodes that could be found") || strstr(text, "nodes instead of"));
}

static void CPL_STDCALL hear(CPLErr class, CPLErrorNum number, const char *text) {
    (void)number;
    io_heard *h = CPLGetErrorHandlerUserData();
    if (class == CE_Debug) hear_note(h, text);
    const bool cut = class == CE_Debug && is_cut(h, text);
    bool about_axes = !strncmp(text, "PROJ", 4); /* froe takes coordinates as they are */
    if ((class < CE_Failure && !cut) || h->failed || about_axes) return;
    h->failed = true;
    snprintf(h->text, sizeof h->text, "%s", strstr(text, h->path) ? "" : text);
    for (char *c = h->text; *c; ++c)
        if (*c == '\n' || *c == '\r') *c = ' ';
}

static void register_drivers(void) {
    GDALAllRegister();
}

void io_gdal_begin(io_heard *heard) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    CPLPushErrorHandlerEx(hear, heard);
    /* Notes are a file beside a map, NAME.gz.properties, that tells how large it is when unpacked. */
    io_setting_begin(&heard->notes, "CPL_VSIL_GZIP_WRITE_PROPERTIES", "NO");
    io_setting_begin(&heard->debug, "CPL_DEBUG", "DXF,OSM");
    pthread_once(&once, register_drivers);
    if (!heard->online) io_offline_begin(&heard->offline);
}

void io_gdal_end(io_heard *heard) {
    if (!heard->online) io_offline_end(&heard->offline);
    io_setting_end(&heard->debug);
    io_setting_end(&heard->notes);
    CPLPopErrorHandler();
    CPLErrorReset();
}

froe_status io_gdal_fail(const io_heard *heard, froe_diagnostic *diag, froe_status status, const char *path,
                         const char *sentence) {
    if (heard->failed && *heard->text)
        return support_fail(diag, status, "%s: OGR reports '%.120s'.", support_short(path), heard->text);
    return support_fail(diag, status, "%s: %s", support_short(path), sentence);
}

void io_names_put(io_names *names, const char *name) {
    const size_t room = sizeof names->text - names->used;
    const size_t length = (size_t)snprintf(names->text + names->used, room, "%s%s", names->count++ ? ", " : "", name);
    names->used += length < room ? length : room - 1;
}
