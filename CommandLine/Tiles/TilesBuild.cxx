#include "TilesBuild.h"

#include "InputIdentity.h"
#include "KnownSystems.h"
#include "OwnFiles.h"

#include "pointfront/Collection/CollectionWriter.h"
#include "pointfront/Tiles/CollectionCloud.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <set>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

bool sameSystems(const std::string& one, const std::string& other)
{
  const std::shared_ptr<const CoordinateSystems> known = knownSystems();
  const auto a = known->parse(one);
  const auto b = known->parse(other);
  return a && b && known->equivalent(*a, *b, false);
}

std::uint64_t sumOf(const std::map<std::string, std::uint64_t>& counts)
{
  std::uint64_t sum = 0;
  for (const auto& [reason, count] : counts)
  {
    sum += count;
  }
  return sum;
}

/// A collection as this build makes it of its tiles, which nobody has changed.
bool isOf(const std::string& path, const std::vector<TileRecord>& records)
{
  const auto cloud = CollectionCloud::open(path);
  if (!cloud)
  {
    return false;
  }
  const CollectionRecord& is = (*cloud)->record();
  return is.state == 1 && is.tiles.size() == records.size() &&
    std::equal(records.begin(), records.end(), is.tiles.begin(),
      [](const TileRecord& record, const CollectedTile& tile)
      {
        return tile.is.address == "tiles/" + record.file && tile.is.identity == record.identity &&
          tile.is.epoch.empty();
      });
}
} // namespace

Result<void> TilesBuild::surveyAll(TilesProgress& progress)
{
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < plan_->inputs.size(); ++i)
  {
    if (!surveyed(i))
    {
      wanted.push_back(i);
    }
  }
  constexpr double shareOfSurvey = 0.25;
  // Until the tiles are known they are taken to be three times the work.
  progress.setTotal(static_cast<double>(wanted.size()) / shareOfSurvey);
  for (std::size_t n = 0; n < wanted.size(); ++n)
  {
    const std::string name =
      "input " + std::to_string(n + 1) + " of " + std::to_string(wanted.size());
    if (Result<void> done = surveyNow(wanted[n], progress.part(name, 1.0, 1)); !done)
    {
      return done;
    }
  }
  return {};
}

/// How many were built.
Result<std::uint64_t> TilesBuild::buildAll(TilesProgress& progress)
{
  std::vector<TileIndex> wanted;
  double points = 0.0;
  for (const auto& [tile, count] : tiles_->tiles)
  {
    if (!tileDone(tile))
    {
      wanted.push_back(tile);
      points += static_cast<double>(count);
    }
  }
  progress.beginTiles(points);
  const Result<AttributePasses> passes = this->passes();
  if (!passes)
  {
    return passes.error();
  }
  const auto stages = static_cast<unsigned>(2 +
    std::count_if(passes->begin(), passes->end(), [](const auto& p) { return p->reach() > 0.0; }));
  std::vector<std::string> faults;
  Error first;
  for (std::size_t n = 0; n < wanted.size(); ++n)
  {
    const std::string name =
      "tile " + std::to_string(n + 1) + " of " + std::to_string(wanted.size());
    const Result<void> done = buildNow(
      wanted[n], progress.part(name, static_cast<double>(tiles_->tiles.at(wanted[n])), stages));
    if (!done && done.error().kind == Error::Kind::Cancelled)
    {
      return done.error();
    }
    if (!done)
    {
      first = faults.empty() ? done.error() : first;
      faults.push_back("tile " + wanted[n].name() + ": " + done.error().what);
    }
  }
  if (faults.empty())
  {
    return std::uint64_t(wanted.size());
  }
  constexpr std::size_t mostNamed = 5;
  std::string what = std::to_string(faults.size()) + " of " + std::to_string(wanted.size()) +
    " tiles were not built (the others are; the same command goes on)";
  for (std::size_t f = 0; f < std::min(mostNamed, faults.size()); ++f)
  {
    what += (f == 0 ? ": " : "; ") + faults[f];
  }
  return makeError(first.kind, what);
}

Result<TilesReport> TilesBuild::all()
{
  const auto begin = std::chrono::steady_clock::now();
  TilesProgress progress(request_.progress);
  if (const Result<bool> done = plan(); !done)
  {
    return done.error();
  }
  if (Result<void> done = surveyAll(progress); !done)
  {
    return done.error();
  }
  if (const Result<bool> done = settle(); !done)
  {
    return done.error();
  }
  const Result<std::uint64_t> built = buildAll(progress);
  if (!built)
  {
    return built.error();
  }
  Result<TilesReport> report = collect();
  if (report)
  {
    report->built = *built;
    const auto end = std::chrono::steady_clock::now();
    report->sums.seconds = std::chrono::duration<double>(end - begin).count();
  }
  return report;
}

std::string TilesBuild::collectionPath() const
{
  const fs::path folder = fs::absolute(request_.folder).lexically_normal();
  const std::string name =
    folder.has_filename() ? folder.filename().string() : folder.parent_path().filename().string();
  return request_.folder + "/" + name + ".pfcollection";
}

