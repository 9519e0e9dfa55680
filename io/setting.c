/* setting.c: see setting.h. */
#include "setting.h"
#include <cpl_conv.h>
#include <stddef.h>

void io_setting_begin(io_setting *setting, const char *name, const char *value) {
    const char *before = CPLGetThreadLocalConfigOption(name, NULL);
    setting->name = name;
    setting->before = before ? CPLStrdup(before) : NULL;
    CPLSetThreadLocalConfigOption(name, value);
}

void io_setting_end(io_setting *setting) {
    CPLSetThreadLocalConfigOption(setting->name, setting->before);
    CPLFree(setting->before);
}
