#include "LanesAVX512.h"

#include "ProjectionLoops.h"
#include "SplatLoops.h"

namespace pointfront
{

extern const RasterKernels kernelsAVX512;
const RasterKernels kernelsAVX512 = { "AVX-512", project, drawSquares, loadRadii, loadNormals,
  setUp, drawSplats, addSplats };

} // namespace pointfront
