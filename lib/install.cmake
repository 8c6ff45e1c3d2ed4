# SPDX-License-Identifier: MIT
# What `cmake --install` puts where: header, library, find_package and pkg-config files.
include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/glssao)

install(TARGETS glssao EXPORT glssao
  LIBRARY COMPONENT Runtime NAMELINK_COMPONENT Development
  ARCHIVE COMPONENT Development
  RUNTIME COMPONENT Runtime)
install(FILES include/glssao/glssao.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/glssao COMPONENT Development)

# The library needs nothing that a config file would have to look for, so the targets are the whole of it.
install(EXPORT glssao NAMESPACE glssao:: FILE glssaoConfig.cmake DESTINATION ${config_folder} COMPONENT Development)
# Before 1.0 a minor version may break the API.
set(compatibility SameMinorVersion)
if(PROJECT_VERSION_MAJOR GREATER 0)
  set(compatibility SameMajorVersion)
endif()
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/glssaoConfigVersion.cmake COMPATIBILITY ${compatibility})
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/glssaoConfigVersion.cmake DESTINATION ${config_folder} COMPONENT Development)

file(RELATIVE_PATH GLSSAO_PREFIX_FROM_PC /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
string(REGEX REPLACE "/$" "" GLSSAO_PREFIX_FROM_PC "${GLSSAO_PREFIX_FROM_PC}")
set(GLSSAO_PC_LIBS "")
set(GLSSAO_PC_CFLAGS "")
if(BUILD_SHARED_LIBS)
  set(GLSSAO_PC_CFLAGS -DGLSSAO_SHARED)
elseif(UNIX)
  set(GLSSAO_PC_LIBS -lm)
endif()
configure_file(glssao.pc.in ${CMAKE_CURRENT_BINARY_DIR}/glssao.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/glssao.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT Development)
