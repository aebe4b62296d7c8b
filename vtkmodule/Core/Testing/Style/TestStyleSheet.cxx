#include "ReferenceColours.h"
#include "StyledStore.h"

#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Style/TechniqueNames.h"

#include <gtest/gtest.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

std::shared_ptr<const ResolvedStyle> resolved(const StyleSheet& sheet, std::size_t layer = 0,
  const StoreDescription& store = styledStore({ 2, 5, 6 }))
{
  const auto style = sheet.resolve(store, layer);
  EXPECT_TRUE(style) << (style ? "" : style.error().what);
  return style ? *style : nullptr;
}

std::string refusal(const StyleSheet& sheet, const StoreDescription& store = styledStore({ 2, 5 }))
{
  const auto styles = sheet.resolveAll(store);
  EXPECT_FALSE(styles);
  return styles ? "" : styles.error().what;
}

std::vector<LayerStyling> all(const StyleSheet& sheet, const StoreDescription& store)
{
  const auto styles = sheet.resolveAll(store);
  EXPECT_TRUE(styles) << (styles ? "" : styles.error().what);
  return styles ? *styles : std::vector<LayerStyling>();
}

} // namespace

TEST(StyleSheet, SaysNothingMeansPointsThatCloseInTheColourThatSaysMost)
{
  const auto style = resolved({});
  EXPECT_EQ(style->technique, Technique::Points);
  EXPECT_EQ(style->size.mode, SplatSize::Mode::Spacing);
  EXPECT_EQ(style->colouring.kind, PointColouring::Kind::Direct);
  EXPECT_EQ(style->columns(), (ColumnSelection{ rgbColumn, splatRadiusColumn }));
}

TEST(StyleSheet, AnEditReadsWhatBecameNecessaryAndDropsWhatNoStyleReads)
{
  StyleSheet sheet;
  sheet.standard.size = StyleSize{ SplatSize::Mode::Pixels, 2.0, "" };
  sheet.standard.colour = ColourSource::ofConstant({ 1, 2, 3, 255 });
  EXPECT_EQ(resolved(sheet)->columns(), ColumnSelection{});
  sheet.standard.technique = Technique::Ewa;
  EXPECT_EQ(resolved(sheet)->columns(), ColumnSelection{ normalsColumn });
  sheet.standard.colour = ColourSource::ofAttribute("intensity");
  EXPECT_EQ(resolved(sheet)->columns(), (ColumnSelection{ intensityColumn, normalsColumn }));
  sheet.standard.where = *FilterExpression::parse("gps_time > 3");
  EXPECT_EQ(
    resolved(sheet)->columns(), (ColumnSelection{ intensityColumn, timeColumn, normalsColumn }));
  sheet.standard.orientation = StyleOrientation{ SplatOrientation::View, {} };
  EXPECT_EQ(resolved(sheet)->columns(), (ColumnSelection{ intensityColumn, timeColumn }));
  sheet.standard.technique = Technique::Points;
  sheet.shading.lit = true;
  EXPECT_EQ(
    resolved(sheet)->columns(), (ColumnSelection{ intensityColumn, timeColumn, normalsColumn }));
  sheet.shading.lit = false;
  sheet.standard.where = FilterExpression();
  sheet.standard.colour = ColourSource::ofAttribute("elevation");
  EXPECT_EQ(resolved(sheet)->columns(), ColumnSelection{});
}

