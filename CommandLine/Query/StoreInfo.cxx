#include "StoreInfo.h"

#include "ByteSize.h"
#include "CloudFacts.h"
#include "SystemName.h"

#include "pointfront/Points/NormalAttribute.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Store/PreviewRecord.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace pointfront
{

namespace
{
const char* refinementName(Refinement refinement)
{
  return refinement == Refinement::Add ? "add" : "replace";
}

/// The coarsest axis: no coordinate is farther from the truth than half of it.
double precisionOf(const QuantisationGrid& grid)
{
  return std::max({ grid.scale.x, grid.scale.y, grid.scale.z });
}

enum class SplatMeasure : std::uint8_t
{
  None,
  PerNode,
  PerPoint ///< and per node
};

SplatMeasure splatMeasure(const StoreDescription& store, const Hierarchy& hierarchy)
{
  if (store.splatRadiusBase > 0.0 && store.schema.find(splatRadiusAttribute))
  {
    return SplatMeasure::PerPoint;
  }
  const std::vector<NodeIndex>& roots = hierarchy.roots();
  const bool byNode = std::any_of(roots.begin(), roots.end(),
    [&](NodeIndex root) { return hierarchy.node(root).splatRadius > 0.0f; });
  return byNode ? SplatMeasure::PerNode : SplatMeasure::None;
}

nlohmann::ordered_json countOrNull(bool known, std::uint32_t count)
{
  return known ? nlohmann::ordered_json(count) : nlohmann::ordered_json();
}

/// Versions of stores and of side files.
bool olderThanSplats(const StoreDescription& store)
{
  return store.version < (store.structure == "inplace" ? 2u : 3u);
}

/// The attributes that files hold, without those that are computed while nodes load.
AttributeSchema heldSchema(const StoreDescription& store)
{
  AttributeSchema held;
  for (std::size_t c = 0; c < store.schema.size(); ++c)
  {
    if (!store.isComputed(c))
    {
      held.add(store.schema[c]);
    }
  }
  return held;
}

/// Which normals there are and where they come from.
struct NormalFacts
{
  std::string source; ///< "stored", "computed while nodes load", "none"
  std::string of; ///< the attribute's description says so
};

NormalFacts normalFacts(const StoreDescription& store)
{
  const std::optional<std::size_t> column = store.schema.find(normalAttribute().name);
  if (!column)
  {
    return { "none", "" };
  }
  return { store.isComputed(*column) ? "computed while nodes load" : "stored",
    store.schema[*column].description };
}

/// Whether some tile has a date or a name.
bool hasEpochs(const StoreDescription& store)
{
  return !store.epochs.empty() && !store.epochs.back().empty();
}

const char* nameOf(SplatMeasure measure)
{
  return measure == SplatMeasure::PerPoint ? "per point"
    : measure == SplatMeasure::PerNode     ? "per node"
                                           : "none";
}
} // namespace

std::string nodesText(const StoreDescription& store, const Hierarchy& hierarchy)
{
  return store.knowsNodes()
    ? std::to_string(hierarchy.nodeCount()) + " nodes in " + std::to_string(store.levels) +
      " levels"
    : "uncounted nodes in at least " + std::to_string(store.levels) + " levels";
}

nlohmann::ordered_json storeJson(const StoreDescription& store, const Hierarchy& hierarchy)
{
  nlohmann::ordered_json object;
  object["points"] = store.pointCount;
  object["bounds"] = boundsJson(store.bounds);
  object["precision"] = precisionOf(store.grid);
  object["crs"] =
    store.crsWkt.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(store.crsWkt);
  object["structure"] = store.structure;
  object["refinement"] = refinementName(store.refinement);
  const bool counted = store.knowsNodes();
  object["nodes"] = countOrNull(counted, hierarchy.nodeCount());
  object["levels"] = store.levels;
  object["bytes"] = counted || store.fileBytes > 0 ? nlohmann::ordered_json(store.fileBytes)
                                                   : nlohmann::ordered_json();
  object["attributes"] = attributesJson(heldSchema(store));
  const NormalFacts normals = normalFacts(store);
  object["normals"] = { { "source", normals.source }, { "of", normals.of } };
  object["layers"] = nlohmann::ordered_json::array();
  for (const Layer& layer : store.layers)
  {
    object["layers"].push_back({ { "class", layer.objectClass }, { "name", layer.name },
      { "points", layer.pointCount }, { "nodes", countOrNull(counted, layer.nodeCount) } });
  }
  object["splat_radius"] = nameOf(splatMeasure(store, hierarchy));
  object["version"] = store.version;
  if (const auto preview = previewRecordOf(store.metadata))
  {
    object["preview"] = { { "of", preview->storeName },
      { "points_expected", preview->pointsExpected }, { "points_read", preview->pointsRead },
      { "points_finished", preview->pointsFinished } };
  }
  if (hasEpochs(store))
  {
    object["epochs"] = store.epochs;
  }
  object["warnings"] = store.warnings;
  object["grid"] = { { "scale", { store.grid.scale.x, store.grid.scale.y, store.grid.scale.z } },
    { "offset", { store.grid.offset.x, store.grid.offset.y, store.grid.offset.z } } };
  return object;
}

std::string storeText(const StoreDescription& store, const Hierarchy& hierarchy)
{
  std::ostringstream text;
  text.precision(15);
  text << store.path;
  if (const auto preview = previewRecordOf(store.metadata))
  {
    text << "\n  preview     of " << preview->storeName << ", which is being built from "
         << preview->pointsExpected << " points; " << preview->pointsRead
         << " were read when this was written, " << preview->pointsFinished
         << " of them are shown in full";
  }
  text << "\n  points      " << store.pointCount << "\n  bounds      " << boundsText(store.bounds);
  text << "\n  precision   " << store.grid.scale.x << ' ' << store.grid.scale.y << ' '
       << store.grid.scale.z << "\n  crs         "
       << (store.crsWkt.empty() ? "not known" : systemName(store.crsWkt)) << "\n  hierarchy   "
       << store.structure << ", refinement " << refinementName(store.refinement) << ", "
       << nodesText(store, hierarchy) << "\n  file        "
       << (store.knowsNodes() || store.fileBytes > 0
              ? byteSizeText(store.fileBytes) + " (" + std::to_string(store.fileBytes) + " bytes)"
              : "files that are opened when they are looked into")
       << ", version " << store.version << ", by " << store.generator << "\n  splat sizes ";
  const SplatMeasure measure = splatMeasure(store, hierarchy);
  text << (measure == SplatMeasure::PerPoint ? "measured per point"
      : measure == SplatMeasure::PerNode     ? "measured per node"
      : olderThanSplats(store)               ? "not measured (built by an older version)"
                                             : "not measured (no two places)");
  text << "\n  attributes  " << attributesText(heldSchema(store));
  const NormalFacts normals = normalFacts(store);
  text << "\n  normals     " << normals.source << (normals.of.empty() ? "" : ": ") << normals.of;
  if (hasEpochs(store))
  {
    text << "\n  epochs     ";
    for (const std::string& epoch : store.epochs)
    {
      text << ' ' << (epoch.empty() ? "(without a name)" : epoch);
    }
  }
  for (const Layer& layer : store.layers)
  {
    text << "\n  layer       " << layer.name << " (class " << layer.objectClass
         << "): " << layer.pointCount << " points";
    if (store.knowsNodes())
    {
      text << " in " << layer.nodeCount << " nodes";
    }
  }
  return text.str();
}

} // namespace pointfront
