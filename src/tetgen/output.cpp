// A mesh as the arrays of a tetgenio, with TetGen's numbering, orientation and markers.
//
// Input points come first, in their order, without those of no tetrahedron unless J is given; then Steiner points, then the nodes on edges
// of second order. Tetrahedra are positive; faces of the boundary point inward, except for the hull of plain points without f, which
// TetGen lists pointing outward and without markers.
#include "stages.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace delotet_tetgen {

namespace {

constexpr int none = -1; // below any number

/// Which of the edges 01 02 03 12 13 23 two corners have.
constexpr std::size_t edge_at[4][4] = {{0, 0, 1, 2}, {0, 0, 3, 4}, {1, 3, 0, 5}, {2, 4, 5, 0}};
/// The same edges in the order of the nodes of second order.
constexpr std::size_t edge_of_node[6] = {5, 2, 0, 3, 4, 1};

class Writer {
  public:
    Writer(const Call &call, const Result &result, tetgenio &out)
        : call_(call), switches_(call.switches), result_(result), mesh_(result.mesh), tets_(result.mesh.tets()), out_(out),
          first_(out.firstnumber)
    {
    }

    void write()
    {
        number_points();
        if (!switches_.nonodewritten)
            write_points();
        write_tets();
        if (!switches_.nofacewritten) {
            write_faces();
            write_edges();
        }
        if (switches_.neighout > 1)
            write_tet_faces_and_edges();
        if (switches_.voroout)
            write_diagram();
    }

