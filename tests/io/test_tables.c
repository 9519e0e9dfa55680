/* Points, boxes and balls in CSV: headers in every guise, exact numbers, any locale. */
#include "support.h"
#include "support/text/csv.h"
#include <locale.h>

static froe_scene *table(const char *text, const char *format) {
    froe_read_report report;
    write_text("table.csv", text);
    froe_scene *scene = read_scene("table.csv", &report);
    assert_string_equal(report.format, format);
    assert_string_equal(report.precision, "float64");
    assert_int_equal(report.features, froe_scene_object_count(scene));
    return scene;
}

static void refuse_table(const char *text, froe_status status, const char *words) {
    write_text("bad.csv", text);
    refuse("bad.csv", status, words);
}

static void the_header_says_what_the_rows_are(void **state) {
    (void)state;
    froe_scene *s = table("x,y\n1,2\n3,4\n", "CSV points");
    assert_int_equal(froe_scene_kind_count(s, FROE_POINT), 2);
    assert_true(corner(s, 1, 0)[0] == 3 && corner(s, 1, 0)[1] == 4);
    froe_scene_free(s);
    s = table("lo_x,lo_y,lo_z,hi_x,hi_y,hi_z\n0,1,2,3,4,5\n", "CSV boxes");
    assert_int_equal(froe_scene_kind_count(s, FROE_BOX), 1);
    assert_true(corner(s, 0, 0)[2] == 2 && corner(s, 0, 1)[0] == 3);
    froe_scene_free(s);
    s = table("x,y,z,r\n0,1,2,0.5\n", "CSV balls");
    assert_int_equal(froe_scene_kind_count(s, FROE_BALL), 1);
    assert_true(froe_scene_object(s, 0).radius == 0.5);
    froe_scene_free(s);
    s = table("from_x,from_y,from_z,from_w,to_x,to_y,to_z,to_w\n0,1,2,3,4,5,6,7\n", "CSV segments");
    assert_int_equal(froe_scene_kind_count(s, FROE_SEGMENT), 1);
    assert_true(froe_scene_dim(s) == 4 && corner(s, 0, 0)[2] == 2 && corner(s, 0, 1)[3] == 7);
    froe_scene_free(s);
    s = table("x1,x2,x3,x4,x5,x6,x7,x8\n1,2,3,4,5,6,7,8\n", "CSV points");
    assert_int_equal(froe_scene_dim(s), 8);
    assert_true(corner(s, 0, 0)[7] == 8);
    froe_scene_free(s);
}

static void columns_come_in_any_order_with_others_between(void **state) {
    (void)state;
    froe_scene *s =
        table("\xef\xbb\xbfname;Y; \"X\" ;tag\r\n\"a;\"\"b\";2;1;18446744073709551615\r\n\r\n;4;3;7", "CSV points");
    assert_int_equal(froe_scene_object_count(s), 2);
    assert_true(corner(s, 0, 0)[0] == 1 && corner(s, 0, 0)[1] == 2);
    assert_true(froe_scene_object(s, 0).tag == UINT64_MAX);
    assert_int_equal(froe_scene_object(s, 1).tag, 7);
    froe_scene_free(s);
    froe_scene_free(table("lo_1,lo_2,lo_3,hi_1,hi_2,hi_3\n0,1,2,3,4,5\n", "CSV boxes"));
    froe_scene_free(table("fid,minx,miny,maxx,maxy,x9\n1,0,0,1,1,7\n", "CSV boxes")); /* x9 is no axis beside them */
    s = table("hi_y\thi_x\tlo_x\tlo_y\n4\t3\t1\t2\n", "CSV boxes");
    assert_true(corner(s, 0, 0)[0] == 1 && corner(s, 0, 0)[1] == 2 && corner(s, 0, 1)[0] == 3 &&
                corner(s, 0, 1)[1] == 4);
    froe_scene_free(s);
}

static void other_headers_are_left_to_ogr(void **state) {
    (void)state;
    write_text("wkt.csv", "x,y,WKT\n1,2,\"LINESTRING (0 0,1 1)\"\n");
    froe_read_report report;
    froe_scene *s = read_scene("wkt.csv", &report);
    assert_string_equal(report.format, "CSV");
    assert_int_equal(froe_scene_kind_count(s, FROE_SEGMENT), 1);
    froe_scene_free(s);
    write_text("places.csv", "name,longitude,latitude\nhere,11.5,48.1\n");
    s = read_scene("places.csv", &report);
    assert_int_equal(froe_scene_kind_count(s, FROE_POINT), 1);
    assert_true(corner(s, 0, 0)[0] == 11.5 && corner(s, 0, 0)[1] == 48.1);
    assert_string_equal(froe_scene_group(s, 0).name, "here");
    froe_scene_free(s);
    refuse("table-without-geometry.csv", FROE_E_IO, "No such file");
}

