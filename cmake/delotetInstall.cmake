# Installation: libraries, program, headers, CMake package, pkg-config file. CMAKE_INSTALL_LIBDIR and similar variables may be absolute.
include(CMakePackageConfigHelpers)
set(_delotet_config_dir "${CMAKE_INSTALL_LIBDIR}/cmake/delotet")

# delotet_strip(<flag> <installed file>): makes `cmake --install --strip` strip cargo's outputs too; CMake itself strips only targets.
function(delotet_strip flag file)
    if(CMAKE_STRIP)
        install(CODE "
            if(CMAKE_INSTALL_DO_STRIP)
                get_filename_component(_file \"${file}\" ABSOLUTE BASE_DIR \"\${CMAKE_INSTALL_PREFIX}\")
                execute_process(COMMAND \"${CMAKE_STRIP}\" ${flag} \"\$ENV{DESTDIR}\${_file}\" RESULT_VARIABLE _result)
                if(NOT _result EQUAL 0)
                    message(FATAL_ERROR \"${CMAKE_STRIP} ${flag} \$ENV{DESTDIR}\${_file}: \${_result}\")
                endif()
            endif()")
    endif()
endfunction()

install(FILES "${DELOTET_ROOT}/include/delotet/delotet.h" "${DELOTET_ROOT}/include/delotet/delotet.hpp"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/delotet")
get_filename_component(_delotet_file "${_delotet_static}" NAME)
set(DELOTET_STATIC_FILE "${CMAKE_INSTALL_LIBDIR}/${_delotet_file}")
set(DELOTET_IMPLIB_FILE "")
install(FILES "${_delotet_static}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
# An archive without symbols would be useless, so only debug information is removed.
delotet_strip(-S "${DELOTET_STATIC_FILE}")
if(WIN32)
    install(PROGRAMS "${_delotet_shared}" DESTINATION "${CMAKE_INSTALL_BINDIR}")
    install(FILES "${_delotet_implib}" DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    get_filename_component(_delotet_file "${_delotet_implib}" NAME)
    set(DELOTET_SHARED_FILE "${CMAKE_INSTALL_BINDIR}/delotet.dll")
    set(DELOTET_IMPLIB_FILE "${CMAKE_INSTALL_LIBDIR}/${_delotet_file}")
else()
    install(PROGRAMS "${_delotet_shared}" DESTINATION "${CMAKE_INSTALL_LIBDIR}" RENAME "${_delotet_full}")
    set(DELOTET_SHARED_FILE "${CMAKE_INSTALL_LIBDIR}/${_delotet_full}")
    if(APPLE)
        delotet_strip(-x "${DELOTET_SHARED_FILE}")
    else()
        delotet_strip("" "${DELOTET_SHARED_FILE}")
    endif()
    get_filename_component(_delotet_dev "${_delotet_shared}" NAME)
    install(CODE "
        get_filename_component(_dir \"${CMAKE_INSTALL_LIBDIR}\" ABSOLUTE BASE_DIR \"\${CMAKE_INSTALL_PREFIX}\")
        file(CREATE_LINK \"${_delotet_full}\" \"\$ENV{DESTDIR}\${_dir}/${_delotet_soname}\" SYMBOLIC)
        file(CREATE_LINK \"${_delotet_soname}\" \"\$ENV{DESTDIR}\${_dir}/${_delotet_dev}\" SYMBOLIC)
        list(APPEND CMAKE_INSTALL_MANIFEST_FILES \"\${_dir}/${_delotet_soname}\" \"\${_dir}/${_delotet_dev}\")")
endif()
if(_delotet_program)
    install(PROGRAMS "${_delotet_program}" DESTINATION "${CMAKE_INSTALL_BINDIR}")
    delotet_strip("" "${CMAKE_INSTALL_BINDIR}/delotet${CMAKE_EXECUTABLE_SUFFIX}")
endif()

set(DELOTET_SONAME "${_delotet_soname}")
set(DELOTET_TETGEN_FILE "${CMAKE_INSTALL_LIBDIR}/${CMAKE_STATIC_LIBRARY_PREFIX}delotet_tetgen${CMAKE_STATIC_LIBRARY_SUFFIX}")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/delotetConfig.cmake.in" "${CMAKE_CURRENT_BINARY_DIR}/delotetConfig.cmake"
    INSTALL_DESTINATION "${_delotet_config_dir}"
    PATH_VARS CMAKE_INSTALL_INCLUDEDIR DELOTET_SHARED_FILE DELOTET_STATIC_FILE DELOTET_IMPLIB_FILE
              DELOTET_TETGEN_FILE)
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/delotetConfigVersion.cmake"
    COMPATIBILITY ${_delotet_compatibility})
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/delotetConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/delotetConfigVersion.cmake" DESTINATION "${_delotet_config_dir}")

# pkg-config: paths relative to the .pc file, so that the prefix can be moved; if one of them is absolute, so is everything derived from it.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
    set(DELOTET_PC_PREFIX "${CMAKE_INSTALL_PREFIX}")
else()
    file(RELATIVE_PATH DELOTET_PC_PREFIX "/p/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/p")
    string(REGEX REPLACE "/$" "" DELOTET_PC_PREFIX "${DELOTET_PC_PREFIX}")
    set(DELOTET_PC_PREFIX "\${pcfiledir}/${DELOTET_PC_PREFIX}")
endif()
foreach(_delotet_dir LIBDIR INCLUDEDIR)
    if(IS_ABSOLUTE "${CMAKE_INSTALL_${_delotet_dir}}")
        set(DELOTET_PC_${_delotet_dir} "${CMAKE_INSTALL_${_delotet_dir}}")
    else()
        set(DELOTET_PC_${_delotet_dir} "\${prefix}/${CMAKE_INSTALL_${_delotet_dir}}")
    endif()
endforeach()
string(REPLACE ";" " -l" _delotet_pc_libs "${DELOTET_NATIVE_LIBS}")
string(STRIP "${DELOTET_LINK_OPTIONS} -l${_delotet_pc_libs}" DELOTET_PC_LIBS_PRIVATE)
configure_file("${CMAKE_CURRENT_LIST_DIR}/delotet.pc.in" "${CMAKE_CURRENT_BINARY_DIR}/delotet.pc" @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/delotet.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
