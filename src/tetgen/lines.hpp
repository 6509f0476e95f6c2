// Text files of numbers, line by line.
//
// Lines without content and comments, from '#' to the end of the line, are passed over; fields are separated by blanks, commas and
// semicolons. Nothing is allocated by what a file says of its length: memory grows with what has been read, and lines are bounded.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

namespace delotet_tetgen {

class Lines {
  public:
    /// Opens a file; opened() says whether that went well.
    explicit Lines(const std::string &path);
    ~Lines();
    Lines(const Lines &) = delete;
    Lines &operator=(const Lines &) = delete;

    bool opened() const { return file_ != NULL; }
    const std::string &path() const { return path_; }

    /// Goes to the next line that has a field. False at the end of the file.
    bool next();

    /// The next field of the line as a number; false if there is none, or it is none.
    bool number(double &value);
    bool number(int &value);
    /// The next field of the line as it is.
    bool word(std::string &text);

    /// The next field, from a later line if this one has no more.
    bool number_ahead(int &value);
    bool number_ahead(double &value);
    bool word_ahead(std::string &text);

    /// A line that starts with a number that is not negative.
    bool count(int &value);

    /// Says what is wrong, and where, on stderr. Returns false.
    bool fault(const char *what) const;

  private:
    bool read_line();
    bool refill();
    bool token(const char *&first, const char *&last);

    std::string path_;
    std::FILE *file_;
    std::vector<char> buffer_;
    std::size_t used_ = 0, filled_ = 0;
    std::string line_;
    std::size_t at_ = 0;
    long number_ = 0;
    bool too_long_ = false;
};

/// How much to reserve for `count` elements that a file claims to have.
inline std::size_t believed(int count)
{
    return static_cast<std::size_t>(count < 65536 ? count : 65536);
}

/// A copy of `list` by new[], for tetgenio; NULL if it is empty.
template <class T> T *to_array(const std::vector<T> &list)
{
    if (list.empty())
        return NULL;
    T *array = new T[list.size()];
    for (std::size_t i = 0; i < list.size(); i++)
        array[i] = list[i];
    return array;
}

/// Puts `list` in the place of an array of tetgenio.
template <class T> void replace(T *&array, const std::vector<T> &list)
{
    T *made = to_array(list);
    delete[] array;
    array = made;
}

} // namespace delotet_tetgen
