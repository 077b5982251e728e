// SPDX-License-Identifier: MIT
#ifndef TOUCHSTONE_TESTS_TESTING_ALLOCATIONS_H_
#define TOUCHSTONE_TESTS_TESTING_ALLOCATIONS_H_

namespace touchstone::testing {

// How often operator new was called so far, by any thread. A test that calls this is linked with an
// operator new that counts.
long AllocationCount();

}  // namespace touchstone::testing

#endif  // TOUCHSTONE_TESTS_TESTING_ALLOCATIONS_H_
