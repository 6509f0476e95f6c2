/* delotet for C++17: owning handles, spans, exceptions that carry all defects, callbacks that may throw. MIT OR Apache-2.0.
 *
 * A thin layer over delotet.h, which documents shapes, ownership and threads; the names are the same. A setter and its getter share a name:
 * options.threads(4), options.threads().
 *
 * Every call that can fail has two forms:
 *   - the plain form throws delotet::Exception;
 *   - the form with an `Error &` as last argument returns the status and throws nothing of its own; it is the only form with
 *     -fno-exceptions. Results are written only on success.
 * Callbacks are std::functions and may throw: the run is then cancelled, and the call rethrows the exception. Views (Span, Records) point
 * into the object they come from and are valid as long as it is; taking a view of a temporary does not compile. The wrapper itself
 * allocates only for a std::function too large for its own buffer, for the exception object of a failure, and for indices of a type other
 * than uint32_t.
 *
 * Indices may be any integers, flat or in rows: std::vector<int>, std::vector<std::array<delotet::Index, 3>>, int[12][3]. Negative or too
 * large values are refused like any other index of no point. Paths are C strings, std::string or std::filesystem::path.
 */
#ifndef DELOTET_DELOTET_HPP
#define DELOTET_DELOTET_HPP

#if (defined(_MSVC_LANG) ? _MSVC_LANG : __cplusplus) < 201703L
#error "delotet.hpp needs C++17 (-std=c++17, /std:c++17 or CMAKE_CXX_STANDARD 17); delotet.h works with any C and C++"
#else

#include <delotet/delotet.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <new>
#include <string>
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
using Warning = DelotetWarning;
using WarningKind = DelotetWarningKind;
using Segment = DelotetSegment;
using RegionSeed = DelotetRegionSeed;
using Region = DelotetRegion;
using Subface = DelotetSubface;
using Subsegment = DelotetSubsegment;
using SteinerPoint = DelotetSteinerPoint;
using SteinerTerm = DelotetSteinerTerm;
using FacetFlip = DelotetFacetFlip;
using Face = DelotetFace;
using Edge = DelotetEdge;
using Stats = DelotetStats;
using TetQuality = DelotetTetQuality;
using ForcedTet = DelotetForcedTet;
using SkinnyTet = DelotetSkinnyTet;
using VoronoiEdge = DelotetVoronoiEdge;
using VoronoiFacet = DelotetVoronoiFacet;
using VoronoiCell = DelotetVoronoiCell;
using QualitySummary = DelotetQualitySummary;

using Index = std::uint32_t;
using Marker = std::int32_t;
using Point = std::array<double, 3>;
using Triangle = std::array<Index, 3>;
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

/// How the rings of a facet bound it.
enum class FacetRule : std::uint32_t { rings = DELOTET_FACET_RULE_RINGS, seeds = DELOTET_FACET_RULE_SEEDS };

enum class MshVersion : std::uint32_t { v4_1 = DELOTET_MSH_4_1, v2_2 = DELOTET_MSH_2_2 };

enum class NodeOrder : std::uint32_t {
    vtk = DELOTET_NODE_ORDER_VTK,
    gmsh = DELOTET_NODE_ORDER_GMSH,
    tetgen = DELOTET_NODE_ORDER_TETGEN
};

enum class QualityMeasure : std::uint32_t {
    min_dihedral = DELOTET_QUALITY_MIN_DIHEDRAL,
    max_dihedral = DELOTET_QUALITY_MAX_DIHEDRAL,
    radius_edge = DELOTET_QUALITY_RADIUS_EDGE,
    eta = DELOTET_QUALITY_ETA
};

/// Why a tetrahedron is above a radius-edge ratio; the first three are input-forced.
enum class SkinnyCause : std::uint32_t {
    wedge = DELOTET_SKINNY_WEDGE,
    corner = DELOTET_SKINNY_CORNER,
    face = DELOTET_SKINNY_FACE,
    beside = DELOTET_SKINNY_BESIDE,
    other = DELOTET_SKINNY_OTHER
};

/// Whether the loaded library has the ABI of this header: the same minor version before 1.0, the same major version after.
inline bool compatible() noexcept
{
    const std::uint32_t library = delotet_version();
    if (DELOTET_VERSION_MAJOR == 0)
        return library / 1000 == DELOTET_VERSION / 1000 && library >= DELOTET_VERSION;
    return library / 1000000 == DELOTET_VERSION_MAJOR && library >= DELOTET_VERSION;
}

/// A view of contiguous elements, not owned: made from a pointer and a count, from a C array, or from anything with data() and size().
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

/// A view of consecutive records, not owned. They are stride() bytes apart, which is more than sizeof(T) if the loaded library has fields
/// that this header does not know.
template <class T> class Records {
  public:
    class iterator {
      public:
        using iterator_category = std::random_access_iterator_tag;
        using value_type = std::remove_cv_t<T>;
        using difference_type = std::ptrdiff_t;
        using pointer = const T *;
        using reference = const T &;

        iterator() noexcept = default;
        iterator(const unsigned char *at, std::size_t stride) noexcept
            : at_(at), stride_(static_cast<std::ptrdiff_t>(stride))
        {
        }
        reference operator*() const noexcept { return *operator->(); }
        pointer operator->() const noexcept { return reinterpret_cast<const T *>(at_); }
        reference operator[](difference_type i) const noexcept { return *(*this + i); }
        iterator &operator+=(difference_type n) noexcept
        {
            at_ += n * stride_;
            return *this;
        }
        iterator &operator-=(difference_type n) noexcept { return *this += -n; }
        iterator &operator++() noexcept { return *this += 1; }
        iterator &operator--() noexcept { return *this -= 1; }
        iterator operator++(int) noexcept
        {
            const iterator before = *this;
            ++*this;
            return before;
        }
        iterator operator--(int) noexcept
        {
            const iterator before = *this;
            --*this;
            return before;
        }
        friend iterator operator+(iterator a, difference_type n) noexcept { return a += n; }
        friend iterator operator+(difference_type n, iterator a) noexcept { return a += n; }
        friend iterator operator-(iterator a, difference_type n) noexcept { return a -= n; }
        friend difference_type operator-(iterator a, iterator b) noexcept
        {
            return a.stride_ == 0 ? 0 : (a.at_ - b.at_) / a.stride_;
        }
        friend bool operator==(iterator a, iterator b) noexcept { return a.at_ == b.at_; }
        friend bool operator!=(iterator a, iterator b) noexcept { return a.at_ != b.at_; }
        friend bool operator<(iterator a, iterator b) noexcept { return a.at_ < b.at_; }
        friend bool operator>(iterator a, iterator b) noexcept { return a.at_ > b.at_; }
        friend bool operator<=(iterator a, iterator b) noexcept { return a.at_ <= b.at_; }
        friend bool operator>=(iterator a, iterator b) noexcept { return a.at_ >= b.at_; }

      private:
        const unsigned char *at_ = nullptr;
        std::ptrdiff_t stride_ = 0;
    };
    using const_iterator = iterator;
    using value_type = std::remove_cv_t<T>;

    Records() noexcept = default;
    Records(const T *first, std::size_t size, std::size_t stride) noexcept
        : first_(reinterpret_cast<const unsigned char *>(first)), size_(size), stride_(stride)
    {
    }

    std::size_t size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }
    /// Bytes from one record to the next.
    std::size_t stride() const noexcept { return stride_; }
    const T &operator[](std::size_t i) const noexcept { return *reinterpret_cast<const T *>(first_ + i * stride_); }
    iterator begin() const noexcept { return {first_, stride_}; }
    iterator end() const noexcept { return {size_ == 0 ? first_ : first_ + size_ * stride_, stride_}; }

  private:
    const unsigned char *first_ = nullptr;
    std::size_t size_ = 0, stride_ = sizeof(T);
};

/// A text or path argument: made from a C string, std::string or std::filesystem::path. Borrows it.
class Text {
  public:
    Text(const char *text) noexcept : text_(text) {}
    template <class String,
              std::enable_if_t<std::is_same_v<decltype(std::declval<const String &>().c_str()), const char *>, int> = 0>
    Text(const String &text) noexcept : text_(text.c_str())
    {
    }
    /// std::filesystem::path on Windows, where its characters are wide: converted to UTF-8 for the library.
    template <class String,
              std::enable_if_t<std::is_same_v<decltype(std::declval<const String &>().c_str()), const wchar_t *>, int> = 0,
              class Narrow = decltype(std::declval<const String &>().u8string())>
    Text(const String &text)
    {
        const Narrow narrow = text.u8string();
        owned_.assign(narrow.begin(), narrow.end());
        text_ = owned_.c_str();
    }
    Text(const Text &) = delete;
    Text &operator=(const Text &) = delete;
    const char *c_str() const noexcept { return text_; }

  private:
    const char *text_ = nullptr;
    std::string owned_;
};
using Path = Text;

namespace detail {

/// A row of integers: how many, and of which type. A single integer is a row of one.
template <class T> struct Row {
    static constexpr bool fits = std::is_integral_v<T> && !std::is_same_v<T, bool>;
    static constexpr std::size_t width = 1;
    using Integer = T;
};
template <class T, std::size_t N> struct Row<std::array<T, N>> {
    static constexpr bool fits = Row<T>::fits && sizeof(std::array<T, N>) == N * sizeof(T);
    static constexpr std::size_t width = N;
    using Integer = T;
};
template <class T, std::size_t N> struct Row<T[N]> {
    static constexpr bool fits = Row<T>::fits;
    static constexpr std::size_t width = N;
    using Integer = T;
};

} // namespace detail

