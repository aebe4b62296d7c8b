#include "LanesAVX2.h"

#include "ProjectionLoops.h"
#include "SplatLoops.h"

namespace pointfront
{

extern const RasterKernels kernelsAVX2;
const RasterKernels kernelsAVX2 = { "AVX2", project, drawSquares, loadRadii, loadNormals, setUp,
  drawSplats, addSplats };

} // namespace pointfront
