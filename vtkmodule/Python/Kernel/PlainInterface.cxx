#include "PlainInterface.h"

#include "ArraySource.h"
#include "BuildRequest.h"
#include "CloudFormats.h"
#include "LASIndexing.h"
#include "PlainColumns.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/ByteTraffic.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Disk/StopOfReads.h"
#include "pointfront/Points/ObjectClass.h"
#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/MissedRegion.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Query/SphereRegion.h"
#include "pointfront/Query/TextRegion.h"
#include "pointfront/Store/PreviewRecord.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <nlohmann/json.hpp>

#include <cstring>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>

struct PointFrontCloud
{
  std::shared_ptr<const pointfront::StoredCloud> store;
};

namespace
{

using pointfront::Error;
using pointfront::makeError;
using pointfront::Result;
using Json = nlohmann::json;

/// Bytes of a path that are no UTF-8 are replaced; null without memory.
char* textOf(const Json& answer)
{
  try
  {
    const std::string text = answer.dump(-1, ' ', false, Json::error_handler_t::replace);
    auto* const copy = static_cast<char*>(std::malloc(text.size() + 1));
    return copy != nullptr ? std::strcpy(copy, text.c_str()) : nullptr;
  }
  catch (const std::exception&)
  {
    return nullptr;
  }
}

Json errorOf(const Error& error)
{
  return { { "error", error.what }, { "cancelled", error.kind == Error::Kind::Cancelled } };
}

/// The text of what `work` answers, or of why it does not: nothing is thrown into Python.
template <typename Work>
char* answer(const Work& work)
{
  try
  {
    Result<Json> done = work();
    return textOf(done ? *done : errorOf(done.error()));
  }
  catch (const std::bad_alloc&)
  {
    return textOf(errorOf(makeError(Error::Kind::NoMemory, "the system gave no more memory")));
  }
  catch (const std::exception& problem)
  {
    return textOf(errorOf(makeError(Error::Kind::BadArgument, problem.what())));
  }
}

pointfront::ProgressFunction reporting(PointFrontProgress progress)
{
  return [progress](const pointfront::Progress& state)
  { return progress(state.phase, state.fraction) != 0; };
}

Result<std::string> canonicalPath(const std::string& path)
{
  if (pointfront::isAddress(path))
  {
    return pointfront::publicForm(path);
  }
  std::error_code code;
  pointfront::EpochAddress asked = pointfront::EpochAddress::of(path);
  const auto found = std::filesystem::canonical(pointfront::presentStorePath(asked.file), code);
  if (code)
  {
    return makeError(Error::Kind::NotFound,
      "cannot open the store " + path + ": " + code.message() + "; check the path");
  }
  asked.file = found.string();
  return asked.text();
}

bool hasDeepColours(const pointfront::StoreDescription& store)
{
  const auto rgb = store.schema.find("rgb");
  if (!rgb || *rgb >= store.ranges.size())
  {
    return false;
  }
  const auto& components = store.ranges[*rgb].components;
  return std::any_of(components.begin(), components.end(),
    [](const std::array<double, 2>& range) { return range[1] > 255.0; });
}

Json describe(const std::string& path, const pointfront::StoreDescription& store)
{
  Json attributes = Json::array();
  Json computed = Json::array();
  for (std::size_t c = 0; c < store.schema.size(); ++c)
  {
    attributes.push_back(store.schema[c].name);
    store.isComputed(c) ? computed.push_back(store.schema[c].name) : void();
  }
  Json classes = Json::array();
  const bool single = store.layers.size() == 1 && store.layers.front().name == "all";
  for (const pointfront::Layer& layer : store.layers)
  {
    single ? void() : classes.push_back({ layer.objectClass, layer.name });
  }
  return { { "path", path }, { "points", store.pointCount }, { "attributes", attributes },
    { "computed", computed }, { "classes", classes }, { "deep", hasDeepColours(store) },
    { "warnings", store.warnings } };
}

Result<void> addRegions(const PointFrontQuery& asked, pointfront::PointQuery& query)
{
  if (asked.box != nullptr)
  {
    const double* const b = asked.box;
    const auto box = pointfront::BoxRegion::make({ { b[0], b[1], b[2] }, { b[3], b[4], b[5] } });
    if (!box)
    {
      return box.error();
    }
    query.regions.push_back(*box);
  }
  if (asked.sphere != nullptr)
  {
    const double* const s = asked.sphere;
    const auto sphere = pointfront::SphereRegion::make({ s[0], s[1], s[2] }, s[3]);
    if (!sphere)
    {
      return sphere.error();
    }
    query.regions.push_back(*sphere);
  }
  if (asked.area != nullptr)
  {
    const auto area = pointfront::regionOfText(asked.area, asked.lineDistance);
    if (!area)
    {
      return area.error();
    }
    query.regions.push_back(*area);
  }
  return {};
}

Result<pointfront::PointQuery> queryOf(const PointFrontQuery& asked)
{
  pointfront::PointQuery query;
  if (Result<void> added = addRegions(asked, query); !added)
  {
    return added.error();
  }
  auto where = pointfront::FilterExpression::parse(asked.where != nullptr ? asked.where : "");
  if (!where)
  {
    return where.error();
  }
  query.where = std::move(*where);
  query.classes.assign(asked.classes, asked.classes + asked.classCount);
  query.spacing = asked.spacing;
  query.attributes.emplace();
  const char* name = asked.attributes;
  for (std::size_t i = 0; i < asked.attributeCount; ++i)
  {
    name += query.attributes->emplace_back(name).size() + 1;
  }
  return query;
}

Json columnsOf(pointfront::PlainColumns& points)
{
  Json columns = Json::array();
  for (pointfront::PlainColumns::Column& column : points.take())
  {
    columns.push_back({ { "name", column.name }, { "type", pointfront::nameOf(column.type) },
      { "components", column.components },
      { "address", reinterpret_cast<std::uintptr_t>(column.memory.release()) } });
  }
  return columns;
}

/// Sources that the order of a build makes of the caller's arrays.
Result<std::unique_ptr<pointfront::PointSource>> sourceOf(
  const PointFrontArray* arrays, std::size_t arrayCount, std::uint64_t points, unsigned threads)
{
  auto made = pointfront::ArraySource::make(
    static_cast<const double*>(arrays[0].data), points, { threads, {} });
  if (!made)
  {
    return made.error();
  }
  std::unique_ptr<pointfront::ArraySource> source = std::move(*made);
  for (std::size_t a = 1; a < arrayCount; ++a)
  {
    const PointFrontArray& array = arrays[a];
    pointfront::Attribute attribute;
    attribute.name = array.name;
    attribute.type = *pointfront::scalarTypeOf(array.type);
    attribute.components = array.components;
    if (!source->add(attribute, array.data))
    {
      return makeError(Error::Kind::BadArgument,
        "two arrays are called '" + attribute.name + "' (upper and lower case are one)");
    }
  }
  return std::unique_ptr<pointfront::PointSource>(std::move(source));
}

Json reportOf(const pointfront::BuildReport& report)
{
  Json skipped = Json::array();
  for (const pointfront::InputFault& fault : report.inputsSkipped)
  {
    skipped.push_back(fault.path + " is skipped: " + fault.why);
  }
  return { { "points_read", report.pointsRead }, { "points_stored", report.pointsStored },
    { "points_outside", report.pointsOutside }, { "nodes", report.nodes },
    { "bytes_written", report.bytesWritten }, { "warnings", report.warnings },
    { "skipped", skipped } };
}

} // namespace

