#include "StyleJSON.h"

#include <gtest/gtest.h>

using namespace pointfront;

namespace
{

StyleSheet parsed(const std::string& text)
{
  const auto sheet = parseStyleSheet(text);
  EXPECT_TRUE(sheet) << text << ": " << (sheet ? "" : sheet.error().what);
  return sheet ? *sheet : StyleSheet();
}

std::string refusal(const std::string& text)
{
  const auto sheet = parseStyleSheet(text);
  EXPECT_FALSE(sheet) << text;
  return sheet ? "" : sheet.error().what;
}

void expectRefusal(const char* text, const char* what)
{
  EXPECT_EQ(refusal(text), what) << text;
}

} // namespace

TEST(StyleJSON, EveryKeyIsUnderstood)
{
  const StyleSheet sheet = parsed(R"({
    "default": { "technique": "splats", "color": "rgb", "size": {"mode": "spacing", "factor": 1.5},
                 "orientation": "view", "opacity": 0.5, "visible": true, "error_factor": 2,
                 "budget_share": 0.25,
                 "blended": true, "accuracy": "exact", "where": "intensity > 3",
                 "epoch": "2024-07" },
    "classes": { "5": { "technique": "spheres",
                        "color": {"attribute": "local-height", "map": "viridis", "range": [0, 20]},
                        "size": {"mode": "fixed", "metres": 0.25}, "orientation": [0, 0, 2] },
                 "9": { "visible": false, "rim_color": "#ff0000",
                        "wall_color": ["#808080", "#404040"], "size": {"mode": "attribute"} } },
    "show_classes": [9, 2, 5], "where": "gps_time in [1, 2]",
    "shading": { "mode": ["lit", "edl"], "strength": 0.7, "radius_px": 2, "ambient": 0.1,
                 "diffuse": 0.9, "fill_holes": true } })");
  EXPECT_EQ(sheet.standard.technique, Technique::Splats);
  EXPECT_EQ(sheet.standard.colour, ColourSource::ofAttribute("rgb"));
  EXPECT_EQ(sheet.standard.size, (StyleSize{ SplatSize::Mode::Spacing, 1.5, "" }));
  EXPECT_EQ(sheet.standard.orientation->mode, SplatOrientation::View);
  EXPECT_EQ(sheet.standard.opacity, 0.5);
  EXPECT_EQ(sheet.standard.visible, true);
  EXPECT_EQ(sheet.standard.errorFactor, 2.0);
  EXPECT_EQ(sheet.standard.budgetShare, 0.25);
  EXPECT_EQ(sheet.standard.blended, true);
  EXPECT_EQ(sheet.standard.accuracy, SplatAccuracy::Exact);
  EXPECT_EQ(sheet.standard.where->text, "intensity > 3");
  EXPECT_EQ(sheet.standard.epoch, "2024-07");
  ASSERT_EQ(sheet.classes.size(), 2u);
  const LayerStyle& five = sheet.classes.at(5);
  EXPECT_EQ(five.colour->map.kind, ColourMapChoice::Kind::Viridis);
  EXPECT_EQ(*five.colour->map.range, (std::array<double, 2>{ 0.0, 20.0 }));
  EXPECT_EQ(five.size, (StyleSize{ SplatSize::Mode::World, 0.25, "" }));
  EXPECT_EQ(five.orientation->direction, glm::dvec3(0, 0, 2));
  EXPECT_FALSE(five.opacity);
  const LayerStyle& nine = sheet.classes.at(9);
  EXPECT_EQ(nine.visible, false);
  EXPECT_EQ(nine.rim, (Rgba8{ 255, 0, 0, 255 }));
  EXPECT_EQ((*nine.wall)[1], (Rgba8{ 64, 64, 64, 255 }));
  EXPECT_EQ(nine.size, (StyleSize{ SplatSize::Mode::Attribute, 1.0, "" }));
  EXPECT_EQ(*sheet.shownClasses, (std::vector<std::uint8_t>{ 2, 5, 9 }));
  EXPECT_EQ(sheet.where.text, "gps_time in [1, 2]");
  EXPECT_TRUE(sheet.shading.lit);
  EXPECT_EQ(sheet.shading.eyeDomeStrength, 0.7f);
  EXPECT_EQ(sheet.shading.eyeDomeRadiusPx, 2.0f);
  EXPECT_EQ(sheet.shading.ambient, 0.1f);
  EXPECT_TRUE(sheet.shading.fillHoles);
  EXPECT_TRUE(parseStyleSheet(writeStyleSheet(sheet)));
  EXPECT_EQ(parsed(writeStyleSheet(sheet)), sheet) << writeStyleSheet(sheet);
}

