#include "pointfront/Ingest/ReferenceSystem.h"

#include "pointfront/Points/GpsTimes.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{
constexpr const char* projectionOwner = "LASF_Projection";

/// The system that a source states, comparable: WKT, else its projection records byte by byte.
std::vector<std::byte> statedSystem(const SourceDescription& source)
{
  std::vector<std::byte> stated;
  const auto add = [&](const void* data, std::size_t bytes)
  {
    const auto* first = static_cast<const std::byte*>(data);
    stated.insert(stated.end(), first, first + bytes);
  };
  if (!source.crsWkt.empty())
  {
    add(source.crsWkt.data(), source.crsWkt.size());
    return stated;
  }
  for (const MetadataRecord& record : source.metadata)
  {
    if (record.owner == projectionOwner)
    {
      add(&record.id, sizeof(record.id));
      add(record.payload.data(), record.payload.size());
    }
  }
  return stated;
}
} // namespace

Result<ReferenceSystem> commonReferenceSystem(
  const std::vector<std::unique_ptr<PointSource>>& sources)
{
  ReferenceSystem system;
  const SourceDescription* first = nullptr; // that states one
  std::vector<std::byte> known;
  std::vector<std::string> silent;
  for (const auto& source : sources)
  {
    const SourceDescription& description = source->description();
    const std::vector<std::byte> stated = statedSystem(description);
    if (stated.empty())
    {
      silent.push_back(description.path);
      continue;
    }
    if (first == nullptr)
    {
      first = &description;
      known = stated;
    }
    else if (stated != known)
    {
      return makeError(Error::Kind::BadArgument,
        "'" + first->path + "' and '" + description.path +
          "' are in different coordinate reference systems; build one store for each");
    }
  }
  if (first != nullptr)
  {
    system.wkt = first->crsWkt;
    system.metadata = first->metadata;
    for (const std::string& path : silent)
    {
      system.warnings.push_back("'" + path +
        "' names no coordinate reference system; it is taken to be that of '" + first->path + "'.");
    }
  }
  else if (!sources.empty())
  {
    system.metadata = sources.front()->description().metadata;
  }
  return system;
}

void ReferenceSystem::keepTimes(const std::vector<std::unique_ptr<PointSource>>& sources,
  const std::function<bool(std::size_t)>& givesPoints)
{
  GatheredTimes times;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    const SourceDescription& description = sources[s]->description();
    if (givesPoints(s))
    {
      times.add(description.path, description.schema, description.metadata);
    }
  }
  times.keepIn(metadata);
  if (std::string warning = times.warning(); !warning.empty())
  {
    warnings.push_back(std::move(warning));
  }
}

} // namespace pointfront