void pointfrontFree(void* memory)
{
  std::free(memory);
}

char* pointfrontClassNames()
{
  return answer(
    []() -> Result<Json>
    {
      Json names = Json::array();
      for (int code = 0; code <= 255; ++code)
      {
        names.push_back(pointfront::objectClassName(static_cast<std::uint8_t>(code)));
      }
      return names;
    });
}

char* pointfrontCredentials(const char* text)
{
  return answer(
    [&]() -> Result<Json>
    {
      const Result<void> learnt = pointfront::learnCredentialsOfServers(text);
      return learnt ? Result<Json>(Json(nullptr)) : learnt.error();
    });
}

char* pointfrontPublicForm(const char* address)
{
  return answer(
    [&]() -> Result<Json>
    {
      pointfront::addCloudFormats();
      return Json(pointfront::publicForm(address));
    });
}

char* pointfrontTraffic()
{
  return answer(
    []() -> Result<Json>
    {
      const pointfront::TrafficCounts traffic = pointfront::ByteTraffic::ofProcess().counts();
      return Json{ { "requests", traffic.requests }, { "bytes_fetched", traffic.bytes },
        { "retries", traffic.retries }, { "cache_hits", traffic.cacheHits },
        { "cache_bytes", traffic.cacheBytes } };
    });
}

