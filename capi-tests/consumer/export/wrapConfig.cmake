# What a project needs whose exported targets link delotet.
include(CMakeFindDependencyMacro)
find_dependency(delotet)
include("${CMAKE_CURRENT_LIST_DIR}/wrapTargets.cmake")
