#include "VerifyCommand.h"

#include "CancelSignal.h"
#include "KnownWords.h"
#include "ProgressDisplay.h"

#include "pointfront/Tiles/StoredCloudFormats.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace pointfront
{

namespace
{
Result<VerifyReport> verifyStore(const std::string& path, const std::string& progress)
{
  Result<std::shared_ptr<const StoredCloud>> store = StoredCloudFormats::ofProcess().open(path);
  if (!store)
  {
    return store.error();
  }
  ProgressDisplay display(*ProgressDisplay::styleOf(progress));
  return (*store)->verify(display.function());
}
} // namespace

void VerifyCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("verify", "Check every checksum, count and invariant of a store");
  app_->add_option("store", path_, "The store")->required()->type_name("STORE");
  app_->add_option("--progress", progress_, "On stderr: auto, plain, json or none (auto)")
    ->check(knownWords({ "auto", "plain", "json", "none" }));
  app_->add_flag("--json", json_, "Print one JSON object");
}

Result<void> VerifyCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Finish);
  const Result<VerifyReport> verified = verifyStore(path_, progress_);
  if (!verified && verified.error().kind == Error::Kind::Cancelled)
  {
    return verified.error();
  }
  // A store that does not even open is a broken store: its report says so.
  VerifyReport report;
  if (verified)
  {
    report = verified.value();
  }
  else
  {
    report.ok = false;
    report.firstError = verified.error().what;
  }
  if (json_)
  {
    std::printf("%s\n", verifyReportJson(report).c_str());
  }
  if (!report.ok)
  {
    return makeError(Error::Kind::Corrupt, report.firstError);
  }
  if (!json_)
  {
    std::printf("%s: %llu nodes and %llu points checked, all sound\n", path_.c_str(),
      static_cast<unsigned long long>(report.nodesChecked),
      static_cast<unsigned long long>(report.pointsChecked));
  }
  return {};
}

std::string verifyReportJson(const VerifyReport& report)
{
  nlohmann::ordered_json object;
  object["ok"] = report.ok;
  object["nodes_checked"] = report.nodesChecked;
  object["points_checked"] = report.pointsChecked;
  object["first_error"] =
    report.ok ? nlohmann::ordered_json() : nlohmann::ordered_json(report.firstError);
  return object.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

} // namespace pointfront
