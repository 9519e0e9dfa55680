/* texture.c: see texture.h. */
#include "formats/input/texture.h"
#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

/* Shares of light of the levels of sRGB (IEC 61966-2-1), times 65535, rounded. */
static const uint16_t lights[256] = {
    0,     20,    40,    60,    80,    99,    119,   139,   159,   179,   199,   219,   241,   264,   288,   313,
    340,   367,   396,   427,   458,   491,   526,   562,   599,   637,   677,   718,   761,   805,   851,   898,
    947,   997,   1048,  1101,  1156,  1212,  1270,  1330,  1391,  1453,  1517,  1583,  1651,  1720,  1790,  1863,
    1937,  2013,  2090,  2170,  2250,  2333,  2418,  2504,  2592,  2681,  2773,  2866,  2961,  3058,  3157,  3258,
    3360,  3464,  3570,  3678,  3788,  3900,  4014,  4129,  4247,  4366,  4488,  4611,  4736,  4864,  4993,  5124,
    5257,  5392,  5530,  5669,  5810,  5953,  6099,  6246,  6395,  6547,  6700,  6856,  7014,  7174,  7335,  7500,
    7666,  7834,  8004,  8177,  8352,  8528,  8708,  8889,  9072,  9258,  9445,  9635,  9828,  10022, 10219, 10417,
    10619, 10822, 11028, 11235, 11446, 11658, 11873, 12090, 12309, 12530, 12754, 12980, 13209, 13440, 13673, 13909,
    14146, 14387, 14629, 14874, 15122, 15371, 15623, 15878, 16135, 16394, 16656, 16920, 17187, 17456, 17727, 18001,
    18277, 18556, 18837, 19121, 19407, 19696, 19987, 20281, 20577, 20876, 21177, 21481, 21787, 22096, 22407, 22721,
    23038, 23357, 23678, 24002, 24329, 24658, 24990, 25325, 25662, 26001, 26344, 26688, 27036, 27386, 27739, 28094,
    28452, 28813, 29176, 29542, 29911, 30282, 30656, 31033, 31412, 31794, 32179, 32567, 32957, 33350, 33745, 34143,
    34544, 34948, 35355, 35764, 36176, 36591, 37008, 37429, 37852, 38278, 38706, 39138, 39572, 40009, 40449, 40891,
    41337, 41785, 42236, 42690, 43147, 43606, 44069, 44534, 45002, 45473, 45947, 46423, 46903, 47385, 47871, 48359,
    48850, 49344, 49841, 50341, 50844, 51349, 51858, 52369, 52884, 53401, 53921, 54445, 54971, 55500, 56032, 56567,
    57105, 57646, 58190, 58737, 59287, 59840, 60396, 60955, 61517, 62082, 62650, 63221, 63795, 64372, 64952, 65535,
};

double formats_light(uint8_t level) {
    return lights[level] / 65535.0;
}

uint8_t formats_level(double light) {
    unsigned lo = 0, hi = 255; /* the least level with at least that much light is in lo .. hi */
    const double steps = light * 65535;
    while (lo < hi) {
        const unsigned middle = (lo + hi) / 2;
        if (lights[middle] < steps)
            lo = middle + 1;
        else
            hi = middle;
    }
    return (uint8_t)(lo && steps - lights[lo - 1] < lights[lo] - steps ? lo - 1 : lo);
}

uint32_t formats_step_colour(uint32_t colour) {
    uint32_t out = 0;
    for (int shift = 24; shift >= 0; shift -= 8) { /* to the nearest of 64 levels, of which 0 and 255 are two */
        const uint32_t step = ((colour >> shift & 255) * 63 + 127) / 255;
        out = out << 8 | (step * 255 + 31) / 63;
    }
    return out ? out : 1;
}

uint32_t formats_light_colour(const double rgba[4]) {
    uint32_t colour = 0;
    for (int k = 0; k < 3; k++) colour = colour << 8 | formats_level(rgba[k]);
    const double alpha = rgba[3] > 0 ? rgba[3] < 1 ? rgba[3] : 1 : 0;
    return formats_step_colour(colour << 8 | (uint32_t)(alpha * 255 + 0.5));
}

/* ----------------------------------------------------------------------- means -- */

/* A place in 0 .. 1. */
static double wrapped(double x, formats_wrap wrap) {
    if (!(fabs(x) < 1e9)) return 0;
    if (wrap == FORMATS_CLAMP) return x > 0 ? x < 1 ? x : 1 : 0;
    if (wrap == FORMATS_REPEAT) return x - floor(x);
    x -= 2 * floor(0.5 * x);
    return x > 1 ? 2 - x : x;
}

typedef struct light_sum {
    double light[3], opacity, weight, count;
} light_sum;

static void add_texel(const formats_texture *t, const double place[2], double weight, light_sum *sum) {
    const uint32_t size[2] = {t->image.width, t->image.height};
    uint32_t at[2];
    for (int k = 0; k < 2; k++) {
        const double x = wrapped(place[k] * t->scale[k] + t->offset[k], t->wrap[k]) * size[k];
        at[k] = x < size[k] ? (uint32_t)x : size[k] - 1;
    }
    const uint8_t *texel = t->image.pixels + 4 * ((size_t)(size[1] - 1 - at[1]) * size[0] + at[0]);
    double opacity = t->cutoff < 0 ? 1 : texel[3] / 255.0;
    if (t->cutoff > 0) opacity = opacity >= t->cutoff;
    for (int k = 0; k < 3; k++) sum->light[k] += weight * opacity * formats_light(texel[k]);
    sum->weight += weight * opacity;
    sum->count += weight;
}

