#include "CompareCommand.h"

#include "CancelSignal.h"
#include "DrawingOptions.h"
#include "PNGReader.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace pointfront
{

namespace
{
nlohmann::ordered_json numberOrNull(const std::optional<double>& value)
{
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}
} // namespace

void CompareCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("compare", "Measure how far a picture is from another");
  app_->add_option("drawn", drawnPath_, "The picture to judge")->required()->type_name("A.png");
  app_->add_option("reference", referencePath_, "What it should be")
    ->required()
    ->type_name("B.png");
  app_->add_option("--mask", maskPath_, "White where B shows a surface: compare there only")
    ->type_name("M.png");
  const auto background = [this](const std::string& text)
  {
    const auto colour = parseColour(text);
    if (!colour)
    {
      throw CLI::ValidationError("--background",
        "'" + text +
          "' is not a colour: write R,G,B "
          "with 0 to 255");
    }
    background_.emplace();
    for (std::size_t i = 0; i < 3; ++i)
    {
      (*background_)[i] = std::uint8_t(std::lround(255.0 * (*colour)[i]));
    }
  };
  app_
    ->add_option_function<std::string>(
      "--background", background, "Colour behind the points (most frequent in B outside the mask)")
    ->type_name("R,G,B");
  app_->add_flag("--json", json_, "Print one JSON object");
}

Result<void> CompareCommand::run()
{
  const CancelSignal signal(CancelSignal::Mode::Leave);
  const Result<Picture> drawn = readPNG(drawnPath_);
  if (!drawn)
  {
    return drawn.error();
  }
  const Result<Picture> reference = readPNG(referencePath_);
  if (!reference)
  {
    return reference.error();
  }
  ComparisonOptions options;
  options.background = background_;
  Picture mask;
  if (!maskPath_.empty())
  {
    Result<Picture> read = readPNG(maskPath_);
    if (!read)
    {
      return read.error();
    }
    mask = std::move(*read);
    options.mask = &mask;
  }
  const Result<PictureComparison> compared = comparePictures(*drawn, *reference, options);
  if (!compared)
  {
    return makeError(compared.error().kind,
      "'" + drawnPath_ + "' and '" + referencePath_ + "': " + compared.error().what);
  }
  const std::string text = json_ ? comparisonJson(*compared) : comparisonText(*compared);
  std::printf("%s\n", text.c_str());
  return {};
}

std::string comparisonJson(const PictureComparison& comparison)
{
  nlohmann::ordered_json object;
  object["identical"] = comparison.identical;
  object["pixels"] = comparison.pixels;
  object["psnr"] = std::isinf(comparison.psnrDecibels)
    ? nlohmann::ordered_json()
    : nlohmann::ordered_json(comparison.psnrDecibels);
  object["ssim"] = comparison.ssim;
  object["share_over_8"] = comparison.shareOver8;
  object["mean_difference"] = comparison.meanDifference;
  object["holes"] = numberOrNull(comparison.holes);
  object["bloat"] = numberOrNull(comparison.bloat);
  object["background"] = comparison.background ? nlohmann::ordered_json(*comparison.background)
                                               : nlohmann::ordered_json();
  return object.dump(2);
}

std::string comparisonText(const PictureComparison& comparison)
{
  char line[160] = {};
  std::string text = std::to_string(comparison.pixels) + " pixels compared";
  if (comparison.identical)
  {
    text += ": the pictures are identical";
  }
  const auto add = [&](const char* format, double value)
  {
    std::snprintf(line, sizeof(line), format, value);
    text += line;
  };
  if (std::isinf(comparison.psnrDecibels))
  {
    text += "\n  PSNR            infinite: none of them differs";
  }
  else
  {
    add("\n  PSNR            %.2f dB", comparison.psnrDecibels);
  }
  add("\n  SSIM            %.4f", comparison.ssim);
  add("\n  off by over 8   %.3f %%", 100.0 * comparison.shareOver8);
  add("\n  mean difference %.3f", comparison.meanDifference);
  if (comparison.holes && comparison.bloat)
  {
    add("\n  holes           %.3f %%", *comparison.holes);
    add("\n  bloat           %.3f %%", *comparison.bloat);
  }
  return text;
}

} // namespace pointfront
