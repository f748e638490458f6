# Unity, the test framework: an installed one, else the one inside a pinned wheel, taken at build
# time into PEL_UNITY_DIR. Defines the library pel_unity.
find_package(unity QUIET)
if(TARGET unity::framework)
    add_library(pel_unity INTERFACE)
    target_link_libraries(pel_unity INTERFACE unity::framework)
    return()
endif()

set(PEL_UNITY_DIR ${PROJECT_BINARY_DIR}/unity CACHE PATH "Where the sources of Unity are put")
set(PEL_UNITY_SHA256
    unity.c b90e735a54cf3b3765ab6caa955d11a1488ee73d9c6152cdc98576c2d17cb871
    unity.h 9db174d3c2c6424fd35c0980c5941d124c5ebb0f48e8172f997a2aa9554b64ea
    unity_internals.h fcd8b3f6b412ac0ab599547eb8a30b6d7f3f0af77aab31f7a1822a2a8fc9a2b2)

set(source_dir ${PEL_UNITY_DIR}/vyperling/c)
if(NOT EXISTS ${source_dir}/unity_internals.h)
    message(STATUS "Unity is not installed: taking it from its wheel")
    execute_process(
        COMMAND ${PEL_PYTHON} -m pip --disable-pip-version-check download --quiet --no-deps
            --require-hashes -r ${CMAKE_CURRENT_LIST_DIR}/unity-requirements.txt
            -d ${PEL_UNITY_DIR}
        RESULT_VARIABLE status)
    file(GLOB wheel ${PEL_UNITY_DIR}/vyperling-*.whl)
    if(NOT status EQUAL 0 OR NOT wheel)
        message(FATAL_ERROR "Unity could not be had with pip. Install Unity or pip, or configure "
            "with -DPEL_BUILD_TESTS=OFF.")
    endif()
    file(ARCHIVE_EXTRACT INPUT ${wheel} DESTINATION ${PEL_UNITY_DIR})
endif()

set(expected ${PEL_UNITY_SHA256})
while(expected)
    list(POP_FRONT expected file sum)
    file(SHA256 ${source_dir}/${file} found)
    if(NOT found STREQUAL sum)
        message(FATAL_ERROR "${source_dir}/${file} is not the Unity that is expected: SHA-256 is "
            "${found}, not ${sum}")
    endif()
endwhile()

add_library(pel_unity STATIC ${source_dir}/unity.c)
target_include_directories(pel_unity SYSTEM PUBLIC ${source_dir})
# Our warnings are not for others' code; the sanitizers are for all.
set_target_properties(pel_unity PROPERTIES COMPILE_OPTIONS "${PEL_SANITIZE_FLAGS}")
