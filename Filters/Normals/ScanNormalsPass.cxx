#include "ScanNormalsPass.h"

#include "ClassChoice.h"
#include "ScanNormals.h"

#include "pointfront/Neighbourhood/PointColumn.h"
#include "pointfront/Neighbourhood/PointReading.h"

#include <cstring>

namespace pointfront
{
namespace
{
/// Normals of one chunk.
class ChunkNormals
{
public:
  ChunkNormals(const PointSources& sources, const ClassSet& classes,
    std::shared_ptr<std::atomic<std::uint64_t>> without)
    : classes_(classes)
    , without_(std::move(without))
  {
    for (const auto& source : sources)
    {
      descriptions_.push_back(source->description());
      counted_.emplace_back(source->chunkCount());
    }
  }

  void compute(const SourceChunk& chunk, const PointBatch& batch, std::byte* values) const
  {
    std::vector<std::uint8_t> classes;
    readClasses(descriptions_[chunk.source].schema, batch, classes);
    std::vector<std::size_t> taking;
    std::vector<glm::dvec3> positions;
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      if (classes_[classes[i]] && hasPlace(batch.positions[i]))
      {
        taking.push_back(i);
        positions.push_back(batch.positions[i]);
      }
    }
    std::vector<PackedNormal> normals;
    scanNormals(positions, normals);
    std::memset(values, 0, batch.size() * sizeof(PackedNormal));
    std::uint64_t without = 0;
    const glm::dvec3* const scanner = descriptions_[chunk.source].scanner(chunk.chunk);
    for (std::size_t i = 0; i < taking.size(); ++i)
    {
      const PackedNormal normal =
        scanner != nullptr ? facing(normals[i], positions[i], *scanner) : normals[i];
      without += normal == PackedNormal(0) ? 1 : 0;
      std::memcpy(values + taking[i] * sizeof normal, &normal, sizeof normal);
    }
    if (without > 0 && !counted_[chunk.source][chunk.chunk].exchange(true))
    {
      *without_ += without;
    }
  }

private:
  ClassSet classes_;
  std::shared_ptr<std::atomic<std::uint64_t>> without_;
  // By source, of the originals: the columns of the batch come first in the new schema too.
  std::vector<SourceDescription> descriptions_;
  /// By source and chunk: a build reads its sources more than once.
  mutable std::vector<std::vector<std::atomic<bool>>> counted_;
};
} // namespace

ScanNormalsPass::ScanNormalsPass(std::optional<std::vector<std::uint8_t>> classes)
  : classes_(std::move(classes))
  , without_(std::make_shared<std::atomic<std::uint64_t>>(0))
{
}

Result<PointSources> ScanNormalsPass::apply(PointSources sources, const PassResources&) const
{
  for (const auto& source : sources)
  {
    if (source->description().inTreeOrder)
    {
      return makeError(Error::Kind::BadArgument,
        source->description().path +
          ": the points of a store have left the order of the scan, "
          "which normals from scan lines need; take normals by PCA, or the original files");
    }
  }
  const Result<ClassSet> classes = chosenClasses(sources, classes_);
  if (!classes)
  {
    return classes.error();
  }
  *without_ = 0;
  const auto normals = std::make_shared<const ChunkNormals>(sources, *classes, without_);
  const ValueSource values = [normals](const SourceChunk& chunk, const PointBatch& batch,
                               std::byte* out) -> Result<void>
  {
    normals->compute(chunk, batch, out);
    return {};
  };
  return withAttributes(std::move(sources), { normalAttribute() }, values);
}

std::vector<std::string> ScanNormalsPass::findings() const
{
  if (*without_ == 0)
  {
    return {};
  }
  if (*without_ == 1)
  {
    return { "1 point has no normal: no scan line beside its own has a point to make a triangle "
             "with." };
  }
  return { std::to_string(*without_) +
    " points have no normal: no scan line beside theirs has a point to make a triangle with." };
}

} // namespace pointfront