/// An argument of integers in the library's type: made from arrays and containers with data() and size() of any integers, flat or (for
/// `Width` > 1) in rows of `Width`. Other types are converted; a value that `To` cannot hold becomes its largest value, which is no valid
/// index. Borrows what needs no conversion.
template <class To, std::size_t Width> class Integers {
    template <class T>
    static constexpr bool accepts =
        detail::Row<std::remove_cv_t<T>>::fits &&
        (detail::Row<std::remove_cv_t<T>>::width == 1 || detail::Row<std::remove_cv_t<T>>::width == Width);

  public:
    Integers() noexcept = default;
    template <class T, std::size_t N, std::enable_if_t<accepts<T>, int> = 0>
    Integers(const T (&array)[N]) noexcept
    {
        take(&array[0], N);
    }
    template <class C, class T = std::remove_pointer_t<decltype(std::declval<const C &>().data())>,
              std::enable_if_t<accepts<T>, int> = 0, class = decltype(std::declval<const C &>().size())>
    Integers(const C &container) noexcept
    {
        take(container.data(), container.size());
    }
    Integers(const Integers &) = delete;
    Integers &operator=(const Integers &) = delete;

    const To *data() const noexcept { return data_; }
    std::size_t size() const noexcept { return size_; }
    /// True if there was no memory for the conversion.
    bool failed() const noexcept { return failed_; }

  private:
    template <class T> void take(const T *rows, std::size_t count) noexcept
    {
        using From = typename detail::Row<std::remove_cv_t<T>>::Integer;
        size_ = count * detail::Row<std::remove_cv_t<T>>::width;
        const From *from = reinterpret_cast<const From *>(rows);
        if constexpr (std::is_same_v<std::make_unsigned_t<From>, To>) {
            // The same type except for the sign: used as it is, unless a value is negative.
            bool as_it_is = true;
            if constexpr (std::is_signed_v<From>)
                for (std::size_t i = 0; i < size_; i++)
                    as_it_is = as_it_is && from[i] >= 0;
            if (as_it_is) {
                data_ = reinterpret_cast<const To *>(from);
                return;
            }
        }
        converted_.reset(new (std::nothrow) To[size_ + 1]);
        data_ = converted_.get();
        failed_ = data_ == nullptr;
        for (std::size_t i = 0; i < size_ && !failed_; i++)
            converted_[i] = in_range(from[i]) ? static_cast<To>(from[i]) : std::numeric_limits<To>::max();
    }
    template <class From> static bool in_range(From value) noexcept
    {
        if constexpr (std::is_signed_v<From>)
            if (value < 0)
                return false;
        return static_cast<std::make_unsigned_t<From>>(value) <= std::numeric_limits<To>::max();
    }

    const To *data_ = nullptr;
    std::size_t size_ = 0;
    bool failed_ = false;
    std::unique_ptr<To[]> converted_;
};

/// Point indices in rows of `Width` (triangles: 3, segments: 2), or flat.
template <std::size_t Width = 1> using Indices = Integers<Index, Width>;
/// The ends of polygons in a list of corners.
using Ends = Integers<std::size_t, 1>;

/// A failure with all its defects; empty on success.
class Error {
  public:
    Error() noexcept = default;

    Status status() const noexcept { return handle_ ? delotet_error_status(handle_.get()) : status_; }
    const char *message() const & noexcept { return handle_ ? delotet_error_message(handle_.get()) : text_; }
    void message() const && = delete;
    /// The elements at fault, at most Options::max_defects of them; defect_count() counts all.
    Records<Defect> defects() const & noexcept
    {
        const DelotetDefectsView view = delotet_error_defects(handle_.get());
        return {view.first, view.count, view.stride};
    }
    void defects() const && = delete;
    std::size_t defect_count() const noexcept { return delotet_error_defect_count(handle_.get()); }
    explicit operator bool() const noexcept { return status() != DELOTET_STATUS_OK; }

    /// For the wrapper: takes ownership of the error that a call reported.
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
    Records<Defect> defects() const & noexcept
    {
        const DelotetDefectsView view = delotet_error_defects(handle_.get());
        return {view.first, view.count, view.stride};
    }
    void defects() const && = delete;
    std::size_t defect_count() const noexcept { return delotet_error_defect_count(handle_.get()); }

  private:
    Status status_;
    const char *text_;
    std::shared_ptr<DelotetError> handle_;
};
#endif

/// The fraction of the whole run that is done when `fraction` of `phase` is done, from 0 to 1.
inline double overall(Phase phase, double fraction) noexcept
{
    return delotet_phase_overall(static_cast<std::uint32_t>(phase), fraction);
}

/// The bounds of the bins of a measure's histogram: DELOTET_QUALITY_BINS + 1 numbers, static.
inline Span<const double> quality_bin_edges(QualityMeasure measure) noexcept
{
    const DelotetDoublesView view = delotet_quality_bin_edges(static_cast<DelotetQualityMeasure>(measure));
    return {view.data, view.count};
}

/// Receives progress: `fraction` of `phase` is done; `overall` combines both into one number. Return false to cancel.
using ProgressFunction = std::function<bool(Phase phase, double fraction)>;
/// Receives a line of text.
using LogFunction = std::function<void(const char *message)>;
/// Gives the edge length wanted at a point: positive, infinite for no wish. The same point must always get the same length.
using SizeFunction = std::function<double(const Point &point)>;

namespace detail {

template <class T, void (*free_function)(T *)> struct Free {
    void operator()(T *handle) const noexcept { free_function(handle); }
};

/// Runs a C call whose last argument is a `DelotetError **` and stores its report in `error`.
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

inline Status out_of_memory(Error &error) noexcept
{
    return error.set(DELOTET_STATUS_OUT_OF_MEMORY, nullptr, "no memory for options or converted indices");
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

/// C views as spans and records.
template <class View> Span<std::remove_pointer_t<decltype(View::data)>> span(View view) noexcept
{
    return {view.data, view.count};
}
template <class View>
Records<std::remove_cv_t<std::remove_pointer_t<decltype(View::first)>>> records(View view) noexcept
{
    return {view.first, view.count, view.stride};
}
inline Span<const Point> points_of(DelotetPointsView view) noexcept
{
    return rows<Point>(view.data, view.count);
}

#if DELOTET_EXCEPTIONS
/// Turns the form with an `Error &` into the throwing form.
template <class Call> void require(Call &&call)
{
    Error error;
    if (call(error) != DELOTET_STATUS_OK)
        throw Exception(std::move(error));
}
#endif

/// The callbacks of the call that this thread is in. Callbacks run on the calling thread, so no allocation or lock is needed, and several
/// threads may use the same options at the same time.
class Running {
  public:
    Running(const ProgressFunction &progress, const LogFunction &log, const SizeFunction *size) noexcept
        : progress_(progress), log_(log), size_(size), outer_(current())
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
    static std::int32_t size(void *, const double *point, double *size) noexcept
    {
        Running *self = current();
        if (!self || !self->size_ || !*self->size_)
            return 0; // No wish.
        self->guarded([&] { *size = (*self->size_)(Point{point[0], point[1], point[2]}); });
        return self->failed();
    }
    /// Rethrows what a callback threw.
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
    /// No exception may pass through the library: it is kept here until the call returns.
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
    const SizeFunction *size_;
    Running *outer_;
#if DELOTET_EXCEPTIONS
    std::exception_ptr thrown_;
#endif
};

} // namespace detail

/// Cancels runs from any thread: const methods may be called at any time. Move-only; options that have it keep its state alive.
class CancelToken {
  public:
    CancelToken() noexcept : handle_(delotet_cancel_token_new()) {}

    /// All runs that use the token fail with DELOTET_STATUS_CANCELLED within a fraction of a second.
    void cancel() const noexcept { delotet_cancel_token_cancel(get()); }
    bool is_cancelled() const noexcept { return delotet_cancel_token_is_cancelled(get()); }
    /// Makes the token usable again.
    void reset() const noexcept { delotet_cancel_token_reset(get()); }
    /// NULL if memory ran out when the token was created, and after a move.
    DelotetCancelToken *get() const noexcept { return handle_.get(); }

  private:
    std::unique_ptr<DelotetCancelToken, detail::Free<DelotetCancelToken, delotet_cancel_token_free>> handle_;
};

class Mesh;

/// Settings of a run. The throwing setters return *this for chaining; a refused value leaves the setting unchanged.
class Options {
  public:
    Options() noexcept : handle_(delotet_options_new())
    {
        Error error; // Fails only without a handle, which every use reports.
        change(error, [&](auto e) { return delotet_options_set_progress(get(), &detail::Running::progress, nullptr, e); });
        change(error, [&](auto e) { return delotet_options_set_log(get(), &detail::Running::log, nullptr, e); });
    }

