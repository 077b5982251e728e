// SPDX-License-Identifier: MIT
//
// What the module of mpi_module.cc offers: plain C, so that the program loads the message passing
// library only where it was started under one.
#ifndef TOUCHSTONE_TOOLS_CAMPAIGN_MPI_MODULE_H_
#define TOUCHSTONE_TOOLS_CAMPAIGN_MPI_MODULE_H_

extern "C" {

// All functions in one table, found as the symbol "touchstone_mpi". Errors are returned, never
// fatal, as far as the library keeps to that.
struct TouchstoneMpiFunctions {
  // Joins the job: this process's number and how many there are.
  bool (*start)(int* rank, int* size);
  // Returns when the text may be reused.
  bool (*send)(int rank, const char* text, int size);
  // The size of a message that waits and where it comes from, or -1.
  int (*probe)(int* rank);
  // False when it is not whole after `seconds`: who began it is gone.
  bool (*receive)(int rank, char* text, int size, double seconds);
  // Leaves the job: in order, or, where a rank is gone, by ending all with `exit_code`.
  void (*finish)(bool in_order, int exit_code);
};

}  // extern "C"

#endif  // TOUCHSTONE_TOOLS_CAMPAIGN_MPI_MODULE_H_
