/* delotet for C++17: owning handles, spans, exceptions that carry all defects, callbacks that may throw. MIT OR Apache-2.0.
 *
 * A thin layer over delotet.h, which documents shapes, ownership and threads; the names are the same.
 *
 * Two forms of every call that can fail:
 *   - the plain form throws delotet::Exception;
 *   - the form with an `Error &` as last argument returns the status, throws nothing of its own, and is all there is with
 *     -fno-exceptions. Its results are written on success only.
 * Callbacks are std::functions and may throw: the run is then cancelled, and the exception comes out of the call.
 * Views (Span) point into the object they come from and die with it. Nothing is allocated beside what the library allocates,
 * except for a std::function that is too large for its own buffer and for the exception object of a failure.
 */
#ifndef DELOTET_DELOTET_HPP
#define DELOTET_DELOTET_HPP

#include <delotet/delotet.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define DELOTET_EXCEPTIONS 1
#else
#define DELOTET_EXCEPTIONS 0
#endif

namespace delotet {

using Status = DelotetStatus;
using Phase = DelotetPhase;
using Defect = DelotetDefect;
using Region = DelotetRegion;
using Subface = DelotetSubface;
using Subsegment = DelotetSubsegment;
using SteinerPoint = DelotetSteinerPoint;
using SteinerTerm = DelotetSteinerTerm;
using FacetFlip = DelotetFacetFlip;
using Face = DelotetFace;
using Edge = DelotetEdge;
using Stats = DelotetStats;

using Index = std::uint32_t;
using Marker = std::int32_t;
using Point = std::array<double, 3>;
using Tet = std::array<Index, 4>;
using Tet10 = std::array<Index, 10>;

/// "None": no neighbour, no parent, not found.
constexpr Index invalid_index = DELOTET_INVALID_INDEX;

enum class Mode : std::uint32_t {
    delaunay = DELOTET_MODE_DELAUNAY,
    constrained = DELOTET_MODE_CONSTRAINED,
    preserve = DELOTET_MODE_PRESERVE
};

enum class Preserve : std::uint32_t { all = DELOTET_PRESERVE_ALL, outer = DELOTET_PRESERVE_OUTER };

enum class NodeOrder : std::uint32_t {
    vtk = DELOTET_NODE_ORDER_VTK,
    gmsh = DELOTET_NODE_ORDER_GMSH,
    tetgen = DELOTET_NODE_ORDER_TETGEN
};

/// The loaded library has the ABI of this header (the same minor version before 1.0, the same major version after).
inline bool compatible() noexcept
{
    const std::uint32_t library = delotet_version();
    if (DELOTET_VERSION_MAJOR == 0)
        return library / 1000 == DELOTET_VERSION / 1000 && library >= DELOTET_VERSION;
    return library / 1000000 == DELOTET_VERSION_MAJOR && library >= DELOTET_VERSION;
}

/// Elements in a row that belong to somebody else: made of pointer and count, of C arrays, and of all that has data() and size().
template <class T> class Span {
  public:
    constexpr Span() noexcept = default;
    constexpr Span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    template <std::size_t N> constexpr Span(T (&array)[N]) noexcept : data_(array), size_(N) {}
    template <class C,
              class = std::enable_if_t<
                  std::is_convertible_v<std::remove_pointer_t<decltype(std::declval<C &>().data())> (*)[], T (*)[]>>,
              class = decltype(std::declval<C &>().size())>
    constexpr Span(C &&container) noexcept : data_(container.data()), size_(container.size())
    {
    }

    constexpr T *data() const noexcept { return data_; }
    constexpr std::size_t size() const noexcept { return size_; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    constexpr T &operator[](std::size_t i) const noexcept { return data_[i]; }
    constexpr T *begin() const noexcept { return data_; }
    constexpr T *end() const noexcept { return data_ + size_; }

  private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

/// A failure with all its defects; empty on success.
class Error {
  public:
    Error() noexcept = default;

    Status status() const noexcept { return handle_ ? delotet_error_status(handle_.get()) : status_; }
    const char *message() const noexcept { return handle_ ? delotet_error_message(handle_.get()) : text_; }
    /// The elements at fault, at most as many as Options::max_defects allows; defect_count() counts all.
    Span<const Defect> defects() const noexcept
    {
        const DelotetDefectsView view = delotet_error_defects(handle_.get());
        return {view.data, view.count};
    }
    std::size_t defect_count() const noexcept { return delotet_error_defect_count(handle_.get()); }
    explicit operator bool() const noexcept { return status() != DELOTET_STATUS_OK; }

    /// For the wrapper: takes over what a call reported.
    Status set(Status status, DelotetError *handle, const char *text = "") noexcept
    {
        handle_.reset(handle);
        status_ = status;
        text_ = text;
        return status;
    }
    DelotetError *release() noexcept { return handle_.release(); }

  private:
    struct Free {
        void operator()(DelotetError *error) const noexcept { delotet_error_free(error); }
    };
    std::unique_ptr<DelotetError, Free> handle_;
    Status status_ = DELOTET_STATUS_OK;
    const char *text_ = "";
};

#if DELOTET_EXCEPTIONS
/// A failure as an exception; copies share the report.
class Exception : public std::exception {
  public:
    explicit Exception(Error &&error)
        : status_(error.status()), text_(error.message()), handle_(error.release(), delotet_error_free)
    {
    }
    Status status() const noexcept { return status_; }
    const char *what() const noexcept override { return text_; }
    /// The elements at fault.
    Span<const Defect> defects() const noexcept
    {
        const DelotetDefectsView view = delotet_error_defects(handle_.get());
        return {view.data, view.count};
    }
    std::size_t defect_count() const noexcept { return delotet_error_defect_count(handle_.get()); }

  private:
    Status status_;
    const char *text_;
    std::shared_ptr<DelotetError> handle_;
};
#endif

/// Receives progress: `fraction` of `phase` is done. Returns false to cancel.
using ProgressFunction = std::function<bool(Phase phase, double fraction)>;
/// Receives a line of text.
using LogFunction = std::function<void(const char *message)>;

namespace detail {

template <class T, void (*free_function)(T *)> struct Free {
    void operator()(T *handle) const noexcept { free_function(handle); }
};

/// Runs a C call that ends with `DelotetError **` and puts its report into `error`.
template <class Call> Status run(Error &error, Call &&call)
{
    DelotetError *handle = nullptr;
    const Status status = call(&handle);
    return error.set(status, handle);
}

inline Status mismatch(Error &error) noexcept
{
    return error.set(DELOTET_STATUS_INVALID_ARGUMENT, nullptr, "the sizes of the arrays do not fit together");
}

/// The markers of `count` elements: none, or one each.
inline bool fits(Span<const Marker> markers, std::size_t count) noexcept
{
    return markers.empty() || markers.size() == count;
}

template <class To, class From> Span<const To> rows(const From *data, std::size_t count) noexcept
{
    static_assert(sizeof(To) % sizeof(From) == 0 && alignof(To) == alignof(From));
    return {reinterpret_cast<const To *>(data), count};
}

#if DELOTET_EXCEPTIONS
/// Makes the throwing form of a call from the other.
template <class Call> void require(Call &&call)
{
    Error error;
    if (call(error) != DELOTET_STATUS_OK)
        throw Exception(std::move(error));
}
#endif

/// The callbacks of the call that this thread is in. Callbacks come on the calling thread, so no allocation and no lock is needed,
/// and options may serve several threads at the same time.
class Running {
  public:
    Running(const ProgressFunction &progress, const LogFunction &log) noexcept
        : progress_(progress), log_(log), outer_(current())
    {
        current() = this;
    }
    ~Running() { current() = outer_; }
    Running(const Running &) = delete;
    Running &operator=(const Running &) = delete;

    static std::int32_t progress(void *, DelotetPhase phase, double fraction) noexcept
    {
        Running *self = current();
        if (!self || !self->progress_)
            return self && self->failed();
        bool go_on = true;
        self->guarded([&] { go_on = self->progress_(phase, fraction); });
        return !go_on || self->failed();
    }
    static void log(void *, const char *message) noexcept
    {
        Running *self = current();
        if (self && self->log_ && !self->failed())
            self->guarded([&] { self->log_(message); });
    }
    /// Throws what a callback threw.
    void rethrow()
    {
#if DELOTET_EXCEPTIONS
        if (thrown_)
            std::rethrow_exception(std::exchange(thrown_, nullptr));
#endif
    }

  private:
    static Running *&current() noexcept
    {
        thread_local Running *running = nullptr;
        return running;
    }
    /// No exception may pass through the library: it waits here until the call has returned.
    template <class Call> void guarded(Call &&call) noexcept
    {
#if DELOTET_EXCEPTIONS
        if (thrown_)
            return;
        try {
            call();
        } catch (...) {
            thrown_ = std::current_exception();
        }
#else
        call();
#endif
    }
    bool failed() const noexcept
    {
#if DELOTET_EXCEPTIONS
        return thrown_ != nullptr;
#else
        return false;
#endif
    }

    const ProgressFunction &progress_;
    const LogFunction &log_;
    Running *outer_;
#if DELOTET_EXCEPTIONS
    std::exception_ptr thrown_;
#endif
};

} // namespace detail

/// Settings of a run. Setters return *this; a value that is refused shows in error() and makes the run fail.
class Options {
  public:
    Options() noexcept : handle_(delotet_options_new())
    {
        keep(delotet_options_set_progress(get(), &detail::Running::progress, nullptr));
        keep(delotet_options_set_log(get(), &detail::Running::log, nullptr));
        if (!handle_)
            status_ = DELOTET_STATUS_OUT_OF_MEMORY;
    }

    Options &mode(Mode mode) noexcept
    {
        return keep(delotet_options_set_mode(get(), static_cast<DelotetMode>(mode)));
    }
    Options &preserve(Preserve preserve) noexcept
    {
        return keep(delotet_options_set_preserve(get(), static_cast<DelotetPreserve>(preserve)));
    }
    Options &keep_hull(bool on) noexcept { return keep(delotet_options_set_keep_hull(get(), on)); }
    Options &merge_facets(double angle) noexcept { return keep(delotet_options_set_merge_facets(get(), angle)); }
    Options &validate(bool on) noexcept { return keep(delotet_options_set_validate(get(), on)); }
    Options &max_defects(std::size_t count) noexcept { return keep(delotet_options_set_max_defects(get(), count)); }
    Options &threads(std::size_t count) noexcept { return keep(delotet_options_set_threads(get(), count)); }
    Options &steiner_limit(std::uint64_t limit) noexcept
    {
        return keep(delotet_options_set_steiner_limit(get(), limit));
    }
    Options &exact_form(bool on) noexcept { return keep(delotet_options_set_exact_form(get(), on)); }
    Options &points_sorted(bool on) noexcept { return keep(delotet_options_set_points_sorted(get(), on)); }
    /// `progress` may throw: the run is cancelled, and the exception comes out of it.
    Options &on_progress(ProgressFunction progress) noexcept
    {
        progress_ = std::move(progress);
        return *this;
    }
    /// `log` may throw, as `progress` may.
    Options &on_log(LogFunction log) noexcept
    {
        log_ = std::move(log);
        return *this;
    }

    /// The status of the first setter that refused its value; DELOTET_STATUS_OK if none did.
    Status error() const noexcept { return status_; }
    const ProgressFunction &progress() const noexcept { return progress_; }
    const LogFunction &log() const noexcept { return log_; }
    DelotetOptions *get() const noexcept { return handle_.get(); }

  private:
    Options &keep(Status status) noexcept
    {
        if (status_ == DELOTET_STATUS_OK)
            status_ = status;
        return *this;
    }
    std::unique_ptr<DelotetOptions, detail::Free<DelotetOptions, delotet_options_free>> handle_;
    ProgressFunction progress_;
    LogFunction log_;
    Status status_ = DELOTET_STATUS_OK;
};

namespace detail {
/// Runs a call that takes options, with their callbacks in place.
template <class Call> Status run(const Options &options, Error &error, Call &&call)
{
    if (options.error() != DELOTET_STATUS_OK)
        return error.set(options.error(), nullptr, "an option has a value out of its range");
    Running running(options.progress(), options.log());
    const Status status = run(error, call);
    running.rethrow();
    return status;
}
} // namespace detail

/// The input. Move-only; empty (get() is NULL) by default.
class Plc {
  public:
    Plc() noexcept = default;
    explicit Plc(DelotetPlc *owned) noexcept : handle_(owned) {}

    static Status create(Span<const Point> points, Plc &plc, Error &error) noexcept
    {
        DelotetPlc *handle = nullptr;
        const double *xyz = points.empty() ? nullptr : points.data()->data();
        const Status status =
            detail::run(error, [&](DelotetError **e) { return delotet_plc_new(xyz, points.size(), &handle, e); });
        plc.handle_.reset(handle);
        return status;
    }
    /// `xyz`: x y z per point.
    static Status create(Span<const double> xyz, Plc &plc, Error &error) noexcept
    {
        if (xyz.size() % 3 != 0)
            return detail::mismatch(error);
        return create(detail::rows<Point>(xyz.data(), xyz.size() / 3), plc, error);
    }
    static Status read(const char *path, Plc &plc, Error &error) noexcept
    {
        DelotetPlc *handle = nullptr;
        const Status status =
            detail::run(error, [&](DelotetError **e) { return delotet_plc_read(path, &handle, e); });
        plc.handle_.reset(handle);
        return status;
    }
    /// `attributes`: #points rows of equal width.
    Status set_point_attributes(Span<const double> attributes, Error &error) noexcept
    {
        const std::size_t count = points().size(), width = count ? attributes.size() / count : 0;
        if (width * count != attributes.size())
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_set_point_attributes(get(), attributes.data(), width, e);
        });
    }
    Status set_point_markers(Span<const Marker> markers, Error &error) noexcept
    {
        if (!detail::fits(markers, points().size()))
            return detail::mismatch(error);
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_point_markers(get(), markers.data(), e); });
    }
    Status add_segment(Index a, Index b, Marker marker, Error &error) noexcept
    {
        return detail::run(error, [&](DelotetError **e) { return delotet_plc_add_segment(get(), a, b, marker, e); });
    }
    /// `ends`: two per segment. `markers`: none, or one per segment.
    Status add_segments(Span<const Index> ends, Span<const Marker> markers, Error &error) noexcept
    {
        const std::size_t count = ends.size() / 2;
        if (ends.size() % 2 != 0 || !detail::fits(markers, count))
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_segments(get(), ends.data(), markers.data(), count, e);
        });
    }
    /// `corners`: three per triangle. `markers`: none, or one per triangle.
    Status add_triangles(Span<const Index> corners, Span<const Marker> markers, Error &error) noexcept
    {
        const std::size_t count = corners.size() / 3;
        if (corners.size() % 3 != 0 || !detail::fits(markers, count))
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_triangles(get(), corners.data(), markers.data(), count, e);
        });
    }
    /// One facet per polygon; `ends` as for delotet_plc_add_polygons. `markers`: none, or one per polygon.
    Status add_polygons(Span<const Index> corners, Span<const std::size_t> ends, Span<const Marker> markers,
                        Error &error) noexcept
    {
        if (!fits(corners, ends) || !detail::fits(markers, ends.size()))
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_polygons(get(), corners.data(), ends.data(), markers.data(), ends.size(), e);
        });
    }
    /// One facet: an outer ring, and rings that are holes in it.
    Status add_facet(Span<const Index> corners, Span<const std::size_t> ring_ends, Marker marker, Error &error) noexcept
    {
        if (!fits(corners, ring_ends))
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_facet(get(), corners.data(), ring_ends.data(), ring_ends.size(), marker, e);
        });
    }
    /// One facet by TetGen's rule, with a seed in each hole.
    Status add_facet_with_hole_seeds(Span<const Index> corners, Span<const std::size_t> polygon_ends,
                                     Span<const Point> seeds, Marker marker, Error &error) noexcept
    {
        if (!fits(corners, polygon_ends))
            return detail::mismatch(error);
        const double *xyz = seeds.empty() ? nullptr : seeds.data()->data();
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_facet_with_hole_seeds(get(), corners.data(), polygon_ends.data(),
                                                         polygon_ends.size(), xyz, seeds.size(), marker, e);
        });
    }
    Status add_hole(const Point &seed, Error &error) noexcept
    {
        return detail::run(error, [&](DelotetError **e) { return delotet_plc_add_hole(get(), seed.data(), e); });
    }
    Status add_region(const Point &seed, double attribute, double max_volume, Error &error) noexcept
    {
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_region(get(), seed.data(), attribute, max_volume, e);
        });
    }
    /// Looks for defects.
    Status check(const Options &options, Error &error) const
    {
        return detail::run(options, error,
                           [&](DelotetError **e) { return delotet_plc_check(get(), options.get(), e); });
    }