    Status mode(Mode mode, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_mode(get(), static_cast<DelotetMode>(mode), e); });
    }
    Mode mode() const noexcept { return static_cast<Mode>(delotet_options_mode(get())); }
    Status preserve(Preserve preserve, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_preserve(get(), static_cast<DelotetPreserve>(preserve), e); });
    }
    Preserve preserve() const noexcept { return static_cast<Preserve>(delotet_options_preserve(get())); }
    Status keep_hull(bool on, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_keep_hull(get(), on, e); });
    }
    bool keep_hull() const noexcept { return delotet_options_keep_hull(get()); }
    Status merge_facets(double angle, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_merge_facets(get(), angle, e); });
    }
    double merge_facets() const noexcept { return delotet_options_merge_facets(get()); }
    Status validate(bool on, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_validate(get(), on, e); });
    }
    bool validate() const noexcept { return delotet_options_validate(get()); }
    Status max_defects(std::size_t count, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_max_defects(get(), count, e); });
    }
    std::size_t max_defects() const noexcept { return delotet_options_max_defects(get()); }
    Status threads(std::size_t count, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_threads(get(), count, e); });
    }
    std::size_t threads() const noexcept { return delotet_options_threads(get()); }
    Status steiner_limit(std::uint64_t limit, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_steiner_limit(get(), limit, e); });
    }
    std::uint64_t steiner_limit() const noexcept { return delotet_options_steiner_limit(get()); }
    /// `limit`: UINT64_MAX for none.
    Status tetrahedra_limit(std::uint64_t limit, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_tetrahedra_limit(get(), limit, e); });
    }
    std::uint64_t tetrahedra_limit() const noexcept { return delotet_options_tetrahedra_limit(get()); }
    /// `seconds`: 0 for no limit.
    Status time_limit(double seconds, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_time_limit(get(), seconds, e); });
    }
    double time_limit() const noexcept { return delotet_options_time_limit(get()); }
    /// `bytes`: 0 for no limit.
    Status memory_limit(std::uint64_t bytes, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_memory_limit(get(), bytes, e); });
    }
    std::uint64_t memory_limit() const noexcept { return delotet_options_memory_limit(get()); }
    Status cancel_token(const CancelToken &token, Error &error) noexcept
    {
        return token.get() ? change(error,
                                    [&](DelotetError **e) {
                                        return delotet_options_set_cancel_token(get(), token.get(), e);
                                    })
                           : detail::out_of_memory(error);
    }
    /// NULL if there is none.
    const DelotetCancelToken *cancel_token() const noexcept { return delotet_options_cancel_token(get()); }
    Status exact_form(bool on, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_exact_form(get(), on, e); });
    }
    bool exact_form() const noexcept { return delotet_options_exact_form(get()); }
    Status drop_unmeshed_points(bool on, Error &error) noexcept
    {
        return change(error,
                      [&](DelotetError **e) { return delotet_options_set_drop_unmeshed_points(get(), on, e); });
    }
    bool drop_unmeshed_points() const noexcept { return delotet_options_drop_unmeshed_points(get()); }
    Status points_sorted(bool on, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_points_sorted(get(), on, e); });
    }
    bool points_sorted() const noexcept { return delotet_options_points_sorted(get()); }
    /// `length`: 0 for none.
    Status size(double length, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_size(get(), length, e); });
    }
    double size() const noexcept { return delotet_options_size(get()); }
    /// `volume`: 0 for no bound.
    Status max_volume(double volume, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_max_volume(get(), volume, e); });
    }
    double max_volume() const noexcept { return delotet_options_max_volume(get()); }
    Status gradation(double slope, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_gradation(get(), slope, e); });
    }
    double gradation() const noexcept { return delotet_options_gradation(get()); }
    /// `ratio`: at least 1, or 0 for no bound.
    Status quality(double ratio, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_quality(get(), ratio, e); });
    }
    double quality() const noexcept { return delotet_options_quality(get()); }
    /// `effort`: 0 for none.
    Status optimize(std::uint32_t effort, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_optimize(get(), effort, e); });
    }
    std::uint32_t optimize() const noexcept { return delotet_options_optimize(get()); }
    /// `seconds`: 0 for none: the effort counts.
    Status optimize_seconds(double seconds, Error &error) noexcept
    {
        return change(
            error, [&](DelotetError **e) { return delotet_options_set_optimize_seconds(get(), seconds, e); });
    }
    double optimize_seconds() const noexcept { return delotet_options_optimize_seconds(get()); }
    /// The edge length wanted inside of `mesh`: linear between the sizes at its points, one each. The mesh is copied as far as needed.
    Status background(const Mesh &mesh, Span<const double> sizes, Error &error) noexcept;
    Status no_background(Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_background(get(), nullptr, nullptr, 0, e); });
    }
    /// The sizes at the points of the background mesh, empty without one.
    Span<const double> background() const & noexcept
    {
        const DelotetDoublesView view = delotet_options_background(get());
        return {view.data, view.count};
    }
    void background() const && = delete;
    /// `degrees`: at most 60, or 0 for none.
    Status min_angle(double degrees, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_options_set_min_angle(get(), degrees, e); });
    }
    double min_angle() const noexcept { return delotet_options_min_angle(get()); }
    /// The function is asked on the thread that makes the mesh; nullptr removes it.
    Status size_function(SizeFunction size, Error &error) noexcept
    {
        const DelotetSizeFunction call = size ? &detail::Running::size : nullptr;
        const Status status =
            change(error, [&](DelotetError **e) { return delotet_options_set_size_function(get(), call, nullptr, e); });
        if (status == DELOTET_STATUS_OK)
            size_ = std::move(size);
        return status;
    }

#if DELOTET_EXCEPTIONS
    Options &mode(Mode value) &
    {
        return chain([&](Error &e) { return mode(value, e); });
    }
    Options &&mode(Mode value) && { return std::move(mode(value)); }
    Options &preserve(Preserve what) &
    {
        return chain([&](Error &e) { return preserve(what, e); });
    }
    Options &&preserve(Preserve what) && { return std::move(preserve(what)); }
    Options &keep_hull(bool on) &
    {
        return chain([&](Error &e) { return keep_hull(on, e); });
    }
    Options &&keep_hull(bool on) && { return std::move(keep_hull(on)); }
    Options &merge_facets(double angle) &
    {
        return chain([&](Error &e) { return merge_facets(angle, e); });
    }
    Options &&merge_facets(double angle) && { return std::move(merge_facets(angle)); }
    Options &validate(bool on) &
    {
        return chain([&](Error &e) { return validate(on, e); });
    }
    Options &&validate(bool on) && { return std::move(validate(on)); }
    Options &max_defects(std::size_t count) &
    {
        return chain([&](Error &e) { return max_defects(count, e); });
    }
    Options &&max_defects(std::size_t count) && { return std::move(max_defects(count)); }
    Options &threads(std::size_t count) &
    {
        return chain([&](Error &e) { return threads(count, e); });
    }
    Options &&threads(std::size_t count) && { return std::move(threads(count)); }
    Options &steiner_limit(std::uint64_t limit) &
    {
        return chain([&](Error &e) { return steiner_limit(limit, e); });
    }
    Options &&steiner_limit(std::uint64_t limit) && { return std::move(steiner_limit(limit)); }
    Options &tetrahedra_limit(std::uint64_t limit) &
    {
        return chain([&](Error &e) { return tetrahedra_limit(limit, e); });
    }
    Options &&tetrahedra_limit(std::uint64_t limit) && { return std::move(tetrahedra_limit(limit)); }
    Options &time_limit(double seconds) &
    {
        return chain([&](Error &e) { return time_limit(seconds, e); });
    }
    Options &&time_limit(double seconds) && { return std::move(time_limit(seconds)); }
    Options &memory_limit(std::uint64_t bytes) &
    {
        return chain([&](Error &e) { return memory_limit(bytes, e); });
    }
    Options &&memory_limit(std::uint64_t bytes) && { return std::move(memory_limit(bytes)); }
    Options &cancel_token(const CancelToken &token) &
    {
        return chain([&](Error &e) { return cancel_token(token, e); });
    }
    Options &&cancel_token(const CancelToken &token) && { return std::move(cancel_token(token)); }
    Options &exact_form(bool on) &
    {
        return chain([&](Error &e) { return exact_form(on, e); });
    }
    Options &&exact_form(bool on) && { return std::move(exact_form(on)); }
    Options &drop_unmeshed_points(bool on) &
    {
        return chain([&](Error &e) { return drop_unmeshed_points(on, e); });
    }
    Options &&drop_unmeshed_points(bool on) && { return std::move(drop_unmeshed_points(on)); }
    Options &points_sorted(bool on) &
    {
        return chain([&](Error &e) { return points_sorted(on, e); });
    }
    Options &&points_sorted(bool on) && { return std::move(points_sorted(on)); }
    Options &size(double length) &
    {
        return chain([&](Error &e) { return size(length, e); });
    }
    Options &&size(double length) && { return std::move(size(length)); }
    Options &max_volume(double volume) &
    {
        return chain([&](Error &e) { return max_volume(volume, e); });
    }
    Options &&max_volume(double volume) && { return std::move(max_volume(volume)); }
    Options &gradation(double slope) &
    {
        return chain([&](Error &e) { return gradation(slope, e); });
    }
    Options &&gradation(double slope) && { return std::move(gradation(slope)); }
    Options &quality(double ratio) &
    {
        return chain([&](Error &e) { return quality(ratio, e); });
    }
    Options &&quality(double ratio) && { return std::move(quality(ratio)); }
    Options &optimize(std::uint32_t effort) &
    {
        return chain([&](Error &e) { return optimize(effort, e); });
    }
    Options &&optimize(std::uint32_t effort) && { return std::move(optimize(effort)); }
    Options &optimize_seconds(double seconds) &
    {
        return chain([&](Error &e) { return optimize_seconds(seconds, e); });
    }
    Options &&optimize_seconds(double seconds) && { return std::move(optimize_seconds(seconds)); }
    Options &background(const Mesh &mesh, Span<const double> sizes) &
    {
        return chain([&](Error &e) { return background(mesh, sizes, e); });
    }
    Options &&background(const Mesh &mesh, Span<const double> sizes) && { return std::move(background(mesh, sizes)); }
    Options &no_background() &
    {
        return chain([&](Error &e) { return no_background(e); });
    }
    Options &&no_background() && { return std::move(no_background()); }
    Options &min_angle(double degrees) &
    {
        return chain([&](Error &e) { return min_angle(degrees, e); });
    }
    Options &&min_angle(double degrees) && { return std::move(min_angle(degrees)); }
    /// `size` may throw: the run is then cancelled and rethrows the exception.
    Options &size_function(SizeFunction size) &
    {
        return chain([&](Error &e) { return size_function(std::move(size), e); });
    }
    Options &&size_function(SizeFunction size) && { return std::move(size_function(std::move(size))); }
#endif
    /// `progress` may throw: the run is then cancelled and rethrows the exception.
    Options &on_progress(ProgressFunction progress) & noexcept
    {
        progress_ = std::move(progress);
        return *this;
    }
    Options &&on_progress(ProgressFunction progress) && noexcept { return std::move(on_progress(std::move(progress))); }
    /// `log` may throw, like `progress`.
    Options &on_log(LogFunction log) & noexcept
    {
        log_ = std::move(log);
        return *this;
    }
    Options &&on_log(LogFunction log) && noexcept { return std::move(on_log(std::move(log))); }

    const ProgressFunction &progress() const & noexcept { return progress_; }
    void progress() const && = delete;
    const LogFunction &log() const & noexcept { return log_; }
    void log() const && = delete;
    const SizeFunction &size_function() const & noexcept { return size_; }
    void size_function() const && = delete;
    /// NULL if memory ran out when the options were created, and after a move.
    DelotetOptions *get() const noexcept { return handle_.get(); }

  private:
    template <class Call> Status change(Error &error, Call &&call) noexcept
    {
        return handle_ ? detail::run(error, call) : detail::out_of_memory(error);
    }
