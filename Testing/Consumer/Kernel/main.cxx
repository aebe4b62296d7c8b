// Uses the installed kernel and nothing else: opens a store and decodes all of its points.
#include <pointfront/Store/PointStore.h>

#include <cstdio>

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: KernelConsumer STORE\n");
    return 2;
  }
  const auto store = pointfront::PointStore::open(argv[1]);
  if (!store)
  {
    std::fprintf(stderr, "%s\n", store.error().what.c_str());
    return 1;
  }
  std::size_t points = 0;
  const pointfront::NodeIndex nodes = (*store)->hierarchy()->nodeCount();
  for (pointfront::NodeIndex node = 0; node < nodes; ++node)
  {
    const auto columns = (*store)->read(node, {});
    if (!columns)
    {
      std::fprintf(stderr, "%s\n", columns.error().what.c_str());
      return 1;
    }
    points += columns->size();
  }
  std::printf("%zu points in %u nodes\n", points, nodes);
  return 0;
}
