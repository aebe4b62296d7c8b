#include "Program.h"

#include <csignal>

int main(int argc, char** argv)
{
  // A limit on the size of files (ulimit -f) is an error of write(), which says what was needed;
  // left to itself the signal would end the process and leave temporary files.
  std::signal(SIGXFSZ, SIG_IGN);
  pointfront::Program program;
  return program.run(argc, argv);
}