TEST(StyleSheet, ClassesSayOnlyWhatDiffers)
{
  StyleSheet sheet;
  sheet.standard.technique = Technique::Splats;
  sheet.standard.colour = ColourSource::ofAttribute("rgb");
  sheet.standard.opacity = 0.5;
  sheet.classes[5].technique = Technique::Spheres;
  sheet.classes[5].colour = ColourSource::ofAttribute(
    "local-height", { ColourMapChoice::Kind::Viridis, {}, { { 0, 20 } } });
  sheet.classes[6].visible = false;
  sheet.classes[77].colour = ColourSource::ofAttribute("no such attribute"); // no layer has it
  const auto layers = all(sheet, styledStore({ 2, 5, 6 }));
  ASSERT_EQ(layers.size(), 3u);
  ASSERT_EQ(layers[0].styles.size(), 1u);
  EXPECT_EQ(layers[0].styles[0]->technique, Technique::Splats);
  EXPECT_EQ(layers[0].columns(), (ColumnSelection{ rgbColumn, normalsColumn, splatRadiusColumn }));
  ASSERT_EQ(layers[1].styles.size(), 1u);
  EXPECT_EQ(layers[1].styles[0]->technique, Technique::Spheres);
  EXPECT_EQ(layers[1].styles[0]->opacity, 0.5);
  EXPECT_EQ(layers[1].styles[0]->map->range, (std::array<double, 2>{ 0.0, 20.0 }));
  EXPECT_FALSE(layers[2].visible());
  EXPECT_TRUE(layers[2].columns().empty());
}

TEST(StyleSheet, LayersOfOneStyleShareIt)
{
  StyleSheet sheet;
  sheet.classes[2].errorFactor = 2.0; // not part of what back ends are given
  sheet.classes[6].opacity = 0.25;
  const auto layers = all(sheet, styledStore({ 2, 5, 6 }));
  EXPECT_EQ(layers[0].styles[0], layers[1].styles[0]);
  EXPECT_NE(layers[0].styles[0], layers[2].styles[0]);
  EXPECT_EQ(layers[0].errorFactor, 2.0);
  EXPECT_EQ(layers[1].errorFactor, 1.0);
}

/// Every class is drawn by one style, that of its own: as in a layered store.
TEST(StyleSheet, ClassesOfAnUnlayeredStoreAreFilters)
{
  StyleSheet sheet;
  sheet.classes[5].technique = Technique::Spheres;
  sheet.classes[6].visible = false;
  sheet.classes[9].technique = Technique::Spheres;
  sheet.classes[9].errorFactor = 0.5;
  const auto layers = all(sheet, styledStore({}));
  ASSERT_EQ(layers.size(), 1u);
  EXPECT_EQ(layers[0].errorFactor, 0.5);
  for (int code = 0; code < 256; ++code)
  {
    int drawnBy = 0;
    for (const auto& style : layers[0].styles)
    {
      ASSERT_EQ(style->filter.conditions.size(), 1u);
      EXPECT_EQ(style->filter.conditions[0].column, classColumn);
      if (style->filter.conditions[0].passes(code))
      {
        ++drawnBy;
        const bool sphere = code == 5 || code == 9;
        EXPECT_EQ(style->technique, sphere ? Technique::Spheres : Technique::Points) << code;
      }
    }
    EXPECT_EQ(drawnBy, code == 6 ? 0 : 1) << code;
  }
  const auto plain = all({}, styledStore({}));
  ASSERT_EQ(plain[0].styles.size(), 1u);
  EXPECT_TRUE(plain[0].styles[0]->filter.empty());
}

TEST(StyleSheet, ShownClassesHideAllOthers)
{
  StyleSheet sheet;
  sheet.shownClasses = std::vector<std::uint8_t>{ 2, 6 };
  sheet.classes[6].visible = false;
  const auto layered = all(sheet, styledStore({ 2, 5, 6 }));
  EXPECT_TRUE(layered[0].visible());
  EXPECT_FALSE(layered[1].visible());
  EXPECT_FALSE(layered[2].visible());
  const auto unlayered = all(sheet, styledStore({}));
  ASSERT_EQ(unlayered[0].styles.size(), 1u);
  EXPECT_EQ(unlayered[0].styles[0]->filter.conditions[0].values, std::vector<long double>{ 2.0 });
  StoreDescription without = styledStore({});
  without.schema = AttributeSchema();
  without.ranges.clear();
  EXPECT_NE(refusal(sheet, without).find("no point has a class"), std::string::npos);
}

