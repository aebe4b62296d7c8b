#include "StyledStore.h"

#include "pointfront/Style/StyleLooks.h"
#include "pointfront/Style/StyleSheet.h"
#include "pointfront/Style/TechniqueNames.h"

#include <gtest/gtest.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

std::vector<LayerStyling> layersBy(const StyleSheet& sheet, const StoreDescription& store)
{
  const auto styles = sheet.resolveAll(store);
  EXPECT_TRUE(styles) << (styles ? "" : styles.error().what);
  return styles ? *styles : std::vector<LayerStyling>();
}

StyleLight noLight()
{
  return { false, {}, {} };
}

bool defaultIsLit(const StyleSheet& sheet)
{
  return sheet.frameShading().lit;
}

} // namespace

TEST(StyleLooks, SpheresAreLitUnlessSomebodySaysOtherwise)
{
  for (const TechniqueTraits& traits : techniqueTraits)
  {
    StyleSheet sheet;
    sheet.standard.technique = traits.technique;
    EXPECT_EQ(defaultIsLit(sheet), traits.technique == Technique::Spheres) << traits.name;
    sheet.shading.lit = true;
    EXPECT_TRUE(defaultIsLit(sheet)) << traits.name;
    sheet.standard.light = noLight();
    EXPECT_FALSE(defaultIsLit(sheet)) << traits.name;
  }
}

TEST(StyleLooks, AClassHasWhatItSaysThenTheDefaultsThenTheSheets)
{
  StyleSheet sheet;
  sheet.shading.ambient = 0.5f;
  sheet.shading.eyeDomeStrength = 0.8f;
  sheet.shading.eyeDomeRadiusPx = 3.0f;
  sheet.classes[5].technique = Technique::Spheres;
  sheet.classes[6].light = StyleLight{ true, {}, 0.9f };
  sheet.classes[6].eyeDome = StyleEyeDome{ true, 0.2f, {} };
  sheet.classes[9].eyeDome = StyleEyeDome{ false, {}, {} };
  const auto look = [&](std::uint8_t code) { return lookOf(sheet.styleOf(code), sheet.shading); };
  EXPECT_EQ(look(2), (FrameLook{ false, 0.3f, 0.7f, 0.8f, 3.0f }));
  EXPECT_EQ(look(5), (FrameLook{ true, 0.5f, 0.7f, 0.8f, 3.0f }));
  EXPECT_EQ(look(6), (FrameLook{ true, 0.5f, 0.9f, 0.2f, 3.0f }));
  EXPECT_EQ(look(9), FrameLook());
  sheet.standard.light = noLight();
  EXPECT_FALSE(look(5).lit) << "the default's light is off for spheres too";
  EXPECT_TRUE(look(6).lit) << "a class has the last word";
  sheet.shading.eyeDomeStrength = 0.0f;
  sheet.classes[9].eyeDome = StyleEyeDome();
  EXPECT_EQ(look(9).eyeDomeStrength, usualEyeDomeStrength);
}

TEST(StyleLooks, EqualOnesAreOneAndEachStyleKnowsItsNumber)
{
  StyleSheet sheet;
  sheet.classes[5].technique = Technique::Spheres;
  sheet.classes[6].light = StyleLight();
  sheet.classes[9].opacity = 0.5;
  StyleLens lens;
  lens.place.halfSizePx = glm::vec2(10.0f);
  lens.standard.eyeDome = StyleEyeDome();
  sheet.lenses.push_back(lens);
  const FrameShading shading = sheet.frameShading();
  EXPECT_EQ(shading.lookCount(), 4u) << "plain, lit, and both with eye-dome lighting";
  for (const bool layered : { true, false })
  {
    for (const LayerStyling& layer :
      layersBy(sheet, layered ? styledStore({ 2, 5, 6, 9 }) : styledStore({})))
    {
      for (const auto& style : layer.styles)
      {
        const FrameLook& look = shading.look(style->look);
        EXPECT_EQ(look.eyeDomeStrength > 0.0f, style->lens == 0);
      }
    }
  }
  const auto layers = layersBy(sheet, styledStore({ 2, 5, 6, 9 }));
  const auto look = [&](std::size_t layer) { return layers[layer].styles[0]->look; };
  EXPECT_EQ(look(0), 0);
  EXPECT_EQ(look(1), look(2)) << "spheres and what is lit";
  EXPECT_NE(look(1), 0);
  EXPECT_EQ(look(3), 0);
}

TEST(StyleLooks, NormalsAreReadForClassesThatAreLit)
{
  StyleSheet sheet;
  sheet.standard.size = StyleSize{ SplatSize::Mode::Pixels, 2.0, "" };
  sheet.standard.colour = ColourSource::ofConstant({ 1, 2, 3, 255 });
  sheet.classes[6].light = StyleLight();
  const auto layers = layersBy(sheet, styledStore({ 2, 6 }));
  EXPECT_EQ(layers[0].columns(), ColumnSelection{});
  EXPECT_EQ(layers[1].columns(), ColumnSelection{ normalsColumn });
}

TEST(StyleLooks, ANumberThatMovesResolvesAnew)
{
  StyleSheet sheet;
  sheet.classes[6].eyeDome = StyleEyeDome{ true, 0.5f, {} };
  StyleSheet other = sheet;
  other.shading.eyeDomeStrength = 0.2f;
  EXPECT_TRUE(other.resolvesAs(sheet)) << "two looks before and after";
  other.shading.eyeDomeStrength = 0.5f;
  EXPECT_FALSE(other.resolvesAs(sheet)) << "the class looks as the default";
  EXPECT_EQ(other.frameShading().lookCount(), 1u);
}