/* As on an old Macintosh. More separators stand in the first bytes than a header may have. */
static void lines_may_end_by_returns_alone(void **state) {
    (void)state;
    enum { ROWS = 1000 };
    char text[8 * ROWS] = "x,y,z\r", *at = text + strlen(text);
    for (int i = 0; i < ROWS; i++) at += sprintf(at, "1,2,0\r");
    froe_scene *s = table(text, "CSV points");
    assert_int_equal(froe_scene_dim(s), 3);
    assert_int_equal(froe_scene_object_count(s), ROWS);
    froe_scene_free(s);
    froe_read_report report;
    write_text("returns.csv", "id,WKT\r1,POINT (1 2)\r");
    s = read_scene("returns.csv", &report);
    assert_string_equal(report.format, "CSV");
    assert_true(corner(s, 0, 0)[0] == 1 && corner(s, 0, 0)[1] == 2);
    froe_scene_free(s);
}

/* What a broken WKT is, and what only looks like one. */
static void geometries_that_are_absent_are_left_out(void **state) {
    (void)state;
    static const char *const names[] = {"WKT", "geometry", "geom"};
    char text[80];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(text, sizeof text, "id,%s\n1,POINT (1 2)\n2,PINT (1 2)\n", names[i]);
        refuse_table(text, FROE_E_FORMAT, "feature 2 of 'bad': Its geometry 'PINT (1 2)' cannot be read.");
    }
    froe_read_report report;
    write_text("two.csv", "id,geometry,WKT\n1,,POINT (1 2)\n2,POINT (3 4),POINT (1 2)\n3,NULL,POINT (5 6)\n");
    froe_scene *s = read_scene("two.csv", &report);
    assert_int_equal(report.no_geometry, 2);
    assert_int_equal(froe_scene_object_count(s), 1);
    assert_true(corner(s, 0, 0)[0] == 3 && corner(s, 0, 0)[1] == 4);
    froe_scene_free(s);
    refuse_table("id,geometry,WKT\n1,PINT (3 4),POINT (1 2)\n", FROE_E_FORMAT, "Its geometry 'PINT (3 4)' cannot");
}

#define DIGITS "1234567890123456789012345678901234567890123456789012345678901"
static void geometries_end_with_their_text(void **state) {
    (void)state;
    write_text("whole.csv", "geom,name\n\"LINESTRING (0.1 0,0." DIGITS " 1) ; \",a\n"
                            "0101000000000000000000F03F0000000000000040,b\n\"POINT Z EMPTY\",c\n"
                            "\"{\"\"type\"\":\"\"Point\"\",\"\"coordinates\"\":[3,4]}\",d\n");
    froe_scene *s = read_scene("whole.csv", NULL);
    assert_int_equal(froe_scene_object_count(s), 3);
    assert_true(corner(s, 0, 1)[0] == 0.1234567890123456789 && corner(s, 1, 0)[1] == 2 && corner(s, 2, 0)[1] == 4);
    froe_scene_free(s);
    refuse_table("WKT,name\n\"LINESTRING (0.1 0,0.2" DIGITS " 1)\",a\n", FROE_E_FORMAT,
                 "feature 1 of 'bad': Of a number of more than 63 characters, "
                 "'0.21234567890123456789012345678901234567...', GDAL makes two.");
    refuse_table("WKT,name\nPOINT (1 2) POINT (3 4),a\n", FROE_E_FORMAT,
                 "feature 1 of 'bad': Behind its geometry stands 'POINT (3 4)', which GDAL leaves out.");
    refuse_table("WKT,name\n\"POINT (1 2), (3 4)\",a\n", FROE_E_FORMAT, "Behind its geometry stands ', (3 4)'");
    refuse_table("WKT\n\"POINT (1 2)\"\n", FROE_E_FORMAT, "bad.csv: GDAL reads no table of one column. Another, which");
}

