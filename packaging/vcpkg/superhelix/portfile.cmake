# superhelix as an overlay port: `vcpkg install superhelix --overlay-ports=packaging/vcpkg` in a checkout, which is what it builds.
# Needs cargo on the machine that builds.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

# A C library: programs that are built for debugging link the same one.
set(VCPKG_BUILD_TYPE release)
if(VCPKG_LIBRARY_LINKAGE STREQUAL "dynamic")
  set(linkage shared)
else()
  set(linkage static)
endif()

vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DSUPERHELIX_LINKAGE=${linkage}
    -DSUPERHELIX_BUILD_EXAMPLES=OFF
    -DSUPERHELIX_INSTALL=ON
    -DSUPERHELIX_INSTALL_CMAKEDIR=share/superhelix
)
vcpkg_cmake_install()
vcpkg_fixup_pkgconfig()

file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/licenses")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE-MIT" "${SOURCE_PATH}/LICENSE-APACHE")
