# The list of sources and include folders of the library, and nothing else.
# Every build (CMake, the ports, the packages) includes this file.
set(PEL_LIB_DIR ${CMAKE_CURRENT_LIST_DIR})
set(PEL_INCLUDE_DIR ${PEL_LIB_DIR}/include)
set(PEL_SOURCES
    ${PEL_LIB_DIR}/src/status.c
    ${PEL_LIB_DIR}/src/fixed.c
    ${PEL_LIB_DIR}/src/backend.c
    ${PEL_LIB_DIR}/src/overlap.c
    ${PEL_LIB_DIR}/src/row/row_c.c
    ${PEL_LIB_DIR}/src/row/row_avx2.c
    ${PEL_LIB_DIR}/src/row/row_neon.c
    ${PEL_LIB_DIR}/src/row/row_filter_c.c
    ${PEL_LIB_DIR}/src/row/row_filter_dsp.c
    ${PEL_LIB_DIR}/src/row/row_filter_narrow.c
    ${PEL_LIB_DIR}/src/row/row_filter_ssse3.c
    ${PEL_LIB_DIR}/src/row/row_filter_avx2.c
    ${PEL_LIB_DIR}/src/row/row_filter_neon.c
    ${PEL_LIB_DIR}/src/row/row_point_c.c
    ${PEL_LIB_DIR}/src/row/row_point_ssse3.c
    ${PEL_LIB_DIR}/src/row/row_point_avx2.c
    ${PEL_LIB_DIR}/src/row/row_point_neon.c
    ${PEL_LIB_DIR}/src/row/row_feature_c.c
    ${PEL_LIB_DIR}/src/color.c
    ${PEL_LIB_DIR}/src/image.c
    ${PEL_LIB_DIR}/src/image_read.c
    ${PEL_LIB_DIR}/src/frames.c
    ${PEL_LIB_DIR}/src/classify.c
    ${PEL_LIB_DIR}/src/classify_plan.c
    ${PEL_LIB_DIR}/src/blobs.c
    ${PEL_LIB_DIR}/src/blobs_frame.c
    ${PEL_LIB_DIR}/src/blob_shape.c
    ${PEL_LIB_DIR}/src/blob_list.c
    ${PEL_LIB_DIR}/src/filter.c
    ${PEL_LIB_DIR}/src/filter_ops.c
    ${PEL_LIB_DIR}/src/filter_kernel.c
    ${PEL_LIB_DIR}/src/filter_frame.c
    ${PEL_LIB_DIR}/src/point_table.c
    ${PEL_LIB_DIR}/src/point_stats.c
    ${PEL_LIB_DIR}/src/point_combine.c
    ${PEL_LIB_DIR}/src/point_adaptive.c
    ${PEL_LIB_DIR}/src/point_resize.c
    ${PEL_LIB_DIR}/src/point_wide.c
    ${PEL_LIB_DIR}/src/feature_corner.c
    ${PEL_LIB_DIR}/src/feature_refine.c
    ${PEL_LIB_DIR}/src/feature_window.c
    ${PEL_LIB_DIR}/src/feature_edge.c
    ${PEL_LIB_DIR}/src/feature_line.c)
