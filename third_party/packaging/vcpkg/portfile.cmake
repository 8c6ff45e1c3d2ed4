# SPDX-License-Identifier: MIT
vcpkg_download_distfile(ARCHIVE
  URLS https://example.org/glssao-${VERSION}.tar.gz
  FILENAME glssao-${VERSION}.tar.gz
  SHA512 0)
vcpkg_extract_source_archive(SOURCE_PATH ARCHIVE ${ARCHIVE})
vcpkg_cmake_configure(SOURCE_PATH ${SOURCE_PATH}
  OPTIONS -DGLSSAO_BUILD_EXAMPLES=OFF -DGLSSAO_BUILD_TESTS=OFF -DGLSSAO_INSTALL=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH lib/cmake/glssao)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE ${CURRENT_PACKAGES_DIR}/debug/include)
vcpkg_install_copyright(FILE_LIST ${SOURCE_PATH}/LICENSE)