#if DELOTET_EXCEPTIONS
    template <class Call> Options &chain(Call &&call)
    {
        detail::require(call);
        return *this;
    }
#endif
    std::unique_ptr<DelotetOptions, detail::Free<DelotetOptions, delotet_options_free>> handle_;
    ProgressFunction progress_;
    LogFunction log_;
    SizeFunction size_;
};

/// How a mesh or a PLC is written. Setters throw or take an Error, like those of Options.
class WriteOptions {
  public:
    WriteOptions() noexcept : handle_(delotet_write_options_new())
    {
        Error error; // Fails only without a handle, which every use reports.
        change(error, [&](auto e) { return delotet_write_options_set_log(get(), &detail::Running::log, nullptr, e); });
    }

    Status compress(bool on, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_write_options_set_compress(get(), on, e); });
    }
    bool compress() const noexcept { return delotet_write_options_compress(get()); }
    Status subfaces(bool on, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_write_options_set_subfaces(get(), on, e); });
    }
    bool subfaces() const noexcept { return delotet_write_options_subfaces(get()); }
    Status quality_data(bool on, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_write_options_set_quality_data(get(), on, e); });
    }
    bool quality_data() const noexcept { return delotet_write_options_quality_data(get()); }
    Status second_order(bool on, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) { return delotet_write_options_set_second_order(get(), on, e); });
    }
    bool second_order() const noexcept { return delotet_write_options_second_order(get()); }
    Status msh_version(MshVersion version, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) {
            return delotet_write_options_set_msh_version(get(), static_cast<DelotetMshVersion>(version), e);
        });
    }
    MshVersion msh_version() const noexcept { return static_cast<MshVersion>(delotet_write_options_msh_version(get())); }
    /// `seconds`: 0 for no limit.
    Status time_limit(double seconds, Error &error) noexcept
    {
        return change(error,
                      [&](DelotetError **e) { return delotet_write_options_set_time_limit(get(), seconds, e); });
    }
    double time_limit() const noexcept { return delotet_write_options_time_limit(get()); }
    Status cancel_token(const CancelToken &token, Error &error) noexcept
    {
        return token.get() ? change(error,
                                    [&](DelotetError **e) {
                                        return delotet_write_options_set_cancel_token(get(), token.get(), e);
                                    })
                           : detail::out_of_memory(error);
    }
    /// NULL if there is none.
    const DelotetCancelToken *cancel_token() const noexcept { return delotet_write_options_cancel_token(get()); }
    /// Names the regions with an attribute; an empty name removes theirs.
    Status region_name(double attribute, const Text &name, Error &error) noexcept
    {
        return change(error,
                      [&](DelotetError **e) { return delotet_write_options_set_region_name(get(), attribute, name.c_str(), e); });
    }
    /// NULL if they have no name. Valid until the options change.
    const char *region_name(double attribute) const & noexcept { return delotet_write_options_region_name(get(), attribute); }
    void region_name(double) const && = delete;

#if DELOTET_EXCEPTIONS
    WriteOptions &compress(bool on) &
    {
        return chain([&](Error &e) { return compress(on, e); });
    }
    WriteOptions &&compress(bool on) && { return std::move(compress(on)); }
    WriteOptions &subfaces(bool on) &
    {
        return chain([&](Error &e) { return subfaces(on, e); });
    }
    WriteOptions &&subfaces(bool on) && { return std::move(subfaces(on)); }
    WriteOptions &quality_data(bool on) &
    {
        return chain([&](Error &e) { return quality_data(on, e); });
    }
    WriteOptions &&quality_data(bool on) && { return std::move(quality_data(on)); }
    WriteOptions &second_order(bool on) &
    {
        return chain([&](Error &e) { return second_order(on, e); });
    }
    WriteOptions &&second_order(bool on) && { return std::move(second_order(on)); }
    WriteOptions &msh_version(MshVersion version) &
    {
        return chain([&](Error &e) { return msh_version(version, e); });
    }
    WriteOptions &&msh_version(MshVersion version) && { return std::move(msh_version(version)); }
    WriteOptions &time_limit(double seconds) &
    {
        return chain([&](Error &e) { return time_limit(seconds, e); });
    }
    WriteOptions &&time_limit(double seconds) && { return std::move(time_limit(seconds)); }
    WriteOptions &cancel_token(const CancelToken &token) &
    {
        return chain([&](Error &e) { return cancel_token(token, e); });
    }
    WriteOptions &&cancel_token(const CancelToken &token) && { return std::move(cancel_token(token)); }
    WriteOptions &region_name(double attribute, const Text &name) &
    {
        return chain([&](Error &e) { return region_name(attribute, name, e); });
    }
    WriteOptions &&region_name(double attribute, const Text &name) && { return std::move(region_name(attribute, name)); }
#endif
    /// Receives lines about what a format cannot hold. `log` may throw: the call rethrows the exception, and the file exists.
    WriteOptions &on_log(LogFunction log) & noexcept
    {
        log_ = std::move(log);
        return *this;
    }
    WriteOptions &&on_log(LogFunction log) && noexcept { return std::move(on_log(std::move(log))); }

    /// Writing reports no progress.
    const ProgressFunction &progress() const & noexcept { return progress_; }
    void progress() const && = delete;
    const LogFunction &log() const & noexcept { return log_; }
    void log() const && = delete;
    /// NULL if memory ran out when the options were created, and after a move.
    DelotetWriteOptions *get() const noexcept { return handle_.get(); }

  private:
    template <class Call> Status change(Error &error, Call &&call) noexcept
    {
        return handle_ ? detail::run(error, call) : detail::out_of_memory(error);
    }
#if DELOTET_EXCEPTIONS
    template <class Call> WriteOptions &chain(Call &&call)
    {
        detail::require(call);
        return *this;
    }
#endif
    std::unique_ptr<DelotetWriteOptions, detail::Free<DelotetWriteOptions, delotet_write_options_free>> handle_;
    ProgressFunction progress_;
    LogFunction log_;
};

namespace detail {
/// Runs a call that takes options, with their callbacks installed.
template <class Settings, class Call> Status run(const Settings &options, Error &error, Call &&call)
{
    if (!options.get())
        return detail::out_of_memory(error);
    const SizeFunction *size = nullptr;
    if constexpr (std::is_same_v<Settings, Options>)
        size = &options.size_function();
    Running running(options.progress(), options.log(), size);
    const Status status = run(error, call);
    running.rethrow();
    return status;
}
} // namespace detail