/* GDAL counts them in whole lines. */
static void quotation_marks_keep_rows_apart(void **state) {
    (void)state;
    static const char *const good[] = {
        "id,WKT\n1,POINT (1 2)\n\"2\",\"POINT (3 4)\"\n",
        "WKT;name\nPOINT (1 2);\"5\"\" pipe\"\nPOINT (3 4);b\n",
        "WKT,name\n\"POINT (1 2)\",\"two\nlines, \"\"\n\"\n\"POINT (3 4)\",\"\"\n",
        "WKT,name\nPOINT (1 2),a \"b\" c\nPOINT (3 4),d\n",
        "\xef\xbb\xbf\"WKT\",\"name\"\r\n\"POINT (1 2)\",\"a\"\r\n\"POINT (3 4)\",\"b\"\r\n",
    };
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        write_text("quotes.csv", good[i]);
        froe_scene *s = read_scene("quotes.csv", NULL);
        assert_int_equal(froe_scene_object_count(s), 2);
        froe_scene_free(s);
    }
    refuse_table("WKT,name\n\"POINT (1 2)\",a\n\"POINT (1 2)\",5\" pipe\n\"POINT (3 4)\",b\n\"POINT (5 6)\",6\" pipe\n",
                 FROE_E_FORMAT, "bad.csv: line 3: GDAL takes rows behind it for a part of it");
    refuse_table("WKT,name\n\"POINT (1 2)\",\"a\"b\"\nPOINT (3 4),c\n", FROE_E_FORMAT, "bad.csv: line 2: GDAL takes");
    refuse_table("WKT,name\nPOINT (1 2),\"a\n\"\nPOINT (3 4),\"b\nPOINT (5 6),c\nPOINT (7 8),d\n", FROE_E_FORMAT,
                 "bad.csv: line 4: A quotation mark is not closed.");
}

static void axes_have_several_names(void **state) {
    (void)state;
    static const char *const headers[] = {"lon,lat", "LNG,Lat", "longitude,latitude", "long,lat", "easting,northing"};
    char text[80];
    for (size_t i = 0; i < sizeof headers / sizeof *headers; i++) {
        snprintf(text, sizeof text, "%s\n2,1\n", headers[i]);
        froe_scene *s = table(text, "CSV points");
        assert_true(corner(s, 0, 0)[0] == 2 && corner(s, 0, 0)[1] == 1);
        froe_scene_free(s);
    }
    froe_scene *s = table("note,latitude,r,longitude\nhere,1,5,2\n", "CSV balls");
    assert_true(corner(s, 0, 0)[0] == 2 && corner(s, 0, 0)[1] == 1 && froe_scene_object(s, 0).radius == 5);
    froe_scene_free(s);
    s = table("lon,lat,x,y\n7,8,1,2\n", "CSV points"); /* x and y count before others */
    assert_true(corner(s, 0, 0)[0] == 1 && corner(s, 0, 0)[1] == 2);
    froe_scene_free(s);
    s = table("lon,lat,z\n7,8,9\n", "CSV points");
    assert_true(froe_scene_dim(s) == 3 && corner(s, 0, 0)[2] == 9);
    froe_scene_free(s);
    s = table("lo_lon,lo_lat,hi_lon,hi_lat\n7,8,9,10\n", "CSV boxes");
    assert_true(corner(s, 0, 1)[0] == 9);
    froe_scene_free(s);
}

static void decimal_commas_stand_between_semicolons(void **state) {
    (void)state;
    froe_scene *s = table("\"a, b\";x;y\nc;0,1;-2,5e1\nd;3.5;4\n", "CSV points");
    assert_true(corner(s, 0, 0)[0] == 0.1 && corner(s, 0, 0)[1] == -25);
    assert_true(corner(s, 1, 0)[0] == 3.5);
    froe_scene_free(s);
    refuse_table("x;y\n1,2,3;4\n", FROE_E_FORMAT, "'1,2,3' is not a number");
    refuse_table("x;y\n1.000,5;4\n", FROE_E_FORMAT, "'1.000,5' is not a number");
}

static void rows_of_one_name_are_a_group(void **state) {
    (void)state;
    froe_scene *s =
        table("name,x,y\n\"St. \"\"J\"\",\nOnt.\",1,2\n\"St. \"\"J\"\",\nOnt.\",3,4\n,5,6\nB,7,8\n", "CSV points");
    assert_int_equal(froe_scene_group_count(s), 2);
    assert_string_equal(froe_scene_group(s, 0).name, "St. \"J\",\nOnt.");
    assert_int_equal(froe_scene_object(s, 1).group, 0);
    assert_int_equal(froe_scene_object(s, 2).group, FROE_NONE);
    assert_string_equal(froe_scene_group(s, froe_scene_object(s, 3).group).name, "B");
    froe_scene_free(s);
    s = table("group,hull,x,y\nroof,1,0,0\nroof,1,1,0\nwall,2,5,5\n", "CSV hulls");
    assert_string_equal(froe_scene_group(s, froe_scene_object(s, 0).group).name, "roof");
    assert_string_equal(froe_scene_group(s, froe_scene_object(s, 1).group).name, "wall");
    froe_scene_free(s);
}

