# The functions that build everything: deixis_library, deixis_service, deixis_program, deixis_test,
# deixis_benchmark, deixis_fuzzer. deixis_message_library stands in DeixisMessages.cmake.

# deixis_library(NAME skin SRCS a.cpp KERNEL_SRCS k.cpp LINK_LIBS deixis::images PRIVATE_LIBS yaml-cpp)
# makes target deixis_<NAME> with alias deixis::<NAME>. A library without sources is header-only.
function(deixis_library)
  cmake_parse_arguments(ARG "" "NAME" "SRCS;KERNEL_SRCS;LINK_LIBS;PRIVATE_LIBS" ${ARGN})
  set(target deixis_${ARG_NAME})
  if(ARG_SRCS OR ARG_KERNEL_SRCS)
    add_library(${target} STATIC ${ARG_SRCS} ${ARG_KERNEL_SRCS})
    target_link_libraries(${target} PUBLIC deixis_flags ${ARG_LINK_LIBS} PRIVATE ${ARG_PRIVATE_LIBS})
    deixis_kernel_flags(${ARG_KERNEL_SRCS})
  else()
    add_library(${target} INTERFACE)
    target_link_libraries(${target} INTERFACE deixis_flags ${ARG_LINK_LIBS})
  endif()
  add_library(deixis::${ARG_NAME} ALIAS ${target})
endfunction()

function(deixis_kernel_flags)
  if(ARGN)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${DEIXIS_KERNEL_FLAGS}")
  endif()
endfunction()

# deixis_service(NAME hand_tracker CORE_SRCS core/a.cpp CORE_LIBS deixis::skin SRCS hand_tracker_service.cpp LIBS ...)
# makes three targets: deixis_<NAME>_core (the algorithm: no LCM), deixis_<NAME>_service (messages in
# and out), and the program deixis-<name> from main.cpp. The service library can be hosted elsewhere.
function(deixis_service)
  cmake_parse_arguments(ARG "" "NAME" "CORE_SRCS;CORE_KERNEL_SRCS;CORE_LIBS;SRCS;LIBS" ${ARGN})
  deixis_library(NAME ${ARG_NAME}_core SRCS ${ARG_CORE_SRCS} KERNEL_SRCS ${ARG_CORE_KERNEL_SRCS}
                 LINK_LIBS deixis::config ${ARG_CORE_LIBS})
  deixis_library(NAME ${ARG_NAME}_service SRCS ${ARG_SRCS}
                 LINK_LIBS deixis::${ARG_NAME}_core deixis::transport deixis::messages ${ARG_LIBS})
  deixis_program(NAME ${ARG_NAME} SRCS main.cpp LIBS deixis::${ARG_NAME}_service deixis::program)
endfunction()

# deixis_program(NAME offline SRCS main.cpp LIBS ...): the installed program deixis-<name>, underscores
# turned into dashes, in <build>/bin.
function(deixis_program)
  cmake_parse_arguments(ARG "" "NAME" "SRCS;LIBS" ${ARGN})
  string(REPLACE "_" "-" program "deixis-${ARG_NAME}")
  add_executable(${program} ${ARG_SRCS})
  target_link_libraries(${program} PRIVATE deixis_flags ${ARG_LIBS})
  set_target_properties(${program} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")
  install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

# deixis_test(NAME bus_test SRCS bus_test.cpp LINK_LIBS deixis::transport): a GoogleTest program whose
# cases ctest runs one by one.
function(deixis_test)
  cmake_parse_arguments(ARG "" "NAME;TIMEOUT" "SRCS;LINK_LIBS;ENVIRONMENT" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  add_executable(${ARG_NAME} ${ARG_SRCS})
  target_link_libraries(${ARG_NAME} PRIVATE deixis_flags ${ARG_LINK_LIBS} GTest::gmock_main)
  target_compile_definitions(${ARG_NAME} PRIVATE
    DEIXIS_SOURCE_DIR="${CMAKE_SOURCE_DIR}" DEIXIS_BINARY_DIR="${CMAKE_BINARY_DIR}")
  gtest_discover_tests(${ARG_NAME} DISCOVERY_MODE PRE_TEST
    PROPERTIES TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()

# deixis_benchmark(NAME skin_benchmark SRCS ... LINK_LIBS ...): Google Benchmark, run by hand.
function(deixis_benchmark)
  cmake_parse_arguments(ARG "" "NAME" "SRCS;LINK_LIBS" ${ARGN})
  if(NOT DEIXIS_BUILD_BENCHMARKS OR DEIXIS_SANITISE)
    return()
  endif()
  find_package(benchmark REQUIRED)
  add_executable(${ARG_NAME} ${ARG_SRCS})
  target_link_libraries(${ARG_NAME} PRIVATE deixis_flags ${ARG_LINK_LIBS} benchmark::benchmark_main)
endfunction()

# deixis_fuzzer(NAME messages_fuzzer SRCS ... LINK_LIBS ...): a libFuzzer target in <build>/fuzz.
function(deixis_fuzzer)
  cmake_parse_arguments(ARG "" "NAME" "SRCS;LINK_LIBS" ${ARGN})
  add_executable(${ARG_NAME} ${ARG_SRCS})
  target_link_libraries(${ARG_NAME} PRIVATE deixis_flags ${ARG_LINK_LIBS})
  target_compile_definitions(${ARG_NAME} PRIVATE DEIXIS_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  target_link_options(${ARG_NAME} PRIVATE -fsanitize=fuzzer)
  set_target_properties(${ARG_NAME} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/fuzz")
endfunction()