TEST(StyleJSON, ColoursAreNamesConstantsMapsOrTwo)
{
  const auto colour = [](const std::string& text)
  {
    const StyleSheet sheet = parsed(R"({"default": {"color": )" + text + "}}");
    EXPECT_EQ(parsed(writeStyleSheet(sheet)), sheet) << writeStyleSheet(sheet);
    return *sheet.standard.colour;
  };
  EXPECT_EQ(colour(R"("auto")"), ColourSource());
  EXPECT_EQ(colour(R"("#102030")"), ColourSource::ofConstant({ 16, 32, 48, 255 }));
  EXPECT_EQ(colour(R"({"attribute": "auto"})"), ColourSource::ofAttribute("auto"));
  const ColourSource list = colour(
    R"({"attribute": "rgb[1]", "map": ["#000000", "#ff0000"], "range": [1, 2],
        "logarithmic": true})");
  EXPECT_EQ(list.map.colours.size(), 2u);
  EXPECT_TRUE(list.map.logarithmic);
  EXPECT_FALSE(colour(R"({"attribute": "intensity", "map": "grey", "range": "auto"})").map.range);
  const ColourSource mixed = colour(R"({"mix": ["rgb", "#ffffff"], "share": 0.25})");
  EXPECT_EQ(mixed.combination, ColourCombination::Mix);
  EXPECT_EQ(mixed.share, 0.25);
  EXPECT_EQ(colour(R"({"multiply": ["rgb", "intensity"]})").parts.size(), 2u);
  EXPECT_EQ(colour(R"({"hue": "classification", "value": "intensity"})").combination,
    ColourCombination::HueValue);
}

TEST(StyleJSON, NothingSaidIsAnEmptySheet)
{
  EXPECT_EQ(parsed("{}"), StyleSheet());
  EXPECT_EQ(writeStyleSheet({}), "{}");
  EXPECT_EQ(parsed(R"({"default": {}, "shading": {"mode": []}})"), StyleSheet());
  EXPECT_EQ(parsed(R"({"shading": {"mode": "none"}})"), parsed(R"({"default": {"light": false}})"));
}

TEST(StyleJSON, LightAndEyeDomeLightingOfAClassAreWrittenAsTheyAreRead)
{
  const StyleSheet sheet = parsed(R"({
    "default": {"technique": "spheres", "edl": true},
    "classes": {
      "2": {"light": true, "edl": false},
      "5": {"light": {"ambient": 0.1}, "edl": {"strength": 0.7, "radius_px": 3}},
      "6": {"light": false, "edl": {}},
      "9": {"light": {"on": false, "ambient": 0.2}}},
    "shading": {"ambient": 0.5}})");
  EXPECT_EQ(sheet.standard.eyeDome, StyleEyeDome());
  EXPECT_EQ(sheet.classes.at(2).light, StyleLight());
  EXPECT_EQ(sheet.classes.at(2).eyeDome, (StyleEyeDome{ false, {}, {} }));
  EXPECT_EQ(sheet.classes.at(5).light, (StyleLight{ true, 0.1f, {} }));
  EXPECT_EQ(sheet.classes.at(5).eyeDome, (StyleEyeDome{ true, 0.7f, 3.0f }));
  EXPECT_EQ(sheet.classes.at(6).light, (StyleLight{ false, {}, {} }));
  EXPECT_EQ(sheet.classes.at(9).light, (StyleLight{ false, 0.2f, {} }));
  EXPECT_EQ(sheet.frameShading().ambient, 0.5f) << "of spheres that nobody asked light for";
  EXPECT_EQ(parsed(writeStyleSheet(sheet)), sheet);
  expectRefusal(
    R"({"default": {"light": 1}})", "default.light: expected true, false or an object, not 1");
  expectRefusal(R"({"classes": {"5": {"edl": {"radius": 1}}}})",
    "classes.5.edl.radius: there is no such key; use on, strength, radius_px; did you mean "
    "'radius_px'?");
  expectRefusal(R"({"shading": {"ambient": 0.5}})",
    "shading.ambient: means something where points are lit only");
}

TEST(StyleJSON, LensesAndHighlightsAreWrittenAsTheyAreRead)
{
  const StyleSheet sheet = parsed(R"({
    "lenses": [
      {"shape": "circle", "center_px": [640, 360.5], "radius_px": 120,
       "inside": {"default": {"color": "intensity"}, "5": {"visible": false}}},
      {"shape": "rectangle", "center_px": [10, 20], "size_px": [30, 41], "inside": {}},
      {"shape": "mask", "mask": [".#", "#."], "inside": {}},
      {"around_class": 14, "radius": 10.5, "inside": {"5": {"opacity": 0.5}}}],
    "highlight": [{"class": 6, "color": "#ff0080", "halo_px": 3, "tint": 0.1}, {"class": 2}]})");
  ASSERT_EQ(sheet.lenses.size(), 4u);
  EXPECT_EQ(sheet.lenses[0].place.centrePx, glm::vec2(640.0f, 360.5f));
  EXPECT_EQ(sheet.lenses[0].place.halfSizePx, glm::vec2(120.0f));
  EXPECT_EQ(sheet.lenses[0].classes.at(5).visible, false);
  EXPECT_EQ(sheet.lenses[0].standard.colour, ColourSource::ofAttribute("intensity"));
  EXPECT_EQ(sheet.lenses[1].place.halfSizePx, glm::vec2(15.0f, 20.5f));
  EXPECT_EQ(sheet.lenses[2].place.mask->values, (std::vector<std::uint8_t>{ 1, 0, 0, 1 }))
    << "the lower row first";
  EXPECT_EQ(sheet.lenses[3].aroundClass, 14);
  EXPECT_EQ(sheet.lenses[3].aroundRadius, 10.5);
  ASSERT_EQ(sheet.highlights.size(), 2u);
  EXPECT_EQ(sheet.highlights[0].colour, (Rgba8{ 255, 0, 128, 255 }));
  EXPECT_EQ(sheet.highlights[0].haloPx, 3.0f);
  EXPECT_EQ(sheet.highlights[1].objectClass, 2);
  EXPECT_EQ(parsed(writeStyleSheet(sheet).c_str()), sheet);
}

