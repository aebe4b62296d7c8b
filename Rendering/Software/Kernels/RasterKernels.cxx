#include "RasterKernels.h"

#include <cstdlib>
#include <cstring>
#include <initializer_list>

namespace pointfront
{

extern const RasterKernels kernelsPortable;
#ifdef POINTFRONT_X86_KERNELS
extern const RasterKernels kernelsAVX2;
extern const RasterKernels kernelsAVX512;
#endif

const RasterKernels* rasterKernelsOf(const char* instructionSet)
{
#ifdef POINTFRONT_X86_KERNELS
  const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  if (std::strcmp(instructionSet, kernelsAVX512.instructionSet) == 0)
  {
    return wide ? &kernelsAVX512 : nullptr;
  }
  if (std::strcmp(instructionSet, kernelsAVX2.instructionSet) == 0)
  {
    return __builtin_cpu_supports("avx2") ? &kernelsAVX2 : nullptr;
  }
#endif
  return std::strcmp(instructionSet, kernelsPortable.instructionSet) == 0 ? &kernelsPortable
                                                                          : nullptr;
}

const RasterKernels& rasterKernels()
{
  static const RasterKernels& best = []() -> const RasterKernels&
  {
    const char* const wanted = std::getenv("POINTFRONT_INSTRUCTIONS");
    for (const char* const name : { wanted ? wanted : "", "AVX-512", "AVX2" })
    {
      if (const RasterKernels* const kernels = rasterKernelsOf(name))
      {
        return *kernels;
      }
    }
    return kernelsPortable;
  }();
  return best;
}

} // namespace pointfront
