/* lettering.c: glyphs as strokes, 24 units from base line to capitals, 16 to small letters.
 *
 * A glyph is its width and strokes: `l` a polyline, `q` a quadratic spline that starts and
 * ends in its first and last point and rounds the corners between (tangent to
 * their edges at the middles), `o` the closed one. So `o0,0 0,24 21,24 21,0` is an O. */
#include "lettering.h"
#include "palette.h"
#include <stdlib.h>
#include <string.h>

enum { CAPITAL = 24, GAP = 6, FIRST = ' ', LAST = '~' };
#define EM (0.7 / CAPITAL)
#define WEIGHT 0.085 /* of strokes, in ems */

static const char *const glyphs[LAST - FIRST + 1] = {
    "7",                                                                                          /* space */
    "0 l0,24 0,8 l0,0 0,1",                                                                       /* ! */
    "5 l0,24 0,18 l5,24 5,18",                                                                    /* " */
    "17 l4,0 7,24 l11,0 14,24 l0,8 17,8 l1,16 18,16",                                             /* # */
    "16 q15,20 13,24 8,24 1,24 1,18 1,13 8,12 16,11 16,6 16,0 8,0 2,0 0,5 l8,27 8,-3",            /* $ */
    "20 o0,14 0,24 8,24 8,14 o12,0 12,10 20,10 20,0 l3,0 17,24",                                  /* % */
    "18 q18,0 10,9 5,15 1,20 4,24 8,26 12,23 13,18 7,14 0,10 0,5 0,0 7,0 14,0 17,10",             /* & */
    "0 l0,24 0,18",                                                                               /* ' */
    "5 q5,27 0,20 0,10 0,0 5,-6",                                                                 /* ( */
    "5 q0,27 5,20 5,10 5,0 0,-6",                                                                 /* ) */
    "10 l5,24 5,14 l1,22 9,16 l1,16 9,22",                                                        /* * */
    "14 l0,10 14,10 l7,3 7,17",                                                                   /* + */
    "1 l1,1 0,-4",                                                                                /* , */
    "9 l0,9 9,9",                                                                                 /* - */
    "0 l0,0 0,1",                                                                                 /* . */
    "11 l0,-3 11,27",                                                                             /* / */
    "14 o0,0 0,24 14,24 14,0",                                                                    /* 0 */
    "8 l2,19 8,24 8,0",                                                                           /* 1 */
    "14 q1,19 2,24 7,24 13,24 13,17 13,13 6,6 0,0 l0,0 14,0",                                     /* 2 */
    "14 q1,20 3,24 7,24 13,24 13,18 13,13 6,13 q6,13 14,13 14,6 14,0 7,0 2,0 0,4",                /* 3 */
    "14 l10,0 10,24 0,7 14,7",                                                                    /* 4 */
    "14 l13,24 3,24 2,13 q2,13 4,15 7,15 14,15 14,8 14,0 7,0 2,0 0,4",                            /* 5 */
    "14 o0,0 0,15 14,15 14,0 q11,24 0,22 0,7",                                                    /* 6 */
    "14 l0,24 14,24 5,0",                                                                         /* 7 */
    "14 o2,13 2,24 12,24 12,13 o0,0 0,13 14,13 14,0",                                             /* 8 */
    "14 o0,9 0,24 14,24 14,9 q3,0 14,2 14,17",                                                    /* 9 */
    "0 l0,1 0,2 l0,14 0,15",                                                                      /* : */
    "1 l1,1 0,-4 l1,14 1,15",                                                                     /* ; */
    "12 l12,18 0,10 12,2",                                                                        /* < */
    "14 l0,13 14,13 l0,7 14,7",                                                                   /* = */
    "12 l0,18 12,10 0,2",                                                                         /* > */
    "12 q0,19 1,24 6,24 12,24 12,18 12,14 6,12 6,7 l6,0 6,1",                                     /* ? */
    "21 o6,6 6,15 14,15 14,6 q14,14 14,4 21,4 21,11 21,22 11,22 0,22 0,9 0,-3 11,-3 14,-3 17,-1", /* @ */
    "20 l0,0 10,24 20,0 l3,8 17,8",                                                               /* A */
    "17 l0,0 0,24 q0,24 8,24 15,24 15,13 8,13 0,13 q0,13 9,13 17,13 17,0 9,0 0,0",                /* B */
    "19 q18,19 16,24 10,24 0,24 0,12 0,0 10,0 16,0 18,5",                                         /* C */
    "18 l0,0 0,24 q0,24 8,24 18,24 18,12 18,0 8,0 0,0",                                           /* D */
    "14 l14,24 0,24 0,0 14,0 l0,13 12,13",                                                        /* E */
    "13 l13,24 0,24 0,0 l0,13 11,13",                                                             /* F */
    "19 q18,19 16,24 10,24 0,24 0,12 0,0 10,0 15,0 19,3 l19,3 19,11 12,11",                       /* G */
    "18 l0,0 0,24 l18,0 18,24 l0,13 18,13",                                                       /* H */
    "0 l0,0 0,24",                                                                                /* I */
    "11 q11,24 11,12 11,0 5,0 1,0 0,5",                                                           /* J */
    "16 l0,0 0,24 l16,24 0,8 l6,14 16,0",                                                         /* K */
    "13 l0,24 0,0 13,0",                                                                          /* L */
    "22 l0,0 0,24 11,5 22,24 22,0",                                                               /* M */
    "18 l0,0 0,24 18,0 18,24",                                                                    /* N */
    "21 o0,0 0,24 21,24 21,0",                                                                    /* O */
    "15 l0,0 0,24 q0,24 8,24 15,24 15,11 8,11 0,11",                                              /* P */
    "21 o0,0 0,24 21,24 21,0 l13,7 21,-2",                                                        /* Q */
    "16 l0,0 0,24 q0,24 8,24 15,24 15,11 8,11 0,11 l8,11 16,0",                                   /* R */
    "16 q15,20 13,24 8,24 1,24 1,18 1,13 8,12 16,11 16,6 16,0 8,0 2,0 0,5",                       /* S */
    "18 l0,24 18,24 l9,24 9,0",                                                                   /* T */
    "18 q0,24 0,12 0,0 9,0 18,0 18,12 18,24",                                                     /* U */
    "18 l0,24 9,0 18,24",                                                                         /* V */
    "28 l0,24 7,0 14,24 21,0 28,24",                                                              /* W */
    "17 l0,0 17,24 l0,24 17,0",                                                                   /* X */
    "18 l0,24 9,11 18,24 l9,11 9,0",                                                              /* Y */
    "17 l0,24 17,24 0,0 17,0",                                                                    /* Z */
    "5 l5,27 0,27 0,-5 5,-5",                                                                     /* [ */
    "11 l0,27 11,-3",                                                                             /* \ */
    "5 l0,27 5,27 5,-5 0,-5",                                                                     /* ] */
    "10 l0,16 5,24 10,16",                                                                        /* ^ */
    "15 l0,-4 15,-4",                                                                             /* _ */
    "4 l0,24 4,20",                                                                               /* ` */
    "13 o0,0 0,16 13,16 13,0 l13,16 13,0",                                                        /* a */
    "13 o0,0 0,16 13,16 13,0 l0,24 0,0",                                                          /* b */
    "12 q12,13 10,16 7,16 0,16 0,8 0,0 7,0 10,0 12,3",                                            /* c */
    "13 o0,0 0,16 13,16 13,0 l13,24 13,0",                                                        /* d */
    "13 l0,8 13,8 q13,8 13,16 6,16 0,16 0,8 0,0 7,0 11,0 13,3",                                   /* e */
    "8 q9,24 3,25 3,18 3,9 3,0 l0,16 8,16",                                                       /* f */
    "13 o0,0 0,16 13,16 13,0 q13,16 13,4 13,-7 6,-7 3,-7 1,-5",                                   /* g */
    "12 l0,0 0,24 q0,8 0,16 7,16 12,16 12,9 12,4 12,0",                                           /* h */
    "0 l0,0 0,16 l0,22 0,23",                                                                     /* i */
    "4 q4,16 4,4 4,-7 0,-7 l4,22 4,23",                                                           /* j */
    "12 l0,0 0,24 l11,16 0,6 l4,10 12,0",                                                         /* k */
    "3 q0,24 0,10 0,0 4,0",                                                                       /* l */
    "20 l0,0 0,16 q0,8 0,16 5,16 10,16 10,9 10,4 10,0 q10,8 10,16 15,16 20,16 20,9 20,4 20,0",    /* m */
    "12 l0,0 0,16 q0,8 0,16 7,16 12,16 12,9 12,4 12,0",                                           /* n */
    "14 o0,0 0,16 14,16 14,0",                                                                    /* o */
    "13 o0,0 0,16 13,16 13,0 l0,16 0,-7",                                                         /* p */
    "13 o0,0 0,16 13,16 13,0 l13,16 13,-7",                                                       /* q */
    "7 l0,0 0,16 q0,8 0,16 8,16",                                                                 /* r */
    "11 q10,13 9,16 6,16 1,16 1,12 1,9 6,8 11,7 11,4 11,0 6,0 1,0 0,3",                           /* s */
    "8 q3,22 3,11 3,0 8,0 l0,16 8,16",                                                            /* t */
    "12 q0,16 0,12 0,7 0,0 5,0 12,0 12,8 l12,16 12,0",                                            /* u */
    "12 l0,16 6,0 12,16",                                                                         /* v */
    "20 l0,16 5,0 10,16 15,0 20,16",                                                              /* w */
    "12 l0,0 12,16 l0,16 12,0",                                                                   /* x */
    "12 l0,16 6,1 l12,16 3,-7",                                                                   /* y */
    "12 l0,16 12,16 0,0 12,0",                                                                    /* z */
    "6 q6,27 3,27 3,20 3,11 0,11 q0,11 3,11 3,2 3,-5 6,-5",                                       /* { */
    "0 l0,28 0,-5",                                                                               /* | */
    "6 q0,27 3,27 3,20 3,11 6,11 q6,11 3,11 3,2 3,-5 0,-5",                                       /* } */
    "15 q0,8 2,12 5,12 8,9 11,6 14,7 15,11",                                                      /* ~ */
};
/* The few others that the pictures themselves use. */
static const struct other {
    const char *utf8, *glyph;
} others[] = {{"\xC2\xB7", "0 l0,10 0,11"},                      /* middle dot */
              {"\xC2\xB0", "8 o0,16 0,24 8,24 8,16"},            /* degree */
              {"\xC3\x97", "12 l0,3 12,15 l0,15 12,3"},          /* times */
              {"\xE2\x89\xA4", "13 l13,20 0,13 13,6 l0,1 13,1"}, /* at most */
              {"\xE2\x89\xA5", "13 l0,20 13,13 0,6 l0,1 13,1"}}; /* at least */

