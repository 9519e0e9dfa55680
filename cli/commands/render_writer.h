/* render_writer.h: which function writes a picture, and what the files of many pictures are called. */
#ifndef FROE_CLI_RENDER_WRITER_H
#define FROE_CLI_RENDER_WRITER_H
#include <froe/render.h>

/** froe_render(), or one of the same form that a library has. */
typedef __typeof__(froe_render) render_fn;

/** PNG and DXF are written by libraries; *write stays as it is for other endings. Returns 0 or an exit code. */
int render_find_writer(const char *path, render_fn **write);
/** Is it like "pic-%03d.svg", with one %d, perhaps with a width? */
bool render_names_frames(const char *pattern);
/** The name of frame i by such a pattern, which the caller frees; NULL: there is no memory. */
char *render_frame_name(const char *pattern, size_t i);
#endif