static void headers_without_axes_are_told(void **state) {
    (void)state;
    refuse_table("town,population\nHere,2\n", FROE_E_FORMAT,
                 "bad.csv: The header names town, population. Columns of points are x,y or x1,x2 or lon,lat or "
                 "easting,northing, of balls x,y,r, of boxes lo_x,lo_y,hi_x,hi_y or xmin,ymin,xmax,ymax.");
    refuse_table("x,z\n1,2\n", FROE_E_FORMAT, "The header names x, z. Columns");
    char wide[4 * SUPPORT_CSV_COLUMNS + 40] = "x,y", *at = wide + 3; /* left to OGR */
    for (int i = 2; i <= SUPPORT_CSV_COLUMNS; i++) at += sprintf(at, ",c");
    at += sprintf(at, "\n1,2");
    for (int i = 2; i <= SUPPORT_CSV_COLUMNS; i++) at += sprintf(at, ",");
    write_text("wide.csv", wide);
    froe_read_report report;
    froe_scene *s = read_scene("wide.csv", &report);
    assert_string_equal(report.format, "CSV");
    assert_true(corner(s, 0, 0)[0] == 1 && corner(s, 0, 0)[1] == 2);
    froe_scene_free(s);
    refuse_table("x,lat\n1,2\n", FROE_E_FORMAT, "The header names x, lat. Columns");
    refuse_table("a column with a long name,another one,and one more,one,x\n1,2,3,4,5\n", FROE_E_FORMAT,
                 "The header names a column with a long name, another one and 3 more. Columns");
}

static void numbers_are_the_nearest_doubles_in_any_locale(void **state) {
    (void)state;
    const char *const locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"};
    for (size_t i = 0; i < sizeof locales / sizeof *locales; i++) {
        setlocale(LC_ALL, locales[i]); /* where it is not installed nothing changes */
        froe_scene *s =
            table("x,y\n0.1,-1e308\n4.9406564584124654e-324,0.30000000000000004\n0x1.8p1,-0\n", "CSV points");
        assert_true(corner(s, 0, 0)[0] == 0.1 && corner(s, 0, 0)[1] == -1e308);
        assert_true(corner(s, 1, 0)[0] == 0x1p-1074 && corner(s, 1, 0)[1] == 0.30000000000000004);
        assert_true(corner(s, 2, 0)[0] == 3 && corner(s, 2, 0)[1] == 0);
        froe_scene_free(s);
    }
    setlocale(LC_ALL, "C");
}

static void rows_of_one_number_are_the_corners_of_a_hull(void **state) {
    (void)state;
    froe_scene *s = table("hull,x,y,z,w,tag\n7,0,0,0,0,5\n7,1,0,0,0,6\n7,0,0,0,1,6\n3,0,0,0,0,9\n", "CSV hulls");
    assert_int_equal(froe_scene_kind_count(s, FROE_HULL), 2);
    assert_int_equal(froe_scene_object(s, 0).corners, 3);
    assert_int_equal(froe_scene_object(s, 1).corners, 1);
    assert_true(froe_scene_object(s, 0).tag == 5 && froe_scene_object(s, 1).tag == 9);
    froe_scene_free(s);
    /* beside plain axes such columns are others */
    s = table("x,y,to_x\n1,2,3\n", "CSV points");
    assert_int_equal(froe_scene_dim(s), 2);
    froe_scene_free(s);
}