#if DELOTET_EXCEPTIONS
    explicit Plc(Span<const Point> points)
    {
        detail::require([&](Error &e) { return create(points, *this, e); });
    }
    explicit Plc(Span<const double> xyz)
    {
        detail::require([&](Error &e) { return create(xyz, *this, e); });
    }
    static Plc read(const char *path)
    {
        Plc plc;
        detail::require([&](Error &e) { return read(path, plc, e); });
        return plc;
    }
    Plc &set_point_attributes(Span<const double> attributes)
    {
        return chain([&](Error &e) { return set_point_attributes(attributes, e); });
    }
    Plc &set_point_markers(Span<const Marker> markers)
    {
        return chain([&](Error &e) { return set_point_markers(markers, e); });
    }
    Plc &add_segment(Index a, Index b, Marker marker = 0)
    {
        return chain([&](Error &e) { return add_segment(a, b, marker, e); });
    }
    Plc &add_segments(Span<const Index> ends, Span<const Marker> markers = {})
    {
        return chain([&](Error &e) { return add_segments(ends, markers, e); });
    }
    Plc &add_triangles(Span<const Index> corners, Span<const Marker> markers = {})
    {
        return chain([&](Error &e) { return add_triangles(corners, markers, e); });
    }
    Plc &add_polygons(Span<const Index> corners, Span<const std::size_t> ends, Span<const Marker> markers = {})
    {
        return chain([&](Error &e) { return add_polygons(corners, ends, markers, e); });
    }
    Plc &add_facet(Span<const Index> corners, Span<const std::size_t> ring_ends, Marker marker = 0)
    {
        return chain([&](Error &e) { return add_facet(corners, ring_ends, marker, e); });
    }
    Plc &add_facet_with_hole_seeds(Span<const Index> corners, Span<const std::size_t> polygon_ends,
                                   Span<const Point> seeds, Marker marker = 0)
    {
        return chain([&](Error &e) { return add_facet_with_hole_seeds(corners, polygon_ends, seeds, marker, e); });
    }
    Plc &add_hole(const Point &seed)
    {
        return chain([&](Error &e) { return add_hole(seed, e); });
    }
    Plc &add_region(const Point &seed, double attribute, double max_volume = 0)
    {
        return chain([&](Error &e) { return add_region(seed, attribute, max_volume, e); });
    }
    void check(const Options &options = {}) const
    {
        detail::require([&](Error &e) { return check(options, e); });
    }
