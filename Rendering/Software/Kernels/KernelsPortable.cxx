#include "LanesPortable.h"

#include "ProjectionLoops.h"
#include "SplatLoops.h"

namespace pointfront
{

extern const RasterKernels kernelsPortable;
const RasterKernels kernelsPortable = { "portable", project, drawSquares, loadRadii, loadNormals,
  setUp, drawSplats, addSplats };

} // namespace pointfront
