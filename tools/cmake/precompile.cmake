# touchstone_precompile(TARGET headers...): headers that most of a target's sources include are read once. Where a
# compiler cache is at work they are not: each would undo the other.
#
# For the sanitizers' builds: a source of core takes 2.3 s of processor time instead of 3.3 (g++ 12, -O2). Not for
# optimised ones: with them g++ 12 sees overlapping copies in "literal" + std::string (as in GCC bug 105651).
option(TOUCHSTONE_PRECOMPILE "Precompile headers, for a build from nothing" OFF)

function(touchstone_precompile target)
  if(TOUCHSTONE_PRECOMPILE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()
