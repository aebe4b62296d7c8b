#include "StoreFacts.h"

#include "StoredBounds.h"
#include "StoredRanges.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Store/StoredCloud.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iomanip>
#include <locale>
#include <sstream>
#include <vector>

namespace pointfront
{
namespace
{

using Ends = std::array<double, 2>;

void addTexts(vtkPolyData* data, const char* name, const std::vector<std::string>& texts)
{
  vtkNew<vtkStringArray> array;
  array->SetName(name);
  for (const std::string& text : texts)
  {
    array->InsertNextValue(text);
  }
  data->GetFieldData()->AddArray(array);
}

void addNumbers(vtkPolyData* data, const char* name, const std::vector<vtkIdType>& numbers)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  for (const vtkIdType number : numbers)
  {
    array->InsertNextValue(number);
  }
  data->GetFieldData()->AddArray(array);
}

std::string structureOf(const StoredCloud& store)
{
  const StoreDescription& about = store.description();
  const std::string nodes =
    about.knowsNodes() ? std::to_string(store.hierarchy()->nodeCount()) : "uncounted";
  return about.structure + ", " + nodes + " nodes, " + std::to_string(about.levels) + " levels" +
    (about.fileBytes > 0 ? ", " + std::to_string(about.fileBytes) + " bytes" : "");
}

/// The name of a coordinate reference system: the first text of its well-known text.
std::string nameOfCrs(const std::string& wkt)
{
  const std::size_t first = wkt.find('"');
  const std::size_t last = first == std::string::npos ? first : wkt.find('"', first + 1);
  if (last == std::string::npos)
  {
    return wkt.empty() ? "not stated" : wkt;
  }
  return wkt.substr(first + 1, last - first - 1);
}

/// World values of a component's range; low above high where the store does not know it.
Ends worldRange(const Attribute& attribute, const Ends& stored)
{
  Ends ends{ stored[0] * attribute.scale + attribute.offset,
    stored[1] * attribute.scale + attribute.offset };
  if (attribute.scale < 0.0)
  {
    std::swap(ends[0], ends[1]);
  }
  return ends;
}

} // namespace

std::string groupedDigits(std::uint64_t number)
{
  std::string digits = std::to_string(number);
  for (std::size_t at = digits.size(); at > 3;)
  {
    at -= 3;
    digits.insert(at, ",");
  }
  return digits;
}

namespace
{
std::string megabytes(std::uint64_t bytes)
{
  return decimalText(1e-6 * double(bytes), bytes < 9950000 ? 2 : 0) + " MB";
}
} // namespace

std::string trafficText(const TrafficCounts& traffic, std::uint64_t missing)
{
  if (!traffic.any())
  {
    return {};
  }
  std::string text = groupedDigits(traffic.requests) + " requests, " + megabytes(traffic.bytes);
  if (traffic.cacheHits > 0)
  {
    text += "; " + megabytes(traffic.cacheBytes) + " from the cache";
  }
  return missing > 0 ? text + "; " + groupedDigits(missing) + " nodes are missing" : text;
}

std::string storeFacts(const StoredCloud& store, std::int64_t mostOverviewPoints)
{
  const StoreDescription& about = store.description();
  const Bounds& box = about.bounds;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(12) << groupedDigits(about.pointCount) << " points\n";
  const auto most = static_cast<std::uint64_t>(std::max<std::int64_t>(mostOverviewPoints, 0));
  if (most < about.pointCount)
  {
    text << "(Information counts an overview of at most " << groupedDigits(most) << " of them)\n";
  }
  text << "x " << box.low.x << " to " << box.high.x << "\n"
       << "y " << box.low.y << " to " << box.high.y << "\n"
       << "z " << box.low.z << " to " << box.high.z << "\n"
       << "CRS: " << nameOfCrs(about.crsWkt) << "\n"
       << structureOf(store) << "\n";
  if (about.layers.size() > 1)
  {
    for (const Layer& layer : about.layers)
    {
      text << "class " << layer.objectClass << ", " << layer.name << ": "
           << groupedDigits(layer.pointCount) << "\n";
    }
  }
  for (std::size_t column = 0; column < about.schema.size(); ++column)
  {
    const Attribute& attribute = about.schema[column];
    text << attribute.name << (about.isComputed(column) ? " (computed while nodes load)" : "");
    for (const Ends& stored : about.ranges[column].components)
    {
      const Ends ends = worldRange(attribute, stored);
      if (ends[0] <= ends[1])
      {
        text << "  " << ends[0];
        ends[0] < ends[1] ? text << " to " << ends[1] : text;
        about.rangesAreSampled ? text << " in some points" : text;
      }
    }
    text << "\n";
  }
  return text.str();
}