TEST(StyleSheet, AHiddenDefaultDrawsOnlyTheClassesThatAreVisible)
{
  StyleSheet sheet;
  sheet.standard.visible = false;
  sheet.classes[6].visible = true;
  const auto unlayered = all(sheet, styledStore({}));
  ASSERT_EQ(unlayered[0].styles.size(), 1u);
  EXPECT_EQ(unlayered[0].styles[0]->filter.conditions[0].values, std::vector<long double>{ 6.0 });
  const auto layered = all(sheet, styledStore({ 2, 6 }));
  EXPECT_FALSE(layered[0].visible());
  EXPECT_TRUE(layered[1].visible());
}

TEST(StyleSheet, FiltersOfSheetAndClassBothHold)
{
  StyleSheet sheet;
  sheet.where = *FilterExpression::parse("intensity > 3");
  sheet.standard.where = *FilterExpression::parse("gps_time > 3");
  sheet.classes[5].where = *FilterExpression::parse("z < 9");
  const auto layers = all(sheet, styledStore({ 2, 5 }));
  ASSERT_EQ(layers[0].styles[0]->filter.conditions.size(), 2u);
  EXPECT_EQ(layers[0].styles[0]->filter.conditions[0].column, intensityColumn);
  EXPECT_EQ(layers[0].styles[0]->filter.conditions[1].column, timeColumn);
  ASSERT_EQ(layers[1].styles[0]->filter.conditions.size(), 2u);
  EXPECT_EQ(layers[1].styles[0]->filter.conditions[1].axis, 2);
}

TEST(StyleSheet, SizesNameColumns)
{
  StyleSheet sheet;
  sheet.standard.colour = ColourSource::ofConstant({});
  EXPECT_EQ(*resolved(sheet)->radiusColumn, splatRadiusColumn);
  sheet.standard.size = StyleSize{ SplatSize::Mode::World, 0.2, "" };
  EXPECT_FALSE(resolved(sheet)->radiusColumn);
  sheet.standard.size = StyleSize{ SplatSize::Mode::Attribute, 1.5, "" };
  EXPECT_EQ(resolved(sheet)->size, (SplatSize{ SplatSize::Mode::Attribute, 1.5, enclosingColumn }));
  EXPECT_EQ(resolved(sheet)->columns(), ColumnSelection{ enclosingColumn });
  sheet.standard.size->attribute = "intensity";
  EXPECT_EQ(resolved(sheet)->size.column, intensityColumn);
}

TEST(StyleSheet, RefusalsNameTheirPlace)
{
  StyleSheet sheet;
  sheet.classes[5].colour = ColourSource::ofAttribute("temperature");
  EXPECT_EQ(refusal(sheet),
    "classes.5.color: town.pfront has no attribute 'temperature' (info lists them)");
  sheet.classes[5].visible = false; // nobody asks then
  EXPECT_TRUE(sheet.resolveAll(styledStore({ 2, 5 })));
  sheet = {};
  sheet.standard.where = *FilterExpression::parse("weight < 1");
  EXPECT_EQ(refusal(sheet),
    "default.where: 'weight < 1', character 1: town.pfront has no attribute 'weight' (info lists "
    "them)");
  sheet = {};
  sheet.where = *FilterExpression::parse("weight < 1");
  EXPECT_EQ(refusal(sheet).rfind("where: 'weight < 1', character 1", 0), 0u);
  sheet = {};
  sheet.classes[2].size = StyleSize{ SplatSize::Mode::Attribute, 1.0, "weight" };
  EXPECT_EQ(refusal(sheet), "classes.2.size.attribute: town.pfront has no attribute 'weight'");
  sheet = {};
  sheet.standard.technique = Technique::Solid;
  EXPECT_NE(refusal(sheet).find("--height-above-ground"), std::string::npos);
  sheet = {};
  sheet.standard.colour =
    ColourSource::ofAttribute("normal", { ColourMapChoice::Kind::Grey, {}, {} });
  EXPECT_NE(refusal(sheet).find("name one of them, normal[0]"), std::string::npos);
}

