// Numbers in text: the same ones in every locale.
#pragma once

#include <charconv>
#include <climits>
#include <cstddef>
#include <cstdlib>

namespace delotet_tetgen {

/// Reads a double at `text`, up to `end`; returns where it ends, or NULL if there is none. Too large ones are refused, too small ones 0.
inline const char *read_double(const char *text, const char *end, double &value)
{
    if (text != end && *text == '+')
        text++;
    if (text == end || *text == '+')
        return NULL;
    const std::from_chars_result result = std::from_chars(text, end, value);
    if (result.ec == std::errc::invalid_argument)
        return NULL;
    if (result.ec == std::errc::result_out_of_range) {
        // Either overflow or underflow; the second has a negative exponent.
        for (const char *at = text; at != result.ptr; at++)
            if ((*at == 'e' || *at == 'E') && at + 1 != result.ptr && at[1] == '-') {
                value = 0.0;
                return result.ptr;
            }
        return NULL;
    }
    return result.ptr;
}

/// Reads an int at `text`, up to `end`, as read_double() does. Ones that are too large are refused.
inline const char *read_int(const char *text, const char *end, int &value)
{
    if (text != end && *text == '+')
        text++;
    if (text == end || *text == '+')
        return NULL;
    const std::from_chars_result result = std::from_chars(text, end, value);
    return result.ec == std::errc() ? result.ptr : NULL;
}

} // namespace delotet_tetgen