  private:
    bool second_order() const { return switches_.order == 2; }
    int number(std::size_t index) const { return static_cast<int>(index) + first_; }
    int number_or_none(Index index) const { return index == delotet::invalid_index ? none : number(index); }
    int point(Index index) const { return numbers_[index]; }
    int node(std::size_t edge) const { return number(kept_ + edge); }
    /// The edge of tetrahedron `tet` between two of its points.
    std::size_t edge_of(Index tet, Index a, Index b) const
    {
        const delotet::Tet &corners = tets_[tet];
        const auto place = [&](Index at) { return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), at) - corners.begin()); };
        return mesh_.tet_edges()[tet][edge_at[place(a)][place(b)]];
    }

    void number_points()
    {
        const std::size_t count = mesh_.points().size();
        std::vector<bool> unused(count);
        for (const Index index : mesh_.unmeshed_points())
            unused[index] = !(switches_.nojettison && index < call_.input_points());
        for (const Index index : mesh_.hidden_points()) // Points of no tetrahedron because of their weights stay.
            unused[index] = false;
        numbers_.resize(count);
        for (std::size_t i = 0; i < count; i++)
            numbers_[i] = unused[i] ? none : number(kept_++);
        count_of(kept_ + (second_order() ? mesh_.edges().size() : 0) + 1); // Numbers from 1 must fit, too.
    }

    int marker_of_steiner(std::size_t i) const
    {
        if (i >= mesh_.steiner_points().size())
            return 0;
        const delotet::SteinerPoint &point = mesh_.steiner_points()[i];
        if (point.segment != delotet::invalid_index && point.segment < result_.segment_markers.size())
            return result_.segment_markers[point.segment];
        if (point.facet != delotet::invalid_index)
            return point.facet < result_.facet_markers.size() ? result_.facet_markers[point.facet] : 0;
        return point.ends[0] != delotet::invalid_index ? call_.automatic_marker() : 0;
    }

    void write_points()
    {
        const PointRows given = point_rows(call_);
        const std::size_t count = mesh_.points().size(), width = given.width();
        const std::size_t nodes = second_order() ? mesh_.edges().size() : 0, total = kept_ + nodes;
        out_.numberofpoints = count_of(total);
        out_.pointlist = new_array<double>(total, 3);
        if (given.attributes > 0) {
            out_.numberofpointattributes = call_.in.numberofpointattributes;
            out_.pointattributelist = new_array<double>(total, given.attributes);
        }
        if (given.sizes > 0) {
            out_.numberofpointmtrs = call_.in.numberofpointmtrs;
            out_.pointmtrlist = new_array<double>(total, given.sizes);
        }
        const bool marked = call_.in.pointmarkerlist && !switches_.nobound;
        if (marked)
            out_.pointmarkerlist = new_array<int>(total);
        const delotet::Span<const delotet::Point> points = mesh_.points();
        const double *rows = result_.point_rows.empty() ? mesh_.point_attributes().data : result_.point_rows.data();
        const std::size_t inputs = call_.input_points(), placed = inputs + call_.added_points();
        for (std::size_t i = 0, at = 0; i < count; i++) {
            if (numbers_[i] == none)
                continue;
            std::copy(points[i].begin(), points[i].end(), out_.pointlist + 3 * at);
            if (rows && width > 0) {
                std::copy(rows + width * i, rows + width * i + given.attributes, out_.pointattributelist + given.attributes * at);
                std::copy(rows + width * i + given.attributes, rows + width * (i + 1), out_.pointmtrlist + given.sizes * at);
            }
            if (marked)
                out_.pointmarkerlist[at] = i < inputs   ? call_.in.pointmarkerlist[i]
                                           : i < placed ? call_.addin->pointmarkerlist ? call_.addin->pointmarkerlist[i - inputs] : 0
                                                        : marker_of_steiner(i - placed);
            at++;
        }
        if (nodes == 0)
            return;
        const delotet::SecondOrder second = mesh_.second_order(delotet::NodeOrder::tetgen);
        for (std::size_t i = 0; i < nodes; i++) {
            const std::size_t at = kept_ + i;
            std::copy(second.nodes[i].begin(), second.nodes[i].end(), out_.pointlist + 3 * at);
            if (marked)
                out_.pointmarkerlist[at] = 0;
            const delotet::Edge &edge = mesh_.edges()[i];
            for (std::size_t k = 0; rows && k < width; k++) {
                const double middle = (rows[width * edge.ends[0] + k] + rows[width * edge.ends[1] + k]) / 2;
                (k < given.attributes ? out_.pointattributelist[given.attributes * at + k]
                                      : out_.pointmtrlist[given.sizes * at + k - given.attributes]) = middle;
            }
        }
    }

    /// Corner `k` of a tetrahedron in the output's order: z1 exchanges the first two.
    std::size_t turned(std::size_t k) const { return switches_.reversetetori && k < 2 ? 1 - k : k; }
    /// The same for nodes of second order, which go with the corners.
    std::size_t turned_node(std::size_t k) const
    {
        static const std::size_t exchanged[6] = {0, 4, 2, 5, 1, 3};
        return switches_.reversetetori ? exchanged[k] : k;
    }

    void write_tets()
    {
        const std::size_t count = tets_.size(), corners = second_order() ? 10 : 4;
        out_.numberofcorners = static_cast<int>(corners);
        const std::size_t width = result_.rows.empty() ? 0 : result_.rows[0].size();
        if (!switches_.noelewritten) {
            out_.numberoftetrahedra = count_of(count);
            out_.tetrahedronlist = new_array<int>(count, corners);
            out_.numberoftetrahedronattributes = count_of(width);
            out_.tetrahedronattributelist = new_array<double>(count, width);
            const delotet::Span<const Index> regions = mesh_.tet_regions();
            for (std::size_t i = 0; i < count; i++) {
                int *to = out_.tetrahedronlist + corners * i;
                for (std::size_t k = 0; k < 4; k++)
                    to[k] = point(tets_[i][turned(k)]);
                for (std::size_t k = 4; k < corners; k++)
                    to[k] = node(mesh_.tet_edges()[i][edge_of_node[turned_node(k - 4)]]);
                if (width > 0) {
                    const std::vector<double> &row = result_.rows[regions[i]];
                    std::copy(row.begin(), row.end(), out_.tetrahedronattributelist + width * i);
                }
            }
        }
        if (switches_.neighout > 0) {
            out_.numberoftetrahedra = count_of(count);
            out_.neighborlist = new_array<int>(count, 4);
            const delotet::Span<const delotet::Tet> neighbors = mesh_.neighbors();
            for (std::size_t i = 0; i < count; i++)
                for (std::size_t k = 0; k < 4; k++)
                    out_.neighborlist[4 * i + k] = number_or_none(neighbors[i][turned(k)]);
        }
        if ((switches_.neighout > 1 || switches_.metric) && !switches_.nonodewritten) {
            out_.point2tetlist = new_array<int>(kept_ + (second_order() ? mesh_.edges().size() : 0));
            for (std::size_t i = 0, at = 0; i < numbers_.size(); i++)
                if (numbers_[i] != none)
                    out_.point2tetlist[at++] = number_or_none(mesh_.point_tets()[i]);
            for (std::size_t i = 0; second_order() && i < mesh_.edges().size(); i++)
                out_.point2tetlist[kept_ + i] = number(mesh_.edges()[i].tet);
        }
    }

    /// A face of the output.
    struct OutputFace {
        Index corners[3];
        Index tets[2];
        int marker;
    };

    std::vector<OutputFace> faces() const
    {
        std::vector<OutputFace> faces;
        if (result_.surface && !switches_.facesout)
            faces.reserve(mesh_.subfaces().size());
        const auto add = [&](const Index *c, const Index *tets, int marker, bool inward) {
            if (inward)
                faces.push_back({{c[0], c[2], c[1]}, {tets[0], tets[1]}, marker});
            else
                faces.push_back({{c[0], c[1], c[2]}, {tets[0], tets[1]}, marker});
        };
        if (switches_.facesout) {
            for (const delotet::Face &face : mesh_.faces()) {
                const bool hull = face.tets[1] == delotet::invalid_index;
                add(face.corners, face.tets, result_.surface ? face.marker : hull, true);
            }
        } else if (result_.surface) {
            for (const delotet::Subface &face : mesh_.subfaces())
                add(face.corners, face.tets, face.marker, true);
        } else {
            // Across from each corner, pointing away from it.
            static const std::size_t across[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
            const delotet::Span<const delotet::Tet> neighbors = mesh_.neighbors();
            for (std::size_t i = 0; i < tets_.size(); i++)
                for (std::size_t k = 0; k < 4; k++) {
                    if (neighbors[i][k] != delotet::invalid_index)
                        continue;
                    const Index face[3] = {tets_[i][across[k][0]], tets_[i][across[k][1]], tets_[i][across[k][2]]};
                    const Index sides[2] = {static_cast<Index>(i), delotet::invalid_index};
                    add(face, sides, 0, false);
                }
        }
        return faces;
    }

    void write_faces()
    {
        const std::vector<OutputFace> list = faces();
        out_.numberoftrifaces = count_of(list.size());
        out_.trifacelist = new_array<int>(list.size(), 3);
        if (!switches_.nobound && (result_.surface || switches_.facesout))
            out_.trifacemarkerlist = new_array<int>(list.size());
        if (second_order())
            out_.o2facelist = new_array<int>(list.size(), 3);
        if (switches_.neighout > 1)
            out_.face2tetlist = new_array<int>(list.size(), 2);
        // With f node i is across from corner i, else it follows it.
        const std::size_t shift = switches_.facesout ? 1 : 0;
        for (std::size_t i = 0; i < list.size(); i++) {
            const OutputFace &face = list[i];
            for (std::size_t k = 0; k < 3; k++) {
                out_.trifacelist[3 * i + k] = point(face.corners[k]);
                if (out_.o2facelist)
                    out_.o2facelist[3 * i + k] =
                        node(edge_of(face.tets[0], face.corners[(k + shift) % 3], face.corners[(k + shift + 1) % 3]));
            }
            if (out_.trifacemarkerlist)
                out_.trifacemarkerlist[i] = face.marker;
            for (std::size_t k = 0; out_.face2tetlist && k < 2; k++)
                out_.face2tetlist[2 * i + k] = number_or_none(face.tets[k]);
        }
        if (switches_.neighout > 1)
            face_list_ = list;
    }

    int marker_of_subsegment(const delotet::Subsegment &piece) const
    {
        return piece.segment < result_.segment_markers.size() ? result_.segment_markers[piece.segment] : call_.automatic_marker();
    }

    /// Whether side `k` of a face is an edge of the polygon that the face lies on.
    bool is_polygon_edge(const delotet::Subface &face, std::size_t k) const
    {
        const Index a = face.corners[k], b = face.corners[(k + 1) % 3];
        for (std::size_t number = 0; number < result_.plc.facet_ring_count(face.facet); number++) {
            const delotet::Span<const Index> ring = result_.plc.facet_ring(face.facet, number);
            for (std::size_t at = 0; at < ring.size(); at++) {
                const Index next = ring[at + 1 == ring.size() ? 0 : at + 1];
                if ((ring[at] == a && next == b) || (ring[at] == b && next == a))
                    return true;
            }
        }
        return false;
    }

    /// An edge that is listed without e.
    struct ListedEdge {
        Index ends[2];
        bool segment; // else an edge of a polygon
        int marker;
        bool operator<(const ListedEdge &other) const
        {
            return std::make_tuple(ends[0], ends[1], !segment) < std::make_tuple(other.ends[0], other.ends[1], !other.segment);
        }
    };

    /// The segments; with Y also the edges of polygons between coplanar ones, which stay and which TetGen lists as segments.
    std::vector<ListedEdge> segments() const
    {
        std::vector<ListedEdge> list;
        for (const delotet::Subsegment &piece : mesh_.subsegments())
            list.push_back({{std::min(piece.ends[0], piece.ends[1]), std::max(piece.ends[0], piece.ends[1])}, true, marker_of_subsegment(piece)});
        if (!switches_.nobisect || !result_.plc.get())
            return list;
        for (const delotet::Subface &face : mesh_.subfaces())
            for (std::size_t k = 0; k < 3; k++) {
                const Index a = face.corners[k], b = face.corners[(k + 1) % 3];
                if (is_polygon_edge(face, k))
                    list.push_back({{std::min(a, b), std::max(a, b)}, false, call_.automatic_marker()});
            }
        std::sort(list.begin(), list.end());
        const auto same = [](const ListedEdge &a, const ListedEdge &b) { return std::equal(a.ends, a.ends + 2, b.ends); };
        list.erase(std::unique(list.begin(), list.end(), same), list.end());
        return list;
    }

    /// The segments alone, without what only the list of all edges tells.
    void write_segments()
    {
        const std::vector<ListedEdge> list = segments();
        out_.numberofedges = count_of(list.size());
        out_.edgelist = new_array<int>(list.size(), 2);
        out_.edgemarkerlist = new_array<int>(list.size());
        for (std::size_t i = 0; i < list.size(); i++) {
            out_.edgelist[2 * i] = point(list[i].ends[0]);
            out_.edgelist[2 * i + 1] = point(list[i].ends[1]);
            out_.edgemarkerlist[i] = list[i].marker;
        }
    }

    /// By edge of the mesh, whether it is an edge of a polygon that stays.
    std::vector<bool> polygon_edges() const
    {
        std::vector<bool> kept(mesh_.edges().size());
        if (!switches_.nobisect || !result_.plc.get())
            return kept;
        const delotet::Span<const delotet::Triangle> edges = mesh_.subface_edges();
        for (std::size_t i = 0; i < edges.size(); i++)
            for (std::size_t k = 0; k < 3; k++)
                if (is_polygon_edge(mesh_.subfaces()[i], k))
                    kept[edges[i][k]] = true;
        return kept;
    }

    void write_edges()
    {
        if (!switches_.edgesout && !result_.surface)
            return;
        if (!switches_.edgesout && !second_order() && switches_.neighout < 2)
            return write_segments();
        std::vector<bool> hull; // The edges of hull faces, which are marked for plain points.
        if (!result_.surface) {
            hull.resize(mesh_.edges().size());
            for (const delotet::Face &face : mesh_.faces())
                for (std::size_t k = 0; face.tets[1] == delotet::invalid_index && k < 3; k++)
                    hull[edge_of(face.tets[0], face.corners[k], face.corners[(k + 1) % 3])] = true;
        }
        const delotet::Records<delotet::Edge> all = mesh_.edges();
        const std::vector<bool> kept = polygon_edges();
        for (std::size_t i = 0; i < all.size(); i++)
            if (switches_.edgesout || kept[i] || all[i].subsegment != delotet::invalid_index)
                edge_list_.push_back(static_cast<Index>(i));
        const std::size_t count = edge_list_.size();
        out_.numberofedges = count_of(count);
        out_.edgelist = new_array<int>(count, 2);
        out_.edgemarkerlist = new_array<int>(count);
        if (second_order())
            out_.o2edgelist = new_array<int>(count);
        if (switches_.neighout > 1)
            out_.edge2tetlist = new_array<int>(count);
        for (std::size_t i = 0; i < count; i++) {
            const delotet::Edge &edge = all[edge_list_[i]];
            out_.edgelist[2 * i] = point(edge.ends[0]);
            out_.edgelist[2 * i + 1] = point(edge.ends[1]);
            out_.edgemarkerlist[i] = edge.subsegment != delotet::invalid_index ? marker_of_subsegment(mesh_.subsegments()[edge.subsegment])
                                     : kept[edge_list_[i]]                    ? call_.automatic_marker()
                                     : hull.empty()                           ? 0
                                                                              : hull[edge_list_[i]];
            if (out_.o2edgelist)
                out_.o2edgelist[i] = node(edge_list_[i]);
            if (out_.edge2tetlist)
                out_.edge2tetlist[i] = number(edge.tet);
        }
    }

    /// The faces and edges of tetrahedra, and the edges of faces, by their numbers in the lists; -1 for those that are not listed.
    void write_tet_faces_and_edges()
    {
        const std::size_t count = tets_.size();
        std::vector<int> edges(mesh_.edges().size(), none);
        for (std::size_t i = 0; i < edge_list_.size(); i++)
            edges[edge_list_[i]] = number(i);
        out_.tet2edgelist = new_array<int>(count, 6);
        out_.tet2facelist = new_array<int>(count, 4);
        std::fill(out_.tet2facelist, out_.tet2facelist + 4 * count, none);
        for (std::size_t i = 0; i < count; i++)
            for (std::size_t k = 0; k < 6; k++)
                out_.tet2edgelist[6 * i + k] = edges[mesh_.tet_edges()[i][edge_of_node[turned_node(k)]]];
        out_.face2edgelist = new_array<int>(face_list_.size(), 3);
        const std::size_t shift = switches_.facesout ? 1 : 0;
        for (std::size_t i = 0; i < face_list_.size(); i++) {
            const OutputFace &face = face_list_[i];
            for (std::size_t k = 0; k < 3; k++)
                out_.face2edgelist[3 * i + k] =
                    edges[edge_of(face.tets[0], face.corners[(k + shift) % 3], face.corners[(k + shift + 1) % 3])];
            for (const Index tet : face.tets) {
                if (tet == delotet::invalid_index)
                    continue;
                for (std::size_t k = 0; k < 4; k++)
                    if (std::find(face.corners, face.corners + 3, tets_[tet][turned(k)]) == face.corners + 3)
                        out_.tet2facelist[4 * std::size_t{tet} + k] = number(i);
            }
        }
    }

    void write_diagram()
    {
        if (!result_.surface)
            return write_voronoi(mesh_, numbers_, out_);
        // A mesh with facets is not Delaunay: its points have a diagram all the same.
        std::vector<delotet::Point> points;
        std::vector<int> numbers;
        for (std::size_t i = 0; i < numbers_.size(); i++)
            if (numbers_[i] >= first_) {
                points.push_back(mesh_.points()[i]);
                numbers.push_back(numbers_[i]);
            }
        const delotet::Plc plc(points);
        write_voronoi(delotet::tetrahedralize(plc, delotet::Options().mode(delotet::Mode::delaunay)), numbers, out_);
    }

    const Call &call_;
    const tetgenbehavior &switches_;
    const Result &result_;
    const delotet::Mesh &mesh_;
    const delotet::Span<const delotet::Tet> tets_;
    tetgenio &out_;
    const int first_;
    std::vector<int> numbers_; // of each point in the output
    std::size_t kept_ = 0;
    std::vector<OutputFace> face_list_; // with nn
    std::vector<Index> edge_list_;      // the listed edges
};

} // namespace

void write_output(const Call &call, const Result &result, tetgenio &out)
{
    Writer(call, result, out).write();
}

void write_empty_output(const Call &call, tetgenio &out)
{
    out.numberofcorners = 4;
    if (!call.switches.nojettison || call.switches.nonodewritten)
        return;
    const tetgenio &in = call.in;
    const std::size_t count = call.input_points();
    out.numberofpoints = in.numberofpoints;
    out.pointlist = new_array<double>(count, 3);
    std::copy(in.pointlist, in.pointlist + 3 * count, out.pointlist);
    if (in.numberofpointattributes > 0 && in.pointattributelist) {
        const std::size_t width = static_cast<std::size_t>(in.numberofpointattributes);
        out.numberofpointattributes = in.numberofpointattributes;
        out.pointattributelist = new_array<double>(count, width);
        std::copy(in.pointattributelist, in.pointattributelist + width * count, out.pointattributelist);
    }
    if (in.pointmarkerlist && !call.switches.nobound) {
        out.pointmarkerlist = new_array<int>(count);
        std::copy(in.pointmarkerlist, in.pointmarkerlist + count, out.pointmarkerlist);
    }
}

} // namespace delotet_tetgen
