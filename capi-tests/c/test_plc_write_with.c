/* delotet_plc_write_with: what a format cannot hold, and what has no effect, is told, a line each. */
#include "test.h"

static char lines[8][200];
static int count;

static void line(void *user_data, const char *message)
{
    CHECK(user_data == lines && count < 8 && strlen(message) < 200);
    strcpy(lines[count++], message);
}

/* The only line since the last time is a warning that has these words. */
static int told(const char *words)
{
    int fine = count == 1 && strncmp(lines[0], "warning: ", 9) == 0 && strstr(lines[0], words) != NULL;
    count = 0;
    return fine;
}

int main(void)
{
    static const double xyz[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.1}, attributes[4] = {0, 0, 0, 7};
    static const int32_t markers[4] = {0, 3, 0, 0};
    static const uint32_t corners[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    static const uint32_t corner[3] = {0, 1, 2};
    DelotetWriteOptions *options = delotet_write_options_new();
    DelotetPlc *plc = NULL, *back = NULL;
    OK(delotet_plc_new(xyz, 4, &plc, &error));
    OK(delotet_plc_add_triangles(plc, corners, NULL, 4, &error));
    OK(delotet_write_options_set_log(options, line, lines, &error));
    OK(delotet_plc_write_with(plc, "plc_write_with.off", options, &error));
    CHECK(count == 0);
    OK(delotet_plc_write_with(plc, "plc_write_with.stl", options, &error));
    CHECK(told("cannot be stored in this file format (point 3)")); /* 0.1 is rounded to single precision. */
    OK(delotet_plc_set_point_markers(plc, markers, &error));
    OK(delotet_plc_write_with(plc, "plc_write_with.off", options, &error));
    CHECK(told("cannot be stored in this file format (point 1)"));
    OK(delotet_plc_write_with(plc, "plc_write_with.node", options, &error));
    CHECK(told("cannot be stored in this file format (facet 0)"));
    OK(delotet_plc_set_point_markers(plc, NULL, &error));
    OK(delotet_plc_set_point_attributes(plc, attributes, 1, &error));
    OK(delotet_plc_write_with(plc, "plc_write_with.ply", options, &error));
    CHECK(told("cannot be stored in this file format (point 3)"));
    OK(delotet_plc_write_with(plc, "plc_write_with.poly", options, &error));
    CHECK(count == 0);
    OK(delotet_write_options_set_second_order(options, true, &error));
    OK(delotet_plc_write_with(plc, "plc_write_with.poly", options, &error));
    CHECK(told("second_order has no effect"));

    OK(delotet_plc_write_with(plc, "plc_write_with.off", NULL, &error));
    OK(delotet_plc_read("plc_write_with.off", &back, &error));
    CHECK(delotet_plc_facet_count(back) == 4 && memcmp(delotet_plc_facet_ring(back, 0, 0).data, corner, 4) == 0);
    delotet_plc_free(back);
    FAILS(DELOTET_STATUS_UNSUPPORTED, delotet_plc_write_with(plc, "plc_write_with.vtu", options, &error));
    FAILS(DELOTET_STATUS_FILE, delotet_plc_write_with(plc, "no/such/folder.off", options, &error));
    FAILS(INVALID, delotet_plc_write_with(plc, NULL, options, &error));
    FAILS(INVALID, delotet_plc_write_with(NULL, "plc_write_with.off", options, &error));
    CHECK(count == 0);
    CHECK(remove("plc_write_with.off") == 0 && remove("plc_write_with.stl") == 0 && remove("plc_write_with.node") == 0);
    CHECK(remove("plc_write_with.ply") == 0 && remove("plc_write_with.poly") == 0);
    delotet_plc_free(plc);
    delotet_write_options_free(options);
    return 0;
}
