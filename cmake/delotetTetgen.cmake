# What takes TetGen's place, all from src/tetgen: delotet::tetgen (header and static library for programs that are compiled), libtet.so.1.5
# (for programs that are not) and the program tetgen. The last two are installed in a folder of their own, so that nothing finds them
# unasked.
file(GLOB _delotet_tetgen_sources CONFIGURE_DEPENDS "${DELOTET_ROOT}/src/tetgen/*.cpp")
set(_delotet_tetgen_header "${_delotet_include}/delotet/tetgen")
set(_delotet_tetgen_dir "${CMAKE_INSTALL_LIBDIR}/delotet/tetgen")
set(_delotet_tetgen_all "")
if(NOT _delotet_top AND NOT DELOTET_INSTALL)
    set(_delotet_tetgen_all EXCLUDE_FROM_ALL)
endif()

add_library(delotet_tetgen_objects OBJECT ${_delotet_tetgen_all} ${_delotet_tetgen_sources})
target_include_directories(delotet_tetgen_objects PRIVATE "${_delotet_include}")
set_target_properties(delotet_tetgen_objects PROPERTIES
    CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT MSVC)
    # The library is optimised without being told so; this part is as well.
    target_compile_options(delotet_tetgen_objects PRIVATE -O2)
endif()

add_library(delotet_tetgen STATIC ${_delotet_tetgen_all} $<TARGET_OBJECTS:delotet_tetgen_objects>)
target_include_directories(delotet_tetgen INTERFACE "${_delotet_include}" "${_delotet_tetgen_header}")
target_link_libraries(delotet_tetgen INTERFACE delotet::delotet)
set_target_properties(delotet_tetgen PROPERTIES LINKER_LANGUAGE CXX)
add_library(delotet::tetgen ALIAS delotet_tetgen)

add_executable(delotet_tetgen_program ${_delotet_tetgen_all} "${DELOTET_ROOT}/src/tetgen/program/main.cpp")
target_link_libraries(delotet_tetgen_program PRIVATE delotet_tetgen_objects delotet::static)
set_target_properties(delotet_tetgen_program PROPERTIES
    OUTPUT_NAME tetgen RUNTIME_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/tetgen")

if(UNIX AND NOT APPLE)
    add_library(delotet_tet SHARED ${_delotet_tetgen_all} $<TARGET_OBJECTS:delotet_tetgen_objects>)
    target_link_libraries(delotet_tet PRIVATE delotet::static)
    target_link_options(delotet_tet PRIVATE "-Wl,--version-script=${CMAKE_CURRENT_LIST_DIR}/libtet.map")
    set_target_properties(delotet_tet PROPERTIES
        OUTPUT_NAME tet VERSION 1.5 SOVERSION 1.5 LINKER_LANGUAGE CXX LINK_DEPENDS "${CMAKE_CURRENT_LIST_DIR}/libtet.map"
        LIBRARY_OUTPUT_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/tetgen")
endif()

if(DELOTET_INSTALL)
    install(FILES "${_delotet_tetgen_header}/tetgen.h" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/delotet/tetgen")
    install(TARGETS delotet_tetgen ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    install(TARGETS delotet_tetgen_program RUNTIME DESTINATION "${_delotet_tetgen_dir}")
    if(TARGET delotet_tet)
        install(TARGETS delotet_tet LIBRARY DESTINATION "${_delotet_tetgen_dir}")
    endif()
    configure_file("${CMAKE_CURRENT_LIST_DIR}/delotet-tetgen.pc.in" "${CMAKE_CURRENT_BINARY_DIR}/delotet-tetgen.pc" @ONLY)
    install(FILES "${CMAKE_CURRENT_BINARY_DIR}/delotet-tetgen.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endif()
