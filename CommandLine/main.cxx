#include "Program.h"

int main(int argc, char** argv)
{
  pointfront::Program program;
  return program.run(argc, argv);
}