void addStoreFrame(const StoredCloud& store, vtkPolyData* output)
{
  const StoreDescription& about = store.description();
  addTexts(output, "store_crs", { about.crsWkt.empty() ? "not stated" : about.crsWkt });
  vtkNew<vtkDoubleArray> grid;
  grid->SetName("store_grid");
  grid->SetNumberOfComponents(6);
  const glm::dvec3& scale = about.grid.scale;
  const glm::dvec3& offset = about.grid.offset;
  const double steps[6] = { scale.x, scale.y, scale.z, offset.x, offset.y, offset.z };
  grid->InsertNextTuple(steps);
  output->GetFieldData()->AddArray(grid);
}

void addStoreFacts(const StoredCloud& store, vtkIdType mostOverviewPoints, vtkPolyData* output)
{
  const StoreDescription& about = store.description();
  const auto points = static_cast<vtkIdType>(about.pointCount);
  addNumbers(output, "store_points", { points });
  vtkNew<vtkDoubleArray> bounds;
  bounds->SetName("store_bounds");
  bounds->SetNumberOfComponents(6);
  const Bounds& box = about.bounds;
  const double ends[6] = { box.low.x, box.high.x, box.low.y, box.high.y, box.low.z, box.high.z };
  bounds->InsertNextTuple(ends);
  output->GetFieldData()->AddArray(bounds);
  addStoreFrame(store, output);
  addTexts(output, "store_structure", { structureOf(store) });
  std::vector<std::string> names;
  std::vector<vtkIdType> counts;
  for (const Layer& layer : about.layers)
  {
    names.push_back(layer.name);
    counts.push_back(static_cast<vtkIdType>(layer.pointCount));
  }
  addTexts(output, "store_classes", names);
  addNumbers(output, "store_class_points", counts);
  const std::string shown = std::to_string(std::min(points, mostOverviewPoints));
  addTexts(output, "output_is",
    { points <= mostOverviewPoints
        ? "all points of the store"
        : "an overview of at most " + shown + " of " + std::to_string(points) +
          " points. Save Data saves this overview. The filter PointFront Extract gives the exact "
          "points, and what it gives can be saved." });
}

void setStoreRanges(const StoredCloud& store, vtkPolyData* output)
{
  const StoreDescription& about = store.description();
  vtkPointData* attributes = output->GetPointData();
  const auto keep = [attributes](const std::string& name, const std::vector<Ends>& ranges)
  {
    if (vtkDataArray* array = attributes->GetArray(name.c_str()))
    {
      const bool active = array == attributes->GetScalars();
      attributes->AddArray(withStoredRanges(array, ranges)); // in its place
      active ? attributes->SetActiveScalars(name.c_str()) : -1;
    }
  };
  for (std::size_t column = 0; column < about.schema.size(); ++column)
  {
    const Attribute& attribute = about.schema[column];
    std::vector<Ends> ranges;
    for (const Ends& stored : about.ranges[column].components)
    {
      ranges.push_back(worldRange(attribute, stored));
    }
    if (attribute.name != "rgb")
    {
      keep(attribute.name, ranges);
    }
  }
  if (!about.schema.find("elevation"))
  {
    keep("elevation", { { about.bounds.low.z, about.bounds.high.z } });
  }
  keep("point_id", { { 0.0, static_cast<double>(about.pointCount) - 1.0 } });
  if (output->GetNumberOfPoints() > 0)
  {
    const glm::dvec3& low = about.bounds.low;
    const glm::dvec3& high = about.bounds.high;
    output->SetPoints(
      withStoredBounds(output->GetPoints(), { low.x, high.x, low.y, high.y, low.z, high.z }));
  }
}

} // namespace pointfront
