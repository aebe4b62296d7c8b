#include "pointfront/Trees/PartTree.h"

namespace pointfront
{

std::vector<std::uint32_t> postOrder(const std::vector<PartNode>& nodes)
{
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < nodes.size(); ++i)
  {
    if (nodes[i].parent == PartNode::none)
    {
      open.push_back(i);
    }
  }
  std::vector<std::uint32_t> order;
  while (!open.empty()) // parents first with children from right to left, then reversed
  {
    const std::uint32_t index = open.back();
    open.pop_back();
    order.push_back(index);
    open.insert(open.end(), nodes[index].children.begin(), nodes[index].children.end());
  }
  return { order.rbegin(), order.rend() };
}

} // namespace pointfront
