/* method.c: names of builders on command lines. */
#include "args/method.h"
#include "args/options.h"
#include "exit.h"
#include <stdio.h>
#include <string.h>

int cli_check_method(const char *name, bool may_be_auto) {
    enum { MOST = 64 };
    const char *names[MOST];
    size_t count = 0;
    char list[400] = "", sentence[sizeof list + 16];
    const froe_method_info *info;
    if (may_be_auto) names[count++] = "auto";
    for (size_t i = 0; (info = froe_method_at(i)) != NULL && count < MOST; i++) /* one way: there are fewer */
        names[count++] = info->name;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(names[i], name) == 0) return 0;
        const size_t used = strlen(list);
        snprintf(list + used, sizeof list - used, "%s%s", i ? ", " : "", names[i]);
    }
    const char *hint = cli_nearest(name, names, count);
    snprintf(sentence, sizeof sentence, "There are: %s.", list);
    return cli_fail_unknown("method", name, hint, sentence);
}
