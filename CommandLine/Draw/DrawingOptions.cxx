#include "DrawingOptions.h"

#include "EpochOption.h"
#include "KnownWords.h"
#include "StyleOptions.h"
#include "Values.h"

#include <algorithm>
#include <map>

namespace pointfront
{

namespace
{
constexpr double largestPointSizePx = 255.0;

/// Calls `take` with the word; false from it is wrong usage, explained by `expected`.
template <typename Take>
CLI::callback_t word(const std::string& option, const std::string& expected, Take take)
{
  return [option, expected, take](const CLI::results_t& words) -> bool
  {
    if (!take(words.back()))
    {
      throw CLI::ParseError(option + ": '" + words.back() + "' is not " + expected, 2);
    }
    return true;
  };
}

void declareColour(CLI::App& app, DrawingOptions& options)
{
  app
    .add_option("--color-by", options.colourBy,
      "rgb, classification, intensity, elevation, normal, horizontality, global-height, "
      "local-height or an attribute (the first of them that says something)")
    ->type_name("ATTRIBUTE")
    ->expected(1)
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  const auto background = word("--background", "a colour: write R,G,B with 0 to 255",
    [&options](const std::string& text)
    {
      const auto colour = parseColour(text);
      options.background = colour.value_or(options.background);
      return colour.has_value();
    });
  app.add_option("--background", background, "Colour behind the points (a dark grey)")
    ->type_name("R,G,B")
    ->expected(1);
}

void declareBackend(CLI::App& app, DrawingOptions& options)
{
  const std::map<std::string, DrawingBackend> backends{ { "auto", DrawingBackend::Auto },
    { "opengl", DrawingBackend::OpenGL }, { "software", DrawingBackend::Software } };
  const auto take = [&options, backends](const std::string& text)
  { options.backend = backends.at(text); };
  app
    .add_option_function<std::string>("--backend", take,
      "software: no display and no GL needed; opengl: VTK, on an X server (auto: software)")
    ->check(knownWords({ "auto", "opengl", "software" }));
}
} // namespace

std::optional<std::array<double, 3>> parseColour(const std::string& text)
{
  std::optional<std::array<double, 3>> colour = parseNumbers<3>(text);
  if (!colour)
  {
    return std::nullopt;
  }
  const double largest = std::max({ (*colour)[0], (*colour)[1], (*colour)[2] });
  const double scale = largest > 1.0 ? 1.0 / 255.0 : 1.0;
  for (double& channel : *colour)
  {
    if (channel < 0.0 || channel > 255.0)
    {
      return std::nullopt;
    }
    channel *= scale;
  }
  return colour;
}

void DrawingOptions::declare(CLI::App& app)
{
  app.add_option("stores", stores, "Stores, drawn together")->required()->type_name("STORE...");
  declareEpoch(app, stores);
  declareBackend(app, *this);
  const auto imageSize = word("--size", "a size of 1 to 65535 pixels each way: write 1280x720",
    [this](const std::string& text)
    {
      const auto edges = parseImageSize(text);
      size = edges.value_or(size);
      return edges.has_value();
    });
  app.add_option("--size", imageSize, "Pixels of the picture (1280x720)")
    ->type_name("WxH")
    ->expected(1);
  declareColour(app, *this);
  const auto pointSize = word("--point-size", "a diameter from 1 to 255 pixels, or auto",
    [this](const std::string& text)
    {
      const auto pixels = parseNumbers<1>(text);
      pointSizePx = pixels ? (*pixels)[0] : 0.0;
      return text == "auto" || (pixels && pointSizePx >= 1.0 && pointSizePx <= largestPointSizePx);
    });
  app.add_option("--point-size", pointSize, "Diameter of a point (auto: as the points' spacing)")
    ->type_name("PX|auto")
    ->expected(1);
  app.add_flag("--edl", eyeDomeLighting, "Eye-dome lighting: shade by depth");
  CLI::Option* const light = app.add_flag_callback(
    "--lit", [this] { lit = true; }, "Light from the eye on points that have a normal");
  app
    .add_flag_callback(
      "--unlit", [this] { lit = false; }, "No light, on spheres neither")
    ->excludes(light);
  app.add_option("--error", errorPx, "Projected point spacing to refine to (1)")
    ->check(numberBetween(0.01, 1000.0))
    ->type_name("PX");
  app.add_option("--point-budget", pointBudget, "Most points drawn at a time")
    ->transform(wholeNumber())
    ->check(CLI::Range(std::int64_t(1), std::int64_t(1) << 40))
    ->type_name("N");
  addByteSize(app, "--gpu-memory", gpuBytes,
    "Most GPU memory for points (as the points need; software takes none)");
  app
    .add_option("--detail", detail,
      "front: each part as fine as it projects; view: one level that fills the view (front)")
    ->check(knownWords({ "front", "view" }));
  addByteSize(app, "--memory", memoryBytes, "Most memory for decoded points and the picture (1G)");
  const auto shown = word("--classes", "a list of class codes: write 2,6",
    [this](const std::string& text)
    {
      const auto codes = parseClasses(text);
      classes = codes.value_or(classes);
      return codes.has_value();
    });
  app.add_option("--classes", shown, "Only these classes (stores built with --layers class)")
    ->type_name("LIST")
    ->expected(1);
  declareStyle(app, *this);
}

} // namespace pointfront
