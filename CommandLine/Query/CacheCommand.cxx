#include "CacheCommand.h"

#include "ByteSize.h"
#include "KnownWords.h"

#include "pointfront/Disk/FarCache.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace pointfront
{
namespace
{
Error noCache()
{
  return makeError(Error::Kind::NotFound,
    "there is no cache: it is switched off, or its folder cannot be written; see POINTFRONT_CACHE");
}

std::string reportJson(const FarCache::Report& report, bool verified)
{
  nlohmann::ordered_json object;
  object["folder"] = report.folder;
  object["bytes"] = report.bytes;
  object["limit_bytes"] = report.mostBytes;
  object["segments"] = report.segments;
  if (verified)
  {
    object["ok"] = report.damaged == 0;
    object["blocks_checked"] = report.blocks;
    object["segments_damaged"] = report.damaged;
  }
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string reportText(const FarCache::Report& report)
{
  return report.folder + ": " + byteSizeText(report.bytes) + " of " +
    byteSizeText(report.mostBytes) + " in " + std::to_string(report.segments) + " segments";
}
} // namespace

void CacheCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("cache", "What addresses have given, kept on this machine's disk");
  app_
    ->add_option("what", what_,
      "info: where it is and how large; clear: take it out; verify: compare every block with its "
      "checksum, and take out what is damaged")
    ->required()
    ->type_name("info|clear|verify")
    ->check(knownWords({ "info", "clear", "verify" }));
  app_->add_flag("--json", json_, "Print one JSON object");
}

Result<void> CacheCommand::run()
{
  const Result<std::shared_ptr<const FarCache>> found = FarCache::ofProcess();
  if (!found)
  {
    return found.error();
  }
  const std::shared_ptr<const FarCache>& cache = *found;
  if (!cache)
  {
    return noCache();
  }
  if (what_ == "clear")
  {
    if (Result<void> cleared = cache->clear(); !cleared)
    {
      return cleared;
    }
  }
  const bool verifies = what_ == "verify";
  const FarCache::Report report = verifies ? cache->verify() : cache->report();
  const std::string text = json_ ? reportJson(report, verifies)
    : verifies && report.damaged == 0
    ? reportText(report) + ", " + std::to_string(report.blocks) + " blocks checked, all sound"
    : reportText(report);
  std::printf("%s\n", text.c_str());
  if (report.damaged > 0)
  {
    return makeError(Error::Kind::Corrupt,
      std::to_string(report.damaged) + " damaged segments of " + report.folder +
        " were taken out; they will be fetched again");
  }
  return {};
}

} // namespace pointfront
