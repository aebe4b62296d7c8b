#pragma once

#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoreWriter.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// A small store whose every byte follows from its options: nodes of points around a few places,
/// a column of every scalar type. The same options give the same points on every machine.
///
/// Tree     0 (layer 0) has the children 2 and 3, 2 has 5 and 6;
///          1 (layer 1, no points of its own) has the child 4.
struct SampleStore
{
  std::vector<Node> nodes;
  std::vector<NodeIndex> roots;
  std::vector<NodeColumns> points; ///< points of node i
  StoreDescription description; ///< as a builder gives it to commit()
};

/// `pointsPerNode` is what each node has but node 1, which has none.
SampleStore makeSample(std::uint32_t pointsPerNode, std::uint64_t seed = 1);

/// Appends every node in the order of the table and commits.
Result<void> writeSample(const SampleStore& sample, StoreWriter& writer);
/// Writes to that path and fails the test when it cannot.
void writeSample(const SampleStore& sample, const std::string& path);

ColumnSelection everyColumn(const AttributeSchema& schema);
std::vector<std::byte> fileBytes(const std::string& path);
void writeFile(const std::string& path, const std::vector<std::byte>& bytes);
/// A path in a folder of this process, which is removed at its end; made of the running test's
/// name and `name`.
std::string temporaryPath(const std::string& name);

} // namespace pointfront
