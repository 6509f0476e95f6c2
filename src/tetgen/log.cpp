// Lines of text for the user.
#include "stages.hpp"

#include <cstdarg>

namespace delotet_tetgen {

void Log::line(const char *format, ...) const
{
    if (!file_)
        return;
    std::va_list arguments;
    va_start(arguments, format);
    std::vfprintf(file_, format, arguments);
    va_end(arguments);
    std::fputc('\n', file_);
}

void Log::detail(const char *format, ...) const
{
    if (!file_ || verbose_ <= 0)
        return;
    std::va_list arguments;
    va_start(arguments, format);
    std::vfprintf(file_, format, arguments);
    va_end(arguments);
    std::fputc('\n', file_);
}

void Log::fail(Thrown code, const char *format, ...) const
{
    if (why_) {
        char text[256];
        std::va_list arguments;
        va_start(arguments, format);
        std::vsnprintf(text, sizeof(text), format, arguments);
        va_end(arguments);
        *why_ = text;
    }
    throw static_cast<int>(code);
}

} // namespace delotet_tetgen