TEST(StyleSheet, ColoursAreAttributesConstantsOrTwo)
{
  StyleSheet sheet;
  sheet.standard.colour = ColourSource::ofAttribute("classification");
  EXPECT_TRUE(resolved(sheet)->map->indexed);
  EXPECT_EQ(resolved(sheet)->map->at(2.0), (Rgba8{ 165, 120, 75, 255 }));
  sheet.standard.colour = ColourSource::ofAttribute("intensity");
  EXPECT_EQ(resolved(sheet)->map->range, (std::array<double, 2>{ 10.0, 210.0 }));
  EXPECT_EQ(resolved(sheet)->map->at(10.0), (Rgba8{ 0, 0, 0, 255 }));
  sheet.standard.colour = ColourSource::ofAttribute("elevation");
  EXPECT_EQ(resolved(sheet)->map->range, (std::array<double, 2>{ 40.0, 90.0 }));
  sheet.standard.colour = ColourSource::ofAttribute("normal.z");
  EXPECT_EQ(resolved(sheet)->map->range, (std::array<double, 2>{ -1.0, 1.0 }));
  EXPECT_EQ(resolved(sheet)->colouring.component, 2);
  sheet.standard.colour = ColourSource::ofAttribute("normal");
  EXPECT_EQ(resolved(sheet)->colouring.kind, PointColouring::Kind::Direct);
  EXPECT_EQ(resolved(sheet)->colouring.colourRange, (std::array<double, 2>{ -1.0, 1.0 }));
  sheet.standard.colour = ColourSource::ofAttribute("horizontality");
  EXPECT_EQ(resolved(sheet)->map->range, (std::array<double, 2>{ 0.0, 1.0 }));
  sheet.standard.colour = ColourSource::ofTwo(ColourCombination::Mix,
    ColourSource::ofAttribute("rgb"), ColourSource::ofAttribute("intensity"), 0.25);
  const auto mixed = resolved(sheet);
  EXPECT_EQ(mixed->second.combination, ColourCombination::Mix);
  EXPECT_EQ(mixed->second.share256, 64u);
  EXPECT_EQ(mixed->columns(), (ColumnSelection{ rgbColumn, intensityColumn, splatRadiusColumn }));
  auto other = *mixed;
  EXPECT_TRUE(other == *mixed);
  other.second.share256 = 65;
  EXPECT_FALSE(other == *mixed);
}

TEST(StyleSheet, TwoColoursAreCombinedPointByPoint)
{
  const StoreDescription store = styledStore({});
  StyleSheet sheet;
  sheet.standard.colour = ColourSource::ofTwo(ColourCombination::HueValue,
    ColourSource::ofConstant({ 200, 100, 0, 255 }), ColourSource::ofAttribute("intensity"));
  const auto style = resolved(sheet, 0, store);
  NodeColumns node;
  node.positions.resize(2);
  node.selection = { intensityColumn };
  const std::uint16_t values[] = { 10, 210 };
  node.columns = { std::vector<std::byte>(4) };
  std::memcpy(node.columns[0].data(), values, 4);
  const std::vector<std::uint32_t> colours =
    referenceColours(*style, node, store.schema, store.grid);
  ASSERT_EQ(colours.size(), 2u);
  Rgba8 dark;
  Rgba8 light;
  std::memcpy(dark.data(), &colours[0], 4);
  std::memcpy(light.data(), &colours[1], 4);
  EXPECT_EQ(dark, (Rgba8{ 0, 0, 0, 255 }));
  EXPECT_EQ(light, (Rgba8{ 255, 128, 0, 255 }));
}

TEST(ColourCombination, KeepsWhatNeutralColoursLeave)
{
  const Rgba8 colour{ 10, 130, 250, 77 };
  const Rgba8 white{ 255, 255, 255, 255 };
  const Rgba8 black{ 0, 0, 0, 255 };
  EXPECT_EQ(combined(ColourCombination::Multiply, 0, colour, white), colour);
  EXPECT_EQ(combined(ColourCombination::Multiply, 0, colour, black), (Rgba8{ 0, 0, 0, 77 }));
  EXPECT_EQ(combined(ColourCombination::Mix, 0, colour, white), colour);
  EXPECT_EQ(combined(ColourCombination::Mix, 256, colour, white), (Rgba8{ 255, 255, 255, 77 }));
  EXPECT_EQ(combined(ColourCombination::HueValue, 0, colour, { 0, 250, 3, 255 }), colour);
  const Rgba8 hueless = combined(ColourCombination::HueValue, 0, { 0, 0, 0, 9 }, { 5, 6, 7, 1 });
  EXPECT_EQ(hueless, (Rgba8{ 7, 7, 7, 9 }));
}

