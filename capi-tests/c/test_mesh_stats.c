/* delotet_mesh_stats: writes no more than the caller has room for. */
#include "test.h"

int main(void)
{
    DelotetMesh *mesh = mesh_of(twisted_prism());
    struct {
        DelotetStats stats;
        unsigned char guard[64];
    } room;
    DelotetStats old;
    memset(&room, 0xAB, sizeof room);
    room.stats.struct_size = sizeof room; /* A newer program: larger than what this library knows. */
    CHECK(delotet_mesh_stats(mesh, &room.stats) == DELOTET_STATUS_OK);
    CHECK(room.stats.struct_size == sizeof(DelotetStats));
    CHECK(room.guard[0] == 0xAB && room.guard[63] == 0xAB);
    CHECK(room.stats.steiner == delotet_mesh_steiner_points(mesh).count);
    CHECK(room.stats.seconds[DELOTET_PHASE_DELAUNAY] >= 0 && room.stats.seconds[15] == 0);
    memset(&old, 0xAB, sizeof old);
    old.struct_size = offsetof(DelotetStats, steiner_exact); /* An older program. */
    CHECK(delotet_mesh_stats(mesh, &old) == DELOTET_STATUS_OK);
    CHECK(old.struct_size == offsetof(DelotetStats, steiner_exact) && old.steiner == room.stats.steiner);
    CHECK(old.steiner_exact == UINT64_C(0xABABABABABABABAB));
    old.struct_size = 0;
    CHECK(delotet_mesh_stats(mesh, &old) == INVALID);
    CHECK(delotet_mesh_stats(mesh, NULL) == INVALID);
    CHECK(delotet_mesh_stats(NULL, &old) == INVALID);
    delotet_mesh_free(mesh);
    return 0;
}
