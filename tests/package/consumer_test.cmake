# Install the component development into a folder of its own, and build and run consumer/ on it alone.
set(folder "${BUILD}/tests/package/consumer_test")
file(REMOVE_RECURSE "${folder}")
macro(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endmacro()
run("${CMAKE_COMMAND}" --install "${BUILD}" --component development --prefix "${folder}/prefix")
run("${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${folder}/build" -G Ninja
  -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
  "-DCMAKE_PREFIX_PATH=${folder}/prefix")
run("${CMAKE_COMMAND}" --build "${folder}/build")
run("${folder}/build/column")
