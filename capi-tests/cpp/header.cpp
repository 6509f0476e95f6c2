// Both headers compile in every supported C++ standard, in either order and twice in a row.
#include <delotet/delotet.hpp>
#include <delotet/delotet.h>
#include <delotet/delotet.hpp>

#include <type_traits>

static_assert(std::is_nothrow_move_constructible_v<delotet::Plc> && !std::is_copy_constructible_v<delotet::Plc>);
static_assert(std::is_nothrow_move_constructible_v<delotet::Mesh> && !std::is_copy_constructible_v<delotet::Mesh>);
static_assert(std::is_nothrow_move_constructible_v<delotet::Error> && !std::is_copy_constructible_v<delotet::Error>);
static_assert(std::is_move_constructible_v<delotet::Options> && !std::is_copy_constructible_v<delotet::Options>);
static_assert(std::is_nothrow_copy_constructible_v<delotet::Exception>);
static_assert(sizeof(delotet::Mesh) == sizeof(void *) && sizeof(delotet::Plc) == sizeof(void *));
