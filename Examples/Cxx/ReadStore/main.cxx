// Reads a store with the kernel alone: the shape of its tree, and the mean of one attribute.
//   ReadStore STORE.pfront ATTRIBUTE
#include <pointfront/Store/PointStore.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <vector>

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::fprintf(stderr, "usage: ReadStore STORE.pfront ATTRIBUTE\n");
    return 2;
  }
  const auto store = pointfront::PointStore::open(argv[1]);
  if (!store)
  {
    std::fprintf(stderr, "%s\n", store.error().what.c_str());
    return 1;
  }
  const pointfront::StoreDescription& description = (*store)->description();
  const auto column = description.schema.find(argv[2]);
  if (!column || description.schema[*column].type != pointfront::ScalarType::UInt16)
  {
    std::fprintf(stderr, "%s: no 16-bit attribute '%s'\n", argv[1], argv[2]);
    return 1;
  }

  // Only the column that is named is read from the disk.
  const pointfront::ColumnSelection selection{ static_cast<std::uint32_t>(*column) };
  const pointfront::Hierarchy& hierarchy = *(*store)->hierarchy();
  std::vector<std::uint64_t> pointsOfLevel(description.levels);
  double sum = 0.0;
  for (pointfront::NodeIndex i = 0; i < hierarchy.nodeCount(); ++i)
  {
    const auto columns = (*store)->read(i, selection);
    if (!columns)
    {
      std::fprintf(stderr, "%s\n", columns.error().what.c_str());
      return 1;
    }
    pointsOfLevel.at(hierarchy.node(i).level) += columns->size();
    for (std::size_t point = 0; point < columns->size(); ++point)
    {
      std::uint16_t value = 0;
      std::memcpy(&value, columns->columns[0].data() + point * sizeof value, sizeof value);
      sum += value;
    }
  }
  std::printf("%llu points\n", static_cast<unsigned long long>(description.pointCount));
  for (std::size_t level = 0; level < pointsOfLevel.size(); ++level)
  {
    std::printf(
      "level %zu: %llu points\n", level, static_cast<unsigned long long>(pointsOfLevel[level]));
  }
  std::printf("mean %s: %.2f\n", argv[2], sum / static_cast<double>(description.pointCount));
  return 0;
}