/// The input. Move-only; empty (get() is NULL) by default. The throwing forms return *this: Plc plc = Plc(points).add_triangles(corners).
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
    static Status read(const Path &path, Plc &plc, Error &error) noexcept
    {
        DelotetPlc *handle = nullptr;
        const Status status =
            detail::run(error, [&](DelotetError **e) { return delotet_plc_read(path.c_str(), &handle, e); });
        plc.handle_.reset(handle);
        return status;
    }
    /// Under the limits of `options`, of which the others have no effect.
    static Status read(const Path &path, const Options &options, Plc &plc, Error &error)
    {
        DelotetPlc *handle = nullptr;
        const Status status = detail::run(options, error, [&](DelotetError **e) {
            return delotet_plc_read_with(path.c_str(), options.get(), &handle, e);
        });
        plc.handle_.reset(handle);
        return status;
    }
    /// A copy with everything in it.
    Status clone(Plc &copy, Error &error) const noexcept
    {
        DelotetPlc *handle = nullptr;
        const Status status =
            detail::run(error, [&](DelotetError **e) { return delotet_plc_clone(get(), &handle, e); });
        copy.handle_.reset(handle);
        return status;
    }
    /// Appends points; `first` receives the index of the first new one.
    Status add_points(Span<const Point> points, Index &first, Error &error) noexcept
    {
        const double *xyz = points.empty() ? nullptr : points.data()->data();
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_add_points(get(), xyz, points.size(), &first, e); });
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
    /// The weights of the points: one each, or none. Counted by Mode::delaunay.
    Status set_point_weights(Span<const double> weights, Error &error) noexcept
    {
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_set_point_weights(get(), weights.data(), weights.size(), e);
        });
    }
    /// The heights of the lifted points, instead of weights: one each, or none.
    Status set_point_heights(Span<const double> heights, Error &error) noexcept
    {
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_set_point_heights(get(), heights.data(), heights.size(), e);
        });
    }
    /// The weights or heights of the points; empty without.
    Span<const double> point_weights() const & noexcept
    {
        const DelotetDoublesView view = delotet_plc_point_weights(get());
        return {view.data, view.count};
    }
    void point_weights() const && = delete;
    /// The edge lengths wanted at the points: one each, infinite for no wish; or none.
    Status set_point_sizes(Span<const double> sizes, Error &error) noexcept
    {
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_set_point_sizes(get(), sizes.data(), sizes.size(), e);
        });
    }
    /// The edge length wanted at the facets with a marker; infinite removes it.
    Status set_facet_size(Marker marker, double size, Error &error) noexcept
    {
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_facet_size(get(), marker, size, e); });
    }
    /// The largest area wanted of a subface of the facets with a marker; infinite removes it.
    Status set_facet_area(Marker marker, double area, Error &error) noexcept
    {
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_facet_area(get(), marker, area, e); });
    }
    /// The edge length wanted at the segments with a marker; infinite removes it.
    Status set_segment_size(Marker marker, double size, Error &error) noexcept
    {
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_segment_size(get(), marker, size, e); });
    }
    /// The edge length wanted in the regions with an attribute; infinite removes it.
    Status set_region_size(double attribute, double size, Error &error) noexcept
    {
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_region_size(get(), attribute, size, e); });
    }
    /// Names a facet marker; an empty name removes its name.
    Status set_marker_name(Marker marker, const Text &name, Error &error) noexcept
    {
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_marker_name(get(), marker, name.c_str(), e); });
    }
    /// One per segment, or none (all 0).
    Status set_segment_markers(Span<const Marker> markers, Error &error) noexcept
    {
        if (!detail::fits(markers, segment_count()))
            return detail::mismatch(error);
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_segment_markers(get(), markers.data(), e); });
    }
    /// One per facet, or none (all 0).
    Status set_facet_markers(Span<const Marker> markers, Error &error) noexcept
    {
        if (!detail::fits(markers, facet_count()))
            return detail::mismatch(error);
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_facet_markers(get(), markers.data(), e); });
    }
    Status set_facet_marker(Index facet, Marker marker, Error &error) noexcept
    {
        return detail::run(
            error, [&](DelotetError **e) { return delotet_plc_set_facet_marker(get(), facet, marker, e); });
    }
    Status add_segment(Index a, Index b, Marker marker, Error &error) noexcept
    {
        return detail::run(error, [&](DelotetError **e) { return delotet_plc_add_segment(get(), a, b, marker, e); });
    }
    /// `ends`: two per segment. `markers`: none, or one per segment.
    Status add_segments(const Indices<2> &ends, Span<const Marker> markers, Error &error) noexcept
    {
        const std::size_t count = ends.size() / 2;
        if (ends.failed())
            return detail::out_of_memory(error);
        if (ends.size() % 2 != 0 || !detail::fits(markers, count))
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_segments(get(), ends.data(), markers.data(), count, e);
        });
    }
    /// `corners`: three per triangle. `markers`: none, or one per triangle.
    Status add_triangles(const Indices<3> &corners, Span<const Marker> markers, Error &error) noexcept
    {
        const std::size_t count = corners.size() / 3;
        if (corners.failed())
            return detail::out_of_memory(error);
        if (corners.size() % 3 != 0 || !detail::fits(markers, count))
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_triangles(get(), corners.data(), markers.data(), count, e);
        });
    }
    /// One facet per polygon; `ends` as for delotet_plc_add_polygons. `markers`: none, or one per polygon.
    Status add_polygons(const Indices<> &corners, const Ends &ends, Span<const Marker> markers,
                        Error &error) noexcept
    {
        if (corners.failed() || ends.failed())
            return detail::out_of_memory(error);
        if (!fits(corners, ends) || !detail::fits(markers, ends.size()))
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_polygons(get(), corners.data(), ends.data(), markers.data(), ends.size(), e);
        });
    }
    /// One facet: an outer ring, and rings that are holes in it.
    Status add_facet(const Indices<> &corners, const Ends &ring_ends, Marker marker, Error &error) noexcept
    {
        if (corners.failed() || ring_ends.failed())
            return detail::out_of_memory(error);
        if (!fits(corners, ring_ends))
            return detail::mismatch(error);
        return detail::run(error, [&](DelotetError **e) {
            return delotet_plc_add_facet(get(), corners.data(), ring_ends.data(), ring_ends.size(), marker, e);
        });
    }
    /// One facet by TetGen's rule, with a seed in each hole.
    Status add_facet_with_hole_seeds(const Indices<> &corners, const Ends &polygon_ends,
                                     Span<const Point> seeds, Marker marker, Error &error) noexcept
    {
        if (corners.failed() || polygon_ends.failed())
            return detail::out_of_memory(error);
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
    /// Writes the PLC; the extension determines the format.
    Status write(const Path &path, Error &error) const noexcept
    {
        return detail::run(error, [&](DelotetError **e) { return delotet_plc_write(get(), path.c_str(), e); });
    }
    /// As above; values that the format cannot hold are reported to the log of `options`.
    Status write(const Path &path, const WriteOptions &options, Error &error) const
    {
        return detail::run(options, error, [&](DelotetError **e) {
            return delotet_plc_write_with(get(), path.c_str(), options.get(), e);
        });
    }
    /// Looks for defects; see delotet_plc_check().
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
    static Plc read(const Path &path)
    {
        Plc plc;
        detail::require([&](Error &e) { return read(path, plc, e); });
        return plc;
    }
    static Plc read(const Path &path, const Options &options)
    {
        Plc plc;
        detail::require([&](Error &e) { return read(path, options, plc, e); });
        return plc;
    }
    Plc clone() const
    {
        Plc copy;
        detail::require([&](Error &e) { return clone(copy, e); });
        return copy;
    }
    /// Appends points. Returns the index of the first new one.
    Index add_points(Span<const Point> points)
    {
        Index first = invalid_index;
        detail::require([&](Error &e) { return add_points(points, first, e); });
        return first;
    }
    void write(const Path &path) const
    {
        detail::require([&](Error &e) { return write(path, e); });
    }
    void write(const Path &path, const WriteOptions &options) const
    {
        detail::require([&](Error &e) { return write(path, options, e); });
    }
    Plc &set_marker_name(Marker marker, const Text &name) &
    {
        return chain([&](Error &e) { return set_marker_name(marker, name, e); });
    }
    Plc &&set_marker_name(Marker marker, const Text &name) && { return std::move(set_marker_name(marker, name)); }
    Plc &set_segment_markers(Span<const Marker> markers) &
    {
        return chain([&](Error &e) { return set_segment_markers(markers, e); });
    }
    Plc &&set_segment_markers(Span<const Marker> markers) && { return std::move(set_segment_markers(markers)); }
    Plc &set_facet_markers(Span<const Marker> markers) &
    {
        return chain([&](Error &e) { return set_facet_markers(markers, e); });
    }
    Plc &&set_facet_markers(Span<const Marker> markers) && { return std::move(set_facet_markers(markers)); }
    Plc &set_facet_marker(Index facet, Marker marker) &
    {
        return chain([&](Error &e) { return set_facet_marker(facet, marker, e); });
    }
    Plc &&set_facet_marker(Index facet, Marker marker) && { return std::move(set_facet_marker(facet, marker)); }
    Plc &set_point_attributes(Span<const double> attributes) &
    {
        return chain([&](Error &e) { return set_point_attributes(attributes, e); });
    }
    Plc &&set_point_attributes(Span<const double> attributes) && { return std::move(set_point_attributes(attributes)); }
    Plc &set_point_markers(Span<const Marker> markers) &
    {
        return chain([&](Error &e) { return set_point_markers(markers, e); });
    }
    Plc &&set_point_markers(Span<const Marker> markers) && { return std::move(set_point_markers(markers)); }
    Plc &set_point_weights(Span<const double> weights) &
    {
        return chain([&](Error &e) { return set_point_weights(weights, e); });
    }
    Plc &&set_point_weights(Span<const double> weights) && { return std::move(set_point_weights(weights)); }
    Plc &set_point_heights(Span<const double> heights) &
    {
        return chain([&](Error &e) { return set_point_heights(heights, e); });
    }
    Plc &&set_point_heights(Span<const double> heights) && { return std::move(set_point_heights(heights)); }
    Plc &set_point_sizes(Span<const double> sizes) &
    {
        return chain([&](Error &e) { return set_point_sizes(sizes, e); });
    }
    Plc &&set_point_sizes(Span<const double> sizes) && { return std::move(set_point_sizes(sizes)); }
    Plc &set_facet_size(Marker marker, double size) &
    {
        return chain([&](Error &e) { return set_facet_size(marker, size, e); });
    }
    Plc &&set_facet_size(Marker marker, double size) && { return std::move(set_facet_size(marker, size)); }
    Plc &set_facet_area(Marker marker, double area) &
    {
        return chain([&](Error &e) { return set_facet_area(marker, area, e); });
    }
    Plc &&set_facet_area(Marker marker, double area) && { return std::move(set_facet_area(marker, area)); }
    Plc &set_segment_size(Marker marker, double size) &
    {
        return chain([&](Error &e) { return set_segment_size(marker, size, e); });
    }
    Plc &&set_segment_size(Marker marker, double size) && { return std::move(set_segment_size(marker, size)); }
    Plc &set_region_size(double attribute, double size) &
    {
        return chain([&](Error &e) { return set_region_size(attribute, size, e); });
    }
    Plc &&set_region_size(double attribute, double size) && { return std::move(set_region_size(attribute, size)); }
    Plc &add_segment(Index a, Index b, Marker marker = 0) &
    {
        return chain([&](Error &e) { return add_segment(a, b, marker, e); });
    }
    Plc &&add_segment(Index a, Index b, Marker marker = 0) && { return std::move(add_segment(a, b, marker)); }
    Plc &add_segments(const Indices<2> &ends, Span<const Marker> markers = {}) &
    {
        return chain([&](Error &e) { return add_segments(ends, markers, e); });
    }
    Plc &&add_segments(const Indices<2> &ends, Span<const Marker> markers = {}) && { return std::move(add_segments(ends, markers)); }
    Plc &add_triangles(const Indices<3> &corners, Span<const Marker> markers = {}) &
    {
        return chain([&](Error &e) { return add_triangles(corners, markers, e); });
    }
    Plc &&add_triangles(const Indices<3> &corners, Span<const Marker> markers = {}) && { return std::move(add_triangles(corners, markers)); }
    Plc &add_polygons(const Indices<> &corners, const Ends &ends, Span<const Marker> markers = {}) &
    {
        return chain([&](Error &e) { return add_polygons(corners, ends, markers, e); });
    }
    Plc &&add_polygons(const Indices<> &corners, const Ends &ends, Span<const Marker> markers = {}) && { return std::move(add_polygons(corners, ends, markers)); }
    Plc &add_facet(const Indices<> &corners, const Ends &ring_ends, Marker marker = 0) &
    {
        return chain([&](Error &e) { return add_facet(corners, ring_ends, marker, e); });
    }
    Plc &&add_facet(const Indices<> &corners, const Ends &ring_ends, Marker marker = 0) && { return std::move(add_facet(corners, ring_ends, marker)); }
    Plc &add_facet_with_hole_seeds(const Indices<> &corners, const Ends &polygon_ends,
                                   Span<const Point> seeds, Marker marker = 0) &
    {
        return chain([&](Error &e) { return add_facet_with_hole_seeds(corners, polygon_ends, seeds, marker, e); });
    }
    Plc &&add_facet_with_hole_seeds(const Indices<> &corners, const Ends &polygon_ends,
                                   Span<const Point> seeds, Marker marker = 0) && { return std::move(add_facet_with_hole_seeds(corners, polygon_ends, seeds, marker)); }
    Plc &add_hole(const Point &seed) &
    {
        return chain([&](Error &e) { return add_hole(seed, e); });
    }
    Plc &&add_hole(const Point &seed) && { return std::move(add_hole(seed)); }
    Plc &add_region(const Point &seed, double attribute, double max_volume = 0) &
    {
        return chain([&](Error &e) { return add_region(seed, attribute, max_volume, e); });
    }
    Plc &&add_region(const Point &seed, double attribute, double max_volume = 0) && { return std::move(add_region(seed, attribute, max_volume)); }
    void check(const Options &options = {}) const
    {
        detail::require([&](Error &e) { return check(options, e); });
    }
#endif

    Span<const Point> points() const & noexcept
    {
        return detail::points_of(delotet_plc_points(get()));
    }
    void points() const && = delete;
    /// #points by `width` doubles.
    DelotetDoublesView point_attributes() const & noexcept { return delotet_plc_point_attributes(get()); }
    void point_attributes() const && = delete;
    Span<const Marker> point_markers() const & noexcept { return detail::span(delotet_plc_point_markers(get())); }
    void point_markers() const && = delete;
    Span<const double> point_sizes() const & noexcept
    {
        const DelotetDoublesView view = delotet_plc_point_sizes(get());
        return {view.data, view.count};
    }
    void point_sizes() const && = delete;
    /// The edge lengths wanted, infinite if there is none: at facets and segments with a marker, in regions with an attribute.
    double facet_size(Marker marker) const noexcept { return delotet_plc_facet_size(get(), marker); }
    double segment_size(Marker marker) const noexcept { return delotet_plc_segment_size(get(), marker); }
    double region_size(double attribute) const noexcept { return delotet_plc_region_size(get(), attribute); }
    /// The largest area wanted of a subface, infinite if there is none, at facets with a marker.
    double facet_area(Marker marker) const noexcept { return delotet_plc_facet_area(get(), marker); }
    Records<Segment> segments() const & noexcept { return detail::records(delotet_plc_segments(get())); }
    void segments() const && = delete;
    Span<const Point> holes() const & noexcept { return detail::points_of(delotet_plc_holes(get())); }
    void holes() const && = delete;
    Records<RegionSeed> regions() const & noexcept { return detail::records(delotet_plc_regions(get())); }
    void regions() const && = delete;
    /// The facets up to the first that was not added as a triangle; see delotet_plc_triangles().
    Span<const Triangle> triangles() const & noexcept
    {
        const DelotetIndexRowsView view = delotet_plc_triangles(get());
        return detail::rows<Triangle>(view.data, view.count);
    }
    void triangles() const && = delete;
    /// The name of a facet marker, from the groups of a file or set by the caller; NULL if it has none.
    const char *marker_name(Marker marker) const & noexcept { return delotet_plc_marker_name(get(), marker); }
    void marker_name(Marker) const && = delete;
    /// The number of markers with names, and the i-th of these markers in ascending order.
    std::size_t marker_name_count() const noexcept { return delotet_plc_marker_name_count(get()); }
    Marker named_marker(std::size_t i) const noexcept { return delotet_plc_named_marker(get(), i); }
    std::size_t facet_ring_count(Index facet) const noexcept { return delotet_plc_facet_ring_count(get(), facet); }
    /// The corners of a ring of a facet.
    Span<const Index> facet_ring(Index facet, std::size_t ring = 0) const & noexcept
    {
        return detail::span(delotet_plc_facet_ring(get(), facet, ring));
    }
    void facet_ring(Index, std::size_t = 0) const && = delete;
    FacetRule facet_rule(Index facet) const noexcept
    {
        return static_cast<FacetRule>(delotet_plc_facet_rule(get(), facet));
    }
    Span<const Point> facet_hole_seeds(Index facet) const & noexcept
    {
        return detail::points_of(delotet_plc_facet_hole_seeds(get(), facet));
    }
    void facet_hole_seeds(Index) const && = delete;
    std::size_t segment_count() const noexcept { return delotet_plc_segment_count(get()); }
    std::size_t facet_count() const noexcept { return delotet_plc_facet_count(get()); }
    Marker facet_marker(Index facet) const noexcept { return delotet_plc_facet_marker(get(), facet); }
    DelotetPlc *get() const noexcept { return handle_.get(); }

  private:
    static bool fits(const Indices<> &corners, const Ends &ends) noexcept
    {
        return (ends.size() == 0 ? 0 : ends.data()[ends.size() - 1]) == corners.size();
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

/// Edge lengths wanted in a mesh that is to be refined. Move-only. The throwing forms return *this.
class MeshSizes {
  public:
    MeshSizes() noexcept : handle_(delotet_mesh_sizes_new()) {}

    /// One length per point of the mesh, infinite where there is no wish; empty removes them.
    Status points(Span<const double> lengths, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) {
            return delotet_mesh_sizes_set_points(get(), lengths.data(), lengths.size(), e);
        });
    }
    /// One length per tetrahedron of the mesh, likewise.
    Status tets(Span<const double> lengths, Error &error) noexcept
    {
        return change(error, [&](DelotetError **e) {
            return delotet_mesh_sizes_set_tets(get(), lengths.data(), lengths.size(), e);
        });
    }
    /// At the subfaces with a marker; infinite removes it, here as below.
    Status facet(Marker marker, double length, Error &error) noexcept
    {
        return change(
            error, [&](DelotetError **e) { return delotet_mesh_sizes_set_facet(get(), marker, length, e); });
    }
    /// The area wanted of the subfaces with a marker: as a length, the edge of the equilateral triangle of this area.
    Status facet_area(Marker marker, double area, Error &error) noexcept
    {
        return change(
            error, [&](DelotetError **e) { return delotet_mesh_sizes_set_facet_area(get(), marker, area, e); });
    }
    /// At the subsegments with a marker.
    Status segment(Marker marker, double length, Error &error) noexcept
    {
        return change(
            error, [&](DelotetError **e) { return delotet_mesh_sizes_set_segment(get(), marker, length, e); });
    }
    /// In the regions with an attribute.
    Status region(double attribute, double length, Error &error) noexcept
    {
        return change(
            error, [&](DelotetError **e) { return delotet_mesh_sizes_set_region(get(), attribute, length, e); });
    }

#if DELOTET_EXCEPTIONS
    MeshSizes &points(Span<const double> lengths) &
    {
        return chain([&](Error &e) { return points(lengths, e); });
    }
    MeshSizes &&points(Span<const double> lengths) && { return std::move(points(lengths)); }
    MeshSizes &tets(Span<const double> lengths) &
    {
        return chain([&](Error &e) { return tets(lengths, e); });
    }
    MeshSizes &&tets(Span<const double> lengths) && { return std::move(tets(lengths)); }
    MeshSizes &facet(Marker marker, double length) &
    {
        return chain([&](Error &e) { return facet(marker, length, e); });
    }
    MeshSizes &&facet(Marker marker, double length) && { return std::move(facet(marker, length)); }
    MeshSizes &facet_area(Marker marker, double area) &
    {
        return chain([&](Error &e) { return facet_area(marker, area, e); });
    }
    MeshSizes &&facet_area(Marker marker, double area) && { return std::move(facet_area(marker, area)); }
    MeshSizes &segment(Marker marker, double length) &
    {
        return chain([&](Error &e) { return segment(marker, length, e); });
    }
    MeshSizes &&segment(Marker marker, double length) && { return std::move(segment(marker, length)); }
    MeshSizes &region(double attribute, double length) &
    {
        return chain([&](Error &e) { return region(attribute, length, e); });
    }
    MeshSizes &&region(double attribute, double length) && { return std::move(region(attribute, length)); }
#endif
    DelotetMeshSizes *get() const noexcept { return handle_.get(); }

  private:
    template <class Call> Status change(Error &error, Call &&call) noexcept
    {
        return handle_ ? detail::run(error, call) : detail::out_of_memory(error);
    }
#if DELOTET_EXCEPTIONS
    template <class Call> MeshSizes &chain(Call &&call)
    {
        detail::require(call);
        return *this;
    }
#endif
    std::unique_ptr<DelotetMeshSizes, detail::Free<DelotetMeshSizes, delotet_mesh_sizes_free>> handle_;
};