#endif

    Span<const Point> points() const noexcept
    {
        const DelotetPointsView view = delotet_plc_points(get());
        return detail::rows<Point>(view.data, view.count);
    }
    std::size_t segment_count() const noexcept { return delotet_plc_segment_count(get()); }
    std::size_t facet_count() const noexcept { return delotet_plc_facet_count(get()); }
    Marker facet_marker(Index facet) const noexcept { return delotet_plc_facet_marker(get(), facet); }
    DelotetPlc *get() const noexcept { return handle_.get(); }

  private:
    static bool fits(Span<const Index> corners, Span<const std::size_t> ends) noexcept
    {
        return (ends.empty() ? 0 : ends[ends.size() - 1]) == corners.size();
    }
#if DELOTET_EXCEPTIONS
    template <class Call> Plc &chain(Call &&call)
    {
        detail::require(call);
        return *this;
    }
#endif
    std::unique_ptr<DelotetPlc, detail::Free<DelotetPlc, delotet_plc_free>> handle_;
};

/// Second-order tetrahedra: mid-edge node i has the index #points + i.
struct SecondOrder {
    Span<const Point> nodes;
    Span<const Tet10> tets;
};

/// The result. Move-only and immutable; empty (get() is NULL) by default.
class Mesh {
  public:
    Mesh() noexcept = default;
    explicit Mesh(DelotetMesh *owned) noexcept : handle_(owned) {}