/* The glyph of the character at *text, which moves on; NULL: not known. */
static const char *next_glyph(const char **text) {
    const unsigned char first = (unsigned char)**text;
    if (first >= FIRST && first <= LAST) return glyphs[*(*text)++ - FIRST];
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        size_t length = strlen(others[i].utf8);
        if (strncmp(*text, others[i].utf8, length) != 0) continue;
        *text += length;
        return others[i].glyph;
    }
    *text += 1;
    return NULL;
}

bool draw_text_known(const char *text) {
    while (*text)
        if (!next_glyph(&text)) return false;
    return true;
}

static void system_font(cairo_t *cr, double size) {
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, size);
}

double draw_text_length(cairo_t *cr, const char *text, double size) {
    if (!draw_text_known(text)) {
        cairo_text_extents_t extents;
        system_font(cr, size);
        cairo_text_extents(cr, text, &extents);
        return extents.x_advance;
    }
    long units = 0;
    for (const char *t = text; *t;) units += strtol(next_glyph(&t), NULL, 10) + GAP;
    return *text ? (double)(units - GAP) * EM * size : 0;
}

typedef struct point {
    double x, y;
} point;

static point middle(point a, point b) {
    return (point){0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
}

/* A quadratic curve from the current point, as the cubic that Cairo takes. */
static void quadratic_to(cairo_t *cr, point control, point end) {
    double x, y;
    cairo_get_current_point(cr, &x, &y);
    cairo_curve_to(cr, x + 2 * (control.x - x) / 3, y + 2 * (control.y - y) / 3, end.x + 2 * (control.x - end.x) / 3,
                   end.y + 2 * (control.y - end.y) / 3, end.x, end.y);
}

/* The strokes of a text that is known. */
static void text_path(cairo_t *cr, const char *text, double x, double y, double size) {
    double unit = EM * size;
    cairo_new_path(cr);
    for (const char *t = text; *t; x += GAP * unit) { /* a glyph is its width and its strokes */
        char *at;
        const double width = (double)strtol(next_glyph(&t), &at, 10) * unit;
        while (*at == ' ') {
            point p[24];
            int count = 0;
            char sort = at[1];
            for (at++; (count ? *at == ' ' && at[1] < 'a' : true) && count < 24; count++) {
                p[count].x = x + unit * (double)strtol(at + 1, &at, 10);
                p[count].y = y - unit * (double)strtol(at + 1, &at, 10);
            }
            const point start = sort == 'o' ? middle(p[count - 1], p[0]) : p[0];
            cairo_move_to(cr, start.x, start.y);
            if (sort == 'o') {
                for (int i = 0; i < count; i++) quadratic_to(cr, p[i], middle(p[i], p[(i + 1) % count]));
                cairo_close_path(cr);
                continue;
            }
            for (int i = 1; i < count; i++)
                if (sort == 'l' || count == 2)
                    cairo_line_to(cr, p[i].x, p[i].y);
                else if (i + 1 < count)
                    quadratic_to(cr, p[i], i + 2 < count ? middle(p[i], p[i + 1]) : p[i + 1]);
        }
        x += width;
    }
    cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
}

void draw_text(cairo_t *cr, const char *text, double x, double y, double size, double align) {
    x -= align * draw_text_length(cr, text, size);
    if (!draw_text_known(text)) {
        system_font(cr, size);
        cairo_move_to(cr, x, y);
        cairo_show_text(cr, text);
        return;
    }
    text_path(cr, text, x, y, size);
    cairo_set_line_width(cr, WEIGHT * size);
    cairo_stroke(cr);
}

void draw_text_backed(cairo_t *cr, const char *text, double x, double y, double size, uint32_t paper, uint32_t ink) {
    const bool known = draw_text_known(text);
    if (known)
        text_path(cr, text, x, y, size);
    else {
        system_font(cr, size);
        cairo_new_path(cr);
        cairo_move_to(cr, x, y);
        cairo_text_path(cr, text);
        cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    }
    draw_set_color(cr, paper, 0.85);
    cairo_set_line_width(cr, 0.36 * size);
    cairo_stroke_preserve(cr);
    draw_set_color(cr, ink, 1);
    cairo_set_line_width(cr, 1.35 * WEIGHT * size);
    if (known)
        cairo_stroke(cr);
    else
        cairo_fill(cr);
}
