/* The header compiles in every supported C standard, twice in a row, and declares what it says. */
#include <delotet/delotet.h>
#include <delotet/delotet.h>

DelotetStatus header_is_usable(const DelotetPlc *plc, DelotetProgressFn progress, DelotetLogFn log);

DelotetStatus header_is_usable(const DelotetPlc *plc, DelotetProgressFn progress, DelotetLogFn log)
{
    DelotetOptions *options = delotet_options_new();
    DelotetMesh *mesh = NULL;
    DelotetStatus status = delotet_options_set_progress(options, progress, NULL, NULL);
    if (status == DELOTET_STATUS_OK)
        status = delotet_options_set_log(options, log, NULL, NULL);
    if (status == DELOTET_STATUS_OK)
        status = delotet_tetrahedralize(plc, options, &mesh, NULL);
    delotet_mesh_free(mesh);
    delotet_options_free(options);
    return status;
}