    Span<const Point> points() const noexcept { return points_of(delotet_mesh_points(get())); }
    std::size_t input_point_count() const noexcept { return delotet_mesh_input_point_count(get()); }
    Span<const Index> crowded_points() const noexcept { return span(delotet_mesh_crowded_points(get())); }
    Span<const Index> replaced_tets() const noexcept { return span(delotet_mesh_replaced_tets(get())); }
    Span<const Index> point_aliases() const noexcept { return span(delotet_mesh_point_aliases(get())); }
    /// #points by `width` doubles.
    DelotetDoublesView point_attributes() const noexcept { return delotet_mesh_point_attributes(get()); }
    Span<const Marker> point_markers() const noexcept { return span(delotet_mesh_point_markers(get())); }
    Span<const Tet> tets() const noexcept { return tets_of(delotet_mesh_tets(get())); }
    Span<const Tet> neighbors() const noexcept { return tets_of(delotet_mesh_neighbors(get())); }
    Span<const Index> tet_regions() const noexcept { return span(delotet_mesh_tet_regions(get())); }
    Span<const Region> regions() const noexcept { return span(delotet_mesh_regions(get())); }
    Span<const Subface> subfaces() const noexcept { return span(delotet_mesh_subfaces(get())); }
    Span<const Subsegment> subsegments() const noexcept { return span(delotet_mesh_subsegments(get())); }
    Span<const SteinerPoint> steiner_points() const noexcept { return span(delotet_mesh_steiner_points(get())); }
    Span<const SteinerTerm> steiner_terms() const noexcept { return span(delotet_mesh_steiner_terms(get())); }
    Span<const FacetFlip> facet_flips() const noexcept { return span(delotet_mesh_facet_flips(get())); }
    Stats stats() const noexcept
    {
        Stats stats = {};
        stats.struct_size = sizeof stats;
        if (delotet_mesh_stats(get(), &stats) != DELOTET_STATUS_OK)
            stats = {};
        return stats;
    }

