# The programs of all consumers: C and C++, linked to `target`.
function(consumer_programs target)
    foreach(_language c cpp)
        add_executable(consumer_${_language} "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/main.${_language}")
        target_link_libraries(consumer_${_language} PRIVATE ${target})
        set_target_properties(consumer_${_language} PROPERTIES CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON)
        add_test(NAME consumer_${_language} COMMAND consumer_${_language})
    endforeach()
endfunction()
