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

/* The member of this name, or NULL, which is refused. */
static const web_member *find(const web_kind *kind, const char *name, froe_diagnostic *diag) {
    for (const web_member *member = kind->members; member->name; member++) {
        const size_t length = strlen(member->name);
        if (member->type == WEB_VECTOR ? !strncmp(name, member->name, length) && name[length] == '.' &&
                                             name[length + 1] && strchr("012", name[length + 1]) && !name[length + 2]
                                       : !strcmp(name, member->name))
            return member;
    }
    refuse(diag, "There is no option %s%s.", name, "");
    return NULL;
}

/* The range of whole numbers that a member takes; false: it takes any number. */
static bool range_of(web_type type, double *least, double *most) {
    *least = type == WEB_SIGNED ? -2147483648.0 : 0;
    *most = type == WEB_SIGNED   ? 2147483647.0
            : type == WEB_UINT64 ? 9007199254740991.0
            : type == WEB_BOOL   ? 1
                                 : 4294967295.0;
    return type != WEB_DOUBLE && type != WEB_VECTOR;
}

static froe_status refuse_number(froe_diagnostic *diag, const web_member *member, double value) {
    double least, most;
    char what[96];
    if (member->type == WEB_SIGNED)
        snprintf(what, sizeof what, "%.16g, not a whole number", value);
    else if (range_of(member->type, &least, &most))
        snprintf(what, sizeof what, "%.16g, not a whole number from %.16g to %.16g", value, least, most);
    else
        snprintf(what, sizeof what, "%.16g, not a number", value);
    return refuse(diag, "The option %s is %s.", member->name, what);
}

/** Sets a member to a number. FROE_E_OPTIONS: no such member, no number, or no whole one where one is asked for. */
WEB_EXPORT froe_status web_set_number(const web_kind *kind, void *options, const char *name, double value,
                                      froe_diagnostic *diag) {
    const web_member *member = find(kind, name, diag);
    if (!member) return FROE_E_OPTIONS;
    if (member->type >= WEB_ADDRESS) return refuse(diag, "The option %s is no number%s.", name, "");
    char *at = (char *)options + member->offset;
    double least, most;
    const bool whole = range_of(member->type, &least, &most);
    if (isnan(value) || (whole && !(value >= least && value <= most && value == floor(value))))
        return refuse_number(diag, member, value);
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
    case WEB_SIGNED:
        *(int *)at = (int)value;
        break;
    default:
        *(uint32_t *)at = (uint32_t)value;
    }
    return FROE_OK;
}

/** Sets a member of type WEB_BOOL. FROE_E_OPTIONS: no such member. */
WEB_EXPORT froe_status web_set_truth(const web_kind *kind, void *options, const char *name, int value,
                                     froe_diagnostic *diag) {
    const web_member *member = find(kind, name, diag);
    if (!member) return FROE_E_OPTIONS;
    if (member->type != WEB_BOOL)
        return refuse(diag, "The option %s does not take %s.", name, value ? "true" : "false");
    *(bool *)((char *)options + member->offset) = value != 0;
    return FROE_OK;
}

/** Sets a member of type WEB_ADDRESS. FROE_E_OPTIONS: no such member. */
WEB_EXPORT froe_status web_set_address(const web_kind *kind, void *options, const char *name, const void *value,
                                       froe_diagnostic *diag) {
    const web_member *member = find(kind, name, diag);
    if (!member) return FROE_E_OPTIONS;
    if (member->type != WEB_ADDRESS) return refuse(diag, "The option %s is no array%s.", name, "");
    *(const void **)((char *)options + member->offset) = value;
    return FROE_OK;
}

/* Finds the number of a value by its name. FROE_E_OPTIONS: there is none. */
static froe_status number_of(const web_member *member, const char *value, int *out, froe_diagnostic *diag) {
    for (int i = 0; i < 31; i++) {
        *out = member->type == WEB_BITS ? 1 << i : i;
        const char *known = member->value_name(*out);
        if (!known) break;
        if (!strcmp(known, value)) return FROE_OK;
    }
    return refuse(diag, "The option %s does not have the value '%s'.", member->name, value);
}

/** Sets a member by a text: WEB_TEXT to it, WEB_NAMED to the value of that name. FROE_E_OPTIONS: no such member, or no
 * such value. */
WEB_EXPORT froe_status web_set_text(const web_kind *kind, void *options, const char *name, const char *value,
                                    froe_diagnostic *diag) {
    const web_member *member = find(kind, name, diag);
    if (!member) return FROE_E_OPTIONS;
    char *at = (char *)options + member->offset;
    if (member->type == WEB_NAMED) return number_of(member, value, (int *)at, diag);
    if (member->type != WEB_TEXT) return refuse(diag, "The option %s does not take the text '%s'.", name, value);
    *(const char **)at = value;
    return FROE_OK;
}

/** Empties a member of type WEB_BITS. FROE_E_OPTIONS: no such member. */
WEB_EXPORT froe_status web_set_empty(const web_kind *kind, void *options, const char *name, froe_diagnostic *diag) {
    const web_member *member = find(kind, name, diag);
    if (!member) return FROE_E_OPTIONS;
    if (member->type != WEB_BITS) return refuse(diag, "The option %s is no list of names%s.", name, "");
    *(int *)((char *)options + member->offset) = 0;
    return FROE_OK;
}

/** Adds the value of a name to a member that web_set_empty() has emptied. FROE_E_OPTIONS: no such value. */
WEB_EXPORT froe_status web_add_name(const web_kind *kind, void *options, const char *name, const char *value,
                                    froe_diagnostic *diag) {
    const web_member *member = find(kind, name, diag);
    int bit = 0;
    const froe_status status = member ? number_of(member, value, &bit, diag) : FROE_E_OPTIONS;
    if (status == FROE_OK) *(int *)((char *)options + member->offset) |= bit;
    return status;
}