char* pointfrontOpen(
  const char* path, PointFrontCloud** cloud, double bounds[6], PointFrontProgress progress)
{
  *cloud = nullptr;
  return answer(
    [&]() -> Result<Json>
    {
      pointfront::addCloudFormats();
      const Result<std::string> found = canonicalPath(path);
      if (!found)
      {
        return found.error();
      }
      const pointfront::StopOfReads stop([progress] { return progress("open", 0.0) == 0; });
      auto opened = pointfront::StoredCloudFormats::ofProcess().open(*found);
      if (!opened)
      {
        return opened.error();
      }
      const pointfront::StoreDescription& store = (*opened)->description();
      for (int axis = 0; axis < 3; ++axis)
      {
        bounds[axis] = store.bounds.low[axis];
        bounds[3 + axis] = store.bounds.high[axis];
      }
      Json described = describe(*found, store);
      *cloud = new PointFrontCloud{ std::move(*opened) };
      return described;
    });
}

void pointfrontClose(PointFrontCloud* cloud)
{
  delete cloud;
}

char* pointfrontPoints(
  const PointFrontCloud* cloud, const PointFrontQuery* asked, PointFrontProgress progress)
{
  return answer(
    [&]() -> Result<Json>
    {
      const Result<pointfront::PointQuery> query = queryOf(*asked);
      if (!query)
      {
        return query.error();
      }
      const auto plan = pointfront::QueryPlan::make(*cloud->store, *query);
      if (!plan)
      {
        return plan.error();
      }
      pointfront::QueryOptions options;
      options.memoryBytes = asked->memoryBytes > 0 ? asked->memoryBytes : options.memoryBytes;
      options.progress = reporting(progress);
      pointfront::PlainColumns points(plan->description(), asked->mostPoints);
      const auto report =
        plan->piece(asked->piece, asked->pieces)
          .run(*cloud->store, options,
            [&](const pointfront::QueryBatch& batch) { return points.add(batch); });
      if (!report)
      {
        return report.error();
      }
      const std::uint64_t count = points.points();
      Json warnings = Json::array();
      if (const auto missed = pointfront::missedRegion(cloud->store->description(), *query))
      {
        asked->piece == 0 ? warnings.push_back(*missed) : void();
      }
      return Json{ { "points", count }, { "columns", columnsOf(points) },
        { "warnings", warnings } };
    });
}

char* pointfrontBuild(const char* request, const PointFrontArray* arrays, std::size_t arrayCount,
  std::uint64_t points, PointFrontProgress progress)
{
  return answer(
    [&]() -> Result<Json>
    {
      pointfront::addCloudFormats();
      pointfront::BuildOrder order = pointfront::buildOrderOf(request);
      std::unique_ptr<pointfront::PointSource> source;
      if (arrayCount > 0)
      {
        auto made = sourceOf(arrays, arrayCount, points, order.options.threads);
        if (!made)
        {
          return made.error();
        }
        source = std::move(*made);
        order.passes.inputsMayNameCrs = false;
        order.made = [&source]() -> Result<pointfront::PointSources>
        {
          pointfront::PointSources sources;
          sources.push_back(std::move(source));
          return sources;
        };
      }
      const auto report = pointfront::carryOut(order, reporting(progress));
      if (!report)
      {
        return report.error();
      }
      return reportOf(*report);
    });
}

char* pointfrontIndex(const char* las, const char* side, int overwrite, std::uint32_t nodePoints,
  PointFrontProgress progress)
{
  return answer(
    [&]() -> Result<Json>
    {
      pointfront::LASIndexOptions options;
      options.leafPoints = nodePoints;
      options.overwrite = overwrite != 0;
      const auto report = pointfront::indexLASFile(las, side, options, reporting(progress));
      if (!report)
      {
        return report.error();
      }
      return Json{ { "points", report->points }, { "warnings", report->warnings } };
    });
}
