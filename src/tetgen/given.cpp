// A given mesh (r): tetrahedra, kept faces and edges, attributes and bounds of a tetgenio; and such a mesh as a PLC.
//
// TetGen refines the boundary of a given mesh as well. The engine's own refinement of meshes keeps it, so where it may change (without Y)
// the mesh becomes a PLC of the same points, faces, edges and regions.
#include "stages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace delotet_tetgen {

namespace {

using delotet::Marker;

std::size_t size(int count)
{
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

/// The corners of tetrahedron `i` of a list with rows of `width`.
delotet::Tet corners_of(const Call &call, const int *list, std::size_t width, std::size_t i, const char *what)
{
    delotet::Tet tet;
    for (std::size_t k = 0; k < 4; k++)
        tet[k] = point_of(call, call.in, list[width * i + k], what, i + 1);
    return tet;
}

/// The attributes of tetrahedra as numbers of different rows.
std::vector<double> materials(const Call &call, Given &given)
{
    const tetgenio &in = call.in;
    const std::size_t width = size(in.numberoftetrahedronattributes);
    std::vector<double> materials;
    if (width == 0 || !in.tetrahedronattributelist)
        return materials;
    std::map<std::vector<double>, std::size_t> known;
    for (std::size_t i = 0; i < size(in.numberoftetrahedra); i++) {
        const double *row = in.tetrahedronattributelist + width * i;
        if (i > 0 && std::equal(row, row + width, row - width)) { // Mostly so: no look-up.
            materials.push_back(materials.back());
            continue;
        }
        for (std::size_t k = 0; k < width; k++)
            if (!(row[k] - row[k] == 0)) // Not finite: no order holds for NaN.
                call.log.fail(bad_input, "An attribute of tetrahedron %zu is not finite.", i + 1);
        const auto entry = known.emplace(std::vector<double>(row, row + width), given.rows.size());
        if (entry.second)
            given.rows.push_back(entry.first->first);
        materials.push_back(static_cast<double>(entry.first->second));
    }
    return materials;
}

/// The largest volumes wanted in the tetrahedra: given ones (a), and in those that are listed to be refined.
std::vector<double> volumes_of(const Call &call, const std::vector<delotet::Tet> &tets)
{
    const tetgenio &in = call.in;
    std::vector<double> volumes;
    if (call.switches.varvolume && in.tetrahedronvolumelist) {
        volumes.assign(tets.size(), no_wish);
        for (std::size_t i = 0; i < tets.size(); i++)
            if (in.tetrahedronvolumelist[i] > 0)
                volumes[i] = in.tetrahedronvolumelist[i];
    }
    if (in.refine_elem_list && in.numberofrefineelems > 0) {
        volumes.resize(tets.size(), no_wish);
        std::map<delotet::Tet, std::size_t> places;
        const auto sorted = [](delotet::Tet tet) {
            std::sort(tet.begin(), tet.end());
            return tet;
        };
        for (std::size_t i = 0; i < tets.size(); i++)
            places.emplace(sorted(tets[i]), i);
        for (std::size_t i = 0; i < size(in.numberofrefineelems); i++) {
            const auto found = places.find(sorted(corners_of(call, in.refine_elem_list, 4, i, "refined tetrahedron")));
            if (found == places.end()) {
                call.log.line("Warning:  Tetrahedron %zu of those to be refined is none of the mesh.", i + 1);
                continue;
            }
            double volume = in.refine_elem_vol_list ? in.refine_elem_vol_list[i] : 0;
            if (!(volume > 0)) { // Refined once: edges of half the length have an eighth of the volume.
                delotet::Point edges[3];
                const delotet::Tet &tet = tets[found->second];
                for (std::size_t k = 0; k < 3; k++)
                    for (std::size_t axis = 0; axis < 3; axis++)
                        edges[k][axis] = in.pointlist[3 * std::size_t{tet[k + 1]} + axis] - in.pointlist[3 * std::size_t{tet[0]} + axis];
                volume = std::abs(edges[0][0] * (edges[1][1] * edges[2][2] - edges[1][2] * edges[2][1]) -
                                  edges[0][1] * (edges[1][0] * edges[2][2] - edges[1][2] * edges[2][0]) +
                                  edges[0][2] * (edges[1][0] * edges[2][1] - edges[1][1] * edges[2][0])) / 48;
            }
            if (volume > 0)
                volumes[found->second] = std::min(volumes[found->second], volume);
        }
    }
    if (std::all_of(volumes.begin(), volumes.end(), [](double volume) { return volume == no_wish; }))
        volumes.clear();
    return volumes;
}

/// A set of faces or edges by their sorted corners.
template <std::size_t N> std::vector<std::array<Index, N>> sorted_rows(std::vector<std::array<Index, N>> rows)
{
    for (auto &row : rows)
        std::sort(row.begin(), row.end());
    std::sort(rows.begin(), rows.end());
    return rows;
}

template <std::size_t N> bool contains(const std::vector<std::array<Index, N>> &rows, std::array<Index, N> row)
{
    std::sort(row.begin(), row.end());
    return std::binary_search(rows.begin(), rows.end(), row);
}

/// The edges where kept faces meet at an angle, or other than two with one marker: the segments of a mesh that is given without any.
std::vector<std::array<Index, 2>> creases(const Call &call, const delotet::Mesh &mesh, const std::vector<Marker> &markers)
{
    struct Side {
        std::array<Index, 2> ends;
        Index apex, face;
    };
    std::vector<Side> sides;
    for (std::size_t i = 0; i < mesh.subfaces().size(); i++) {
        const Index *c = mesh.subfaces()[i].corners;
        for (std::size_t k = 0; k < 3; k++) {
            const Index a = c[k], b = c[(k + 1) % 3];
            sides.push_back({{std::min(a, b), std::max(a, b)}, c[(k + 2) % 3], static_cast<Index>(i)});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) { return a.ends < b.ends || (a.ends == b.ends && a.face < b.face); });
    const delotet::Span<const delotet::Point> points = mesh.points();
    // Across an edge, from the foot of the apex to the apex.
    const auto rise = [&](const Side &side) {
        delotet::Point edge, up;
        double along = 0, square = 0;
        for (std::size_t axis = 0; axis < 3; axis++) {
            edge[axis] = points[side.ends[1]][axis] - points[side.ends[0]][axis];
            up[axis] = points[side.apex][axis] - points[side.ends[0]][axis];
            along += edge[axis] * up[axis];
            square += edge[axis] * edge[axis];
        }
        for (std::size_t axis = 0; axis < 3 && square > 0; axis++)
            up[axis] -= along / square * edge[axis];
        return up;
    };
    const double flat = std::cos(call.switches.facet_separate_ang_tol * 3.14159265358979323846 / 180);
    std::vector<std::array<Index, 2>> edges;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t next = i;
        while (next < sides.size() && sides[next].ends == sides[i].ends)
            next++;
        bool crease = next - i != 2 || markers[sides[i].face] != markers[sides[i + 1].face];
        if (!crease) {
            const delotet::Point a = rise(sides[i]), b = rise(sides[i + 1]);
            const double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            const double lengths = std::sqrt((a[0] * a[0] + a[1] * a[1] + a[2] * a[2]) * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2]));
            crease = product > flat * lengths;
        }
        if (crease)
            edges.push_back(sides[i].ends);
        i = next;
    }
    return edges;
}

} // namespace

