// Text files of numbers, line by line.
#include "lines.hpp"

#include "number.hpp"

#include <cmath>
#include <cstring>

namespace delotet_tetgen {

namespace {

// A polygon with a million corners fits; a file without line ends does not fill the memory.
constexpr std::size_t longest_line = 1 << 24;
constexpr std::size_t chunk = 1 << 16;

bool separates(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == ',' || c == ';' || c == '\0';
}

bool starts_number(char c)
{
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

} // namespace

Lines::Lines(const std::string &path) : path_(path), file_(std::fopen(path.c_str(), "rb"))
{
    if (file_ != NULL) {
        try {
            buffer_.resize(chunk);
        } catch (...) {
            std::fclose(file_);
            throw;
        }
    }
}

Lines::~Lines()
{
    if (file_ != NULL)
        std::fclose(file_);
}

bool Lines::refill()
{
    used_ = 0;
    filled_ = std::fread(buffer_.data(), 1, buffer_.size(), file_);
    return filled_ != 0;
}

/// Reads a line without its end and its comment.
bool Lines::read_line()
{
    line_.clear();
    at_ = 0;
    if (file_ == NULL || too_long_)
        return false;
    bool any = false;
    for (;;) {
        if (used_ == filled_ && !refill())
            break;
        any = true;
        const char *first = buffer_.data() + used_;
        const void *found = memchr(first, '\n', filled_ - used_);
        const std::size_t length =
            found == NULL ? filled_ - used_ : static_cast<std::size_t>(static_cast<const char *>(found) - first);
        if (line_.size() + length > longest_line) {
            too_long_ = true;
            return false;
        }
        line_.append(first, length);
        used_ += length;
        if (found != NULL) {
            used_++;
            break;
        }
    }
    if (!any)
        return false;
    number_++;
    const std::size_t comment = line_.find('#');
    if (comment != std::string::npos)
        line_.resize(comment);
    return true;
}

bool Lines::next()
{
    while (read_line())
        for (std::size_t i = 0; i < line_.size(); i++)
            if (!separates(line_[i])) {
                at_ = i;
                return true;
            }
    return false;
}

bool Lines::token(const char *&first, const char *&last)
{
    while (at_ < line_.size() && separates(line_[at_]))
        at_++;
    if (at_ == line_.size())
        return false;
    first = line_.data() + at_;
    while (at_ < line_.size() && !separates(line_[at_]))
        at_++;
    last = line_.data() + at_;
    return true;
}

bool Lines::number(double &value)
{
    const char *first = NULL, *last = NULL;
    double found = 0.0;
    if (!token(first, last) || !starts_number(*first) || read_double(first, last, found) != last || !std::isfinite(found))
        return false;
    value = found;
    return true;
}

bool Lines::number(int &value)
{
    const char *first = NULL, *last = NULL;
    if (!token(first, last) || !starts_number(*first))
        return false;
    if (read_int(first, last, value) == last)
        return true;
    // 1.0 or 1e3: a number of another program.
    double found = 0.0;
    if (read_double(first, last, found) != last || !(std::fabs(found) < 2147483648.0) || std::floor(found) != found)
        return false;
    value = static_cast<int>(found);
    return true;
}

bool Lines::word(std::string &text)
{
    const char *first = NULL, *last = NULL;
    if (!token(first, last))
        return false;
    text.assign(first, static_cast<std::size_t>(last - first));
    return true;
}

bool Lines::number_ahead(int &value)
{
    while (at_ < line_.size() && separates(line_[at_]))
        at_++;
    return (at_ < line_.size() || next()) && number(value);
}

bool Lines::number_ahead(double &value)
{
    while (at_ < line_.size() && separates(line_[at_]))
        at_++;
    return (at_ < line_.size() || next()) && number(value);
}

bool Lines::word_ahead(std::string &text)
{
    while (at_ < line_.size() && separates(line_[at_]))
        at_++;
    return (at_ < line_.size() || next()) && word(text);
}

bool Lines::count(int &value)
{
    return next() && number(value) && value >= 0;
}

bool Lines::fault(const char *what) const
{
    if (too_long_)
        std::fprintf(stderr, "%s: line %ld is too long\n", path_.c_str(), number_ + 1);
    else
        std::fprintf(stderr, "%s: line %ld: %s\n", path_.c_str(), number_, what);
    return false;
}

} // namespace delotet_tetgen
