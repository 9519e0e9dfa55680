/* eps.c: an encapsulated PostScript file of level 2 (Adobe: PostScript Language Document Structuring Conventions 3.0,
 * and Encapsulated PostScript File Format 3.0, 1992). */
#include "page.h"
#include "render.h"

/* The operators of PDF that page.c writes. */
static const char prolog[] =
    "%%BeginProlog\n"
    "16 dict begin\n"
    "/m{moveto}bind def/l{lineto}bind def/h{closepath}bind def\n"
    "/f{fill}bind def/S{stroke}bind def/B{gsave fill grestore stroke}bind def\n"
    "/w{setlinewidth}bind def/j{setlinejoin}bind def/J{setlinecap}bind def/d{setdash}bind def\n"
    "/rg{setrgbcolor}bind def/RG{setrgbcolor}bind def/cm{6 array astore concat}bind def\n"
    "/re{4 2 roll moveto 1 index 0 rlineto 0 exch rlineto neg 0 rlineto closepath}bind def\n"
    "%%EndProlog\n";

void vector_eps(vector_render *render, vector_output *output) {
    const froe_camera *camera = &render->options->camera;
    const double unit = vector_unit(render->options);
    const vector_digits width = vector_points(render, camera->width), height = vector_points(render, camera->height);
    bool alphas[256] = {false};
    vector_print(output, "%%!PS-Adobe-3.0 EPSF-3.0\n%%%%Creator: froe\n%%%%LanguageLevel: 2\n%%%%Pages: 1\n");
    vector_print(output, "%%%%BoundingBox: 0 0 %.0f %.0f\n%%%%HiResBoundingBox: 0 0 %s %s\n%%%%EndComments\n",
                 ceil(camera->width * unit), ceil(camera->height * unit), width.text, height.text);
    vector_put(output, prolog, sizeof prolog - 1);
    vector_print(output, "%%%%Page: 1 1\nsave\n0 0 %s %s rectclip\n", width.text, height.text);
    vector_put_page(render, output, alphas);
    vector_print(output, "restore\nshowpage\n%%%%Trailer\nend\n%%%%EOF\n");
}
