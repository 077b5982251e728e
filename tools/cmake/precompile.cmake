# touchstone_precompile(TARGET headers...): headers that most of a target's sources include are read once. Where a
# compiler cache is at work they are not: each would undo the other.
#
# Measured (g++ 12, -O2, processor time): a source of core 3.3 s, 2.3 s with Eigen and the containers read before; a
# subcommand 12.9 s, with CLI11 and nlohmann_json 9.4 s.
# Not for -O2 of g++ 12: with them it sees overlapping copies in "literal" + std::string (as in GCC bug 105651).
option(TOUCHSTONE_PRECOMPILE "Precompile headers, for a build from nothing" OFF)

function(touchstone_precompile target)
  if(TOUCHSTONE_PRECOMPILE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()
