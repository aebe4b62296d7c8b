#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/EnclosingRadius.h"
#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Records/TreeSpace.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace pointfront
{

/// True for values that have a mean: floating point (normals, angles, heights, times), those of a
/// scale (LAS extra bytes that measure something) and intensity, rgb, nir. All other integers are
/// taken for codes or counts: a mean of two classes is not a class.
bool hasMean(const Attribute& attribute);

/// An input of a representative: a record of the pool, or another representative.
struct MeanInput
{
  const std::byte* record = nullptr;
  bool original = false; ///< just the record, without the exact mean behind it
};

/// Records of representatives (FRONT-3): a record as the pool has them, whose position, columns and
/// radius can be stored, and behind it what the levels above need to be exact: the number of points
/// of the input, the mean position in steps and the means of the columns, not rounded.
/// Position  the mean of all points of the input below, rounded to the grid.
/// Columns   the mean of the same points where there is one (hasMean(); NaN does not count, normals
///           get length 1), else the value of whatever was summarised nearest to the mean.
/// One input keeps its values bit for bit, also a normal that has another length.
/// Radius    of the sphere around the stored position that holds all those points; it also holds
///           the spheres of the representatives below. Rounded up.
/// Threads   one instance a thread.
/// Source    Richter & Doellner 2010, section 3.1.
class MeanRecord
{
public:
  /// `pooled` ends with enclosingRadiusAttribute().
  MeanRecord(const TreeSpace& space, const AttributeSchema& pooled);

  /// Bytes of a representative; its record as in the pool comes first.
  std::size_t bytes() const { return meansOffset_ + means_.size() * sizeof(double); }

  /// Writes bytes() to `out`. All inputs lie in one cell of the tree, and so does the result.
  void summarise(
    const std::vector<MeanInput>& inputs, std::size_t begin, std::size_t end, std::byte* out);
  /// A value that was measured around a point does not hold for the representative of its cell,
  /// even if the point is alone there.
  void forgetSplat(std::byte* record) const;

private:
  struct Mean
  {
    std::size_t offset = 0; ///< offset of the component in the record
    ScalarType type = ScalarType::UInt8;
    bool normal = false; ///< the first of three components that have length 1 together
    double scale = 1.0; ///< between stored numbers and meant ones
    double zero = 0.0; ///< meaning of a stored 0
    double sum = 0.0;
    double weight = 0.0;
  };
  double weightOf(const MeanInput& input) const;
  glm::dvec3 centreOf(const MeanInput& input) const;
  TreePosition onGrid(const glm::dvec3& centre) const;
  template <typename T>
  void addMean(
    Mean& mean, std::size_t exactOffset, const MeanInput* first, const MeanInput* last) const;
  void addMeans(const MeanInput* first, const MeanInput* last);
  void writeMeans(std::byte* out);
  void writeUnitNormal(std::size_t first, std::byte* out) const;
  void keep(const MeanInput& input, std::byte* out) const;

  glm::dvec3 stepLength_; ///< length of a tree step on each axis, world units
  TreePosition gridStep_; ///< tree steps between positions that can be stored
  std::size_t recordBytes_;
  std::size_t radiusOffset_;
  std::optional<std::size_t> splatOffset_; ///< offset of the byte, if there is one
  std::size_t meansOffset_; ///< behind weight and mean position
  std::vector<Mean> means_;
};

} // namespace pointfront
