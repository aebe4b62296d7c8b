#include "Program.h"

#include <csignal>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

int main(int argc, char** argv)
{
  // A limit on the size of files (ulimit -f) is an error of write(), which says what was needed;
  // left to itself the signal would end the process and leave temporary files.
  std::signal(SIGXFSZ, SIG_IGN);
#if defined(__GLIBC__)
  // Points of nodes come and go all the time. Left to itself malloc() raises this value with each
  // large block that is freed, up to 32 MiB, and what then is free inside its heaps stays with the
  // process, beside --memory.
  constexpr int ownPagesFrom = 64 << 10; // bytes of a block
  mallopt(M_MMAP_THRESHOLD, ownPagesFrom + 4096);
#endif
  pointfront::Program program;
  return program.run(argc, argv);
}
