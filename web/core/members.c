/* members.c: members of options by name; refusals */
#include "web.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static froe_status refuse(froe_diagnostic *diag, const char *pattern, const char *a, const char *b) {
    diag->status = FROE_E_OPTIONS;
    diag->object = diag->corner = diag->axis = FROE_NONE;
    snprintf(diag->message, sizeof diag->message, pattern, a, b);
    return FROE_E_OPTIONS;
}

static const web_member *find(const web_member *table, const char *name) {
    for (; table->name; table++) {
        const size_t length = strlen(table->name);
        if (table->type == WEB_VECTOR
                ? !strncmp(name, table->name, length) && name[length] == '.' && strchr("012", name[length + 1])
                : !strcmp(name, table->name))
            return table;
    }
    return NULL;
}

froe_status web_set_number(void *options, const web_member *table, const char *name, double value,
                           froe_diagnostic *diag) {
    const web_member *member = find(table, name);
    if (!member || member->type == WEB_NAMED) return refuse(diag, "There is no option %s%s.", name, "");
    char *at = (char *)options + member->offset;
    const double most = member->type == WEB_UINT64 ? 9007199254740992.0 : 4294967295.0;
    const bool real = member->type == WEB_DOUBLE || member->type == WEB_VECTOR;
    if (!real && !(value >= -2147483648.0 && value <= most && value == floor(value)))
        return refuse(diag, "The option %s is not a whole number%s.", name, "");
    if (member->type == WEB_BOOL) *(bool *)at = value != 0;
    if (member->type == WEB_INT && value < 0) *(int *)at = (int)value;
    if (member->type == WEB_INT && value >= 0) *(unsigned *)at = (unsigned)value;
    if (member->type == WEB_UINT64) *(uint64_t *)at = (uint64_t)value;
    if (member->type == WEB_DOUBLE) *(double *)at = value;
    if (member->type == WEB_VECTOR) ((double *)at)[name[strlen(member->name) + 1] - '0'] = value;
    if (member->type == WEB_ADDRESS) *(const char **)at = (const char *)(uintptr_t)value;
    return FROE_OK;
}

froe_status web_set_name(void *options, const web_member *table, const char *name, const char *value,
                         froe_diagnostic *diag) {
    const web_member *member = find(table, name);
    if (!member || member->type != WEB_NAMED)
        return refuse(diag, "There is no option %s with the value %s.", name, value);
    for (int i = 0; member->value_name(i); i++)
        if (!strcmp(member->value_name(i), value)) {
            *(int *)((char *)options + member->offset) = i;
            return FROE_OK;
        }
    return refuse(diag, "The option %s does not have the value %s.", name, value);
}

froe_status web_no_memory(froe_diagnostic *diag) {
    refuse(diag, "The page has no more memory%s%s.", "", "");
    return diag->status = FROE_E_MEMORY;
}
