/* log.c: what assimp tells in its log alone: that it leaves something out, or takes an index for another one. The log
 * is one for the whole process, and a listener can neither be added nor removed while another thread writes into it. So
 * froe is added once and stays, and hears only those threads whose import is its own. */
#include "check/check.h"
#include <assimp/cimport.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* What assimp says, and what is left out then. NULL: the file is broken, and the model would be another one. With an
 * end, the name between both is what is left out. */
typedef struct rule {
    const char *said, *end, *left;
} rule;

static const rule rules[] = {
    {"polygon vertex index out of range", NULL, NULL}, /* FBX */
    {"is not a multiple of three (3)", NULL, NULL},
    {"for incoming Model link, ignoring", NULL, "objects that are no meshes"}, /* NURBS */
    {"encountered duplicate object id", NULL, "objects with ids of others"},
    {"LWOB: face index is out of range", NULL, NULL}, /* LightWave */
    {"primitive chunk (METABALL)", NULL, "metaballs"},
    {"primitive chunk (SPLINE)", NULL, "splines"},
    {"LWO2: Ignoring unknown polygon type", NULL, "unknown polygons"},
    {"Collada: Unable to find geometry for ID", NULL, NULL},
    {"3DS: Vertex index overflow", NULL, NULL},
    {"3DS: Chunk overflow", NULL, NULL},
    {"MD2: Vertex index is outside the allowed range", NULL, NULL},
    {"AC3D: Unexpected ", NULL, NULL},
    {"AC3D: material index is out of range", NULL, NULL},
    {"has an invalid index. It will be ignored", NULL, NULL}, /* ASE */
    {"Unable to parse float", NULL, NULL},
    {"Found *MESH_ANIMATION element", NULL, NULL}, /* its last shape would be read */
    {"STEP: ignoring unexpected EOF", NULL, NULL}, /* IFC */
    {"an object with the id #", NULL, NULL},
    {"expected token ')'", NULL, NULL},
    {"error occurred while processing curve", NULL, "broken curves"},
    {"entity, type is ", " ", NULL},
    {"unsupported boolean operator: ", " ", NULL},
    {"skipping openings", NULL, "openings"},
    {"skipping some openings", NULL, "openings"},
    {"could not generate openings", NULL, "openings"},
    {"type is unsupported: `", "`", NULL}, /* Blender */
    {"find a handler for modifier: ", " ", "modifiers"},
};

static _Thread_local io_log *assimp_listener; /* of the import that runs in this thread */

void io_leave(formats_sink *sink, const char *name, size_t length) {
    char *left = sink->report.sorts_left;
    const size_t used = strlen(left), between = used ? 2 : 0, room = sizeof sink->report.sorts_left - used;
    for (const char *at = left; *at; at += strcspn(at, ","), at += strspn(at, ", ")) /* is it there already? */
        if (!strncmp(at, name, length) && (!at[length] || at[length] == ',')) return;
    if (between + length < room) snprintf(left + used, room, "%s%.*s", used ? ", " : "", (int)length, name);
}

/* Lines are like "Warn,  T0: FBX-DOM (TOK_KEY, line 36, col 10) failed to read ...". */
static void hear(const char *line, char *user) {
    io_log *log = assimp_listener;
    const char *text = strstr(line, ": ");
    (void)user;
    if (!log || !text || (strncmp(line, "Warn", 4) != 0 && strncmp(line, "Error", 5) != 0)) return;
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        const rule *r = &rules[i];
        const char *said = strstr(text, r->said);
        if (!said) continue;
        const char *name = said + strlen(r->said);
        if (r->left)
            io_leave(log->sink, r->left, strlen(r->left));
        else if (r->end)
            io_leave(log->sink, name, strcspn(name, r->end[0] == ' ' ? " \r\n" : r->end));
        else if (!*log->damage)
            snprintf(log->damage, sizeof log->damage, "%.*s", (int)strcspn(text + 2, "\r\n"), text + 2);
    }
}

static void attach(void) {
    const struct aiLogStream stream = {.callback = hear};
    aiAttachLogStream(&stream);
}

void io_log_begin(io_log *log) {
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, attach);
    assimp_listener = log;
}

void io_log_end(void) {
    assimp_listener = NULL;
}
