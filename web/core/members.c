/* members.c: options by the names of their members; refusals; progress */
#include "web.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Module.progress is what package/core.js sets. */
EM_JS(int, web_tell, (double done), { return Module.progress ? Module.progress(done) : 1; })

bool web_progress(void *user, double done) {
    (void)user;
    return web_tell(done);
}

static froe_status refuse(froe_diagnostic *diag, const char *pattern, const char *a, const char *b) {
    diag->status = FROE_E_OPTIONS;
    diag->object = diag->corner = diag->axis = FROE_NONE;
    snprintf(diag->message, sizeof diag->message, pattern, a, b);
    return FROE_E_OPTIONS;
}

froe_status web_no_memory(froe_diagnostic *diag) {
    refuse(diag, "The page has no more memory%s%s.", "", "");
    return diag->status = FROE_E_MEMORY;
}

/** The kind of this name, or NULL. */
WEB_EXPORT const web_kind *web_kind_of(const char *name) {
    static const web_kind *const kinds[] = {
        &web_objects, &web_read_options,   &web_build_options, &web_batch,          &web_range,
        &web_audit,   &web_render_options, &web_line_style,    &web_export_options, &web_motion,
        &web_moving,  &web_body,           &web_contacts,      &web_kinetic,        &web_snapshot,
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (!strcmp(kinds[i]->name, name)) return kinds[i];
    return NULL;
}
WEB_EXPORT size_t web_kind_size(const web_kind *kind) {
    return kind->size;
}
WEB_EXPORT void web_kind_defaults(const web_kind *kind, void *options) {
    kind->defaults(options);
}

static const web_member *find(const web_kind *kind, const char *name) {
    for (const web_member *member = kind->members; member->name; member++) {
        const size_t length = strlen(member->name);
        if (member->type == WEB_VECTOR ? !strncmp(name, member->name, length) && name[length] == '.' &&
                                             name[length + 1] && strchr("012", name[length + 1]) && !name[length + 2]
                                       : !strcmp(name, member->name))
            return member;
    }
    return NULL;
}

/* The range of whole numbers that a member takes; false: it takes any number. */
static bool range_of(web_type type, double *least, double *most) {
    *least = type == WEB_INT ? -2147483648.0 : 0;
    *most = type == WEB_UINT64 ? 9007199254740992.0 : type == WEB_BOOL ? 1 : 4294967295.0;
    return type != WEB_DOUBLE && type != WEB_VECTOR;
}

/** Sets a member to a number. FROE_E_OPTIONS: no such member, no number, or no whole one where one is asked for. */
WEB_EXPORT froe_status web_set_number(const web_kind *kind, void *options, const char *name, double value,
                                      froe_diagnostic *diag) {
    const web_member *member = find(kind, name);
    if (!member) return refuse(diag, "There is no option %s%s.", name, "");
    if (member->type == WEB_NAMED || member->type == WEB_TEXT || member->type == WEB_ADDRESS)
        return refuse(diag, "The option %s is no number%s.", name, "");
    char *at = (char *)options + member->offset;
    double least, most;
    if (range_of(member->type, &least, &most) && !(value >= least && value <= most && value == floor(value)))
        return refuse(diag, "The option %s is no whole number in its range%s.", name, "");
    switch (member->type) {
    case WEB_BOOL:
        *(bool *)at = value != 0;
        break;
    case WEB_UINT64:
        *(uint64_t *)at = (uint64_t)value;
        break;
    case WEB_DOUBLE:
        *(double *)at = value;
        break;
    case WEB_VECTOR:
        ((double *)at)[name[strlen(member->name) + 1] - '0'] = value;
        break;
    default:
        if (value < 0)
            *(int *)at = (int)value;
        else
            *(uint32_t *)at = (uint32_t)value;
    }
    return FROE_OK;
}

/** Sets a member of type WEB_ADDRESS. FROE_E_OPTIONS: no such member. */
WEB_EXPORT froe_status web_set_address(const web_kind *kind, void *options, const char *name, const void *value,
                                       froe_diagnostic *diag) {
    const web_member *member = find(kind, name);
    if (!member) return refuse(diag, "There is no option %s%s.", name, "");
    if (member->type != WEB_ADDRESS) return refuse(diag, "The option %s is no array%s.", name, "");
    *(const void **)((char *)options + member->offset) = value;
    return FROE_OK;
}

/** Sets a member by a text: WEB_TEXT to it, WEB_NAMED to the value of that name; WEB_BITS gets one more bit.
 * FROE_E_OPTIONS: no such member, or no such value. */
WEB_EXPORT froe_status web_set_text(const web_kind *kind, void *options, const char *name, const char *value,
                                    froe_diagnostic *diag) {
    const web_member *member = find(kind, name);
    if (!member) return refuse(diag, "There is no option %s%s.", name, "");
    char *at = (char *)options + member->offset;
    if (member->type == WEB_TEXT) {
        *(const char **)at = value;
        return FROE_OK;
    }
    if (!member->value_name) return refuse(diag, "The option %s does not take the text '%s'.", name, value);
    const bool bits = member->type == WEB_BITS;
    for (int i = 0; i < 31; i++) {
        const int number = bits ? 1 << i : i;
        const char *known = member->value_name(number);
        if (!known) break;
        if (strcmp(known, value) != 0) continue;
        *(int *)at = bits ? *(int *)at | number : number;
        return FROE_OK;
    }
    return refuse(diag, "The option %s does not have the value '%s'.", name, value);
}