Given given_mesh(const Call &call)
{
    const tetgenio &in = call.in;
    if (in.numberoftetrahedra <= 0 || !in.tetrahedronlist || in.numberofcorners < 4)
        call.log.fail(bad_input, "There are no tetrahedra to refine.");
    Given given;
    const std::vector<delotet::Point> points = points_of(in);
    std::vector<delotet::Tet> tets(size(in.numberoftetrahedra));
    for (std::size_t i = 0; i < tets.size(); i++)
        tets[i] = corners_of(call, in.tetrahedronlist, size(in.numberofcorners), i, "tetrahedron");
    const std::vector<double> attributes = materials(call, given);

    // Faces and edges with the marker 0 are no constraints, nor are those of no tetrahedron.
    std::vector<delotet::Triangle> faces, unmarked;
    std::vector<Marker> face_markers;
    if (in.numberoftrifaces > 0 && in.trifacelist) {
        static const std::size_t opposite[4][3] = {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}};
        std::vector<delotet::Triangle> all;
        for (const delotet::Tet &tet : tets)
            for (const auto &face : opposite)
                all.push_back({tet[face[0]], tet[face[1]], tet[face[2]]});
        all = sorted_rows(std::move(all));
        for (std::size_t i = 0; i < size(in.numberoftrifaces); i++) {
            const Marker marker = in.trifacemarkerlist ? in.trifacemarkerlist[i] : call.automatic_marker();
            delotet::Triangle face;
            for (std::size_t k = 0; k < 3; k++)
                face[k] = point_of(call, in, in.trifacelist[3 * i + k], "face", i + 1);
            if (marker == 0) {
                unmarked.push_back(face);
                continue;
            }
            if (!contains(all, face)) {
                call.log.line("Warning:  Face %zu is none of the mesh and has no effect.", i + 1);
                continue;
            }
            faces.push_back(face);
            face_markers.push_back(marker);
        }
    }
    std::vector<std::array<Index, 2>> edges;
    if (in.numberofedges > 0 && in.edgelist) {
        std::vector<std::array<Index, 2>> all;
        for (const delotet::Tet &tet : tets)
            for (std::size_t a = 0; a < 4; a++)
                for (std::size_t b = a + 1; b < 4; b++)
                    all.push_back({tet[a], tet[b]});
        all = sorted_rows(std::move(all));
        for (std::size_t i = 0; i < size(in.numberofedges); i++) {
            const int marker = in.edgemarkerlist ? in.edgemarkerlist[i] : call.automatic_marker();
            const std::array<Index, 2> edge = {point_of(call, in, in.edgelist[2 * i], "edge", i + 1),
                                               point_of(call, in, in.edgelist[2 * i + 1], "edge", i + 1)};
            if (marker == 0)
                continue;
            if (!contains(all, edge)) {
                call.log.line("Warning:  Edge %zu is none of the mesh and has no effect.", i + 1);
                continue;
            }
            edges.push_back(edge);
            given.edge_markers.push_back(marker);
        }
    }
    delotet::MeshArrays arrays;
    arrays.points = points;
    arrays.tets = tets;
    arrays.attributes = attributes;
    arrays.faces = faces;
    arrays.face_markers = face_markers;
    arrays.edges = edges;
    given.mesh = delotet::mesh_from_arrays(arrays);
    // Faces that are kept although they are not listed get the automatic marker, and a mesh without segments those of its shape. What is
    // listed with the marker 0 is kept on the boundary and between regions only, with that marker.
    const bool bare = in.numberofedges <= 0 || !in.edgelist;
    if (bare || given.mesh.subfaces().size() > faces.size()) {
        const std::size_t listed = faces.size();
        unmarked = sorted_rows(std::move(unmarked));
        std::vector<delotet::Triangle> kept;
        std::vector<Marker> markers;
        for (const delotet::Subface &face : given.mesh.subfaces()) {
            kept.push_back({face.corners[0], face.corners[1], face.corners[2]});
            markers.push_back(face.facet < listed                ? face.marker
                              : contains(unmarked, kept.back()) ? 0
                                                                : call.automatic_marker());
        }
        if (bare) {
            edges = creases(call, given.mesh, markers);
            given.edge_markers.assign(edges.size(), call.automatic_marker());
        }
        faces = std::move(kept);
        face_markers = std::move(markers);
        arrays.faces = faces;
        arrays.face_markers = face_markers;
        arrays.edges = edges;
        given.mesh = delotet::mesh_from_arrays(arrays);
    }
    given.volumes = volumes_of(call, tets);
    return given;
}

