/* animate_film.c: triangles in motion as a film, by itself or within the page that plays it. */
#include "formats/motion/animate.h"
#include <froe/render.h>
#include <math.h>

static bool put_film(void *user, const void *bytes, size_t count) {
    formats_writer *w = user;
    support_writer_put(&w->out, bytes, count);
    return true;
}

froe_status formats_animate_film(formats_writer *w, const formats_animation *a, froe_diagnostic *diag) {
    enum { A_SECOND = 15 };
    froe_render_options o = froe_render_defaults();
    froe_film_options film = froe_film_defaults();
    const int up = a->options.up;
    if (up < 0 || up > 2) return support_fail(diag, FROE_E_OPTIONS, "There is no axis %d that could point up.", up);
    for (int k = 0; k < 3; k++) o.camera.up[k] = k == up;
    const double from[3] = {3, -5, 2}; /* towards the eye: right, forwards, up */
    o.camera.eye[up] = from[2];
    o.camera.eye[(up + 1) % 3] = up == 1 ? -from[1] : from[0];
    o.camera.eye[(up + 2) % 3] = up == 1 ? from[0] : from[1];
    o.camera.width = a->options.width, o.camera.height = ceil(0.625 * a->options.width);
    o.background = 0xFFFFFF;
    o.title = "A moving model";
    film.seconds = a->options.seconds;
    film.frames = (uint32_t)fmin(fmax(ceil(A_SECOND * film.seconds), 2), 10000);
    return froe_film_write(a->motion, put_film, w, &o, &film, NULL, diag);
}
