# LCM::lcm, LCM_GEN_EXECUTABLE and, where Java is supported, LCM_JAR. LCM's own package (1.5 and later)
# goes first; Debian's 1.3.1 has none, and its pkg-config file asks for glib's headers, not needed here.
find_package(lcm QUIET CONFIG)
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp)
find_library(LCM_LIBRARY lcm)
find_program(LCM_GEN_EXECUTABLE lcm-gen)
find_file(LCM_JAR lcm.jar PATHS /usr /usr/local PATH_SUFFIXES share/java)
mark_as_advanced(LCM_INCLUDE_DIR LCM_LIBRARY LCM_GEN_EXECUTABLE LCM_JAR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(LCM REQUIRED_VARS LCM_LIBRARY LCM_INCLUDE_DIR LCM_GEN_EXECUTABLE
  REASON_FAILURE_MESSAGE "on Debian: apt install liblcm-dev liblcm-bin")
if(LCM_FOUND AND TARGET lcm AND NOT TARGET LCM::lcm)
  add_library(LCM::lcm ALIAS lcm)
elseif(LCM_FOUND AND NOT TARGET LCM::lcm)
  add_library(LCM::lcm UNKNOWN IMPORTED)
  set_target_properties(LCM::lcm PROPERTIES IMPORTED_LOCATION "${LCM_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${LCM_INCLUDE_DIR}")  # imported, so SYSTEM
endif()
