# What `cmake --install` puts where: headers, library, CMake package, pkg-config file, command.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pel)
install(DIRECTORY ${PEL_INCLUDE_DIR}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.h")
install(TARGETS pel EXPORT pel ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# Without dependencies the exported targets are the whole package.
install(EXPORT pel NAMESPACE pel:: FILE pelConfig.cmake DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pelConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/pelConfigVersion.cmake DESTINATION ${package_dir})

# The way from the .pc file up to the prefix, so that an installed tree can be moved.
set(pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
if(IS_ABSOLUTE ${CMAKE_INSTALL_LIBDIR} OR IS_ABSOLUTE ${CMAKE_INSTALL_INCLUDEDIR})
    set(PEL_PC_PREFIX ${CMAKE_INSTALL_PREFIX})
    set(PEL_PC_LIBDIR ${CMAKE_INSTALL_FULL_LIBDIR})
    set(PEL_PC_INCLUDEDIR ${CMAKE_INSTALL_FULL_INCLUDEDIR})
else()
    file(RELATIVE_PATH up /prefix/${pc_dir} /prefix)
    string(REGEX REPLACE "/$" "" up ${up})
    set(PEL_PC_PREFIX "\${pcfiledir}/${up}")
    set(PEL_PC_LIBDIR "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
    set(PEL_PC_INCLUDEDIR "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
set(PEL_PC_DEFINE "")
if(NOT PEL_CLASS_MAX EQUAL 8)
    set(PEL_PC_DEFINE " -DPEL_CLASS_MAX=${PEL_CLASS_MAX}")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/pel.pc.in ${PROJECT_BINARY_DIR}/pel.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/pel.pc DESTINATION ${pc_dir})

if(TARGET pel_command)
    install(TARGETS pel_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
