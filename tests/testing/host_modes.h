// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_TESTING_HOST_MODES_H_
#define TOUCHSTONE_TESTS_TESTING_HOST_MODES_H_

#include <cfenv>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace touchstone::testing {

// Sets the thread's rounding mode, and whether denormals are flushed to zero, for a scope.
class HostMode {
 public:
  HostMode(int rounding, bool flush) {
#if defined(__SSE2__)
    control_ = _mm_getcsr();
#endif
    rounding_ = std::fegetround();
    std::fesetround(rounding);
#if defined(__SSE2__)
    if (flush) _mm_setcsr(_mm_getcsr() | kFlush);
#else
    static_cast<void>(flush);
#endif
  }
  ~HostMode() {
    std::fesetround(rounding_);
#if defined(__SSE2__)
    _mm_setcsr(control_);
#endif
  }
  HostMode(const HostMode&) = delete;
  HostMode& operator=(const HostMode&) = delete;

  static constexpr bool CanFlush() {
#if defined(__SSE2__)
    return true;
#else
    return false;
#endif
  }

 private:
  static constexpr unsigned kFlush = 0x8040;  // results, operands
  int rounding_;
  unsigned control_ = 0;
};

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_TESTING_HOST_MODES_H_