/// A mesh as arrays, which somebody else keeps: see delotet_mesh_from_arrays(). Lists of attributes and markers may be empty.
struct MeshArrays {
    Span<const Point> points;
    Span<const Tet> tets;
    Span<const double> attributes;
    /// Faces and edges of the mesh that are to be kept.
    Span<const Triangle> faces;
    Span<const Marker> face_markers;
    Span<const std::array<Index, 2>> edges;
    Span<const Marker> edge_markers;
    /// The others may be moved and taken out later; by default all are input points.
    std::size_t input_point_count = static_cast<std::size_t>(-1);
};

/// The tetrahedra of a mesh above a radius-edge ratio. Move-only and immutable; empty (get() is NULL) by default.
class SkinnyTets {
  public:
    SkinnyTets() noexcept = default;
    explicit SkinnyTets(DelotetSkinnyTets *owned) noexcept : handle_(owned) {}

    /// All of them, in ascending order.
    Records<SkinnyTet> tets() const & noexcept { return detail::records(delotet_skinny_tets_view(get())); }
    void tets() const && = delete;
    double ratio() const noexcept { return delotet_skinny_tets_ratio(get()); }
    std::size_t count(SkinnyCause cause) const noexcept
    {
        std::size_t count = 0;
        for (const SkinnyTet &tet : tets())
            count += tet.cause == static_cast<DelotetSkinnyCause>(cause);
        return count;
    }
    DelotetSkinnyTets *get() const noexcept { return handle_.get(); }

