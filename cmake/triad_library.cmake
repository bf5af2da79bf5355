# A root for includes that holds one folder alone: #include "NAME/..." finds what lies in FOLDER, and nothing else.
function(triad_include_root target visibility name folder)
  set(root ${PROJECT_BINARY_DIR}/include/${name})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${folder} ${root}/${name} SYMBOLIC)
  target_include_directories(${target} ${visibility} ${root})
endfunction()

# triad_library(NAME [ROOMS room...] [EXTERNAL lib...])
# One folder, one static library triad_NAME with an include root of its own. ROOMS are the folders whose headers this one
# includes, itself or by their headers; links are private, so that an include of any other folder does not compile.
function(triad_library name)
  cmake_parse_arguments(arg "" "" "ROOMS;EXTERNAL" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/(main|counted_new).cpp$") # of programs alone
  add_library(triad_${name} STATIC ${sources})
  # So that libtriad.so and the Python module can be made of it, and show nothing of it.
  set_target_properties(triad_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  list(TRANSFORM arg_ROOMS PREPEND triad_ OUTPUT_VARIABLE rooms)
  target_link_libraries(triad_${name} PRIVATE triad_options triad_border ${rooms} ${arg_EXTERNAL})
  triad_include_root(triad_${name} PUBLIC ${name} ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()

# triad_uses(TARGET ROOM...): the same for programs and tests, whose memory is counted, but under the thread sanitizer, which has a
# `new` of its own that no other may replace.
function(triad_uses target)
  list(TRANSFORM ARGN PREPEND triad_ OUTPUT_VARIABLE rooms)
  target_link_libraries(${target} PRIVATE triad_options triad_border ${rooms})
  if("base" IN_LIST ARGN AND NOT TRIAD_SANITIZE STREQUAL "thread")
    target_link_libraries(${target} PRIVATE triad_counted_new)
  endif()
endfunction()

# triad_builds_soon(TARGET...): for what hardly takes time in a run, but much to compile (command lines, JSON, tests): two thirds of it.
function(triad_builds_soon)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()