    Status tet_attributes(Span<const double> &out, Error &error) const noexcept
    {
        DelotetDoublesView view = {};
        const Status status = detail::run(
            error, [&](DelotetError **e) { return delotet_mesh_tet_attributes(get(), &view, e); });
        out = {view.data, view.count};
        return status;
    }
    Status point_tets(Span<const Index> &out, Error &error) const noexcept
    {
        return derive<DelotetIndicesView>(delotet_mesh_point_tets, out, error);
    }
    Status faces(Span<const Face> &out, Error &error) const noexcept
    {
        return derive<DelotetFacesView>(delotet_mesh_faces, out, error);
    }
    Status edges(Span<const Edge> &out, Error &error) const noexcept
    {
        return derive<DelotetEdgesView>(delotet_mesh_edges, out, error);
    }
    Status tet_faces(Span<const Tet> &out, Error &error) const noexcept
    {
        return derive<DelotetTetsView>(delotet_mesh_tet_faces, out, error);
    }
    Status tet_edges(Span<const std::array<Index, 6>> &out, Error &error) const noexcept
    {
        return derive<DelotetIndexRowsView>(delotet_mesh_tet_edges, out, error);
    }
    Status subface_edges(Span<const std::array<Index, 3>> &out, Error &error) const noexcept
    {
        return derive<DelotetIndexRowsView>(delotet_mesh_subface_edges, out, error);
    }
    Status second_order(NodeOrder order, SecondOrder &out, Error &error) const noexcept
    {
        DelotetSecondOrderView view = {};
        const Status status = detail::run(error, [&](DelotetError **e) {
            return delotet_mesh_second_order(get(), static_cast<DelotetNodeOrder>(order), &view, e);
        });
        out = {detail::rows<Point>(view.nodes, view.node_count), detail::rows<Tet10>(view.tets, view.tet_count)};
        return status;
    }
    /// `tets`: one per point. `barycentric`: none, or one row per point.
    Status locate(Span<const Point> points, Span<Index> tets, Span<std::array<double, 4>> barycentric,
                  Error &error) const noexcept
    {
        if (tets.size() != points.size() || (!barycentric.empty() && barycentric.size() != points.size()))
            return detail::mismatch(error);
        const double *xyz = points.empty() ? nullptr : points.data()->data();
        double *weights = barycentric.empty() ? nullptr : barycentric.data()->data();
        return detail::run(error, [&](DelotetError **e) {
            return delotet_mesh_locate(get(), xyz, points.size(), tets.data(), weights, e);
        });
    }
    Status check(const Plc &plc, bool constrained_delaunay, std::size_t max_defects, Error &error) const noexcept
    {
        return detail::run(error, [&](DelotetError **e) {
            return delotet_mesh_check(get(), plc.get(), constrained_delaunay, max_defects, e);
        });
    }
    Status check_preserved(const Plc &plc, std::size_t max_defects, Error &error) const noexcept
    {
        return detail::run(error, [&](DelotetError **e) {
            return delotet_mesh_check_preserved(get(), plc.get(), max_defects, e);
        });
    }
    Status check_preserved_outer(const Plc &plc, std::size_t max_defects, Error &error) const noexcept
    {
        return detail::run(error, [&](DelotetError **e) {
            return delotet_mesh_check_preserved_outer(get(), plc.get(), max_defects, e);
        });
    }
    Status write(const Plc &plc, const char *path, Error &error) const noexcept
    {
        return detail::run(error,
                           [&](DelotetError **e) { return delotet_mesh_write(get(), plc.get(), path, e); });
    }

#if DELOTET_EXCEPTIONS
    Span<const double> tet_attributes() const
    {
        return made<Span<const double>>([&](auto &out, Error &e) { return tet_attributes(out, e); });
    }
    Span<const Index> point_tets() const
    {
        return made<Span<const Index>>([&](auto &out, Error &e) { return point_tets(out, e); });
    }
    Span<const Face> faces() const
    {
        return made<Span<const Face>>([&](auto &out, Error &e) { return faces(out, e); });
    }
    Span<const Edge> edges() const
    {
        return made<Span<const Edge>>([&](auto &out, Error &e) { return edges(out, e); });
    }
    Span<const Tet> tet_faces() const
    {
        return made<Span<const Tet>>([&](auto &out, Error &e) { return tet_faces(out, e); });
    }
    Span<const std::array<Index, 6>> tet_edges() const
    {
        return made<Span<const std::array<Index, 6>>>([&](auto &out, Error &e) { return tet_edges(out, e); });
    }
    Span<const std::array<Index, 3>> subface_edges() const
    {
        return made<Span<const std::array<Index, 3>>>([&](auto &out, Error &e) { return subface_edges(out, e); });
    }
    SecondOrder second_order(NodeOrder order) const
    {
        return made<SecondOrder>([&](auto &out, Error &e) { return second_order(order, out, e); });
    }
    void locate(Span<const Point> points, Span<Index> tets, Span<std::array<double, 4>> barycentric = {}) const
    {
        detail::require([&](Error &e) { return locate(points, tets, barycentric, e); });
    }
    void check(const Plc &plc, bool constrained_delaunay = true, std::size_t max_defects = 1000) const
    {
        detail::require([&](Error &e) { return check(plc, constrained_delaunay, max_defects, e); });
    }
    void check_preserved(const Plc &plc, std::size_t max_defects = 1000) const
    {
        detail::require([&](Error &e) { return check_preserved(plc, max_defects, e); });
    }
    void check_preserved_outer(const Plc &plc, std::size_t max_defects = 1000) const
    {
        detail::require([&](Error &e) { return check_preserved_outer(plc, max_defects, e); });
    }
    void write(const Plc &plc, const char *path) const
    {
        detail::require([&](Error &e) { return write(plc, path, e); });
    }
#endif