Domain domain_of(const Call &call, const Given &given, const std::vector<delotet::Point> &voids)
{
    const delotet::Mesh &mesh = given.mesh;
    Domain domain;
    domain.plc = delotet::Plc(mesh.points());
    std::vector<Index> corners;
    std::vector<Marker> markers;
    for (const delotet::Subface &face : mesh.subfaces()) {
        domain.facets.push_back(markers.size());
        corners.insert(corners.end(), face.corners, face.corners + 3);
        markers.push_back(face.marker);
    }
    domain.plc.add_triangles(corners, markers);
    for (const delotet::Point &at : voids)
        domain.plc.add_hole(at);

    // A seed in every part that facets bound: in its largest tetrahedron.
    delotet::Records<delotet::TetQuality> quality = mesh.quality();
    std::vector<bool> seen(mesh.tets().size());
    std::vector<Index> part;
    std::vector<std::array<bool, 4>> walls(mesh.tets().size());
    for (const delotet::Subface &face : mesh.subfaces())
        for (const Index tet : face.tets)
            if (tet != delotet::invalid_index)
                for (std::size_t k = 0; k < 4; k++)
                    if (std::find(face.corners, face.corners + 3, mesh.tets()[tet][k]) == face.corners + 3)
                        walls[tet][k] = true;
    for (std::size_t start = 0; start < seen.size(); start++) {
        if (seen[start])
            continue;
        seen[start] = true;
        part.assign(1, static_cast<Index>(start));
        Index best = part[0];
        for (std::size_t i = 0; i < part.size(); i++) {
            const Index tet = part[i];
            if (quality[tet].volume > quality[best].volume)
                best = tet;
            for (std::size_t k = 0; k < 4; k++) {
                const Index next = mesh.neighbors()[tet][k];
                if (next == delotet::invalid_index || walls[tet][k] || seen[next])
                    continue;
                seen[next] = true;
                part.push_back(next);
            }
        }
        Seed seed;
        for (const Index corner : mesh.tets()[best])
            for (std::size_t axis = 0; axis < 3; axis++)
                seed.at[axis] += mesh.points()[corner][axis] / 4;
        const Index region = mesh.tet_regions()[best];
        seed.attribute = static_cast<int>(given.rows.empty() ? 0 : mesh.regions()[region].attribute);
        seed.origin = domain.seeds.size();
        domain.seeds.push_back(seed);
        domain.plc.add_region(seed.at, seed.attribute, 0);
    }

    std::vector<InputSegment> segments;
    for (const delotet::Subsegment &edge : mesh.subsegments()) {
        InputSegment segment;
        std::copy(edge.ends, edge.ends + 2, segment.ends);
        if (edge.segment == delotet::invalid_index)
            continue;
        segment.marker = given.edge_markers[edge.segment];
        segment.marked = true;
        segment.origin = segments.size();
        segments.push_back(segment);
    }
    complete(call, domain, std::move(segments));
    return domain;
}

} // namespace delotet_tetgen
