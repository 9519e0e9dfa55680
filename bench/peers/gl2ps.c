/* gl2ps.c: gl2ps 1.4 as a BSP of triangles: it sorts with a BSP and writes every piece as a polygon. */
#include "gl2ps.h"
#include <GL/gl.h>
#include <gl2ps.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* in the library, not in its header */
void gl2psAddPolyPrimitive(GLshort type, GLshort numverts, GL2PSvertex *verts, GLint offset, GLfloat ofactor,
                           GLfloat ounits, GLushort pattern, GLint factor, GLfloat width, GLint linecap, GLint linejoin,
                           char boundary);

static size_t count_polygons(FILE *f) {
    char line[4096];
    size_t count = 0;
    rewind(f);
    while (fgets(line, sizeof line, f)) count += strstr(line, "<polygon") != NULL;
    return count;
}

static void begin(FILE *f, GLint more_options) {
    GLint viewport[4] = {0, 0, 1000, 1000};
    gl2psBeginPage("", "", viewport, GL2PS_SVG, GL2PS_BSP_SORT,
                   GL2PS_NO_OPENGL_CONTEXT | GL2PS_SILENT | GL2PS_NO_BLENDING | more_options, GL_RGBA, 0, NULL, 0, 0, 0,
                   0, f, "");
}

/* Colours are truncated to bytes: half a step more keeps them. */
static void add(const double *triangle, unsigned colour) {
    GL2PSvertex v[3];
    memset(v, 0, sizeof v);
    for (int k = 0; k < 9; k++) v[k / 3].xyz[k % 3] = (GLfloat)triangle[k];
    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < 3; c++) v[k].rgba[c] = ((GLfloat)(colour >> (16 - 8 * c) & 255) + 0.5F) / 255;
        v[k].rgba[3] = 1;
    }
    gl2psAddPolyPrimitive(GL2PS_TRIANGLE, 3, v, 0, 0, 0, 0xffff, 1, 1, 0, 0, 0);
}

size_t peer_gl2ps(const double *triangles, size_t n, bool best_root) {
    FILE *f = tmpfile();
    if (!f) return 0;
    begin(f, best_root ? GL2PS_BEST_ROOT : 0);
    for (size_t i = 0; i < n; i++) add(triangles + 9 * i, 0);
    gl2psEndPage();
    size_t count = count_polygons(f);
    fclose(f);
    return count;
}

bool peer_gl2ps_picture(const double *triangles, const unsigned *colours, size_t n, const char *path) {
    FILE *f = fopen(path, "wb");
    if (!f) return false;
    begin(f, GL2PS_BEST_ROOT | GL2PS_OCCLUSION_CULL);
    for (size_t i = 0; i < n; i++) add(triangles + 9 * i, colours[i]);
    const bool ok = gl2psEndPage() == GL2PS_SUCCESS;
    return fclose(f) == 0 && ok;
}