    DelotetMesh *get() const noexcept { return handle_.get(); }

  private:
    template <class View> static Span<std::remove_pointer_t<decltype(View::data)>> span(View view) noexcept
    {
        return {view.data, view.count};
    }
    static Span<const Point> points_of(DelotetPointsView view) noexcept
    {
        return detail::rows<Point>(view.data, view.count);
    }
    static Span<const Tet> tets_of(DelotetTetsView view) noexcept { return detail::rows<Tet>(view.data, view.count); }
    template <class View, class T>
    Status derive(DelotetStatus (*call)(const DelotetMesh *, View *, DelotetError **), Span<const T> &out,
                  Error &error) const noexcept
    {
        View view = {};
        const Status status = detail::run(error, [&](DelotetError **e) { return call(get(), &view, e); });
        out = detail::rows<T>(view.data, view.count);
        return status;
    }
#if DELOTET_EXCEPTIONS
    template <class Out, class Call> static Out made(Call &&call)
    {
        Out out;
        detail::require([&](Error &e) { return call(out, e); });
        return out;
    }
#endif
    std::unique_ptr<DelotetMesh, detail::Free<DelotetMesh, delotet_mesh_free>> handle_;
};

/// Makes the mesh of a PLC. What a callback of `options` throws comes out of this call.
inline Status tetrahedralize(const Plc &plc, const Options &options, Mesh &mesh, Error &error)
{
    DelotetMesh *handle = nullptr;
    struct Owner {
        DelotetMesh *&handle;
        ~Owner() { delotet_mesh_free(handle); }
    } owner{handle};
    const Status status = detail::run(options, error, [&](DelotetError **e) {
        return delotet_tetrahedralize(plc.get(), options.get(), &handle, e);
    });
    mesh = Mesh(std::exchange(handle, nullptr));
    return status;
}

#if DELOTET_EXCEPTIONS
inline Mesh tetrahedralize(const Plc &plc, const Options &options = {})
{
    Mesh mesh;
    detail::require([&](Error &e) { return tetrahedralize(plc, options, mesh, e); });
    return mesh;
}
#endif

} // namespace delotet
#endif
