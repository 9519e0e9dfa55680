/* gl2ps.c: gl2ps 1.4 as a BSP of triangles: it sorts with a BSP and writes every piece as a polygon. */
#include "peers.h"
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

size_t peer_gl2ps(const double *triangles, size_t n, bool best_root) {
    GLint options = GL2PS_NO_OPENGL_CONTEXT | GL2PS_SILENT | GL2PS_NO_BLENDING | (best_root ? GL2PS_BEST_ROOT : 0);
    GLint viewport[4] = {0, 0, 1000, 1000};
    FILE *f = tmpfile();
    if (!f) return 0;
    gl2psBeginPage("", "", viewport, GL2PS_SVG, GL2PS_BSP_SORT, options, GL_RGBA, 0, NULL, 0, 0, 0, 0, f, "");
    for (size_t i = 0; i < n; i++) {
        GL2PSvertex v[3];
        memset(v, 0, sizeof v);
        for (int k = 0; k < 9; k++) v[k / 3].xyz[k % 3] = (GLfloat)triangles[9 * i + (size_t)k];
        for (int k = 0; k < 3; k++) v[k].rgba[3] = 1;
        gl2psAddPolyPrimitive(GL2PS_TRIANGLE, 3, v, 0, 0, 0, 0xffff, 1, 1, 0, 0, 0);
    }
    gl2psEndPage();
    size_t count = count_polygons(f);
    fclose(f);
    return count;
}
