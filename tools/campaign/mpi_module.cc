// SPDX-License-Identifier: MIT
//
// The one file that includes MPI.
#include "touchstone/tools/campaign/mpi_module.h"

#include <mpi.h>

#include <algorithm>
#include <memory>

namespace {

constexpr int kTag = 1;

bool Start(int* rank, int* size) {
  if (MPI_Init(nullptr, nullptr) != MPI_SUCCESS) return false;
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  return MPI_Comm_rank(MPI_COMM_WORLD, rank) == MPI_SUCCESS &&
         MPI_Comm_size(MPI_COMM_WORLD, size) == MPI_SUCCESS;
}

bool Send(int rank, const char* text, int size) {
  return MPI_Send(text, size, MPI_CHAR, rank, kTag, MPI_COMM_WORLD) == MPI_SUCCESS;
}

int Probe(int* rank) {
  int waits = 0, size = -1;
  MPI_Status status;
  if (MPI_Iprobe(MPI_ANY_SOURCE, kTag, MPI_COMM_WORLD, &waits, &status) != MPI_SUCCESS ||
      waits == 0 || MPI_Get_count(&status, MPI_CHAR, &size) != MPI_SUCCESS) {
    return -1;
  }
  *rank = status.MPI_SOURCE;
  return size;
}

// A long text is fetched from its sender, and MPI_Recv would wait for ever for one that was killed.
bool Receive(int rank, char* text, int size, double seconds) {
  auto buffer = std::make_unique<char[]>(static_cast<std::size_t>(size));
  MPI_Request request;
  if (MPI_Irecv(buffer.get(), size, MPI_CHAR, rank, kTag, MPI_COMM_WORLD, &request) != MPI_SUCCESS)
    return false;
  const double end = MPI_Wtime() + seconds;
  int is_whole = 0, error = MPI_SUCCESS;
  do {
    error = MPI_Test(&request, &is_whole, MPI_STATUS_IGNORE);
  } while (error == MPI_SUCCESS && is_whole == 0 && MPI_Wtime() < end);
  if (is_whole != 0) {
    std::copy_n(buffer.get(), size, text);
  } else {
    buffer.release();  // the library may still write there
  }
  return error == MPI_SUCCESS && is_whole != 0;
}

void Finish(bool in_order, int exit_code) {
  if (in_order) {
    MPI_Finalize();
  } else {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
  }
}

}  // namespace

extern "C" const TouchstoneMpiFunctions touchstone_mpi = {Start, Send, Probe, Receive, Finish};
