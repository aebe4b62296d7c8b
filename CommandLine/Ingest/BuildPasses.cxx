#include "BuildPasses.h"

#include "ChosenPasses.h"

#include "pointfront/Base/LetterCase.h"

#include <algorithm>

namespace pointfront
{

void BuildPasses::declare(CLI::App& app)
{
  app
    .add_option("--crs", choice_.targetCrs,
      "Coordinate reference system of the store; utm: the zone of the first input (the inputs')")
    ->type_name("EPSG:N|WKTFILE|utm");
  app.add_option("--assume-crs", choice_.assumedCrs, "What inputs are in that do not name it")
    ->type_name("EPSG:N|WKTFILE");

  app
    .add_option("--color-from", choice_.colourFrom,
      "Colours from georeferenced images: files, patterns, folders; the first has right of way")
    ->type_name("IMG...")
    ->expected(1, -1);
  app
    .add_option(
      "--attribute-from", choice_.attributeFrom, "Values of georeferenced images, likewise")
    ->type_name("NAME=IMG...")
    ->expected(1, -1);

  normals_.declare(app);
  app.add_flag("--splat-radius", choice_.splatRadius,
    "Measure around each point how large it must be drawn; comes with --normals pca");
  heights_.declare(app);
  app.parse_complete_callback([this]() { normals_.check(); });
}

std::vector<std::string> BuildPasses::inputsAmongImages(
  const std::vector<std::string>& pointExtensions)
{
  std::vector<std::string> inputs;
  for (std::vector<std::string>* words : { &choice_.colourFrom, &choice_.attributeFrom })
  {
    const auto isPoints = [&pointExtensions](const std::string& word)
    {
      const std::string extension = loweredExtension(word);
      return word.find('=') == std::string::npos && !extension.empty() &&
        std::find(pointExtensions.begin(), pointExtensions.end(), extension.substr(1)) !=
        pointExtensions.end();
    };
    if (words->empty())
    {
      continue;
    }
    // The first is what the option is about, whatever it is called.
    const auto images = std::stable_partition(words->begin() + 1, words->end(),
      [&isPoints](const std::string& word) { return !isPoints(word); });
    inputs.insert(inputs.end(), images, words->end());
    words->erase(images, words->end());
  }
  return inputs;
}

PassChoice BuildPasses::choice() const
{
  PassChoice choice = choice_;
  normals_.fill(choice);
  heights_.fill(choice);
  return choice;
}

Result<AttributePasses> BuildPasses::passes() const
{
  return chosenPasses(choice());
}

} // namespace pointfront
