// Our mesh of a model, timed.
#ifndef DELOTET_PEERS_OURS_HPP
#define DELOTET_PEERS_OURS_HPP
#include "peers.hpp"
#include <delotet/delotet.hpp>

struct Ours {
    delotet::Plc plc;
    delotet::Mesh mesh;
    delotet::Error error;
    delotet::Status status;
    Result result; ///< Without points and tetrahedra unless the status is OK.

    Ours(const Model &model, const delotet::Options &options) : plc(model.points)
    {
        std::vector<delotet::Index> corners;
        for (const Triangle &t : model.triangles)
            corners.insert(corners.end(), t.begin(), t.end());
        plc.add_triangles(corners);
        const Stopwatch watch;
        status = delotet::tetrahedralize(plc, options, mesh, error);
        result.seconds = watch.seconds();
        if (status == DELOTET_STATUS_OK) {
            result.points.assign(mesh.points().begin(), mesh.points().end());
            result.tets.assign(mesh.tets().begin(), mesh.tets().end());
        }
    }
};
#endif