namespace
{

StyleLens circle(float radius = 10.0f)
{
  StyleLens lens;
  lens.place.centrePx = { 20.0f, 20.0f };
  lens.place.halfSizePx = glm::vec2(radius);
  return lens;
}

} // namespace

// Inside: its class, its default, the class outside, the default outside.
TEST(StyleLenses, WhatIsSaidInsideGoesBeforeWhatIsSaidOutside)
{
  StyleSheet sheet;
  sheet.standard.technique = Technique::Splats;
  sheet.classes[6].colour = ColourSource::ofConstant({ 1, 1, 1, 255 });
  sheet.classes[5].opacity = 0.5;
  StyleLens lens = circle();
  lens.standard.colour = ColourSource::ofConstant({ 9, 9, 9, 255 });
  lens.classes[5].visible = false;
  lens.classes[2].technique = Technique::Spheres;
  sheet.lenses.push_back(lens);
  const auto layers = all(sheet, styledStore({ 2, 5, 6 }));
  ASSERT_EQ(layers.size(), 3u);
  ASSERT_EQ(layers[0].styles.size(), 2u);
  EXPECT_EQ(layers[0].styles[0]->lens, -1);
  EXPECT_EQ(layers[0].styles[0]->technique, Technique::Splats);
  EXPECT_EQ(layers[0].styles[1]->lens, 0);
  EXPECT_EQ(layers[0].styles[1]->technique, Technique::Spheres);
  EXPECT_EQ(layers[0].styles[1]->flat, (Rgba8{ 9, 9, 9, 255 }));
  ASSERT_EQ(layers[1].styles.size(), 1u) << "hidden inside";
  EXPECT_EQ(layers[1].styles[0]->group, 6) << "translucent outside";
  ASSERT_EQ(layers[2].styles.size(), 2u);
  EXPECT_EQ(layers[2].styles[0]->flat, (Rgba8{ 1, 1, 1, 255 }));
  EXPECT_EQ(layers[2].styles[1]->flat, (Rgba8{ 9, 9, 9, 255 })) << "the lens' default";
}

TEST(StyleLenses, OneThatCoversNothingCostsNothing)
{
  StyleSheet sheet;
  sheet.classes[5].visible = false;
  const auto without = all(sheet, styledStore({ 2, 5, 6 }));
  StyleLens lens = circle(0.0f);
  lens.standard.colour = ColourSource::ofAttribute("gps_time");
  lens.classes[5].visible = true;
  sheet.lenses.push_back(lens);
  const auto with = all(sheet, styledStore({ 2, 5, 6 }));
  for (std::size_t layer = 0; layer < 3; ++layer)
  {
    EXPECT_EQ(with[layer].columns(), without[layer].columns());
    EXPECT_EQ(with[layer].styles.size(), without[layer].styles.size());
    EXPECT_EQ(with[layer].visible(), layer != 1);
  }
}

TEST(StyleLenses, MovingOneResolvesNothingAnew)
{
  StyleSheet sheet;
  sheet.lenses.push_back(circle());
  StyleSheet moved = sheet;
  moved.lenses[0].place.centrePx += 5.0f;
  moved.shading.eyeDomeStrength = 1.0f;
  EXPECT_TRUE(moved.resolvesAs(sheet));
  moved.lenses[0].place.halfSizePx = glm::vec2(0.0f);
  EXPECT_FALSE(moved.resolvesAs(sheet)) << "it covers nothing now";
  moved = sheet;
  moved.lenses[0].standard.opacity = 0.5;
  EXPECT_FALSE(moved.resolvesAs(sheet));
  moved = sheet;
  moved.shading.lit = true;
  EXPECT_FALSE(moved.resolvesAs(sheet)) << "light asks for normals";
}

