#include "pointfront/Ingest/CommonRadii.h"

#include "pointfront/Points/SplatRadius.h"

#include <algorithm>
#include <optional>

namespace pointfront
{
namespace
{
std::optional<std::size_t> codesOf(const SourceDescription& source)
{
  const auto column = source.schema.find(splatRadiusAttribute);
  return column && source.schema[*column].bytes() == 1 ? column : std::nullopt;
}

/// A source with its codes of radii looked up in a table.
class RebasedRadii final : public PointSource
{
public:
  RebasedRadii(const PointSource& original, std::size_t column, double base)
    : original_(original)
    , description_(original.description())
    , column_(column)
  {
    codes_ = recodedRadii(description_.splatRadiusBase, base);
    description_.splatRadiusBase = base;
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return original_.chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_.chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    return recoded(original_.read(chunk, batch), batch);
  }
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override
  {
    return recoded(original_.readSteps(chunk, batch), batch);
  }

private:
  Result<void> recoded(Result<void> read, PointBatch& batch) const
  {
    if (read)
    {
      std::vector<std::byte>& column = batch.columns[column_];
      std::transform(column.begin(), column.end(), column.begin(),
        [this](std::byte code) { return codes_[std::to_integer<std::size_t>(code)]; });
    }
    return read;
  }

  const PointSource& original_;
  SourceDescription description_;
  std::size_t column_;
  std::array<std::byte, 256> codes_{};
};

/// A source as it is.
class UnchangedSource final : public PointSource
{
public:
  explicit UnchangedSource(const PointSource& original)
    : original_(original)
  {
  }
  const SourceDescription& description() const override { return original_.description(); }
  std::uint64_t chunkCount() const override { return original_.chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_.chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    return original_.read(chunk, batch);
  }
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override
  {
    return original_.readSteps(chunk, batch);
  }

private:
  const PointSource& original_;
};
} // namespace

std::array<std::byte, 256> recodedRadii(double oldBase, double newBase)
{
  std::array<std::byte, 256> codes{};
  for (std::size_t code = 0; code < codes.size(); ++code)
  {
    const float radius = decodeSplatRadius(static_cast<std::uint8_t>(code), oldBase);
    codes[code] = static_cast<std::byte>(encodeSplatRadius(radius, newBase));
  }
  return codes;
}

CommonRadii commonRadii(const std::vector<std::unique_ptr<PointSource>>& sources)
{
  double largest = 0.0;
  bool differ = false;
  std::optional<double> first;
  for (const auto& source : sources)
  {
    if (codesOf(source->description()))
    {
      const double base = source->description().splatRadiusBase;
      first = first.value_or(base);
      differ = differ || base != *first;
      largest = std::max(largest, base);
    }
  }
  CommonRadii common;
  if (!differ)
  {
    return common;
  }
  for (const auto& source : sources)
  {
    const SourceDescription& description = source->description();
    const auto column = codesOf(description);
    if (!column || description.splatRadiusBase == largest)
    {
      common.sources.push_back(std::make_unique<UnchangedSource>(*source));
      continue;
    }
    if (description.splatRadiusBase == 0.0)
    {
      common.warnings.push_back("'" + description.path +
        "' does not say what its splat radii are "
        "multiples of; they are stored as unknown.");
    }
    common.sources.push_back(std::make_unique<RebasedRadii>(*source, *column, largest));
  }
  return common;
}

} // namespace pointfront
