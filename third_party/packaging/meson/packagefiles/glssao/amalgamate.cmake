# SPDX-License-Identifier: MIT
# cmake -DSOURCE=folder -DBUILD=folder -DOUTPUT=folder -P amalgamate.cmake: writes glssao.c and glssao.h to OUTPUT.
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} -DGLSSAO_BUILD_EXAMPLES=OFF -DGLSSAO_BUILD_TESTS=OFF)
run(${CMAKE_COMMAND} --build ${BUILD} --target glssao-amalgamation)
file(COPY ${BUILD}/amalgamation/glssao.c ${BUILD}/amalgamation/glssao.h DESTINATION ${OUTPUT})
