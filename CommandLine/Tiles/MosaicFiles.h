#pragma once

#include "pointfront/Mosaic/InputSurvey.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Tiles/CollectedTile.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The files by which `build --tiles` knows what is done: JSON below FOLDER/work. Each is written
/// whole under another name and renamed, so that a file is there or not, whoever writes it, also
/// several processes at once.

/// An input as it was found when the build was planned.
struct PlannedInput
{
  std::string path; ///< absolute
  std::string identity; ///< sizes, times and checksums of its files' ends
  std::string kind; ///< attributes, grid and system: equal for inputs that have the same
  bool representative = false; ///< the first of its kind
  std::uint64_t missing = 0; ///< points that its header promises and the file lacks
  bool kept = false; ///< its survey keeps the points for the tiles
};

/// work/plan.json: what is to be built of what.
struct MosaicPlan
{
  nlohmann::json settings; ///< the options that decide about the result
  TileGrid grid;
  QuantisationGrid steps;
  bool classes = false; ///< layers by class are possible
  std::vector<PlannedInput> inputs;
  std::vector<std::pair<std::string, std::string>> skipped; ///< path, why

  nlohmann::ordered_json json() const;
  static MosaicPlan of(const nlohmann::json& json);
};

/// An input once it has been read.
struct SettledInput
{
  Bounds bounds;
  bool deep = false; ///< has colours of more than 8 bits
  std::uint16_t ownColour = 0; ///< largest of its own, where images give others
};

/// work/tiles.json: what all tiles have in common, and which there are.
struct MosaicTiles
{
  bool layers = false;
  bool wideColours = false;
  bool ground = false; ///< a point is of class 2
  double extent = 0.0; ///< margins of so many units take in all
  std::uint64_t read = 0;
  std::uint64_t keptBytes = 0; ///< points that surveys kept
  std::map<std::string, std::uint64_t> rejected;
  std::vector<SettledInput> inputs; ///< as the plan's
  std::vector<std::pair<std::string, std::string>> skipped; ///< path, why
  std::map<TileIndex, std::uint64_t> tiles;

  nlohmann::ordered_json json() const;
  static MosaicTiles of(const nlohmann::json& json);
};

/// work/survey-N.json.
struct SurveyRecord
{
  std::string key; ///< hash: the input and how it was read
  InputSurvey survey;
  std::uint64_t keptBytes = 0; ///< points of the input, for the tiles
  std::uint16_t ownColour = 0; ///< largest 16-bit colour before images give others

  nlohmann::ordered_json json() const;
  static SurveyRecord of(const nlohmann::json& json);
};

/// work/tile-NAME.json: a tile that is done.
struct TileRecord
{
  std::string key; ///< hash: all that the tile depends on
  double margin = 0.0;
  std::string file; ///< below FOLDER/tiles
  TileIdentity identity; ///< identity of that file
  std::uint64_t points = 0;
  std::uint64_t nodes = 0;
  std::uint64_t bytes = 0;
  std::uint64_t spilled = 0;
  double cpuSeconds = 0.0;
  std::map<std::string, std::uint64_t> rejected;
  std::vector<std::string> warnings;
  std::vector<std::string> findings; ///< findings of the passes, for the tile with its margin
  std::vector<std::string> ofInputs; ///< findings that name inputs or are of all of them

  nlohmann::ordered_json json() const;
  static TileRecord of(const nlohmann::json& json);
};

/// work/collection.json: the collection as the build left it.
struct CollectionNote
{
  std::string key; ///< hash: its tiles
  TileIdentity identity;

  nlohmann::ordered_json json() const;
  static CollectionNote of(const nlohmann::json& json);
};

/// Nothing if the file is absent, cut short or not of this kind: what it says is then done again.
template <typename Record>
std::optional<Record> loadRecord(const std::string& path);

/// Writes under a name of this process alone and renames. Error Unwritable.
Result<void> replaceFile(const std::string& path, const std::string& text);

/// A name that no other process gives, on this machine or another one: "HOST-PID".
std::string processName();

std::string hex(std::uint64_t number);
nlohmann::json toJson(const TileIdentity& identity);
TileIdentity identityOf(const nlohmann::json& json);

} // namespace pointfront
