#pragma once

#include "pointfront/Points/PointSink.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Writes points as text: one line a point, `x y z` and then every attribute of the schema in its
/// order, separated by one blank. The first line names the columns and starts with "# "; a
/// component of an attribute with several is "name[0]", of rgb "red", "green", "blue", of normal
/// "nx", "ny", "nz". As CSV: commas, and names without the "# ".
/// Digits    coordinates: as many decimals as the grid needs to be found again exactly; integers
///           as integers; float32 with 9 and float64 with 17 significant digits at most, the
///           shortest text that reads back to the same value. Scaled attributes in world units.
/// Errors    as in PointSink.
/// Threads   one thread.
class XYZWriter final : public PointSink
{
public:
  enum class Style
  {
    Blanks,
    CSV
  };
  explicit XYZWriter(std::string path, Style style = Style::Blanks);
  ~XYZWriter() override;
  XYZWriter(const XYZWriter&) = delete;
  XYZWriter& operator=(const XYZWriter&) = delete;

  std::string path() const override;
  Result<void> begin(const SinkDescription& description) override;
  Result<void> append(const PointBatch& batch) override;
  Result<void> finish() override;
  std::vector<std::string> findings() const override; ///< names that FieldNames changes

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace pointfront