TEST(StyleJSON, RefusalsBeginWithTheirPlace)
{
  expectRefusal(R"({"classes": {"6": {"size": {"mode": "big"}}}})",
    "classes.6.size.mode: 'big' is unknown: use fixed, spacing, attribute");
  expectRefusal(R"({"classes": {"6": {"colour": "rgb"}}})",
    "classes.6.colour: there is no such key; use technique, color, size, orientation, opacity, "
    "visible, error_factor, budget_share, blended, accuracy, rim_color, wall_color, where, "
    "epoch, light, edl; did you mean 'color'?");
  expectRefusal(R"({"classes": {"256": {}}})", "classes.256: a class is a code from 0 to 255");
  expectRefusal(R"({"classes": {"06": {}}})", "classes.06: a class is a code from 0 to 255");
  expectRefusal(
    R"({"classes": {"ground": {}}})", "classes.ground: a class is a code from 0 to 255");
  expectRefusal(
    R"({"default": {"opacity": 2}})", "default.opacity: expected a number from 0.0 to 1.0, not 2");
  expectRefusal(R"({"default": {"visible": 1}})", "default.visible: expected true or false, not 1");
  expectRefusal(R"({"default": {"technique": "dots"}})",
    "default.technique: 'dots' is unknown: use points, splats, spheres, silhouettes, solid, ewa");
  expectRefusal(R"({"default": {"where": "intensity = 3"}})",
    "default.where: 'intensity = 3', character 11: expected 'in', ==, !=, <, <=, > or >=, not '= "
    "3'");
  expectRefusal(R"({"default": {"size": {"mode": "fixed", "px": 2, "metres": 3}}})",
    "default.size: a fixed size has either px or metres");
  expectRefusal(R"({"default": {"size": {"mode": "spacing", "px": 2}}})",
    "default.size.px: there is no such key; use mode, factor");
  expectRefusal(R"({"default": {"size": {"mode": "fixed", "px": 0}}})",
    "default.size.px: expected a number above 0, not 0");
  expectRefusal(R"({"default": {"color": {"attribute": "z", "range": [2, 1]}}})",
    "default.color.range: expected the smaller number first, not [2,1]");
  expectRefusal(R"({"default": {"color": {"mix": ["rgb", {"mix": ["rgb", "rgb"]}]}}})",
    "default.color.mix[1]: a combination is of two colours that are none themselves");
  expectRefusal(
    R"({"shading": {"strength": 1}})", "shading.strength: means something with the mode edl only");
  for (const char* text : { R"({"default": {"color": "#12"}})", R"({"default": {"color": 3}})",
         R"({"default": {"color": {"map": "grey"}}})", R"({"default": {"orientation": [0, 0, 0]}})",
         R"({"default": {"color": {"attribute": "a", "map": []}}})",
         R"({"default": {"color": {"attribute": "a", "map": "jet"}}})",
         R"({"default": {"wall_color": ["#000000"]}})", R"({"show_classes": [2, 300]})",
         R"({"show_classes": 2})", R"({"shading": {"mode": "dark"}})", R"({"classes": []})",
         R"({"default": {"error_factor": 0}})", R"({"classes": {"6": {"budget_share": 1.5}}})",
         R"({"default": {"accuracy": "best"}})" })
  {
    EXPECT_NE(refusal(text).find(": "), std::string::npos) << text;
  }
}