/* Twice the area of a triangle in the space of `dim` axes. */
static double area_of(const double *a, const double *b, const double *c, int dim) {
    double d[3] = {0}, e[3] = {0}, square = 0;
    for (int k = 0; k < dim; k++) d[k] = b[k] - a[k], e[k] = c[k] - a[k];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double x = d[i] * e[j] - d[j] * e[i];
        square += x * x;
    }
    return sqrt(square);
}

/* The texels of a triangle, all together with a weight. */
static void add_triangle(const formats_texture *t, const double *a, const double *b, const double *c, double weight,
                         light_sum *sum) {
    enum { LEAST = 8, MOST = 24 };
    const double texels =
                     0.5 * area_of(a, b, c, 2) * fabs(t->scale[0] * t->scale[1]) * t->image.width * t->image.height,
                 fit = ceil(sqrt(8 * texels));
    const int k = !(fit > LEAST) ? LEAST : fit < MOST ? (int)fit : MOST;
    for (int i = 0; i < k; i++)
        for (int j = 0; i + j < k; j++)
            for (int turned = 0; turned < 2 && i + j + turned < k; turned++) {
                const double x = (i + (turned ? 2 : 1) / 3.0) / k, y = (j + (turned ? 2 : 1) / 3.0) / k;
                double place[2];
                for (int axis = 0; axis < 2; axis++)
                    place[axis] = a[axis] + x * (b[axis] - a[axis]) + y * (c[axis] - a[axis]);
                add_texel(t, place, weight / (k * k), sum);
            }
}

bool formats_texture_mean(const formats_texture *t, const double *corners, const double *places, size_t count,
                          double rgba[4]) {
    light_sum sum = {{0}, 0, 0, 0};
    double whole = 0;
    if (!t->image.pixels || count < 3) return false;
    for (size_t i = 2; i < count; i++) whole += area_of(corners, corners + 3 * (i - 1), corners + 3 * i, 3);
    const bool flat = !(whole > 0 && whole < INFINITY);
    for (size_t i = 2; i < count; i++) {
        const double area = area_of(corners, corners + 3 * (i - 1), corners + 3 * i, 3);
        add_triangle(t, places, places + 2 * (i - 1), places + 2 * i, flat ? 1 : area / whole, &sum);
    }
    for (int k = 0; k < 3; k++) rgba[k] = sum.weight > 0 ? sum.light[k] / sum.weight : 0;
    rgba[3] = t->cutoff > 0 ? sum.weight > 0 : sum.weight / sum.count;
    return true;
}

/* ---------------------------------------------------------------------- finding -- */

static bool is_file(const char *path) {
    struct stat about;
    return !stat(path, &about) && S_ISREG(about.st_mode);
}

/* Writes where an image is: where the file says, if that is at or below its folder, or else beside it. */
static bool place_image(const char *path, const char *name, char *out, size_t room) {
    const char *slash = strrchr(path, '/'), *last = strrchr(name, '/');
    const int folder = slash ? (int)(slash - path) + 1 : 0;
    const bool above = *name == '/' || !strcmp(name, "..") || !strncmp(name, "../", 3) || strstr(name, "/../");
    for (int beside = above; beside < 2; beside++) {
        const int length = snprintf(out, room, "%.*s%s", folder, path, beside && last ? last + 1 : name);
        if (length > 0 && (size_t)length < room && is_file(out)) return true;
    }
    return false;
}

froe_status formats_image_find(formats_sink *sink, const char *path, const char *name, const void *bytes, size_t count,
                               formats_images *images, froe_image *out) {
    enum { PATH_ROOM = 4096 };
    char place[PATH_ROOM];
    formats_image found = {.image = {.pixels = NULL}};
    const size_t length = strlen(name);
    for (size_t i = 0; i < images->count; i++)
        if (!strcmp(images->data[i].name, name)) return *out = images->data[i].image, FROE_OK;
    if (!array_reserve(&sink->alloc, images, 1)) return support_fail_memory(sink->diag);
    const bool there = length < sizeof found.name && (bytes || place_image(path, name, place, sizeof place));
    memcpy(found.name, name, length < sizeof found.name ? length : sizeof found.name - 1);
    if (!there || !sink->image ||
        !sink->image(sink->image_user, bytes ? NULL : place, bytes, count, &sink->alloc, &found.image)) {
        found.image.pixels = NULL;
        if (!sink->report.unread++) snprintf(sink->report.unread_name, sizeof sink->report.unread_name, "%.63s", name);
    }
    sink->report.textures++;
    images->data[images->count++] = found;
    *out = found.image;
    return FROE_OK;
}

void formats_images_free(const froe_allocator *alloc, formats_images *images) {
    for (size_t i = 0; i < images->count; i++) {
        const froe_image *image = &images->data[i].image;
        if (image->pixels) support_free(alloc, image->pixels, 4 * (size_t)image->width * image->height);
    }
    array_free(alloc, images);
}
