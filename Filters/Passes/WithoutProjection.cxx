#include "KnownSystems.h"

#include "LeftOut.h"

#include <vector>

namespace pointfront
{
namespace
{
constexpr const char* option = "POINTFRONT_PROJECTION";

class NoCoordinateSystems final : public CoordinateSystems
{
public:
  Result<CoordinateSystem> parse(const std::string&) const override
  {
    return leftOut("coordinate reference systems", option);
  }
  Result<CoordinateSystem> fromGeoKeys(const GeoKeys&, std::vector<std::string>&) const override
  {
    return leftOut("coordinate reference systems", option);
  }
  bool equivalent(
    const CoordinateSystem& a, const CoordinateSystem& b, bool /*horizontally*/) const override
  {
    return a.wkt == b.wkt;
  }
  Result<std::unique_ptr<CoordinateTransform>> transform(
    const CoordinateSystem&, const CoordinateSystem&, const Bounds&) const override
  {
    return leftOut("transforming coordinates", option);
  }
};

/// The system that an input states: WKT, else the records that hold GeoTIFF keys.
std::string statedSystem(const SourceDescription& description)
{
  std::string stated = description.crsWkt;
  for (const MetadataRecord& record : description.metadata)
  {
    if (description.crsWkt.empty() && record.owner == "LASF_Projection")
    {
      stated += std::to_string(record.id) + ":";
      stated.append(reinterpret_cast<const char*>(record.payload.data()), record.payload.size());
    }
  }
  return stated;
}

class SameSystemPass final : public AttributePass
{
public:
  double reach() const override { return 0.0; }
  Result<PointSources> apply(PointSources sources, const PassResources&) const override
  {
    const SourceDescription* first = nullptr;
    for (const auto& source : sources)
    {
      const SourceDescription& description = source->description();
      if (statedSystem(description).empty())
      {
        continue;
      }
      first = first != nullptr ? first : &description;
      if (statedSystem(description) != statedSystem(*first))
      {
        return leftOut(first->path + " and " + description.path +
            " may be in two coordinate reference systems, and comparing or transforming them needs "
            "PROJ",
          option);
      }
    }
    return sources;
  }
  std::vector<std::string> findings() const override
  {
    return {
      "This build was made without PROJ: coordinates and what inputs say of their coordinate "
      "reference system are passed on unchecked."
    };
  }
  bool findsInputs() const override { return true; }
};
} // namespace

std::shared_ptr<const CoordinateSystems> knownSystems()
{
  return std::make_shared<NoCoordinateSystems>();
}

Result<std::unique_ptr<AttributePass>> oneSystemPass(const PassChoice& choice)
{
  if (!choice.targetCrs.empty() || !choice.assumedCrs.empty())
  {
    return leftOut("naming a coordinate reference system", option);
  }
  return std::unique_ptr<AttributePass>(std::make_unique<SameSystemPass>());
}

Result<std::unique_ptr<PointSink>> sinkInSystem(std::unique_ptr<PointSink> /*sink*/,
  const std::string& /*target*/, const std::string& /*assumedName*/)
{
  return leftOut("writing points in another coordinate reference system", option);
}

} // namespace pointfront