  private:
    std::unique_ptr<DelotetSkinnyTets, detail::Free<DelotetSkinnyTets, delotet_skinny_tets_free>> handle_;
};

/// The Voronoi diagram of the points of a mesh, or their power diagram: the dual of the mesh as it is, in the same order. Move-only and
/// immutable; empty (get() is NULL) by default.
class Voronoi {
  public:
    Voronoi() noexcept = default;
    explicit Voronoi(DelotetVoronoi *owned) noexcept : handle_(owned) {}

    /// One per tetrahedron.
    Span<const Point> vertices() const & noexcept { return detail::points_of(delotet_voronoi_vertices(get())); }
    void vertices() const && = delete;
    /// One per face.
    Records<VoronoiEdge> edges() const & noexcept { return detail::records(delotet_voronoi_edges(get())); }
    void edges() const && = delete;
    /// One per edge.
    Records<VoronoiFacet> facets() const & noexcept { return detail::records(delotet_voronoi_facets(get())); }
    void facets() const && = delete;
    /// One per point.
    Records<VoronoiCell> cells() const & noexcept { return detail::records(delotet_voronoi_cells(get())); }
    void cells() const && = delete;
    /// The edges of a facet, in order.
    Span<const Index> edges_of(const VoronoiFacet &facet) const & noexcept
    {
        return {delotet_voronoi_facet_edges(get()).data + facet.first, facet.count};
    }
    void edges_of(const VoronoiFacet &) const && = delete;
    /// The facets of a cell, ascending; empty if there is no cell.
    Span<const Index> facets_of(const VoronoiCell &cell) const & noexcept
    {
        return {delotet_voronoi_cell_facets(get()).data + cell.first, cell.count};
    }
    void facets_of(const VoronoiCell &) const && = delete;
    DelotetVoronoi *get() const noexcept { return handle_.get(); }

  private:
    std::unique_ptr<DelotetVoronoi, detail::Free<DelotetVoronoi, delotet_voronoi_free>> handle_;
};

/// The result. Move-only and immutable; empty (get() is NULL) by default.
class Mesh {
  public:
    Mesh() noexcept = default;
    explicit Mesh(DelotetMesh *owned) noexcept : handle_(owned) {}

    Span<const Point> points() const & noexcept { return detail::points_of(delotet_mesh_points(get())); }
    void points() const && = delete;
    std::size_t input_point_count() const noexcept { return delotet_mesh_input_point_count(get()); }
    Span<const Index> crowded_points() const & noexcept { return detail::span(delotet_mesh_crowded_points(get())); }
    void crowded_points() const && = delete;
    Span<const Index> replaced_tets() const & noexcept { return detail::span(delotet_mesh_replaced_tets(get())); }
    void replaced_tets() const && = delete;
    Span<const Index> point_aliases() const & noexcept { return detail::span(delotet_mesh_point_aliases(get())); }
    void point_aliases() const && = delete;
    /// For each input point its index in points(); empty without Options::drop_unmeshed_points.
    Span<const Index> point_map() const & noexcept { return detail::span(delotet_mesh_point_map(get())); }
    void point_map() const && = delete;
    /// #points by `width` doubles.
    DelotetDoublesView point_attributes() const & noexcept { return delotet_mesh_point_attributes(get()); }
    void point_attributes() const && = delete;
    Span<const Marker> point_markers() const & noexcept { return detail::span(delotet_mesh_point_markers(get())); }
    void point_markers() const && = delete;
    Span<const Tet> tets() const & noexcept { return tets_of(delotet_mesh_tets(get())); }
    void tets() const && = delete;
    Span<const Tet> neighbors() const & noexcept { return tets_of(delotet_mesh_neighbors(get())); }
    void neighbors() const && = delete;
    Span<const Index> tet_regions() const & noexcept { return detail::span(delotet_mesh_tet_regions(get())); }
    void tet_regions() const && = delete;
    Records<Region> regions() const & noexcept { return detail::records(delotet_mesh_regions(get())); }
    void regions() const && = delete;
    Records<Subface> subfaces() const & noexcept { return detail::records(delotet_mesh_subfaces(get())); }
    void subfaces() const && = delete;
    Records<Subsegment> subsegments() const & noexcept { return detail::records(delotet_mesh_subsegments(get())); }
    void subsegments() const && = delete;
    Records<SteinerPoint> steiner_points() const & noexcept { return detail::records(delotet_mesh_steiner_points(get())); }
    void steiner_points() const && = delete;
    Records<SteinerTerm> steiner_terms() const & noexcept { return detail::records(delotet_mesh_steiner_terms(get())); }
    void steiner_terms() const && = delete;
    Records<FacetFlip> facet_flips() const & noexcept { return detail::records(delotet_mesh_facet_flips(get())); }
    void facet_flips() const && = delete;
    Records<Subface> unmeshed_subfaces() const & noexcept { return detail::records(delotet_mesh_unmeshed_subfaces(get())); }
    void unmeshed_subfaces() const && = delete;
    Records<Subsegment> unmeshed_subsegments() const & noexcept
    {
        return detail::records(delotet_mesh_unmeshed_subsegments(get()));
    }
    void unmeshed_subsegments() const && = delete;
    Span<const Index> unmeshed_points() const & noexcept { return detail::span(delotet_mesh_unmeshed_points(get())); }
    void unmeshed_points() const && = delete;
    /// Those of them that others hide by their weights.
    Span<const Index> hidden_points() const & noexcept { return detail::span(delotet_mesh_hidden_points(get())); }
    void hidden_points() const && = delete;
    /// The weights or heights that counted, one per point; empty without.
    Span<const double> point_weights() const & noexcept
    {
        const DelotetDoublesView view = delotet_mesh_point_weights(get());
        return {view.data, view.count};
    }
    void point_weights() const && = delete;
    Records<Warning> warnings() const & noexcept { return detail::records(delotet_mesh_warnings(get())); }
    void warnings() const && = delete;
    /// The number of warnings of a kind, listed or not.
    std::uint64_t warning_count(WarningKind kind) const noexcept
    {
        return delotet_mesh_warning_count(get(), static_cast<std::uint32_t>(kind));
    }
    Stats stats() const noexcept
    {
        Stats stats = {};
        stats.struct_size = sizeof stats;
        if (delotet_mesh_stats(get(), &stats, nullptr) != DELOTET_STATUS_OK)
            stats = {};
        return stats;
    }

