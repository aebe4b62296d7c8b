#include "DrawingOptions.h"

#include <gtest/gtest.h>

#include <fstream>

namespace pointfront
{

namespace
{
/// As one command among others parses them.
DrawingOptions parsed(std::vector<std::string> words)
{
  CLI::App program;
  CLI::App* const command = program.add_subcommand("render");
  DrawingOptions options;
  options.declare(*command);
  words.insert(words.begin(), { "render", "a.pfront" });
  std::reverse(words.begin(), words.end());
  program.parse(words);
  return options;
}

std::string refusal(const std::vector<std::string>& words)
{
  try
  {
    parsed(words);
  }
  catch (const CLI::ParseError& wrong)
  {
    return wrong.what();
  }
  return "";
}

std::string styleFile(const std::string& name, const std::string& text)
{
  const std::string path = testing::TempDir() + "/pointfront-style-" + name + ".json";
  std::ofstream(path) << text;
  return path;
}
} // namespace

TEST(StyleOptions, NothingSaidIsAnEmptySheet)
{
  EXPECT_EQ(parsed({}).style, StyleSheet());
}

TEST(StyleOptions, OptionsBecomeTheDefault)
{
  const StyleSheet sheet =
    parsed({ "--technique", "ewa", "--color-by", "intensity", "--point-size", "3", "--where",
             "return_number == 1", "--classes", "6,2", "--edl" })
      .style;
  EXPECT_EQ(sheet.standard.technique, Technique::Ewa);
  EXPECT_EQ(sheet.standard.colour, ColourSource::ofAttribute("intensity"));
  EXPECT_EQ(sheet.standard.size, (StyleSize{ SplatSize::Mode::Pixels, 3.0, "" }));
  EXPECT_EQ(sheet.where.text, "return_number == 1");
  EXPECT_EQ(*sheet.shownClasses, (std::vector<std::uint8_t>{ 2, 6 }));
  EXPECT_EQ(sheet.shading.eyeDomeStrength, usualEyeDomeStrength);
  EXPECT_EQ(parsed({ "--point-size", "auto" }).style.standard.size, StyleSize());
}

TEST(StyleOptions, OptionsChangeTheDefaultOfTheFile)
{
  const std::string path = styleFile("over", R"({"default": {"technique": "spheres",
    "color": "rgb"}, "classes": {"6": {"technique": "splats"}}, "where": "intensity > 2",
    "shading": {"mode": "edl", "strength": 0.8}})");
  const StyleSheet file = parsed({ "--style", path }).style;
  EXPECT_EQ(file.standard.technique, Technique::Spheres);
  const StyleSheet sheet =
    parsed({ "--where", "z < 9", "--edl", "--technique", "points", "--style", path }).style;
  EXPECT_EQ(sheet.standard.technique, Technique::Points);
  EXPECT_EQ(sheet.standard.colour, ColourSource::ofAttribute("rgb"));
  EXPECT_EQ(sheet.classes.at(6).technique, Technique::Splats);
  EXPECT_EQ(sheet.where.text, "intensity > 2 and z < 9");
  EXPECT_EQ(sheet.where.terms.size(), 2u);
  EXPECT_EQ(sheet.shading.eyeDomeStrength, 0.8f);
  EXPECT_FALSE(sheet.standard.light) << "nobody asked";
}

TEST(StyleOptions, LightIsTheDefaults)
{
  const std::string path = styleFile("light", R"({"default": {"technique": "spheres",
    "light": {"ambient": 0.1}, "edl": false}, "classes": {"6": {"light": false}}})");
  const auto look = [](const StyleSheet& sheet) { return sheet.frameShading().look(0); };
  EXPECT_TRUE(look(parsed({ "--technique", "spheres" }).style).lit);
  EXPECT_FALSE(look(parsed({ "--technique", "spheres", "--unlit" }).style).lit);
  EXPECT_TRUE(look(parsed({ "--technique", "splats", "--lit" }).style).lit);
  const StyleSheet lit = parsed({ "--style", path, "--lit", "--edl" }).style;
  EXPECT_EQ(look(lit).ambient, 0.1f);
  EXPECT_EQ(look(lit).eyeDomeStrength, usualEyeDomeStrength);
  EXPECT_EQ(lit.classes.at(6).light, (StyleLight{ false, {}, {} }));
  EXPECT_FALSE(look(parsed({ "--style", path, "--unlit" }).style).lit);
}

TEST(StyleOptions, AQualityIsTechniqueAndErrorTogether)
{
  const DrawingOptions draft = parsed({ "--quality", "draft" });
  EXPECT_EQ(draft.style.standard.technique, Technique::Splats);
  EXPECT_EQ(draft.style.standard.blended, false);
  EXPECT_EQ(draft.errorPx, 2.0);
  const DrawingOptions exact = parsed({ "--quality", "exact", "--error", "1.5" });
  EXPECT_EQ(exact.style.standard.technique, Technique::Ewa);
  EXPECT_EQ(exact.style.standard.accuracy, SplatAccuracy::Affine);
  EXPECT_EQ(exact.errorPx, 1.5) << "an option of its own counts more";
  EXPECT_EQ(parsed({ "--technique", "spheres", "--quality", "balanced" }).style.standard.technique,
    Technique::Spheres);
  EXPECT_NE(refusal({ "--quality", "best" }).find("best"), std::string::npos);
}

TEST(StyleOptions, SharesOfClassesGoOverThoseOfTheFile)
{
  const std::string path = styleFile("shares", R"({"classes": {"6": {"budget_share": 0.1},
    "9": {"budget_share": 0.2}}})");
  const StyleSheet sheet = parsed({ "--class-share", "6=0.5,2=.25", "--style", path }).style;
  EXPECT_EQ(sheet.classes.at(6).budgetShare, 0.5);
  EXPECT_EQ(sheet.classes.at(2).budgetShare, 0.25);
  EXPECT_EQ(sheet.classes.at(9).budgetShare, 0.2);
  EXPECT_TRUE(sheet.wantsShares());
  EXPECT_FALSE(parsed({ "--class-share", "6=0" }).style.wantsShares());
  for (const char* text : { "6", "6=2", "6=-1", "=0.5", "6=0.5,6=0.5", "300=0.5", "6=x" })
  {
    EXPECT_NE(refusal({ "--class-share", text }).find("write 6=0.5,2=0.25"), std::string::npos)
      << text;
  }
}

TEST(StyleOptions, WhatIsWrongIsNamed)
{
  EXPECT_EQ(refusal({ "--where", "z = 3" }),
    "--where: 'z = 3', character 3: expected 'in', ==, !=, <, <=, > or >=, not '= 3'");
  EXPECT_NE(refusal({ "--technique", "dots" }).find("'dots' is unknown"), std::string::npos);
  const std::string path = styleFile("wrong", R"({"classes": {"6": {"size": {"mode": "big"}}}})");
  EXPECT_EQ(refusal({ "--style", path }),
    "--style: " + path + ": classes.6.size.mode: 'big' is unknown: use fixed, spacing, attribute");
  EXPECT_EQ(
    refusal({ "--style", "/nowhere.json" }), "--style: /nowhere.json: cannot read the file");
}

} // namespace pointfront
