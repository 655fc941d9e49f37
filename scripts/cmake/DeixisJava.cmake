# What is made in Java: left out where there is no JDK or no lcm.jar.
include_guard(GLOBAL)

# deixis_has_java(OUT): true where Java can be built; sets Java_JAVAC_EXECUTABLE and its like in any case.
macro(deixis_has_java out)
  find_package(Java QUIET COMPONENTS Development)
  set(${out} FALSE)
  if(Java_JAVAC_EXECUTABLE AND Java_JAR_EXECUTABLE AND LCM_JAR)
    set(${out} TRUE)
  endif()
endmacro()

# deixis_jar(NAME deixis_spy SRCS ... JARS ... [DEPENDS targets])
#
# <build>/java/<NAME>.jar from the sources, with the jars on the class path, as part of the default
# build: target <NAME>_jar.
function(deixis_jar)
  cmake_parse_arguments(ARG "" "NAME" "SRCS;JARS;DEPENDS" ${ARGN})
  list(TRANSFORM ARG_SRCS PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
  set(jar "${CMAKE_BINARY_DIR}/java/${ARG_NAME}.jar")
  set(classes "${CMAKE_CURRENT_BINARY_DIR}/${ARG_NAME}_classes")
  string(REPLACE ";" ":" class_path "${ARG_JARS}")
  if(DEIXIS_WARNINGS_AS_ERRORS)
    set(werror -Werror)
  endif()
  add_custom_command(OUTPUT "${jar}"
    COMMAND "${CMAKE_COMMAND}" -E rm -rf "${classes}"
    COMMAND "${Java_JAVAC_EXECUTABLE}" --release 11 -encoding UTF-8 -Xlint:all ${werror}
            -cp "${class_path}" -d "${classes}" ${ARG_SRCS}
    COMMAND "${Java_JAR_EXECUTABLE}" cf "${jar}" -C "${classes}" .
    DEPENDS ${ARG_SRCS} ${ARG_JARS} ${ARG_DEPENDS} COMMENT "Java ${ARG_NAME}" VERBATIM)
  add_custom_target(${ARG_NAME}_jar ALL DEPENDS "${jar}")
endfunction()