TEST(StyleJSON, RefusalsOfLensesAndHighlightsBeginWithTheirPlace)
{
  expectRefusal(R"({"lenses": {}})", "lenses: expected a list of lenses, not {}");
  expectRefusal(
    R"({"lenses": [{"inside": {}}]})", "lenses[0]: a lens has a shape, or around_class");
  expectRefusal(R"({"lenses": [{"shape": "circle", "center_px": [1, 2], "inside": {}}]})",
    "lenses[0]: expected the key radius_px");
  expectRefusal(
    R"({"lenses": [{"shape": "circle", "center_px": [1, 2], "radius_px": -1, "inside": {}}]})",
    "lenses[0].radius_px: expected a number from 0.0 to 1000000.0, not -1");
  expectRefusal(R"({"lenses": [{"shape": "mask", "mask": ["##", "#"], "inside": {}}]})",
    "lenses[0].mask[0]: rows of a mask are of one length, which is not 0");
  expectRefusal(R"({"lenses": [{"around_class": 300, "radius": 1, "inside": {}}]})",
    "lenses[0].around_class: a class is a code from 0 to 255");
  expectRefusal(R"({"lenses": [{"around_class": 6, "radius": 0, "inside": {}}]})",
    "lenses[0].radius: expected a number above 0, not 0");
  expectRefusal(
    R"({"lenses": [{"around_class": 6, "radius": 1, "inside": {"5": {"technique": "dots"}}}]})",
    "lenses[0].inside.5.technique: 'dots' is unknown: use points, splats, spheres, silhouettes, "
    "solid, ewa");
  expectRefusal(R"({"highlight": [{"class": 6}, {"class": 6}]})",
    "highlight[1].class: a class has one highlight");
  expectRefusal(R"({"highlight": [{"class": 6, "halo_px": 17}]})",
    "highlight[0].halo_px: expected a number from 0.0 to 16.0, not 17");
}

TEST(StyleJSON, TextThatIsNoSheetIsRefused)
{
  expectRefusal(R"({"default": {"opacity": 1, "opacity": 0}})",
    "the key \"opacity\" stands twice in one object");
  expectRefusal("[]", "the file: expected an object, not []");
  expectRefusal(R"({"default": 3})", "default: expected an object, not 3");
  expectRefusal(
    "{\"a\": 1e999}", "a number in it is too large for double precision; write one below 1e308");
  for (const char* text : { "", "{", R"({"default")", "nan", "\xff" })
  {
    EXPECT_EQ(refusal(text).rfind("not JSON: line 1, column ", 0), 0u)
      << text << ": " << refusal(text);
  }
}

TEST(StyleJSON, RefusalsOfTextsOfSeveralLinesNameTheLine)
{
  expectRefusal("{\n \"default\": {\"opacity\": 2}\n}\n",
    "line 2: default.opacity: expected a number from 0.0 to 1.0, not 2");
  expectRefusal("{\n \"classes\": {\"2\": {}, \"6\": {\n\n  \"opacity\":\n 2}}}\n",
    "line 4: classes.6.opacity: expected a number from 0.0 to 1.0, not 2");
  expectRefusal("{\"show_classes\": [2,\n 3,\n 300]}",
    "line 3: show_classes[2]: a class is a code from 0 to 255");
  expectRefusal("{\"lenses\": [\n{\"shape\": \"circle\",\n\"inside\": {}}]}",
    "line 2: lenses[0]: expected the key center_px"); // the line of the object
  expectRefusal("{\"where\": \"a > 1\",\n\"classes\": {},\n\"where\": \"a > 2\"}",
    "line 3: the key \"where\" stands twice in one object");
  expectRefusal("{\"default\": {\n\"technique\": \"dots\",\n}\n}",
    "not JSON: line 3, column 1: syntax error while parsing object key - unexpected '}'; expected "
    "string literal");
  // Brackets, quotes and line ends within strings do not count.
  expectRefusal("{\"where\": \"\\\"} a\\n\",\n\"shading\": 3}",
    "line 1: where: '\"} a\n', character 1: "
    "expected a name and a closing \", not '\"} a\n'");
}

TEST(StyleJSON, MisspeltNamesGetTheNearestOne)
{
  for (const auto& [text, meant] :
    { std::pair{ R"({"default": {"technique": "slpats"}})", "splats" },
      std::pair{ R"({"default": {"colour": "rgb"}})", "color" },
      std::pair{ R"({"clases": {}})", "classes" },
      std::pair{ R"({"classes": {"6": {"size": {"mode": "fixd", "px": 1}}}})", "fixed" },
      std::pair{ R"({"default": {"color": {"attribute": "z", "map": "virdis"}}})", "viridis" },
      std::pair{ R"({"shading": {"mode": "eld"}})", "edl" },
      std::pair{ R"({"highlight": [{"clas": 6}]})", "class" } })
  {
    EXPECT_NE(refusal(text).find("; did you mean '" + std::string(meant) + "'?"), std::string::npos)
      << refusal(text);
  }
}
