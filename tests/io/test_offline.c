/* test_offline.c: files that name what lies on the network are read without it. A socket of this test stands for the
 * network, and so does the function that GDAL fetches addresses by. Where not even the machine itself can be reached
 * the socket says nothing. */
#define _DEFAULT_SOURCE
#include "io/support.h"
#include <arpa/inet.h>
#include <cpl_conv.h>
#include <cpl_http.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/socket.h>
#include <unistd.h>

enum { TEXT = 500 };
static int listener = -1, port, fetched;

static CPLHTTPResult *count_fetch(const char *address, CSLConstList options, GDALProgressFunc progress, void *shown,
                                  CPLHTTPFetchWriteFunc write, void *written, void *user) {
    CPLHTTPResult *nothing = CPLCalloc(1, sizeof *nothing);
    (void)address, (void)options, (void)progress, (void)shown, (void)write, (void)written, (void)user;
    nothing->nStatus = 1;
    fetched++;
    return nothing;
}

static int open_listener(void **state) {
    struct sockaddr_in at = {.sin_family = AF_INET, .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    socklen_t size = sizeof at;
    (void)state;
    listener = socket(AF_INET, SOCK_STREAM, 0);
    if (listener < 0 || bind(listener, (struct sockaddr *)&at, size) || listen(listener, 9) ||
        fcntl(listener, F_SETFL, O_NONBLOCK) || getsockname(listener, (struct sockaddr *)&at, &size))
        return -1;
    port = ntohs(at.sin_port);
    CPLSetConfigOption("GDAL_HTTP_TIMEOUT", "0.2"); /* nothing is answered */
    return CPLHTTPPushFetchCallback(count_fetch, NULL) ? 0 : -1;
}

/* Was there a connection to the socket, or an address fetched, since the last call? */
static bool network_was_used(void) {
    bool used = fetched > 0;
    for (int connection; (connection = accept(listener, NULL, NULL)) >= 0; used = true) close(connection);
    fetched = 0;
    return used;
}

static froe_status read_named(const char *name) {
    froe_scene *scene = NULL;
    const froe_status status = froe_read(name, NULL, &scene, NULL, NULL);
    froe_scene_free(scene);
    return status;
}

/* The text with the port for %d. */
static froe_status read_written(const char *name, const char *form) {
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    assert_true(fprintf(file, form, port) > 0);
    fclose(file);
    return read_named(name);
}

#define LAYER(SOURCE)                                                                                                  \
    "<OGRVRTDataSource><OGRVRTLayer name=\"a\"><SrcDataSource>" SOURCE                                                 \
    "</SrcDataSource><SrcLayer>source</SrcLayer></OGRVRTLayer></OGRVRTDataSource>"
#define LINE(MEMBER)                                                                                                   \
    "{\"type\":\"FeatureCollection\",\"crs\":{\"type\":\"link\",\"properties\":{\"" MEMBER                             \
    "\":\"http://127.0.0.1:%d/wkt\"}},\"features\":[{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":"   \
    "\"LineString\",\"coordinates\":[[0,0],[1,1]]}}]}"

static void what_files_name_is_not_fetched(void **state) {
    (void)state;
    assert_int_equal(read_written("link.geojson", LINE("href")), FROE_OK);
    assert_int_equal(read_written("address.geojson", LINE("url")), FROE_OK);
    read_written("service.xml", "<OGRWFSDataSource><URL>http://127.0.0.1:%d/</URL></OGRWFSDataSource>");
    read_written("file.vrt", LAYER("/vsicurl/http://127.0.0.1:%d/a.geojson"));
    read_written("archive.vrt", LAYER("/vsizip//vsicurl/http://127.0.0.1:%d/a.zip"));
    read_written("service.vrt", LAYER("WFS:http://127.0.0.1:%d/"));
    assert_false(network_was_used());
}

static bool machine_reaches_itself(void) {
    const struct sockaddr_in at = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    const int connection = socket(AF_INET, SOCK_STREAM, 0);
    const bool reached = !connect(connection, (const struct sockaddr *)&at, sizeof at);
    close(connection);
    return reached && network_was_used();
}

static void a_name_in_a_virtual_file_system_is_the_users_wish(void **state) {
    char name[TEXT];
    (void)state;
    snprintf(name, sizeof name, "/vsicurl/http://127.0.0.1:%d/a.geojson", port);
    const bool reached = machine_reaches_itself();
    assert_int_not_equal(read_named(name), FROE_OK);
    assert_int_equal(network_was_used(), reached);
}

static void settings_of_the_thread_are_put_back(void **state) {
    static const char *const settings[] = {"CPL_VSIL_CURL_ALLOWED_FILENAME", "CPL_VSIL_GZIP_WRITE_PROPERTIES"};
    (void)state;
    for (int i = 0; i < 2; i++) CPLSetThreadLocalConfigOption(settings[i], "this");
    assert_int_equal(read_written("link.geojson", LINE("href")), FROE_OK);
    for (int i = 0; i < 2; i++) {
        assert_string_equal(CPLGetThreadLocalConfigOption(settings[i], ""), "this");
        CPLSetThreadLocalConfigOption(settings[i], NULL);
    }
    CPLHTTPDestroyResult(CPLHTTPFetch("http://127.0.0.1/", NULL));
    assert_true(network_was_used());
}

static void only_what_is_named_so_is_a_virtual_file(void **state) {
    (void)state;
    assert_int_equal(read_written("source.geojson", LINE("none")), FROE_OK);
    assert_int_equal(read_written("named.vrt", LAYER("source.geojson") "<!-- %d -->"), FROE_OK);
    assert_int_equal(read_written("named.geojson", LAYER("source.geojson") "<!-- %d -->"), FROE_E_FORMAT);
    assert_int_equal(read_written("named.kml", LAYER("source.geojson") "<!-- %d -->"), FROE_E_FORMAT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_files_name_is_not_fetched),
        cmocka_unit_test(a_name_in_a_virtual_file_system_is_the_users_wish),
        cmocka_unit_test(settings_of_the_thread_are_put_back),
        cmocka_unit_test(only_what_is_named_so_is_a_virtual_file),
    };
    return cmocka_run_group_tests_name("io/offline", tests, open_listener, NULL);
}
