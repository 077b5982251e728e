# Installs the build in BUILD_DIR to a clean prefix, then configures, builds and runs the project in
# CONSUMER_DIR against it, in WORK_DIR.
#   cmake -DBUILD_DIR= -DCONSUMER_DIR= -DNAME= -DWORK_DIR= -DCONFIG= -DGENERATOR= -DCXX= -P run_consumer.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${ARGV}\n${output}")
  endif()
endfunction()

set(prefix ${WORK_DIR}/prefix)
file(REMOVE_RECURSE ${WORK_DIR})
file(MAKE_DIRECTORY ${WORK_DIR})
if(NAME STREQUAL "core")
  # The core's component alone, and no CGAL to be found.
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --config ${CONFIG} --prefix ${prefix} --component core)
  set(arguments -DCMAKE_DISABLE_FIND_PACKAGE_CGAL=TRUE)
else()
  run(${CMAKE_COMMAND} --install ${BUILD_DIR} --config ${CONFIG} --prefix ${prefix})
  set(arguments "")
endif()

# Outside the tree: nothing may be found by its place.
file(COPY ${CONSUMER_DIR}/ DESTINATION ${WORK_DIR}/source)
run(${CMAKE_COMMAND} -S ${WORK_DIR}/source -B ${WORK_DIR}/build -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${CXX}
    -DCMAKE_PREFIX_PATH=${prefix} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" ${arguments})
run(${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run(${WORK_DIR}/build/${NAME}_consumer)

if(NAME STREQUAL "core")
  file(READ ${WORK_DIR}/build/compile_commands.json commands)
  string(TOUPPER "${commands}" commands)
  if(commands MATCHES "CGAL|GMP|MPFR")
    message(FATAL_ERROR "the core's consumer is compiled with oracle code in sight: ${commands}")
  endif()
endif()
file(GLOB_RECURSE private ${prefix}/*_internal.h)
if(private)
  message(FATAL_ERROR "private headers were installed: ${private}")
endif()
