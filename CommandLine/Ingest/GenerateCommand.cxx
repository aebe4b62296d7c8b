#include "GenerateCommand.h"

#include "CancelSignal.h"
#include "KnownWords.h"
#include "ProgressDisplay.h"
#include "SinkFormats.h"
#include "Values.h"

#include "pointfront/Export/SourceExport.h"
#include "pointfront/Generate/TerrainSource.h"

#include <cstdio>

namespace pointfront
{

void GenerateCommand::declare(CLI::App& program)
{
  const std::uint64_t most = 1000000000000; // 10^12
  app_ = program.add_subcommand(
    "generate", "Make up an airborne survey: ground, water, vegetation, buildings");
  app_->add_option("--points", points_, "How many")
    ->required()
    ->transform(wholeNumber())
    ->check(CLI::Range(std::uint64_t(1), most))
    ->type_name("N");
  app_->add_option("-o,--output", outputPath_, "The file to write")
    ->required()
    ->check(sinkExtension());
  app_
    ->add_option(
      "--seed", seed_, "Another landscape for another number (24); many lack some of the classes")
    ->check(wholeNumberOf64Bits())
    ->type_name("S");
  app_->add_flag("--force", replace_, "Replace an existing file of the same kind");
  app_->add_option("--progress", progress_, "On stderr: auto, plain, json or none (auto)")
    ->check(knownWords({ "auto", "plain", "json", "none" }));
}

Result<void> GenerateCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Finish);
  Result<void> checked = checkOutputTarget({ outputPath_, sinkKind(outputPath_), replace_ });
  if (!checked)
  {
    return checked;
  }
  const TerrainSource survey(points_, seed_);
  SinkChoice choice;
  choice.dated = false; // the same numbers give the same file
  const Result<std::unique_ptr<PointSink>> made = makeSink(outputPath_, choice);
  if (!made)
  {
    return made.error();
  }
  PointSink& sink = **made;
  std::uint64_t written = 0;
  {
    ProgressDisplay display(*ProgressDisplay::styleOf(progress_));
    const Result<std::uint64_t> exported = exportSource(survey, sink, display.function());
    if (!exported)
    {
      return exported.error();
    }
    written = exported.value();
  }
  std::printf("%s: %llu points\n", outputPath_.c_str(), static_cast<unsigned long long>(written));
  return {};
}

} // namespace pointfront
