/* setting.h: a setting of GDAL for the calling thread, for a while. */
#ifndef FROE_IO_SETTING_H
#define FROE_IO_SETTING_H

typedef struct io_setting {
    const char *name;
    char *before; /* text of GDAL; NULL: the thread had none */
} io_setting;

/** `name` is kept, and has the value until io_setting_end(). */
void io_setting_begin(io_setting *setting, const char *name, const char *value);
/** Puts back what the thread had before. */
void io_setting_end(io_setting *setting);

#endif
