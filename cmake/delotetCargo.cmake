# Finds cargo, and reports problems with it at configure time. Sets DELOTET_CARGO; needs DELOTET_ROOT and _delotet_rust.
find_program(DELOTET_CARGO cargo PATHS "$ENV{CARGO_HOME}/bin" "$ENV{HOME}/.cargo/bin")
set(_delotet_hint "Install Rust ${_delotet_rust} or later with rustup (https://rustup.rs), or name another cargo with -DDELOTET_CARGO=/path/to/cargo.")
if(NOT DELOTET_CARGO)
    message(FATAL_ERROR "delotet: cargo, which builds the library, is neither in PATH nor in ~/.cargo/bin. ${_delotet_hint}")
endif()
# In the folder where it will run, since a file or an environment variable may choose the toolchain by folder.
execute_process(COMMAND "${DELOTET_CARGO}" --version WORKING_DIRECTORY "${DELOTET_ROOT}"
    RESULT_VARIABLE _delotet_result OUTPUT_VARIABLE _delotet_output ERROR_VARIABLE _delotet_error)
if(NOT _delotet_result EQUAL 0 OR NOT _delotet_output MATCHES "^cargo ([0-9]+\\.[0-9]+\\.[0-9]+)")
    message(FATAL_ERROR "delotet: '${DELOTET_CARGO} --version' does not tell a version (${_delotet_result}): ${_delotet_output}${_delotet_error}${_delotet_hint}")
elseif(CMAKE_MATCH_1 VERSION_LESS _delotet_rust)
    message(FATAL_ERROR "delotet: ${DELOTET_CARGO} is version ${CMAKE_MATCH_1}, but delotet needs ${_delotet_rust} or later. ${_delotet_hint} (With rustup installed: rustup update.)")
endif()