TEST(StyleLenses, AroundAClassHaveTheClassesPointsAsTheirMask)
{
  StyleSheet sheet;
  StyleLens lens;
  lens.place.shape = LensShape::AroundClass;
  lens.aroundClass = 6;
  lens.aroundRadius = 4.0;
  sheet.lenses.push_back(lens);
  const auto layers = all(sheet, styledStore({ 2, 6 }));
  EXPECT_EQ(layers[0].styles.size(), 2u);
  ASSERT_EQ(layers[1].styles.size(), 3u);
  const ResolvedStyle& mask = *layers[1].styles[2];
  EXPECT_TRUE(mask.lensMask);
  EXPECT_EQ(mask.size.value, 8.0) << "a diameter";
  const auto tree = all(sheet, styledStore({}));
  ASSERT_EQ(tree[0].styles.size(), 3u);
  EXPECT_FALSE(tree[0].styles[2]->filter.empty()) << "of one tree, the class alone";
}

TEST(StyleOpacity, ZeroIsHiddenAndLessThanOneIsAGroup)
{
  StyleSheet sheet;
  sheet.standard.opacity = 0.5;
  sheet.classes[5].opacity = 0.0;
  sheet.classes[6].opacity = 1.0;
  sheet.classes[9].opacity = 0.5; // the default's, but a surface of its own
  for (const bool layered : { true, false })
  {
    const auto layers = all(sheet, layered ? styledStore({ 2, 3, 5, 6, 9 }) : styledStore({}));
    std::vector<std::uint16_t> groups;
    for (const LayerStyling& layer : layers)
    {
      for (const auto& style : layer.styles)
      {
        groups.push_back(style->group);
      }
    }
    std::vector<std::uint16_t> expected{ 257, 257, 0, 10 };
    expected.erase(expected.begin(), expected.begin() + (layered ? 0 : 1));
    EXPECT_EQ(groups, expected) << "one surface of all that have no style of their own";
  }
}

TEST(StyleHighlights, AreOfTheirClassAlone)
{
  StyleSheet sheet;
  sheet.highlights.push_back({ 5, {}, 2.0f, 0.5f });
  sheet.highlights.push_back({ 6, {}, 2.0f, 0.5f });
  const auto layers = all(sheet, styledStore({ 2, 5, 6 }));
  EXPECT_EQ(layers[0].styles[0]->highlight, 0);
  EXPECT_EQ(layers[1].styles[0]->highlight, 1);
  EXPECT_EQ(layers[2].styles[0]->highlight, 2);
  const auto tree = all(sheet, styledStore({}));
  ASSERT_EQ(tree[0].styles.size(), 3u);
  EXPECT_EQ(tree[0].styles[0]->highlight, 0);
  EXPECT_EQ(tree[0].styles[1]->highlight, 1);
  EXPECT_EQ(tree[0].styles[2]->highlight, 2);
}

TEST(Techniques, NamesAreInTheOrderOfTheEnumeration)
{
  for (std::size_t i = 0; i < techniqueTraits.size(); ++i)
  {
    EXPECT_EQ(static_cast<std::size_t>(techniqueTraits[i].technique), i);
    EXPECT_EQ(techniqueOf(techniqueTraits[i].name), techniqueTraits[i].technique);
  }
  EXPECT_FALSE(techniqueOf("Points"));
}

TEST(ColourCode, IsSixHexadecimalDigits)
{
  EXPECT_EQ(parseColourCode("#0aFf10"), (Rgba8{ 10, 255, 16, 255 }));
  EXPECT_EQ(colourCode({ 10, 255, 16, 255 }), "#0aff10");
  for (const char* text : { "", "#fff", "0aff10", "#0aff1g", "#0aff100", "red" })
  {
    EXPECT_FALSE(parseColourCode(text)) << text;
  }
}
