# Tests of what takes TetGen's place: src/tetgen with the warnings and sanitizers of the tests, programs against its header, the program.
set(_tetgen "${CMAKE_CURRENT_SOURCE_DIR}/tetgen")
set(_tetgen_include "${DELOTET_ROOT}/include/delotet/tetgen")
file(GLOB _tetgen_sources CONFIGURE_DEPENDS "${DELOTET_ROOT}/src/tetgen/*.cpp")
add_library(tetgen_tested STATIC ${_tetgen_sources})
target_compile_options(tetgen_tested PRIVATE -std=c++17 ${_cxx_warnings})
target_link_libraries(tetgen_tested PUBLIC delotet::shared delotet_test_flags)

function(delotet_tetgen_test name)
    add_executable(${name} ${ARGN})
    target_compile_options(${name} PRIVATE -std=c++17 ${_cxx_warnings})
    target_include_directories(${name} PRIVATE "${_tetgen_include}")
    target_link_libraries(${name} PRIVATE tetgen_tested)
endfunction()

# Every member is where programs expect it; where Debian's header is installed, it says the same.
foreach(_version 150 160)
    add_library(tetgen_layout_${_version} OBJECT "${_tetgen}/layout.cpp")
    target_compile_options(tetgen_layout_${_version} PRIVATE -std=c++17 ${_cxx_warnings})
    target_compile_definitions(tetgen_layout_${_version} PRIVATE DELOTET_TETGEN_VERSION=${_version})
    target_link_libraries(tetgen_layout_${_version} PRIVATE delotet::shared)
endforeach()
find_path(DELOTET_DEBIAN_TETGEN tetgen.h PATHS /usr/include NO_DEFAULT_PATH)
if(DELOTET_DEBIAN_TETGEN)
    delotet_tetgen_test(tetgen_offsets "${_tetgen}/offsets.cpp")
    add_executable(tetgen_offsets_debian "${_tetgen}/offsets.cpp")
    target_include_directories(tetgen_offsets_debian PRIVATE "${DELOTET_DEBIAN_TETGEN}")
    add_test(NAME tetgen_layout_of_debian COMMAND sh -c "$<TARGET_FILE:tetgen_offsets> > ours.txt && $<TARGET_FILE:tetgen_offsets_debian> > theirs.txt \
&& test $(wc -l < ours.txt) -gt 150 && diff ours.txt theirs.txt")
else()
    message(STATUS "SKIPPED: the layout is not compared with TetGen's header, since libtet1.5-dev is not installed")
endif()

delotet_tetgen_test(tetgen_switches "${_tetgen}/test_switches.cpp")
add_test(NAME tetgen_switches COMMAND tetgen_switches "${_tetgen}/switches.txt")
foreach(_name switches_160 memory files)
    delotet_tetgen_test(tetgen_${_name} "${_tetgen}/test_${_name}.cpp")
    delotet_add_test(tetgen_${_name} tetgen)
endforeach()
delotet_tetgen_test(tetgen_two_layouts "${_tetgen}/two_layouts_150.cpp" "${_tetgen}/two_layouts_160.cpp")
delotet_add_test(tetgen_two_layouts tetgen)

include("${_tetgen}/run.cmake" OPTIONAL)

if(TARGET delotet_tetgen_program)
    set(_folder "${CMAKE_CURRENT_BINARY_DIR}/run/tetgen_program")
    file(MAKE_DIRECTORY "${_folder}")
    add_test(NAME tetgen_program WORKING_DIRECTORY "${_folder}" COMMAND "${CMAKE_COMMAND}"
        "-DPROGRAM=$<TARGET_FILE:delotet_tetgen_program>" "-DFOLDER=${_folder}" -P "${_tetgen}/test_program.cmake")
endif()
if(TARGET delotet_tet AND DELOTET_NM)
    # Nothing but TetGen's names is exported.
    add_test(NAME tetgen_symbols COMMAND sh -c "! '${DELOTET_NM}' -D --defined-only '$<TARGET_FILE:delotet_tet>' | \
grep -v -e ' T _Z14tetrahedralizeP' -e ' T _ZN8tetgenio[0-9]*[ls][oa][av][de]_' -e ' T _ZN14tetgenbehavior[0-9]*[psu][aysus]'")
endif()
# Programs of others; with sanitizers they would test the same library.
if(TARGET delotet_tet AND NOT DELOTET_SANITIZE)
    add_test(NAME tetgen_clients COMMAND bash "${_tetgen}/clients.sh" "${DELOTET_ROOT}/../shared/tools/clients"
        "$<TARGET_FILE_DIR:delotet_tet>" "$<TARGET_FILE:delotet_tetgen_program>" "${CMAKE_CURRENT_BINARY_DIR}/clients")
    set_tests_properties(tetgen_clients PROPERTIES TIMEOUT 900 LABELS tetgen SKIP_REGULAR_EXPRESSION "0 passed, 0 failed")
endif()
