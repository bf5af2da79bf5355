# TRIAD_SANITIZE: the host code under Clang's sanitizers. Kernels are compiled by drivers and are not instrumented, nor is any
# library; what is known of these is suppressed by name, in tests/sanitizers/.
if(NOT TRIAD_SANITIZE)
  return()
endif()
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -gline-tables-only") # nothing else: asserts count
set(instrument -fsanitize=${TRIAD_SANITIZE} -fno-omit-frame-pointer)
target_compile_options(triad_options INTERFACE ${instrument} -fsanitize-ignorelist=${PROJECT_SOURCE_DIR}/tests/sanitizers/ignored.txt)
target_link_options(triad_options INTERFACE ${instrument})
if(TRIAD_SANITIZE MATCHES address)
  # libFuzzer's counters, for the targets of tests/fuzz; other programs carry them and do nothing with them.
  target_compile_options(triad_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
# What the sanitizers are told is part of every program, so that children have it too.
add_library(triad_sanitizer_options OBJECT ${PROJECT_SOURCE_DIR}/tests/sanitizers/options.cpp)
target_link_libraries(triad_options INTERFACE
  $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:$<TARGET_OBJECTS:triad_sanitizer_options>>)
