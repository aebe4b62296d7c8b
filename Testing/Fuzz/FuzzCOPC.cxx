#include "BytesAsFile.h"
#include "COPCFile.h"

/// The tree and the points of a COPC file: whatever the bytes, an Error or as many points as the
/// tree says.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pointfront;
  const fuzz::BytesAsFile file(data, size);
  const auto cloud = COPCFormat().open(file.path());
  if (!cloud)
  {
    fuzz::require(!cloud.error().what.empty(), "an Error says what happened");
    return 0;
  }
  const Hierarchy& table = *(*cloud)->hierarchy();
  constexpr NodeIndex most = 64;
  for (NodeIndex i = 0; i < table.nodeCount() && i < most; ++i)
  {
    if (const auto node = (*cloud)->read(i, {}))
    {
      fuzz::require(node->size() == table.node(i).pointCount, "a node has its points");
    }
  }
  return 0;
}
