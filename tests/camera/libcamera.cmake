# Checks of the libcamera backend. `none` runs anywhere; the other groups of libcamera_check want the
# kernel's virtual camera vimc.
if(TARGET pel_linux)
    add_executable(libcamera_check ${CMAKE_CURRENT_LIST_DIR}/libcamera_check.c)
    target_link_libraries(libcamera_check PRIVATE pel::linux)
    target_compile_definitions(libcamera_check PRIVATE _POSIX_C_SOURCE=200809L)
    set_target_properties(libcamera_check PROPERTIES
        C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
    pel_program_test(libcamera_none COMMAND $<TARGET_FILE:libcamera_check> none)
endif()