void TilesBuild::tellWarnings(const std::vector<TileRecord>& records) const
{
  std::map<std::string, std::vector<std::string>> warnings;
  std::map<std::string, std::vector<std::string>> findings;
  std::set<std::string> ofInputs;
  for (const TileRecord& record : records)
  {
    const std::string tile = record.file.substr(0, record.file.rfind('-'));
    for (const std::string& text : record.warnings)
    {
      warnings[text].push_back(tile);
    }
    for (const std::string& text : record.findings)
    {
      findings[text].push_back(tile);
    }
    ofInputs.insert(record.ofInputs.begin(), record.ofInputs.end());
  }
  const auto tell = [this](const auto& texts, const char* one, const char* many)
  {
    for (const auto& [text, tiles] : texts)
    {
      const std::string where = tiles.size() == 1 ? "tile " + tiles.front() + one
                                                  : std::to_string(tiles.size()) + " tiles" + many;
      request_.warn(where + ": " + text);
    }
  };
  for (const std::string& text : ofInputs)
  {
    request_.warn(text);
  }
  tell(warnings, "", "");
  tell(findings, " and its margin", " and their margins");
}

/// Tiles that are no part any more, points that were kept, and what killed processes left. Never
/// what others keep there.
void TilesBuild::removeOthers(const std::vector<TileRecord>& records) const
{
  std::set<std::string> kept;
  for (const TileRecord& record : records)
  {
    kept.insert(record.file);
  }
  for (const auto& [tile, points] : tiles_->tiles)
  {
    kept.insert(fs::path(tilePath(tile)).filename().string());
  }
  std::error_code failure;
  std::set<fs::path> inputs; // they may lie anywhere
  for (const PlannedInput& input : plan_->inputs)
  {
    inputs.insert(fs::weakly_canonical(input.path, failure));
  }
  const auto removeFrom = [&](const std::string& folder, const auto& isOwn)
  {
    for (const auto& entry : fs::directory_iterator(folder, failure))
    {
      const std::string name = entry.path().filename().string();
      std::error_code ignored;
      if (isOwn(name) && kept.count(name) == 0 &&
        fs::is_regular_file(entry.symlink_status(ignored)) &&
        inputs.count(fs::weakly_canonical(entry.path(), ignored)) == 0)
      {
        fs::remove(entry.path(), ignored);
      }
    }
  };
  removeFrom(request_.folder + "/tiles", isNameOfTile);
  removeFrom(request_.folder + "/work",
    [](const std::string& name) { return isNameOfRecord(name) || isNameOfPoints(name); });
}

Result<void> TilesBuild::writeCollection(const std::vector<TileRecord>& records)
{
  const std::string path = collectionPath();
  std::vector<TileRequest> requests;
  std::string content;
  for (const TileRecord& record : records)
  {
    TileRequest request;
    request.path = storePath(record.file);
    request.address = "tiles/" + record.file;
    request.identity = record.identity;
    request.name = record.file.substr(0, record.file.rfind('-'));
    requests.push_back(std::move(request));
    content += record.file + toJson(record.identity).dump();
  }
  const std::string key = hex(hashOfText(content));
  const auto before = loadRecord<CollectionNote>(work("collection.json"));
  std::error_code failure;
  if (fs::exists(path, failure))
  {
    const Result<TileIdentity> now = TileIdentity::of(path);
    const bool ours = before && now && *now == before->identity;
    if (ours && before->key == key)
    {
      return {};
    }
    if (!ours && now && isOf(path, records)) // a kill came before the note
    {
      return replaceFile(work("collection.json"), CollectionNote{ key, *now }.json().dump(1));
    }
    if (!ours && !request_.force)
    {
      return makeError(Error::Kind::Unwritable,
        path + ": is not as this build left it; --force makes it anew, without the changes");
    }
  }
  CollectionOptions options;
  options.sameSystem = sameSystems;
  options.progress = request_.progress;
  if (const Result<CollectionReport> made = createCollection(path, requests, options); !made)
  {
    return made.error();
  }
  const Result<TileIdentity> identity = TileIdentity::of(path);
  if (!identity)
  {
    return identity.error();
  }
  return replaceFile(work("collection.json"), CollectionNote{ key, *identity }.json().dump(1));
}

Result<TilesReport> TilesBuild::collect()
{
  if (Result<void> ready = loadTiles(); !ready)
  {
    return ready.error();
  }
  TilesReport report;
  std::vector<TileRecord> records;
  report.sums.pointsRead = tiles_->read;
  report.sums.pointsRejected = tiles_->rejected;
  report.sums.spilledBytes = tiles_->keptBytes;
  for (const auto& [path, why] : tiles_->skipped)
  {
    report.sums.inputsSkipped.push_back({ path, why });
  }
  for (const auto& [tile, points] : tiles_->tiles)
  {
    std::optional<TileRecord> record = tileDone(tile);
    if (!record)
    {
      return makeError(Error::Kind::NotFound,
        "tile " + tile.name() + " is not built; run --only tile:" + tile.name() + " first");
    }
    report.sums.pointsStored += record->points;
    report.sums.nodes += record->nodes;
    report.sums.bytesWritten += record->bytes;
    report.sums.spilledBytes += record->spilled;
    report.sums.cpuSeconds += record->cpuSeconds;
    for (const auto& [reason, count] : record->rejected)
    {
      report.sums.pointsRejected[reason] += count;
    }
    records.push_back(std::move(*record));
  }
  std::map<std::string, std::uint64_t> leftOut = report.sums.pointsRejected;
  leftOut.erase("missing"); // they were not read
  if (report.sums.pointsRead != report.sums.pointsStored + sumOf(leftOut))
  {
    return makeError(Error::Kind::Corrupt,
      "internal: of " + std::to_string(report.sums.pointsRead) + " points read, " +
        std::to_string(report.sums.pointsStored) + " are in tiles and " +
        std::to_string(sumOf(leftOut)) + " were rejected; please report this");
  }
  if (Result<void> done = writeCollection(records); !done)
  {
    return done.error();
  }
  removeOthers(records);
  tellWarnings(records);
  report.tiles = records.size();
  report.collection = collectionPath();
  return report;
}

} // namespace pointfront
