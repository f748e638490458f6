# Checks of the libcamera backend. `none` runs anywhere; the other groups of libcamera_check want
# the kernel's virtual camera vimc. libcamera_replay has a libcamera of its own.
include_guard(GLOBAL)

if(TARGET pel_linux)
    add_executable(libcamera_check ${CMAKE_CURRENT_LIST_DIR}/libcamera_check.c)
    target_link_libraries(libcamera_check PRIVATE pel::linux)
    target_compile_definitions(libcamera_check PRIVATE _POSIX_C_SOURCE=200809L)
    set_target_properties(libcamera_check PROPERTIES
        C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
    pel_program_test(libcamera_none COMMAND $<TARGET_FILE:libcamera_check> none)

    find_package(PkgConfig QUIET)
    if(PKG_CONFIG_FOUND)
        pkg_check_modules(PEL_FAKE_LIBCAMERA QUIET IMPORTED_TARGET libcamera)
    endif()
    if(PEL_FAKE_LIBCAMERA_FOUND AND PEL_FAKE_LIBCAMERA_VERSION VERSION_LESS 0.1)
        enable_language(CXX)
        # Its definitions must be there before the library's are looked for.
        add_executable(libcamera_replay ${CMAKE_CURRENT_LIST_DIR}/libcamera_replay.cpp
            ${CMAKE_CURRENT_LIST_DIR}/libcamera_lives.cpp
            ${CMAKE_CURRENT_LIST_DIR}/fake_libcamera.cpp)
        target_link_libraries(libcamera_replay PRIVATE pel::linux PkgConfig::PEL_FAKE_LIBCAMERA)
        set_target_properties(libcamera_replay PROPERTIES ENABLE_EXPORTS ON
            CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
        pel_program_test(libcamera_replay COMMAND libcamera_replay)
    endif()
endif()
