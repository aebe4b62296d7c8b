#include "StyleOptions.h"

#include "DrawingOptions.h"
#include "KnownWords.h"
#include "Values.h"

#include "StyleJSON.h"

#include "pointfront/Quality/QualityChoice.h"
#include "pointfront/Style/TechniqueNames.h"

#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

namespace
{
CLI::ParseError wrong(const std::string& option, const std::string& why)
{
  return CLI::ParseError(option + ": " + why, 2);
}

struct StyleArguments
{
  std::string file;
  std::string technique;
  std::string orientation;
  std::string where;
  std::map<std::uint8_t, double> shares;
};

/// "6=0.5,2=0.25"
std::map<std::uint8_t, double> sharesOf(const std::string& text)
{
  std::map<std::uint8_t, double> shares;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');)
  {
    const std::size_t sign = word.find('=');
    const auto code = parseClasses(word.substr(0, sign));
    const auto share =
      sign == std::string::npos ? std::nullopt : parseNumbers<1>(word.substr(sign + 1));
    const bool sound = code && code->size() == 1 && share && (*share)[0] >= 0.0 &&
      (*share)[0] <= 1.0 && shares.count(code->front()) == 0;
    if (!sound)
    {
      throw wrong("--class-share",
        "'" + text + "' is not a list of classes with shares from 0 to 1: write 6=0.5,2=0.25");
    }
    shares[code->front()] = (*share)[0];
  }
  return shares;
}

/// The words by which a style names an orientation.
const std::vector<std::pair<std::string, SplatOrientation>> orientations{
  { "auto", SplatOrientation::Automatic },
  { "normal", SplatOrientation::Normal },
  { "view", SplatOrientation::View },
};

StyleSheet readStyle(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
  {
    throw wrong("--style", path + ": cannot read the file");
  }
  Result<StyleSheet> sheet = parseStyleSheet(text.str());
  if (!sheet)
  {
    throw wrong("--style", path + ": " + sheet.error().what);
  }
  return std::move(*sheet);
}

/// Both conditions hold.
FilterExpression joined(const FilterExpression& file, const FilterExpression& option)
{
  if (file.empty() || option.empty())
  {
    return file.empty() ? option : file;
  }
  return FilterExpression::parse(file.text + " and " + option.text).value();
}

/// `hasError`: --error was given, and counts more.
void applyQuality(bool hasError, DrawingOptions& options, StyleSheet& sheet)
{
  const Result<QualityChoice> choice = chooseQuality(options.qualityAsked);
  if (!choice)
  {
    throw wrong("--quality", choice.error().what);
  }
  choice->preset.applyTo(sheet.standard);
  options.errorPx = hasError ? options.errorPx : choice->preset.errorPx;
  options.quality = choice->place ? std::optional<QualityChoice>(*choice) : std::nullopt;
}

/// An option of its own counts more than the preset.
StyleSheet makeStyle(const CLI::App& app, const StyleArguments& arguments, DrawingOptions& options)
{
  StyleSheet sheet = arguments.file.empty() ? StyleSheet() : readStyle(arguments.file);
  if (!options.qualityAsked.empty())
  {
    applyQuality(app.count("--error") > 0, options, sheet);
  }
  if (!arguments.technique.empty())
  {
    sheet.standard.technique = techniqueOf(arguments.technique);
  }
  for (const auto& [name, mode] : orientations)
  {
    if (name == arguments.orientation)
    {
      sheet.standard.orientation = StyleOrientation{ mode, {} };
    }
  }
  if (!options.colourBy.empty())
  {
    sheet.standard.colour = ColourSource::ofAttribute(options.colourBy);
  }
  if (app.count("--point-size") > 0)
  {
    sheet.standard.size = options.pointSizePx > 0.0
      ? StyleSize{ SplatSize::Mode::Pixels, options.pointSizePx, "" }
      : StyleSize();
  }
  for (const auto& [code, share] : arguments.shares)
  {
    sheet.classes[code].budgetShare = share;
  }
  if (!options.classes.empty())
  {
    sheet.shownClasses = options.classes;
  }
  if (options.eyeDomeLighting && sheet.standard.eyeDome)
  {
    sheet.standard.eyeDome->on = true;
  }
  else if (options.eyeDomeLighting && !(sheet.shading.eyeDomeStrength > 0.0f))
  {
    sheet.shading.eyeDomeStrength = usualEyeDomeStrength;
  }
  if (options.lit)
  {
    sheet.standard.light = sheet.standard.light.value_or(StyleLight());
    sheet.standard.light->on = *options.lit;
  }
  const Result<FilterExpression> where = FilterExpression::parse(arguments.where);
  if (!where || (where->empty() && app.count("--where") > 0))
  {
    throw wrong("--where", where ? noCondition : where.error().what);
  }
  sheet.where = joined(sheet.where, *where);
  return sheet;
}
} // namespace

void declareStyle(CLI::App& app, DrawingOptions& options)
{
  const auto arguments = std::make_shared<StyleArguments>();
  std::vector<std::string> techniques;
  for (const TechniqueTraits& traits : techniqueTraits)
  {
    techniques.emplace_back(traits.name);
  }
  app
    .add_option("--style", arguments->file,
      "How each class is drawn, as JSON (docs/user/styles.md); other options change its default")
    ->type_name("FILE.json")
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app
    .add_option("--quality", options.qualityAsked,
      "Technique and --error together: draft, balanced or exact; the fastest of an SSIM, as 0.95; "
      "or the most accurate of a frame time, as 33ms (none)")
    ->type_name("PRESET|SSIM|MS")
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.add_option("--technique", arguments->technique, "How points become pixels (points)")
    ->check(knownWords(techniques))
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  std::vector<std::string> words;
  for (const auto& [name, mode] : orientations)
  {
    words.push_back(name);
  }
  app
    .add_option("--orientation", arguments->orientation,
      "Discs face their normal or the eye (auto: normals that must be computed while nodes load "
      "are so only for ewa and --lit)")
    ->check(knownWords(words))
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app
    .add_option("--where", arguments->where,
      "Only points that meet it: 'ATTRIBUTE in [a, b]', 'in {1, 2}', ==, !=, <, <=, >, >=, and")
    ->type_name("CONDITION")
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app
    .add_option_function<std::string>(
      "--class-share", [arguments](const std::string& text) { arguments->shares = sharesOf(text); },
      "Shares of --point-budget and --memory that classes have before others, 0 to 1")
    ->type_name("CLASS=SHARE,...")
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.parse_complete_callback(
    [&app, &options, arguments]() { options.style = makeStyle(app, *arguments, options); });
}

} // namespace pointfront