static void bad_rows_are_named(void **state) {
    (void)state;
    refuse_table("x,y\n1,2\n3,nan\n", FROE_E_INPUT, "row 2: Coordinate y of corner 0 is nan, not a finite number.");
    refuse_table("x,y\n1,-inf\n", FROE_E_INPUT, "row 1: Coordinate y of corner 0 is -inf, not a finite number.");
    refuse_table("x,y\n1,1e309\n", FROE_E_INPUT, "is inf");
    refuse_table("x,y\n1,two\n", FROE_E_FORMAT, "'two' is not a number");
    refuse_table("x,y\n1,2 3\n", FROE_E_FORMAT, "'2 3' is not a number");
    refuse_table("x,y\n1,\n", FROE_E_FORMAT, "missing");
    refuse_table("x,y\n1\n", FROE_E_FORMAT, "The row has 1 column, and the header 2.");
    refuse_table("x,y\n1,2,3\n", FROE_E_FORMAT, "The row has 3 columns, and the header 2.");
    refuse_table("x,y,tag\n1,2,-1\n", FROE_E_FORMAT, "tag");
    refuse_table("x,y,tag\n1,2,18446744073709551616\n", FROE_E_FORMAT, "tag");
    refuse_table("lo_x,lo_y,hi_x,hi_y\n0,0,-1,1\n", FROE_E_INPUT,
                 "Its low corner 0 is above its high corner -1 on axis x.");
    refuse_table("x,y,r\n0,0,-1\n", FROE_E_INPUT, "radius is -1");
    refuse_table("x,y,r\n0,0,inf\n", FROE_E_INPUT, "radius");
    refuse_table("lo_x,lo_y,hi_x\n0,0,1\n", FROE_E_FORMAT,
                 "boxes are lo_ and hi_, of segments from_ and to_, of the same");
    refuse_table("lo_x,lo_y,lo_z,hi_x,hi_y,x\n0,0,1,1,1,1\n", FROE_E_FORMAT,
                 "boxes are lo_ and hi_, of segments from_ and to_, of the same");
    refuse_table("from_x,from_y,to_x\n0,0,1\n", FROE_E_FORMAT, "of segments from_ and to_, of the same");
    refuse_table("hull,x,y\n1,0,0\none,1,0\n", FROE_E_FORMAT, "row 2: The hull 'one' is not a whole number");
    refuse_table("hull,x,y\n1,0,0\n1,nan,0\n", FROE_E_INPUT, "Coordinate x of corner 1 is nan");
    refuse_table("lo_1,hi_1,lo_9,hi_9\n0,1,0,1\n", FROE_E_UNSUPPORTED, "more than 8 axes");
    refuse_table("0,0,1,1\n2,2,3,3\n", FROE_E_FORMAT, "The header names 0, 0, 1, 1. Columns of points are x,y");
    refuse_table("x,y\n", FROE_E_INPUT, "holds no objects");
    refuse_table("x1,x2,x3,x4,x5,x6,x7,x8,x9\n1,2,3,4,5,6,7,8,9\n", FROE_E_UNSUPPORTED, "more than 8");
    write_bytes("zero.csv", "x,y\n1,\0002\n", 9);
    refuse("zero.csv", FROE_E_FORMAT, "byte 6 is zero");
}

static void balls_have_boxes_that_contain_them(void **state) {
    (void)state;
    write_text("balls.csv", "x,y,r\n0.1,0.2,0.3\n5,5,0\n");
    froe_read_options options = froe_read_defaults();
    options.boxes = true;
    froe_scene *s = read_with("balls.csv", &options, NULL);
    assert_int_equal(froe_scene_kind_count(s, FROE_BOX), 2);
    assert_true(corner(s, 0, 0)[0] < 0.1 - 0.3 && corner(s, 0, 1)[1] > 0.2 + 0.3);
    assert_true(corner(s, 1, 0)[0] == 5 && corner(s, 1, 1)[0] == 5);
    froe_scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_header_says_what_the_rows_are),
        cmocka_unit_test(columns_come_in_any_order_with_others_between),
        cmocka_unit_test(other_headers_are_left_to_ogr),
        cmocka_unit_test(lines_may_end_by_returns_alone),
        cmocka_unit_test(geometries_that_are_absent_are_left_out),
        cmocka_unit_test(geometries_end_with_their_text),
        cmocka_unit_test(quotation_marks_keep_rows_apart),
        cmocka_unit_test(axes_have_several_names),
        cmocka_unit_test(decimal_commas_stand_between_semicolons),
        cmocka_unit_test(rows_of_one_name_are_a_group),
        cmocka_unit_test(headers_without_axes_are_told),
        cmocka_unit_test(numbers_are_the_nearest_doubles_in_any_locale),
        cmocka_unit_test(rows_of_one_number_are_the_corners_of_a_hull),
        cmocka_unit_test(bad_rows_are_named),
        cmocka_unit_test(balls_have_boxes_that_contain_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