    Status tet_attributes(Span<const double> &out, Error &error) const & noexcept
    {
        DelotetDoublesView view = {};
        const Status status = detail::run(
            error, [&](DelotetError **e) { return delotet_mesh_tet_attributes(get(), &view, e); });
        out = {view.data, view.count};
        return status;
    }
    void tet_attributes(Span<const double> &, Error &) const && = delete;
    Status point_tets(Span<const Index> &out, Error &error) const & noexcept
    {
        return derive<DelotetIndicesView>(delotet_mesh_point_tets, out, error);
    }
    void point_tets(Span<const Index> &, Error &) const && = delete;
    Status faces(Records<Face> &out, Error &error) const & noexcept
    {
        return derive_records(delotet_mesh_faces, out, error);
    }
    void faces(Records<Face> &, Error &) const && = delete;
    Status edges(Records<Edge> &out, Error &error) const & noexcept
    {
        return derive_records(delotet_mesh_edges, out, error);
    }
    void edges(Records<Edge> &, Error &) const && = delete;
    Status tet_faces(Span<const Tet> &out, Error &error) const & noexcept
    {
        return derive<DelotetTetsView>(delotet_mesh_tet_faces, out, error);
    }
    void tet_faces(Span<const Tet> &, Error &) const && = delete;
    Status tet_edges(Span<const std::array<Index, 6>> &out, Error &error) const & noexcept
    {
        return derive<DelotetIndexRowsView>(delotet_mesh_tet_edges, out, error);
    }
    void tet_edges(Span<const std::array<Index, 6>> &, Error &) const && = delete;
    Status subface_edges(Span<const Triangle> &out, Error &error) const & noexcept
    {
        return derive<DelotetIndexRowsView>(delotet_mesh_subface_edges, out, error);
    }
    void subface_edges(Span<const Triangle> &, Error &) const && = delete;
    Status second_order(NodeOrder order, SecondOrder &out, Error &error) const & noexcept
    {
        DelotetSecondOrderView view = {};
        const Status status = detail::run(error, [&](DelotetError **e) {
            return delotet_mesh_second_order(get(), static_cast<DelotetNodeOrder>(order), &view, e);
        });
        out = {detail::rows<Point>(view.nodes, view.node_count), detail::rows<Tet10>(view.tets, view.tet_count)};
        return status;
    }
    void second_order(NodeOrder, SecondOrder &, Error &) const && = delete;
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
    /// The measures of every tetrahedron.
    Status quality(Records<TetQuality> &out, Error &error) const & noexcept
    {
        return derive_records(delotet_mesh_quality, out, error);
    }
    void quality(Records<TetQuality> &, Error &) const && = delete;
    /// Worst values and histograms.
    Status quality_summary(QualitySummary &out, Error &error) const noexcept
    {
        QualitySummary summary = {};
        summary.struct_size = sizeof summary;
        const Status status = detail::run(
            error, [&](DelotetError **e) { return delotet_mesh_quality_summary(get(), &summary, e); });
        if (status == DELOTET_STATUS_OK)
            out = summary;
        return status;
    }
    /// Fills `tets` with the worst tetrahedra, the worst first; with `unforced`, without those that are input-forced.
    Status worst_tets(QualityMeasure measure, bool unforced, Span<Index> tets, Error &error) const noexcept
    {
        return detail::run(error, [&](DelotetError **e) {
            return delotet_mesh_worst_tets(get(), static_cast<DelotetQualityMeasure>(measure), unforced, tets.data(),
                                           tets.size(), e);
        });
    }
    /// Tetrahedra in narrow wedges between two facets.
    Status forced_tets(Records<ForcedTet> &out, Error &error) const & noexcept
    {
        return derive_records(delotet_mesh_forced_tets, out, error);
    }
    void forced_tets(Records<ForcedTet> &, Error &) const && = delete;
    /// Tetrahedra above a radius-edge ratio, and what forces them. `ratio`: 0 is the one that was asked for.
    Status skinny_tets(double ratio, SkinnyTets &out, Error &error) const noexcept
    {
        DelotetSkinnyTets *made = nullptr;
        const Status status = detail::run(
            error, [&](DelotetError **e) { return delotet_skinny_tets_new(get(), ratio, &made, e); });
        if (status == DELOTET_STATUS_OK)
            out = SkinnyTets(made);
        return status;
    }
    /// The Voronoi or power diagram of a mesh made with Mode::delaunay. Limits and tokens of `options` end it.
    Status voronoi(const Options &options, Voronoi &out, Error &error) const
    {
        DelotetVoronoi *made = nullptr;
        const Status status = detail::run(options, error, [&](DelotetError **e) {
            return delotet_voronoi_new(get(), options.get(), &made, e);
        });
        if (status == DELOTET_STATUS_OK)
            out = Voronoi(made);
        return status;
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
    Status write(const Plc &plc, const Path &path, Error &error) const noexcept
    {
        return detail::run(error,
                           [&](DelotetError **e) { return delotet_mesh_write(get(), plc.get(), path.c_str(), e); });
    }
    Status write(const Plc &plc, const Path &path, const WriteOptions &options, Error &error) const
    {
        return detail::run(options, error, [&](DelotetError **e) {
            return delotet_mesh_write_with(get(), plc.get(), path.c_str(), options.get(), e);
        });
    }

#if DELOTET_EXCEPTIONS
    Span<const double> tet_attributes() const &
    {
        return made<Span<const double>>([&](auto &out, Error &e) { return tet_attributes(out, e); });
    }
    void tet_attributes() const && = delete;
    Span<const Index> point_tets() const &
    {
        return made<Span<const Index>>([&](auto &out, Error &e) { return point_tets(out, e); });
    }
    void point_tets() const && = delete;
    Records<Face> faces() const &
    {
        return made<Records<Face>>([&](auto &out, Error &e) { return faces(out, e); });
    }
    void faces() const && = delete;
    Records<Edge> edges() const &
    {
        return made<Records<Edge>>([&](auto &out, Error &e) { return edges(out, e); });
    }
    void edges() const && = delete;
    Span<const Tet> tet_faces() const &
    {
        return made<Span<const Tet>>([&](auto &out, Error &e) { return tet_faces(out, e); });
    }
    void tet_faces() const && = delete;
    Span<const std::array<Index, 6>> tet_edges() const &
    {
        return made<Span<const std::array<Index, 6>>>([&](auto &out, Error &e) { return tet_edges(out, e); });
    }
    void tet_edges() const && = delete;
    Span<const Triangle> subface_edges() const &
    {
        return made<Span<const Triangle>>([&](auto &out, Error &e) { return subface_edges(out, e); });
    }
    void subface_edges() const && = delete;
    SecondOrder second_order(NodeOrder order) const &
    {
        return made<SecondOrder>([&](auto &out, Error &e) { return second_order(order, out, e); });
    }
    void second_order(NodeOrder) const && = delete;
    void locate(Span<const Point> points, Span<Index> tets, Span<std::array<double, 4>> barycentric = {}) const
    {
        detail::require([&](Error &e) { return locate(points, tets, barycentric, e); });
    }
    Records<TetQuality> quality() const &
    {
        return made<Records<TetQuality>>([&](auto &out, Error &e) { return quality(out, e); });
    }
    void quality() const && = delete;
    QualitySummary quality_summary() const
    {
        return made<QualitySummary>([&](auto &out, Error &e) { return quality_summary(out, e); });
    }
    void worst_tets(QualityMeasure measure, bool unforced, Span<Index> tets) const
    {
        detail::require([&](Error &e) { return worst_tets(measure, unforced, tets, e); });
    }
    Records<ForcedTet> forced_tets() const &
    {
        return made<Records<ForcedTet>>([&](auto &out, Error &e) { return forced_tets(out, e); });
    }
    void forced_tets() const && = delete;
    SkinnyTets skinny_tets(double ratio = 0) const
    {
        return made<SkinnyTets>([&](auto &out, Error &e) { return skinny_tets(ratio, out, e); });
    }
    Voronoi voronoi(const Options &options = {}) const
    {
        return made<Voronoi>([&](auto &out, Error &e) { return voronoi(options, out, e); });
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
    void write(const Plc &plc, const Path &path) const
    {
        detail::require([&](Error &e) { return write(plc, path, e); });
    }
    void write(const Plc &plc, const Path &path, const WriteOptions &options) const
    {
        detail::require([&](Error &e) { return write(plc, path, options, e); });
    }
#endif

    DelotetMesh *get() const noexcept { return handle_.get(); }

  private:
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
    template <class View, class T>
    Status derive_records(DelotetStatus (*call)(const DelotetMesh *, View *, DelotetError **), Records<T> &out,
                          Error &error) const noexcept
    {
        View view = {};
        const Status status = detail::run(error, [&](DelotetError **e) { return call(get(), &view, e); });
        out = {view.first, view.count, view.stride};
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

namespace detail {
/// Runs a call that makes a mesh.
template <class Call> Status made(const Options &options, Mesh &mesh, Error &error, Call &&call)
{
    DelotetMesh *handle = nullptr;
    struct Owner {
        DelotetMesh *&handle;
        ~Owner() { delotet_mesh_free(handle); }
    } owner{handle};
    const Status status = run(options, error, [&](DelotetError **e) { return call(&handle, e); });
    mesh = Mesh(std::exchange(handle, nullptr));
    return status;
}
} // namespace detail

/// Makes the mesh of a PLC. Rethrows what a callback of `options` throws.
inline Status tetrahedralize(const Plc &plc, const Options &options, Mesh &mesh, Error &error)
{
    return detail::made(options, mesh, error, [&](DelotetMesh **out, DelotetError **e) {
        return delotet_tetrahedralize(plc.get(), options.get(), out, e);
    });
}

#if DELOTET_EXCEPTIONS
inline Mesh tetrahedralize(const Plc &plc, const Options &options = {})
{
    Mesh mesh;
    detail::require([&](Error &e) { return tetrahedralize(plc, options, mesh, e); });
    return mesh;
}
#endif

/// Makes a mesh of arrays, under the limits of `options`.
inline Status mesh_from_arrays(const MeshArrays &arrays, const Options &options, Mesh &mesh, Error &error)
{
    const auto listed = [](std::size_t given, std::size_t count) { return given == 0 || given == count; };
    if (!listed(arrays.attributes.size(), arrays.tets.size()) || !listed(arrays.face_markers.size(), arrays.faces.size()) ||
        !listed(arrays.edge_markers.size(), arrays.edges.size()))
        return detail::mismatch(error);
    const auto first = [](const auto &rows) { return rows.empty() ? nullptr : rows.data()->data(); };
    const std::size_t count = arrays.points.size();
    const std::size_t inputs = arrays.input_point_count == static_cast<std::size_t>(-1) ? count : arrays.input_point_count;
    return detail::made(options, mesh, error, [&](DelotetMesh **out, DelotetError **e) {
        return delotet_mesh_from_arrays(
            first(arrays.points), count, inputs, first(arrays.tets), arrays.tets.size(), arrays.attributes.data(),
            first(arrays.faces), arrays.faces.size(), arrays.face_markers.data(), first(arrays.edges),
            arrays.edges.size(), arrays.edge_markers.data(), options.get(), out, e);
    });
}

/// Reads a mesh from a file, under the limits of `options`.
inline Status read_mesh(const Path &path, const Options &options, Mesh &mesh, Error &error)
{
    return detail::made(options, mesh, error, [&](DelotetMesh **out, DelotetError **e) {
        return delotet_mesh_read(path.c_str(), options.get(), out, e);
    });
}

/// Refines a mesh: see delotet_mesh_refine(). Rethrows what a callback of `options` throws.
inline Status refine(const Mesh &mesh, const MeshSizes &sizes, const Options &options, Mesh &refined, Error &error)
{
    return detail::made(options, refined, error, [&](DelotetMesh **out, DelotetError **e) {
        return delotet_mesh_refine(mesh.get(), sizes.get(), options.get(), out, e);
    });
}

/// Improves the dihedral angles of a mesh: see delotet_mesh_improve().
inline Status improve(const Mesh &mesh, const Options &options, Mesh &improved, Error &error)
{
    return detail::made(options, improved, error, [&](DelotetMesh **out, DelotetError **e) {
        return delotet_mesh_improve(mesh.get(), options.get(), out, e);
    });
}

#if DELOTET_EXCEPTIONS
inline Mesh mesh_from_arrays(const MeshArrays &arrays, const Options &options = {})
{
    Mesh mesh;
    detail::require([&](Error &e) { return mesh_from_arrays(arrays, options, mesh, e); });
    return mesh;
}
inline Mesh read_mesh(const Path &path, const Options &options = {})
{
    Mesh mesh;
    detail::require([&](Error &e) { return read_mesh(path, options, mesh, e); });
    return mesh;
}
inline Mesh refine(const Mesh &mesh, const MeshSizes &sizes, const Options &options = {})
{
    Mesh refined;
    detail::require([&](Error &e) { return refine(mesh, sizes, options, refined, e); });
    return refined;
}
inline Mesh refine(const Mesh &mesh, const Options &options)
{
    return refine(mesh, MeshSizes(), options);
}
inline Mesh improve(const Mesh &mesh, const Options &options = {})
{
    Mesh improved;
    detail::require([&](Error &e) { return improve(mesh, options, improved, e); });
    return improved;
}
#endif

inline Status Options::background(const Mesh &mesh, Span<const double> sizes, Error &error) noexcept
{
    return change(error, [&](DelotetError **e) {
        return delotet_options_set_background(get(), mesh.get(), sizes.data(), sizes.size(), e);
    });
}
} // namespace delotet
#endif // C++17
#endif
