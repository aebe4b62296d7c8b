#include "MosaicFiles.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace pointfront
{
namespace
{
using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;
constexpr int version = 2;

/// Infinite numbers are not JSON.
OrderedJson numberJson(double number)
{
  return std::isfinite(number) ? OrderedJson(number) : OrderedJson("infinite");
}

double numberOf(const Json& json)
{
  return json.is_number() ? json.get<double>() : infinity;
}

OrderedJson boxJson(const Bounds& box)
{
  return box.empty()
    ? OrderedJson::array()
    : OrderedJson{ box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z };
}

Bounds boxOf(const Json& json)
{
  Bounds box;
  if (json.size() >= 6)
  {
    box.low = { json[0].get<double>(), json[1].get<double>(), json[2].get<double>() };
    box.high = { json[3].get<double>(), json[4].get<double>(), json[5].get<double>() };
  }
  return box;
}

OrderedJson vectorJson(const glm::dvec3& v)
{
  return { v.x, v.y, v.z };
}

glm::dvec3 vectorOf(const Json& json)
{
  return { json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>() };
}

OrderedJson skippedJsonOf(const std::vector<std::pair<std::string, std::string>>& skipped)
{
  OrderedJson list = OrderedJson::array();
  for (const auto& [path, why] : skipped)
  {
    list.push_back({ { "path", path }, { "why", why } });
  }
  return list;
}

std::vector<std::pair<std::string, std::string>> skippedOf(const Json& json)
{
  std::vector<std::pair<std::string, std::string>> skipped;
  for (const Json& one : json)
  {
    skipped.emplace_back(one.at("path"), one.at("why"));
  }
  return skipped;
}

OrderedJson tilesJson(const std::map<TileIndex, std::uint64_t>& tiles)
{
  OrderedJson list = OrderedJson::array();
  for (const auto& [tile, points] : tiles)
  {
    list.push_back({ tile.x, tile.y, points });
  }
  return list;
}

std::map<TileIndex, std::uint64_t> tilesOf(const Json& json)
{
  std::map<TileIndex, std::uint64_t> tiles;
  for (const Json& one : json)
  {
    tiles[{ one.at(0), one.at(1) }] = one.at(2);
  }
  return tiles;
}
} // namespace

Json toJson(const TileIdentity& identity)
{
  return { identity.bytes, identity.head, identity.tail };
}

TileIdentity identityOf(const Json& json)
{
  TileIdentity identity;
  identity.bytes = json.at(0);
  identity.head = json.at(1);
  identity.tail = json.at(2);
  return identity;
}

OrderedJson MosaicPlan::json() const
{
  OrderedJson object;
  object["version"] = version;
  object["settings"] = settings;
  object["edge"] = grid.edge;
  object["scale"] = vectorJson(steps.scale);
  object["offset"] = vectorJson(steps.offset);
  object["classes"] = classes;
  object["inputs"] = OrderedJson::array();
  for (const PlannedInput& input : inputs)
  {
    object["inputs"].push_back({ { "path", input.path }, { "identity", input.identity },
      { "kind", input.kind }, { "representative", input.representative },
      { "missing", input.missing }, { "kept", input.kept } });
  }
  object["skipped"] = skippedJsonOf(skipped);
  return object;
}

MosaicPlan MosaicPlan::of(const Json& json)
{
  MosaicPlan plan;
  plan.settings = json.at("settings");
  plan.grid.edge = json.at("edge");
  plan.steps.scale = vectorOf(json.at("scale"));
  plan.steps.offset = vectorOf(json.at("offset"));
  plan.classes = json.at("classes");
  for (const Json& one : json.at("inputs"))
  {
    plan.inputs.push_back({ one.at("path"), one.at("identity"), one.at("kind"),
      one.at("representative"), one.at("missing"), one.at("kept") });
  }
  plan.skipped = skippedOf(json.at("skipped"));
  return plan;
}

OrderedJson MosaicTiles::json() const
{
  OrderedJson object;
  object["version"] = version;
  object["layers"] = layers;
  object["wide_colours"] = wideColours;
  object["ground"] = ground;
  object["extent"] = extent;
  object["points_read"] = read;
  object["kept_bytes"] = keptBytes;
  object["points_rejected"] = rejected;
  object["inputs"] = OrderedJson::array();
  for (const SettledInput& input : inputs)
  {
    object["inputs"].push_back({ { "bounds", boxJson(input.bounds) }, { "deep", input.deep },
      { "own_colour", input.ownColour } });
  }
  object["skipped"] = skippedJsonOf(skipped);
  object["tiles"] = tilesJson(tiles);
  return object;
}

MosaicTiles MosaicTiles::of(const Json& json)
{
  MosaicTiles tiles;
  tiles.layers = json.at("layers");
  tiles.wideColours = json.at("wide_colours");
  tiles.ground = json.at("ground");
  tiles.extent = json.at("extent");
  tiles.read = json.at("points_read");
  tiles.keptBytes = json.at("kept_bytes");
  tiles.rejected = json.at("points_rejected").get<std::map<std::string, std::uint64_t>>();
  for (const Json& one : json.at("inputs"))
  {
    tiles.inputs.push_back({ boxOf(one.at("bounds")), one.at("deep"), one.at("own_colour") });
  }
  tiles.skipped = skippedOf(json.at("skipped"));
  tiles.tiles = tilesOf(json.at("tiles"));
  return tiles;
}

OrderedJson SurveyRecord::json() const
{
  OrderedJson object;
  object["version"] = version;
  object["key"] = key;
  object["points_read"] = survey.read;
  object["kept_bytes"] = keptBytes;
  object["points_rejected"] = survey.rejected;
  object["classes"] = survey.classes.to_string();
  object["largest_colour"] = survey.largestColour;
  object["own_colour"] = ownColour;
  object["tiles"] = tilesJson(survey.tiles);
  object["chunks"] = OrderedJson::array();
  for (const SurveyedChunk& chunk : survey.chunks)
  {
    object["chunks"].push_back({ boxJson(chunk.bounds), hex(chunk.hash) });
  }
  return object;
}

SurveyRecord SurveyRecord::of(const Json& json)
{
  SurveyRecord record;
  record.key = json.at("key");
  record.survey.read = json.at("points_read");
  record.keptBytes = json.at("kept_bytes");
  record.survey.rejected = json.at("points_rejected").get<std::map<std::string, std::uint64_t>>();
  record.survey.classes = std::bitset<256>(json.at("classes").get<std::string>());
  record.survey.largestColour = json.at("largest_colour");
  record.ownColour = json.at("own_colour");
  record.survey.tiles = tilesOf(json.at("tiles"));
  for (const Json& one : json.at("chunks"))
  {
    record.survey.chunks.push_back(
      { boxOf(one.at(0)), std::stoull(one.at(1).get<std::string>(), nullptr, 16) });
  }
  return record;
}

OrderedJson TileRecord::json() const
{
  OrderedJson object;
  object["version"] = version;
  object["key"] = key;
  object["margin"] = numberJson(margin);
  object["file"] = file;
  object["identity"] = toJson(identity);
  object["points"] = points;
  object["nodes"] = nodes;
  object["bytes"] = bytes;
  object["spilled_bytes"] = spilled;
  object["cpu_seconds"] = cpuSeconds;
  object["points_rejected"] = rejected;
  object["warnings"] = warnings;
  object["findings"] = findings;
  object["findings_of_inputs"] = ofInputs;
  return object;
}

TileRecord TileRecord::of(const Json& json)
{
  TileRecord record;
  record.key = json.at("key");
  record.margin = numberOf(json.at("margin"));
  record.file = json.at("file");
  record.identity = identityOf(json.at("identity"));
  record.points = json.at("points");
  record.nodes = json.at("nodes");
  record.bytes = json.at("bytes");
  record.spilled = json.at("spilled_bytes");
  record.cpuSeconds = json.at("cpu_seconds");
  record.rejected = json.at("points_rejected").get<std::map<std::string, std::uint64_t>>();
  record.warnings = json.at("warnings").get<std::vector<std::string>>();
  record.findings = json.at("findings").get<std::vector<std::string>>();
  record.ofInputs = json.at("findings_of_inputs").get<std::vector<std::string>>();
  return record;
}

OrderedJson CollectionNote::json() const
{
  OrderedJson object;
  object["version"] = version;
  object["key"] = key;
  object["identity"] = toJson(identity);
  return object;
}

CollectionNote CollectionNote::of(const Json& json)
{
  return { json.at("key"), identityOf(json.at("identity")) };
}

template <typename Record>
std::optional<Record> loadRecord(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  try
  {
    const Json json = Json::parse(text.str());
    return json.at("version") == version ? std::optional<Record>(Record::of(json)) : std::nullopt;
  }
  catch (const std::exception&) // no JSON, not ours, or a number that is none
  {
    return std::nullopt;
  }
}

template std::optional<MosaicPlan> loadRecord(const std::string& path);
template std::optional<MosaicTiles> loadRecord(const std::string& path);
template std::optional<SurveyRecord> loadRecord(const std::string& path);
template std::optional<TileRecord> loadRecord(const std::string& path);
template std::optional<CollectionNote> loadRecord(const std::string& path);

std::string processName()
{
  char host[256] = "host";
  ::gethostname(host, sizeof host - 1);
  return std::string(host) + "-" + std::to_string(::getpid());
}

Result<void> replaceFile(const std::string& path, const std::string& text)
{
  const std::string meanwhile = path + "." + processName();
  {
    std::ofstream file(meanwhile, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (!file)
    {
      const std::string why = std::strerror(errno);
      std::remove(meanwhile.c_str());
      return makeError(Error::Kind::Unwritable, "cannot write '" + path + "': " + why);
    }
  }
  if (std::rename(meanwhile.c_str(), path.c_str()) != 0)
  {
    const std::string why = std::strerror(errno);
    std::remove(meanwhile.c_str());
    return makeError(Error::Kind::Unwritable, "cannot write '" + path + "': " + why);
  }
  return {};
}

std::string hex(std::uint64_t number)
{
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(number));
  return text;
}

} // namespace pointfront
