# deixis_message_library(NAME lcmtypes SRCS deixis_hand_t.lcm ...)
#
# Generates from the .lcm files, all as part of the default build:
#   <build>/include/lcmtypes_cpp/<package>/<name>.hpp   C++, target deixis_<NAME>, alias deixis::<NAME>
#   <build>/include/lcmtypes_cpp/deixis/message_types.hpp   names every type once, for tests and tools
#   <build>/python/<package>/                           Python 3
#   <build>/java/deixis_types.jar                       Java, where a JDK and LCM's jar are present
# and the rules that install them. A file is named <package>_<struct>.lcm.
include_guard(GLOBAL)
include(DeixisJava)
set(DEIXIS_MESSAGES_SCRIPT_DIR "${CMAKE_CURRENT_LIST_DIR}")

function(deixis_message_library)
  cmake_parse_arguments(ARG "" "NAME" "SRCS" ${ARGN})
  list(TRANSFORM ARG_SRCS PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" OUTPUT_VARIABLE files)
  # A package line that changes moves the output, so the build has to be configured anew.
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
  deixis_message_names(types ${files})
  deixis_cpp_messages(${ARG_NAME} "${files}" "${types}")
  deixis_python_messages(${ARG_NAME} "${files}" "${types}")
  deixis_java_messages(${ARG_NAME} "${files}" "${types}")
  set_target_properties(deixis_${ARG_NAME} PROPERTIES DEIXIS_LCM_FILES "${files}")
  install(FILES ${files} DESTINATION ${CMAKE_INSTALL_DATADIR}/deixis/lcmtypes)
endfunction()

# deixis_wire_layouts(sources deixis_lcmtypes): the C++ file, made in this folder's part of the build, with the
# table that common/messages checks the types of that library by.
function(deixis_wire_layouts out library)
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
  get_target_property(files ${library} DEIXIS_LCM_FILES)
  set(root "${CMAKE_SOURCE_DIR}/scripts/python")
  file(GLOB generator CONFIGURE_DEPENDS "${root}/deixis_schema/*.py")
  set(table "${CMAKE_CURRENT_BINARY_DIR}/wire_layouts.cpp")
  add_custom_command(OUTPUT "${table}"
    COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${root}" PYTHONDONTWRITEBYTECODE=1
            "${Python3_EXECUTABLE}" -m deixis_schema.wire_layouts --output "${table}" ${files}
    DEPENDS ${files} ${generator} COMMENT "Wire layouts" VERBATIM)
  set(${out} "${table}" PARENT_SCOPE)
endfunction()

# <package>/<struct> of each file, in the order of the files.
function(deixis_message_names out)
  foreach(file IN LISTS ARGN)
    file(STRINGS "${file}" line REGEX "^package +[a-z0-9_]+;" LIMIT_COUNT 1)
    string(REGEX REPLACE "^package +([a-z0-9_]+).*" "\\1" package "${line}")
    get_filename_component(stem "${file}" NAME_WE)
    if(NOT stem MATCHES "^${package}_(.+)$" OR package STREQUAL "")
      message(FATAL_ERROR "${file}: the file name must be <package>_<struct>.lcm; its package is '${package}'")
    endif()
    string(REGEX REPLACE "^${package}_" "" struct "${stem}")
    list(APPEND types "${package}/${struct}")
  endforeach()
  set(${out} "${types}" PARENT_SCOPE)
endfunction()

function(deixis_cpp_messages name files types)
  set(root "${CMAKE_BINARY_DIR}/include/lcmtypes_cpp")
  foreach(file type IN ZIP_LISTS files types)
    set(header "${root}/${type}.hpp")
    # c++11: constants are constexpr, thus usable by reference without a definition.
    add_custom_command(OUTPUT "${header}"
      COMMAND "${LCM_GEN_EXECUTABLE}" --cpp --cpp-std=c++11 --cpp-hpath "${root}" "${file}"
      DEPENDS "${file}" COMMENT "C++ type ${type}" VERBATIM)
    list(APPEND headers "${header}")
    string(REPLACE "/" "::" cpp_type "${type}")
    string(REPLACE "/" "." lcm_type "${type}")
    string(APPEND includes "#include \"${type}.hpp\"\n")
    string(APPEND visits "  visit(MessageType<::${cpp_type}>{\"${lcm_type}\"});\n")
  endforeach()
  configure_file("${DEIXIS_MESSAGES_SCRIPT_DIR}/message_types.hpp.in" "${root}/deixis/message_types.hpp" @ONLY)

  set(target deixis_${name})
  add_custom_target(${target}_headers ALL DEPENDS ${headers} COMMENT "C++ types")
  add_library(${target} INTERFACE)
  add_library(deixis::${name} ALIAS ${target})
  add_dependencies(${target} ${target}_headers)
  target_include_directories(${target} SYSTEM INTERFACE "${root}")
  target_link_libraries(${target} INTERFACE LCM::lcm)
  # A folder of their own: robots have another bot_core on their include path.
  install(DIRECTORY "${root}/" DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/deixis/lcmtypes)
endfunction()

function(deixis_python_messages name files types)
  set(root "${CMAKE_BINARY_DIR}/python")
  deixis_packages(packages ${types})
  set(stamp "${CMAKE_CURRENT_BINARY_DIR}/${name}_python.stamp")
  set(script "${DEIXIS_MESSAGES_SCRIPT_DIR}/GeneratePythonTypes.cmake")
  add_custom_command(OUTPUT "${stamp}"
    COMMAND "${CMAKE_COMMAND}" "-DLCM_GEN=${LCM_GEN_EXECUTABLE}" "-DROOT=${root}" "-DPACKAGES=${packages}"
            "-DFILES=${files}" -P "${script}"
    COMMAND "${CMAKE_COMMAND}" -E touch "${stamp}"
    DEPENDS ${files} "${script}" COMMENT "Python types" VERBATIM)
  add_custom_target(deixis_${name}_python ALL DEPENDS "${stamp}")
  foreach(package IN LISTS packages)
    install(DIRECTORY "${root}/${package}" DESTINATION lib/deixis/python
            PATTERN __pycache__ EXCLUDE)
  endforeach()
endfunction()

function(deixis_java_messages name files types)
  deixis_has_java(has_java)
  if(NOT has_java)
    message(STATUS "Java types and scripts/deixis spy: left out, for want of a JDK (javac, jar) or LCM's lcm.jar "
                   "(on Debian: default-jdk-headless, liblcm-java)")
    return()
  endif()
  set(root "${CMAKE_BINARY_DIR}/java")
  set(jar "${root}/deixis_types.jar")
  list(TRANSFORM types REPLACE "^(.+)$" "${root}/src/\\1.java" OUTPUT_VARIABLE sources)
  add_custom_command(OUTPUT "${jar}"
    COMMAND "${CMAKE_COMMAND}" -E rm -rf "${root}/src" "${root}/classes"
    COMMAND "${LCM_GEN_EXECUTABLE}" --java --jpath "${root}/src" ${files}
    COMMAND "${Java_JAVAC_EXECUTABLE}" --release 11 -encoding UTF-8 -nowarn -cp "${LCM_JAR}"
            -d "${root}/classes" ${sources}
    COMMAND "${Java_JAR_EXECUTABLE}" cf "${jar}" -C "${root}/classes" .
    DEPENDS ${files} COMMENT "Java types" VERBATIM)
  add_custom_target(deixis_${name}_java ALL DEPENDS "${jar}")
  install(FILES "${jar}" DESTINATION ${CMAKE_INSTALL_DATADIR}/java)
endfunction()

# The packages that occur in a list of <package>/<struct>.
function(deixis_packages out)
  list(TRANSFORM ARGN REPLACE "/.*" "" OUTPUT_VARIABLE packages)
  list(REMOVE_DUPLICATES packages)
  set(${out} "${packages}" PARENT_SCOPE)
endfunction()
